//! The report as a whole: what it shows, what it must not load, and what it must not replace.

use super::*;
use crate::Error;
use crate::picture::DisplayPicture;
use crate::suite::Results;
use std::fs;
use std::path::Path;

/// The sample's results with pictures, written to a folder.
fn write(dir: &Path, results: &Results) -> crate::Result<()> {
    let reference = sample::picture(1.0);
    let captures: Vec<DisplayPicture> = (0..6).map(|i| sample::picture(0.05 + 0.19 * i as f32)).collect();
    let maps: Vec<DisplayPicture> = captures
        .iter()
        .map(|capture| crate::metrics::error_map(&crate::metrics::Pair::new(capture, &reference)?))
        .collect::<crate::Result<_>>()?;
    let pictures = |i: usize| MethodPictures { capture: &captures[i % 6], error_map: Some(&maps[i % 6]) };
    let scenes = results.scenes.iter().map(|scene| ScenePictures {
        reference: &reference,
        methods: scene
            .methods
            .iter()
            .enumerate()
            .map(|(i, method)| matches!(method.outcome, crate::suite::Outcome::Scored { .. }).then(|| pictures(i)))
            .collect(),
    });
    write_html(dir, &ReportInput { results, scenes: scenes.collect() })
}

fn page_of(results: &Results) -> String {
    let home = tempfile::tempdir().expect("a folder");
    let dir = home.path().join("report");
    write(&dir, results).expect("written");
    fs::read_to_string(dir.join("index.html")).expect("a page")
}

#[test]
fn json_is_stable_and_comes_back() {
    let results = sample::results(6);
    assert_eq!(json(&results), json(&results.clone()));
    let read: Results = serde_json::from_str(&json(&results)).expect("readable");
    assert_eq!(read.scenes[1].methods[2], results.scenes[1].methods[2]);
    assert!(json(&results).contains("\"timing\"") && json(&results).ends_with("}\n"));
}

#[test]
fn the_page_loads_nothing_but_its_pictures() {
    let home = tempfile::tempdir().expect("a folder");
    let dir = home.path().join("report");
    write(&dir, &sample::results(6)).expect("written");
    let page = fs::read_to_string(dir.join("index.html")).expect("a page");
    for address in ["http://", "https://", "src=\"//", "url(", "@import", "fetch("] {
        assert!(!page.contains(address), "{address}");
    }
    let sources: Vec<&str> = page.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert_eq!(sources.len(), 20);
    for source in sources {
        assert!(dir.join(source).is_file(), "{source}");
    }
    assert!(dir.join("results.json").is_file());
}

#[test]
fn the_same_input_gives_the_same_page() {
    assert_eq!(page_of(&sample::results(6)), page_of(&sample::results(6)));
}

#[test]
fn names_are_escaped() {
    let mut results = sample::results(6);
    for scene in &mut results.scenes {
        scene.name = "<b>bold</b>".into();
        scene.about = "a \"quoted\" <script>alert(1)</script>".into();
        scene.methods[0].spec = "<i>none</i>".into();
        scene.reference.spec = "<u>reference</u>".into();
    }
    results.command.push("<s>".into());
    let page = page_of(&results);
    for tag in ["<b>", "<i>", "<u>", "<s>", "<script>alert"] {
        assert!(!page.contains(tag), "{tag}");
    }
    assert!(page.contains("&lt;b&gt;bold&lt;/b&gt;"));
}

#[test]
fn failures_and_words_are_shown() {
    let page = page_of(&sample::results(6));
    assert!(page.contains("failed: this adapter has 1 and 4 samples, not 16; choose one of them"));
    assert!(page.contains(">inf<") && page.contains("infinite: the pictures are equal"));
    assert!(page.contains(">NaN<") && page.contains("3 pixels are NaN or infinite, the first in column 4, row 2"));
    assert!(page.contains("dejag score edges fence -m none --size 160x90"));
    assert!(page.contains("Noise floor") || page.contains("noise floor RMS 1.2e-4"));
}

#[test]
fn straight_edges_have_a_section_where_there_are_any() {
    use crate::suite::{EdgeCurve, EdgeErrors};
    let mut results = sample::results(2);
    assert!(!page_of(&results).contains("Straight edges"));
    let curve =
        |name: &str, rms: [f64; 3]| EdgeCurve { name: name.into(), baseline: name == "none", over_all: 0.25, rms: rms.into() };
    let curves = vec![curve("none", [0.29, 0.25, 0.22]), curve("<filter>", [0.1, 0.125, 0.05])];
    results.edges = Some(EdgeErrors { degrees: vec![0, 1, 2], curves });
    let page = page_of(&results);
    for text in ["href=\"#edges\"", "degrees from a vertical edge", "&lt;filter&gt;", "0.1250</td><td>1</td>"] {
        assert!(page.contains(text), "{text}");
    }
    let read: Results = serde_json::from_str(&json(&results)).expect("readable");
    assert_eq!(read.edges, results.edges);
}

#[test]
fn a_scene_without_pictures_or_times_does_no_harm() {
    let mut results = sample::results(3);
    results.scenes[0].methods.remove(0);
    results.scenes[0].methods.remove(0);
    results.scenes[1].methods.clear();
    let page = page_of(&results);
    assert!(page.contains("No method made a picture of this scene."));
}

#[test]
fn a_foreign_folder_is_refused_and_an_old_report_replaced() {
    let home = tempfile::tempdir().expect("a folder");
    let (foreign, dir) = (home.path().join("foreign"), home.path().join("report"));
    fs::create_dir(&foreign).expect("made");
    fs::write(foreign.join("index.html"), b"somebody's page").expect("written");
    assert!(matches!(write(&foreign, &sample::results(2)), Err(Error::Request(_))));
    assert_eq!(fs::read(foreign.join("index.html")).expect("still there"), b"somebody's page");

    write(&dir, &sample::results(6)).expect("written");
    let many = fs::read_dir(dir.join("pictures")).expect("pictures").count();
    write(&dir, &sample::results(1)).expect("replaced");
    let few = fs::read_dir(dir.join("pictures")).expect("pictures").count();
    assert_eq!((many, few), (22, 6));
}

#[test]
fn pictures_must_belong_to_the_results() {
    let home = tempfile::tempdir().expect("a folder");
    let dir = home.path().join("report");
    let results = sample::results(2);
    let none = write_html(&dir, &ReportInput { results: &results, scenes: vec![] });
    assert!(matches!(none, Err(Error::Request(_))), "{none:?}");
    let mut report = HtmlReport::begin(&dir).expect("begun");
    report.add_scene("another", &sample::picture(1.0)).expect("saved");
    assert!(matches!(report.finish(&results), Err(Error::Request(_))));
    assert_eq!(fs::read_dir(home.path()).expect("a folder").count(), 0, "nothing is left behind");
}
