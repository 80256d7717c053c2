//! Edges and weights as pictures to look at; nothing of it exists until it is asked for.

use super::Weights;
use crate::pass::{Binding, Context, Recorder, ScreenPass};
use crate::shader::{Source, part};

/// Both views' module.
pub(crate) const SHOW: Source = Source {
    name: "show",
    parts: &[
        part!("common/screen.wgsl"),
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/show.wgsl"),
    ],
};

/// Draws intermediates into textures of its own.
#[derive(Debug)]
pub(crate) struct Viewer {
    device: wgpu::Device,
    size: [u32; 2],
}

impl Viewer {
    pub(crate) const EDGES: &str = "edges";
    pub(crate) const WEIGHTS: &str = "weights";

    pub(crate) fn new(context: &Context<'_>) -> Self {
        Self { device: context.device.clone(), size: context.size }
    }

    /// One of the two views; none for another name, or for weights where there are none. With them, the bits of each.
    pub(crate) fn show(
        &self,
        recorder: &mut Recorder<'_>,
        name: &str,
        masks: &Binding,
        weights: Option<(&Weights, u32)>,
    ) -> Option<wgpu::TextureView> {
        match (name, weights) {
            (Self::EDGES, _) => Some(self.draw(recorder, ("fs_edges", 16), &[masks], wgpu::TextureFormat::Rgba8Unorm)),
            (Self::WEIGHTS, Some((weights, bits))) => {
                let bindings = [masks, &weights.rows, &weights.columns];
                Some(self.draw(recorder, ("fs_weights", bits), &bindings, wgpu::TextureFormat::Rgba16Float))
            }
            _ => None,
        }
    }

    fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        (fragment, weight_bits): (&str, u32),
        bindings: &[&Binding],
        format: wgpu::TextureFormat,
    ) -> wgpu::TextureView {
        let [width, height] = self.size;
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("view"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let constants =
            [("WIDTH", width), ("HEIGHT", height), ("WEIGHT_BITS", weight_bits)].map(|(name, v)| (name, f64::from(v)));
        ScreenPass::new(&self.device, "view", &SHOW, fragment, &constants, &[format]).record(recorder, bindings, &[&view]);
        view
    }
}
