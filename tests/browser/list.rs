//! The list: filters, order, keys, the address.

use super::chromium;
use super::sample::{Sample, earlier, mixed};

/// Ids of the rows that are shown, from the top, in one text.
const SHOWN: &str = "Array.from(document.querySelectorAll('.case')).filter((row) => row.getClientRects().length > 0)\
     .map((row) => decodeURIComponent(row.dataset.id).slice(5)).join(' ')";

/// The one that has the focus.
const FOCUSED: &str = "document.activeElement.closest('.case')?.dataset.id ?? 'none'";

#[test]
fn filters_and_orders_show_what_they_say() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "");
    // Those without figures, then by their share of differing pixels, those that are the same last.
    let worst_first = "04-size 05-missing 06-new 07-unreadable 08-failed 02-different 09-different 01-same 03-same 10-same";
    assert_eq!(page.text(SHOWN), worst_first);
    assert_eq!(page.text("document.getElementById('shown').textContent"), "10 of 10 shown");

    page.click("[data-show=different]");
    assert_eq!(page.text(SHOWN), "02-different 09-different");
    assert_eq!(page.text("document.querySelector('[data-show=different]').getAttribute('aria-pressed')"), "true");
    assert_eq!(page.text("document.querySelector('[data-show=all]').getAttribute('aria-pressed')"), "false");
    page.click("[data-show=not-same]");
    assert_eq!(page.text("document.getElementById('shown').textContent"), "7 of 10 shown");

    page.key("/");
    page.type_text("DISC/02");
    assert_eq!(page.text(SHOWN), "02-different");
    assert!(page.text("location.hash").contains("find=DISC%2F02"));

    page.open(&sample.page(), "#sort=manifest");
    page.wait("document.getElementById('sort').value === 'manifest'");
    assert!(page.text(SHOWN).starts_with("01-same 02-different 03-same 04-size"));
    page.must_be_content();
}

#[test]
fn keys_lead_through_the_list_into_a_case_and_back() {
    let sample = Sample::write(mixed(), &earlier());
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "#show=different");
    page.wait("document.getElementById('shown').textContent === '2 of 10 shown'");
    page.key("j");
    assert_eq!(page.text(FOCUSED), "disc/02-different");
    page.key("ArrowDown");
    assert_eq!(page.text(FOCUSED), "disc/09-different");
    page.key("k");
    page.key("Enter");
    assert_eq!(page.ask("document.getElementById('viewer').open"), true);
    assert_eq!(page.text("location.hash"), "#show=different&case=disc%2F02-different");
    page.key("j");
    assert_eq!(page.text("document.getElementById('name').textContent"), "disc/09-different");
    assert_eq!(page.text("document.getElementById('said').textContent"), "Case 2 of 2: disc/09-different, different");
    page.key("Escape");
    page.wait("location.hash === '#show=different' && !document.getElementById('viewer').open");
    assert_eq!(page.text(FOCUSED), "disc/09-different");

    page.key("?");
    assert_eq!(page.ask("document.getElementById('help').open"), true);
    page.key("Escape");
    page.wait("!document.getElementById('help').open");
    // What is typed is no command.
    page.key("/");
    page.type_text("jk?1");
    assert_eq!(page.text("document.getElementById('find').value"), "jk?1");
    assert_eq!(page.ask("document.getElementById('help').open"), false);
    page.must_be_content();
}

#[test]
fn an_address_opens_its_case_and_the_way_back_closes_it() {
    let sample = Sample::write(mixed(), &[]);
    let Some(mut page) = chromium::start() else { return };
    page.open(&sample.page(), "#case=disc%2F09-different&view=flip");
    page.wait("document.getElementById('panes').dataset.ready === 'true'");
    assert_eq!(page.text("document.getElementById('name').textContent"), "disc/09-different");
    assert_eq!(page.text("document.getElementById('panes').dataset.view"), "flip");
    page.key("Escape");
    page.wait("!document.getElementById('viewer').open && !location.hash.includes('case=')");
    page.click(".case h3 a");
    page.wait("document.getElementById('viewer').open && location.hash.includes('case=')");
    page.ask("history.back()");
    page.wait("!document.getElementById('viewer').open");
    // An address that names nothing opens nothing.
    page.ask("location.hash = '#case=nothing&view=nonsense&sort=constructor'");
    page.wait("document.getElementById('sort').value === 'worst'");
    assert_eq!(page.ask("document.getElementById('viewer').open"), false);
    page.must_be_content();
}
