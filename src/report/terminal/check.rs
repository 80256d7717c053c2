//! What came of checking cases, for a terminal.

use super::Ink;
use super::diff::paragraph;
use crate::report::pair_words::{counted, sentences};
use crate::report::words::printable;
use crate::suite::{CheckResults, CheckedCase, DiffOutcome};

/// A paragraph for each case that is not the same, or for each with `all`. Lines keep to [`super::TABLE_WIDTH`] characters where
/// no name is longer. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn check_text(results: &CheckResults, all: bool, color: bool) -> String {
    let ink = Ink { color };
    let shown = |case: &&CheckedCase| all || case.pair.outcome != DiffOutcome::Same;
    let lines = results.cases.iter().filter(shown).flat_map(|case| of_case(case, &ink));
    lines.map(|line| line + "\n").collect()
}

/// How many cases came out how, in a line.
#[must_use]
pub fn check_summary(results: &CheckResults) -> String {
    let mut words = vec![counted(&results.counts)];
    if let Some(shard) = &results.shard {
        words.push(format!("shard {}/{}: {} of {} entries", shard.index, shard.count, shard.own.len(), shard.dealt.len()));
    }
    match results.unused_goldens.len() {
        0 => {}
        1 => words.push(format!("1 golden that no case uses: {}", printable(&results.unused_goldens[0]))),
        n => words.push(format!("{n} goldens that no case uses, the first is {}", printable(&results.unused_goldens[0]))),
    }
    words.join(", ")
}

fn of_case(case: &CheckedCase, ink: &Ink) -> Vec<String> {
    let mut said = sentences(&case.pair);
    // Without a golden there is no difference that a cause could explain.
    let causes = case.likely_causes.iter().filter(|_| case.pair.outcome != DiffOutcome::New);
    said.extend(causes.map(|cause| format!("likely cause: {cause}")));
    paragraph(&case.id, case.pair.outcome, &said, ink)
}
