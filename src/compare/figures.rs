//! Figures of metrics over a pair, a strip at a time: a picture in floats would take many times its room.

use super::sides::Sides;
use crate::Result;
use crate::metrics::{Figure, MARGIN, Mean, Pair, Strip, Sum};
use crate::picture::{Channels, DisplayPicture, LinearPicture, Pixel, Raster};
use rayon::prelude::*;

/// Pixels of a strip, about; each takes some 200 bytes while it is measured.
const STRIP_PIXELS: u32 = 1 << 20;

/// A black and a white wall behind transparent pictures: on one of the two whatever changes is seen.
const WALLS: [f32; 2] = [0.0, 1.0];

/// The figure of each of these metrics, over the pixels that count. Pictures with transparency are seen before black and before
/// white, and the worse figure holds.
///
/// # Errors
///
/// What `watch` answers between strips.
pub(super) fn figures(sides: &Sides<'_>, means: &[Mean], watch: fn() -> Result<()>) -> Result<Vec<Figure>> {
    if means.is_empty() {
        return Ok(Vec::new());
    }
    let walls = if sides.have_alpha() { &WALLS[..] } else { &WALLS[..1] };
    let mut worst: Vec<Figure> = Vec::new();
    for &wall in walls {
        let found = before(sides, means, wall, watch)?;
        worst = if worst.is_empty() {
            found
        } else {
            means.iter().zip(worst.into_iter().zip(found)).map(|(mean, (a, b))| worse(*mean, a, b)).collect()
        };
    }
    Ok(worst)
}

fn worse(mean: Mean, a: Figure, b: Figure) -> Figure {
    match (a.number(), b.number()) {
        (None, _) => a,
        (_, None) => b,
        (Some(x), Some(y)) => {
            let higher_is_worse = mean == Mean::Flip;
            if (x > y) == higher_is_worse { a } else { b }
        }
    }
}

fn before(sides: &Sides<'_>, means: &[Mean], wall: f32, watch: fn() -> Result<()>) -> Result<Vec<Figure>> {
    let [width, height] = sides.size();
    let step = (STRIP_PIXELS / width).max(2 * MARGIN);
    let mut sums = vec![Sum::default(); means.len()];
    for top in (0..height).step_by(step as usize) {
        watch()?;
        let bottom = height.min(top.saturating_add(step));
        let (start, end) = (top.saturating_sub(MARGIN), height.min(bottom + MARGIN));
        let seen = Seen::of(sides, start..end, wall)?;
        let pair = Pair::new(&seen.actual, &seen.expected)?;
        let strip = Strip { pair: &pair, rows: (top - start) as usize..(bottom - start) as usize, counted: &seen.counted };
        for (sum, mean) in sums.iter_mut().zip(means) {
            sum.add(mean.sum(&strip));
        }
    }
    Ok(means.iter().zip(&sums).map(|(mean, sum)| mean.figure(sum)).collect())
}

/// Some rows of both pictures as a display shows them.
struct Seen {
    expected: DisplayPicture,
    actual: DisplayPicture,
    /// Empty if all count.
    counted: Vec<bool>,
}

impl Seen {
    fn of(sides: &Sides<'_>, rows: std::ops::Range<u32>, wall: f32) -> Result<Self> {
        let [width, height] = [sides.size()[0], rows.end - rows.start];
        let mut expected = shown(sides.expected, rows.clone(), wall);
        let mut actual = shown(sides.actual, rows.clone(), wall);
        let counted: Vec<bool> = rows.filter_map(|y| sides.scope.row(y, width)).flatten().collect();
        for (index, _) in counted.iter().enumerate().filter(|(_, counts)| !**counts) {
            // What does not count must not reach those that do through a filter.
            if expected[index].iter().any(|value| !value.is_finite()) {
                expected[index] = [0.0, 0.0, 0.0, 1.0];
            }
            actual[index] = expected[index];
        }
        let picture = |pixels| DisplayPicture::new(width, height, pixels);
        Ok(Self { expected: picture(expected)?, actual: picture(actual)?, counted })
    }
}

fn shown(raster: &Raster, rows: std::ops::Range<u32>, wall: f32) -> Vec<Pixel> {
    let rows: Vec<Vec<Pixel>> = rows.into_par_iter().map(|y| display_row(raster, y, |_| wall)).collect();
    rows.concat()
}

/// A row as a display shows it, before a wall of a grey that may differ from column to column.
pub(super) fn display_row(raster: &Raster, y: u32, wall: impl Fn(usize) -> f32) -> Vec<Pixel> {
    let mut row = raster.row(y);
    if raster.has_alpha() {
        let light = matches!(raster.channels(), Channels::Float(_));
        for (x, pixel) in row.iter_mut().enumerate() {
            let ([r, g, b, a], behind) = (*pixel, wall(x));
            // Floats are light that arrives already weighted by its coverage, levels are colours that are still to be.
            let over = |value: f32| if light { value + (1.0 - a) * behind } else { a * value + (1.0 - a) * behind };
            *pixel = [over(r), over(g), over(b), 1.0];
        }
    }
    if matches!(raster.channels(), Channels::Float(_)) {
        let linear = LinearPicture::new(raster.size()[0], 1, row).map(|row| row.to_display().into_pixels());
        return linear.unwrap_or_default();
    }
    row
}
