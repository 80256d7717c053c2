//! Dark and light, wide and narrow, paper.

use super::chromium::{self, Page};
use super::sample::{Sample, earlier, mixed};

const VIEWS: [&str; 6] = ["side", "slider", "flip", "blink", "difference", "heat"];

/// The mean of the ground's three levels.
fn ground(page: &mut Page) -> f64 {
    let color = page.text("getComputedStyle(document.body).backgroundColor");
    let levels: Vec<f64> = color.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
    levels[..3].iter().sum::<f64>() / 3.0
}

fn display(page: &mut Page, selector: &str) -> String {
    page.text(&format!("getComputedStyle(document.querySelector('{selector}')).display"))
}

#[test]
fn the_page_follows_the_system_s_dark_mode() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "");
    for (scheme, light) in [("light", true), ("dark", false)] {
        page.prefer("", &[("prefers-color-scheme", scheme)]);
        assert_eq!(ground(&mut page) > 128.0, light, "{scheme}");
        page.shoot(&format!("list-{scheme}"));
    }
    page.must_be_content();
}

#[test]
fn paper_has_the_failing_cases_with_their_facts_on_white() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "");
    assert_eq!(display(&mut page, ".case.same"), "flex");
    assert_eq!(display(&mut page, ".facts-of"), "none");
    page.prefer("print", &[("prefers-color-scheme", "dark")]);
    assert!(ground(&mut page) > 250.0);
    for (selector, shown) in [("#controls", "none"), (".case.same", "none"), (".case:not(.same)", "flex"), (".facts-of", "block")]
    {
        assert_eq!(display(&mut page, selector), shown, "{selector}");
    }
    page.shoot("paper");
    page.print("paper");
    page.must_be_content();
}

#[test]
fn without_scripts_every_case_has_its_facts_in_place() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.call("Emulation.setScriptExecutionDisabled", &serde_json::json!({ "value": true }));
    page.open(&sample.page(), "");
    assert_eq!(display(&mut page, "#controls"), "none");
    assert_eq!(display(&mut page, ".facts-of"), "block");
    assert!(page.ask("document.querySelector('.case img').naturalWidth").as_u64() > Some(0));
    assert!(page.complaints.is_empty(), "{:?}", page.complaints);
}

#[test]
fn nothing_is_wider_than_a_narrow_screen() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.resize([400, 800]);
    page.open(&sample.page(), "");
    assert_eq!(page.ask("document.documentElement.scrollWidth"), 400);
    page.shoot("narrow-list");
    page.ask("location.hash = '#case=disc%2F02-different'");
    page.wait("document.getElementById('panes').dataset.ready === 'true'");
    let fits = "document.getElementById('viewer').scrollWidth <= document.getElementById('viewer').clientWidth";
    assert_eq!(page.ask(fits), true);
    page.shoot("narrow-case");
    page.must_be_content();
}

#[test]
fn every_view_fills_its_window() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "#case=disc%2F02-different");
    page.wait("document.getElementById('panes').dataset.ready === 'true'");
    for (number, view) in (1..).zip(VIEWS) {
        page.key(&number.to_string());
        page.wait(&format!(
            "document.getElementById('panes').dataset.view === '{view}' && document.getElementById('one').clientHeight > 200"
        ));
        page.ask("new Promise((done) => setTimeout(() => done(true), 100))");
        page.shoot(&format!("view-{number}-{view}"));
    }
    page.key("1");
    page.key("w");
    page.shoot("view-worst");
    page.prefer("", &[("prefers-color-scheme", "dark")]);
    page.shoot("view-worst-dark");
    page.key("?");
    page.shoot("keys");
    page.must_be_content();
}
