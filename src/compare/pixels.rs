//! The plain test: which pixels differ, by how much, and what tolerance would have passed them. Reads each picture once, in its own
//! depth, and needs no memory beside the two.

use super::histogram::Histogram;
use super::sides::Sides;
use crate::picture::{Channels, Raster};
use crate::suite::{PixelFigures, WorstPixel};
use rayon::prelude::*;

/// Rows that are counted at once.
const BAND: u32 = 32;

/// What the plain test finds.
#[derive(Debug)]
pub(super) struct Pixels {
    pub(super) figures: PixelFigures,
    /// Root mean square difference of red, green and blue over the compared pixels.
    pub(super) rmse: f64,
    gaps: Histogram,
}

impl Pixels {
    /// Pixels of which a channel differs by more than `per_channel` count as differing.
    pub(super) fn of(sides: &Sides<'_>, per_channel: f64) -> Self {
        let height = sides.size()[1];
        let mut whole = Tally::new();
        let bands: Vec<u32> = (0..height).step_by(BAND as usize).collect();
        // In waves, so that only a few histograms are alive, and added in order, so that sums do not depend on threads.
        for wave in bands.chunks(4 * rayon::current_num_threads()) {
            let tallies: Vec<Tally> =
                wave.par_iter().map(|&y| Tally::of(sides, y..(y + BAND).min(height), per_channel)).collect();
            tallies.into_iter().for_each(|tally| whole.add(tally));
        }
        let worst = whole.worst.map(|(difference, at)| worst(sides, difference, at));
        let bounds = (whole.differing > 0).then(|| {
            let [left, top, right, bottom] = whole.bounds;
            [left, top, right - left, bottom - top]
        });
        let rmse = (whole.squared / (3 * whole.compared.max(1)) as f64).sqrt();
        let figures = PixelFigures { compared: whole.compared, differing: whole.differing, bounds, worst };
        Self { figures, rmse, gaps: whole.gaps }
    }

    /// The smallest tolerance at which no more than `most` pixels differ; none if no finite one is enough.
    pub(super) fn tolerance_for(&self, most: u64) -> Option<f64> {
        self.gaps.tolerance_for(most)
    }
}

#[derive(Debug)]
struct Tally {
    compared: u64,
    differing: u64,
    squared: f64,
    /// Left, top, right, bottom, the last two outside.
    bounds: [u32; 4],
    /// Largest difference and its place.
    worst: Option<(f64, [u32; 2])>,
    gaps: Histogram,
}

impl Tally {
    fn new() -> Self {
        Self {
            compared: 0,
            differing: 0,
            squared: 0.0,
            bounds: [u32::MAX, u32::MAX, 0, 0],
            worst: None,
            gaps: Histogram::default(),
        }
    }

    fn of(sides: &Sides<'_>, rows: std::ops::Range<u32>, per_channel: f64) -> Self {
        let mut tally = Self::new();
        let width = sides.size()[0];
        for y in rows {
            let counted = sides.scope.row(y, width);
            tally.compared += counted.map_or(u64::from(width), |row| row.into_iter().filter(|counts| *counts).count() as u64);
            sides.differing_in_row(y, |gap| {
                let x = gap.x as u32;
                tally.gaps.add(gap.largest);
                tally.squared += gap.squared;
                if tally.worst.is_none_or(|(largest, _)| gap.largest > largest) {
                    tally.worst = Some((gap.largest, [x, y]));
                }
                if gap.largest > per_channel {
                    tally.differing += 1;
                    let [left, top, right, bottom] = tally.bounds;
                    tally.bounds = [left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)];
                }
            });
        }
        tally
    }

    /// Of the rows below these.
    fn add(&mut self, below: Self) {
        self.compared += below.compared;
        self.differing += below.differing;
        self.squared += below.squared;
        let ([left, top, right, bottom], [l, t, r, b]) = (self.bounds, below.bounds);
        self.bounds = [left.min(l), top.min(t), right.max(r), bottom.max(b)];
        if below.worst.is_some_and(|(theirs, _)| self.worst.is_none_or(|(ours, _)| theirs > ours)) {
            self.worst = below.worst;
        }
        self.gaps.merge(below.gaps);
    }
}

fn worst(sides: &Sides<'_>, difference: f64, at: [u32; 2]) -> WorstPixel {
    let bits = |raster: &Raster| match raster.channels() {
        Channels::Eight(_) => 8,
        Channels::Sixteen(_) => 16,
        Channels::Float(_) => 32,
    };
    let finite = |raster: &Raster| raster.values(at).into_iter().map(|value| Some(value).filter(|v| v.is_finite())).collect();
    WorstPixel {
        at,
        expected: finite(sides.expected),
        actual: finite(sides.actual),
        bits: [bits(sides.expected), bits(sides.actual)],
        difference: Some(difference).filter(|difference| difference.is_finite()),
    }
}
