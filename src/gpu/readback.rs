//! Textures back to the CPU, padded rows and size limits handled once.

use std::sync::mpsc;

use super::texels::memory_for;
use super::{Gpu, decode_texels};
use crate::error::{Error, Result};
use crate::picture::LinearPicture;

/// Bytes read in one go; larger textures come in bands of rows.
const BAND_BYTES: u64 = 64 << 20;

impl Gpu {
    /// All texels of a single-sampled 2D texture, rows tightly packed, top row first.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn read_bytes(&self, texture: &wgpu::Texture, aspect: wgpu::TextureAspect) -> Result<Vec<u8>> {
        let texel = u64::from(texture.format().block_copy_size(Some(aspect)).unwrap_or(4));
        let row = u64::from(texture.width()) * texel;
        let padded_row = row.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
        let band =
            (BAND_BYTES.min(self.device.limits().max_buffer_size) / padded_row).clamp(1, u64::from(texture.height())) as u32;
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: padded_row * u64::from(band),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut bytes = memory_for((row * u64::from(texture.height())) as usize)?;
        for top in (0..texture.height()).step_by(band as usize) {
            let rows = band.min(texture.height() - top);
            self.copy_rows(texture, aspect, top, rows, &buffer, padded_row as u32)?;
            self.map(&buffer)?;
            {
                let view = buffer.get_mapped_range(..).map_err(|e| Error::Gpu { kind: "mapping", message: e.to_string() })?;
                for padded in view.chunks_exact(padded_row as usize).take(rows as usize) {
                    bytes.extend_from_slice(&padded[..row as usize]);
                }
            }
            buffer.unmap();
        }
        Ok(bytes)
    }

    /// All bytes of a buffer that can be copied from.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn read_buffer(&self, source: &wgpu::Buffer) -> Result<Vec<u8>> {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: source.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.encoder();
        encoder.copy_buffer_to_buffer(source, 0, &buffer, 0, source.size());
        self.submit(encoder)?;
        self.map(&buffer)?;
        let view = buffer.get_mapped_range(..).map_err(|e| Error::Gpu { kind: "mapping", message: e.to_string() })?;
        Ok(view.to_vec())
    }

    fn copy_rows(
        &self,
        texture: &wgpu::Texture,
        aspect: wgpu::TextureAspect,
        top: u32,
        rows: u32,
        buffer: &wgpu::Buffer,
        padded_row: u32,
    ) -> Result<()> {
        let mut encoder = self.encoder();
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin: wgpu::Origin3d { x: 0, y: top, z: 0 }, aspect },
            wgpu::TexelCopyBufferInfo {
                buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded_row), rows_per_image: None },
            },
            wgpu::Extent3d { width: texture.width(), height: rows, depth_or_array_layers: 1 },
        );
        self.submit(encoder)
    }

    fn map(&self, buffer: &wgpu::Buffer) -> Result<()> {
        let (sender, receiver) = mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // Nobody listens only if waiting failed, and that error is returned.
            let _ = sender.send(result);
        });
        self.wait()?;
        match receiver.try_recv() {
            Ok(Ok(())) => Ok(()),
            Ok(Err(e)) => Err(Error::Gpu { kind: "mapping", message: e.to_string() }),
            Err(_) => Err(Error::Gpu { kind: "mapping", message: "the driver did not answer".into() }),
        }
    }

    /// The texels as f32 RGBA, as they are stored (see [`decode_texels`]).
    ///
    /// # Errors
    /// [`Error::Gpu`]; [`Error::Unsupported`] for a format that holds no colours.
    pub fn read_linear(&self, texture: &wgpu::Texture) -> Result<LinearPicture> {
        use wgpu::TextureFormat as F;
        let aspect = match texture.format() {
            F::Depth32Float | F::Depth32FloatStencil8 => wgpu::TextureAspect::DepthOnly,
            _ => wgpu::TextureAspect::All,
        };
        let bytes = self.read_bytes(texture, aspect)?;
        let pixels = decode_texels(texture.format(), &bytes)?;
        LinearPicture::new(texture.width(), texture.height(), pixels)
    }
}
