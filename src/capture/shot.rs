//! Taking a picture: the loop between a method and the renderer.

use crate::error::{Error, Result};
use crate::forward::{Forward, Targets};
use crate::gpu::{Gpu, TextureSpec, bytes_of};
use crate::methods::Spec;
use crate::pass::{Context, Draw, Encoding, Extras, FrameFacts, Inputs, Pass, Recorder, Role, Target, Technique, Timer};
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::Scene;

use super::present::Present;

/// A scene on a device.
#[derive(Debug)]
pub struct Studio<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// What is drawn.
    pub scene: &'a Scene,
    forward: Forward,
}

/// Is asked between draws whether to go on.
pub trait Watch {
    /// `done` of `total` samples a pixel are drawn.
    ///
    /// # Errors
    /// [`Error::Interrupted`] to stop.
    fn tick(&mut self, done: u32, total: u32) -> Result<()>;
}

/// Never interrupts.
impl Watch for () {
    fn tick(&mut self, _: u32, _: u32) -> Result<()> {
        Ok(())
    }
}

/// A picture and what it took.
#[derive(Debug, Clone)]
pub struct Capture {
    /// Linear light, not exposed; none where the method only makes display values.
    pub linear: Option<LinearPicture>,
    /// Exposed, tone-mapped and sRGB-coded, not rounded to 8 bits.
    pub display: DisplayPicture,
    /// Samples shaded a pixel.
    pub samples_per_pixel: f64,
    /// Bytes of all targets of draws and passes together.
    pub target_bytes: u64,
}

impl<'a> Studio<'a> {
    /// Uploads the scene.
    ///
    /// # Errors
    /// [`Error::Unsupported`] or [`Error::Gpu`].
    pub fn new(gpu: &'a Gpu, scene: &'a Scene) -> Result<Self> {
        let forward = Forward::new(gpu, scene)?;
        gpu.check()?;
        Ok(Self { gpu, scene, forward })
    }

    /// Prepares a method on one frame. Shots of one studio may be kept side by side.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where the adapter lacks something, [`Error::Request`] for a frame or size that is none.
    pub fn shot(&self, spec: &Spec, frame: u32, size: [u32; 2]) -> Result<Shot> {
        let techniques: Vec<(&str, &dyn Technique)> = spec.stages.iter().map(|s| (s.method.name, &*s.technique)).collect();
        self.shot_of(&techniques, frame, size, Extras::default())
    }

    /// As [`Studio::shot`], for techniques that are in no registry, and with extras that no method asked for.
    ///
    /// # Errors
    /// As [`Studio::shot`].
    pub fn shot_of(&self, techniques: &[(&str, &dyn Technique)], frame: u32, size: [u32; 2], extras: Extras) -> Result<Shot> {
        self.gpu.check_size(size)?;
        if frame >= self.scene.frames {
            return Err(Error::Request(format!(
                "{} has no frame {frame}; it has frames 0 to {}",
                self.scene.name,
                self.scene.frames - 1
            )));
        }
        let mut stages = Vec::new();
        for (name, technique) in techniques {
            stages.push(Stage::new(self.gpu, self.scene, name, *technique, size)?);
        }
        let shot = Shot { frame, size, extras, stages, targets: Vec::new() };
        self.gpu.check()?;
        Ok(shot)
    }

    /// Draws, anti-aliases, and leaves the picture in the shot.
    ///
    /// # Errors
    /// [`Error::Gpu`], and what `watch` answers.
    pub fn take(&mut self, shot: &mut Shot, mut timer: Option<&mut dyn Timer>, watch: &mut dyn Watch) -> Result<()> {
        let frame = self.scene.frame(shot.frame, shot.size)?;
        self.forward.set_frame(&frame, shot.size)?;
        let total = shot.samples_per_pixel();
        let mut done = 0;
        for k in 0.. {
            let draws = shot.stages[0].role == Role::Draws;
            let request = if draws { shot.stages[0].pass.next_draw(k) } else { (k == 0).then(Draw::default) };
            let Some(request) = request else { break };
            watch.tick(done, total)?;
            done += request.jitters.len() as u32 * request.samples;
            self.draw(shot, k, &request, &mut timer)?;
        }
        for stage in 1..shot.stages.len() {
            self.filter(shot, stage, &mut timer)?;
        }
        self.gpu.wait()?;
        watch.tick(total, total)
    }

    fn draw(&mut self, shot: &mut Shot, k: u32, request: &Draw, timer: &mut Option<&mut dyn Timer>) -> Result<()> {
        let index = shot.targets_for(self.gpu, request)?;
        let facts = shot.facts(self.scene);
        let Shot { targets, stages, .. } = shot;
        let targets = &targets[index].1;
        let stage = &mut stages[0];
        let mut encoder = self.gpu.encoder();
        let mut recorder = recorder(&mut encoder, timer);
        self.forward.draw(&mut recorder, request, targets, &view_of(&stage.output))?;
        // Sums and outputs leave no input; the depth stands in for a view that nobody reads.
        let color = view_of(targets.color.as_ref().unwrap_or(&targets.depth));
        let extras = [&targets.motion, &targets.ids].map(|t| t.as_ref().map(view_of));
        let depth = view_of(&targets.depth);
        let inputs =
            Inputs { color: &color, depth: Some(&depth), motion: extras[0].as_ref(), ids: extras[1].as_ref(), frame: facts };
        stage.record(&mut recorder, k, &inputs);
        self.gpu.submit(encoder)?;
        // Bounds what is in flight, and how long a Ctrl-C waits.
        if k % 4 == 3 { self.gpu.wait() } else { Ok(()) }
    }

    fn filter(&mut self, shot: &mut Shot, index: usize, timer: &mut Option<&mut dyn Timer>) -> Result<()> {
        let facts = shot.facts(self.scene);
        let (before, after) = shot.stages.split_at_mut(index);
        let input = view_of(&before[index - 1].output);
        let mut encoder = self.gpu.encoder();
        let inputs = Inputs { color: &input, depth: None, motion: None, ids: None, frame: facts };
        after[0].record(&mut recorder(&mut encoder, timer), 0, &inputs);
        self.gpu.submit(encoder)
    }

    /// Reads a taken shot back.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn read(&self, shot: &Shot) -> Result<Capture> {
        let last = &shot.stages[shot.stages.len() - 1];
        let (linear, display) = match last.encoding {
            Encoding::Linear => {
                (Some(self.gpu.read_linear(&last.output)?), Present::display_of(self.gpu, self.scene, &last.output)?)
            }
            Encoding::Display => {
                let coded = self.gpu.read_linear(&last.output)?;
                (None, DisplayPicture::new(coded.width(), coded.height(), coded.into_pixels())?)
            }
        };
        Ok(Capture { linear, display, samples_per_pixel: f64::from(shot.samples_per_pixel()), target_bytes: shot.target_bytes() })
    }

    /// Prepares, takes and reads in one go.
    ///
    /// # Errors
    /// As [`Studio::shot`] and [`Studio::take`].
    pub fn capture(&mut self, spec: &Spec, frame: u32, size: [u32; 2], watch: &mut dyn Watch) -> Result<Capture> {
        let mut shot = self.shot(spec, frame, size)?;
        self.take(&mut shot, None, watch)?;
        self.read(&shot)
    }
}

fn view_of(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn recorder<'r>(encoder: &'r mut wgpu::CommandEncoder, timer: &'r mut Option<&mut dyn Timer>) -> Recorder<'r> {
    match timer {
        Some(timer) => Recorder::timed(encoder, &mut **timer),
        None => Recorder::new(encoder),
    }
}

/// A method prepared on one frame of a studio's scene.
#[derive(Debug)]
pub struct Shot {
    frame: u32,
    size: [u32; 2],
    extras: Extras,
    stages: Vec<Stage>,
    /// One set a kind of draw.
    targets: Vec<(TargetsKey, Targets)>,
}

#[derive(Debug, PartialEq, Eq)]
struct TargetsKey {
    samples: u32,
    stencil: bool,
    color: bool,
}

/// A built method with its output.
#[derive(Debug)]
struct Stage {
    pass: Box<dyn Pass>,
    role: Role,
    encoding: Encoding,
    extras: Extras,
    samples_per_pixel: u32,
    output: wgpu::Texture,
    /// Where the stage wants display values of linear input.
    present: Option<(Present, wgpu::Texture)>,
}

impl Stage {
    fn new(gpu: &Gpu, scene: &Scene, name: &str, technique: &dyn Technique, size: [u32; 2]) -> Result<Self> {
        let needs = technique.needs();
        needs.check(name, gpu.device.features(), &gpu.sample_counts())?;
        let target = |label, format| gpu.target(TextureSpec { label, size, format, samples: 1 });
        let output = target(
            "output",
            match (needs.output, needs.wide_output) {
                (Encoding::Display, _) => wgpu::TextureFormat::Rgba8Unorm,
                (Encoding::Linear, false) => Targets::color_format(),
                (Encoding::Linear, true) => wgpu::TextureFormat::Rgba32Float,
            },
        );
        let present = (needs.role == Role::Filters(Encoding::Display)).then(|| {
            let shown = target("shown", wgpu::TextureFormat::Rgba8Unorm);
            (Present::new(gpu, scene, shown.format()), shown)
        });
        let input_format = present.as_ref().map_or(Targets::color_format(), |(_, shown)| shown.format());
        let context = Context { device: &gpu.device, queue: &gpu.queue, size, input_format, output_format: output.format() };
        Ok(Self {
            pass: technique.build(&context)?,
            role: needs.role,
            encoding: needs.output,
            extras: needs.extras,
            samples_per_pixel: needs.samples_per_pixel,
            output,
            present,
        })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>) {
        let output = view_of(&self.output);
        match &mut self.present {
            None => self.pass.record(recorder, k, inputs, &output),
            Some((present, shown)) => {
                let shown = view_of(shown);
                present.record(recorder, inputs.color, &shown);
                self.pass.record(recorder, k, &Inputs { color: &shown, ..*inputs }, &output);
            }
        }
    }
}

impl Shot {
    fn facts(&self, scene: &Scene) -> FrameFacts {
        FrameFacts { index: self.frame, reset: true, exposure: scene.exposure }
    }

    fn samples_per_pixel(&self) -> u32 {
        self.stages[0].samples_per_pixel
    }

    /// The targets that fit a draw, made if none do.
    fn targets_for(&mut self, gpu: &Gpu, request: &Draw) -> Result<usize> {
        let sum = matches!(request.target, Target::Sum(_));
        let key = TargetsKey {
            samples: request.samples,
            stencil: sum || request.mask.is_some(),
            color: matches!(request.target, Target::Input),
        };
        if let Some(index) = self.targets.iter().position(|(made, _)| *made == key) {
            return Ok(index);
        }
        let needs = self.stages[0].extras;
        // A sum's depth is that of its last jitter: extras beside it would not be the picture's.
        let asked = if sum { Extras::default() } else { self.extras };
        let extras =
            Extras { depth: needs.depth || asked.depth, motion: needs.motion || asked.motion, ids: needs.ids || asked.ids };
        self.targets.push((key, Forward::targets(gpu, self.size, request, extras)?));
        gpu.check()?;
        Ok(self.targets.len() - 1)
    }

    fn target_bytes(&self) -> u64 {
        let drawn: u64 = self.targets.iter().map(|(_, targets)| targets.bytes()).sum();
        let staged = self
            .stages
            .iter()
            .map(|s| s.pass.target_bytes() + bytes_of(&s.output) + s.present.as_ref().map_or(0, |(_, shown)| bytes_of(shown)));
        drawn + staged.sum::<u64>()
    }

    /// Depth, motion or ids of the last plain draw, if they were drawn.
    pub(super) fn drawn(&self, pick: impl Fn(&Targets) -> Option<&wgpu::Texture>) -> Option<&wgpu::Texture> {
        self.targets.iter().rev().find_map(|(_, targets)| pick(targets))
    }

    /// The methods' intermediates by name; in a combination, the last stage's first.
    #[must_use]
    pub fn views(&self) -> Vec<(&'static str, wgpu::TextureView)> {
        self.stages.iter().rev().flat_map(|stage| stage.pass.views()).collect()
    }
}
