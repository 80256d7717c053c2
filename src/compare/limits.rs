//! What a pair must meet.

/// Limits of a comparison. Without any, a single differing pixel is too many.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Limits {
    /// How many pixels may differ; not asked if only others are set.
    pub max_pixels: Option<Allowance>,
    /// How much a channel may differ before its pixel does, as a share of the highest level (or as a float).
    pub per_channel: Option<f64>,
    /// Limits of metrics, each at most once.
    pub metrics: Vec<MetricLimit>,
    /// Whether pixels of resampled edges may differ.
    pub allow_edges: bool,
}

/// A number of pixels, or a share of those that are compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Allowance {
    /// So many.
    Count(u64),
    /// This share, 0 to 1; what it comes to is rounded down.
    Share(f64),
}

/// A limit of one metric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MetricLimit {
    /// Which.
    pub measure: Measure,
    /// The worst figure that passes.
    pub limit: f64,
}

/// What can be limited beside pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Root mean square difference of the colours' values as the files store them.
    Rmse,
    /// [`crate::metrics`]' PSNR of display values.
    Psnr,
    /// [`crate::metrics`]' structural similarity of display values.
    Ssim,
    /// [`crate::metrics`]' mean FLIP error.
    Flip,
}

impl Measure {
    /// The option that sets its limit.
    #[must_use]
    pub fn option(self) -> &'static str {
        match self {
            Self::Rmse => "--max-rmse",
            Self::Psnr => "--min-psnr",
            Self::Ssim => "--min-ssim",
            Self::Flip => "--max-flip",
        }
    }

    /// Whether higher figures are better.
    #[must_use]
    pub fn is_least(self) -> bool {
        matches!(self, Self::Psnr | Self::Ssim)
    }
}

impl Limits {
    /// Whether differing pixels decide: always, unless only metrics are limited.
    #[must_use]
    pub fn asks_pixels(&self) -> bool {
        self.metrics.is_empty() || self.max_pixels.is_some() || self.per_channel.is_some() || self.allow_edges
    }

    /// The limit of a metric, if there is one.
    #[must_use]
    pub fn of(&self, measure: Measure) -> Option<f64> {
        self.metrics.iter().find(|limit| limit.measure == measure).map(|limit| limit.limit)
    }
}

impl Allowance {
    /// Pixels that it allows of so many.
    #[must_use]
    pub fn pixels(self, of: u64) -> u64 {
        match self {
            Self::Count(count) => count,
            // What a share like 0.3 % comes to is often a whole number that f64 misses by little.
            Self::Share(share) => (share * of as f64 + 1e-9).floor() as u64,
        }
    }
}
