//! The targets of a draw.

use crate::error::{Error, Result};
use crate::gpu::{Gpu, TextureSpec, bytes_of};
use crate::pass::{Draw, Extras, Target};

/// Linear HDR colour. rgba16float: every adapter renders, blends and multisamples it; 11 bits are finer than any 8-bit display.
const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// What a draw renders into, beside a pass's own sum or output.
#[derive(Debug)]
pub struct Targets {
    pub(super) size: [u32; 2],
    pub(super) samples: u32,
    depth_is_wanted: bool,
    /// None if the colour goes elsewhere.
    pub color: Option<wgpu::Texture>,
    /// Reversed depth; with a stencil where masks or sums need one.
    pub depth: wgpu::Texture,
    /// rg32float, pixels.
    pub motion: Option<wgpu::Texture>,
    /// r32uint.
    pub ids: Option<wgpu::Texture>,
    /// r32uint.
    pub signature: Option<wgpu::Texture>,
}

impl Targets {
    pub(super) fn new(gpu: &Gpu, size: [u32; 2], draw: &Draw, extras: Extras) -> Result<Self> {
        let samples = draw.samples;
        if samples > 1 && (extras != Extras::default() || matches!(draw.target, Target::Sum(_))) {
            return Err(Error::Unsupported(
                "depth to read, motion vectors, ids and sums are drawn with one sample a pixel; put what reads them after `none`"
                    .into(),
            ));
        }
        let stencil = draw.mask.is_some() || matches!(draw.target, Target::Sum(_));
        if stencil && !gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
            return Err(Error::Unsupported("sums and masks need DEPTH32FLOAT_STENCIL8, which this adapter lacks".into()));
        }
        let depth_format = if stencil { wgpu::TextureFormat::Depth32FloatStencil8 } else { wgpu::TextureFormat::Depth32Float };
        let target = |label, format| gpu.target(TextureSpec { label, size, format, samples });
        Ok(Self {
            size,
            samples,
            depth_is_wanted: extras.depth,
            color: matches!(draw.target, Target::Input).then(|| target("scene color", COLOR)),
            depth: target("scene depth", depth_format),
            motion: extras.motion.then(|| target("scene motion", wgpu::TextureFormat::Rg32Float)),
            ids: extras.ids.then(|| target("scene ids", wgpu::TextureFormat::R32Uint)),
            signature: extras.signature.then(|| target("scene signature", wgpu::TextureFormat::R32Uint)),
        })
    }

    /// The depth for a shader to read, if it was asked for.
    #[must_use]
    pub fn readable_depth(&self) -> Option<wgpu::TextureView> {
        let aspect = wgpu::TextureAspect::DepthOnly;
        self.depth_is_wanted.then(|| self.depth.create_view(&wgpu::TextureViewDescriptor { aspect, ..Default::default() }))
    }

    /// The colour's unresolved samples, if there are several.
    #[must_use]
    pub fn samples(&self) -> Option<&wgpu::Texture> {
        self.color.as_ref().filter(|_| self.samples > 1)
    }

    /// Bytes of all of them.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        [self.color.as_ref(), Some(&self.depth), self.motion.as_ref(), self.ids.as_ref(), self.signature.as_ref()]
            .into_iter()
            .flatten()
            .map(bytes_of)
            .sum()
    }

    /// Format of the colour that a pass gets as input.
    #[must_use]
    pub const fn color_format() -> wgpu::TextureFormat {
        COLOR
    }
}
