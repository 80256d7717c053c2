//! The GPU's part: built filters, kept for the next picture of the same size.

use crate::capture::PictureFilter;
use crate::error::Result;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::pass::Surface;
use crate::picture::{BitDepth, DisplayPicture, FileKind, LinearPicture, Loaded, PictureFile, Samples};

/// How many sizes and surfaces are kept built.
const KEPT: usize = 4;

/// Device memory that filters out of use may hold, in bytes.
const KEPT_BYTES: u64 = 1 << 29;

/// A method, built for the sizes met last.
#[derive(Debug)]
pub(super) struct Filters<'g> {
    gpu: &'g Gpu,
    spec: &'g Spec,
    view: Option<&'g str>,
    /// The one used last stands last.
    built: Vec<Built<'g>>,
}

#[derive(Debug)]
struct Built<'g> {
    size: [u32; 2],
    surface: Surface,
    filter: PictureFilter<'g>,
}

impl<'g> Filters<'g> {
    /// Finds out on a single pixel, in a format that every adapter has, whether the method is built and the view exists.
    pub(super) fn new(gpu: &'g Gpu, spec: &'g Spec, view: Option<&'g str>) -> Result<Self> {
        let probe = PictureFilter::new(gpu, spec, [1, 1], Surface::linear(wgpu::TextureFormat::Rgba16Float))?;
        view.map_or(Ok(()), |view| probe.check_view(spec, view))?;
        Ok(Self { gpu, spec, view, built: Vec::new() })
    }

    /// The picture filtered in its own encoding, or the view of it in the one that a file of this kind holds.
    pub(super) fn apply(&mut self, file: PictureFile, kind: FileKind) -> Result<PictureFile> {
        let (size, surface) = (file.picture.size(), surface(&file, kind));
        let PictureFile { picture, carried } = file;
        let (linear, pixels) = match picture {
            Loaded::Linear(picture) => (true, picture.into_pixels()),
            Loaded::Display(picture) => (false, picture.into_pixels()),
        };
        let (spec, view) = (self.spec, self.view);
        let filter = self.built_for(size, surface)?;
        filter.upload(&pixels)?;
        drop(pixels);
        filter.run(None)?;
        if let Some(name) = view {
            let view = filter.view(spec, name)?;
            let picture = if kind == FileKind::Exr { Loaded::Linear(view.data) } else { Loaded::Display(view.display) };
            return Ok(PictureFile { picture, carried: carried.without_colour() });
        }
        let ([width, height], pixels) = (size, filter.read()?);
        let picture = if linear {
            Loaded::Linear(LinearPicture::new(width, height, pixels)?)
        } else {
            Loaded::Display(DisplayPicture::new(width, height, pixels)?)
        };
        Ok(PictureFile { picture, carried })
    }

    fn built_for(&mut self, size: [u32; 2], surface: Surface) -> Result<&mut PictureFilter<'g>> {
        let built = match self.built.iter().position(|built| (built.size, built.surface) == (size, surface)) {
            Some(at) => self.built.remove(at),
            None => {
                self.make_room();
                Built { size, surface, filter: PictureFilter::new(self.gpu, self.spec, size, surface)? }
            }
        };
        Ok(&mut self.built.push_mut(built).filter)
    }

    /// Drops those that were not used for the longest time.
    fn make_room(&mut self) {
        let bytes = |built: &[Built<'_>]| built.iter().map(|built| built.filter.target_bytes()).sum::<u64>();
        while self.built.len() >= KEPT || bytes(&self.built) > KEPT_BYTES {
            self.built.remove(0);
        }
    }
}

/// Levels of 8 bits in and out stay such; all else is filtered in floats.
fn surface(file: &PictureFile, kind: FileKind) -> Surface {
    match (&file.picture, file.carried.samples) {
        (Loaded::Linear(_), _) => Surface::linear(wgpu::TextureFormat::Rgba32Float),
        (_, Samples::Levels(BitDepth::Eight)) if kind != FileKind::Exr => Surface::display(wgpu::TextureFormat::Rgba8Unorm),
        _ => Surface::display(wgpu::TextureFormat::Rgba32Float),
    }
}
