//! How often each difference occurs, to tell which tolerance would have passed.

use std::collections::BTreeMap;

/// Differences of pixels by size. Multiples of 1/65535, which all differences of levels are, are kept exactly; others, those of
/// floats, to 9 bits, so that they cannot fill the memory.
#[derive(Debug)]
pub(super) struct Histogram {
    /// By multiples of 1/255: most pictures have 8 bits, and what is this small stays in the fastest memory.
    levels: [u64; LEVELS + 1],
    /// By multiples of 1/65535 that are none of 1/255; empty until there is one.
    steps: Vec<u64>,
    /// By the bits of a number at least as large; of positive numbers these have the numbers' order.
    others: BTreeMap<u64, u64>,
}

const LEVELS: usize = 255;
const STEPS: usize = 65_535;

/// Bits of an f64 that are dropped of what is no multiple of 1/65535: 43 of 52 after the point.
const DROPPED: u64 = (1 << 43) - 1;

impl Default for Histogram {
    fn default() -> Self {
        Self { levels: [0; LEVELS + 1], steps: Vec::new(), others: BTreeMap::new() }
    }
}

impl Histogram {
    /// One more of a difference above 0.
    pub(super) fn add(&mut self, gap: f64) {
        if let Some(level) = multiple(gap, LEVELS) {
            self.levels[level] += 1;
        } else if let Some(step) = multiple(gap, STEPS) {
            self.make_steps();
            self.steps[step] += 1;
        } else {
            let bits = if gap.is_finite() { gap.to_bits() | DROPPED } else { f64::INFINITY.to_bits() };
            *self.others.entry(bits).or_default() += 1;
        }
    }

    fn make_steps(&mut self) {
        if self.steps.is_empty() {
            self.steps = vec![0; STEPS + 1];
        }
    }

    pub(super) fn merge(&mut self, other: Self) {
        self.levels.iter_mut().zip(other.levels).for_each(|(own, more)| *own += more);
        if !other.steps.is_empty() {
            self.make_steps();
            self.steps.iter_mut().zip(other.steps).for_each(|(own, more)| *own += more);
        }
        for (bits, count) in other.others {
            *self.others.entry(bits).or_default() += count;
        }
    }

    /// The smallest difference that no more than `most` exceed, or a little more where it was kept to 9 bits; none if infinite.
    pub(super) fn tolerance_for(&self, most: u64) -> Option<f64> {
        let levels = self.levels.iter().enumerate().map(|(level, &count)| (level as f64 / LEVELS as f64, count));
        let steps = self.steps.iter().enumerate().map(|(step, &count)| (step as f64 / STEPS as f64, count));
        let others = self.others.iter().map(|(&bits, &count)| (f64::from_bits(bits), count));
        let mut all: Vec<(f64, u64)> = levels.chain(steps).chain(others).filter(|(_, count)| *count > 0).collect();
        all.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut above = 0;
        for (gap, count) in all {
            above += count;
            if above > most {
                return Some(gap).filter(|gap| gap.is_finite());
            }
        }
        Some(0.0)
    }
}

/// Which multiple of `1 / parts` it is; none if it is none, or more than 1.
fn multiple(gap: f64, parts: usize) -> Option<usize> {
    // Rounds without the library's function, which takes longer than all the rest.
    let nearest = (gap * parts as f64 + 0.5) as usize;
    (nearest <= parts && nearest as f64 / parts as f64 == gap).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(gaps: &[f64]) -> Histogram {
        let mut parts = [Histogram::default(), Histogram::default()];
        gaps.iter().enumerate().for_each(|(i, gap)| parts[i % 2].add(*gap));
        let [mut whole, other] = parts;
        whole.merge(other);
        whole
    }

    #[test]
    fn the_tolerance_is_the_largest_difference_but_so_many() {
        let levels = of(&[1.0 / 255.0, 3.0 / 255.0, 3.0 / 255.0, 7.0 / 65_535.0]);
        assert_eq!(
            [0, 1, 2, 3, 4].map(|most| levels.tolerance_for(most)),
            [Some(3.0 / 255.0), Some(3.0 / 255.0), Some(1.0 / 255.0), Some(7.0 / 65_535.0), Some(0.0)]
        );
    }

    #[test]
    fn floats_are_rounded_up_and_infinity_is_no_tolerance() {
        let floats = of(&[0.1234567, 1e9, f64::INFINITY]);
        assert_eq!(floats.tolerance_for(0), None);
        for (most, gap) in [(1, 1e9), (2, 0.1234567)] {
            let tolerance = floats.tolerance_for(most).expect("finite");
            assert!(tolerance >= gap && tolerance < gap * 1.004, "{tolerance} for {gap}");
        }
    }
}
