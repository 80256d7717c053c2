//! The TAA of `bevy_anti_alias` 0.20.1 by its published behaviour, as something to be held against: eight jitters whose mean is not
//! the pixel's centre, a fixed range of shares, a box of one deviation, and a reset that trusts its only sample like sixty.
//!
//! Its history is trusted more by ten each frame at rest, and by one only as soon as anything moves.

use dejag::pass::{Context, Draw, Extras, FrameFacts, Inputs, Jitter, Needs, Pass, Recorder, Technique};
use wgpu::TextureFormat as Format;

const HISTORY: Format = Format::Rgba16Float;

/// From the pixel's centre in pixels: the centre, then Halton's points 1 to 7 of bases 2 and 3.
const JITTERS_PX: [[f32; 2]; 8] = [
    [0.0, 0.0],
    [0.0, -1.0 / 6.0],
    [-0.25, 1.0 / 6.0],
    [0.25, -7.0 / 18.0],
    [-0.375, -1.0 / 18.0],
    [0.125, 5.0 / 18.0],
    [-0.125, -5.0 / 18.0],
    [0.375, 1.0 / 18.0],
];

/// Without options, as it is there.
#[derive(Debug)]
pub(crate) struct BevyTaa;

impl Technique for BevyTaa {
    fn needs(&self) -> Needs {
        Needs { extras: Extras { depth: true, motion: true, ..Extras::default() }, frames_before: 64, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        let device = context.device;
        let [width, height] = context.size;
        let history = || {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("bevy history"),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: HISTORY,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let bilinear = wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        };
        Ok(Box::new(BevyPass {
            device: device.clone(),
            queue: context.queue.clone(),
            pipeline: pipeline(device, context.output.format),
            frame: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("bevy frame"),
                size: 8,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            bilinear: device.create_sampler(&bilinear),
            histories: [history(), history()],
        }))
    }
}

fn pipeline(device: &wgpu::Device, output: Format) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("bevy.wgsl"));
    let options = wgpu::PipelineCompilationOptions::default;
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("bevy taa"),
        layout: None,
        vertex: wgpu::VertexState { module: &module, entry_point: Some("vs"), compilation_options: options(), buffers: &[] },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: options(),
            targets: &[Some(output.into()), Some(HISTORY.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[derive(Debug)]
struct BevyPass {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    /// Exposure and reset.
    frame: wgpu::Buffer,
    bilinear: wgpu::Sampler,
    /// The newest last.
    histories: [wgpu::TextureView; 2],
}

impl BevyPass {
    fn bindings(&self, inputs: &Inputs<'_>) -> wgpu::BindGroup {
        use wgpu::BindingResource::{Sampler, TextureView};
        let beside = |view: Option<_>| TextureView(view.expect("asked for"));
        let resources = [
            self.frame.as_entire_binding(),
            TextureView(inputs.color),
            beside(inputs.depth),
            beside(inputs.motion),
            TextureView(&self.histories[0]),
            Sampler(&self.bilinear),
        ];
        let entries: Vec<_> =
            resources.into_iter().zip(0..).map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource }).collect();
        let layout = self.pipeline.get_bind_group_layout(0);
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries })
    }
}

impl Pass for BevyPass {
    fn next_draw(&mut self, k: u32, frame: &FrameFacts) -> Option<Draw> {
        let offset_px = JITTERS_PX[frame.index as usize % JITTERS_PX.len()];
        (k == 0).then(|| Draw { jitters: vec![Jitter { offset_px, weight: 1.0 }], ..Draw::default() })
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let words = [inputs.frame.exposure.to_bits(), u32::from(inputs.frame.reset)];
        self.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&words));
        self.histories.swap(0, 1);
        let bindings = self.bindings(inputs);
        let attachments = [output, &self.histories[1]].map(|view| {
            let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store };
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
        });
        let descriptor =
            wgpu::RenderPassDescriptor { label: Some("bevy taa"), color_attachments: &attachments, ..Default::default() };
        recorder.render(&descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
