//! Pictures of a comparison: made a row at a time, so that they need no memory to speak of.

use super::edges::Classes;
use super::figures::display_row;
use super::sides::Sides;
use crate::metrics::magma;
use crate::picture::{Apng, DisplayPicture, Pixel, Raster, write_png_rows};
use crate::{Error, Result};
use std::fs;
use std::path::PathBuf;

/// Between the pictures of a triptych.
const GAP_PX: u32 = 4;

/// For how long a frame of a flip-book is shown.
const FRAME_S: f64 = 0.5;

/// Side of the squares that stand behind transparent pixels.
const SQUARE_PX: usize = 8;

/// Where pictures of a pair are written, each if it is asked for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Targets {
    /// A PNG: the expected picture dark and grey, differing pixels from purple to pale yellow by the root of their difference,
    /// resampled edges in blue, and what does not count in green.
    pub heat: Option<PathBuf>,
    /// A PNG: expected, actual and heat map side by side.
    pub triptych: Option<PathBuf>,
    /// An animated PNG: expected and actual by turns. While it is written it takes 19 bytes a pixel.
    pub flip_book: Option<PathBuf>,
}

impl Targets {
    /// All that are asked for.
    pub fn all(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.heat, &self.triptych, &self.flip_book].into_iter().flatten()
    }
}

/// Writes what is asked for, and says where.
pub(super) fn write(sides: &Sides<'_>, classes: Option<&Classes>, per_channel: f64, targets: &Targets) -> Result<Vec<String>> {
    for folder in targets.all().filter_map(|path| path.parent()) {
        fs::create_dir_all(folder).map_err(Error::io("create the folder", folder))?;
    }
    let heat = Heat { sides, classes, per_channel };
    let [width, height] = sides.size();
    if let Some(path) = &targets.heat {
        write_png_rows(path, [width, height], |y| heat.row(y))?;
    }
    if let Some(path) = &targets.triptych {
        write_png_rows(path, [3 * width + 2 * GAP_PX, height], |y| {
            let gap = vec![[0.1, 0.1, 0.1, 1.0]; GAP_PX as usize];
            [before_squares(sides.expected, y), gap.clone(), before_squares(sides.actual, y), gap, heat.row(y)].concat()
        })?;
    }
    if let Some(path) = &targets.flip_book {
        let mut book = Apng::begin(path, [width, height], 2, FRAME_S)?;
        for side in [sides.expected, sides.actual] {
            let pixels = (0..height).flat_map(|y| before_squares(side, y)).collect();
            book.add(&DisplayPicture::new(width, height, pixels)?)?;
        }
        book.finish()?;
    }
    Ok(targets.all().map(|path| path.to_string_lossy().into_owned()).collect())
}

/// A row as a display shows it, transparent parts before two greys in squares.
fn before_squares(raster: &Raster, y: u32) -> Vec<Pixel> {
    display_row(raster, y, |x| if (x / SQUARE_PX + y as usize / SQUARE_PX).is_multiple_of(2) { 0.4 } else { 0.6 })
}

struct Heat<'a> {
    sides: &'a Sides<'a>,
    classes: Option<&'a Classes>,
    per_channel: f64,
}

impl Heat<'_> {
    fn row(&self, y: u32) -> Vec<Pixel> {
        let mut row: Vec<Pixel> = before_squares(self.sides.expected, y).into_iter().map(dark).collect();
        if let Some(counted) = self.sides.scope.row(y, self.sides.size()[0]) {
            for (pixel, _) in row.iter_mut().zip(counted).filter(|(_, counts)| !counts) {
                pixel[1] += 0.15;
            }
        }
        self.sides.differing_in_row(y, |gap| {
            if gap.largest > self.per_channel {
                // Even the least difference stands out from the dark picture behind it.
                let strength = 0.3 + 0.7 * gap.largest.min(1.0).sqrt() as f32;
                let edge = self.classes.is_some_and(|classes| !classes.is_object(gap.x as u32, y));
                row[gap.x] = if edge { [0.1, 0.6 * strength, strength, 1.0] } else { magma(strength) };
            }
        });
        row
    }
}

/// A quarter of its luma.
fn dark([r, g, b, _]: Pixel) -> Pixel {
    let luma = 0.25 * (0.2126 * r + 0.7152 * g + 0.0722 * b);
    [luma, luma, luma, 1.0]
}
