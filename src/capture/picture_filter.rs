//! Filters on pictures that nobody draws: a file, a game's frame, a test pattern.

use crate::error::{Error, Result};
use crate::gpu::{Gpu, TextureSpec, bytes_of};
use crate::methods::{METHODS, Spec};
use crate::pass::{Context, Encoding, Extras, Inputs, Pass, Recorder, Role, Surface, Timer};
use crate::picture::Pixel;

use super::shot::view_among;
use super::view::{View, check_view};

/// One or several filters, built for pictures of one size and surface. Used again and again, it allocates nothing on the device.
#[derive(Debug)]
pub struct PictureFilter<'g> {
    gpu: &'g Gpu,
    input: wgpu::TextureView,
    stages: Vec<Stage>,
}

#[derive(Debug)]
struct Stage {
    pass: Box<dyn Pass>,
    output: wgpu::TextureView,
}

impl<'g> PictureFilter<'g> {
    /// The formats of [`Gpu::upload`]. What comes out is a surface like the one that goes in.
    ///
    /// # Errors
    /// [`Error::Request`] for a method that draws the scene itself or reads what lies beside its colour; [`Error::Unsupported`]
    /// where the adapter lacks something.
    pub fn new(gpu: &'g Gpu, spec: &Spec, size: [u32; 2], surface: Surface) -> Result<Self> {
        Self::check(spec)?;
        gpu.check_size(size)?;
        let target = |label| {
            let texture = gpu.target(TextureSpec { label, size, format: surface.format, samples: 1 });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let mut stages = Vec::new();
        for stage in &spec.stages {
            let (name, needs) = (stage.method.name, stage.technique.needs());
            if needs.role == Role::Filters(Encoding::Linear) && surface.values == Encoding::Display {
                return Err(Error::Request(format!("{name} filters linear light, this picture holds display values")));
            }
            needs.check(name, gpu.device.features(), &gpu.sample_counts())?;
            let context =
                Context { device: &gpu.device, queue: &gpu.queue, size, input: surface, input_samples: 1, output: surface };
            stages.push(Stage { pass: stage.technique.build(&context)?, output: target("filtered") });
        }
        gpu.check()?;
        Ok(Self { gpu, input: target("picture"), stages })
    }

    /// Whether a picture is all that these methods need: asked without a device.
    ///
    /// # Errors
    /// [`Error::Request`] for a method that draws the scene itself, with those that do not, or reads what lies beside its colour.
    pub fn check(spec: &Spec) -> Result<()> {
        for stage in &spec.stages {
            let (name, needs) = (stage.method.name, stage.technique.needs());
            if matches!(needs.role, Role::Draws(_)) {
                return Err(Error::Request(format!(
                    "{name} draws the scene itself; a picture can only be given to a filter ({})",
                    filters().join(", ")
                )));
            }
            if needs.extras != Extras::default() {
                return Err(Error::Request(format!(
                    "{spec} reads a scene's {}, which a picture does not have; choose options that need the colour alone, or \
                     capture a scene with it",
                    needs.extras.names().join(" and ")
                )));
            }
        }
        Ok(())
    }

    /// Filters a picture: pixels in reading order, as the surface's format can hold them.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn apply(&mut self, pixels: &[Pixel]) -> Result<Vec<Pixel>> {
        self.upload(pixels)?;
        self.run(None)?;
        self.read()
    }

    /// Takes a picture in without filtering it yet.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn upload(&self, pixels: &[Pixel]) -> Result<()> {
        self.gpu.upload(self.input.texture(), pixels)
    }

    /// Filters what was uploaded and waits until it is done.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn run(&mut self, timer: Option<&mut dyn Timer>) -> Result<()> {
        let mut encoder = self.gpu.encoder();
        let mut recorder = match timer {
            Some(timer) => Recorder::timed(&mut encoder, timer),
            None => Recorder::new(&mut encoder),
        };
        let mut color = &self.input;
        for stage in &mut self.stages {
            stage.pass.record(&mut recorder, 0, &Inputs::picture(color), &stage.output);
            color = &stage.output;
        }
        self.gpu.submit(encoder)?;
        self.gpu.wait()
    }

    /// What came out of the last run.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn read(&self) -> Result<Vec<Pixel>> {
        Ok(self.gpu.read_linear(self.output())?.into_pixels())
    }

    /// Where the last stage leaves its picture.
    #[must_use]
    pub fn output(&self) -> &wgpu::Texture {
        self.stages.last().map_or(&self.input, |stage| &stage.output).texture()
    }

    /// Whether there is a view of this name, before any run.
    ///
    /// # Errors
    /// [`Error::Request`] with those there are.
    pub fn check_view(&self, spec: &Spec, name: &str) -> Result<()> {
        check_view(spec, name, &self.views())
    }

    /// An intermediate of the last run.
    ///
    /// # Errors
    /// [`Error::Request`] for a name that there is not, with those there are; [`Error::Gpu`].
    pub fn view(&mut self, spec: &Spec, name: &str) -> Result<View> {
        self.check_view(spec, name)?;
        let view = view_among(self.gpu, self.stages.iter_mut().rev().map(|stage| &mut stage.pass), name)?;
        Ok(View::of_numbers(self.gpu.read_linear(view.texture())?))
    }

    /// The methods' intermediates by name; in a combination, the last stage's first.
    #[must_use]
    pub fn views(&self) -> Vec<&'static str> {
        self.stages.iter().rev().flat_map(|stage| stage.pass.views()).copied().collect()
    }

    /// Bytes on the device, the picture that goes in included.
    #[must_use]
    pub fn target_bytes(&self) -> u64 {
        let staged = self.stages.iter().map(|stage| stage.pass.target_bytes() + bytes_of(stage.output.texture()));
        bytes_of(self.input.texture()) + staged.sum::<u64>()
    }
}

/// Methods that take a finished picture, as they are without options.
fn filters() -> Vec<&'static str> {
    let takes_pictures = |name| Spec::parse(name).is_ok_and(|spec| !matches!(spec.first_needs().role, Role::Draws(_)));
    METHODS.iter().map(|method| method.name).filter(|name| takes_pictures(name)).collect()
}
