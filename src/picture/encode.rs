//! Pictures back into files of the kind they came from, or of another, with all that the new file can hold.

use super::integers::level;
use super::kind::Samples;
use super::save::png_failure;
use super::{BitDepth, Carried, DisplayPicture, FileKind, Loaded, PictureFile, Pixel, write_atomically};
use crate::{Error, Result};
use image::codecs::{jpeg::JpegEncoder, webp::WebPEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::Path;

type Out<'a, 'f> = &'a mut BufWriter<&'f File>;

/// What one segment of a JPEG holds of EXIF data, in bytes.
const MAX_JPEG_EXIF: usize = 65_527;

impl PictureFile {
    /// Writes the picture as a file of this kind, whole or not at all, in the encoding of its pixels: OpenEXR wants linear light,
    /// the others display values ([`PictureFile::encoded_for`]). Bit depth, greys, alpha, colour profile and EXIF data are kept as
    /// far as the kind can ([`Carried::losses`]). `jpeg_quality` goes from 1 to 100. The same picture always gives the same bytes.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] for transparent pixels or a side that the kind cannot hold, and for pixels in the wrong encoding;
    /// [`Error::Io`] if the file cannot be written. Nothing is left behind then.
    pub fn save(&self, path: &Path, kind: FileKind, jpeg_quality: u8) -> Result<()> {
        let ([width, height], limit) = (self.picture.size(), kind.max_side());
        if width.max(height) > limit {
            return Err(Error::Request(format!(
                "{}: {width}x{height} is more than {kind} holds, {limit} pixels a side; write a .png or .exr file",
                path.display()
            )));
        }
        match (&self.picture, kind) {
            (_, FileKind::Tiff) => {
                Err(Error::Request(format!("{}: TIFF is read but not written; write a .png or .exr file", path.display())))
            }
            (Loaded::Linear(picture), FileKind::Exr) => {
                let alpha = self.carried.alpha || !is_opaque(picture.pixels());
                let half = self.carried.samples == Samples::Half;
                write_atomically(path, |out| picture.encode_exr_as(out, half, alpha, self.carried.primaries))
            }
            (Loaded::Display(picture), FileKind::Png | FileKind::Jpeg | FileKind::WebP) => {
                let form = Form::of(&self.carried, picture, kind, path)?;
                write_atomically(path, |out| form.write(&self.carried, picture, kind, jpeg_quality, out))
            }
            _ => Err(Error::Request(format!("{}: {kind} holds pixels in another encoding; convert them first", path.display()))),
        }
    }
}

impl FileKind {
    pub(super) fn keeps_grey(self) -> bool {
        matches!(self, Self::Png | Self::Jpeg)
    }
}

/// What of a pixel is written, and how.
#[derive(Debug, Clone, Copy)]
struct Form {
    grey: bool,
    alpha: bool,
    depth: BitDepth,
}

impl Form {
    fn of(carried: &Carried, picture: &DisplayPicture, kind: FileKind, path: &Path) -> Result<Self> {
        let opaque = is_opaque(picture.pixels());
        if kind == FileKind::Jpeg && !opaque {
            return Err(Error::Request(format!(
                "{}: it has transparent pixels, which JPEG cannot hold; write a .png, .webp or .exr file",
                path.display()
            )));
        }
        let deep = carried.samples != Samples::Levels(BitDepth::Eight) && kind == FileKind::Png;
        Ok(Self {
            // A profile of colours fits no greys.
            grey: carried.grey && kind.keeps_grey() && carried.profile_kind() != Some(b"RGB ") && is_grey(picture.pixels()),
            alpha: kind != FileKind::Jpeg && (carried.alpha || !opaque),
            depth: if deep { BitDepth::Sixteen } else { BitDepth::Eight },
        })
    }

    fn write(self, carried: &Carried, picture: &DisplayPicture, kind: FileKind, quality: u8, out: Out<'_, '_>) -> io::Result<()> {
        match kind {
            FileKind::Png => self.write_png(carried, picture, out),
            FileKind::Jpeg => {
                let mut encoder = JpegEncoder::new_with_quality(out, quality);
                let exif = carried.exif.clone().filter(|exif| exif.len() <= MAX_JPEG_EXIF);
                self.describe(carried, &mut encoder, exif)?;
                self.write_bytes(picture, encoder)
            }
            _ => {
                let mut encoder = WebPEncoder::new_lossless(out);
                self.describe(carried, &mut encoder, carried.exif.clone())?;
                self.write_bytes(picture, encoder)
            }
        }
    }

    fn describe(self, carried: &Carried, encoder: &mut impl ImageEncoder, exif: Option<Vec<u8>>) -> io::Result<()> {
        let failed = |error: image::error::UnsupportedError| io::Error::other(error.to_string());
        if let Some(icc) = self.profile(carried) {
            encoder.set_icc_profile(icc.to_vec()).map_err(failed)?;
        }
        exif.map_or(Ok(()), |exif| encoder.set_exif_metadata(exif).map_err(failed))
    }

    /// The colour profile, if it describes what is written.
    fn profile(self, carried: &Carried) -> Option<&[u8]> {
        let wanted = if self.grey { b"GRAY" } else { b"RGB " };
        carried.icc.as_deref().filter(|_| carried.profile_kind() == Some(wanted))
    }

    fn write_bytes(self, picture: &DisplayPicture, encoder: impl ImageEncoder) -> io::Result<()> {
        let color = match (self.grey, self.alpha) {
            (true, false) => ExtendedColorType::L8,
            (true, true) => ExtendedColorType::La8,
            (false, false) => ExtendedColorType::Rgb8,
            (false, true) => ExtendedColorType::Rgba8,
        };
        encoder.write_image(&self.bytes(picture), picture.width(), picture.height(), color).map_err(|error| match error {
            ImageError::IoError(source) => source,
            other => io::Error::other(other.to_string()),
        })
    }

    fn write_png(self, carried: &Carried, picture: &DisplayPicture, out: Out<'_, '_>) -> io::Result<()> {
        let info = self.png_info(carried, picture.size());
        let cicp = info.coding_independent_code_points;
        let mut encoder = png::Encoder::with_info(out, info).map_err(png_failure)?;
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header().map_err(png_failure)?;
        if let Some(points) = cicp {
            // The encoder leaves this one out; its matrix is always that of RGB.
            let full = u8::from(points.is_video_full_range_image);
            let bytes = [points.color_primaries, points.transfer_function, 0, full];
            writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &bytes).map_err(png_failure)?;
        }
        writer.write_image_data(&self.bytes(picture)).map_err(png_failure)?;
        writer.finish().map_err(png_failure)
    }

    /// The chunks of the PNG that the picture came from, or what any other says of itself.
    fn png_info(self, carried: &Carried, [width, height]: [u32; 2]) -> png::Info<'static> {
        let mut info = carried.png.as_deref().cloned().unwrap_or_default();
        (info.width, info.height) = (width, height);
        info.bit_depth = if self.depth == BitDepth::Sixteen { png::BitDepth::Sixteen } else { png::BitDepth::Eight };
        info.color_type = match (self.grey, self.alpha) {
            (true, false) => png::ColorType::Grayscale,
            (true, true) => png::ColorType::GrayscaleAlpha,
            (false, false) => png::ColorType::Rgb,
            (false, true) => png::ColorType::Rgba,
        };
        // The decoder leaves these in one place, the encoder takes them from another.
        (info.source_gamma, info.source_chromaticities) = (info.gama_chunk, info.chrm_chunk);
        info.exif_metadata = carried.exif.clone().map(Into::into);
        info.icc_profile = self.profile(carried).map(|icc| icc.to_vec().into());
        if info.icc_profile.is_some() {
            // The profile outranks this mark, and the encoder would write the mark alone.
            info.srgb = None;
        } else if carried.png.is_none() {
            info.srgb = Some(png::SrgbRenderingIntent::RelativeColorimetric);
        }
        // About pixels as the old file packed them.
        info.interlaced = false;
        (info.palette, info.trns, info.sbit, info.bkgd) = (None, None, None, None);
        info
    }

    /// Channels in the file's order; 16 bit levels with the high byte first.
    fn bytes(self, picture: &DisplayPicture) -> Vec<u8> {
        let channels: &[usize] = match (self.grey, self.alpha) {
            (true, false) => &[0],
            (true, true) => &[0, 3],
            (false, false) => &[0, 1, 2],
            (false, true) => &[0, 1, 2, 3],
        };
        let values = picture.pixels().iter().flat_map(|pixel| channels.iter().map(|&channel| pixel[channel]));
        match self.depth {
            BitDepth::Eight => values.map(|value| level(value, 255) as u8).collect(),
            BitDepth::Sixteen => values.flat_map(|value| level(value, 65_535).to_be_bytes()).collect(),
        }
    }
}

fn is_opaque(pixels: &[Pixel]) -> bool {
    pixels.iter().all(|pixel| pixel[3] >= 1.0)
}

fn is_grey(pixels: &[Pixel]) -> bool {
    pixels.iter().all(|[r, g, b, _]| r == g && g == b)
}
