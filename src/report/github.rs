//! Results of `dejag check` for GitHub: annotations of a workflow's step, and the summary of its job.

use std::collections::BTreeSet;

use super::pair_words::{counted, missed, sentences, what_would_pass};
use super::words::{NONE, figure, printable, shorten, stamp};
use crate::suite::{CheckResults, CheckedCase, DiffOutcome, DiffPair, Environment};

/// Annotations that GitHub shows of each kind in a step; it drops the others without a word.
const ANNOTATIONS: usize = 10;

/// The longest title that GitHub takes, in characters.
const TITLE: usize = 255;

/// Characters of an annotation's text. GitHub takes 64 KiB.
const TEXT: usize = 4_000;

/// Bytes of a summary. GitHub refuses one of more than 1 MiB a step; what else the step says needs some room, too.
const SUMMARY_BYTES: usize = 1_000_000;

/// Characters of a cell in the summary's table, and of a line above it.
const CELL: usize = 200;

/// Workflow commands, a line each, for the step's output: an error for each picture that is not the same, of more than nine
/// the first nine and how many more there are; a notice with what probably caused them; a warning of goldens that no case uses.
/// `manifest` is the file that they are attached to, relative to the repository.
#[must_use]
pub fn annotations(results: &CheckResults, manifest: &str) -> Vec<String> {
    let command = |kind: &str, title: &str, text: &str| {
        let (file, title) = (property(manifest), property(&shorten(&printable(title), TITLE)));
        format!("::{kind} file={file},title={title}::{}", data(&shorten(text, TEXT)))
    };
    let wrong: Vec<&CheckedCase> = not_the_same(results).collect();
    let shown = wrong.len().min(ANNOTATIONS - 1);
    let mut lines: Vec<String> = wrong[..shown]
        .iter()
        .map(|case| command("error", &format!("{}: {}", case.pair.outcome.as_str(), case.id), &text(&case.pair)))
        .collect();
    if wrong.len() > shown {
        lines.push(command("error", "dejag check", &format!("and {} more", wrong.len() - shown)));
    }
    let causes: BTreeSet<&str> = wrong.iter().flat_map(|case| &case.likely_causes).map(String::as_str).collect();
    if !causes.is_empty() {
        lines.push(command("notice", "likely causes", &lines_of(causes)));
    }
    if !results.unused_goldens.is_empty() {
        let title = format!("goldens that no case uses: {}", results.unused_goldens.len());
        lines.push(command("warning", &title, &lines_of(results.unused_goldens.iter().map(String::as_str))));
    }
    lines
}

fn not_the_same(results: &CheckResults) -> impl Iterator<Item = &CheckedCase> {
    results.cases.iter().filter(|case| case.pair.outcome != DiffOutcome::Same)
}

/// What is known of a pair, a line for each sentence; its outcome where that is all.
fn text(pair: &DiffPair) -> String {
    let said = sentences(pair);
    if said.is_empty() { pair.outcome.as_str().into() } else { lines_of(said.iter().map(String::as_str)) }
}

fn lines_of<'a>(texts: impl IntoIterator<Item = &'a str>) -> String {
    texts.into_iter().map(printable).collect::<Vec<_>>().join("\n")
}

/// What stands behind the second `::` of a command.
fn data(text: &str) -> String {
    // The escape character first, or it would escape the escapes.
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a command's property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// Markdown for the file that `GITHUB_STEP_SUMMARY` names: counts, environment, and a table of what is not the same. It stays below
/// 1 MiB, which is all that GitHub takes, and says how many rows were left out.
#[must_use]
pub fn job_summary(results: &CheckResults) -> String {
    let mut page = format!("### dejag check: {}\n\n{}\n", counted(&results.counts), environment(&results.environment));
    let wrong: Vec<&CheckedCase> = not_the_same(results).collect();
    if wrong.is_empty() {
        return page;
    }
    page.push_str("\n| case | outcome | differing pixels | FLIP | missed | each would pass alone |\n|---|---|--:|--:|---|---|\n");
    let mut left_out = wrong.len();
    for row in wrong.into_iter().map(row) {
        if page.len() + row.len() > SUMMARY_BYTES {
            break;
        }
        page.push_str(&row);
        left_out -= 1;
    }
    if left_out > 0 {
        page.push_str(&format!("\n{left_out} rows are left out; the report has all.\n"));
    }
    page
}

fn environment(environment: &Environment) -> String {
    let Environment { key, platform, stamp: drawn_by } = environment;
    let drawn_by = drawn_by.as_ref().map(|drawn_by| format!(" · {}", literal(&stamp(drawn_by)))).unwrap_or_default();
    format!("{} · {}{drawn_by}", literal(key), literal(platform))
}

fn row(case: &CheckedCase) -> String {
    let CheckedCase { id, pair, .. } = case;
    let pixels = pair.pixels.as_ref().map_or(NONE.into(), |pixels| pixels.differing.to_string());
    let flip = pair.knobs.iter().find(|knob| knob.option == "--max-flip");
    let flip = flip.map_or(NONE.into(), |knob| figure("flip", knob.value));
    let mut missed = missed(pair);
    if missed.is_empty() {
        // Sizes, spaces or an error.
        missed.extend(pair.why.clone());
    }
    let [id, missed, passes] = [id, &missed.join("; "), &what_would_pass(pair).join("; ")].map(|text| literal(text));
    format!("| {id} | {} | {pixels} | {flip} | {missed} | {passes} |\n", pair.outcome.as_str())
}

/// Text that neither Markdown nor HTML takes for its own: every sign but the plainest is a character reference. Shortened to
/// [`CELL`] characters.
fn literal(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || !c.is_ascii() || matches!(c, ' ' | '/' | '-');
    let escaped = |c: char| if plain(c) { c.to_string() } else { format!("&#{};", u32::from(c)) };
    shorten(&printable(text), CELL).chars().map(escaped).collect()
}
