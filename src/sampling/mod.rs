//! Point sets and reconstruction filters: pure arithmetic in f64, no GPU.
//!
//! A pattern gives N points in the unit square; a filter gives a point's weight in a pixel. Both are registry slices: a new one is
//! one function and one line.

mod filters;
mod patterns;
mod sequences;

pub use filters::{FILTERS, Filter, filter};
pub use patterns::{MAX_POINTS, PATTERNS, Pattern, pattern};
pub use sequences::{hash, larcher_pillichshammer, owen_scrambled, radical_inverse};

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
/// The even-numbered points come first and the odd-numbered ones after them, so that the first half of the list samples the
/// pixel as evenly as the whole.
#[must_use]
pub fn weighted_offsets(pattern: &Pattern, n: u32, seed: u32, filter: &Filter, radius_px: f64) -> Vec<WeightedOffset> {
    let points = (pattern.points)(n, seed);
    let halves = points.iter().step_by(2).chain(points.iter().skip(1).step_by(2));
    halves
        .map(|p| {
            let offset_px = p.map(|u| (2.0 * u - 1.0) * radius_px);
            WeightedOffset {
                offset_px,
                weight: filter.weight(offset_px, radius_px),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_halves_cover_the_pixel() {
        let lattice = pattern("r2").expect("a shipped pattern");
        let samples = weighted_offsets(lattice, 1000, 0, filter("box").expect("a shipped filter"), 0.5);
        for half in samples.chunks(500) {
            let mean: f64 = half.iter().map(|s| s.offset_px[0]).sum::<f64>() / 500.0;
            assert!(mean.abs() < 0.01, "{mean}");
            assert!(
                half.iter()
                    .all(|s| s.weight == 1.0 && s.offset_px.iter().all(|o| o.abs() <= 0.5))
            );
        }
    }
}
