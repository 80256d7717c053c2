//! The method's private textures.

use crate::pass::Binding;

/// An array of textures, one layer a probe.
#[derive(Debug)]
pub(super) struct Layers {
    pub(super) all: wgpu::TextureView,
    each: Vec<wgpu::TextureView>,
}

impl Layers {
    pub(super) fn new(device: &wgpu::Device, label: &str, size: [u32; 2], count: u32, format: wgpu::TextureFormat) -> Self {
        let texture = texture(device, label, size, count, format);
        let all = wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() };
        let one = |layer| wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        };
        Self { all: texture.create_view(&all), each: (0..count).map(|layer| texture.create_view(&one(layer))).collect() }
    }

    pub(super) fn layer(&self, index: usize) -> &wgpu::TextureView {
        &self.each[index]
    }

    /// Copies a picture of the same size and format into a layer.
    pub(super) fn copy_from(&self, encoder: &mut wgpu::CommandEncoder, picture: &wgpu::Texture, index: usize) {
        let mut layer = self.all.texture().as_image_copy();
        layer.origin.z = index as u32;
        let size = wgpu::Extent3d { depth_or_array_layers: 1, ..self.all.texture().size() };
        encoder.copy_texture_to_texture(picture.as_image_copy(), layer, size);
    }
}

fn texture(
    device: &wgpu::Device,
    label: &str,
    [width, height]: [u32; 2],
    depth_or_array_layers: u32,
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// A view of a texture of its own.
pub(super) fn target(device: &wgpu::Device, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::TextureView {
    texture(device, label, size, 1, format).create_view(&wgpu::TextureViewDescriptor::default())
}

pub(super) fn of(view: &wgpu::TextureView) -> Binding {
    Binding::Texture(view.clone())
}

/// Of the texture behind a view.
pub(super) fn bytes(view: &wgpu::TextureView) -> u64 {
    let size = view.texture().size();
    let texel = view.texture().format().block_copy_size(None).unwrap_or(0);
    u64::from(size.width) * u64::from(size.height) * u64::from(size.depth_or_array_layers) * u64::from(texel)
}
