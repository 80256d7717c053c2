//! The order of a cycle's points in time.
//!
//! The chance that a straight edge somewhere across the pixel parts two points grows as their distance (Crofton's formula), and
//! what a weighted mean of samples misses of such edges falls as the sum of w_i w_j |p_i - p_j| over pairs rises. In a running mean
//! that sum depends on the order: samples near in time count together, so they should lie far apart.

use super::sequences::radical_inverse;

/// What a frame adds to the running mean that the order is made for. Means of 0.05 err as little in an order made for 0.1.
const SHARE: f64 = 0.1;

/// Frames after which a sample does not count any more: 0.9^64 is 0.1 %.
const MEMORY: usize = 64;

/// More than cycles of up to [`LONG`] frames were seen to need.
const MOST_ROUNDS: usize = 64;

/// Longer cycles begin in an order that is good already, and take few rounds: one costs n^2.
const LONG: usize = 128;
const ROUNDS_OF_LONG: usize = 4;

/// The points in an order that no exchange of two betters, or nearly so for long cycles: a repeating cycle whose running mean errs
/// little at every frame. A cycle of a thousand takes two seconds.
pub(super) fn spread_in_time(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut cycle = Cycle::new(points);
    let long = points.len() > LONG;
    if long {
        cycle.leap();
    }
    for _ in 0..if long { ROUNDS_OF_LONG } else { MOST_ROUNDS } {
        if !cycle.exchange_all() {
            break;
        }
    }
    cycle.order.iter().map(|&point| points[point]).collect()
}

#[derive(Debug)]
struct Cycle {
    /// Between all pairs of points.
    distances: Vec<f64>,
    /// How much two frames count together, by how far on the second is.
    weights: Vec<f64>,
    /// Which point each frame has.
    order: Vec<usize>,
}

impl Cycle {
    fn new(points: &[[f64; 2]]) -> Self {
        let distances = points.iter().flat_map(|p| points.iter().map(move |q| (p[0] - q[0]).hypot(p[1] - q[1]))).collect();
        let kept = |frames: usize| (1.0 - SHARE).powi(frames as i32);
        // Up to a factor: a sample and one so many frames on, of this cycle or of the one before.
        let weights = (0..points.len()).map(|lag| kept(lag) + kept(points.len() - lag)).collect();
        Self { distances, weights, order: (0..points.len()).collect() }
    }

    /// Points in the order of their numbers' radical inverses: neighbours in a pattern's own order often lie close together.
    fn leap(&mut self) {
        self.order.sort_by(|a, b| radical_inverse(2, *a as u32).total_cmp(&radical_inverse(2, *b as u32)));
    }

    /// Exchanges each two frames' points where that is better; whether any were.
    fn exchange_all(&mut self) -> bool {
        let mut any = false;
        for later in 1..self.order.len() {
            for earlier in 0..later {
                // Ties stay as they are, whatever their last digits.
                if self.gain(earlier, later) > 1e-9 {
                    self.order.swap(earlier, later);
                    any = true;
                }
            }
        }
        any
    }

    /// Of the weighted sum of distances, if two frames exchanged their points. What is between these two stays.
    fn gain(&self, a: usize, b: usize) -> f64 {
        self.farther(a, b) + self.farther(b, a)
    }

    /// How much farther `from` the frames around would be if this frame had the `other`'s point.
    fn farther(&self, frame: usize, other: usize) -> f64 {
        let n = self.order.len();
        let [here, there] = [frame, other].map(|frame| &self.distances[self.order[frame] * n..][..n]);
        let difference = |lag: usize| {
            let near = frame + lag;
            let near = if near < n { near } else { near - n };
            let point = self.order[near];
            if near == other { 0.0 } else { self.weights[lag] * (there[point] - here[point]) }
        };
        let ahead = 1..n.min(MEMORY);
        let behind = ahead.end.max((n + 1).saturating_sub(MEMORY))..n;
        ahead.chain(behind).map(difference).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::PATTERNS;

    #[test]
    fn the_points_stay_and_no_exchange_is_better() {
        for pattern in PATTERNS {
            for length in [1, 2, 3, 16, 33, LONG as u32] {
                let points = pattern.points(length, 5);
                let ordered = spread_in_time(&points);
                let sorted = |points: &[[f64; 2]]| {
                    let mut bits: Vec<_> = points.iter().map(|p| p.map(f64::to_bits)).collect();
                    bits.sort_unstable();
                    bits
                };
                assert_eq!(sorted(&points), sorted(&ordered), "{}", pattern.name);
                assert!(!Cycle::new(&ordered).exchange_all(), "{} {length}", pattern.name);
            }
        }
    }

    #[test]
    fn a_gain_is_what_the_sum_rises_by() {
        let points = PATTERNS[0].points(12, 0);
        let sum = |cycle: &Cycle| {
            let pairs = (0..12).flat_map(|i| (0..12).map(move |k| (i, k))).filter(|(i, k)| i != k);
            let of_pair =
                |(i, k): (usize, usize)| cycle.weights[(k + 12 - i) % 12] * cycle.distances[cycle.order[i] * 12 + cycle.order[k]];
            // Each pair is met twice.
            0.5 * pairs.map(of_pair).sum::<f64>()
        };
        let mut cycle = Cycle::new(&points);
        for (a, b) in [(0, 1), (2, 9), (3, 8)] {
            let (gain, before) = (cycle.gain(a, b), sum(&cycle));
            cycle.order.swap(a, b);
            assert!((sum(&cycle) - before - gain).abs() < 1e-12, "{a} {b}");
        }
    }
}
