//! What a sequence is summed up by.

use super::ledger::FrameRow;
use super::{Continuity, GhostSums, SETTLED_AGES};
use crate::metrics::{Better, Figure};

/// One figure of a sequence.
#[derive(Debug)]
pub struct Measure {
    /// Short name.
    pub name: &'static str,
    /// Name and version as results carry them. Figures of different ids must not be compared.
    pub id: &'static str,
    /// What it measures, in a line.
    pub summary: &'static str,
    /// The figure's unit; empty for a bare number.
    pub unit: &'static str,
    /// Which figures are good.
    pub better: Better,
    /// One frame's; none for what only a sequence has.
    pub(super) frame: Option<fn(&FrameRow) -> Figure>,
    /// All frames'.
    pub(super) overall: fn(&[FrameRow]) -> Figure,
}

impl PartialEq for Measure {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// Flicker at one gap: mean and 99th percentile.
macro_rules! flicker {
    ($gap:literal) => {
        [
            Measure {
                name: concat!("flicker-", $gap),
                id: concat!("flicker-", $gap, "/1"),
                summary: concat!(
                    "mean change of surfaces since frame n - ",
                    $gap,
                    " in display values, less the reference's; mean over frames"
                ),
                unit: "",
                better: Better::NearZero,
                frame: Some(|row| excess(row, $gap)),
                overall: |rows| mean(rows, |row| excess(row, $gap)),
            },
            Measure {
                name: concat!("flicker-", $gap, "-p99"),
                id: concat!("flicker-", $gap, "-p99/1"),
                summary: concat!("the same of the change that 99 % of the pixels since frame n - ", $gap, " do not exceed"),
                unit: "",
                better: Better::NearZero,
                frame: Some(|row| excess_p99(row, $gap)),
                overall: |rows| mean(rows, |row| excess_p99(row, $gap)),
            },
        ]
    };
}

const FLICKER: [[Measure; 2]; super::GAPS] = [flicker!(1), flicker!(2), flicker!(3), flicker!(4)];

/// All measures, in the order in which results list them.
pub const MEASURES: &[Measure] = &{
    let [[f1, p1], [f2, p2], [f3, p3], [f4, p4]] = FLICKER;
    [
        Measure {
            name: "psnr",
            id: "sequence-psnr/1",
            summary: "PSNR of display values, peak 1; squared errors pooled over all frames",
            unit: "dB",
            better: Better::Higher,
            frame: Some(|row| decibels(row.square)),
            overall: |rows| decibels_of_mean(rows.iter().map(|row| row.square)),
        },
        Measure {
            name: "flip",
            id: "sequence-flip/1.7@67.0206",
            summary: "mean FLIP error, 67.0206 pixels a degree; mean over frames",
            unit: "",
            better: Better::Lower,
            frame: Some(|row| row.flip),
            overall: |rows| mean(rows, |row| row.flip),
        },
        Measure {
            name: "tpsnr",
            id: "tpsnr/1",
            summary: "PSNR of the difference to the frame before, in place; squared errors pooled over all frames",
            unit: "dB",
            better: Better::Higher,
            frame: Some(|row| row.step_square.map_or(Figure::NotApplicable, decibels)),
            overall: |rows| decibels_of_mean(rows.iter().filter_map(|row| row.step_square)),
        },
        f1,
        p1,
        f2,
        p2,
        f3,
        p3,
        f4,
        p4,
        Measure {
            name: "if-ssim",
            id: "if-ssim/1",
            summary: "SSIM with the frame before brought to its place, less the reference's; mean over frames",
            unit: "",
            better: Better::NearZero,
            frame: Some(|row| number(row.similarity)),
            overall: |rows| mean(rows, |row| number(row.similarity)),
        },
        Measure {
            name: "ghost",
            id: "ghost-4-to-8/1",
            summary: "what is left of a thing where it was 4 to 8 frames ago, as a share of its contrast",
            unit: "",
            better: Better::Lower,
            frame: Some(|row| row.ghost.left(SETTLED_AGES)),
            overall: |rows| {
                let mut all = GhostSums::default();
                rows.iter().for_each(|row| all.add(&row.ghost));
                all.left(SETTLED_AGES)
            },
        },
        Measure {
            name: "continuity",
            id: "continuity/1",
            summary: "share of the reference's thin lines that have at least half of their contrast; mean over frames",
            unit: "",
            better: Better::Higher,
            frame: Some(continuity),
            overall: |rows| mean(rows, continuity),
        },
        Measure {
            name: "continuity-sd",
            id: "continuity-sd/1",
            summary: "standard deviation of that share over the frames",
            unit: "",
            better: Better::Lower,
            frame: None,
            overall: |rows| spread(rows, continuity),
        },
        Measure {
            name: "energy",
            id: "sequence-energy/1",
            summary: "sum of exposed linear values (decoded display values for methods that have no others) over the reference's",
            unit: "",
            better: Better::NearOne,
            frame: Some(|row| ratio(row.energy)),
            overall: |rows| ratio(rows.iter().fold([0.0; 2], |sum, row| [sum[0] + row.energy[0], sum[1] + row.energy[1]])),
        },
    ]
};

fn number(value: Option<f64>) -> Figure {
    value.map_or(Figure::NotApplicable, Figure::from)
}

fn excess(row: &FrameRow, gap: usize) -> Figure {
    number(row.excess[gap - 1].map(|excess| excess.mean))
}

fn excess_p99(row: &FrameRow, gap: usize) -> Figure {
    number(row.excess[gap - 1].map(|excess| excess.p99))
}

fn continuity(row: &FrameRow) -> Figure {
    number(row.continuity.map(Continuity::share))
}

fn decibels(mean_square: f64) -> Figure {
    Figure::from(-10.0 * mean_square.log10())
}

fn decibels_of_mean(squares: impl Iterator<Item = f64>) -> Figure {
    let (sum, count) = squares.fold((0.0, 0u32), |(sum, count), square| (sum + square, count + 1));
    if count == 0 { Figure::NotApplicable } else { decibels(sum / f64::from(count)) }
}

/// Two black pictures have ratio 1.
fn ratio([test, reference]: [f64; 2]) -> Figure {
    if reference == 0.0 && test == 0.0 { Figure::Number(1.0) } else { Figure::from(test / reference) }
}

/// Over the frames that have a figure; no number if one of them is none.
fn mean(rows: &[FrameRow], figure: impl Fn(&FrameRow) -> Figure) -> Figure {
    moments(rows, figure).map_or_else(|none| none, |[mean, _]| Figure::from(mean))
}

/// Standard deviation over the frames that have a figure.
fn spread(rows: &[FrameRow], figure: impl Fn(&FrameRow) -> Figure) -> Figure {
    moments(rows, figure).map_or_else(|none| none, |[_, variance]| Figure::from(variance.sqrt()))
}

/// Mean and variance, or why there are none.
fn moments(rows: &[FrameRow], figure: impl Fn(&FrameRow) -> Figure) -> Result<[f64; 2], Figure> {
    let figures: Vec<Figure> = rows.iter().map(figure).filter(|figure| *figure != Figure::NotApplicable).collect();
    if figures.is_empty() {
        return Err(Figure::NotApplicable);
    }
    let numbers: Vec<f64> = figures.iter().map(|figure| figure.number().unwrap_or(f64::NAN)).collect();
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count;
    Ok([mean, numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count])
}
