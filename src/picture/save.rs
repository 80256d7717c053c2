//! Pictures into files: display values as PNG, linear ones as OpenEXR, with what made them as metadata.

use super::{BitDepth, DisplayPicture, LinearPicture, Pixel, write_atomically};
use crate::{Error, Result};
use exr::image::write::channels::WritableChannels;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{Encoding, Image, ImageAttributes, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage, f16};
use std::io::{self, Seek, Write};
use std::path::Path;

/// Keys and values that are stored beside the pixels, such as the scene, the method and the adapter. Keys are ASCII, at most 79
/// characters; values are any text.
pub type Metadata<'a> = &'a [(&'a str, &'a str)];

/// A format that pictures are written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FileFormat {
    /// `.png`: display values, 8 or 16 bits a channel.
    Png,
    /// `.exr`: linear values, 32 bit floats.
    Exr,
}

impl FileFormat {
    /// The format that a path's extension asks for, in any case.
    ///
    /// # Errors
    ///
    /// [`Error::Request`], listing what exists, if there is no extension or another one.
    pub fn of_path(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            given => {
                let given = given.map_or("has no extension".into(), |given| format!("ends in .{given}"));
                let path = path.display();
                Err(Error::Request(format!(
                    "{path} {given}; pictures are written as .png (display values) or .exr (linear values)"
                )))
            }
        }
    }
}

impl DisplayPicture {
    /// Writes a PNG, whole or not at all: RGBA, marked as sRGB, with `metadata` as text chunks.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written; nothing is left behind then.
    pub fn save_png(&self, path: &Path, depth: BitDepth, metadata: Metadata<'_>) -> Result<()> {
        write_atomically(path, |file| self.encode_png(file, depth, metadata))
    }

    /// Writes the bytes of [`Self::save_png`] to any writer. The same picture and metadata always give the same bytes.
    ///
    /// # Errors
    ///
    /// Whatever the writer fails with, and `InvalidInput` for a metadata key that PNG does not allow.
    pub fn encode_png(&self, writer: impl Write, depth: BitDepth, metadata: Metadata<'_>) -> io::Result<()> {
        let (bits, bytes) = match depth {
            BitDepth::Eight => (png::BitDepth::Eight, self.to_rgba8()),
            BitDepth::Sixteen => (png::BitDepth::Sixteen, self.to_rgba16().into_iter().flat_map(u16::to_be_bytes).collect()),
        };
        let mut encoder = png::Encoder::new(writer, self.width(), self.height());
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(bits);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        for &(key, value) in metadata {
            add_text(&mut encoder, key, value).map_err(png_failure)?;
        }
        let mut writer = encoder.write_header().map_err(png_failure)?;
        writer.write_image_data(&bytes).map_err(png_failure)?;
        writer.finish().map_err(png_failure)
    }
}

/// The plain text chunk that every reader knows, where the text allows it, else the Unicode one.
pub(super) fn add_text<W: Write>(encoder: &mut png::Encoder<'_, W>, key: &str, value: &str) -> Result<(), png::EncodingError> {
    if value.is_ascii() {
        encoder.add_text_chunk(key.into(), value.into())
    } else {
        encoder.add_itxt_chunk(key.into(), value.into())
    }
}

pub(super) fn png_failure(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(source) => source,
        other => io::Error::new(io::ErrorKind::InvalidInput, other),
    }
}

impl LinearPicture {
    /// Writes an OpenEXR file, whole or not at all: red, green, blue and alpha as 32 bit floats, losslessly compressed, with
    /// `metadata` as lines of `key: value` in the standard `comments` attribute.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written; nothing is left behind then.
    pub fn save_exr(&self, path: &Path, metadata: Metadata<'_>) -> Result<()> {
        write_atomically(path, |file| self.encode_exr(file, metadata))
    }

    /// Writes the bytes of [`Self::save_exr`] to any writer. The same picture and metadata always give the same bytes.
    ///
    /// # Errors
    ///
    /// Whatever the writer fails with.
    pub fn encode_exr(&self, writer: impl Write + Seek, metadata: Metadata<'_>) -> io::Result<()> {
        let channels = SpecificChannels::rgba(|at| {
            let [r, g, b, a] = self.at(at);
            (r, g, b, a)
        });
        write_exr(&self.exr(channels, comments(metadata), None), writer)
    }

    /// Without metadata: as halves, which take half the room, and without an alpha of ones, if asked for.
    pub(super) fn encode_exr_as(
        &self,
        writer: impl Write + Seek,
        half: bool,
        alpha: bool,
        primaries: Option<Chromaticities>,
    ) -> io::Result<()> {
        let plain = LayerAttributes::default();
        let rgb = |at| {
            let [r, g, b, _] = self.at(at);
            (r, g, b)
        };
        let rgba = |at| {
            let [r, g, b, a] = self.at(at);
            (r, g, b, a)
        };
        let half_rgb = |at| {
            let [r, g, b, _] = self.at(at).map(f16::from_f32);
            (r, g, b)
        };
        let half_rgba = |at| {
            let [r, g, b, a] = self.at(at).map(f16::from_f32);
            (r, g, b, a)
        };
        match (half, alpha) {
            (false, false) => write_exr(&self.exr(SpecificChannels::rgb(rgb), plain, primaries), writer),
            (false, true) => write_exr(&self.exr(SpecificChannels::rgba(rgba), plain, primaries), writer),
            (true, false) => write_exr(&self.exr(SpecificChannels::rgb(half_rgb), plain, primaries), writer),
            (true, true) => write_exr(&self.exr(SpecificChannels::rgba(half_rgba), plain, primaries), writer),
        }
    }

    fn at(&self, at: Vec2<usize>) -> Pixel {
        self.pixel(at.x() as u32, at.y() as u32)
    }

    fn exr<C>(&self, channel_data: C, attributes: LayerAttributes, primaries: Option<Chromaticities>) -> Image<Layer<C>> {
        let size = Vec2(self.width() as usize, self.height() as usize);
        let layer_data = Layer { channel_data, attributes, size, encoding: Encoding::SMALL_LOSSLESS };
        let mut attributes = ImageAttributes::with_size(size);
        attributes.chromaticities = primaries;
        Image { attributes, layer_data }
    }
}

fn write_exr<'i, C: WritableChannels<'i>>(image: &'i Image<Layer<C>>, writer: impl Write + Seek) -> io::Result<()> {
    image.write().to_buffered(writer).map_err(|error| match error {
        exr::error::Error::Io(source) => source,
        other => io::Error::other(other.to_string()),
    })
}

/// One attribute for all: the encoder keeps attributes of one's own in random order, which would change the file's bytes.
fn comments(metadata: Metadata<'_>) -> LayerAttributes {
    let lines: Vec<String> = metadata.iter().map(|(key, value)| format!("{key}: {value}")).collect();
    let text = lines.join("\n");
    let ascii: String = text.chars().map(|c| if c.is_ascii() { c } else { '?' }).collect();
    let text = Text::new_or_none(&text).or_else(|| Text::new_or_none(&ascii));
    LayerAttributes { comments: text.filter(|_| !metadata.is_empty()), ..LayerAttributes::default() }
}
