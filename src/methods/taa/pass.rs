//! The pass: this frame into the mean, the mean into the output.

use crate::error::Result;
use crate::pass::{Binding, Context, Draw, FrameFacts, Inputs, Jitter, Pass, Recorder, ScreenPass, Surface, Technique};
use crate::sampling::{Filter, filter};
use crate::shader::{Source, layout::gpu_struct, part};

use super::options::Settings;

pub(super) const RESOLVE: Source = Source {
    name: "taa resolve",
    parts: &[
        part!("common/color.wgsl"),
        part!("common/screen.wgsl"),
        part!("taa/frame.wgsl"),
        part!("taa/working.wgsl"),
        part!("taa/neighborhood.wgsl"),
        part!("taa/memory.wgsl"),
        part!("taa/reproject.wgsl"),
        part!("common/moved.wgsl"),
        part!("taa/interpolate.wgsl"),
        part!("taa/history.wgsl"),
        part!("taa/resolve.wgsl"),
    ],
};

pub(super) const SHOW: Source = Source {
    name: "taa show",
    parts: &[
        part!("common/color.wgsl"),
        part!("common/screen.wgsl"),
        part!("taa/frame.wgsl"),
        part!("taa/working.wgsl"),
        part!("taa/show.wgsl"),
    ],
};

gpu_struct! {
    /// What a frame brings beside its pictures.
    struct TaaFrame {
        /// A clip position of this frame to where a point that stands still was in the frame before.
        previous_clip_from_clip: [[f32; 4]; 4],
        /// What each sample of the 3 x 3 counts, a column a row of the picture.
        input_weights: [[f32; 4]; 3],
        /// What the whole of them counts beside other frames'.
        frame_weight: f32,
        /// Factor on linear colour before the tone map.
        exposure: f32,
        /// Changes what is rounded up.
        seed: u32,
        /// Whether what came before must be forgotten.
        reset: u32,
    }
}

const MEMORY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
const VIEWS: [&str; 4] = ["history", "frames", "refused", "clipped"];

/// What is handed from a frame to the next.
#[derive(Debug)]
struct Kept {
    history: wgpu::TextureView,
    memory: wgpu::TextureView,
}

#[derive(Debug)]
pub(super) struct TaaPass {
    device: wgpu::Device,
    queue: wgpu::Queue,
    settings: Settings,
    jitters: Vec<Jitter>,
    input: InputFilter,
    uniforms: wgpu::Buffer,
    resolve: ScreenPass,
    show: ScreenPass,
    /// The newest last.
    kept: [Kept; 2],
    has_history: bool,
    /// Stands in for what is not read.
    unread: Unread,
    fallback: Option<(Box<dyn Pass>, wgpu::TextureView)>,
}

/// Pictures of one pixel.
#[derive(Debug)]
struct Unread {
    depth: wgpu::TextureView,
    ids: wgpu::TextureView,
}

impl TaaPass {
    pub(super) fn new(
        context: &Context<'_>,
        settings: &Settings,
        jitters_px: &[[f64; 2]],
        fallback: Option<&dyn Technique>,
    ) -> Result<Self> {
        let history_format = match settings.in_halves {
            true => wgpu::TextureFormat::Rgba16Float,
            false => wgpu::TextureFormat::Rgba32Float,
        };
        let target = |label, format| texture(context, label, context.size, format);
        let kept = || Kept { history: target("taa history", history_format), memory: target("taa memory", MEMORY_FORMAT) };
        let fallback = fallback.map(|technique| {
            let output = target("taa fallback", wgpu::TextureFormat::Rgba16Float);
            let surface = Surface::linear(output.texture().format());
            let pass = technique.build(&Context { input: context.input, output: surface, ..*context })?;
            Ok::<_, crate::Error>((pass, output))
        });
        let constants = settings.resolve_constants();
        let mut showing = settings.space_constants();
        showing.push(("SHARPEN", settings.sharpen));
        let formats = [history_format, MEMORY_FORMAT];
        Ok(Self {
            device: context.device.clone(),
            queue: context.queue.clone(),
            settings: *settings,
            jitters: jitters_px.iter().map(|p| Jitter { offset_px: p.map(|x| x as f32), weight: 1.0 }).collect(),
            input: InputFilter::new(filter(settings.input)?, jitters_px),
            uniforms: context.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("taa frame"),
                size: size_of::<TaaFrame>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            resolve: ScreenPass::new(context.device, "taa resolve", &RESOLVE, "fs_resolve", &constants, &formats),
            show: ScreenPass::new(context.device, "taa show", &SHOW, "fs_show", &showing, &[context.output.format]),
            kept: [kept(), kept()],
            has_history: false,
            unread: Unread {
                depth: texture(context, "no depth", [1; 2], wgpu::TextureFormat::Depth32Float),
                ids: texture(context, "no ids", [1; 2], wgpu::TextureFormat::R32Uint),
            },
            fallback: fallback.transpose()?,
        })
    }

    fn uniforms(&self, frame: &FrameFacts) -> TaaFrame {
        let (input_weights, frame_weight) = self.input.weights(frame.jitter_px.map(f64::from));
        TaaFrame {
            previous_clip_from_clip: frame.previous_clip_from_clip,
            input_weights,
            frame_weight,
            exposure: frame.exposure,
            seed: frame.index,
            reset: u32::from(frame.reset || !self.has_history),
        }
    }
}

fn texture(context: &Context<'_>, label: &str, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = context.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

impl Pass for TaaPass {
    fn next_draw(&mut self, k: u32, frame: &FrameFacts) -> Option<Draw> {
        let jitter = self.jitters[frame.index as usize % self.jitters.len()];
        (k == 0).then(|| Draw { jitters: vec![jitter], ..Draw::default() })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        self.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&self.uniforms(&inputs.frame)));
        let filtered = match &mut self.fallback {
            Some((pass, filtered)) => {
                pass.record(recorder, 0, inputs, filtered);
                &*filtered
            }
            None => inputs.color,
        };
        let motion = inputs.motion.unwrap_or_else(|| panic!("taa follows motion vectors: its host owes it Inputs::motion"));
        let of = |view: &wgpu::TextureView| Binding::Texture(view.clone());
        let uniforms = Binding::Buffer(self.uniforms.clone());
        self.kept.swap(0, 1);
        let [past, new] = &self.kept;
        let bindings = [
            uniforms.clone(),
            of(inputs.color),
            of(inputs.depth.unwrap_or(&self.unread.depth)),
            of(motion),
            of(inputs.ids.unwrap_or(&self.unread.ids)),
            of(&past.history),
            of(&past.memory),
            of(filtered),
        ];
        self.resolve.record(recorder, &bindings.each_ref(), &[&new.history, &new.memory]);
        self.show.record(recorder, &[&uniforms, &of(&new.history)], &[output]);
        self.has_history = true;
    }

    fn views(&self) -> &'static [&'static str] {
        &VIEWS
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        let [_, newest] = &self.kept;
        let kind = VIEWS.iter().position(|known| *known == name)?;
        if kind == 0 {
            return Some(newest.history.clone());
        }
        let shown = newest.history.texture();
        let target = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("taa view"),
            size: shown.size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let target = target.create_view(&wgpu::TextureViewDescriptor::default());
        let constants = [("VIEW", (kind - 1) as f64), ("MOST_STILL", f64::from(self.settings.most))];
        let bindings = [&newest.history, &newest.memory].map(|view| Binding::Texture(view.clone()));
        ScreenPass::new(&self.device, "taa view", &SHOW, "fs_view", &constants, &[wgpu::TextureFormat::Rgba8Unorm]).record(
            recorder,
            &bindings.each_ref(),
            &[&target],
        );
        Some(target)
    }

    fn target_bytes(&self) -> u64 {
        let bytes = |view: &wgpu::TextureView| {
            let texture = view.texture();
            let texel = texture.format().block_copy_size(None).unwrap_or(0);
            u64::from(texture.width()) * u64::from(texture.height()) * u64::from(texel)
        };
        let kept: u64 = self.kept.iter().map(|kept| bytes(&kept.history) + bytes(&kept.memory)).sum();
        kept + self.fallback.as_ref().map_or(0, |(pass, filtered)| pass.target_bytes() + bytes(filtered))
    }
}

/// What a frame's samples count for the pixel's centre, by where the frame was sampled.
#[derive(Debug)]
struct InputFilter {
    filter: &'static Filter,
    radius_px: f64,
    /// Of all weights of a frame, over the cycle.
    mean_sum: f64,
}

impl InputFilter {
    fn new(filter: &'static Filter, jitters_px: &[[f64; 2]]) -> Self {
        // Of a wider one the 3 x 3 would hold a part only.
        let mut input = Self { filter, radius_px: filter.default_radius_px.min(1.5), mean_sum: 1.0 };
        let sum: f64 = jitters_px.iter().map(|jitter| input.sum(*jitter)).sum();
        input.mean_sum = sum / jitters_px.len() as f64;
        input
    }

    fn is_own_sample(&self) -> bool {
        self.filter.name == "box"
    }

    fn weight(&self, jitter_px: [f64; 2], row: usize, column: usize) -> f64 {
        if self.is_own_sample() {
            return f64::from(u8::from((row, column) == (1, 1)));
        }
        self.filter.weight([column as f64 - 1.0 + jitter_px[0], row as f64 - 1.0 + jitter_px[1]], self.radius_px)
    }

    fn sum(&self, jitter_px: [f64; 2]) -> f64 {
        (0..9).map(|i| self.weight(jitter_px, i / 3, i % 3)).sum()
    }

    /// Each sample's share, and what the frame counts: one that lies badly for the pixel counts less.
    fn weights(&self, jitter_px: [f64; 2]) -> ([[f32; 4]; 3], f32) {
        let sum = self.sum(jitter_px);
        let mut weights = [[0.0; 4]; 3];
        for (row, weights) in weights.iter_mut().enumerate() {
            for (column, weight) in weights.iter_mut().enumerate().take(3) {
                *weight = (self.weight(jitter_px, row, column) / sum) as f32;
            }
        }
        (weights, (sum / self.mean_sum).clamp(0.1, 4.0) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{FILTERS, jitter_cycle, pattern};

    #[test]
    fn shares_sum_to_one_and_frames_count_one_in_the_mean() {
        let jitters = jitter_cycle(pattern("halton").expect("exists"), 16, 0);
        for filter in FILTERS {
            let input = InputFilter::new(filter, &jitters);
            let mut mean = 0.0;
            for jitter in &jitters {
                let (weights, frame) = input.weights(*jitter);
                assert!((weights.iter().flatten().sum::<f32>() - 1.0).abs() < 1e-6, "{}", filter.name);
                mean += frame / 16.0;
            }
            assert!((mean - 1.0).abs() < 1e-5, "{}: {mean}", filter.name);
        }
    }

    #[test]
    fn the_box_is_the_pixels_own_sample() {
        let input = InputFilter::new(filter("box").expect("exists"), &[[0.0; 2]]);
        assert_eq!(input.weights([0.4, -0.3]), ([[0.0; 4], [0.0, 1.0, 0.0, 0.0], [0.0; 4]], 1.0));
    }
}
