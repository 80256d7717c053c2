//! How far a picture is from its reference: a registry of metrics, each with a versioned id.
//!
//! ```
//! use dejag::metrics::{self, Pair};
//! use dejag::picture::DisplayPicture;
//!
//! let reference = DisplayPicture::from_rgba8(1, 1, &[128, 128, 128, 255])?;
//! let candidate = DisplayPicture::from_rgba8(1, 1, &[129, 128, 128, 255])?;
//! let pair = Pair::new(&candidate, &reference)?;
//! let psnr = metrics::find("psnr")?.evaluate(&pair).number().expect("a finite pair");
//! assert!(psnr > 50.0);
//! # Ok::<(), dejag::Error>(())
//! ```

mod difference;
mod flip;
mod pair;
mod ssim;
mod sums;
pub mod temporal;

#[cfg(test)]
mod formula;
#[cfg(test)]
mod published;
#[cfg(test)]
mod tests;

pub use flip::{NON_FINITE_COLOUR, PIXELS_PER_DEGREE, error_map, magma};
pub use pair::Pair;
pub use sums::{MARGIN, Mean, Strip, Sum};

use crate::Result;
use crate::error::unknown;

/// A metric's figure, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Figure {
    /// A finite number.
    Number(f64),
    /// Plus infinity: the PSNR of equal pictures.
    Infinite,
    /// A pixel of either picture is NaN or infinite, so a figure would mean nothing.
    NonFinite,
    /// The metric does not apply: a linear one to display values only, or a window that is larger than the picture.
    NotApplicable,
}

impl Figure {
    /// The number, with infinity as such; none where there is no figure.
    #[must_use]
    pub fn number(self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(x),
            Self::Infinite => Some(f64::INFINITY),
            Self::NonFinite | Self::NotApplicable => None,
        }
    }
}

impl From<f64> for Figure {
    fn from(x: f64) -> Self {
        if x.is_finite() {
            Self::Number(x)
        } else if x == f64::INFINITY {
            Self::Infinite
        } else {
            Self::NonFinite
        }
    }
}

/// Which figures of a metric are the good ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    /// The higher, the nearer to the reference.
    Higher,
    /// The lower, the nearer to the reference.
    Lower,
    /// 1 is right, on either side of it is wrong.
    NearOne,
    /// 0 is right, on either side of it is wrong.
    NearZero,
}

impl Better {
    /// `higher`, `lower`, `near 1` or `near 0`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Higher => "higher",
            Self::Lower => "lower",
            Self::NearOne => "near 1",
            Self::NearZero => "near 0",
        }
    }
}

/// The values that a metric reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reads {
    /// sRGB-coded values as displayed, after the tone map.
    Display,
    /// Linear values, exposed, before the tone map.
    Linear,
}

impl Reads {
    /// `display` or `linear`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Display => "display",
            Self::Linear => "linear",
        }
    }
}

/// One metric of the registry. All look at red, green and blue only.
#[derive(Debug)]
pub struct Metric {
    /// The name a user asks for it by.
    pub name: &'static str,
    /// Name and version as results carry them. Figures of different ids must not be compared.
    pub id: &'static str,
    /// What it measures, in a line.
    pub summary: &'static str,
    /// The figure's unit; empty for a bare number.
    pub unit: &'static str,
    /// Which figures are good.
    pub better: Better,
    /// The values it reads.
    pub reads: Reads,
    figure: fn(&Pair<'_>) -> Figure,
}

impl Metric {
    /// The metric's figure for a pair; [`Figure::NonFinite`] if any pixel of it is NaN or infinite.
    #[must_use]
    pub fn evaluate(&self, pair: &Pair<'_>) -> Figure {
        if pair.is_finite() { (self.figure)(pair) } else { Figure::NonFinite }
    }
}

/// All metrics, in the order in which results list them.
pub const METRICS: &[Metric] = &[
    Metric {
        name: "psnr",
        id: "psnr/1",
        summary: "peak signal to noise ratio of display values, peak 1",
        unit: "dB",
        better: Better::Higher,
        reads: Reads::Display,
        figure: difference::psnr,
    },
    Metric {
        name: "ssim",
        id: "ssim-gaussian11/1",
        summary: "structural similarity of display values, Gaussian window of 11x11, mean of RGB",
        unit: "",
        better: Better::Higher,
        reads: Reads::Display,
        figure: ssim::ssim,
    },
    Metric {
        name: "flip",
        id: "flip-ldr/1.7@67.0206",
        summary: "mean FLIP error: how visible the difference is, 67.0206 pixels a degree",
        unit: "",
        better: Better::Lower,
        reads: Reads::Display,
        figure: flip::mean,
    },
    Metric {
        name: "flip-p99",
        id: "flip-ldr-p99/1.7@67.0206",
        summary: "FLIP error that 99 % of the pixels do not exceed, unweighted",
        unit: "",
        better: Better::Lower,
        reads: Reads::Display,
        figure: flip::percentile_99,
    },
    Metric {
        name: "max-error",
        id: "max-error/1",
        summary: "largest absolute difference of a display channel",
        unit: "1/255",
        better: Better::Lower,
        reads: Reads::Display,
        figure: difference::max_error,
    },
    Metric {
        name: "psnr-linear",
        id: "psnr-linear/1",
        summary: "peak signal to noise ratio of exposed linear values clamped to [0, 1], peak 1",
        unit: "dB",
        better: Better::Higher,
        reads: Reads::Linear,
        figure: difference::psnr_linear,
    },
    Metric {
        name: "rel-rmse",
        id: "rel-rmse/1",
        summary: "relative root mean square error of exposed linear values, sqrt(mean((T-R)^2/(R^2+0.01)))",
        unit: "",
        better: Better::Lower,
        reads: Reads::Linear,
        figure: difference::relative_rmse,
    },
    Metric {
        name: "energy",
        id: "energy/1",
        summary: "mean over the reference's mean, in exposed linear values",
        unit: "",
        better: Better::NearOne,
        reads: Reads::Linear,
        figure: difference::energy,
    },
];

/// The metric of that name.
///
/// # Errors
///
/// [`crate::Error::Request`] that lists the known names and suggests the nearest.
pub fn find(name: &str) -> Result<&'static Metric> {
    METRICS.iter().find(|metric| metric.name == name).ok_or_else(|| {
        let known: Vec<&str> = METRICS.iter().map(|metric| metric.name).collect();
        unknown("metric", name, &known)
    })
}
