//! Means of exactly known functions over pixels, on the CPU.

use rayon::prelude::*;

use super::check_interrupt;
use crate::error::Result;
use crate::sampling::integrals::PixelTest;
use crate::sampling::{PatternSpec, hash};

/// How many points all sets of a pool have together, if nothing else is asked for.
const POOL_POINTS: u32 = 1 << 20;

/// Of fewer, what is common to them by chance would show; more than pixels are of no use.
const POOL_SETS: (u32, u32) = (256, 65_536);

/// Which sets pixels have: a pattern that uses the seed has one of a pool of sets for each, drawn by chance; another the same for all.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PixelSets {
    /// Of the first set.
    pub(super) seed: u32,
    /// Sets of a pattern that uses the seed; else as many as suit the number of samples.
    pub(super) pool: Option<u32>,
    /// Whether the one set of a pattern that does not use the seed is moved on the torus for each pixel.
    pub(super) shift: bool,
}

impl PixelSets {
    /// In a word.
    pub(super) fn describe(self, seeded: bool) -> &'static str {
        match (seeded, self.shift) {
            (true, _) => "fresh",
            (false, true) => "shifted",
            (false, false) => "fixed",
        }
    }

    /// The error of each pixel's mean.
    pub(super) fn errors(self, test: &PixelTest, spec: &PatternSpec, seeded: bool, spp: u32) -> Result<Vec<f64>> {
        let sets = if seeded { self.pool.unwrap_or((POOL_POINTS / spp).clamp(POOL_SETS.0, POOL_SETS.1)) } else { 1 };
        let set = |k: u32| {
            check_interrupt()?;
            spec.points(spp, self.seed.wrapping_add(k))
        };
        let pool: Vec<Vec<[f64; 2]>> = (0..sets).into_par_iter().map(set).collect::<Result<_>>()?;
        let shifted = !seeded && self.shift;
        let error = |pixel: usize| {
            // By chance: in turn, squares of pixels that are averaged would have the same few sets again and again.
            let points = pool[(hash(pixel as u64) % pool.len() as u64) as usize].iter();
            if shifted {
                let shift = shift_of(self.seed, pixel);
                test.error(pixel, points.map(|p| [0, 1].map(|k| (p[k] + shift[k]).fract())))
            } else {
                test.error(pixel, points.copied())
            }
        };
        Ok((0..test.pixels()).into_par_iter().map(error).collect())
    }
}

/// Cranley and Patterson's (1976): the same for all points of a pixel, uniform over the torus.
fn shift_of(seed: u32, pixel: usize) -> [f64; 2] {
    [0, 1].map(|k| (hash(hash(u64::from(seed)) ^ (2 * pixel as u64 + k)) >> 11) as f64 / (1u64 << 53) as f64)
}
