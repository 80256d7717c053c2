//! What short runs of their own say of a method, beside its sequence.

use serde::{Deserialize, Serialize};

use crate::metrics::Figure;

/// The probes that were run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ProbeFigures {
    /// Whether a still picture stands still.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crawl: Option<CrawlFigures>,
    /// How a still picture gets better from frame to frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub convergence: Option<ConvergenceFigures>,
    /// How long a change of the light takes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response: Option<ResponseFigures>,
    /// How sharp the picture is at several speeds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sharpness: Option<Vec<SharpnessFigure>>,
    /// Where straight edges are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<PositionFigures>,
}

impl ProbeFigures {
    /// Whether none was run.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Standard deviation of a pixel over time in a still picture, in display values, after warming up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CrawlFigures {
    /// Mean over all pixels.
    pub mean: Figure,
    /// What 99.99 % of the pixels do not exceed.
    pub p9999: Figure,
}

/// PSNR of a still picture by the number of frames since a reset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceFigures {
    /// In dB after 1, 2, 3, ... frames.
    pub psnr: Vec<Figure>,
    /// In dB, squared errors pooled over the last sixteen frames.
    pub settled: Figure,
    /// After how many frames it is within half a dB of that for the first time.
    pub frames: Figure,
}

/// What is done of a change by the number of frames since all light was halved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResponseFigures {
    /// The share after 1, 2, 3, ... frames; not quite 1 in the end for a picture that is not the reference's.
    pub shares: Vec<Figure>,
    /// After how many frames it is nine tenths of the last share for the first time; `"inf"` if that is below 0.8.
    pub frames: Figure,
}

/// How sharp the picture is while it moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SharpnessFigure {
    /// In pixels a frame, to the right.
    pub pan_px: f64,
    /// Gradient energy over the reference's.
    pub ratio: Figure,
}

/// How far straight edges are from where they should be, in pixels across the edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PositionFigures {
    /// Root mean square over all angles and places along the edge.
    pub rms_px: Figure,
    /// Largest.
    pub max_px: Figure,
    /// Each angle by itself.
    pub angles: Vec<EdgeAngle>,
}

/// At one angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeAngle {
    /// Of the edge's normal from the horizontal.
    pub degrees: f64,
    /// Root mean square over the places along the edge.
    pub rms_px: Figure,
    /// Largest.
    pub max_px: Figure,
}
