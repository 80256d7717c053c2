//! Sample positions that follow one another from frame to frame.

use super::Pattern;
use super::order::spread_in_time;

/// The first `length` points of a pattern as offsets from the pixel's centre in pixels, y down, in an order in which frames near in
/// time sample far apart, and with a mean of zero: a cycle whose mean is not the centre shifts the whole picture.
///
/// Patterns whose points are spread in their own order keep it.
#[must_use]
pub fn jitter_cycle(pattern: &Pattern, length: u32, seed: u32) -> Vec<[f64; 2]> {
    let points = pattern.points(length, seed);
    let points = if pattern.progressive { points } else { spread_in_time(&points) };
    let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / f64::from(length));
    points.into_iter().map(|p| [p[0] - mean[0], p[1] - mean[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::integrals::PixelTest;
    use crate::sampling::{PATTERNS, pattern};

    /// Of a running mean to which each frame adds a tenth, once it has settled: root mean square over the cycle's frames and
    /// half-planes across the pixel, times 1000.
    fn settled_error(test: &PixelTest, offsets: &[[f64; 2]]) -> f64 {
        const SHARE: f64 = 0.1;
        let squares = (0..test.pixels()).map(|edge| {
            let errors = offsets.iter().map(|p| test.error(edge, std::iter::once([p[0] + 0.5, p[1] + 0.5])));
            let errors: Vec<f64> = errors.collect();
            let add = |mean: f64, error: &f64| mean + SHARE * (error - mean);
            // A cycle leaves this share of what was there before it, and adds the same each time.
            let kept = (1.0 - SHARE).powi(errors.len() as i32);
            let mut mean = errors.iter().fold(0.0, add) / (1.0 - kept);
            let of_frames = errors.iter().map(|error| {
                mean = add(mean, error);
                mean * mean
            });
            of_frames.sum::<f64>() / errors.len() as f64
        });
        1e3 * (squares.sum::<f64>() / test.pixels() as f64).sqrt()
    }

    /// In the pattern's own order.
    fn plain(name: &str, length: u32) -> Vec<[f64; 2]> {
        let points = pattern(name).expect("exists").points(length, 0);
        points.iter().map(|p| p.map(|x| x - 0.5)).collect()
    }

    fn centred(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mean = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64);
        points.iter().map(|p| [p[0] - mean[0], p[1] - mean[1]]).collect()
    }

    fn half_planes() -> PixelTest {
        PixelTest::new("halfplane", 0.0).expect("exists")
    }

    #[test]
    fn running_means_err_as_another_program_found() {
        let test = half_planes();
        for (name, length, as_they_are, with_a_mean_of_zero) in [
            ("halton", 16, 60.3, 51.7),
            ("halton", 32, 48.6, 46.0),
            ("r2", 16, 73.7, 47.9),
            ("larcher", 16, 64.3, 64.3),
            ("regular", 16, 63.0, 63.0),
        ] {
            let points = plain(name, length);
            for (points, expected) in [(points.clone(), as_they_are), (centred(&points), with_a_mean_of_zero)] {
                let found = settled_error(&test, &points);
                // Its 6000 edges by chance have a standard error of above 1 %.
                assert!((found / expected - 1.0_f64).abs() < 0.03, "{name} {length}: {found}, expected {expected}");
            }
        }
    }

    #[test]
    fn the_order_is_worth_it() {
        let test = half_planes();
        let error = |name: &str, length| settled_error(&test, &jitter_cycle(pattern(name).expect("exists"), length, 0));
        // With the farthest point first the other program found 47.9 and 51.0 for these.
        for (name, most) in [("regular", 45.5), ("larcher", 48.5)] {
            assert!(error(name, 16) < most, "{name}: {}", error(name, 16));
        }
        // Orders do not get worse with length.
        for name in ["regular", "rotated", "larcher", "fibonacci"] {
            for (length, most) in [(32, 43.5), (64, 43.0), (256, 43.5)] {
                assert!(error(name, length) < most, "{name} {length}: {}", error(name, length));
            }
        }
    }

    #[test]
    fn every_cycle_has_its_mean_at_the_centre() {
        for pattern in PATTERNS {
            for length in [1, 2, 3, 8, 16, 23, 32, 64, 256] {
                // As a GPU gets them.
                let offsets: Vec<[f32; 2]> = jitter_cycle(pattern, length, 7).iter().map(|p| p.map(|x| x as f32)).collect();
                assert_eq!(offsets.len(), length as usize);
                for axis in 0..2 {
                    let mean = offsets.iter().map(|p| f64::from(p[axis])).sum::<f64>() / f64::from(length);
                    assert!(mean.abs() < 1e-6, "{} {length}: {mean}", pattern.name);
                }
            }
        }
    }
}
