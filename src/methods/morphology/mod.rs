//! What the morphological methods share: edges as bits, lists of pixels, areas, and how changed pixels come into the picture.
//!
//! Most pixels of a picture have no edge. So only one pass looks at all of them for edges (`detect`), sixteen pixels a thread, and
//! one more writes the output (`apply`): what lies between is dispatched for the pixels on a list alone. Nothing depends on the
//! lists' order, and a list has room for every pixel, so it cannot overflow.

mod area_set;
mod areas;
mod edges;
mod line_filter;
mod patch;
mod show;
#[cfg(all(test, feature = "workbench"))]
pub(super) mod tests;

pub(super) use area_set::AreaSet;
pub(super) use edges::{EdgeFinder, EdgeRule, Geometry, Predication, check_size, detect};
pub(super) use line_filter::{BlendSides, LineFilter, LineRules};
pub(super) use patch::{PatchedModules, Patches, SHARED_MODULES, Touch, patched};
pub(super) use show::{SHOW, Viewer};

use crate::error::{Error, Result};
use crate::pass::{Binding, ComputePass, Context, Encoding, Groups, Kind, OptionSpec, Recorder, Surface};
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
    /// Of pixels with an edge above; after them, of all that may change.
    pub(super) pixels: Binding,
    /// Of pixels with an edge to their left; after them, of those that a staircase may go through.
    pub(super) second_pixels: Binding,
    empty: wgpu::Buffer,
    bytes: u64,
}

impl Lists {
    const WORDS: u64 = 16;
    /// Where the dispatches over the lists begin in `tally`, in bytes.
    pub(super) const ROWS: u64 = 0;
    pub(super) const COLUMNS: u64 = 16;
    pub(super) const TOUCHED: u64 = 32;
    pub(super) const DIAGONALS: u64 = 48;

    /// With room for every pixel.
    pub(super) fn new(context: &Context<'_>) -> Result<Self> {
        let [width, height] = context.size;
        Self::with_second(context, 4 * u64::from(width) * u64::from(height))
    }

    /// For a method whose second list stays empty.
    pub(super) fn single(context: &Context<'_>) -> Result<Self> {
        Self::with_second(context, 4)
    }

    fn with_second(context: &Context<'_>, second_bytes: u64) -> Result<Self> {
        use wgpu::util::DeviceExt as _;
        let [width, height] = context.size;
        let bytes = 4 * u64::from(width) * u64::from(height);
        let limits = context.device.limits();
        if bytes > limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) || width.max(height) > 1 << 16 {
            return Err(Error::Unsupported(format!(
                "a list of {width}x{height} pixels takes {bytes} bytes, more than this device binds; choose a smaller size"
            )));
        }
        let buffer = |label, size, usage| {
            context.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        let tally = buffer("tally", 4 * Self::WORDS, storage | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_DST);
        let empty = context.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("empty tally"),
            contents: bytemuck::cast_slice(&[[0_u32, 1, 1, 0]; 4]),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        Ok(Self {
            tally_binding: Binding::Buffer(tally.clone()),
            tally,
            pixels: Binding::Buffer(buffer("pixel list", bytes, storage)),
            second_pixels: Binding::Buffer(buffer("second pixel list", second_bytes, storage)),
            empty,
            bytes: bytes + second_bytes,
        })
    }

    /// Records that all lists are empty.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.empty, 0, &self.tally, 0, 4 * Self::WORDS);
    }

    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// Weights of every pixel's edges, those along rows and those along columns, and what computes them.
#[derive(Debug)]
pub(super) struct Weights {
    by_row: ComputePass,
    by_column: ComputePass,
    pub(super) rows: Binding,
    pub(super) columns: Binding,
    bytes: u64,
}

impl Weights {
    /// The module has the entry points `cs_rows` and `cs_columns`, and its last binding is what it writes.
    pub(super) fn new(context: &Context<'_>, module: &Source, constants: &[(&str, f64)]) -> Self {
        let texture = |label| storage_texture(context, label, context.size, wgpu::TextureFormat::R32Uint);
        let pass = |label, entry_point| ComputePass::new(context.device, label, module, entry_point, constants);
        let (rows, columns) = (texture("row weights"), texture("column weights"));
        Self {
            by_row: pass("row weights", "cs_rows"),
            by_column: pass("column weights", "cs_columns"),
            bytes: texture_bytes(&rows) + texture_bytes(&columns),
            rows: Binding::Texture(rows),
            columns: Binding::Texture(columns),
        }
    }

    /// `areas`, those of rows and those of columns, stand between masks and lists, if the module reads any.
    pub(super) fn record(&mut self, recorder: &mut Recorder<'_>, masks: &Binding, areas: Option<[&Binding; 2]>, lists: &Lists) {
        let halves = [
            (&mut self.by_row, &lists.pixels, &self.rows, Lists::ROWS),
            (&mut self.by_column, &lists.second_pixels, &self.columns, Lists::COLUMNS),
        ];
        for (axis, (pass, pixels, weights, list)) in halves.into_iter().enumerate() {
            let groups = Groups::Indirect(&lists.tally, list);
            match areas.map(|areas| areas[axis]) {
                Some(areas) => pass.record(recorder, &[masks, areas, &lists.tally_binding, pixels, weights], groups),
                None => pass.record(recorder, &[masks, &lists.tally_binding, pixels, weights], groups),
            }
        }
    }

    pub(super) fn bytes(&self) -> u64 {
        self.bytes
    }
}
