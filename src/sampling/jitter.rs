//! Sample positions that follow one another from frame to frame.

use super::Pattern;

/// The first `length` points of a pattern as offsets from the pixel's centre in pixels, y down, in an order in which any few that
/// follow each other lie far apart, and with a mean of zero: a cycle whose mean is not the centre shifts the whole picture.
///
/// Patterns whose points are spread in their own order keep it; others start at the point nearest to the centre and go on with the
/// one that is farthest from all before, around the pixel's borders.
#[must_use]
pub fn jitter_cycle(pattern: &Pattern, length: u32, seed: u32) -> Vec<[f64; 2]> {
    let points = pattern.points(length, seed);
    let ordered = if pattern.progressive { points } else { farthest_first(points) };
    let mean = [0, 1].map(|k| ordered.iter().map(|p| p[k]).sum::<f64>() / f64::from(length));
    ordered.into_iter().map(|p| [p[0] - mean[0], p[1] - mean[1]]).collect()
}

fn farthest_first(mut rest: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let mut ordered: Vec<[f64; 2]> = Vec::with_capacity(rest.len());
    while !rest.is_empty() {
        let distance = |p: &[f64; 2]| match ordered.is_empty() {
            true => -torus_distance(*p, [0.5, 0.5]),
            false => ordered.iter().map(|q| torus_distance(*p, *q)).fold(f64::INFINITY, f64::min),
        };
        let mut farthest = 0;
        for (k, point) in rest.iter().enumerate() {
            // Ties go to the earlier point, whatever their last digits are.
            if distance(point) > distance(&rest[farthest]) + 1e-12 {
                farthest = k;
            }
        }
        ordered.push(rest.remove(farthest));
    }
    ordered
}

/// Squared, in a square whose opposite sides touch.
fn torus_distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    [0, 1].map(|k| (p[k] - q[k]).abs()).map(|d| d.min(1.0 - d)).iter().map(|d| d * d).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::PATTERNS;

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

    #[test]
    fn neighbours_in_time_are_far_apart() {
        for pattern in PATTERNS.iter().filter(|p| !["random", "jittered"].contains(&p.name)) {
            let offsets = jitter_cycle(pattern, 16, 0);
            let steps = offsets.windows(2).map(|w| torus_distance(w[0], w[1]).sqrt());
            let mean = steps.sum::<f64>() / 15.0;
            assert!(mean > 0.38, "{}: {mean}", pattern.name);
        }
    }
}
