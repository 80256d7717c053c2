//! Kinds of picture files: told apart by their first bytes when read, by their extension when written.

use super::BitDepth;
use crate::{Error, Result};
use image::ImageFormat;
use std::path::Path;

/// A kind of picture file that is read, and, but for TIFF, written again by [`super::PictureFile`]. What is drawn anew is written
/// as one of the fewer [`super::FileFormat`]s.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// `.png`: display values, 8 or 16 bits a channel.
    Png,
    /// `.jpg`, `.jpeg`: display values, 8 bits a channel, lossy, without alpha.
    Jpeg,
    /// `.webp`: display values, 8 bits a channel; written losslessly.
    WebP,
    /// `.exr`: linear values, floats.
    Exr,
    /// `.tif`, `.tiff`: display values of 8 or 16 bits, or floats, which are taken as linear; read only.
    Tiff,
}

impl FileKind {
    /// The kind to write that a path's extension names, in any case.
    ///
    /// # Errors
    ///
    /// [`Error::Request`], listing what exists, if there is no extension or another one.
    pub fn of_path(path: &Path) -> Result<Self> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("jpg" | "jpeg") => Ok(Self::Jpeg),
            Some("webp") => Ok(Self::WebP),
            Some("exr") => Ok(Self::Exr),
            given => {
                let given = given.map_or("has no extension".into(), |given| format!("ends in .{given}"));
                let path = path.display();
                Err(Error::Request(format!("{path} {given}; pictures end in .png, .jpg, .jpeg, .webp or .exr")))
            }
        }
    }

    /// Whether a name ends like a picture's that is read.
    #[must_use]
    pub fn is_readable_name(path: &Path) -> bool {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        matches!(extension.as_deref(), Some("png" | "jpg" | "jpeg" | "webp" | "exr" | "tif" | "tiff"))
    }

    /// The kind that a file's first bytes announce, or what they are instead.
    pub(super) fn of_bytes(start: &[u8]) -> Result<Self, String> {
        match start {
            [] => Err("it is empty".into()),
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Ok(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Ok(Self::Jpeg),
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', rest @ ..] => match rest {
                [b'V', b'P', b'8', b'X', _, _, _, _, flags, ..] if flags & 2 != 0 => Err(ANIMATED.into()),
                _ => Ok(Self::WebP),
            },
            [0x76, 0x2f, 0x31, 0x01, ..] => Ok(Self::Exr),
            [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => Ok(Self::Tiff),
            _ if start.starts_with(b"version https://git-lfs") => {
                Err("it is a Git LFS pointer, not the picture; run `git lfs pull`".into())
            }
            _ => Err("it begins like none of them".into()),
        }
    }

    pub(super) fn expected(self) -> &'static str {
        match self {
            Self::Png => "PNG picture",
            Self::Jpeg => "JPEG picture",
            Self::WebP => "WebP picture",
            Self::Exr => "OpenEXR picture",
            Self::Tiff => "TIFF picture",
        }
    }

    pub(super) fn format(self) -> ImageFormat {
        match self {
            Self::Png => ImageFormat::Png,
            Self::Jpeg => ImageFormat::Jpeg,
            Self::WebP => ImageFormat::WebP,
            Self::Exr => ImageFormat::OpenExr,
            Self::Tiff => ImageFormat::Tiff,
        }
    }

    /// Longest side that the format can express, in pixels, where that is less than [`super::MAX_SIDE`].
    pub(super) fn max_side(self) -> u32 {
        match self {
            Self::Png | Self::Exr | Self::Tiff => super::MAX_SIDE,
            Self::Jpeg => 65_535,
            Self::WebP => 16_384,
        }
    }
}

/// What is said of files with several frames.
pub(super) const ANIMATED: &str = "it is an animation; save the frame you mean as a still picture";

/// How a file stores one channel of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Samples {
    /// Integer levels of display values.
    Levels(BitDepth),
    /// 16 bit floats of linear light.
    Half,
    /// 32 bit floats of linear light.
    Float,
}

impl std::fmt::Display for FileKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::WebP => "WebP",
            Self::Exr => "OpenEXR",
            Self::Tiff => "TIFF",
        })
    }
}
