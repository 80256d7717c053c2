//! Full-screen passes: one triangle, one bind group, one target or several.

use super::Recorder;
use super::bindings::{Binding, Bound};
use crate::shader::Source;

/// A pipeline that fills a target, with its bind group kept for as long as it is given the same resources.
#[derive(Debug)]
pub(crate) struct ScreenPass {
    device: wgpu::Device,
    label: &'static str,
    pipeline: wgpu::RenderPipeline,
    bound: Bound,
}

impl ScreenPass {
    /// `source` must have the entry points `vs_screen` (see `common/screen.wgsl`) and `fragment`.
    pub(crate) fn new(
        device: &wgpu::Device,
        label: &'static str,
        source: &Source,
        fragment: &str,
        constants: &[(&str, f64)],
        targets: &[wgpu::TextureFormat],
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
                targets: &targets.iter().map(|format| Some((*format).into())).collect::<Vec<_>>(),
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { device: device.clone(), label, pipeline, bound: Bound::default() }
    }

    /// Records the pass over the whole of its targets.
    pub(crate) fn record(&mut self, recorder: &mut Recorder<'_>, bindings: &[&Binding], targets: &[&wgpu::TextureView]) {
        let pipeline = &self.pipeline;
        let group = self.bound.group(&self.device, self.label, || pipeline.get_bind_group_layout(0), bindings);
        let attachments: Vec<_> = targets.iter().map(|view| Some(attachment(view))).collect();
        let descriptor =
            wgpu::RenderPassDescriptor { label: Some(self.label), color_attachments: &attachments, ..Default::default() };
        recorder.render(&descriptor, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}

fn attachment(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        // Every pixel is written: clearing is the cheapest way to say that nothing is kept.
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
    }
}
