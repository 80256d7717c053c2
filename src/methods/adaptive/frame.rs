//! What both schemes are told of a frame, and how they show how many samples its pixels took.

use super::targets::{of, target};
use crate::pass::{Recorder, ScreenPass};
use crate::shader::{Source, layout::gpu_struct, part};

pub(super) const SHOW: Source =
    Source { name: "adaptive show", parts: &[part!("common/screen.wgsl"), part!("adaptive/show.wgsl")] };

gpu_struct! {
    /// What a frame brings beside its pictures.
    struct AdaptiveFrame {
        /// Factor on linear colour before the tone map.
        exposure: f32,
    }
}

impl AdaptiveFrame {
    pub(super) fn buffer(device: &wgpu::Device) -> wgpu::Buffer {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("adaptive frame"),
            size: size_of::<Self>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }
}

/// The alpha of `counts` as grey: black one sample, white `most`, a step each time they double.
pub(super) fn show_counts(
    device: &wgpu::Device,
    recorder: &mut Recorder<'_>,
    counts: &wgpu::TextureView,
    most: u32,
) -> wgpu::TextureView {
    let size = counts.texture().size();
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let picture = target(device, "adaptive refine", [size.width, size.height], format);
    let most = [("MOST", f64::from(most))];
    ScreenPass::new(device, "adaptive refine", &SHOW, "fs_refine", &most, &[format]).record(
        recorder,
        &[&of(counts)],
        &[&picture],
    );
    picture
}
