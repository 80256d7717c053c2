//! A sequence's results as tables.

use super::{Grid, Ink, TABLE_WIDTH, probes};
use crate::metrics::Figure;
use crate::metrics::temporal::MEASURES;
use crate::report::words::{self, NONE, printable, shorten, wrap};
use crate::suite::{SequenceFigure, SequenceFigures, SequenceMethod, SequenceOutcome, SequenceResults};

const HEADINGS: [&str; 14] =
    ["method", "PSNR", "worst", "FLIP", "tPSNR", "flick1", "2", "4", "p99", "ghost", "trail", "lines", "±", "energy"];

const LEGEND: &str = "PSNR: dB of display values, squared errors pooled over all frames; worst: that of the worst frame. FLIP: mean over \
    frames. tPSNR: of what changes in place from frame to frame. flick1, 2, 4: how much more than the reference's the surfaces \
    change over so many frames, in 1/255, 0 is right; p99: the same of what 99 % of the pixels do not exceed, over one frame. \
    ghost: share that is left of a thing where it was 4 to 8 frames ago; trail: for how many frames 1/255 is left. lines: share of \
    the reference's thin lines that are there, ±: its standard deviation over the frames. energy: light over the reference's.";

/// A line for each method. No line is longer than [`TABLE_WIDTH`] characters; a method whose name does not fit stands on a line of its
/// own, above its figures. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn sequence_table(results: &SequenceResults, color: bool) -> String {
    let ink = Ink { color };
    let mut lines = Vec::new();
    title(results, &ink, &mut lines);
    let measured: Vec<(String, Vec<String>)> = results.result.methods.iter().filter_map(row).collect();
    let grid = Grid::new(&HEADINGS, &measured);
    lines.extend(grid.heading.iter().map(|line| ink.dim(line)));
    let mut laid_out = grid.lines.into_iter();
    for method in &results.result.methods {
        push_method(method, grid.room, &mut laid_out, &ink, &mut lines);
    }
    lines.push(String::new());
    lines.extend(wrap(LEGEND, TABLE_WIDTH).iter().map(|line| ink.dim(line)));
    probes::push(&results.result, &ink, &mut lines);
    lines.extend(wrap(&words::stamp(&results.stamp), TABLE_WIDTH).iter().map(|line| ink.dim(line)));
    lines.join("\n") + "\n"
}

fn title(results: &SequenceResults, ink: &Ink, lines: &mut Vec<String>) {
    let result = &results.result;
    let [width, height] = result.size;
    let name = shorten(&printable(&result.scene), TABLE_WIDTH - 60);
    let indices = match (result.frames.first(), result.frames.last()) {
        (Some(first), Some(last)) => format!(" ({} to {})", first.index, last.index),
        _ => String::new(),
    };
    lines.push(ink.bold(&format!("{name} · {width}x{height}, {} frames{indices}", result.frames.len())));
    lines.extend(wrap(&printable(&result.about), TABLE_WIDTH));
    let mut reference = format!("reference {}", printable(&result.reference.spec));
    if let Some(floor) = &result.reference.noise_floor {
        reference += &format!(" · {}", words::noise_floor(floor));
    }
    lines.extend(wrap(&reference, TABLE_WIDTH).iter().map(|line| ink.dim(line)));
}

fn push_method(
    method: &SequenceMethod,
    room: usize,
    laid_out: &mut impl Iterator<Item = String>,
    ink: &Ink,
    lines: &mut Vec<String>,
) {
    let name = printable(&method.spec);
    match &method.outcome {
        SequenceOutcome::Measured(figures) => {
            lines.extend(name_line(&name, room));
            lines.extend(laid_out.next());
            if let Some(found) = figures.non_finite {
                let note = format!(
                    "    {} pixels in {} frames are NaN or infinite, first in frame {}",
                    found.pixels, found.frames, found.first
                );
                lines.push(ink.yellow(&note));
            }
        }
        SequenceOutcome::Failed { error } => {
            lines.push(ink.red(&shorten(&format!("✗ {name}"), TABLE_WIDTH)));
            let text = format!("failed: {}", printable(error));
            lines.extend(wrap(&text, TABLE_WIDTH - 4).iter().map(|line| ink.red(&format!("    {line}"))));
        }
    }
}

fn row(method: &SequenceMethod) -> Option<(String, Vec<String>)> {
    let SequenceOutcome::Measured(figures) = &method.outcome else {
        return None;
    };
    let found = |name: &str| figure(figures, name);
    let overall = |name: &str| found(name).map_or(Figure::NotApplicable, |figure| figure.overall);
    let worst = found("psnr").and_then(|figure| figure.worst).map_or(Figure::NotApplicable, |worst| worst.value);
    let steps = |name: &str| shown(overall(name), |x| format!("{:+.2}", 255.0 * x));
    let digits = |figure: Figure, digits: usize| shown(figure, |x| format!("{x:.digits$}"));
    let cells = vec![
        digits(overall("psnr"), 2),
        digits(worst, 2),
        digits(overall("flip"), 4),
        digits(overall("tpsnr"), 2),
        steps("flicker-1"),
        steps("flicker-2"),
        steps("flicker-4"),
        steps("flicker-1-p99"),
        digits(overall("ghost"), 4),
        shown_trail(figures.ghost.trail),
        digits(overall("continuity"), 3),
        digits(overall("continuity-sd"), 3),
        digits(overall("energy"), 4),
    ];
    Some((printable(&method.spec), cells))
}

/// A measure's verdict by its short name; none if the results do not have it in the version known here.
fn figure<'f>(figures: &'f SequenceFigures, name: &str) -> Option<&'f SequenceFigure> {
    figures.figure(MEASURES.iter().find(|measure| measure.name == name)?.id)
}

/// A line of its own for a name that the grid has no room for.
pub(super) fn name_line(name: &str, room: usize) -> Option<String> {
    (name.chars().count() > room).then(|| shorten(name, TABLE_WIDTH))
}

pub(super) fn shown(figure: Figure, number: impl Fn(f64) -> String) -> String {
    match figure {
        Figure::Number(x) => number(x),
        Figure::Infinite => "inf".into(),
        Figure::NonFinite => "NaN".into(),
        Figure::NotApplicable => NONE.into(),
    }
}

fn shown_trail(trail: Figure) -> String {
    match trail {
        Figure::Infinite => ">8".into(),
        other => shown(other, |x| format!("{x:.0}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn every_line_fits_whatever_the_names() {
        let long = "taa:jitter=halton,length=16,clip=variance,gamma=1.25,history=catmull-rom,sharpen=0.2,".repeat(3);
        let mut results = sample::sequence();
        results.result.methods[0].spec = long.clone();
        results.result.reference.spec = long.clone();
        results.result.scene = long.clone();
        results.result.methods[1].outcome = SequenceOutcome::Failed { error: format!("it needs {long}") };
        let text = sequence_table(&results, false);
        for line in text.lines() {
            assert!(line.chars().count() <= TABLE_WIDTH, "{} characters: {line}", line.chars().count());
        }
        assert!(!text.contains('\u{1b}') && text.contains("failed: it needs"), "{text}");
    }

    #[test]
    fn figures_stand_in_both_tables() {
        let text = sequence_table(&sample::sequence(), false);
        let lines: Vec<&str> = text.lines().filter(|line| line.starts_with("none")).collect();
        assert_eq!(lines.len(), 2, "{text}");
        assert!(lines[0].contains("24.10") && lines[0].contains("+1.02") && lines[0].contains(">8"), "{text}");
        assert!(lines[1].contains("never") && lines[1].contains("0.51"), "{text}");
        assert!(text.contains("6 pixels in 2 frames are NaN or infinite, first in frame 3"), "{text}");
    }

    #[test]
    fn colour_only_adds_escapes() {
        let results = sample::sequence();
        let mut plain = sequence_table(&results, true);
        for code in [0, 1, 2, 31, 32, 33] {
            plain = plain.replace(&format!("\u{1b}[{code}m"), "");
        }
        assert_eq!(plain, sequence_table(&results, false));
    }
}
