//! What came of checking cases, for a terminal.

use super::diff::{INDENT, counted, paragraph};
use super::{Ink, TABLE_WIDTH};
use crate::report::words::{printable, wrap};
use crate::suite::{CheckResults, CheckedCase, DiffOutcome, DiffPair};

/// A paragraph for each case that is not the same, or for each with `all`. Lines keep to [`TABLE_WIDTH`] characters where no name is
/// longer. With `color`, ANSI escapes mark what matters.
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
    let mut words = counted(&results.counts);
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
    let pair = DiffPair { path: Some(case.id.clone()), ..case.pair.clone() };
    let mut lines = paragraph(&pair, ink);
    let causes = case.likely_causes.iter().filter(|_| case.pair.outcome != DiffOutcome::New);
    for cause in causes {
        let text = printable(&format!("likely cause: {cause}"));
        lines.extend(wrap(&text, TABLE_WIDTH - INDENT).into_iter().map(|line| " ".repeat(INDENT) + &line));
    }
    lines
}
