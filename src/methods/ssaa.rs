//! Supersampling by accumulation: the scene is drawn N times, each time moved by a fraction of a pixel, and averaged.
//!
//! The offsets fill the support of a reconstruction filter and each draw counts by the filter's weight there, so wide and
//! negative-lobed filters cost no more than the box; the sum is divided by the sum of weights, which keeps constant areas
//! constant. Sums are f32 on the GPU at constant memory: two rgba32float targets whatever N is. Many offsets go into one request
//! to draw, so that a host can add them without storing each ([`crate::pass::Target::Sum`]).
//!
//! The samples' two halves are kept apart until the end (views `half-a` and `half-b`): their difference is the picture's own
//! noise floor. Cost: N draws and one full-screen pass.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::pass::{
    Binding, Context, Draw, Encoding, FrameFacts, Inputs, Jitter, Kind, Method, Needs, OptionSpec, Options, Pass, Recorder,
    ScreenPass, Sum, Target, Technique,
};
use crate::sampling::{FILTERS, MAX_POINTS, filter, pattern, pattern_names, weighted_offsets};
use crate::shader::{Source, part};

const SHADER: Source = Source { name: "ssaa", parts: &[part!("common/screen.wgsl"), part!("ssaa.wgsl")] };

pub(super) const METHOD: Method = Method {
    name: "ssaa",
    summary: "N jittered draws, accumulated in f32 under any pattern and filter",
    source: "Haeberli and Akeley 1990, The Accumulation Buffer",
    options: &[
        OptionSpec { name: "spp", help: "samples a pixel", kind: Kind::Integer { min: 1, max: MAX_POINTS }, default: "16" },
        OptionSpec {
            name: "pattern",
            help: "where the samples lie; auto is rotated up to 16, larcher for 32 and 64, fibonacci for other numbers",
            kind: Kind::Choice(|| [vec!["auto"], pattern_names()].concat()),
            default: "auto",
        },
        OptionSpec {
            name: "filter",
            help: "how much each counts",
            kind: Kind::Choice(|| FILTERS.iter().map(|f| f.name).collect()),
            default: "box",
        },
        OptionSpec {
            name: "radius",
            help: "of the filter in pixels; auto is the filter's own",
            kind: Kind::NumberOrAuto { min: 0.01, max: 16.0 },
            default: "auto",
        },
        OptionSpec {
            name: "shutter",
            help: "share of a frame's interval over which the samples are spread, around its moment; above 0 what moves is blurred",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0",
        },
        OptionSpec {
            name: "seed",
            help: "of the patterns that use chance",
            kind: Kind::Integer { min: 0, max: u32::MAX },
            default: "0",
        },
    ],
    configure: |options| Ok(Box::new(Ssaa::new(options)?)),
    shaders: &[SHADER],
    layouts: &[],
};

/// Jitters a request: enough to hide what a request costs, few enough to keep a long capture of a large picture responsive.
fn jitters_a_draw([width, height]: [u32; 2]) -> usize {
    const SAMPLES_A_DRAW: u64 = 20_000_000;
    let pixels = u64::from(width) * u64::from(height);
    (SAMPLES_A_DRAW / pixels).clamp(4, 50) as usize
}

/// Samples that share a moment of an open shutter: with more, what moves would show as copies; with fewer, the scene would be
/// set up for each.
const SAMPLES_A_MOMENT: usize = 4;

/// The pattern with the least error on the shipped scenes at so many samples, where one set serves all pixels (docs/sampling.md).
/// Nets are at their best for powers of two and far from it elsewhere; lattices take any number.
fn best_pattern(samples: u32) -> &'static str {
    match samples {
        ..=16 => "rotated",
        32 | 64 => "larcher",
        _ => "fibonacci",
    }
}

#[derive(Debug)]
struct Ssaa {
    jitters: Arc<[Jitter]>,
    shutter: f32,
}

impl Ssaa {
    fn new(options: &Options) -> Result<Self> {
        let filter = filter(options.word("filter"))?;
        let radius_px = options.number("radius").unwrap_or(filter.default_radius_px);
        let count = options.integer("spp");
        let name = Some(options.word("pattern")).filter(|name| *name != "auto").unwrap_or_else(|| best_pattern(count));
        let samples = weighted_offsets(pattern(name)?, count, options.integer("seed"), filter, radius_px);
        let (sum, size) = samples.iter().fold((0.0, 0.0), |(sum, size), s| (sum + s.weight, size + s.weight.abs()));
        // With few samples under negative lobes the weights can cancel, and dividing by their sum would blow up the noise.
        if sum <= 0.05 * size {
            return Err(Error::Request(format!(
                "ssaa: the weights of these {} samples under {} sum to {sum:.3}, too little to divide by; take more samples, a smaller \
                 radius or another filter",
                samples.len(),
                filter.name
            )));
        }
        // Weights of mean 1 keep sums of any count in the middle of f32's range.
        let scale = samples.len() as f64 / sum;
        let jitters = samples
            .iter()
            .map(|s| Jitter { offset_px: s.offset_px.map(|x| x as f32), weight: (s.weight * scale) as f32 })
            .collect();
        Ok(Self { jitters, shutter: options.number("shutter").unwrap_or_default() as f32 })
    }
}

impl Technique for Ssaa {
    fn needs(&self) -> Needs {
        Needs {
            output: Encoding::Linear,
            wide_output: true,
            features: wgpu::Features::FLOAT32_BLENDABLE,
            samples_per_pixel: self.jitters.len() as u32,
            ..Needs::default()
        }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        Ok(Box::new(Accumulation {
            jitters: Arc::clone(&self.jitters),
            jitters_a_draw: if self.shutter > 0.0 { SAMPLES_A_MOMENT } else { jitters_a_draw(context.size) },
            shutter: self.shutter,
            halves: ["ssaa half-a", "ssaa half-b"].map(|label| accumulator(context, label)),
            normalize: ScreenPass::new(context.device, "ssaa normalize", &SHADER, "fs_normalize", &[], &[context.output.format]),
        }))
    }
}

fn accumulator(context: &Context<'_>, label: &str) -> wgpu::TextureView {
    let [width, height] = context.size;
    let texture = context.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The samples' halves.
const VIEWS: [&str; 2] = ["half-a", "half-b"];

#[derive(Debug)]
struct Accumulation {
    jitters: Arc<[Jitter]>,
    jitters_a_draw: usize,
    shutter: f32,
    halves: [wgpu::TextureView; 2],
    normalize: ScreenPass,
}

impl Accumulation {
    /// Where in the open shutter the `k`-th request is, in (0, 1): by the golden ratio, so that near samples are far in time.
    fn moment(&self, k: u32) -> f32 {
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        ((f64::from(k) + 0.5) * GOLDEN).fract() as f32
    }

    /// Which half the `k`-th request adds to, and which jitters it draws. No request straddles the halves.
    fn request(&self, k: u32) -> Option<(usize, bool, &[Jitter])> {
        let (a, b) = self.jitters.split_at(self.jitters.len().div_ceil(2));
        let requests_a = a.len().div_ceil(self.jitters_a_draw);
        let (half, jitters, k) = if (k as usize) < requests_a { (0, a, k as usize) } else { (1, b, k as usize - requests_a) };
        let chunk = jitters.chunks(self.jitters_a_draw).nth(k)?;
        Some((half, k == 0, chunk))
    }
}

impl Pass for Accumulation {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        let (half, clear, jitters) = self.request(k)?;
        let sum = Sum { view: self.halves[half].clone(), clear };
        let time = self.shutter * (self.moment(k) - 0.5);
        Some(Draw { jitters: jitters.to_vec(), time, target: Target::Sum(sum), ..Draw::default() })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, k: u32, _: &Inputs<'_>, output: &wgpu::TextureView) {
        if self.request(k + 1).is_some() {
            return;
        }
        // A single sample leaves the second half as it was made: zero.
        let bindings = self.halves.clone().map(Binding::Texture);
        self.normalize.record(recorder, &bindings.each_ref(), &[output]);
    }

    fn views(&self) -> &'static [&'static str] {
        &VIEWS
    }

    fn view(&mut self, _: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        VIEWS.iter().position(|known| *known == name).map(|half| self.halves[half].clone())
    }

    fn target_bytes(&self) -> u64 {
        self.halves.iter().map(wgpu::TextureView::texture).map(|t| u64::from(t.width()) * u64::from(t.height()) * 16).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_is_the_pattern_that_it_stands_for() {
        let jitters = |text: &str| {
            let options = Options::parse("ssaa", METHOD.options, Some(text)).expect(text);
            Ssaa::new(&options).expect(text).jitters
        };
        for (samples, name) in [
            (1, "rotated"),
            (8, "rotated"),
            (16, "rotated"),
            (17, "fibonacci"),
            (32, "larcher"),
            (64, "larcher"),
            (1000, "fibonacci"),
        ] {
            let stated = jitters(&format!("spp={samples},pattern={name}"));
            assert_eq!(jitters(&format!("spp={samples}")), stated, "{samples}");
            assert_eq!(jitters(&format!("spp={samples},pattern=auto")), stated, "{samples}");
        }
        assert_ne!(jitters("spp=36"), jitters("spp=36,pattern=larcher"));
    }
}
