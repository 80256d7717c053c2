//! A small seeded generator, ours so that a scene never changes with a dependency.

/// PCG-XSH-RR 64/32 (O'Neill 2014): 64 bits of state, 32 bits a draw.
#[derive(Debug, Clone)]
pub(super) struct Pcg32 {
    state: u64,
}

impl Pcg32 {
    const MULTIPLIER: u64 = 6_364_136_223_846_793_005;
    const INCREMENT: u64 = 1_442_695_040_888_963_407;

    /// A sequence of its own for each seed.
    pub(super) fn new(seed: u64) -> Self {
        let mut generator = Self { state: seed.wrapping_add(Self::INCREMENT) };
        generator.next_u32();
        generator
    }

    /// The next 32 bits.
    pub(super) fn next_u32(&mut self) -> u32 {
        let old = self.state;
        self.state = old.wrapping_mul(Self::MULTIPLIER).wrapping_add(Self::INCREMENT);
        let shifted = (((old >> 18) ^ old) >> 27) as u32;
        shifted.rotate_right((old >> 59) as u32)
    }

    /// Uniform in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        f64::from(self.next_u32()) / 4_294_967_296.0
    }

    /// Uniform in [low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_numbers_and_another_seed_others() {
        let draw = |seed| {
            let mut generator = Pcg32::new(seed);
            [0; 4].map(|_| generator.next_u32())
        };
        assert_eq!(draw(7), draw(7));
        assert_ne!(draw(7), draw(8));
    }

    #[test]
    fn the_mean_and_the_bounds_are_those_of_a_uniform_distribution() {
        let mut generator = Pcg32::new(1);
        let draws: Vec<f64> = (0..10_000).map(|_| generator.between(-2.0, 4.0)).collect();
        assert!(draws.iter().all(|x| (-2.0..4.0).contains(x)));
        let mean = draws.iter().sum::<f64>() / 10_000.0;
        assert!((mean - 1.0).abs() < 0.05, "{mean}");
    }
}
