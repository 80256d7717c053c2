//! Figures as Markdown.

use std::fmt::Write as _;

use super::measure::Times;
use super::pictures::{KINDS, Kind};

/// One program's figures.
pub(crate) struct Row {
    name: String,
    pub(crate) times: Vec<(Kind, Times)>,
    pub(crate) peak_bytes: Option<u64>,
    /// Pairs that it called the same though they differ, or the other way round.
    pub(crate) wrong: usize,
}

impl Row {
    pub(crate) fn new(name: &str) -> Self {
        Self { name: name.into(), times: Vec::new(), peak_bytes: None, wrong: 0 }
    }

    fn median_ms(&self, kind: Option<Kind>, of: impl Fn(&Times) -> f64) -> f64 {
        let of_kind = self.times.iter().filter(|(own, _)| kind.is_none_or(|kind| kind == *own));
        median(of_kind.map(|(_, times)| 1e3 * of(times)).collect())
    }
}

pub(crate) fn median(mut samples: Vec<f64>) -> f64 {
    samples.sort_by(f64::total_cmp);
    let middle = samples.len() / 2;
    match samples.len() {
        0 => f64::NAN,
        n if n.is_multiple_of(2) => 0.5 * (samples[middle - 1] + samples[middle]),
        _ => samples[middle],
    }
}

/// A process a pair. The ratio is of wall times over all pairs, to the first row's.
pub(crate) fn one_by_one(rows: &[Row]) -> String {
    let mut text = String::from(
        "| ms a pair | identical | slight | large | all, wall | all, user | peak MiB | wrong | ratio |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    let own = rows.first().map_or(f64::NAN, |row| row.median_ms(None, |times| times.wall_s));
    for row in rows {
        let of_kinds = KINDS.map(|kind| format!("{:.1}", row.median_ms(Some(kind), |times| times.wall_s))).join(" | ");
        let (wall, user) = (row.median_ms(None, |times| times.wall_s), row.median_ms(None, |times| times.user_s));
        let peak = row.peak_bytes.map_or("–".into(), |bytes| format!("{:.0}", bytes as f64 / f64::from(1 << 20)));
        writeln!(text, "| {} | {of_kinds} | {wall:.1} | {user:.1} | {peak} | {} | {:.2} |", row.name, row.wrong, wall / own)
            .expect("a string takes it");
    }
    text
}

/// All pairs on all cores.
pub(crate) fn all_at_once(rows: &[(&str, f64)], pairs: usize) -> String {
    let mut text = format!("| {pairs} pairs | s | ratio |\n|---|--:|--:|\n");
    let own = rows.first().map_or(f64::NAN, |(_, seconds)| *seconds);
    for (name, seconds) in rows {
        writeln!(text, "| {name} | {seconds:.1} | {:.2} |", seconds / own).expect("a string takes it");
    }
    text
}

/// Programs and libraries that compute FLIP.
pub(crate) fn flip(rows: &[(&str, Vec<Times>)]) -> String {
    let mut text = String::from("| FLIP, ms a pair | wall | user |\n|---|--:|--:|\n");
    for (name, times) in rows {
        let of = |of: fn(&Times) -> f64| median(times.iter().map(|times| 1e3 * of(times)).collect());
        let (wall, user) = (of(|times| times.wall_s), of(|times| times.user_s));
        writeln!(text, "| {name} | {wall:.0} | {user:.0} |").expect("a string takes it");
    }
    text
}
