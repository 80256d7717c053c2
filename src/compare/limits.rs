//! What a pair must meet, and the words it is asked for with.

use std::str::FromStr;

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

impl FromStr for Allowance {
    type Err = String;

    /// Reads a count, or a share such as `0.1%`.
    fn from_str(text: &str) -> Result<Self, String> {
        let allowance = match text.trim().strip_suffix('%') {
            Some(percent) => {
                let share = number(percent).filter(|percent| *percent <= 100.0).map(|percent| percent / 100.0);
                share.map(Self::Share)
            }
            None => text.trim().parse().ok().map(Self::Count),
        };
        allowance.ok_or_else(|| {
            format!("'{text}' is no number of pixels; write a whole number, or a share of at most 100 such as 0.1%")
        })
    }
}

/// Reads a difference of channels: `2/255`, `300/65535`, or a number.
///
/// # Errors
///
/// What should have been written.
pub fn parse_difference(text: &str) -> Result<f64, String> {
    let difference = match text.split_once('/') {
        Some((levels, of)) => number(levels).zip(number(of).filter(|of| *of > 0.0)).map(|(levels, of)| levels / of),
        None => number(text),
    };
    difference.ok_or_else(|| format!("'{text}' is no difference; write 2/255, 300/65535, or a number of at least 0 such as 0.01"))
}

/// Reads the limit of a metric.
///
/// # Errors
///
/// What should have been written.
pub fn parse_limit(text: &str) -> Result<f64, String> {
    number(text).ok_or_else(|| format!("'{text}' is no limit; write a number of at least 0"))
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|x| *x >= 0.0 && x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_counts() {
        assert_eq!("12".parse(), Ok(Allowance::Count(12)));
        assert_eq!("0.1%".parse(), Ok(Allowance::Share(0.001)));
        assert_eq!(Allowance::Share(0.003).pixels(1000), 3);
        assert_eq!(Allowance::Share(0.0039).pixels(1000), 3);
        for bad in ["", "%", "-1", "1.5", "101%", "nan%", "many"] {
            assert!(bad.parse::<Allowance>().is_err(), "{bad}");
        }
    }

    #[test]
    fn differences() {
        assert_eq!(parse_difference("2/255"), Ok(2.0 / 255.0));
        assert_eq!(parse_difference("0.5"), Ok(0.5));
        for bad in ["", "/", "1/0", "-1/255", "1/2/3", "inf", "nan"] {
            assert!(parse_difference(bad).is_err(), "{bad}");
        }
    }
}
