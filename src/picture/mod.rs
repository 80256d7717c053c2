//! Pictures in main memory, as types that carry their encoding, and the way to files and back.
//!
//! A [`LinearPicture`] holds linear light, a [`DisplayPicture`] holds sRGB-coded values; what expects one cannot be given the
//! other. Both are 32 bit floats, red, green, blue and alpha, the top row first. Alpha is coverage and is never coded.

mod apng;
mod atomic;
mod color_space;
mod encode;
mod file;
#[cfg(test)]
mod file_tests;
mod integers;
mod kind;
mod load;
mod raster;
mod rows;
mod save;
mod srgb;
#[cfg(test)]
mod tests;
mod texts;
mod tiff_pages;

pub use apng::{Apng, side_by_side};
pub use atomic::{write_atomically, write_bytes_atomically};
pub use color_space::ColorSpace;
pub use file::{Carried, PictureFile};
pub use integers::BitDepth;
pub use kind::{FileKind, Samples};
pub use load::{Loaded, MAX_PIXELS, MAX_SIDE, load, measure};
pub use raster::{Channels, Raster};
pub use rows::write_png_rows;
pub use save::{FileFormat, Metadata};
pub use srgb::{srgb_decode, srgb_encode};
pub use texts::{texts, with_png_texts};

use crate::{Error, Result};
use serde::{Deserialize, Serialize};
use std::marker::PhantomData;

/// Red, green, blue, alpha.
pub type Pixel = [f32; 4];

/// Marks a picture as linear light, scene-referred: 1 is not the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linear {}

/// Marks a picture as sRGB-coded, display-referred: [0, 1], not quantised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Display {}

/// A picture in linear light.
pub type LinearPicture = Picture<Linear>;

/// A picture as a display shows it.
pub type DisplayPicture = Picture<Display>;

/// A picture of at least one pixel, its values in the encoding `E`. Values may lie outside the encoding's range and may be NaN
/// or infinite: [`Picture::non_finite`] finds them.
#[derive(Clone, PartialEq)]
pub struct Picture<E> {
    size: [u32; 2],
    pixels: Vec<Pixel>,
    encoding: PhantomData<E>,
}

/// Pixels with a channel that is NaN or infinite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct NonFinite {
    /// How many, at least 1.
    pub pixels: u64,
    /// Column and row of the first in reading order.
    pub first: [u32; 2],
}

impl<E> Picture<E> {
    /// A picture of `width * height` pixels, the top row first.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if a side is 0 or the pixels are more or fewer.
    pub fn new(width: u32, height: u32, pixels: Vec<Pixel>) -> Result<Self> {
        check_side_lengths(width, height)?;
        if pixels.len() as u64 != u64::from(width) * u64::from(height) {
            let count = pixels.len();
            return Err(Error::Request(format!("{count} pixels do not fill a picture of {width}x{height}")));
        }
        Ok(Self::assemble([width, height], pixels))
    }

    /// A picture of `width * height` pixels, each computed from its column and row.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if a side is 0.
    pub fn from_fn(width: u32, height: u32, mut pixel: impl FnMut(u32, u32) -> Pixel) -> Result<Self> {
        check_side_lengths(width, height)?;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            pixels.extend((0..width).map(|x| pixel(x, y)));
        }
        Ok(Self::assemble([width, height], pixels))
    }

    /// Of parts that are known to fit.
    fn assemble(size: [u32; 2], pixels: Vec<Pixel>) -> Self {
        Self { size, pixels, encoding: PhantomData }
    }

    /// Width in pixels, at least 1.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Height in pixels, at least 1.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.size[1]
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// All pixels in reading order.
    #[must_use]
    pub fn pixels(&self) -> &[Pixel] {
        &self.pixels
    }

    /// The rows from the top, `width` pixels each.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, Pixel> {
        self.pixels.chunks_exact(self.width() as usize)
    }

    /// The pixel in column `x` and row `y`.
    ///
    /// # Panics
    ///
    /// If it lies outside.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Pixel {
        assert!(x < self.width(), "column {x} of a picture of {} columns", self.width());
        self.pixels[y as usize * self.width() as usize + x as usize]
    }

    /// The pixels, without the picture.
    #[must_use]
    pub fn into_pixels(self) -> Vec<Pixel> {
        self.pixels
    }

    /// Counts the pixels with a NaN or infinite channel, alpha included; none if all are finite.
    #[must_use]
    pub fn non_finite(&self) -> Option<NonFinite> {
        let broken = |pixel: &Pixel| !pixel.iter().all(|value| value.is_finite());
        let first = self.pixels.iter().position(broken)?;
        let pixels = self.pixels[first..].iter().filter(|pixel| broken(pixel)).count() as u64;
        let width = self.width() as usize;
        Some(NonFinite { pixels, first: [(first % width) as u32, (first / width) as u32] })
    }

    /// The part of `width` x `height` pixels whose top left pixel is (`x`, `y`).
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if a side is 0 or the part reaches outside.
    pub fn crop(&self, x: u32, y: u32, width: u32, height: u32) -> Result<Self> {
        let inside = |start: u32, length: u32, whole: u32| start.checked_add(length).is_some_and(|end| end <= whole);
        if !inside(x, width, self.width()) || !inside(y, height, self.height()) {
            let [whole_width, whole_height] = self.size;
            return Err(Error::Request(format!(
                "a crop of {width}x{height} at ({x}, {y}) reaches outside a picture of {whole_width}x{whole_height}"
            )));
        }
        Self::from_fn(width, height, |column, row| self.pixel(x + column, y + row))
    }

    /// Each pixel as a square of `factor` x `factor`, to look at crops.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if `factor` is 0 or the result would exceed [`MAX_SIDE`] or [`MAX_PIXELS`].
    pub fn magnify(&self, factor: u32) -> Result<Self> {
        let [width, height] = self.size.map(|side| u64::from(side) * u64::from(factor));
        if factor == 0 || width.max(height) > MAX_SIDE.into() || width * height > MAX_PIXELS {
            let [w, h] = self.size;
            return Err(Error::Request(format!("a picture of {w}x{h} cannot be magnified {factor} times")));
        }
        Self::from_fn(width as u32, height as u32, |x, y| self.pixel(x / factor, y / factor))
    }
}

impl<E> std::fmt::Debug for Picture<E> {
    /// Its encoding and size: nobody wants to read a million pixels.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let encoding = std::any::type_name::<E>().rsplit("::").next().unwrap_or_default();
        write!(f, "{encoding}Picture({}x{})", self.width(), self.height())
    }
}

fn check_side_lengths(width: u32, height: u32) -> Result<()> {
    if width == 0 || height == 0 {
        return Err(Error::Request(format!("a picture of {width}x{height} has no pixels; both sides must be at least 1")));
    }
    Ok(())
}
