//! Pictures with what their files say of them beyond the pixels, for whoever writes them again.

use super::kind::{ANIMATED, Samples};
use super::load::{self, Refusal, from_image};
use super::{BitDepth, FileKind, Loaded, tiff_pages};
use crate::Result;
use exr::meta::MetaData;
use exr::meta::attribute::{Chromaticities, SampleType};
use image::metadata::Orientation;
use image::{ColorType, DynamicImage, ImageDecoder};
use std::fs::File;
use std::io::{BufReader, Seek};
use std::path::Path;

/// A picture, upright, and what its file said of it.
#[derive(Debug, Clone)]
pub struct PictureFile {
    /// The pixels. They may be replaced by others, and converted.
    pub picture: Loaded,
    /// What was said of them.
    pub carried: Carried,
}

/// What a file says of its picture, to be carried into the file that is made of it.
#[derive(Debug, Clone)]
pub struct Carried {
    /// The kind of file it was.
    pub kind: FileKind,
    /// How it stored a channel.
    pub samples: Samples,
    /// Whether it stored greys only.
    pub grey: bool,
    /// Whether it stored an alpha channel.
    pub alpha: bool,
    pub(super) icc: Option<Vec<u8>>,
    /// Its orientation is reset: the pixels are upright.
    pub(super) exif: Option<Vec<u8>>,
    /// A PNG's chunks before its pixels: gamma, resolution, texts.
    pub(super) png: Option<Box<png::Info<'static>>>,
    pub(super) primaries: Option<Chromaticities>,
}

impl PictureFile {
    /// Reads what [`load`](super::load()) reads, turns it upright if its EXIF data say that it lies, and keeps the bit depth, the
    /// colour profile and whatever else the file carries.
    ///
    /// # Errors
    ///
    /// As [`load`](super::load()); and [`crate::Error::Format`] for animations, of which it would keep one frame only.
    pub fn read(path: &Path) -> Result<Self> {
        load::open(path, |mut file, kind| {
            let facts = Facts::of(&mut file, kind)?;
            let mut decoder = load::decoder(file, kind)?;
            let icc = decoder.icc_profile()?;
            let mut exif = decoder.exif_metadata()?;
            let turned = exif.as_deref_mut().and_then(Orientation::remove_from_exif_chunk);
            let color = decoder.color_type();
            let mut image = DynamicImage::from_decoder(decoder)?;
            image.apply_orientation(turned.unwrap_or(Orientation::NoTransforms));
            let carried = Carried {
                kind,
                samples: samples(color, facts.half),
                grey: !color.has_color(),
                alpha: color.has_alpha(),
                icc,
                exif,
                png: facts.png,
                primaries: facts.primaries,
            };
            Ok(Self { picture: from_image(image)?, carried })
        })
    }

    /// The picture in another encoding, if `kind` holds another: linear for OpenEXR, display values for the others.
    #[must_use]
    pub fn encoded_for(self, kind: FileKind) -> Self {
        let picture = match kind {
            FileKind::Exr => Loaded::Linear(self.picture.into_linear()),
            FileKind::Png | FileKind::Jpeg | FileKind::WebP => Loaded::Display(self.picture.into_display()),
            FileKind::Tiff => self.picture,
        };
        Self { picture, ..self }
    }
}

impl Carried {
    /// Of the bit depth alone: for pictures that show something else than colours, and that no profile may change.
    #[must_use]
    pub fn without_colour(self) -> Self {
        Self { grey: false, alpha: false, icc: None, exif: None, png: None, primaries: None, ..self }
    }

    /// What a file of this kind cannot keep, each in a clause; nothing if it keeps everything.
    #[must_use]
    pub fn losses(&self, kind: FileKind) -> Vec<String> {
        let mut losses = Vec::new();
        match (self.samples, kind) {
            (Samples::Half | Samples::Float, FileKind::Png | FileKind::Jpeg | FileKind::WebP) => {
                losses.push("linear light became sRGB display values; what lay outside 0 to 1 is cut off".into());
            }
            (Samples::Levels(BitDepth::Sixteen), FileKind::Jpeg | FileKind::WebP) => {
                losses.push(format!("16 bits a channel became 8, which is what {kind} holds"));
            }
            _ => {}
        }
        match (self.profile_kind(), kind) {
            (Some(_), FileKind::Exr) => {
                losses.push("its colour profile was left out and its values taken as sRGB: OpenEXR holds no profiles".into());
            }
            (Some(b"RGB "), _) | (None, _) => {}
            (Some(b"GRAY"), _) if self.grey && kind.keeps_grey() => {}
            (Some(other), _) => {
                let other = String::from_utf8_lossy(other).trim_end().to_owned();
                losses.push(format!("its colour profile was left out: it describes {other}, not RGB"));
            }
        }
        losses
    }

    /// The colour space that the profile describes, as its header names it.
    pub(super) fn profile_kind(&self) -> Option<&[u8; 4]> {
        self.icc.as_deref()?.get(16..)?.first_chunk()
    }
}

pub(super) fn samples(color: ColorType, half: bool) -> Samples {
    match color {
        ColorType::Rgb32F | ColorType::Rgba32F if half => Samples::Half,
        ColorType::Rgb32F | ColorType::Rgba32F => Samples::Float,
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => Samples::Levels(BitDepth::Sixteen),
        _ => Samples::Levels(BitDepth::Eight),
    }
}

/// What the common decoder does not tell.
#[derive(Default)]
pub(super) struct Facts {
    pub(super) png: Option<Box<png::Info<'static>>>,
    pub(super) primaries: Option<Chromaticities>,
    half: bool,
}

impl Facts {
    /// Leaves the file at its beginning.
    pub(super) fn of(file: &mut BufReader<File>, kind: FileKind) -> Result<Self, Refusal> {
        match kind {
            FileKind::Png => Self::of_png(file),
            FileKind::Exr => Ok(Self::of_exr(&load::exr_header(file)?)),
            FileKind::Tiff => tiff_pages::check_single(file).map(|()| Self::default()),
            FileKind::Jpeg | FileKind::WebP => Ok(Self::default()),
        }
    }

    fn of_png(file: &mut BufReader<File>) -> Result<Self, Refusal> {
        let reader = png::Decoder::new(&mut *file).read_info().map_err(|error| Refusal::Format(error.to_string()))?;
        let info = reader.info().clone();
        file.rewind().map_err(Refusal::Io)?;
        if info.animation_control.is_some() {
            return Err(Refusal::Format(ANIMATED.into()));
        }
        Ok(Self { png: Some(Box::new(info)), ..Self::default() })
    }

    fn of_exr(meta: &MetaData) -> Self {
        let channels = meta.headers.iter().flat_map(|header| &header.channels.list);
        let mut colors = channels.filter(|channel| ["R", "G", "B", "A"].iter().any(|name| channel.name == **name)).peekable();
        Self {
            half: colors.peek().is_some() && colors.all(|channel| channel.sample_type == SampleType::F16),
            primaries: meta.headers.first().and_then(|header| header.shared_attributes.chromaticities),
            png: None,
        }
    }
}
