//! What came of comparing pictures, for a terminal.

use super::{Ink, TABLE_WIDTH};
use crate::report::pair_words::{counted, name, sentences};
use crate::report::words::{printable, wrap};
use crate::suite::{DiffOutcome, DiffPair, DiffResults};

/// Below the line of its pair.
const INDENT: usize = 4;

/// A paragraph for each pair; of several pairs, those that are the same only with `all`. Lines keep to [`TABLE_WIDTH`] characters
/// where no path is longer. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn diff_text(results: &DiffResults, all: bool, color: bool) -> String {
    let ink = Ink { color };
    let shown = |pair: &&DiffPair| all || results.pairs.len() == 1 || pair.outcome != DiffOutcome::Same;
    let lines = results.pairs.iter().filter(shown).flat_map(|pair| of_pair(pair, &ink));
    lines.map(|line| line + "\n").collect()
}

/// How many pairs came out how, in a line.
#[must_use]
pub fn diff_summary(results: &DiffResults) -> String {
    let mut words = vec![counted(&results.counts)];
    match results.skipped {
        0 => {}
        1 => words.push("1 other file skipped".into()),
        n => words.push(format!("{n} other files skipped")),
    }
    words.join(", ")
}

fn of_pair(pair: &DiffPair, ink: &Ink) -> Vec<String> {
    paragraph(name(pair), pair.outcome, &sentences(pair), ink)
}

/// Outcome and name, and below them what is known of it.
pub(super) fn paragraph(name: &str, outcome: DiffOutcome, sentences: &[String], ink: &Ink) -> Vec<String> {
    let word = outcome.as_str();
    let marked = match outcome {
        DiffOutcome::Same => ink.green(word),
        DiffOutcome::Different | DiffOutcome::Size | DiffOutcome::Profile | DiffOutcome::Unreadable | DiffOutcome::Failed => {
            ink.red(word)
        }
        DiffOutcome::Missing | DiffOutcome::New | DiffOutcome::Uncounted => ink.yellow(word),
    };
    let gap = " ".repeat(10 - word.len().min(9));
    let mut lines = vec![format!("{marked}{gap}{}", printable(name))];
    for sentence in sentences {
        let wrapped = wrap(&printable(sentence), TABLE_WIDTH - INDENT);
        lines.extend(wrapped.into_iter().map(|line| " ".repeat(INDENT) + &line));
    }
    lines
}
