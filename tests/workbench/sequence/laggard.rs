//! A method that does what temporal anti-aliasing must not: it keeps a share of the last picture where it was, whatever moves.

use dejag::pass::{Context, FrameFacts, Inputs, Needs, Pass, Recorder, Technique};
use wgpu::TextureFormat as Format;

/// What is kept of the last picture, from 0 to below 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Laggard {
    pub(super) keep: f64,
}

const SHADER: &str = "
@vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(4.0 * f32(i & 1u) - 1.0, 4.0 * f32(i >> 1u) - 1.0, 0.0, 1.0);
}
@group(0) @binding(0) var picture: texture_2d<f32>;
@fragment fn fs(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
    return textureLoad(picture, vec2<i32>(p.xy), 0);
}";

impl Technique for Laggard {
    fn needs(&self) -> Needs {
        Needs::default()
    }

    fn build(&self, context: &Context<'_>) -> dejag::Result<Box<dyn Pass>> {
        let [width, height] = context.size;
        let history = context.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("laggard"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Format::Rgba16Float,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let factor =
            |src_factor, dst_factor| wgpu::BlendComponent { src_factor, dst_factor, operation: wgpu::BlendOperation::Add };
        let mix = factor(wgpu::BlendFactor::Constant, wgpu::BlendFactor::OneMinusConstant);
        Ok(Box::new(LaggardPass {
            keep: self.keep,
            device: context.device.clone(),
            history: history.create_view(&wgpu::TextureViewDescriptor::default()),
            mix: pipeline(context.device, Format::Rgba16Float, Some(wgpu::BlendState { color: mix, alpha: mix })),
            show: pipeline(context.device, context.output.format, None),
        }))
    }
}

fn pipeline(device: &wgpu::Device, format: Format, blend: Option<wgpu::BlendState>) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(SHADER.into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("laggard"), source });
    let options = wgpu::PipelineCompilationOptions::default;
    let target = wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("laggard"),
        layout: None,
        vertex: wgpu::VertexState { module: &module, entry_point: Some("vs"), compilation_options: options(), buffers: &[] },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: options(),
            targets: &[Some(target)],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[derive(Debug)]
struct LaggardPass {
    keep: f64,
    device: wgpu::Device,
    history: wgpu::TextureView,
    mix: wgpu::RenderPipeline,
    show: wgpu::RenderPipeline,
}

impl LaggardPass {
    fn screen(
        &self,
        recorder: &mut Recorder<'_>,
        pipeline: &wgpu::RenderPipeline,
        [from, to]: [&wgpu::TextureView; 2],
        share: f64,
    ) {
        let entry = wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(from) };
        let layout = pipeline.get_bind_group_layout(0);
        let group = self.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &[entry] });
        let ops = wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store };
        let attachment = wgpu::RenderPassColorAttachment { view: to, depth_slice: None, resolve_target: None, ops };
        let descriptor =
            wgpu::RenderPassDescriptor { label: Some("lag"), color_attachments: &[Some(attachment)], ..Default::default() };
        recorder.render(&descriptor, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.set_blend_constant(wgpu::Color { r: share, g: share, b: share, a: share });
            pass.draw(0..3, 0..1);
        });
    }
}

impl Pass for LaggardPass {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let FrameFacts { reset, .. } = inputs.frame;
        self.screen(recorder, &self.mix, [inputs.color, &self.history], if reset { 1.0 } else { 1.0 - self.keep });
        self.screen(recorder, &self.show, [&self.history, output], 1.0);
    }
}
