//! Hardware multisampling: coverage and depth at several places of each pixel, shading once a surface, then a resolve.
//!
//! The hardware's own resolve is the plain mean of a pixel's samples. Ours weights each sample at its true position by any filter
//! over any radius, so it may reach into neighbouring pixels, and can weight by 1/(1 + luminance) or 1/(1 + largest channel) of the
//! exposed colour, which keeps one bright sample from washing out an edge (Karis 2013) at the price of energy.
//! Positions are those of the Direct3D and Vulkan standard, which wgpu cannot query; drivers that deviate shift the weights.
//!
//! Alpha to coverage turns the opacity of alpha-tested surfaces into a number of covered samples, the opacity sharpened around
//! the cut-off by its screen derivative (Golus 2017). Cost: one draw and one resolve.

use wgpu::util::DeviceExt as _;

use crate::error::{Error, Result};
use crate::pass::{
    Binding, Context, Draw, FrameFacts, Inputs, Kind, Method, Needs, OptionSpec, Options, Pass, Recorder, ScreenPass, Technique,
};
use crate::sampling::{FILTERS, Filter, filter, standard_positions};
use crate::shader::{Source, layout::gpu_struct, part};

const SHADER: Source =
    Source { name: "msaa", parts: &[part!("common/screen.wgsl"), part!("common/color.wgsl"), part!("msaa.wgsl")] };

const WEIGHTS: [&str; 3] = ["none", "luma", "max3"];

pub(super) const METHOD: Method = Method {
    name: "msaa",
    summary: "hardware multisampling with the hardware's resolve or a filtered, HDR-weighted one",
    source: "Akeley 1993, RealityEngine Graphics; weights: Karis 2013",
    options: &[
        OptionSpec {
            name: "samples",
            help: "samples a pixel; which ones exist depends on the adapter",
            kind: Kind::Choice(|| vec!["2", "4", "8", "16"]),
            default: "4",
        },
        OptionSpec {
            name: "resolve",
            help: "box is the hardware's mean unless weighted or given a radius",
            kind: Kind::Choice(|| FILTERS.iter().map(|f| f.name).collect()),
            default: "box",
        },
        OptionSpec {
            name: "radius",
            help: "of the resolve in pixels; auto is the filter's own",
            kind: Kind::NumberOrAuto { min: 0.5, max: 3.0 },
            default: "auto",
        },
        OptionSpec {
            name: "weight",
            help: "tone-map weight of each sample: 1/(1+luminance) or 1/(1+largest channel)",
            kind: Kind::Choice(|| WEIGHTS.to_vec()),
            default: "none",
        },
        OptionSpec { name: "a2c", help: "alpha to coverage for alpha-tested surfaces", kind: Kind::Switch, default: "off" },
    ],
    configure: |options| Ok(Box::new(Msaa::new(options)?)),
    shaders: &[SHADER],
    layouts: &[Tap::LAYOUT, ResolveUniforms::LAYOUT],
};

gpu_struct! {
    /// One sample of the resolve's footprint.
    struct Tap {
        /// From the resolved pixel, in whole pixels.
        offset: [i32; 2],
        /// Number of the sample in that pixel.
        index: u32,
        /// The filter at the sample's true position.
        weight: f32,
    }
}

gpu_struct! {
    /// What the resolve needs to know of the frame.
    struct ResolveUniforms {
        /// Factor on linear colour before the tone map.
        exposure: f32,
    }
}

#[derive(Debug)]
struct Msaa {
    samples: u32,
    alpha_to_coverage: bool,
    /// None: the hardware's resolve.
    footprint: Option<Vec<Tap>>,
    weighting: usize,
}

impl Msaa {
    fn new(options: &Options) -> Result<Self> {
        let samples = options.word("samples").parse().map_err(|_| Error::Request("msaa: samples is no number".into()))?;
        let weighting = WEIGHTS.iter().position(|w| *w == options.word("weight")).unwrap_or(0);
        let (name, radius_px) = (options.word("resolve"), options.number("radius"));
        let filter = filter(name)?;
        let hardware = name == "box" && radius_px.is_none() && weighting == 0;
        let footprint = (!hardware).then(|| footprint(samples, filter, radius_px.unwrap_or(filter.default_radius_px)));
        Ok(Self { samples, alpha_to_coverage: options.switch("a2c"), footprint, weighting })
    }
}

/// Every sample of the neighbourhood that the filter gives weight to, nearest rows first in reading order.
fn footprint(samples: u32, filter: &Filter, radius_px: f64) -> Vec<Tap> {
    let reach = (radius_px + 0.5).ceil() as i32;
    let mut taps = Vec::new();
    for y in -reach..=reach {
        for x in -reach..=reach {
            for (position, index) in standard_positions(samples).into_iter().flatten().zip(0..) {
                let at = [f64::from(x) + f64::from(position[0]) / 16.0, f64::from(y) + f64::from(position[1]) / 16.0];
                let weight = filter.weight(at, radius_px) as f32;
                if weight != 0.0 {
                    taps.push(Tap { offset: [x, y], index, weight });
                }
            }
        }
    }
    taps
}

impl Technique for Msaa {
    fn needs(&self) -> Needs {
        // WebGPU guarantees 4 samples; other counts are the adapter's own.
        let specific = wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
        let features = if self.samples == 4 { wgpu::Features::empty() } else { specific };
        Needs { samples: self.samples, features, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        let draw = Draw { samples: self.samples, alpha_to_coverage: self.alpha_to_coverage, ..Draw::default() };
        let Some(footprint) = &self.footprint else {
            if context.input.format != context.output.format {
                return Err(Error::Unsupported(format!(
                    "the hardware resolves {:?} to the same format only, not to {:?}; choose a resolve with a radius",
                    context.input.format, context.output.format
                )));
            }
            return Ok(Box::new(HardwareResolve { draw }));
        };
        let buffer = |label, contents, usage| {
            context.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        let constants = [("WEIGHTING", self.weighting as f64)];
        Ok(Box::new(FilteredResolve {
            draw,
            queue: context.queue.clone(),
            taps: buffer("msaa taps", bytemuck::cast_slice(footprint), wgpu::BufferUsages::STORAGE),
            uniforms: buffer(
                "msaa uniforms",
                bytemuck::bytes_of(&ResolveUniforms { exposure: 1.0 }),
                wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            ),
            resolve: ScreenPass::new(context.device, "msaa resolve", &SHADER, "fs_resolve", &constants, &[context.output.format]),
        }))
    }
}

/// The mean of a pixel's samples, made by the hardware at the end of an empty render pass.
#[derive(Debug)]
struct HardwareResolve {
    draw: Draw,
}

impl Pass for HardwareResolve {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        (k == 0).then(|| self.draw.clone())
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let attachment = wgpu::RenderPassColorAttachment {
            view: inputs.color,
            depth_slice: None,
            resolve_target: Some(output),
            ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
        };
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some("msaa resolve"),
            color_attachments: &[Some(attachment)],
            ..Default::default()
        };
        recorder.render(&descriptor, |_| ());
    }
}

/// Our own resolve: a footprint of weighted samples.
#[derive(Debug)]
struct FilteredResolve {
    draw: Draw,
    queue: wgpu::Queue,
    taps: wgpu::Buffer,
    uniforms: wgpu::Buffer,
    resolve: ScreenPass,
}

impl Pass for FilteredResolve {
    fn next_draw(&mut self, k: u32, _: &FrameFacts) -> Option<Draw> {
        (k == 0).then(|| self.draw.clone())
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let uniforms = ResolveUniforms { exposure: inputs.frame.exposure };
        self.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&uniforms));
        let bindings =
            [Binding::Texture(inputs.color.clone()), Binding::Buffer(self.taps.clone()), Binding::Buffer(self.uniforms.clone())];
        self.resolve.record(recorder, &bindings.each_ref(), &[output]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_of_half_a_pixel_is_the_pixels_own_samples() {
        for samples in [2, 4, 8] {
            let taps = footprint(samples, filter("box").expect("exists"), 0.5);
            assert_eq!(taps.len(), samples as usize);
            assert!(taps.iter().all(|tap| tap.offset == [0, 0] && tap.weight == 1.0));
        }
    }
}
