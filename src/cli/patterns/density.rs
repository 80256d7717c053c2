//! A photo as the density of points: the darker, the more.

use std::path::Path;

use crate::error::Result;
use crate::picture::{LinearPicture, load};
use crate::sampling::Density;

/// Larger pictures are averaged down to about this many cells a side, which no number of points resolves.
const MOST_CELLS: u32 = 1024;

/// The picture in the middle of the square in its own proportions, black ink on white paper: where a share of the ink is to be, so
/// much of the light is missing. Nothing lies beside it.
pub(super) fn of_photo(path: &Path) -> Result<Density> {
    let picture = load(path)?.into_linear();
    let [width, height] = picture.size();
    let longest = width.max(height);
    let step = longest.div_ceil(MOST_CELLS);
    let side = longest.div_ceil(step);
    let [left, top] = [width, height].map(|extent| (side - extent.div_ceil(step)) / 2);
    let cells = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
    let ink = cells.map(|(x, y)| match (x.checked_sub(left), y.checked_sub(top)) {
        (Some(x), Some(y)) => mean_ink(&picture, [x * step, y * step], step),
        _ => 0.0,
    });
    Density::new(side, side, ink.collect())
}

/// Over a square of pixels, as far as it is in the picture. Transparent pixels are paper.
fn mean_ink(picture: &LinearPicture, [left, top]: [u32; 2], side: u32) -> f64 {
    let ends = [left + side, top + side];
    let (columns, rows) = (left..ends[0].min(picture.width()), top..ends[1].min(picture.height()));
    let pixels = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
    let ink = |[r, g, b, a]: [f32; 4]| {
        let light = 0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b);
        // NaN stays, so that it is refused.
        let ink = if light.is_nan() { light } else { 1.0 - light.clamp(0.0, 1.0) };
        ink * f64::from(a)
    };
    pixels.map(|(x, y)| ink(picture.pixel(x, y))).sum::<f64>() / f64::from(side * side)
}
