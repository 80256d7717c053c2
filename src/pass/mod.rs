//! What an anti-aliasing method is, and what it may count on.
//!
//! A [`Method`] is a static descriptor in the [`crate::methods::METHODS`] slice. Its options make a [`Technique`], which says what it
//! [`Needs`]; a technique builds a [`Pass`] for one device and size. The pass then drives: it is asked for the draws it wants
//! ([`Pass::next_draw`]) and told when each is done ([`Pass::record`]).
//!
//! # Contracts
//! - y points down, pixel centres lie at .5, motion vectors are un-jittered, in pixels, from this frame to the previous one.
//! - Encoding is explicit: a technique says whether it reads and writes linear light or display values.
//! - Frame facts are inputs. No globals, no clocks: the same inputs give the same bits.
//! - Size is fixed when a pass is built; another size is another pass. 1x1 and odd sizes work.
//! - What a method needs and the adapter lacks is an error that says so.
//!
//! Nothing here knows who draws: the workbench answers with its own forward renderer, an embedder with theirs.

mod bindings;
mod compute;
mod draw;
mod options;
mod record;
mod screen;

pub(crate) use bindings::Binding;
pub(crate) use compute::{ComputePass, Groups};
pub use draw::{Draw, Jitter, Mask, Sum, Target};
pub use options::{Kind, OptionSpec, Options};
pub use record::{Recorder, Timer};
pub(crate) use screen::ScreenPass;

use std::fmt::Debug;

use crate::error::{Error, Result};
use crate::shader::{Layout, Source};

/// A way to anti-alias, as the registry lists it.
#[derive(Debug)]
pub struct Method {
    /// As in `-m NAME`.
    pub name: &'static str,
    /// What it does, in a line.
    pub summary: &'static str,
    /// Who described it first, or best.
    pub source: &'static str,
    /// What can be set, in the order it is listed.
    pub options: &'static [OptionSpec],
    /// Options, already checked one by one -> technique. Fails where they contradict each other.
    pub configure: fn(&Options) -> Result<Box<dyn Technique>>,
    /// Every module it may compile.
    pub shaders: &'static [Source],
    /// Every struct those modules share with Rust.
    pub layouts: &'static [Layout],
}

/// A method with its options set: still without a device.
pub trait Technique: Debug + Send + Sync {
    /// What it asks of the host and the adapter.
    fn needs(&self) -> Needs;

    /// Pipelines and private targets for one device, size and format.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where the size or the options ask for more than the device has.
    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>>;
}

/// What a technique asks of the host and the adapter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Whether it asks for draws of its own, or takes a finished picture.
    pub role: Role,
    /// What its output holds.
    pub output: Encoding,
    /// Whether its output deserves rgba32float: what it makes is finer than rgba16float's 11 bits.
    pub wide_output: bool,
    /// Hardware samples a pixel of its draws; 1 for none.
    pub samples: u32,
    /// Device features beyond WebGPU's base.
    pub features: wgpu::Features,
    /// What must be drawn beside the colour, by whichever method draws.
    pub extras: Extras,
    /// Samples shaded a pixel by all its draws together.
    pub samples_per_pixel: u32,
    /// Frames that must have gone before for the picture to be what the method makes of a sequence; 0 without history.
    pub frames_before: u32,
}

impl Default for Needs {
    /// One plain draw to linear light.
    fn default() -> Self {
        Self {
            role: Role::Draws(Encoding::Linear),
            output: Encoding::Linear,
            wide_output: false,
            samples: 1,
            features: wgpu::Features::empty(),
            extras: Extras::default(),
            samples_per_pixel: 1,
            frames_before: 0,
        }
    }
}

/// Where a technique's picture comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It drives the scene's draws and is handed them in this encoding. In a combination only the first may.
    Draws(Encoding),
    /// It takes a finished picture in this encoding; alone, it is given one plain draw.
    Filters(Encoding),
}

/// What numbers in a picture mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Linear light, scene-referred, not limited to 1.
    Linear,
    /// Tone-mapped and sRGB-coded, in [0, 1].
    Display,
}

/// What a draw writes beside the colour, only if asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Extras {
    /// Reversed depth, readable afterwards.
    pub depth: bool,
    /// Motion vectors in pixels, from this frame to the previous one.
    pub motion: bool,
    /// Object ids, 0 for the background.
    pub ids: bool,
    /// What a surface is made of and whether it faces the light, as a number; 0 for the background. Unlike a colour it is the same
    /// all over a texture.
    pub signature: bool,
}

/// What a pass is built for.
#[derive(Debug, Clone, Copy)]
pub struct Context<'a> {
    /// Has at least the features that [`Needs`] named.
    pub device: &'a wgpu::Device,
    /// Of the same device.
    pub queue: &'a wgpu::Queue,
    /// Width and height in pixels, at least 1.
    pub size: [u32; 2],
    /// The pictures that a draw makes or that come in.
    pub input: Surface,
    /// Hardware samples a pixel that the picture was resolved from, if it was; else 1.
    pub input_samples: u32,
    /// What is written.
    pub output: Surface,
}

/// The format of a picture on the device, and what a shader that loads from it or writes to it deals in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Surface {
    /// Of the view, not of the texture below it.
    pub format: wgpu::TextureFormat,
    /// What its loads give and its stores take.
    pub values: Encoding,
}

impl Surface {
    /// A picture of display values. Through an `-srgb` format the shader sees them decoded, in linear light.
    #[must_use]
    pub fn display(format: wgpu::TextureFormat) -> Self {
        Self { format, values: if format.is_srgb() { Encoding::Linear } else { Encoding::Display } }
    }

    /// A picture in linear light.
    #[must_use]
    pub const fn linear(format: wgpu::TextureFormat) -> Self {
        Self { format, values: Encoding::Linear }
    }
}

/// A built method: pipelines and private targets for one device and size.
pub trait Pass: Debug {
    /// The `k`-th draw of this frame, from 0; none when the frame is complete. Asked again after [`Pass::record`]. Of the facts,
    /// [`FrameFacts::jitter_px`] is not known yet: it is what the answer asks for.
    fn next_draw(&mut self, k: u32, frame: &FrameFacts) -> Option<Draw> {
        let _ = frame;
        (k == 0).then(Draw::default)
    }

    /// Records what is to be done after the `k`-th draw. After the last one the output holds the picture.
    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView);

    /// Names of the intermediates that can be looked at once a frame is complete.
    fn views(&self) -> &'static [&'static str] {
        &[]
    }

    /// One of them as a texture that can be copied from; records what it takes to make it visible. None for another name.
    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        let _ = (recorder, name);
        None
    }

    /// How many samples were shaded, where pixels differ in that. None where every pixel takes [`Needs::samples_per_pixel`].
    fn shaded(&self) -> Option<Shaded> {
        None
    }

    /// Bytes of its private targets.
    fn target_bytes(&self) -> u64 {
        0
    }
}

/// Samples that were shaded, pixel by pixel.
#[derive(Debug, Clone)]
pub struct Shaded {
    /// An rgba32float texture whose alpha counts them.
    pub counts: wgpu::TextureView,
    /// How many every pixel took beside.
    pub beside: u32,
}

/// What a pass reads.
#[derive(Debug, Clone, Copy)]
pub struct Inputs<'a> {
    /// What was drawn, or the picture to filter in the encoding that was asked for. Multisampled if samples were asked for. After a
    /// draw with [`Target::Sum`] or [`Target::Output`] there is nothing in it.
    pub color: &'a wgpu::TextureView,
    /// For a filter after a multisampled draw: its unresolved samples, in linear light.
    pub samples: Option<&'a wgpu::TextureView>,
    /// Reversed depth, if asked for.
    pub depth: Option<&'a wgpu::TextureView>,
    /// Motion vectors, if asked for.
    pub motion: Option<&'a wgpu::TextureView>,
    /// Object ids, if asked for.
    pub ids: Option<&'a wgpu::TextureView>,
    /// Signatures of material and light (r32uint), if asked for.
    pub signature: Option<&'a wgpu::TextureView>,
    /// Facts about the frame.
    pub frame: FrameFacts,
}

/// Facts about a frame that are not pictures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameFacts {
    /// Counts frames up, and wraps. Sequences of jitters follow it.
    pub index: u32,
    /// Where in every pixel the draw at hand was sampled, from the pixel's centre, y down.
    pub jitter_px: [f32; 2],
    /// Whether what came before must be forgotten: the first frame, a cut.
    pub reset: bool,
    /// Factor on linear colour before the tone map.
    pub exposure: f32,
    /// Takes a clip-space position of this frame to where a point that stands still was in the frame before, both without jitter;
    /// columns. The way to reproject the background, which has no motion vectors of its own.
    pub previous_clip_from_clip: [[f32; 4]; 4],
}

impl Default for FrameFacts {
    /// A picture by itself: nothing came before it.
    fn default() -> Self {
        let previous_clip_from_clip = glam::Mat4::IDENTITY.to_cols_array_2d();
        Self { index: 0, jitter_px: [0.0; 2], reset: true, exposure: 1.0, previous_clip_from_clip }
    }
}

impl<'a> Inputs<'a> {
    /// A picture and nothing beside it: all that a filter reads unless it asks for [`Extras`].
    #[must_use]
    pub fn picture(color: &'a wgpu::TextureView) -> Self {
        Self { color, samples: None, depth: None, motion: None, ids: None, signature: None, frame: FrameFacts::default() }
    }
}

impl Extras {
    /// What is asked for, in words.
    #[must_use]
    pub fn names(self) -> Vec<&'static str> {
        let all = [(self.depth, "depth"), (self.motion, "motion"), (self.ids, "ids"), (self.signature, "signature")];
        all.into_iter().filter(|(asked, _)| *asked).map(|(_, name)| name).collect()
    }

    /// What either asks for.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            depth: self.depth || other.depth,
            motion: self.motion || other.motion,
            ids: self.ids || other.ids,
            signature: self.signature || other.signature,
        }
    }
}

impl Needs {
    /// Checks an adapter's features, and sample counts where several samples are needed.
    ///
    /// # Errors
    /// [`Error::Unsupported`] that names what is missing and lists the sample counts there are.
    pub fn check(&self, method: &str, available: wgpu::Features, sample_counts: &[u32]) -> Result<()> {
        let missing = self.features - available;
        if !missing.is_empty() {
            let names: Vec<_> = missing.iter_names().map(|(name, _)| name).collect();
            return Err(Error::Unsupported(format!(
                "{method} needs what this adapter lacks: {}; choose another adapter (`dejag list adapters`)",
                names.join(", ")
            )));
        }
        if !sample_counts.contains(&self.samples) {
            let counts: Vec<_> = sample_counts.iter().map(u32::to_string).collect();
            return Err(Error::Unsupported(format!(
                "{method} needs {} samples a pixel; this adapter has {}",
                self.samples,
                counts.join(", ")
            )));
        }
        Ok(())
    }
}
