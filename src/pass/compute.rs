//! Compute passes: one pipeline, one bind group, one dispatch.

use super::Recorder;
use super::bindings::{Binding, Bound};
use crate::shader::Source;

/// A compute pipeline, with its bind group kept for as long as it is given the same resources.
#[derive(Debug)]
pub(crate) struct ComputePass {
    device: wgpu::Device,
    label: &'static str,
    pipeline: wgpu::ComputePipeline,
    bound: Bound,
}

/// How many workgroups run.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Groups<'a> {
    /// As many as are named.
    Direct([u32; 2]),
    /// As many as the three words of this buffer say that begin at this byte.
    Indirect(&'a wgpu::Buffer, u64),
}

impl ComputePass {
    pub(crate) fn new(
        device: &wgpu::Device,
        label: &'static str,
        source: &Source,
        entry_point: &str,
        constants: &[(&str, f64)],
    ) -> Self {
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: None,
            module: &source.module(device),
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        Self { device: device.clone(), label, pipeline, bound: Bound::default() }
    }

    /// Records the dispatch.
    pub(crate) fn record(&mut self, recorder: &mut Recorder<'_>, bindings: &[&Binding], groups: Groups<'_>) {
        let pipeline = &self.pipeline;
        let group = self.bound.group(&self.device, self.label, || pipeline.get_bind_group_layout(0), bindings);
        recorder.compute(self.label, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            match groups {
                Groups::Direct([x, y]) => pass.dispatch_workgroups(x, y, 1),
                Groups::Indirect(buffer, offset) => pass.dispatch_workgroups_indirect(buffer, offset),
            }
        });
    }
}
