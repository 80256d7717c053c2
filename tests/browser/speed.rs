//! Two thousand cases: how soon something is seen, whether what is not seen is left alone, how evenly it scrolls.

use dejag::suite::{CheckedCase, DiffOutcome};

use super::chromium;
use super::sample::{Sample, case};

const CASES: usize = 2000;

/// A hundred that differ, dealt evenly.
fn many() -> Vec<CheckedCase> {
    let outcome = |i: usize| if i % 20 == 7 { DiffOutcome::Different } else { DiffOutcome::Same };
    (0..CASES).map(|i| case(&format!("group-{:02}/case-{i:04}", i / 100), outcome(i))).collect()
}

/// Scrolls by 40 CSS pixels a frame and returns the milliseconds between frames, sorted.
const SCROLL: &str = "new Promise((done) => {
  const times = [];
  const frame = (now) => {
    times.push(now);
    if (times.length > 180) { done(times.slice(1).map((time, i) => time - times[i]).sort((a, b) => a - b)); return; }
    window.scrollBy({ top: 40, behavior: 'instant' });
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
})";

#[test]
fn two_thousand_cases_are_seen_at_once_and_scroll_evenly() {
    let sample = Sample::write(many(), &[]);
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "");
    let paint = "performance.getEntriesByName('first-contentful-paint').length > 0";
    page.wait(paint);
    let first = page.ask("performance.getEntriesByName('first-contentful-paint')[0].startTime").as_f64().expect("a time");
    let ready = page.ask("performance.getEntriesByType('navigation')[0].loadEventEnd").as_f64().expect("a time");
    assert_eq!(page.text("document.getElementById('shown').textContent"), format!("{CASES} of {CASES} shown"));

    let loaded = "Array.from(document.images).filter((image) => image.naturalWidth > 0).length";
    let at_first = page.ask(loaded).as_u64().expect("a number");
    let images = page.ask("document.querySelectorAll('#cases img').length").as_u64().expect("a number");
    assert!(at_first > 0 && at_first < images / 10, "{at_first} of {images} pictures are loaded though few are in view");

    let deltas = page.ask(SCROLL);
    let deltas: Vec<f64> = deltas.as_array().expect("a list").iter().filter_map(serde_json::Value::as_f64).collect();
    let (median, worst) = (deltas[deltas.len() / 2], deltas[deltas.len() - 1]);
    let size = std::fs::metadata(sample.page()).expect("a page").len();
    println!(
        "{CASES} cases: page of {} kB, first paint {first:.0} ms, loaded {ready:.0} ms, {at_first} of {images} pictures, frames while \
         scrolling: median {median:.1} ms, worst {worst:.1} ms",
        size / 1000
    );
    page.shoot("many");
    assert!(first < 1000.0, "first paint after {first:.0} ms");
    assert!(median < 34.0, "a frame takes {median:.1} ms");
    assert!(page.ask("scrollY").as_f64().expect("a number") > 5000.0);
    page.must_be_content();
}
