//! Chance in a row: numbers, points and permutations that follow from a seed.

use super::sequences::{hash, unit};

/// Independent uniform numbers, the same for the same seed and lane everywhere.
#[derive(Debug, Clone)]
pub(super) struct Stream {
    key: u64,
    next: u64,
}

impl Stream {
    /// Lanes of one seed have nothing to do with each other.
    pub(super) fn new(seed: u32, lane: u32) -> Self {
        Self { key: hash(u64::from(lane) << 32 | u64::from(seed)), next: 0 }
    }

    /// In [0, 1).
    pub(super) fn number(&mut self) -> f64 {
        let number = unit(hash(self.key ^ self.next));
        self.next += 1;
        number
    }

    /// 32 coins.
    pub(super) fn bits(&mut self) -> u32 {
        self.next += 1;
        (hash(self.key ^ (self.next - 1)) >> 32) as u32
    }

    /// In [0, 1)^2.
    pub(super) fn point(&mut self) -> [f64; 2] {
        [self.number(), self.number()]
    }

    /// 0 to `length` - 1 in an order that each has the same chance to be (Fisher and Yates 1938).
    pub(super) fn permutation(&mut self, length: u32) -> Vec<u32> {
        let mut order: Vec<u32> = (0..length).collect();
        for last in (1..order.len()).rev() {
            let other = (self.number() * (last + 1) as f64) as usize;
            order.swap(last, other);
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_permutation_has_every_number_once_and_no_favourite() {
        let mut stream = Stream::new(1, 0);
        let mut firsts = [0u32; 6];
        for _ in 0..6000 {
            let order = stream.permutation(6);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, [0, 1, 2, 3, 4, 5]);
            firsts[order[0] as usize] += 1;
        }
        // 1000 each, standard deviation 29.
        assert!(firsts.iter().all(|count| count.abs_diff(1000) < 145), "{firsts:?}");
    }

    #[test]
    fn uniform_numbers_look_uniform() {
        for lane in 0..3 {
            let mut stream = Stream::new(7, lane);
            let mean = (0..10_000).map(|_| stream.number()).sum::<f64>() / 10_000.0;
            assert!((mean - 0.5).abs() < 0.01, "{mean}");
        }
    }
}
