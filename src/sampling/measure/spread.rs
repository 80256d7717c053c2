//! What many trials of a figure have in common.

/// Mean and spread of a figure over trials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// How many there were, at least 1.
    pub trials: usize,
    /// Arithmetic mean.
    pub mean: f64,
    /// Root of the mean square: what has a closed form where the mean has none.
    pub rms: f64,
    /// With `trials` - 1 in the denominator; 0 for one trial.
    pub variance: f64,
}

impl Spread {
    /// Of these values; none if there are none.
    #[must_use]
    pub fn of(values: &[f64]) -> Option<Self> {
        let trials = values.len();
        if trials == 0 {
            return None;
        }
        let mean_of = |value: &dyn Fn(f64) -> f64| values.iter().map(|&x| value(x)).sum::<f64>() / trials as f64;
        let mean = mean_of(&|x| x);
        let about_mean = mean_of(&|x| (x - mean) * (x - mean)) * trials as f64;
        let variance = about_mean / (trials - 1).max(1) as f64;
        Some(Self { trials, mean, rms: mean_of(&|x| x * x).sqrt(), variance })
    }

    /// Root of the variance.
    #[must_use]
    pub fn standard_deviation(&self) -> f64 {
        self.variance.sqrt()
    }

    /// How far the mean is likely to be from that of infinitely many trials.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        (self.variance / self.trials as f64).sqrt()
    }
}
