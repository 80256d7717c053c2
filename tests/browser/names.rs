//! Names that would like to be more than names.

use dejag::suite::DiffOutcome;

use super::chromium;
use super::sample::{Sample, case};

const HOSTILE: [&str; 7] = [
    "<img src=x onerror=window.pwned=1>\"'",
    "</script><script>window.pwned=1</script>",
    "\"onmouseover=\"window.pwned=1\" x=\"",
    "../../../etc/passwd",
    "a\r\nb\tc",
    "javascript:window.pwned=1//&case=x#y%41+z",
    "\u{202e}gnp.esrever é 漢",
];

#[test]
fn hostile_names_do_nothing_and_their_cases_open() {
    let mut cases: Vec<_> = HOSTILE.iter().map(|id| case(id, DiffOutcome::Different)).collect();
    for case in &mut cases {
        let id = case.id.clone();
        case.about.clone_from(&id);
        case.entry = format!("{id}-entry");
        case.pair.why = Some(id.clone());
        case.likely_causes = vec![id.clone()];
        case.pair.knobs[0].option.clone_from(&id);
        case.pair.knobs[0].metric.clone_from(&id);
        if let Some(golden) = &mut case.golden {
            golden.provenance.insert(id.clone(), id.clone());
            golden.environment = id;
        }
    }
    let sample = Sample::write(cases, &[]);
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "");
    for id in HOSTILE {
        let name = serde_json::to_string(&id.replace(char::is_control, "\u{fffd}")).expect("a string");
        let id = serde_json::to_string(id).expect("a string");
        page.ask(&format!("location.hash = '#case=' + encodeURIComponent({id})"));
        page.wait(&format!("document.getElementById('viewer').open && document.getElementById('name').textContent === {name}"));
        page.wait("document.getElementById('panes').dataset.ready === 'true'");
    }
    page.must_be_content();
    assert_eq!(page.ask("typeof window.pwned"), "undefined");
    assert_eq!(page.ask("document.scripts.length"), 1, "the page's own");
    assert_eq!(page.ask("document.querySelectorAll('img[onerror], [onmouseover]').length"), 0);
    let files = page.ask("Array.from(document.images, (image) => image.getAttribute('src')).filter(Boolean)");
    let files: Vec<&str> = files.as_array().expect("a list").iter().filter_map(|file| file.as_str()).collect();
    assert!(files.len() >= 3 * HOSTILE.len(), "{files:?}");
    assert!(files.iter().all(|file| file.starts_with("pictures/0000") && !file.contains("..")), "{files:?}");
}

#[test]
fn a_script_that_slipped_into_the_page_would_not_run() {
    let sample = Sample::write(vec![case("one", DiffOutcome::Different)], &[]);
    let Some(mut page) = chromium::start() else { return };
    let text = std::fs::read_to_string(sample.page()).expect("a page");
    std::fs::write(sample.page(), text.replace("<main>", "<main><script>window.pwned=1</script>")).expect("written");
    page.open(&sample.page(), "");
    page.ask("new Promise((done) => setTimeout(() => done(true), 100))");
    assert_eq!(page.ask("typeof window.pwned"), "undefined");
    assert!(page.complaints.iter().any(|complaint| complaint.contains("Content Security Policy")), "{:?}", page.complaints);
}
