//! The recursive scheme: a square has samples at its centre E and its corners A to D, and the mean E/2 + (A + B + C + D)/8. Where
//! E and a corner differ by more than `threshold`, the quadrant between them is a square itself. A pixel is halved twice at most.
//!
//! Corners are shared between squares and between pixels, so a pixel without detail costs two samples and one that is refined
//! throughout 32 of the 41 that it uses; pixels of the last column and row also take the corners that no neighbour owns.
//!
//! Where it is wrong: what lies between a centre and a corner that are alike is never seen, be it a whole wire. And all samples lie
//! on one lattice of nine rows and columns, so that near-level and near-upright edges have nine steps to a pixel.
//!
//! Source: Whitted 1980, An Improved Illumination Model for Shaded Display, its section on anti-aliasing; the centre beside the
//! corners is how it is taught since.
//! Cost: 41 draws of one sample, all but two under a mask; seven full-screen passes. 32 layers of the input's format (256 bytes a
//! pixel with halves) and 24 bytes a pixel beside.

use super::frame::{AdaptiveFrame, show_counts};
use super::samples::{LEVELS, MOST, OWNED, Sample};
use super::targets::{Layers, bytes, of, target};
use crate::error::{Error, Result};
use crate::pass::{
    Binding, Context, Draw, FrameFacts, Inputs, Mask, Needs, Options, Pass, Recorder, ScreenPass, Shaded, Technique,
};
use crate::shader::{Source, part};

pub(super) const REFINE: Source = Source {
    name: "adaptive whitted refine",
    parts: &[
        part!("common/color.wgsl"),
        part!("common/screen.wgsl"),
        part!("adaptive/seen.wgsl"),
        part!("adaptive/whitted.wgsl"),
        part!("adaptive/whitted_refine.wgsl"),
    ],
};

pub(super) const GATHER: Source =
    Source { name: "adaptive whitted gather", parts: &[part!("common/screen.wgsl"), part!("adaptive/whitted_gather.wgsl")] };

pub(super) const MEAN: Source = Source {
    name: "adaptive whitted mean",
    parts: &[part!("common/screen.wgsl"), part!("adaptive/whitted.wgsl"), part!("adaptive/whitted_mean.wgsl")],
};

const BITS: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
const COUNTS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// `scheme=whitted`, its options set.
#[derive(Debug)]
pub(super) struct Recursive {
    threshold: f64,
}

impl Recursive {
    pub(super) fn new(options: &Options) -> Result<Self> {
        if let Some(other) = options.given().iter().find(|name| !["scheme", "threshold"].contains(name)) {
            return Err(Error::Request(format!("adaptive: {other} is of scheme=flat; scheme=whitted takes threshold alone")));
        }
        Ok(Self { threshold: options.number("threshold").unwrap_or_default() })
    }
}

impl Technique for Recursive {
    fn needs(&self) -> Needs {
        Needs { wide_output: true, samples_per_pixel: MOST, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        let limit = context.device.limits().max_texture_dimension_2d;
        if context.size.iter().any(|side| *side >= limit) {
            return Err(Error::Unsupported(format!(
                "adaptive:scheme=whitted keeps a column and a row more than the picture: sides up to {}",
                limit - 1
            )));
        }
        Ok(Box::new(Whitted::new(context, self.threshold)))
    }
}

#[derive(Debug)]
struct Whitted {
    device: wgpu::Device,
    queue: wgpu::Queue,
    size: [u32; 2],
    /// By level.
    samples: Vec<Sample>,
    uniforms: wgpu::Buffer,
    layers: Layers,
    /// Which squares are refined: the bits that `Centre`s are drawn by.
    refined: wgpu::TextureView,
    /// Which `Point`s are taken.
    points: wgpu::TextureView,
    counts: wgpu::TextureView,
    /// By how often pixels are halved.
    refine: Vec<ScreenPass>,
    gather: ScreenPass,
    mean: ScreenPass,
}

impl Whitted {
    fn new(context: &Context<'_>, threshold: f64) -> Self {
        let device = context.device;
        let own = |label, format| target(device, label, context.size, format);
        let pass = |label, source, entry, constants: &[_], targets: &[_]| {
            ScreenPass::new(device, label, source, entry, constants, targets)
        };
        let refine = |depth| {
            let constants = [("THRESHOLD", threshold), ("DEPTH", f64::from(depth))];
            pass("adaptive refine", &REFINE, "fs_refine", &constants, &[BITS])
        };
        let with_border = context.size.map(|side| side + 1);
        Self {
            device: device.clone(),
            queue: context.queue.clone(),
            size: context.size,
            samples: Sample::all(),
            uniforms: AdaptiveFrame::buffer(device),
            layers: Layers::new(device, "adaptive samples", with_border, OWNED, context.input.format),
            refined: own("adaptive refined", BITS),
            points: own("adaptive points", BITS),
            counts: own("adaptive counts", COUNTS),
            refine: (0..LEVELS).map(refine).collect(),
            gather: pass("adaptive gather", &GATHER, "fs_gather", &[], &[BITS]),
            mean: pass("adaptive mean", &MEAN, "fs_mean", &[], &[context.output.format, COUNTS]),
        }
    }

    fn mask(&self, sample: Sample) -> Option<Mask> {
        match sample {
            _ if sample.level() == 0 && sample.on_far_border() == [false; 2] => None,
            Sample::Point([x, y]) => Some(Mask { view: self.points.clone(), bits: 1 << (x + 5 * y) }),
            Sample::Centre([x, y]) => Some(Mask { view: self.refined.clone(), bits: 1 << (x + 4 * y) }),
        }
    }

    /// Copies a drawn sample to its layer; of one on the far border only what lies on that of the picture, one pixel further on,
    /// where its owner would be.
    fn keep(&self, recorder: &mut Recorder<'_>, sample: Sample, picture: &wgpu::Texture) {
        let far = sample.on_far_border();
        let along = |axis: usize, on_border: u32, elsewhere: u32| if far[axis] { on_border } else { elsewhere };
        let [x, y] = [0, 1].map(|axis| along(axis, self.size[axis] - 1, 0));
        let [width, height] = [0, 1].map(|axis| along(axis, 1, self.size[axis]));
        let mut source = picture.as_image_copy();
        source.origin = wgpu::Origin3d { x, y, z: 0 };
        let mut layer = self.layers.all.texture().as_image_copy();
        let [x, y] = [0, 1].map(|axis| along(axis, self.size[axis], 0));
        layer.origin = wgpu::Origin3d { x, y, z: sample.layer() };
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        recorder.clocked("adaptive keep", |encoder| encoder.copy_texture_to_texture(source, layer, size));
    }

    /// Which squares are refined where pixels are halved so often, and which samples that takes.
    fn plan(&mut self, recorder: &mut Recorder<'_>, depth: u32) {
        let bindings = [Binding::Buffer(self.uniforms.clone()), of(&self.layers.all)];
        self.refine[depth as usize].record(recorder, &bindings.each_ref(), &[&self.refined]);
        self.gather.record(recorder, &[&of(&self.refined)], &[&self.points]);
    }

    fn finish(&mut self, recorder: &mut Recorder<'_>, output: &wgpu::TextureView) {
        let bindings = [&self.refined, &self.layers.all, &self.points].map(of);
        self.mean.record(recorder, &bindings.each_ref(), &[output, &self.counts]);
    }
}

impl Pass for Whitted {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        let sample = *self.samples.get(k as usize)?;
        Some(Draw { jitters: vec![sample.jitter()], mask: self.mask(sample), ..Draw::default() })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let sample = self.samples[k as usize];
        self.keep(recorder, sample, inputs.color.texture());
        if k == 0 {
            let frame = AdaptiveFrame { exposure: inputs.frame.exposure };
            self.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&frame));
            // Nothing is refined yet, but the picture's far borders are to be drawn.
            self.plan(recorder, 0);
        }
        match self.samples.get(k as usize + 1) {
            Some(next) if next.level() == sample.level() => {}
            Some(next) => self.plan(recorder, next.level()),
            None => self.finish(recorder, output),
        }
    }

    fn views(&self) -> &'static [&'static str] {
        &["refine"]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        (name == "refine").then(|| show_counts(&self.device, recorder, &self.counts, OWNED))
    }

    fn shaded(&self) -> Option<Shaded> {
        Some(Shaded { counts: self.counts.clone(), beside: 0 })
    }

    fn target_bytes(&self) -> u64 {
        [&self.layers.all, &self.refined, &self.points, &self.counts].into_iter().map(bytes).sum()
    }
}
