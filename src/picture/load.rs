//! Pictures from files: PNG, JPEG, WebP and TIFF hold display values, OpenEXR and float TIFF linear ones. The bytes decide, not the
//! name.

use super::{DisplayPicture, FileKind, LinearPicture};
use crate::{Error, Result};
use exr::meta::MetaData;
use image::{DynamicImage, ImageDecoder, ImageError, ImageReader, Limits};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek};
use std::path::Path;

/// Most pixels of a picture that is read: 16 384 x 16 384.
pub const MAX_PIXELS: u64 = 1 << 28;

/// Longest side of a picture that is read, in pixels.
pub const MAX_SIDE: u32 = 1 << 17;

/// What a decoder may allocate: the largest picture at 16 bytes a pixel, and as much again to work with.
const MAX_BYTES: u64 = 2 * 16 * MAX_PIXELS;

/// A picture in the encoding its file has.
#[derive(Debug, Clone, PartialEq)]
pub enum Loaded {
    /// sRGB-coded values, from PNG, JPEG, WebP or TIFF.
    Display(DisplayPicture),
    /// Linear values, from OpenEXR or TIFF of floats.
    Linear(LinearPicture),
}

impl Loaded {
    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        match self {
            Self::Display(picture) => picture.size(),
            Self::Linear(picture) => picture.size(),
        }
    }

    /// Display values; linear ones are clamped and sRGB-coded.
    #[must_use]
    pub fn into_display(self) -> DisplayPicture {
        match self {
            Self::Display(picture) => picture,
            Self::Linear(picture) => picture.to_display(),
        }
    }

    /// Linear values; display ones are decoded.
    #[must_use]
    pub fn into_linear(self) -> LinearPicture {
        match self {
            Self::Display(picture) => picture.to_linear(),
            Self::Linear(picture) => picture,
        }
    }
}

/// Reads a PNG (any depth and colour type), a JPEG, a still WebP, a TIFF or an OpenEXR picture with RGB(A) channels. Integer values are
/// taken as sRGB-coded whatever gamma or profile the file carries, pixels as they lie whatever its orientation, and a missing
/// alpha is 1. [`super::PictureFile`] reads what this leaves out.
///
/// # Errors
///
/// [`Error::Io`] if the file is absent or unreadable; [`Error::Format`] if its bytes are no such picture, are damaged or cut
/// short, or if it is larger than [`MAX_SIDE`] or [`MAX_PIXELS`], which is found out before its pixels are allocated.
pub fn load(path: &Path) -> Result<Loaded> {
    open(path, |file, kind| from_image(DynamicImage::from_decoder(decoder(file, kind)?)?))
}

/// Width and height of a picture in pixels as its header states them, before any turning. No pixel is decoded.
///
/// # Errors
///
/// As [`load()`], as far as the header shows it.
pub fn measure(path: &Path) -> Result<[u32; 2]> {
    open(path, |file, kind| {
        let (width, height) = decoder(file, kind)?.dimensions();
        Ok([width, height])
    })
}

/// Opens a file, finds out its kind and lets `read` have it from the beginning.
pub(super) fn open<T>(path: &Path, read: impl FnOnce(BufReader<File>, FileKind) -> Result<T, Refusal>) -> Result<T> {
    let mut file = BufReader::new(File::open(path).map_err(Error::io("read", path))?);
    let mut start = Vec::new();
    file.by_ref().take(64).read_to_end(&mut start).map_err(Error::io("read", path))?;
    let kind =
        FileKind::of_bytes(&start).map_err(|message| format_error(path, "PNG, JPEG, WebP, TIFF or OpenEXR picture", message))?;
    file.rewind().map_err(Error::io("read", path))?;
    read(file, kind).map_err(|refusal| match refusal {
        Refusal::Io(source) => Error::io("read", path)(source),
        Refusal::Format(message) => format_error(path, kind.expected(), message),
    })
}

fn format_error(path: &Path, expected: &'static str, message: String) -> Error {
    Error::Format { path: path.to_path_buf(), expected, message }
}

/// Why a file gave no picture: the system's fault, or its bytes'.
pub(super) enum Refusal {
    Io(io::Error),
    Format(String),
}

impl From<ImageError> for Refusal {
    fn from(error: ImageError) -> Self {
        match error {
            // Decoders report a cut-off file as a failed read.
            ImageError::IoError(source) if source.kind() == io::ErrorKind::UnexpectedEof => {
                Self::Format("it ends before the picture does".into())
            }
            ImageError::IoError(source) if source.raw_os_error().is_some() => Self::Io(source),
            ImageError::Limits(_) => Self::Format(format!("it is too large; {}", limits_in_words())),
            other => Self::Format(other.to_string()),
        }
    }
}

fn limits_in_words() -> String {
    format!("pictures of up to {MAX_SIDE} pixels a side and {MAX_PIXELS} in all are read")
}

/// A decoder of a picture that has a sensible size.
pub(super) fn decoder(mut file: BufReader<File>, kind: FileKind) -> Result<impl ImageDecoder, Refusal> {
    if kind == FileKind::Exr {
        check_exr_windows(&exr_header(&mut file)?)?;
    }
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MAX_BYTES);
    let mut reader = ImageReader::with_format(file, kind.format());
    reader.limits(limits);
    let decoder = reader.into_decoder()?;
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into())?;
    Ok(decoder)
}

/// What an EXR file says before its pixels. The file is left at its beginning.
pub(super) fn exr_header(file: &mut BufReader<File>) -> Result<MetaData, Refusal> {
    let meta = MetaData::read_from_buffered(&mut *file, false).map_err(|error| Refusal::Format(error.to_string()))?;
    file.rewind().map_err(Refusal::Io)?;
    Ok(meta)
}

/// An EXR's pixels may lie in a window other than the displayed one; both have to be of a sensible size.
fn check_exr_windows(meta: &MetaData) -> Result<(), Refusal> {
    for header in &meta.headers {
        let (data, display) = (header.layer_size, header.shared_attributes.display_window.size);
        check_size(data.width() as u64, data.height() as u64)?;
        check_size(display.width() as u64, display.height() as u64)?;
    }
    Ok(())
}

fn check_size(width: u64, height: u64) -> Result<(), Refusal> {
    if width.max(height) > MAX_SIDE.into() || width.saturating_mul(height) > MAX_PIXELS {
        return Err(Refusal::Format(format!("it claims {width}x{height} pixels; {}", limits_in_words())));
    }
    Ok(())
}

pub(super) fn from_image(image: DynamicImage) -> Result<Loaded, Refusal> {
    use DynamicImage as Image;
    let (width, height) = (image.width(), image.height());
    match image {
        Image::ImageRgb32F(_) | Image::ImageRgba32F(_) => {
            let values = image.into_rgba32f().into_raw();
            LinearPicture::new(width, height, values.as_chunks::<4>().0.to_vec()).map(Loaded::Linear)
        }
        Image::ImageLuma16(_) | Image::ImageLumaA16(_) | Image::ImageRgb16(_) | Image::ImageRgba16(_) => {
            DisplayPicture::from_rgba16(width, height, &image.into_rgba16()).map(Loaded::Display)
        }
        _ => DisplayPicture::from_rgba8(width, height, &image.into_rgba8()).map(Loaded::Display),
    }
    .map_err(|error| Refusal::Format(error.to_string()))
}
