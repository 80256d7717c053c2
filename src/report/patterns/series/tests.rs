//! The folder is complete, names are harmless, figures are those of the results.

use super::*;
use crate::suite::{Chapter, SERIES_SCHEMA_VERSION, SampledPicture, Series, Stamp, Subject};

fn results() -> SeriesResults {
    let subject = |name: &str| Subject {
        name: name.into(),
        about: "on the CPU".into(),
        exact: "exact means".into(),
        size: [80, 70],
        detail: [16, 6],
    };
    let series = |title: &str, subject, rms: [f64; 2]| {
        let picture = |(spp, rms)| SampledPicture { pattern: title.into(), sets: "fresh".into(), spp, rms };
        Series { title: title.into(), subject, pictures: [1, 16].into_iter().zip(rms).map(picture).collect() }
    };
    let text = |text: &str| text.to_owned();
    SeriesResults {
        schema_version: SERIES_SCHEMA_VERSION,
        stamp: Stamp {
            dejag: text("0"),
            adapter: text("<i>card</i>"),
            kind: text("software"),
            driver: text("d"),
            driver_version: text("1"),
            backend: text("vulkan"),
        },
        command: vec!["patterns".into(), "report".into()],
        chapters: vec![Chapter {
            title: "A & B".into(),
            about: "look".into(),
            subjects: vec![subject("<b>one</b>"), subject("two")],
            series: vec![
                series("jittered", 0, [0.25, 0.1]),
                series("jittered", 1, [0.123_44, 0.0]),
                series("<u>", 0, [0.5, 0.031_26]),
            ],
        }],
    }
}

fn write(dir: &Path, results: &SeriesResults) {
    let report = SeriesReport::begin(dir).expect("begins");
    let picture = DisplayPicture::from_fn(80, 70, |x, y| [x as f32 / 80.0, y as f32 / 70.0, 0.5, 1.0]).expect("fits");
    for (number, chapter) in results.chapters.iter().enumerate() {
        for subject in 0..chapter.subjects.len() {
            report.add(number, SeriesPicture::Exact { subject }, &picture).expect("written");
        }
        for (series, of) in chapter.series.iter().enumerate() {
            for picture_place in 0..of.pictures.len() {
                report.add(number, SeriesPicture::Sampled { series, picture: picture_place }, &picture).expect("written");
            }
        }
    }
    report.finish(results).expect("finishes");
}

/// The values of all attributes of this name.
fn values<'p>(page: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    page.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_link_has_its_end_and_every_file_its_link() {
    let home = tempfile::tempdir().expect("a folder");
    let target = home.path().join("report");
    write(&target, &results());
    let page = std::fs::read_to_string(target.join("index.html")).expect("a page");
    let links = [values(&page, "href"), values(&page, "src")].concat();
    for link in &links {
        match link.strip_prefix('#') {
            Some(id) => assert!(values(&page, "id").contains(&id), "nothing is called {id}"),
            None => assert!(target.join(link).is_file(), "no file {link}"),
        }
    }
    let files: Vec<_> = std::fs::read_dir(target.join("pictures")).expect("a folder").collect();
    assert_eq!(files.len(), 2 + 6);
    for file in files {
        let name = format!("pictures/{}", file.expect("an entry").file_name().to_string_lossy());
        assert!(links.contains(&name.as_str()), "{name} is not shown");
    }
    assert!(!page.contains("http://") && !page.contains("https://"), "it loads nothing from elsewhere");
    let shown = page.matches("<img").count();
    assert_eq!((page.matches("loading=\"lazy\"").count(), values(&page, "alt").len()), (shown, shown));
    assert!(values(&page, "alt").iter().all(|alt| !alt.is_empty()));
    assert!(page.contains("image-rendering: pixelated") && page.contains("prefers-color-scheme: dark"));
}

#[test]
fn names_are_escaped_and_figures_are_those_of_the_results() {
    let text = page::page(&results());
    for name in ["&lt;b&gt;one&lt;/b&gt;", "&lt;i&gt;card", "&lt;u&gt;", "A &amp; B"] {
        assert!(text.contains(name), "{name}");
    }
    for raw in ["<b>", "<i>", "<u>"] {
        assert!(!text.contains(raw), "{raw}");
    }
    // In the table, and under the picture; the half is rounded up.
    for (cell, caption) in [
        ("<td>250.0</td>", "RMS 250.0, 12.0 dB"),
        ("<td>123.4</td>", "RMS 123.4, 18.2 dB"),
        ("<td>31.3</td>", "RMS 31.3, 30.1 dB"),
    ] {
        assert!(text.contains(cell) && text.contains(caption), "{cell} {caption}");
    }
    assert!(text.contains("RMS 0.0, inf dB"));
    // Titles stand once over the rows that share them.
    assert_eq!(text.matches("<h3").count(), 2);
}

#[test]
fn the_same_results_give_the_same_bytes() {
    assert_eq!(page::page(&results()), page::page(&results()));
}
