//! Figures of sequences: what moves between frames, and whether it should. Pure functions of pictures and motion.
//!
//! Pictures are display values that were not rounded to 8 bits; T is the picture under test, R the reference of the same frame.
//! [`Tracks`] say where what a pixel shows was seen in earlier frames; all that follows surfaces reads them. [`MEASURES`] is what a
//! sequence is summed up by, [`Ledger`] sums it up.

mod change;
mod edge_position;
mod ghost;
mod ledger;
mod measures;
mod response;
mod ridges;
mod sharpness;
mod similarity;
mod steadiness;
mod tracks;
mod yardstick;

#[cfg(test)]
mod sample;

pub use change::{Change, change, mean_square, mean_square_of_steps};
pub use edge_position::edge_displacements;
pub use ghost::{AGES, GHOST_FLOOR, GhostSums, SETTLED_AGES, Uncovered};
pub use ledger::{FrameRow, Ledger, Verdict, Worst};
pub use measures::{MEASURES, Measure};
pub use response::response;
pub use ridges::{Continuity, Ridges};
pub use sharpness::sharpness;
pub use similarity::similarity;
pub use steadiness::{Crawl, Steadiness};
pub use tracks::{Flow, GAPS, Place, Tracks};
pub use yardstick::{Truth, Yardstick};

use crate::picture::Pixel;

/// Luma of display values, by the weights of ITU-R BT.709.
fn luma([r, g, b, _]: Pixel) -> f64 {
    0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
}

/// Red, green and blue in f64.
fn rgb([r, g, b, _]: Pixel) -> [f64; 3] {
    [r, g, b].map(f64::from)
}

/// What a fraction of the values does not exceed, between the two nearest ranks linearly; none of nothing.
fn percentile(mut values: Vec<f32>, fraction: f64) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    values.sort_unstable_by(f32::total_cmp);
    let rank = fraction * last as f64;
    let [below, above] = [rank.floor(), rank.ceil()].map(|rank| f64::from(values[rank as usize]));
    Some(below + rank.fract() * (above - below))
}
