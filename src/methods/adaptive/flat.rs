//! The flat scheme: probes, then round after round under a mask.

use std::ops::Range;

use super::Adaptive;
use super::frame::{AdaptiveFrame, SHOW, show_counts};
use super::targets::{Layers, bytes, of, target};
use crate::pass::{Binding, Context, Draw, FrameFacts, Inputs, Jitter, Mask, Pass, Recorder, ScreenPass, Shaded, Sum, Target};
use crate::shader::{Source, part};

pub(super) const KEEP: Source =
    Source { name: "adaptive keep", parts: &[part!("common/screen.wgsl"), part!("adaptive/keep.wgsl")] };

pub(super) const DETECT: Source = Source {
    name: "adaptive detect",
    parts: &[
        part!("common/color.wgsl"),
        part!("common/screen.wgsl"),
        part!("adaptive/seen.wgsl"),
        part!("adaptive/doubt.wgsl"),
        part!("adaptive/detect.wgsl"),
    ],
};

pub(super) const SPREAD: Source = Source {
    name: "adaptive spread",
    parts: &[part!("common/screen.wgsl"), part!("adaptive/doubt.wgsl"), part!("adaptive/spread.wgsl")],
};

pub(super) const SETTLE: Source = Source {
    name: "adaptive settle",
    parts: &[
        part!("common/color.wgsl"),
        part!("common/screen.wgsl"),
        part!("adaptive/seen.wgsl"),
        part!("adaptive/doubt.wgsl"),
        part!("adaptive/settle.wgsl"),
    ],
};

const SURFACE: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;
const TOTAL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const MASK: wgpu::TextureFormat = wgpu::TextureFormat::R8Uint;

/// How many times the samples so far a pixel has after a round. Each round costs two looks at the whole picture.
const GROWTH: usize = 4;

/// One request to draw.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Step {
    /// A probe, kept by itself.
    Probe(usize),
    /// Samples that every pixel gets and that count, where the probes do not.
    Base(Range<usize>),
    /// Samples under the mask. The last of a round closes it.
    Refine { samples: Range<usize>, closes: bool },
}

/// Every request of a frame, in order.
fn steps(probes: usize, most: usize, independent: bool, most_a_draw: usize) -> Vec<Step> {
    let mut steps: Vec<Step> = (0..probes).map(Step::Probe).collect();
    if independent {
        steps.push(Step::Base(0..probes));
    }
    let mut taken = probes;
    while taken < most {
        // Independent probes decide once, for all samples.
        let end = if independent { most } else { (GROWTH * taken).min(most) };
        for from in (taken..end).step_by(most_a_draw) {
            let to = (from + most_a_draw).min(end);
            steps.push(Step::Refine { samples: from..to, closes: to == end });
        }
        taken = end;
    }
    steps
}

#[derive(Debug)]
pub(super) struct Flat {
    queue: wgpu::Queue,
    device: wgpu::Device,
    probes: Vec<Jitter>,
    samples: Vec<Jitter>,
    steps: Vec<Step>,
    independent: bool,
    wants_outline: bool,
    uniforms: wgpu::Buffer,
    colors: Layers,
    /// Where a criterion reads them.
    surfaces: Option<(Layers, ScreenPass)>,
    by_signature: bool,
    no_surfaces: Layers,
    outline: wgpu::TextureView,
    /// Sum of all samples that count, and as it was before the round.
    total: wgpu::TextureView,
    before: wgpu::TextureView,
    /// The mask, and the one being made.
    doubts: [wgpu::TextureView; 2],
    detect: ScreenPass,
    spread: Option<ScreenPass>,
    settle: ScreenPass,
    show: ScreenPass,
}

impl Flat {
    pub(super) fn new(context: &Context<'_>, method: &Adaptive) -> Self {
        let device = context.device;
        let criteria = method.criteria;
        let own = |label, format| target(device, label, context.size, format);
        let threshold = ("THRESHOLD", method.threshold);
        let on = |name, on| (name, f64::from(u8::from(on)));
        let detecting = [
            threshold,
            on("BY_COLOR", criteria.color),
            on("BY_GRADIENT", criteria.gradient),
            on("BY_VARIANCE", criteria.variance),
            on("BY_DEPTH", criteria.depth),
            on("BY_IDS", criteria.ids || criteria.signature),
        ];
        let pass = |label, source, entry, constants: &[_], targets: &[_]| {
            ScreenPass::new(device, label, source, entry, constants, targets)
        };
        let probes = method.probes.len() as u32;
        let layers = |label, size, format| Layers::new(device, label, size, probes, format);
        let reach = [("REACH", f64::from(method.dilate))];
        let keep = || pass("adaptive keep", &KEEP, "fs_keep", &[], &[SURFACE]);
        Self {
            queue: context.queue.clone(),
            device: device.clone(),
            probes: method.probes.clone(),
            samples: method.samples.clone(),
            steps: steps(method.probes.len(), method.samples.len(), method.independent, jitters_a_draw(context.size)),
            independent: method.independent,
            wants_outline: method.outline,
            uniforms: AdaptiveFrame::buffer(device),
            colors: layers("adaptive probes", context.size, context.input.format),
            surfaces: criteria.reads_surfaces().then(|| (layers("adaptive surfaces", context.size, SURFACE), keep())),
            by_signature: criteria.signature,
            no_surfaces: layers("adaptive no surfaces", [1; 2], SURFACE),
            outline: own("adaptive outline", MASK),
            total: own("adaptive total", TOTAL),
            before: own("adaptive total before", TOTAL),
            doubts: [(); 2].map(|()| own("adaptive doubts", MASK)),
            detect: pass("adaptive detect", &DETECT, "fs_detect", &detecting, &[TOTAL, MASK]),
            spread: (method.dilate > 0).then(|| pass("adaptive spread", &SPREAD, "fs_spread", &reach, &[MASK])),
            settle: pass("adaptive settle", &SETTLE, "fs_settle", &[threshold], &[MASK]),
            show: pass("adaptive show", &SHOW, "fs_show", &[], &[context.output.format]),
        }
    }

    fn keep_probe(&mut self, recorder: &mut Recorder<'_>, index: usize, inputs: &Inputs<'_>) {
        recorder.clocked("adaptive keep", |encoder| self.colors.copy_from(encoder, inputs.color.texture(), index));
        if let Some((surfaces, keep)) = &mut self.surfaces {
            let owed = |view: Option<&wgpu::TextureView>, what| {
                of(view.unwrap_or_else(|| panic!("adaptive compares surfaces: its host owes it Inputs::{what}")))
            };
            let bindings = match self.by_signature {
                true => [owed(inputs.depth, "depth"), owed(inputs.signature, "signature")],
                false => [owed(inputs.depth, "depth"), owed(inputs.ids, "ids")],
            };
            keep.record(recorder, &bindings.each_ref(), &[surfaces.layer(index)]);
        }
    }

    fn judge_probes(&mut self, recorder: &mut Recorder<'_>, exposure: f32) {
        self.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&AdaptiveFrame { exposure }));
        let surfaces = self.surfaces.as_ref().map_or(&self.no_surfaces, |(layers, _)| layers);
        let bindings = [Binding::Buffer(self.uniforms.clone()), of(&self.colors.all), of(&surfaces.all), of(&self.outline)];
        // Where the probes do not count, their sum goes where nobody reads it.
        let total = if self.independent { &self.before } else { &self.total };
        self.detect.record(recorder, &bindings.each_ref(), &[total, &self.doubts[0]]);
        if let Some(spread) = &mut self.spread {
            spread.record(recorder, &[&of(&self.doubts[0])], &[&self.doubts[1]]);
            self.doubts.swap(0, 1);
        }
        self.remember(recorder);
    }

    /// Keeps the total as it is, to tell what the next round brings.
    fn remember(&self, recorder: &mut Recorder<'_>) {
        recorder.clocked("adaptive remember", |encoder| {
            let [from, to] = [&self.total, &self.before].map(|view| view.texture().as_image_copy());
            encoder.copy_texture_to_texture(from, to, self.total.texture().size());
        });
    }

    fn close_round(&mut self, recorder: &mut Recorder<'_>) {
        let textures = [&self.before, &self.total, &self.doubts[0]];
        let bindings: Vec<Binding> = std::iter::once(Binding::Buffer(self.uniforms.clone())).chain(textures.map(of)).collect();
        self.settle.record(recorder, &bindings.iter().collect::<Vec<_>>(), &[&self.doubts[1]]);
        self.doubts.swap(0, 1);
        self.remember(recorder);
    }
}

/// Jitters a request: masked draws are cheap, and each request looks at the mask once.
fn jitters_a_draw([width, height]: [u32; 2]) -> usize {
    const SAMPLES_A_DRAW: u64 = 60_000_000;
    (SAMPLES_A_DRAW / (u64::from(width) * u64::from(height))).clamp(4, 64) as usize
}

impl Pass for Flat {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        let total = |clear| Target::Sum(Sum { view: self.total.clone(), clear });
        Some(match self.steps.get(k as usize)?.clone() {
            Step::Probe(index) => Draw {
                jitters: vec![self.probes[index]],
                outline: (index == 0 && self.wants_outline).then(|| self.outline.clone()),
                ..Draw::default()
            },
            Step::Base(samples) => Draw { jitters: self.samples[samples].to_vec(), target: total(true), ..Draw::default() },
            Step::Refine { samples, .. } => Draw {
                jitters: self.samples[samples].to_vec(),
                mask: Some(Mask::non_zero(self.doubts[0].clone())),
                target: total(false),
                ..Draw::default()
            },
        })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let is_last = k as usize + 1 == self.steps.len();
        match self.steps[k as usize] {
            Step::Probe(index) => {
                self.keep_probe(recorder, index, inputs);
                if index + 1 == self.probes.len() {
                    self.judge_probes(recorder, inputs.frame.exposure);
                }
            }
            Step::Refine { closes, .. } if closes && !is_last => self.close_round(recorder),
            Step::Refine { .. } | Step::Base(_) => {}
        }
        if is_last {
            self.show.record(recorder, &[&of(&self.total)], &[output]);
        }
    }

    fn views(&self) -> &'static [&'static str] {
        &["refine"]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        (name == "refine").then(|| show_counts(&self.device, recorder, &self.total, self.samples.len() as u32))
    }

    fn shaded(&self) -> Option<Shaded> {
        let beside = if self.independent { self.probes.len() } else { 0 };
        Some(Shaded { counts: self.total.clone(), beside: beside as u32 })
    }

    fn target_bytes(&self) -> u64 {
        let surfaces = self.surfaces.as_ref().map(|(layers, _)| &layers.all);
        let one = [&self.colors.all, &self.outline, &self.total, &self.before];
        one.into_iter().chain(&self.doubts).chain(surfaces).map(bytes).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sample is taken once and in order, and a round ends where it should.
    #[test]
    fn steps_cover_every_sample() {
        for (probes, most, independent, most_a_draw) in
            [(4, 64, false, 50), (1, 64, false, 4), (4, 64, true, 50), (3, 100, false, 8), (4, 4, false, 50), (16, 17, true, 1)]
        {
            let mut next = probes;
            let mut ends = Vec::new();
            for step in steps(probes, most, independent, most_a_draw) {
                let Step::Refine { samples, closes } = step else { continue };
                assert_eq!(samples.start, next);
                assert!(samples.len() <= most_a_draw);
                next = samples.end;
                if closes {
                    ends.push(next);
                }
            }
            assert_eq!(next, most);
            let growing = std::iter::successors(Some(probes), |n| Some(n * GROWTH)).skip(1);
            let expected: Vec<usize> = match independent {
                _ if probes == most => vec![],
                true => vec![most],
                false => growing.take_while(|n| *n < most).chain([most]).collect(),
            };
            assert_eq!(ends, expected);
        }
    }
}
