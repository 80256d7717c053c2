//! Pictures to the GPU.

use super::{Gpu, encode_texels};
use crate::error::{Error, Result};
use crate::picture::{LinearPicture, Pixel};

impl Gpu {
    /// Fills a texture with pixels in reading order, whatever they mean: rounded to what its format holds (see
    /// [`super::encode_texels`]).
    ///
    /// # Errors
    /// [`Error::Unsupported`] for another format, [`Error::Request`] for pixels that do not fill it.
    pub fn upload(&self, texture: &wgpu::Texture, pixels: &[Pixel]) -> Result<()> {
        let (width, height) = (texture.width(), texture.height());
        if pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(Error::Request(format!("{} pixels do not fill a texture of {width}x{height}", pixels.len())));
        }
        let bytes = encode_texels(texture.format(), pixels)?;
        self.queue.write_texture(
            texture.as_image_copy(),
            &bytes,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some((bytes.len() / height as usize) as u32),
                rows_per_image: None,
            },
            texture.size(),
        );
        self.check()
    }

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
