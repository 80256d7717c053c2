//! What is filtered: display values, 8 bits a channel.

use std::path::Path;

use dejag::capture::Studio;
use dejag::error::Error;
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::picture::{DisplayPicture, Pixel};
use dejag::scene::Scene;

use crate::options::Options;

pub(crate) struct Picture {
    pub(crate) name: String,
    pub(crate) size: [u32; 2],
    pub(crate) pixels: Vec<Pixel>,
}

impl Picture {
    fn from_fn(name: &str, size: [u32; 2], mut pixel: impl FnMut(u32, u32) -> Pixel) -> Self {
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
        Self { name: name.into(), size, pixels }
    }
}

/// The files that were named, a captured scene, and a synthetic picture.
pub(crate) fn all(gpu: &Gpu, options: &Options) -> dejag::Result<Vec<Picture>> {
    let size = if options.smoke { [64, 36] } else { [1920, 1080] };
    let mut pictures = options.pictures.iter().map(|path| load(path)).collect::<Result<Vec<_>, _>>()?;
    pictures.extend([courtyard(gpu, size)?, star(size)]);
    Ok(pictures)
}

/// A file as it stands, whatever its values mean.
fn load(path: &Path) -> dejag::Result<Picture> {
    let refusal = |error: image::ImageError| Error::Request(format!("{} cannot be read: {error}", path.display()));
    let image = image::open(path).map_err(refusal)?.to_rgba8();
    let picture = DisplayPicture::from_rgba8(image.width(), image.height(), &image)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Picture { name, size: picture.size(), pixels: picture.into_pixels() })
}

/// The shipped scene without anti-aliasing.
pub(crate) fn courtyard(gpu: &Gpu, size: [u32; 2]) -> dejag::Result<Picture> {
    let scene = Scene::load("courtyard")?;
    let capture = Studio::new(gpu, &scene)?.capture(&Spec::parse("none")?, 0, size, &mut ())?;
    Ok(Picture { name: "courtyard".into(), size, pixels: capture.display.into_pixels() })
}

/// Black and white spokes: edges at every angle, few outside and nothing else in the middle.
fn star(size: [u32; 2]) -> Picture {
    Picture::from_fn("star of 48 spokes", size, |x, y| {
        let from_middle = |at: u32, side: u32| f64::from(at) + 0.5 - 0.5 * f64::from(side) + 0.01;
        let turn = from_middle(y, size[1]).atan2(from_middle(x, size[0]));
        grey(f32::from((48.0 * turn).sin() > 0.0))
    })
}

/// A square from the middle of a picture and its mirror images, side by side: as many edges a pixel at any size, and no seams.
pub(crate) fn tiled(picture: &Picture, side: u32) -> Picture {
    const TILE: u32 = 256;
    let [width, height] = picture.size;
    let mirrored = |at: u32| if (at / TILE).is_multiple_of(2) { at % TILE } else { TILE - 1 - at % TILE };
    Picture::from_fn("tiles", [side; 2], |x, y| {
        let (column, row) = ((width - TILE) / 2 + mirrored(x), (height - TILE) / 2 + mirrored(y));
        picture.pixels[(row * width + column) as usize]
    })
}

/// Grey, but for a share of the pixels, each of them black, white or anything between.
pub(crate) fn noise(size: [u32; 2], percent: u32) -> Picture {
    let mut state = 0x9e37_79b9_u32;
    // Marsaglia's 32-bit xorshift: the same noise on every machine.
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state
    };
    Picture::from_fn("noise", size, |_, _| {
        let (chance, level) = (random(), random());
        grey(if chance / 256 % 100 < percent { (level >> 24) as f32 / 255.0 } else { 128.0 / 255.0 })
    })
}

fn grey(level: f32) -> Pixel {
    [level, level, level, 1.0]
}
