//! Full-screen passes: one triangle, one bind group, one target.

use super::Recorder;
use crate::shader::Source;

/// A pipeline that fills a target, with its bind group kept for as long as it is given the same resources.
#[derive(Debug)]
pub(crate) struct ScreenPass {
    label: &'static str,
    pipeline: wgpu::RenderPipeline,
    bound: Option<(Vec<Binding>, wgpu::BindGroup)>,
}

/// A resource at binding 0, 1, ... of group 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Binding {
    Texture(wgpu::TextureView),
    Buffer(wgpu::Buffer),
}

impl Binding {
    fn resource(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
            Self::Buffer(buffer) => buffer.as_entire_binding(),
        }
    }
}

impl ScreenPass {
    /// `source` must have the entry points `vs_screen` (see `common/screen.wgsl`) and `fragment`.
    pub(crate) fn new(
        device: &wgpu::Device,
        label: &'static str,
        source: &Source,
        fragment: &str,
        constants: &[(&str, f64)],
        target: wgpu::TextureFormat,
    ) -> Self {
        let module = source.module(device);
        let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_screen"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(fragment),
                compilation_options,
                targets: &[Some(target.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { label, pipeline, bound: None }
    }

    /// Records the pass over the whole of `output`.
    pub(crate) fn record(
        &mut self,
        device: &wgpu::Device,
        recorder: &mut Recorder<'_>,
        bindings: Vec<Binding>,
        output: &wgpu::TextureView,
    ) {
        if self.bound.as_ref().is_none_or(|(bound, _)| *bound != bindings) {
            let group = self.bind(device, &bindings);
            self.bound = Some((bindings, group));
        }
        let group = self.bound.as_ref().map(|(_, group)| group);
        let attachment = wgpu::RenderPassColorAttachment {
            view: output,
            depth_slice: None,
            resolve_target: None,
            // Every pixel is written: clearing is the cheapest way to say that nothing is kept.
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        };
        let descriptor =
            wgpu::RenderPassDescriptor { label: Some(self.label), color_attachments: &[Some(attachment)], ..Default::default() };
        recorder.render(&descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..3, 0..1);
        });
    }

    fn bind(&self, device: &wgpu::Device, bindings: &[Binding]) -> wgpu::BindGroup {
        let entries: Vec<_> =
            bindings.iter().zip(0..).map(|(b, binding)| wgpu::BindGroupEntry { binding, resource: b.resource() }).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        })
    }
}
