//! A picture as its file stores it, for whoever compares files: no level is rounded, nothing takes more room than it did.

use super::file::{Facts, samples};
use super::load::{self, Refusal};
use super::{BitDepth, ColorSpace, DisplayPicture, Pixel};
use crate::Result;
use image::metadata::Orientation;
use image::{DynamicImage, ImageBuffer, ImageDecoder};
use std::path::Path;

/// A decoded picture, upright, in the depth and the channels of its file: 1 to 16 bytes a pixel.
#[derive(Debug, Clone)]
pub struct Raster {
    image: DynamicImage,
    space: ColorSpace,
}

/// All values of a raster, interleaved, row after row.
#[derive(Debug, Clone, Copy)]
pub enum Channels<'a> {
    /// Levels of 8 bits.
    Eight(&'a [u8]),
    /// Levels of 16 bits.
    Sixteen(&'a [u16]),
    /// Floats.
    Float(&'a [f32]),
}

impl Raster {
    /// Reads a PNG, JPEG, still WebP, single TIFF or OpenEXR picture, turned upright if its EXIF data say that it lies. The picture
    /// may take `max_bytes` when decoded, which its header tells before anything is allocated. While it is decoded a TIFF takes
    /// twice, and an OpenEXR or a picture that is turned up to twice its room.
    ///
    /// # Errors
    ///
    /// As [`load()`](super::load()); and [`crate::Error::Format`] for animations, TIFFs of several pages, and pictures that take
    /// more than `max_bytes`.
    pub fn read(path: &Path, max_bytes: u64) -> Result<Self> {
        load::open(path, |mut file, kind| {
            let facts = Facts::of(&mut file, kind)?;
            let mut decoder = load::decoder(file, kind)?;
            check_bytes(decoder.dimensions(), decoder.total_bytes(), max_bytes)?;
            let icc = decoder.icc_profile()?;
            let space = ColorSpace::of(samples(decoder.color_type(), false), icc, &facts);
            let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
            let mut image = DynamicImage::from_decoder(decoder)?;
            image.apply_orientation(orientation);
            Ok(Self { image, space })
        })
    }

    /// Display values rounded to levels of that depth, sRGB, with alpha.
    #[must_use]
    pub fn from_display(picture: &DisplayPicture, depth: BitDepth) -> Self {
        let [width, height] = picture.size();
        let full = "a picture has as many pixels as its size says";
        let image = match depth {
            BitDepth::Eight => ImageBuffer::from_raw(width, height, picture.to_rgba8()).map(DynamicImage::ImageRgba8),
            BitDepth::Sixteen => ImageBuffer::from_raw(width, height, picture.to_rgba16()).map(DynamicImage::ImageRgba16),
        };
        Self { image: image.expect(full), space: ColorSpace::Srgb }
    }

    /// Bytes that [`Self::read`] would hold of this file, as its header tells. No pixel is decoded.
    ///
    /// # Errors
    ///
    /// As [`Self::read`], as far as the header shows it.
    pub fn measure_bytes(path: &Path) -> Result<u64> {
        load::open(path, |file, kind| Ok(load::decoder(file, kind)?.total_bytes()))
    }

    /// What the values mean.
    #[must_use]
    pub fn space(&self) -> &ColorSpace {
        &self.space
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.image.width(), self.image.height()]
    }

    /// Channels of a pixel: 1 grey, 2 grey and alpha, 3 colours, 4 colours and alpha.
    #[must_use]
    pub fn channel_count(&self) -> usize {
        self.image.color().channel_count().into()
    }

    /// Whether the last channel is alpha.
    #[must_use]
    pub fn has_alpha(&self) -> bool {
        self.image.color().has_alpha()
    }

    /// All values.
    #[must_use]
    pub fn channels(&self) -> Channels<'_> {
        use DynamicImage as Image;
        match &self.image {
            Image::ImageLuma8(image) => Channels::Eight(image),
            Image::ImageLumaA8(image) => Channels::Eight(image),
            Image::ImageRgb8(image) => Channels::Eight(image),
            Image::ImageRgba8(image) => Channels::Eight(image),
            Image::ImageLuma16(image) => Channels::Sixteen(image),
            Image::ImageLumaA16(image) => Channels::Sixteen(image),
            Image::ImageRgb16(image) => Channels::Sixteen(image),
            Image::ImageRgba16(image) => Channels::Sixteen(image),
            Image::ImageRgb32F(image) => Channels::Float(image),
            Image::ImageRgba32F(image) => Channels::Float(image),
            other => unreachable!("no decoder makes {:?}", other.color()),
        }
    }

    /// The values of one pixel as the file stores them: levels, or floats.
    ///
    /// # Panics
    ///
    /// If the pixel lies outside.
    #[must_use]
    pub fn values(&self, [x, y]: [u32; 2]) -> Vec<f64> {
        let count = self.channel_count();
        let start = (y as usize * self.image.width() as usize + x as usize) * count;
        let own = start..start + count;
        match self.channels() {
            Channels::Eight(all) => all[own].iter().copied().map(f64::from).collect(),
            Channels::Sixteen(all) => all[own].iter().copied().map(f64::from).collect(),
            Channels::Float(all) => all[own].iter().copied().map(f64::from).collect(),
        }
    }

    /// A pixel as red, green, blue and alpha: levels as shares of the highest, floats as they are, a missing alpha 1.
    ///
    /// # Panics
    ///
    /// If it lies outside.
    #[must_use]
    pub fn pixel(&self, [x, y]: [u32; 2]) -> Pixel {
        let count = self.channel_count();
        let start = (y as usize * self.image.width() as usize + x as usize) * count;
        self.colors(start..start + count)[0]
    }

    /// Row `y` as red, green, blue and alpha: levels as shares of the highest, floats as they are, a missing alpha 1.
    ///
    /// # Panics
    ///
    /// If there is no such row.
    #[must_use]
    pub fn row(&self, y: u32) -> Vec<Pixel> {
        let length = self.image.width() as usize * self.channel_count();
        self.colors(y as usize * length..(y as usize + 1) * length)
    }

    /// The pixels that these values are.
    fn colors(&self, own: std::ops::Range<usize>) -> Vec<Pixel> {
        match self.channels() {
            Channels::Eight(all) => self.spread(&all[own], 1.0, |level| f32::from(level) / 255.0),
            Channels::Sixteen(all) => self.spread(&all[own], 1.0, |level| f32::from(level) / 65_535.0),
            Channels::Float(all) => self.spread(&all[own], 1.0, |value| value),
        }
    }

    /// Row `y` as levels of 16 bits, of which those of 8 bits are exact multiples; none if it holds floats.
    ///
    /// # Panics
    ///
    /// If there is no such row.
    #[must_use]
    pub fn row_of_levels(&self, y: u32) -> Option<Vec<[u16; 4]>> {
        let length = self.image.width() as usize * self.channel_count();
        let own = y as usize * length..(y as usize + 1) * length;
        match self.channels() {
            Channels::Eight(all) => Some(self.spread(&all[own], u16::MAX, |level| u16::from(level) * 257)),
            Channels::Sixteen(all) => Some(self.spread(&all[own], u16::MAX, |level| level)),
            Channels::Float(_) => None,
        }
    }

    fn spread<T: Copy, V: Copy>(&self, row: &[T], opaque: V, value: impl Fn(T) -> V) -> Vec<[V; 4]> {
        let pixels = row.chunks_exact(self.channel_count());
        pixels
            .map(|pixel| match *pixel {
                [l] => [value(l), value(l), value(l), opaque],
                [l, a] => [value(l), value(l), value(l), value(a)],
                [r, g, b] => [value(r), value(g), value(b), opaque],
                [r, g, b, a, ..] => [value(r), value(g), value(b), value(a)],
                [] => [opaque; 4],
            })
            .collect()
    }
}

fn check_bytes((width, height): (u32, u32), bytes: u64, max_bytes: u64) -> Result<(), Refusal> {
    if bytes > max_bytes {
        return Err(Refusal::Format(format!(
            "its {width}x{height} pixels take {}, and the limit for a picture is {}; raise the limit if the file can be trusted",
            in_words(bytes),
            in_words(max_bytes)
        )));
    }
    Ok(())
}

fn in_words(bytes: u64) -> String {
    match bytes >> 20 {
        0 => format!("{bytes} bytes"),
        mebibytes => format!("{mebibytes} MiB"),
    }
}
