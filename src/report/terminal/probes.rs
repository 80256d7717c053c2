//! What probes found, as a table.

use super::sequence::{name_line, shown};
use super::{Grid, Ink, TABLE_WIDTH};
use crate::metrics::Figure;
use crate::report::words::{printable, wrap};
use crate::suite::{ProbeFigures, SequenceOutcome, SequenceResult};

const HEADINGS: [&str; 16] =
    ["method", "crawl", "max", "1st", "8th", "64th", "end", "in", "step", "0px", "¼", "½", "1.37", "8", "edge", "max"];

const LEGEND: &str = "Still picture: crawl: how much a pixel varies after 32 frames, in 1/255, max: 99.99 % of the pixels less; 1st, 8th, \
    64th: PSNR of that frame after a reset, end: what it settles at, in: frames to within half a dB of that. step: frames until nine \
    tenths of a halving of all light are seen. 0px to 8: sharpness while the picture moves by so many pixels a frame, 1 is the \
    reference's. edge, max: RMS and largest error of where a straight edge is, in pixels, over angles.";

/// Lines of the table and its legend; none if no probe was run.
pub(super) fn push(result: &SequenceResult, ink: &Ink, lines: &mut Vec<String>) {
    let figures = |outcome: &SequenceOutcome| match outcome {
        SequenceOutcome::Measured(figures) if !figures.probes.is_empty() => Some(row(&figures.probes)),
        _ => None,
    };
    let rows = result.methods.iter().filter_map(|method| Some((printable(&method.spec), figures(&method.outcome)?)));
    let rows: Vec<(String, Vec<String>)> = rows.collect();
    if rows.is_empty() {
        return;
    }
    let grid = Grid::new(&HEADINGS, &rows);
    lines.push(String::new());
    lines.extend(grid.heading.iter().map(|line| ink.dim(line)));
    for ((name, _), line) in rows.iter().zip(grid.lines) {
        lines.extend(name_line(name, grid.room));
        lines.push(line);
    }
    lines.push(String::new());
    lines.extend(wrap(LEGEND, TABLE_WIDTH).iter().map(|line| ink.dim(line)));
}

fn row(probes: &ProbeFigures) -> Vec<String> {
    let digits = |figure: Figure, digits: usize| shown(figure, |x| format!("{x:.digits$}"));
    let steps = |figure: Option<Figure>| shown(figure.unwrap_or(Figure::NotApplicable), |x| format!("{:.2}", 255.0 * x));
    let or_none = |figure: Option<Figure>| figure.unwrap_or(Figure::NotApplicable);
    let convergence = probes.convergence.as_ref();
    let after = |frames: usize| digits(or_none(convergence.and_then(|c| c.psnr.get(frames - 1).copied())), 1);
    let count = |figure: Option<Figure>| match figure {
        Some(Figure::Infinite) => "never".into(),
        figure => digits(or_none(figure), 0),
    };
    let sharpness = |k: usize| digits(or_none(probes.sharpness.as_ref().and_then(|s| s.get(k)).map(|s| s.ratio)), 2);
    let position = probes.position.as_ref();
    let mut cells = vec![
        steps(probes.crawl.as_ref().map(|crawl| crawl.mean)),
        steps(probes.crawl.as_ref().map(|crawl| crawl.p9999)),
        after(1),
        after(8),
        after(64),
        digits(or_none(convergence.map(|c| c.settled)), 1),
        count(convergence.map(|c| c.frames)),
        count(probes.response.as_ref().map(|r| r.frames)),
    ];
    cells.extend((0..5).map(sharpness));
    cells.push(digits(or_none(position.map(|p| p.rms_px)), 3));
    cells.push(digits(or_none(position.map(|p| p.max_px)), 3));
    cells
}
