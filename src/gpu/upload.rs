//! Pictures to the GPU.

use super::Gpu;
use crate::picture::LinearPicture;

impl Gpu {
    /// An rgba32float texture that holds the picture.
    #[must_use]
    pub fn upload_linear(&self, picture: &LinearPicture) -> wgpu::Texture {
        let [width, height] = picture.size();
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("uploaded picture"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        self.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(picture.pixels()),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(width * 16), rows_per_image: None },
            size,
        );
        texture
    }
}
