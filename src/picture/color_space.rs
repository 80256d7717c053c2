//! What a file says its values mean. Equal numbers in two spaces are two colours.

use super::file::Facts;
use super::kind::Samples;
use png::{CodingIndependentCodePoints, Info, SourceChromaticities};
use std::fmt;

/// sRGB's gamma in a PNG, in 1/100000: what is written beside sRGB-coded values by those who do not mark them as such.
const SRGB_GAMMA: u32 = 45_455;

/// sRGB's white, red, green and blue in a PNG, x and y, in 1/100000.
const SRGB_PRIMARIES: [u32; 8] = [31_270, 32_900, 64_000, 33_000, 30_000, 60_000, 15_000, 6_000];

/// What values mean. Of several marks the one counts that the PNG specification prefers: cICP, a profile, sRGB, gAMA with cHRM.
#[derive(Debug, Clone, PartialEq)]
pub enum ColorSpace {
    /// sRGB-coded display values, marked as such or not marked at all.
    Srgb,
    /// Linear light, floats, with the primaries given or those of sRGB.
    Linear(Option<[f32; 8]>),
    /// An ICC profile, byte for byte.
    Icc(Vec<u8>),
    /// A PNG's gamma and primaries (white, red, green, blue; x and y), in 1/100000.
    Gamma(u32, Option<[u32; 8]>),
    /// A PNG's code points of primaries and transfer, and whether the range is full.
    CodePoints(u8, u8, bool),
}

impl ColorSpace {
    pub(super) fn of(samples: Samples, icc: Option<Vec<u8>>, facts: &Facts) -> Self {
        let png = facts.png.as_deref();
        match (png.and_then(|info| info.coding_independent_code_points), icc) {
            (Some(points), _) => Self::of_code_points(points),
            (None, Some(profile)) => Self::Icc(profile),
            (None, None) if !matches!(samples, Samples::Levels(_)) => Self::Linear(facts.primaries.map(|primaries| {
                let points = [primaries.white, primaries.red, primaries.green, primaries.blue];
                std::array::from_fn(|i| if i % 2 == 0 { points[i / 2].x() } else { points[i / 2].y() })
            })),
            (None, None) => png.map_or(Self::Srgb, Self::of_png),
        }
    }

    fn of_code_points(points: CodingIndependentCodePoints) -> Self {
        // 1 and 13 are the primaries and the transfer of sRGB.
        match (points.color_primaries, points.transfer_function, points.is_video_full_range_image) {
            (1, 13, true) => Self::Srgb,
            (primaries, transfer, full) => Self::CodePoints(primaries, transfer, full),
        }
    }

    fn of_png(info: &Info<'_>) -> Self {
        let primaries = info.chrm_chunk.map(scaled).filter(|primaries| *primaries != SRGB_PRIMARIES);
        match info.gama_chunk.map(png::ScaledFloat::into_scaled) {
            _ if info.srgb.is_some() => Self::Srgb,
            None | Some(SRGB_GAMMA) if primaries.is_none() => Self::Srgb,
            gamma => Self::Gamma(gamma.unwrap_or(SRGB_GAMMA), primaries),
        }
    }

    /// Whether values are light itself rather than coded for a display.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        matches!(self, Self::Linear(_))
    }
}

fn scaled(points: SourceChromaticities) -> [u32; 8] {
    let points = [points.white, points.red, points.green, points.blue];
    std::array::from_fn(|i| if i % 2 == 0 { points[i / 2].0 } else { points[i / 2].1 }.into_scaled())
}

impl fmt::Display for ColorSpace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Srgb => f.write_str("sRGB"),
            Self::Linear(None) => f.write_str("linear light"),
            Self::Linear(Some(primaries)) => write!(f, "linear light with primaries {primaries:?}"),
            Self::Icc(profile) => {
                let hash = blake3::hash(profile).to_hex();
                write!(f, "an ICC profile of {} bytes (BLAKE3 {})", profile.len(), &hash[..12])
            }
            Self::Gamma(gamma, None) => write!(f, "gamma {}", f64::from(*gamma) / 1e5),
            Self::Gamma(gamma, Some(primaries)) => write!(f, "gamma {} with primaries {primaries:?}", f64::from(*gamma) / 1e5),
            Self::CodePoints(primaries, transfer, full) => {
                let range = if *full { "full" } else { "video" };
                write!(f, "code points {primaries}/{transfer} of {range} range")
            }
        }
    }
}
