//! One case in the list: what it came to in a few lines, its pictures small, and all it has to say for the opened view.

use maud::{Markup, html};

use super::facts;
use super::files::{CaseFiles, Picture};
use super::history::History;
use super::is_same;
use super::page::outcome_class;
use crate::metrics::Figure;
use crate::report::words::{figure, printable};
use crate::suite::{CheckedCase, Knob};

/// A case, where its pictures lie, and its place in the manifest, from 1.
pub(super) struct Shown<'a> {
    pub(super) case: &'a CheckedCase,
    pub(super) files: &'a CaseFiles,
    number: usize,
}

pub(super) fn shown<'a>(((case, files), number): ((&'a CheckedCase, &'a CaseFiles), usize)) -> Shown<'a> {
    Shown { case, files, number }
}

/// Differing pixels as a share of those that were compared; none if none were.
pub(super) fn differing_share(case: &CheckedCase) -> Option<f64> {
    let pixels = case.pair.pixels.as_ref().filter(|pixels| pixels.compared > 0)?;
    Some(pixels.differing as f64 / pixels.compared as f64)
}

/// The limit of FLIP, met or not, where the case has one.
pub(super) fn flip(case: &CheckedCase) -> Option<&Knob> {
    case.pair.knobs.iter().find(|knob| knob.metric.starts_with("flip-"))
}

pub(super) fn row(shown: &Shown<'_>, history: &History<'_>) -> Markup {
    let Shown { case, files, number } = shown;
    let key = percent_encoded(&case.id);
    let flip = flip(case).and_then(|knob| knob.value.number());
    let worst = case.pair.pixels.as_ref().and_then(|pixels| pixels.worst.as_ref());
    html! {
        li.case.same[is_same(case)] data-id=(key) data-outcome=(case.pair.outcome.as_str()) data-place=(number)
            data-flip=[flip] data-pixels=[files.pixels.as_deref()] data-heat=[files.heat.full()]
            data-worst=[worst.map(|worst| format!("{},{}", worst.at[0], worst.at[1]))] {
            (thumbnails(files))
            div.what {
                h3 {
                    (outcome_word(case)) " "
                    a href={ "#case=" (key) } { bdi { (printable(&case.id)) } }
                }
                @if !case.about.is_empty() { p.about { (printable(&case.about)) } }
                p.figures { (in_a_line(case)) }
                (history.of_case(case))
            }
            div.facts-of { (facts::facts(case, files)) }
        }
    }
}

pub(super) fn outcome_word(case: &CheckedCase) -> Markup {
    html! { span.outcome.(outcome_class(case.pair.outcome)) { (case.pair.outcome.as_str()) } }
}

fn thumbnails(files: &CaseFiles) -> Markup {
    let sides = [("expected", &files.expected), ("actual", &files.actual), ("difference", &files.heat)];
    html! { div.small { @for (word, picture) in sides { (thumbnail(word, picture)) } } }
}

fn thumbnail(word: &str, picture: &Picture) -> Markup {
    let Picture::Shown { small, small_px: [width, height], .. } = picture else { return html! {} };
    html! {
        figure {
            img src=(small) width=(width) height=(height) alt=(word) loading="lazy" decoding="async";
            figcaption { (word) }
        }
    }
}

/// Why, or the figures that decide.
fn in_a_line(case: &CheckedCase) -> String {
    let mut parts: Vec<String> = case.pair.why.iter().map(|why| printable(why)).collect();
    if let Some(pixels) = &case.pair.pixels {
        parts.push(match pixels.differing {
            0 => format!("all {} compared pixels are equal", pixels.compared),
            differing => format!("{differing} of {} pixels differ ({})", pixels.compared, percent(case)),
        });
    }
    parts.extend(case.pair.knobs.iter().filter(|knob| knob.limit.is_some()).map(knob_in_words));
    parts.join(" · ")
}

fn percent(case: &CheckedCase) -> String {
    match differing_share(case).map(|share| 100.0 * share) {
        Some(percent) if percent < 0.01 => "<0.01 %".into(),
        Some(percent) => format!("{percent:.2} %"),
        None => String::new(),
    }
}

fn knob_in_words(knob: &Knob) -> String {
    let verdict = match knob.met {
        Some(true) => "met",
        Some(false) => "missed",
        None => "not asked",
    };
    format!("{} {}: {verdict} at {}", printable(&knob.option), limit(knob), value(knob))
}

/// The figure with as many digits as tell it from its limit.
pub(super) fn value(knob: &Knob) -> String {
    match knob.value {
        Figure::Number(x) => number(x),
        other => figure("", other),
    }
}

pub(super) fn limit(knob: &Knob) -> String {
    knob.limit.map_or(crate::report::words::NONE.into(), number)
}

/// A whole number as such, others to six places, or as few digits as tell a small one from nothing.
pub(super) fn number(x: f64) -> String {
    match x {
        _ if x.fract() == 0.0 && x.abs() < 1e15 => format!("{x:.0}"),
        _ if x.abs() < 1e-5 => format!("{x:.1e}"),
        _ => format!("{x:.6}").trim_end_matches('0').into(),
    }
}

/// An id as part of an address; the script decodes it. Every byte but letters, digits and a few marks is written as a number.
fn percent_encoded(id: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.~/".contains(&byte);
    id.bytes().map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_in_addresses_are_harmless_and_come_back() {
        assert_eq!(percent_encoded("a/b-1.png"), "a/b-1.png");
        assert_eq!(percent_encoded("\"<é\r\n&=#%"), "%22%3C%C3%A9%0D%0A%26%3D%23%25");
    }

    #[test]
    fn numbers_show_what_they_hold() {
        assert_eq!([0.0, 57_600.0, 0.0125, 1e-9].map(number), ["0", "57600", "0.0125", "1.0e-9"]);
    }
}
