//! Render targets: made in one line, counted in bytes.

use super::Gpu;

/// A render target that can also be read by shaders and copied out.
#[derive(Debug, Clone, Copy)]
pub struct TextureSpec {
    /// Named in errors.
    pub label: &'static str,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Format.
    pub format: wgpu::TextureFormat,
    /// Samples a pixel.
    pub samples: u32,
}

impl Gpu {
    /// Makes a render target.
    #[must_use]
    pub fn target(&self, spec: TextureSpec) -> wgpu::Texture {
        let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        if spec.samples == 1 {
            usage |= wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::COPY_DST;
        }
        // Filters on a software adapter write straight into their output.
        let storable = [wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureFormat::Rgba16Float, wgpu::TextureFormat::Rgba32Float];
        if spec.samples == 1 && storable.contains(&spec.format) {
            usage |= wgpu::TextureUsages::STORAGE_BINDING;
        }
        let [width, height] = spec.size;
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(spec.label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: spec.samples,
            dimension: wgpu::TextureDimension::D2,
            format: spec.format,
            usage,
            view_formats: &[],
        })
    }
}

/// Bytes that a texture holds, all samples and mips, as its format says; alignment is the driver's.
#[must_use]
pub fn bytes_of(texture: &wgpu::Texture) -> u64 {
    let texel = match texture.format() {
        // The stencil's byte is padded to four.
        wgpu::TextureFormat::Depth32FloatStencil8 => 8,
        format => u64::from(format.block_copy_size(None).unwrap_or(4)),
    };
    let mips = (0..texture.mip_level_count())
        .map(|mip| u64::from((texture.width() >> mip).max(1)) * u64::from((texture.height() >> mip).max(1)));
    mips.sum::<u64>() * texel * u64::from(texture.sample_count()) * u64::from(texture.depth_or_array_layers())
}
