//! A model's pictures, decoded without trusting their headers.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use gltf::json;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use json::texture::{MagFilter, WrappingMode};
use json::validation::Checked;

use super::{Document, Failure, uri};
use crate::error::{Error, Result};
use crate::scene::{Texture, TextureRef, Wrap};

const LONGEST_SIDE: u32 = 16_384;
/// Of one picture's decoder, and of all pictures decoded.
const MOST_DECODER_BYTES: u64 = 2 << 30;
const MOST_TEXTURE_BYTES: u64 = 4 << 30;
const LARGEST_FILE: u64 = 1 << 30;
const EXPECTED: &str = "PNG or JPEG picture";

/// The textures that a model's materials have asked for.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) list: Vec<Texture>,
    /// By texture and whether it is read as sRGB.
    known: BTreeMap<(usize, bool), usize>,
    bytes: u64,
}

impl Textures {
    /// A texture of the model, decoded when it is asked for the first time.
    pub(super) fn get(&mut self, document: &mut Document, index: usize, srgb: bool) -> Result<TextureRef> {
        if let Some(&texture) = self.known.get(&(index, srgb)) {
            return Ok(TextureRef { texture });
        }
        let json = document.get(&document.root.textures, index, "texture")?.clone();
        let sampler =
            json.sampler.map(|sampler| document.get(&document.root.samplers, sampler.value(), "sampler")).transpose()?;
        let wrap = sampler.map_or([Wrap::Repeat; 2], |sampler| [wrap(&sampler.wrap_s), wrap(&sampler.wrap_t)]);
        let nearest = sampler.is_some_and(|sampler| matches!(sampler.mag_filter, Some(Checked::Valid(MagFilter::Nearest))));
        let picture = picture(document, json.source.value())?.into_rgba8();
        self.bytes += picture.len() as u64;
        if self.bytes > MOST_TEXTURE_BYTES {
            return Err(document.failure(format!("its textures need more than {MOST_TEXTURE_BYTES} bytes")));
        }
        let (width, height) = picture.dimensions();
        self.list.push(Texture { width, height, rgba8: picture.into_raw(), srgb, wrap, nearest, anisotropy: 1 });
        self.known.insert((index, srgb), self.list.len() - 1);
        Ok(TextureRef { texture: self.list.len() - 1 })
    }
}

fn wrap(mode: &Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::Clamp,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::Mirror,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

fn picture(document: &mut Document, index: usize) -> Result<DynamicImage> {
    let image = document.get(&document.root.images, index, "image")?.clone();
    let (bytes, path): (Vec<u8>, PathBuf) = match (image.uri, image.buffer_view) {
        (Some(uri), _) => {
            let resource = uri::read(&document.path, &uri, LARGEST_FILE, EXPECTED)?;
            document.hash(&resource.bytes);
            (resource.bytes, resource.path)
        }
        (None, Some(view)) => (document.view(view, &format!("image {index}"))?.0.to_vec(), document.path.clone()),
        (None, None) => return Err(document.failure(format!("image {index} has neither a uri nor a bufferView"))),
    };
    decode(&bytes).map_err(|message| not_a_picture(&path, index, &message))
}

fn not_a_picture(path: &Path, index: usize, message: &str) -> Error {
    Error::Format { path: path.to_path_buf(), expected: EXPECTED, message: format!("image {index}: {message}") }
}

/// Looks at the claimed size before anything is allocated for it.
fn decode(bytes: &[u8]) -> Result<DynamicImage, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|error| error.to_string())?;
    if !matches!(reader.format(), Some(ImageFormat::Png | ImageFormat::Jpeg)) {
        return Err("it begins like neither of them".into());
    }
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_DECODER_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > LONGEST_SIDE || width.min(height) == 0 {
        return Err(format!("it claims {width}x{height} pixels; expected 1 to {LONGEST_SIDE} a side"));
    }
    DynamicImage::from_decoder(decoder).map_err(|error| error.to_string())
}
