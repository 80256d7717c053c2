//! Point sets and reconstruction filters: pure arithmetic in f64, no GPU.
//!
//! A pattern gives N points in the unit square; a filter gives a point's weight in a pixel. Both are registry slices: a new one is
//! one function and one line. A [`PatternSpec`] is a pattern with values for its parameters; a [`Request`] says how many points, in
//! which domain, how densely where.

mod filters;
pub mod integrals;
mod jitter;
pub mod measure;
mod order;
mod patterns;
mod sequences;
mod stream;

pub use filters::{FILTERS, Filter, filter};
pub use jitter::jitter_cycle;
pub use patterns::{
    Counts, Density, DensityControl, Domain, MAX_POINTS, MAX_SET_POINTS, PATTERNS, Parameter, Pattern, PatternSpec, Progress,
    Request, pattern, pattern_names, standard_positions,
};
use sequences::hilbert_index;
pub use sequences::{hash, larcher_pillichshammer, owen_scrambled, radical_inverse, sobol_second};

/// A sample of a pixel: where, and how much it counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightedOffset {
    /// From the pixel's centre, in pixels, y down.
    pub offset_px: [f64; 2],
    /// Not normalised; negative under a filter's negative lobes.
    pub weight: f64,
}

/// `n` samples spread by `pattern` over the support of `filter` stretched to `radius_px`, weighted by the filter.
///
/// They come in two halves (the first the larger if n is odd) that each cover the support evenly: neighbours along a Hilbert
/// curve go to different halves. Taking every other point in the pattern's own order would not do: a radical inverse puts its
/// even-numbered points into one half of the pixel.
#[must_use]
pub fn weighted_offsets(pattern: &Pattern, n: u32, seed: u32, filter: &Filter, radius_px: f64) -> Vec<WeightedOffset> {
    let mut points = pattern.points(n, seed);
    points.sort_by_key(|p| hilbert_index(*p));
    let halves = points.iter().step_by(2).chain(points.iter().skip(1).step_by(2));
    halves
        .map(|p| {
            let offset_px = p.map(|u| (2.0 * u - 1.0) * radius_px);
            WeightedOffset { offset_px, weight: filter.weight(offset_px, radius_px) }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_halves_cover_the_pixel() {
        let unit = filter("box").expect("a shipped filter");
        for pattern in PATTERNS {
            let samples = weighted_offsets(pattern, 1000, 0, unit, 0.5);
            assert!(samples.iter().all(|s| s.weight == 1.0 && s.offset_px.iter().all(|o| o.abs() <= 0.5)));
            for half in samples.chunks(500) {
                // Every quarter of the pixel has its quarter of the half.
                for quarter in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
                    let count = half.iter().filter(|s| (0..2).all(|k| s.offset_px[k] * quarter[k] > 0.0)).count();
                    assert!((count as f64 - 125.0).abs() < 30.0, "{}: {count}", pattern.name);
                }
            }
        }
    }
}
