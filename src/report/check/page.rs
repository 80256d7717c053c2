//! The page as a whole: what the run came to, the controls, the cases.

use std::cmp::Ordering;

use maud::{DOCTYPE, Markup, html};

use super::case::{self, Shown};
use super::files::CaseFiles;
use super::history::History;
use super::{is_same, viewer};
use crate::report::head::head_with;
use crate::report::words::{self, printable};
use crate::suite::{CheckResults, CheckedCase, DiffOutcome};

const STYLE: &str = include_str!("check.css");

/// Nothing from elsewhere, and no script but those beside the page: a name that slipped through could still do nothing.
/// Pages from disk have no origin of their own, so `file:` stands beside `'self'`.
const POLICY: &str = "default-src 'none'; img-src 'self' file:; script-src 'self' file:; style-src 'unsafe-inline'; \
     base-uri 'none'; form-action 'none'";

/// The whole page. It loads nothing but what lies beside it.
pub(super) fn page(results: &CheckResults, history: &[CheckResults], files: &[CaseFiles]) -> String {
    let history = History::of(history);
    let mut cases: Vec<Shown<'_>> = results.cases.iter().zip(files).zip(1..).map(case::shown).collect();
    cases.sort_by(|a, b| urgency(a.case, b.case));
    let policy = html! { meta http-equiv="Content-Security-Policy" content=(POLICY); };
    html! {
        (DOCTYPE)
        html lang="en" {
            (head_with(&format!("check, {}", in_words(results)), STYLE, &policy))
            body {
                a.skip href="#cases" { "Skip to the cases" }
                header {
                    h1 { "dejag" span.light { " check" } }
                    p.extent { (in_words(results)) }
                    p.stamp { (environment(results)) }
                }
                main {
                    (controls(results))
                    ol #cases role="list" aria-label="Cases" tabindex="-1" {
                        @for shown in &cases { (case::row(shown, &history)) }
                    }
                    (unused(results))
                    (again(results))
                }
                (viewer::dialogs())
                script src="check.js" {}
            }
        }
    }
    .into_string()
}

/// What has to be looked at first, and of that the worst: those without figures, then by the share of differing pixels.
fn urgency(a: &CheckedCase, b: &CheckedCase) -> Ordering {
    let share = |case| case::differing_share(case).unwrap_or(f64::INFINITY);
    is_same(a).cmp(&is_same(b)).then(share(b).total_cmp(&share(a)))
}

fn in_words(results: &CheckResults) -> String {
    let total = results.cases.len();
    let counts = results.counts.all().into_iter().filter(|(_, count)| *count > 0);
    let counts: Vec<String> = counts.map(|(outcome, count)| format!("{count} {}", outcome.as_str())).collect();
    format!("{total} {}: {}", if total == 1 { "case" } else { "cases" }, counts.join(", "))
}

fn environment(results: &CheckResults) -> Markup {
    let environment = &results.environment;
    html! {
        "Environment " bdi { (printable(&environment.key)) } " on " (printable(&environment.platform))
        @if let Some(stamp) = &environment.stamp { " · " (words::stamp(stamp)) }
        @else { " · nothing drawn · dejag " (printable(&results.dejag)) }
        @if let Some(shard) = &results.shard { " · shard " (shard.index) " of " (shard.count) }
    }
}

/// They need the script, and are hidden where there is none.
fn controls(results: &CheckResults) -> Markup {
    let total = results.cases.len() as u64;
    let outcomes = results.counts.all().into_iter().filter(|(_, count)| *count > 0);
    html! {
        div #controls.toolbar role="search" {
            div.group role="group" aria-label="Show by outcome" {
                (filter("all", "all", total))
                @if results.counts.same > 0 && results.counts.same < total { (filter("not-same", "not same", total - results.counts.same)) }
                @for (outcome, count) in outcomes { (filter(outcome.as_str(), outcome.as_str(), count)) }
            }
            input #find type="search" placeholder="Find by id" aria-label="Find by id" autocomplete="off" spellcheck="false";
            label {
                "Order "
                select #sort {
                    option value="worst" { "worst first" }
                    option value="flip" { "highest FLIP first" }
                    option value="manifest" { "as in the manifest" }
                }
            }
            output #shown {}
            button #keys type="button" aria-haspopup="dialog" { "Keys " kbd { "?" } }
        }
        noscript { p.note { "Scripts are off: every case shows its figures in place, and there is nothing to open." } }
    }
}

fn filter(value: &str, word: &str, count: u64) -> Markup {
    html! {
        button type="button" data-show=(value) aria-pressed=(value == "all") { (word) " " span.count { (count) } }
    }
}

fn unused(results: &CheckResults) -> Markup {
    let goldens = &results.unused_goldens;
    html! {
        @if !goldens.is_empty() {
            section #unused {
                h2 { "Goldens that no case uses" }
                ul { @for golden in goldens { li { code { (printable(golden)) } } } }
            }
        }
    }
}

fn again(results: &CheckResults) -> Markup {
    html! {
        section #again {
            h2 { "Run it again" }
            pre tabindex="0" { code { (printable(&words::shell_line("dejag", &results.command))) } }
            p { "All figures: " a href="check.json" { "check.json" } ". BLAKE3 of the manifest: " code { (printable(&results.manifest)) } "." }
        }
    }
}

/// The class of an outcome's word: what fails, what only asks for attention, what is well.
pub(super) fn outcome_class(outcome: DiffOutcome) -> &'static str {
    match outcome {
        DiffOutcome::Same => "well",
        DiffOutcome::Missing | DiffOutcome::New | DiffOutcome::Uncounted => "unsure",
        DiffOutcome::Different | DiffOutcome::Size | DiffOutcome::Profile | DiffOutcome::Unreadable | DiffOutcome::Failed => {
            "bad"
        }
    }
}
