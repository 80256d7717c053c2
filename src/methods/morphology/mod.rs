//! What the morphological methods share: edges as bits, lists of pixels, areas, and how changed pixels come into the picture.
//!
//! Most pixels of a picture have no edge. So only one pass looks at all of them for edges (`detect`), four pixels a thread, and one
//! more writes the output (`apply`): what lies between is dispatched for the pixels on a list alone. Nothing depends on the
//! lists' order, and a list has room for every pixel, so it cannot overflow.

mod areas;
mod edges;
mod line_filter;
mod patch;
mod show;
#[cfg(all(test, feature = "workbench"))]
pub(super) mod tests;

use areas::AreaTable;
pub(super) use edges::{EdgeFinder, EdgeRule, Geometry, Predication, check_size, detect};
#[cfg(all(test, feature = "workbench"))]
pub(super) use line_filter::Areas;
pub(super) use line_filter::{BlendSides, LineRules};
pub(super) use patch::{PatchedModules, Patches, SHARED_MODULES, Touch, patched};
pub(super) use show::{SHOW, Viewer};

use crate::error::{Error, Result};
use crate::pass::{Binding, Context, Encoding, Kind, OptionSpec, Surface};
use crate::shader::Source;

/// Every module that [`LineRules`] may compile.
pub(super) const LINE_MODULES: [Source; 15] = {
    let ([a, b, c, d, e], [f, g, h], [i, j, k]) = (edges::MODULES, SHARED_MODULES, line_filter::BLEND_MODULES);
    [line_filter::WEIGHTS, line_filter::DIAGONALS, patch::TOUCH_DIAGONALS, SHOW, a, b, c, d, e, f, g, h, i, j, k]
};

/// `(name, value)` of a shader's `override`s.
pub(super) type Constants = Vec<(&'static str, f64)>;

/// Whether colours are mixed in linear light or as display values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Blend {
    Linear,
    Coded,
}

impl Blend {
    pub(super) const OPTION: OptionSpec = OptionSpec {
        name: "blend",
        help: "mix colours in linear light, or as the display values they are coded in",
        kind: Kind::Choice(|| vec!["linear", "coded"]),
        default: "linear",
    };

    pub(super) fn named(name: &str) -> Self {
        if name == "coded" { Self::Coded } else { Self::Linear }
    }
}

/// What `morphology/picture.wgsl` wants to know.
pub(super) fn picture_constants(context: &Context<'_>, blend: Blend) -> Constants {
    let is_linear = |surface: Surface| f64::from(u8::from(surface.values == Encoding::Linear));
    let is_float = context.input.format.sample_type(None, None) == Some(wgpu::TextureSampleType::Float { filterable: false })
        || matches!(context.input.format, wgpu::TextureFormat::Rgba16Float | wgpu::TextureFormat::Rg11b10Ufloat);
    vec![
        ("INPUT_IS_LINEAR", is_linear(context.input)),
        ("OUTPUT_IS_LINEAR", is_linear(context.output)),
        ("INPUT_IS_FLOAT", f64::from(u8::from(is_float))),
        ("BLEND_IN_LINEAR", f64::from(u8::from(blend == Blend::Linear))),
    ]
}

/// A private texture of a pass, one texel for each of `size`.
pub(super) fn storage_texture(
    context: &Context<'_>,
    label: &str,
    [width, height]: [u32; 2],
    format: wgpu::TextureFormat,
) -> wgpu::TextureView {
    let texture = context.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Bytes of a private texture.
pub(super) fn texture_bytes(view: &wgpu::TextureView) -> u64 {
    let texture = view.texture();
    u64::from(texture.width()) * u64::from(texture.height()) * u64::from(texture.format().block_copy_size(None).unwrap_or(4))
}

/// Lists of pixels, and how many groups it takes to go through each (see `morphology/list.wgsl`).
#[derive(Debug)]
pub(super) struct Lists {
    pub(super) tally: wgpu::Buffer,
    pub(super) tally_binding: Binding,
    pub(super) pixels: Binding,
    empty: wgpu::Buffer,
    bytes: u64,
}

impl Lists {
    const WORDS: u64 = 12;
    /// Where the dispatch over pixels with edges begins in `tally`, in bytes.
    pub(super) const CANDIDATES: u64 = 0;
    /// And the one over pixels that may change.
    pub(super) const TOUCHED: u64 = 16;
    /// And the one over pixels that a staircase may go through.
    pub(super) const DIAGONALS: u64 = 32;

    /// With room for every pixel.
    pub(super) fn new(context: &Context<'_>) -> Result<Self> {
        use wgpu::util::DeviceExt as _;
        let [width, height] = context.size;
        let bytes = 4 * u64::from(width) * u64::from(height);
        let limits = context.device.limits();
        if bytes > limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) || width.max(height) > 1 << 16 {
            return Err(Error::Unsupported(format!(
                "a list of {width}x{height} pixels takes {bytes} bytes, more than this device binds; choose a smaller size"
            )));
        }
        let tally = context.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("tally"),
            size: 4 * Self::WORDS,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let empty = context.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("empty tally"),
            contents: bytemuck::cast_slice(&[0_u32, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0]),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        let pixels = Self::room(context);
        Ok(Self { tally_binding: Binding::Buffer(tally.clone()), tally, pixels, empty, bytes })
    }

    /// A list's own buffer, with room for every pixel.
    pub(super) fn room(context: &Context<'_>) -> Binding {
        let [width, height] = context.size;
        Binding::Buffer(context.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pixel list"),
            size: 4 * u64::from(width) * u64::from(height),
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        }))
    }

    /// Records that all lists are empty.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.empty, 0, &self.tally, 0, 4 * Self::WORDS);
    }

    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }
}
