//! S2x, T2x and 4x: pictures sampled at several places of each pixel, each filtered with areas for its own place, and averaged.
//!
//! After Jimenez et al. 2012, "SMAA", sections on spatial multisampling and temporal supersampling. S2x averages two pictures of one
//! frame; T2x takes one a frame at two places by turns and averages it with the frame before (see [`super::history`]); 4x does both,
//! which makes four places of every two frames.
//!
//! A frame that has none before it is filtered alone: T2x is 1x then, and 4x is S2x.
//!
//! What differs. Samples are always draws of their own: published, S2x and 4x separate the two samples of a hardware 2x MSAA target,
//! which WebGPU does not guarantee. So two samples are shaded where MSAA shades one, textures and shading are anti-aliased too, and
//! 4x is not bound to the hardware's places: its four form a rotated grid instead of two pairs along one diagonal.

use super::history::{History, average, target};
use crate::error::Result;
use crate::methods::morphology::{LineFilter, LineRules, Viewer, texture_bytes};
use crate::pass::{
    Binding, Context, Draw, Encoding, Extras, FrameFacts, Inputs, Jitter, Needs, Options, Pass, Recorder, Role, ScreenPass,
    Surface, Technique,
};

/// Where samples lie, from the pixels' centres, y down.
type Place = [f64; 2];

const TWO: [Place; 2] = [[0.25, 0.25], [-0.25, -0.25]];
const FOUR: [Place; 4] = [[0.125, 0.375], [-0.125, -0.375], [0.375, -0.125], [-0.375, 0.125]];

/// How many draws a frame has, and over how many frames their places go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    S2x,
    T2x,
    FourX,
}

impl Mode {
    /// None is 1x.
    pub(super) const ALL: [(&str, Option<Self>); 4] =
        [("1x", None), ("s2x", Some(Self::S2x)), ("t2x", Some(Self::T2x)), ("4x", Some(Self::FourX))];

    pub(super) fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == name).and_then(|(_, mode)| *mode)
    }

    fn draws(self) -> usize {
        if self == Self::T2x { 1 } else { 2 }
    }

    fn is_temporal(self) -> bool {
        self != Self::S2x
    }

    fn places_px(self) -> &'static [Place] {
        if self == Self::FourX { &FOUR } else { &TWO }
    }

    /// Which of its places the `k`-th draw of a frame samples; none after the last.
    fn place(self, frame_index: u32, k: u32) -> Option<usize> {
        let k = k as usize;
        let first = if self.is_temporal() { (frame_index & 1) as usize * self.draws() } else { 0 };
        (k < self.draws()).then_some(first + k)
    }
}

/// A technique of several samples a pixel.
#[derive(Debug)]
pub(super) struct Several {
    rules: LineRules,
    mode: Mode,
    /// How the frame before loses weight, if motion vectors are followed.
    velocity_scale: Option<f64>,
}

impl Several {
    pub(super) fn new(rules: LineRules, mode: Mode, options: &Options) -> Self {
        let velocity_scale = options.number("velocity_scale").filter(|_| options.switch("reproject"));
        Self { rules, mode, velocity_scale }
    }
}

impl Technique for Several {
    fn needs(&self) -> Needs {
        let motion = self.mode.is_temporal() && self.velocity_scale.is_some();
        Needs {
            role: Role::Draws(Encoding::Display),
            extras: self.rules.needs().extras.union(Extras { motion, ..Extras::default() }),
            samples_per_pixel: self.mode.draws() as u32,
            frames_before: u32::from(self.mode.is_temporal()),
            ..self.rules.needs()
        }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        let blend = self.rules.blend;
        let private = filtered_surface(context.input);
        let filtering = Context { output: private, ..*context };
        let resolving = Context { input: private, ..*context };
        let averaging = if self.mode.is_temporal() { Context { output: private, ..resolving } } else { resolving };
        let areas = self.rules.exact_areas(context, self.mode.places_px());
        Ok(Box::new(SeveralPass {
            mode: self.mode,
            filter: self.rules.build_with(&filtering, areas)?,
            pair: (self.mode.draws() == 2).then(|| Pair {
                filtered: [(); 2].map(|()| target(context, "filtered sample", private.format)),
                average: average(&averaging, blend),
            }),
            history: self.mode.is_temporal().then(|| History::new(&resolving, blend, self.velocity_scale)),
        }))
    }
}

/// What a filtered picture is kept in: whatever the input can hold, written to either way.
fn filtered_surface(input: Surface) -> Surface {
    use wgpu::TextureFormat as Format;
    match input.format.remove_srgb_suffix() {
        Format::Rgba8Unorm | Format::Bgra8Unorm if input.format.is_srgb() || input.values == Encoding::Display => {
            Surface::display(Format::Rgba8Unorm)
        }
        Format::Rgba32Float => input,
        _ => Surface { format: Format::Rgba16Float, values: input.values },
    }
}

/// The two samples of a frame.
#[derive(Debug)]
struct Pair {
    filtered: [wgpu::TextureView; 2],
    average: ScreenPass,
}

#[derive(Debug)]
struct SeveralPass {
    mode: Mode,
    filter: LineFilter,
    pair: Option<Pair>,
    history: Option<History>,
}

impl Pass for SeveralPass {
    fn next_draw(&mut self, k: u32, frame: &FrameFacts) -> Option<Draw> {
        let place = self.mode.place(frame.index, k)?;
        let offset_px = self.mode.places_px()[place].map(|x| x as f32);
        Some(Draw { jitters: vec![Jitter { offset_px, weight: 1.0 }], ..Draw::default() })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let Some(place) = self.mode.place(inputs.frame.index, k) else { return };
        let Self { mode, filter, pair, history } = self;
        let frame = history.as_ref().map_or(output, |history| history.target(&inputs.frame));
        let target = pair.as_ref().map_or(frame, |pair| &pair.filtered[k as usize]);
        filter.record_at(recorder, place, inputs, target);
        if mode.place(inputs.frame.index, k + 1).is_some() {
            return;
        }
        if let Some(Pair { filtered, average }) = pair {
            let samples = filtered.clone().map(Binding::Texture);
            average.record(recorder, &samples.each_ref(), &[frame]);
        }
        if let Some(history) = history {
            history.record(recorder, inputs, output);
        }
    }

    fn views(&self) -> &'static [&'static str] {
        match self.history {
            None => self.filter.views(),
            Some(_) => &VIEWS,
        }
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        let kept = self.history.as_ref().and_then(|history| history.view(name));
        kept.or_else(|| self.filter.view(recorder, name))
    }

    fn target_bytes(&self) -> u64 {
        let pair = self.pair.as_ref().map_or(0, |pair| pair.filtered.iter().map(texture_bytes).sum());
        self.filter.target_bytes() + pair + self.history.as_ref().map_or(0, History::bytes)
    }
}

/// Those of the filter are of the frame's last draw.
const VIEWS: [&str; 4] = [Viewer::EDGES, Viewer::WEIGHTS, History::VIEWS[0], History::VIEWS[1]];

#[cfg(all(test, feature = "workbench"))]
mod tests;
