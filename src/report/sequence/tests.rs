use super::*;
use crate::metrics::Figure;
use crate::report::sample;

fn picture(value: f32) -> DisplayPicture {
    DisplayPicture::from_fn(4, 3, |_, _| [value, value, value, 1.0]).expect("fits")
}

#[test]
fn a_strip_shows_both_ends_and_never_too_many() {
    assert_eq!(strip_places(0), [0; 0]);
    assert_eq!(strip_places(1), [0]);
    assert_eq!(strip_places(3), [0, 1, 2]);
    let places = strip_places(64);
    assert_eq!((places.len(), places.first(), places.last()), (8, Some(&0), Some(&63)));
    assert!(places.windows(2).all(|w| w[0] < w[1]));
}

#[test]
fn the_page_shows_every_method_its_film_and_its_curves_and_escapes_names() {
    let home = tempfile::tempdir().expect("a folder");
    let target = home.path().join("report");
    let mut results = sample::sequence();
    results.result.methods[0].spec = "<b>loud</b>".into();
    let mut report = SequenceReport::begin(&target).expect("begins");
    report.add(0, Shown::Reference, &picture(0.5)).expect("written");
    report.add(0, Shown::Capture(0), &picture(0.25)).expect("written");
    report.add(0, Shown::ErrorMap(0), &picture(0.75)).expect("written");
    report.finish(&results).expect("finishes");
    let page = std::fs::read_to_string(target.join("index.html")).expect("a page");
    assert!(page.contains("&lt;b&gt;loud&lt;/b&gt;") && !page.contains("<b>loud"), "{page}");
    for file in ["00000-reference.png", "00000-00.png", "00000-00-error.png"] {
        assert!(page.contains(file) && target.join("pictures").join(file).is_file(), "{file}");
    }
    assert!(page.contains("<svg") && page.contains("Visible error"), "no curves");
    assert!(!page.contains("http://") && !page.contains("https://"), "it loads nothing");
    assert!(target.join("results.json").is_file());
}

#[test]
fn what_was_not_measured_has_no_curve() {
    let mut results = sample::sequence();
    for method in &mut results.result.methods {
        if let crate::suite::SequenceOutcome::Measured(figures) = &mut method.outcome {
            figures.figures.iter_mut().for_each(|figure| figure.frames.fill(Figure::NotApplicable));
            figures.ghost.ages.fill(Figure::NotApplicable);
            figures.probes = Default::default();
        }
    }
    assert!(curves::all(&results.result).is_empty());
}
