//! Temporal anti-aliasing: each frame samples another place in the pixel, and a running mean follows the surfaces as they move.
//!
//! The mean is kept as its value and the number of frames it stands for: the n-th frame counts 1/n until `most` is reached, so a
//! still picture converges as supersampling with the same jitters does, and a picture that changes begins anew. History is fetched
//! where motion vectors say the surface was (Nehab et al. 2007; Karis 2014, High Quality Temporal Supersampling), refused where it
//! is of another surface, and held against the box of this frame's colours (Salvi 2016, for the variance box). Its edges:
//!
//! - **Thin things.** A line thinner than a pixel is missing from most frames, and the frame's own box would clip it away. So the
//!   box is remembered and gives way slowly (`memory`), unless it has nothing in common with the new one: then the light changed.
//! - **What is bared.** History is refused where its surface is no longer seen around the pixel, by object id or by depth, but only
//!   where that surface moved against the one seen now: what moves together hides nothing, it only fell between the samples.
//! - **Whole pixels.** History at a whole offset (within 1/1024 pixel) is read as it is; elsewhere by a cubic, kept between the four
//!   pixels around.
//! - **Numbers that are none** are no samples: their weight is zero and their neighbours' boxes leave them out.
//! - **Halves** are rounded up or down by chance in proportion, so that a mean of many frames neither stalls nor drifts.
//!
//! With `weight=luma` colours are averaged and compared as c / (1 + luminance), which is the mean weighted by 1 / (1 + luminance):
//! bright samples flicker less, and light is lost; `weight=none` loses none.
//!
//! Needs one draw a frame with motion vectors, and depth or ids where options ask for them; one frame a submission. Cost: a pass
//! that fetches history and a pass that shows it; 16 bytes a pixel and frame beside the history.

mod options;
mod pass;

use crate::error::Result;
use crate::pass::{Context, Encoding, Extras, Method, Needs, Options, Pass, Role, Technique};
use crate::sampling::{jitter_cycle, pattern};
use options::Settings;

use super::Spec;

pub(super) const METHOD: Method = Method {
    name: "taa",
    summary: "temporal: jittered frames in a running mean that follows motion; needs a sequence",
    source: "Karis 2014, High Quality Temporal Supersampling; Salvi 2016",
    options: Settings::OPTIONS,
    configure: |options| Ok(Box::new(Taa::new(options)?)),
    shaders: &[pass::RESOLVE, pass::SHOW],
    layouts: &[pass::TaaFrame::LAYOUT],
};

#[derive(Debug)]
struct Taa {
    settings: Settings,
    /// From the pixel's centre in pixels, y down.
    jitters: Vec<[f64; 2]>,
    fallback: Option<Box<dyn Technique>>,
}

impl Taa {
    fn new(options: &Options) -> Result<Self> {
        let settings = Settings::new(options);
        let jitters = jitter_cycle(pattern(settings.jitter)?, settings.cycle, 0);
        let fallback = match settings.fallback {
            "off" => None,
            name => Some(Spec::parse(name)?.stages.swap_remove(0).technique),
        };
        Ok(Self { settings, jitters, fallback })
    }
}

impl Technique for Taa {
    fn needs(&self) -> Needs {
        Needs {
            role: Role::Draws(Encoding::Linear),
            wide_output: !self.settings.in_halves,
            extras: Extras {
                depth: self.settings.reads_depth(),
                motion: true,
                ids: self.settings.rejects_by("ids"),
                ..Extras::default()
            },
            frames_before: self.settings.most.max(self.settings.cycle),
            ..Needs::default()
        }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        Ok(Box::new(pass::TaaPass::new(context, &self.settings, &self.jitters, self.fallback.as_deref())?))
    }
}
