//! Bringing changed pixels into the picture.

use super::edges::RESOLVED;
use super::{Blend, Constants, EdgeFinder, Lists, picture_constants, storage_texture, texture_bytes};
use crate::pass::{Binding, ComputePass, Context, Encoding, Groups, Inputs, Recorder, ScreenPass, Surface};
use crate::shader::{Source, part};

const TOUCH: Source = Source {
    name: "touch",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/enlist.wgsl"),
        part!("morphology/touch.wgsl"),
    ],
};

/// As [`TOUCH`], with a list of the pixels that staircases may go through.
pub(crate) const TOUCH_DIAGONALS: Source = Source {
    name: "touch with diagonals",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/enlist.wgsl"),
        part!("morphology/enlist_second.wgsl"),
        part!("morphology/touch.wgsl"),
        part!("morphology/touch_diagonals.wgsl"),
    ],
};

const APPLY: Source = Source {
    name: "apply",
    parts: &[
        part!("common/screen.wgsl"),
        part!("common/color.wgsl"),
        part!("common/srgb.wgsl"),
        part!("morphology/picture.wgsl"),
        part!("morphology/apply.wgsl"),
    ],
};

/// The modules of every method that patches.
pub(crate) const SHARED_MODULES: [Source; 3] = [RESOLVED, TOUCH, APPLY];

/// `patched!("name", parts...)`: a module that writes patches, for each of [`PATCH_FORMATS`].
macro_rules! patched {
    ($name:literal, $($part:expr),* $(,)?) => {
        [
            $crate::shader::Source { name: $name, parts: &[$($part,)* $crate::shader::part!("morphology/patch_rgba8unorm.wgsl")] },
            $crate::shader::Source { name: $name, parts: &[$($part,)* $crate::shader::part!("morphology/patch_rgba16float.wgsl")] },
            $crate::shader::Source { name: $name, parts: &[$($part,)* $crate::shader::part!("morphology/patch_rgba32float.wgsl")] },
        ]
    };
}
pub(crate) use patched;

/// A module for each of [`PATCH_FORMATS`].
pub(crate) type PatchedModules = [Source; 3];

const PATCH_FORMATS: [wgpu::TextureFormat; 3] =
    [wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureFormat::Rgba16Float, wgpu::TextureFormat::Rgba32Float];

/// Which of [`PATCH_FORMATS`] holds whatever the output can.
fn patch_format(output: Surface) -> usize {
    match (output.format, output.values) {
        (wgpu::TextureFormat::Rgba8Unorm | wgpu::TextureFormat::Bgra8Unorm, Encoding::Display) => 0,
        (wgpu::TextureFormat::Rgba32Float, _) => 2,
        _ => 1,
    }
}

/// Lists the pixels that may change: those with an edge on any side.
#[derive(Debug)]
pub(crate) struct Touch {
    diagonals: bool,
    pass: ComputePass,
    /// A bit for each of them.
    pub(crate) touched: Binding,
    groups: [u32; 2],
    bytes: u64,
}

impl Touch {
    pub(crate) fn new(context: &Context<'_>) -> Self {
        Self::with_pass(context, false, ComputePass::new(context.device, "touch", &TOUCH, "cs_touch", &[]))
    }

    /// Lists the pixels that a staircase may go through as well.
    pub(crate) fn with_diagonals(context: &Context<'_>) -> Self {
        Self::with_pass(context, true, ComputePass::new(context.device, "touch", &TOUCH_DIAGONALS, "cs_touch_diagonals", &[]))
    }

    fn with_pass(context: &Context<'_>, diagonals: bool, pass: ComputePass) -> Self {
        let [width, height] = context.size;
        let words = width.div_ceil(16);
        let touched = storage_texture(context, "touched pixels", [words, height], wgpu::TextureFormat::R32Uint);
        Self {
            diagonals,
            pass,
            groups: [words.div_ceil(64), height],
            bytes: texture_bytes(&touched),
            touched: Binding::Texture(touched),
        }
    }

    pub(crate) fn record(&mut self, recorder: &mut Recorder<'_>, edges: &EdgeFinder, lists: &Lists) {
        let all = [&edges.masks, &self.touched, &lists.tally_binding, &lists.pixels, &lists.second_pixels];
        let bindings = if self.diagonals { &all[..] } else { &all[..4] };
        self.pass.record(recorder, bindings, Groups::Direct(self.groups));
    }

    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// Computes the pixels on a list anew, and writes the picture with them put in.
///
/// Where nothing can be read and written at once, the changed pixels go into a texture of their own, and a pass over the whole
/// picture puts them in. A software adapter, to which such a pass costs as much as all the rest, copies the picture and writes
/// them straight into the copy, if it may: what comes out is the same.
#[derive(Debug)]
pub(crate) struct Patches {
    compute: ComputePass,
    apply: ScreenPass,
    patches: Binding,
    may_copy: bool,
    bytes: u64,
}

impl Patches {
    /// `modules` have the entry point and, at bindings 0 to 3, picture, patches, tally and list.
    pub(crate) fn new(
        context: &Context<'_>,
        blend: Blend,
        (label, modules, entry_point): (&'static str, &PatchedModules, &str),
        constants: &[(&'static str, f64)],
    ) -> Self {
        let kind = patch_format(context.output);
        let patches = storage_texture(context, "patches", context.size, PATCH_FORMATS[kind]);
        let picture = picture_constants(context, blend);
        let computing: Constants = picture.iter().chain(constants).copied().collect();
        let software = context.device.adapter_info().device_type == wgpu::DeviceType::Cpu;
        Self {
            compute: ComputePass::new(context.device, label, &modules[kind], entry_point, &computing),
            apply: ScreenPass::new(context.device, "apply", &APPLY, "fs_apply", &picture, &[context.output.format]),
            may_copy: software && context.input == context.output && context.output.format == PATCH_FORMATS[kind],
            bytes: texture_bytes(&patches),
            patches: Binding::Texture(patches),
        }
    }

    /// `own` is what the module reads from binding 4 on, `touched` holds a bit for each pixel on the list.
    pub(crate) fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        (lists, list): (&Lists, u64),
        (own, touched): (&[&Binding], &Binding),
        inputs: &Inputs<'_>,
        output: &wgpu::TextureView,
    ) {
        let color = Binding::Texture(inputs.color.clone());
        let target = Binding::Texture(output.clone());
        let copies = self.may_copy && can_copy(inputs.color.texture(), output.texture());
        let patches = if copies { &target } else { &self.patches };
        if copies {
            recorder.clocked("copy", |encoder| copy(encoder, inputs.color.texture(), output.texture()));
        }
        let shared = [&color, patches, &lists.tally_binding, &lists.pixels];
        let mut bindings = [&color; 8];
        let count = shared.len() + own.len();
        bindings[..shared.len()].copy_from_slice(&shared);
        bindings[shared.len()..count].copy_from_slice(own);
        self.compute.record(recorder, &bindings[..count], Groups::Indirect(&lists.tally, list));
        if !copies {
            self.apply.record(recorder, &[&color, touched, &self.patches], &[output]);
        }
    }

    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }
}

/// Whether views can only be of the whole textures, and the textures let themselves be copied and written to.
fn can_copy(from: &wgpu::Texture, to: &wgpu::Texture) -> bool {
    let whole = |texture: &wgpu::Texture| texture.mip_level_count() == 1 && texture.depth_or_array_layers() == 1;
    let written = wgpu::TextureUsages::COPY_DST | wgpu::TextureUsages::STORAGE_BINDING;
    whole(from)
        && whole(to)
        && from.format() == to.format()
        && from.usage().contains(wgpu::TextureUsages::COPY_SRC)
        && to.usage().contains(written)
}

fn copy(encoder: &mut wgpu::CommandEncoder, from: &wgpu::Texture, to: &wgpu::Texture) {
    encoder.copy_texture_to_texture(from.as_image_copy(), to.as_image_copy(), to.size());
}
