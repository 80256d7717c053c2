//! Figures of point sets as tables.

use super::{Grid, Ink, TABLE_WIDTH};
use crate::report::words::{NONE, printable, shorten, three_digits, wrap};
use crate::suite::{IntegralRow, PatternRow, SpectrumRow};

const TABLE_LEGEND: &str = "star: largest deviation of a box's share of the points from its area, over boxes at the origin; L2: its root mean \
    square form; T: root mean square over all rectangles (Stroud), mean over the trials, rms: root of its mean square, SE: standard \
    error of T; ±: standard deviations. All of these times 1000, var T times a million. near, mean: distances to \
    nearest neighbours on the torus, smallest and mean, times 1000.";

const SPECTRUM_LEGEND: &str = "Power is 1 for white noise, frequencies are relative to sqrt(n). <1/4, <1/2: mean power below; max: largest power \
    below 1/2; peak, at: largest radial mean; onset: where it first exceeds 1/2; aniso: radial variance over squared mean in dB, and \
    its floor for so many sets; axis: mean power on both axes.";

const INTEGRAL_LEGEND: &str = "Root mean square errors of pixel means times 1000, by samples a pixel. slope: of a straight line in logarithms of \
    both; random sets have -0.5.";

/// A line a pattern. No line is longer than [`TABLE_WIDTH`] characters. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn pattern_table(rows: &[PatternRow], color: bool) -> String {
    let (torus, timing) = (rows.iter().any(|r| r.stroud_torus.is_some()), rows.iter().any(|r| r.timing.is_some()));
    let mut headings = vec!["pattern", "sets", "star", "±", "L2", "±", "T", "±", "SE", "rms", "var T", "near", "mean"];
    headings.extend(torus.then_some("torus T"));
    headings.extend(timing.then_some("ms"));
    let cells = |row: &PatternRow| {
        let thousandths = |x: f64| three_digits_of(1e3 * x);
        let of_nearest = |pick: fn(&crate::suite::NearestFigures) -> f64| {
            row.nearest_torus.as_ref().map_or(NONE.into(), |nearest| format!("{:.2}", 1e3 * pick(nearest)))
        };
        let spread = |x: f64| if row.trials > 1 { thousandths(x) } else { NONE.into() };
        let mut cells = vec![row.trials.to_string(), thousandths(row.star), spread(row.star_sd), thousandths(row.l2)];
        cells.extend([spread(row.l2_sd), thousandths(row.stroud), spread(row.stroud_sd), spread(row.stroud_se)]);
        cells.extend([thousandths(row.stroud_rms), spread(1e3 * row.stroud_variance)]);
        cells.extend([of_nearest(|nearest| nearest.smallest), of_nearest(|nearest| nearest.mean)]);
        cells.extend(torus.then(|| row.stroud_torus.map_or(NONE.into(), thousandths)));
        cells.extend(timing.then(|| row.timing.map_or(NONE.into(), |timing| three_digits(timing.generate_ms))));
        (printable(&row.pattern), cells)
    };
    let mut legend = String::new();
    if let Some(first) = rows.first() {
        legend = format!("{} points. ", first.n);
        legend += &first.lattice.map_or(String::new(), |k| format!("T over rectangles with corners on a lattice of {k} steps. "));
    }
    laid_out(&headings, &rows.iter().map(cells).collect::<Vec<_>>(), &(legend + TABLE_LEGEND), color)
}

/// A line a pattern, as [`pattern_table`].
#[must_use]
pub fn spectrum_table(rows: &[SpectrumRow], color: bool) -> String {
    let headings = ["pattern", "n", "sets", "<1/4", "<1/2", "max", "peak", "at", "onset", "aniso", "floor", "axis"];
    let cells = |row: &SpectrumRow| {
        let optional = |x: Option<f64>, digits: usize| x.map_or(NONE.into(), |x| format!("{x:.digits$}"));
        let mut cells = vec![row.n.to_string(), row.trials.to_string()];
        cells.extend([row.low_quarter, row.low_half].map(|power| format!("{power:.4}")));
        cells.extend([row.low_largest, row.peak, row.peak_frequency].map(|figure| format!("{figure:.2}")));
        cells.extend([optional(row.onset_frequency, 2), optional(row.anisotropy_db, 1)]);
        cells.extend([format!("{:.1}", row.anisotropy_floor_db), format!("{:.3}", row.axis)]);
        (printable(&row.pattern), cells)
    };
    laid_out(&headings, &rows.iter().map(cells).collect::<Vec<_>>(), SPECTRUM_LEGEND, color)
}

/// A line for each pattern and part, a column for each number of samples of the first row, as [`pattern_table`].
#[must_use]
pub fn integral_table(rows: &[IntegralRow], color: bool) -> String {
    let counts = rows.first().map_or(&[][..], |row| &row.errors);
    let counts: Vec<String> = counts.iter().map(|error| error.spp.to_string()).collect();
    let mut headings = vec!["pattern", "part", "sets"];
    headings.extend(counts.iter().map(String::as_str));
    headings.push("slope");
    let cells = |row: &IntegralRow| {
        let mut cells = vec![row.part.clone(), row.sets.clone()];
        cells.extend(row.errors.iter().map(|error| three_digits_of(1e3 * error.rms)));
        cells.push(row.slope.map_or(NONE.into(), |slope| format!("{slope:.2}")));
        (printable(&row.pattern), cells)
    };
    let what = rows.first().map_or(String::new(), |row| format!("{}. ", printable(&row.test)));
    laid_out(&headings, &rows.iter().map(cells).collect::<Vec<_>>(), &(what + INTEGRAL_LEGEND), color)
}

/// Three decimals, fewer for large values: columns of similar values line up.
fn three_digits_of(x: f64) -> String {
    let digits = match x.abs() {
        x if x < 10.0 => 3,
        x if x < 100.0 => 2,
        _ => 1,
    };
    format!("{x:.digits$}")
}

fn laid_out(headings: &[&str], rows: &[(String, Vec<String>)], legend: &str, color: bool) -> String {
    let ink = Ink { color };
    let grid = Grid::new(headings, rows);
    let mut lines: Vec<String> = grid.heading.iter().map(|line| ink.dim(line)).collect();
    for ((name, _), line) in rows.iter().zip(grid.lines) {
        lines.extend((name.chars().count() > grid.room).then(|| shorten(name, TABLE_WIDTH)));
        lines.push(line);
    }
    lines.push(String::new());
    lines.extend(wrap(legend, TABLE_WIDTH).iter().map(|line| ink.dim(line)));
    lines.join("\n") + "\n"
}
