//! FLIP: how visible the differences are to somebody who flips between the two pictures.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild: FLIP: A Difference Evaluator for
//! Alternating Images, Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020. The map comes from
//! the crate flip-rs, a port of version 1.7 of NVIDIA's; here it is pooled in f64.

use super::{Figure, Pair};
use crate::picture::{DisplayPicture, Pixel};
use crate::{Error, Result};

/// Pixels a degree of the visual field: 3840 pixels on 0.7 m, seen from 0.7 m, as NVIDIA's tool assumes. About 67.0206; it
/// is part of the metrics' ids, since figures at other values differ.
pub const PIXELS_PER_DEGREE: f32 = flip_rs::DEFAULT_PPD;

/// What a pixel is painted in an error map if it is NaN or infinite: a green that the map has no other use for.
pub const NON_FINITE_COLOUR: Pixel = [0.0, 1.0, 0.0, 1.0];

/// Mean FLIP error.
pub(super) fn mean(pair: &Pair<'_>) -> Figure {
    pair.flip_map().map_or(Figure::NotApplicable, |map| Figure::from(mean_of(map)))
}

/// The FLIP error that 99 % of the pixels do not exceed: every pixel counts the same (FLIP's own tool weights percentiles by
/// the error), linearly interpolated between the two nearest ranks.
pub(super) fn percentile_99(pair: &Pair<'_>) -> Figure {
    pair.flip_map().map_or(Figure::NotApplicable, |map| Figure::from(percentile(map, 0.99)))
}

pub(super) fn mean_of(map: &[f32]) -> f64 {
    map.iter().copied().map(f64::from).sum::<f64>() / map.len() as f64
}

fn percentile(map: &[f32], fraction: f64) -> f64 {
    let mut sorted = map.to_vec();
    sorted.sort_unstable_by(f32::total_cmp);
    let rank = fraction * (sorted.len() - 1) as f64;
    let (below, above) = (sorted[rank.floor() as usize], sorted[rank.ceil() as usize]);
    f64::from(below) + rank.fract() * (f64::from(above) - f64::from(below))
}

/// The FLIP error map in magma colours, 0 black to 1 pale yellow, the colours that FLIP's own tool uses. Pixels that are NaN or
/// infinite on either side are painted in [`NON_FINITE_COLOUR`].
///
/// # Errors
///
/// [`Error::Unsupported`] if the pictures are too large for FLIP, which happens beyond 28 million pixels.
pub fn error_map(pair: &Pair<'_>) -> Result<DisplayPicture> {
    let map = pair.flip_map().ok_or_else(|| {
        let [width, height] = pair.size();
        Error::Unsupported(format!("{width}x{height} pixels are too many for a FLIP map; compare a crop"))
    })?;
    let colours =
        map.iter().zip(pair.broken_pixels()).map(|(&error, broken)| if broken { NON_FINITE_COLOUR } else { magma(error) });
    let [width, height] = pair.size();
    DisplayPicture::new(width, height, colours.collect())
}

/// The magma colour of an error in [0, 1], which is clamped.
#[must_use]
pub fn magma(error: f32) -> Pixel {
    let [r, g, b] = flip_rs::MAGMA[(error.clamp(0.0, 1.0) * 255.0).round() as usize];
    [r, g, b, 1.0]
}

/// The error of each pixel in reading order. Pixels that are not finite are taken as black on both sides, so that the others
/// still have a map.
pub(super) fn compute_map(pair: &Pair<'_>, pixels_per_degree: f32) -> Option<Vec<f32>> {
    let broken = if pair.is_finite() { Vec::new() } else { pair.broken_pixels() };
    let sides = pair.display();
    let (candidate, reference) = (rgb(sides.candidate, &broken)?, rgb(sides.reference, &broken)?);
    flip_rs::ldr_flip(&reference, &candidate, pixels_per_degree).ok().map(flip_rs::ErrorMap::into_pixels)
}

fn rgb(picture: &DisplayPicture, broken: &[bool]) -> Option<flip_rs::RgbImage<f32>> {
    let is_broken = |index: usize| broken.get(index).copied().unwrap_or(false);
    let pixels = picture.pixels().iter().enumerate();
    let values = pixels.flat_map(|(i, &[r, g, b, _])| if is_broken(i) { [0.0; 3] } else { [r, g, b] }).collect();
    flip_rs::RgbImage::new(picture.width() as usize, picture.height() as usize, values).ok()
}
