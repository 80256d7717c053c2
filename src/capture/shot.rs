//! Taking a picture: the loop between a method and the renderer.

use crate::error::{Error, Result};
use crate::forward::{Forward, Targets};
use crate::gpu::{Gpu, TextureSpec, bytes_of};
use crate::methods::Spec;
use crate::pass::{Context, Draw, Encoding, Extras, FrameFacts, Inputs, Pass, Recorder, Role, Surface, Target, Technique, Timer};
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::{Frame, Scene, Tick};

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
        let mut stages: Vec<Stage> = Vec::new();
        let mut extras = extras;
        let drawn_samples = techniques.first().map_or(1, |(_, technique)| technique.needs().samples);
        for (name, technique) in techniques {
            let before = stages.last().map_or(Surface::linear(Targets::color_format()), Stage::surface);
            stages.push(Stage::new(self.gpu, self.scene, (name, *technique), size, (before, drawn_samples))?);
            extras = extras.union(technique.needs().extras);
        }
        let shot = Shot { tick: Tick::of_frame(self.scene, frame), reset: true, size, extras, stages, targets: Vec::new() };
        self.gpu.check()?;
        Ok(shot)
    }

    /// Takes a shot of which nothing was taken before: first as many frames of what came earlier as its methods need.
    ///
    /// # Errors
    /// As [`Studio::take`].
    pub fn take_alone(&mut self, shot: &mut Shot, watch: &mut dyn Watch) -> Result<()> {
        let own = shot.tick;
        let first = own.index - i64::from(shot.frames_before());
        for index in first..own.index {
            shot.move_to(Tick::of(self.scene, index), index == first);
            self.take(shot, None, watch)?;
        }
        shot.move_to(if first < own.index { Tick::of(self.scene, own.index) } else { own }, first == own.index);
        self.take(shot, None, watch)
    }

    /// Draws, anti-aliases, and leaves the picture in the shot.
    ///
    /// # Errors
    /// [`Error::Gpu`], and what `watch` answers.
    pub fn take(&mut self, shot: &mut Shot, mut timer: Option<&mut dyn Timer>, watch: &mut dyn Watch) -> Result<()> {
        let frame = self.scene.at(&shot.tick, shot.size)?;
        self.forward.set_frame(&frame, shot.size)?;
        let mut facts = self.facts(shot, &frame);
        let total = shot.samples_per_pixel();
        let mut done = 0;
        let mut time = 0.0;
        let mut in_flight = InFlight::default();
        for k in 0.. {
            let draws = matches!(shot.stages[0].role, Role::Draws(_));
            let request = if draws { shot.stages[0].pass.next_draw(k, &facts) } else { (k == 0).then(Draw::default) };
            let Some(request) = request else { break };
            watch.tick(done, total)?;
            done += request.jitters.len() as u32 * request.samples;
            if request.time != time {
                time = request.time;
                let moment = self.scene.at(&shot.tick.later(time.into()), shot.size)?;
                self.forward.set_frame(&moment, shot.size)?;
            }
            facts.jitter_px = request.jitters.first().map_or([0.0; 2], |jitter| jitter.offset_px);
            self.draw(shot, k, &request, facts, &mut timer)?;
            if in_flight.is_full(&request, shot.size) {
                self.gpu.wait()?;
            }
        }
        for stage in 1..shot.stages.len() {
            self.filter(shot, stage, facts, &mut timer)?;
        }
        self.gpu.wait()?;
        watch.tick(total, total)
    }

    fn facts(&self, shot: &Shot, frame: &Frame) -> FrameFacts {
        let aspect = f64::from(shot.size[0]) / f64::from(shot.size[1]);
        let previous_clip_from_clip = frame.view.previous_clip_from_clip(&frame.previous_view, aspect);
        FrameFacts {
            index: shot.tick.index as u32,
            jitter_px: [0.0; 2],
            reset: shot.reset,
            exposure: self.scene.exposure,
            previous_clip_from_clip: previous_clip_from_clip.as_mat4().to_cols_array_2d(),
        }
    }

    fn draw(
        &mut self,
        shot: &mut Shot,
        k: u32,
        request: &Draw,
        frame: FrameFacts,
        timer: &mut Option<&mut dyn Timer>,
    ) -> Result<()> {
        let index = shot.targets_for(self.gpu, request)?;
        let Shot { targets, stages, .. } = shot;
        let targets = &targets[index].1;
        let stage = &mut stages[0];
        let mut encoder = self.gpu.encoder();
        let mut recorder = recorder(&mut encoder, timer);
        self.forward.draw(&mut recorder, request, targets, &view_of(&stage.output))?;
        let beside = Beside::of(Some(targets));
        // Sums and outputs leave no input; the depth stands in for a view that nobody reads.
        let color = view_of(targets.color.as_ref().unwrap_or(&targets.depth));
        stage.record(&mut recorder, k, &beside.inputs(&color, None, frame));
        self.gpu.submit(encoder)
    }

    fn filter(&mut self, shot: &mut Shot, index: usize, frame: FrameFacts, timer: &mut Option<&mut dyn Timer>) -> Result<()> {
        let drawn = shot.targets.last().map(|(_, targets)| targets);
        let (beside, samples) = (Beside::of(drawn), drawn.and_then(Targets::samples).map(view_of));
        let (before, after) = shot.stages.split_at_mut(index);
        let input = view_of(&before[index - 1].output);
        let mut encoder = self.gpu.encoder();
        after[0].record(&mut recorder(&mut encoder, timer), 0, &beside.inputs(&input, samples.as_ref(), frame));
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
        Ok(Capture { linear, display, samples_per_pixel: self.shaded(shot)?, target_bytes: shot.target_bytes() })
    }

    /// Samples a pixel that were shaded for what was taken last.
    fn shaded(&self, shot: &Shot) -> Result<f64> {
        let Some(shaded) = shot.stages[0].pass.shaded() else { return Ok(f64::from(shot.samples_per_pixel())) };
        let counts = self.gpu.read_linear(shaded.counts.texture())?;
        let sum: f64 = counts.pixels().iter().map(|pixel| f64::from(pixel[3])).sum();
        Ok(sum / counts.pixels().len() as f64 + f64::from(shaded.beside))
    }

    /// Prepares, takes and reads in one go.
    ///
    /// # Errors
    /// As [`Studio::shot`] and [`Studio::take`].
    pub fn capture(&mut self, spec: &Spec, frame: u32, size: [u32; 2], watch: &mut dyn Watch) -> Result<Capture> {
        let mut shot = self.shot(spec, frame, size)?;
        self.take_alone(&mut shot, watch)?;
        self.read(&shot)
    }
}

/// Work that was submitted and not waited for, so that what is in flight and the time to notice a Ctrl-C stay bounded.
#[derive(Default)]
struct InFlight {
    samples: u64,
}

impl InFlight {
    /// Some tenths of a second on a software rasteriser, a few milliseconds on a GPU.
    const MOST_SAMPLES: u64 = 30_000_000;

    /// Counts a request; true if it is time to wait.
    fn is_full(&mut self, request: &Draw, [width, height]: [u32; 2]) -> bool {
        self.samples += u64::from(width) * u64::from(height) * request.jitters.len() as u64 * u64::from(request.samples);
        let full = self.samples >= Self::MOST_SAMPLES;
        if full {
            self.samples = 0;
        }
        full
    }
}

/// Views of what a draw left beside the colour.
struct Beside {
    depth: Option<wgpu::TextureView>,
    motion: Option<wgpu::TextureView>,
    ids: Option<wgpu::TextureView>,
    signature: Option<wgpu::TextureView>,
}

impl Beside {
    fn of(drawn: Option<&Targets>) -> Self {
        let view = |pick: fn(&Targets) -> Option<&wgpu::Texture>| drawn.and_then(pick).map(view_of);
        Self {
            depth: drawn.and_then(Targets::readable_depth),
            motion: view(|targets| targets.motion.as_ref()),
            ids: view(|targets| targets.ids.as_ref()),
            signature: view(|targets| targets.signature.as_ref()),
        }
    }

    fn inputs<'a>(
        &'a self,
        color: &'a wgpu::TextureView,
        samples: Option<&'a wgpu::TextureView>,
        frame: FrameFacts,
    ) -> Inputs<'a> {
        let (depth, motion, ids) = (self.depth.as_ref(), self.motion.as_ref(), self.ids.as_ref());
        Inputs { color, samples, depth, motion, ids, signature: self.signature.as_ref(), frame }
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
    tick: Tick,
    /// Whether what came before must be forgotten.
    reset: bool,
    size: [u32; 2],
    /// What the stages want drawn beside the colour, together.
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
    samples_per_pixel: u32,
    frames_before: u32,
    output: wgpu::Texture,
    /// Where the stage wants display values of linear input.
    present: Option<(Present, wgpu::Texture)>,
}

impl Stage {
    /// `before` is the picture that comes in, resolved from so many samples.
    fn new(
        gpu: &Gpu,
        scene: &Scene,
        (name, technique): (&str, &dyn Technique),
        size: [u32; 2],
        (before, input_samples): (Surface, u32),
    ) -> Result<Self> {
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
        if (needs.role, before.values) == (Role::Filters(Encoding::Linear), Encoding::Display) {
            return Err(Error::Request(format!(
                "{name} filters linear light; put it before the method that makes display values"
            )));
        }
        let (Role::Draws(read) | Role::Filters(read)) = needs.role;
        let tone_maps = (read, before.values) == (Encoding::Display, Encoding::Linear);
        let present = tone_maps.then(|| {
            let shown = target("shown", wgpu::TextureFormat::Rgba8Unorm);
            (Present::new(gpu, scene, shown.format()), shown)
        });
        let input = match &present {
            Some((_, shown)) => Surface::display(shown.format()),
            None => before,
        };
        let surface = Surface { format: output.format(), values: needs.output };
        let context = Context { device: &gpu.device, queue: &gpu.queue, size, input, input_samples, output: surface };
        Ok(Self {
            pass: technique.build(&context)?,
            role: needs.role,
            encoding: needs.output,
            samples_per_pixel: needs.samples_per_pixel,
            frames_before: needs.frames_before,
            output,
            present,
        })
    }

    /// What it hands to the next stage.
    fn surface(&self) -> Surface {
        Surface { format: self.output.format(), values: self.encoding }
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>) {
        let output = view_of(&self.output);
        match &mut self.present {
            None => self.pass.record(recorder, k, inputs, &output),
            Some((present, shown)) => {
                let shown = view_of(shown);
                present.record(recorder, inputs.color, &shown);
                let inputs = Inputs { color: &shown, ..*inputs };
                self.pass.record(recorder, k, &inputs, &output);
            }
        }
    }
}

impl Shot {
    /// What is taken next: this frame, with (`reset`) or without forgetting those that were taken before.
    pub fn move_to(&mut self, tick: Tick, reset: bool) {
        (self.tick, self.reset) = (tick, reset);
    }

    fn samples_per_pixel(&self) -> u32 {
        self.stages[0].samples_per_pixel
    }

    fn frames_before(&self) -> u32 {
        self.stages.iter().map(|stage| stage.frames_before).max().unwrap_or(0)
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
        // A sum's depth is that of its last jitter: what lies beside it would not be the picture's.
        if sum && self.stages.len() > 1 && self.extras != Extras::default() {
            return Err(Error::Unsupported(
                "a method that reads depth, motion or ids cannot follow one that sums jitters: no single draw is the picture's; put it \
                 after `none`"
                    .into(),
            ));
        }
        let extras = if sum { Extras::default() } else { self.extras };
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
    pub fn views(&self) -> Vec<&'static str> {
        self.stages.iter().rev().flat_map(|stage| stage.pass.views()).copied().collect()
    }

    /// One of them, of what was taken last.
    ///
    /// # Errors
    /// [`Error::Request`] for a name that there is not; [`Error::Gpu`].
    pub fn view(&mut self, gpu: &Gpu, name: &str) -> Result<wgpu::TextureView> {
        view_among(gpu, self.stages.iter_mut().rev().map(|stage| &mut stage.pass), name)
    }
}

/// An intermediate of the first of these passes that has one of this name.
pub(super) fn view_among<'p>(
    gpu: &Gpu,
    passes: impl Iterator<Item = &'p mut Box<dyn Pass>>,
    name: &str,
) -> Result<wgpu::TextureView> {
    let mut encoder = gpu.encoder();
    let view = passes.into_iter().find_map(|pass| pass.view(&mut Recorder::new(&mut encoder), name));
    gpu.submit(encoder)?;
    view.ok_or_else(|| Error::Request(format!("there is no view '{name}'")))
}
