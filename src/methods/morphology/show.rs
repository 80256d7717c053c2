//! Edges and weights as pictures to look at; nothing of it exists until it is asked for.

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

    /// One of the two views; none for another name, or for weights where there are none.
    pub(crate) fn show(
        &self,
        recorder: &mut Recorder<'_>,
        name: &str,
        masks: &Binding,
        weights: Option<&Binding>,
    ) -> Option<wgpu::TextureView> {
        match (name, weights) {
            (Self::EDGES, _) => Some(self.draw(recorder, "fs_edges", &[masks], wgpu::TextureFormat::Rgba8Unorm)),
            (Self::WEIGHTS, Some(weights)) => {
                Some(self.draw(recorder, "fs_weights", &[masks, weights], wgpu::TextureFormat::Rgba16Float))
            }
            _ => None,
        }
    }

    fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        fragment: &str,
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
        let constants = [("WIDTH", f64::from(width)), ("HEIGHT", f64::from(height))];
        ScreenPass::new(&self.device, "view", &SHOW, fragment, &constants, format).record(recorder, bindings, &view);
        view
    }
}
