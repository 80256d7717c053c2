//! Pipelines by kind of surface and kind of draw, made when first drawn with.

use std::collections::HashMap;

use super::SHADER;
use super::uniforms::pattern_number;
use crate::scene::{AlphaMode, Material};

/// In the stencil where a mask forbids drawing. Everything that draws passes where its reference is greater than what is stored,
/// so nothing passes here.
pub(super) const STENCIL_FORBIDDEN: u32 = 0xff;

/// Most jitters of one render pass: the stencil counts them, below [`STENCIL_FORBIDDEN`], and each takes a power of two of depth.
pub(super) const MOST_JITTERS: usize = 100;

/// What a surface's shader is compiled for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Kind {
    pub(super) pattern: u8,
    pub(super) unlit: bool,
    pub(super) textured: bool,
    pub(super) normal_mapped: bool,
    pub(super) masked: bool,
    pub(super) double_sided: bool,
    /// Whether the transform mirrors, which turns front faces clockwise.
    pub(super) mirrored: bool,
}

impl Kind {
    pub(super) fn of(material: &Material, mirrored: bool) -> Self {
        let textures = [material.base_color_texture, material.metallic_roughness_texture, material.emissive_texture];
        Self {
            pattern: pattern_number(&material.pattern),
            unlit: material.unlit,
            textured: textures.iter().any(Option::is_some),
            normal_mapped: material.normal_texture.is_some() || matches!(material.pattern, crate::scene::Pattern::Bumps { .. }),
            masked: matches!(material.alpha, AlphaMode::Mask { .. }),
            double_sided: material.double_sided,
            mirrored,
        }
    }
}

/// What a pass beside the colour writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub(super) struct ExtraTargets {
    pub(super) motion: bool,
    pub(super) ids: bool,
    pub(super) signature: bool,
}

/// What a draw does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Step {
    /// Colour with depth test and write.
    Color { format: wgpu::TextureFormat, alpha_to_coverage: bool },
    /// Depth alone, before a sum.
    Depth,
    /// Adds where the depth is equal and nothing was added yet.
    Sum,
    /// Motion vectors and ids where the depth is equal.
    Extras(ExtraTargets),
}

/// Full-screen steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Fill {
    /// The background, weighted by the sum of all weights.
    Background,
    /// Forbids drawing where the mask has none of the draw's bits.
    Stencil { color: Option<wgpu::TextureFormat> },
    /// Motion of what lies at infinity, and id 0.
    Extras { extras: ExtraTargets, depth: wgpu::TextureFormat },
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Key {
    Surface { kind: Kind, step: Step, samples: u32, depth: wgpu::TextureFormat, masked_draw: bool },
    Fill { fill: Fill, samples: u32, masked_draw: bool },
}

/// Layouts, the module, and every pipeline made so far.
#[derive(Debug)]
pub(super) struct Pipelines {
    device: wgpu::Device,
    module: wgpu::ShaderModule,
    pub(super) frame_layout: wgpu::BindGroupLayout,
    pub(super) material_layout: wgpu::BindGroupLayout,
    pub(super) mask_layout: wgpu::BindGroupLayout,
    surface_layout: wgpu::PipelineLayout,
    fill_layout: wgpu::PipelineLayout,
    stencil_layout: wgpu::PipelineLayout,
    made: HashMap<Key, wgpu::RenderPipeline>,
}

fn entry(binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

fn buffer(ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

fn texture(sample_type: wgpu::TextureSampleType) -> wgpu::BindingType {
    wgpu::BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2, multisampled: false }
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let storage = buffer(wgpu::BufferBindingType::Storage { read_only: true });
        let layout = |label, entries: &[_]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let frame_layout = layout(
            "frame",
            &[entry(0, both, buffer(wgpu::BufferBindingType::Uniform)), entry(1, both, storage), entry(2, both, storage)],
        );
        let mut material = vec![entry(0, fragment, buffer(wgpu::BufferBindingType::Uniform))];
        for slot in 0..4 {
            material.push(entry(1 + 2 * slot, fragment, texture(wgpu::TextureSampleType::Float { filterable: true })));
            material.push(entry(2 + 2 * slot, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)));
        }
        let material_layout = layout("material", &material);
        let mask_layout = layout("mask", &[entry(9, fragment, texture(wgpu::TextureSampleType::Uint))]);
        let pipeline_layout = |label, groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(label),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        Self {
            module: SHADER.module(device),
            surface_layout: pipeline_layout("surface", &[Some(&frame_layout), Some(&material_layout)]),
            fill_layout: pipeline_layout("fill", &[Some(&frame_layout)]),
            stencil_layout: pipeline_layout("stencil", &[Some(&frame_layout), Some(&mask_layout)]),
            device: device.clone(),
            frame_layout,
            material_layout,
            mask_layout,
            made: HashMap::new(),
        }
    }

    pub(super) fn surface(
        &mut self,
        kind: Kind,
        step: Step,
        samples: u32,
        depth: wgpu::TextureFormat,
        masked_draw: bool,
    ) -> &wgpu::RenderPipeline {
        let key = Key::Surface { kind, step, samples, depth, masked_draw };
        if !self.made.contains_key(&key) {
            let pipeline = self.make_surface(kind, step, samples, depth, masked_draw);
            self.made.insert(key, pipeline);
        }
        &self.made[&key]
    }

    pub(super) fn fill(&mut self, fill: Fill, samples: u32, masked_draw: bool) -> &wgpu::RenderPipeline {
        let key = Key::Fill { fill, samples, masked_draw };
        if !self.made.contains_key(&key) {
            let pipeline = self.make_fill(fill, samples, masked_draw);
            self.made.insert(key, pipeline);
        }
        &self.made[&key]
    }

    fn make_surface(
        &self,
        kind: Kind,
        step: Step,
        samples: u32,
        depth: wgpu::TextureFormat,
        masked_draw: bool,
    ) -> wgpu::RenderPipeline {
        let a2c = matches!(step, Step::Color { alpha_to_coverage: true, .. });
        let on = |b: bool| f64::from(u8::from(b));
        let constants = [
            ("PATTERN", f64::from(kind.pattern)),
            ("UNLIT", on(kind.unlit)),
            ("TEXTURED", on(kind.textured)),
            ("NORMAL_MAPPED", on(kind.normal_mapped)),
            ("MASKED", on(kind.masked)),
            ("ALPHA_TO_COVERAGE", on(a2c)),
        ];
        let (vertex, fragment, targets) = match step {
            Step::Color { format, .. } => ("vs_surface", Some("fs_color"), vec![Some(format.into())]),
            Step::Sum => ("vs_surface", Some("fs_sum"), vec![Some(additive(wgpu::BlendFactor::Constant))]),
            Step::Depth if kind.masked => ("vs_mask", Some("fs_mask"), vec![]),
            Step::Depth => ("vs_depth", None, vec![]),
            Step::Extras(extras) => ("vs_extras", Some("fs_extras"), extras_targets(extras)),
        };
        let targets = if step == Step::Depth { vec![Some(no_color())] } else { targets };
        let has_fragment = fragment.is_some();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(vertex),
            layout: Some(&self.surface_layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &vertex_buffers(vertex != "vs_depth"),
            },
            primitive: wgpu::PrimitiveState {
                front_face: if kind.mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
                cull_mode: (!kind.double_sided).then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(surface_depth_stencil(step, depth, masked_draw)),
            multisample: wgpu::MultisampleState {
                count: samples,
                alpha_to_coverage_enabled: a2c && kind.masked,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                // A depth-only draw of an opaque surface still names an empty shader: the pass has a colour target to agree with.
                entry_point: Some(fragment.unwrap_or("fs_nothing")),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: if has_fragment { &constants } else { &[] },
                    ..Default::default()
                },
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn make_fill(&self, fill: Fill, samples: u32, masked_draw: bool) -> wgpu::RenderPipeline {
        let (layout, fragment, targets) = match fill {
            Fill::Background => (&self.fill_layout, "fs_background", vec![Some(additive(wgpu::BlendFactor::One))]),
            Fill::Stencil { color } => (&self.stencil_layout, "fs_stencil", vec![color.map(no_color_of)]),
            Fill::Extras { extras, .. } => (&self.fill_layout, "fs_background_extras", extras_targets(extras)),
        };
        let format = match fill {
            Fill::Extras { depth, .. } => depth,
            _ => wgpu::TextureFormat::Depth32FloatStencil8,
        };
        let stencil = match fill {
            Fill::Background if masked_draw => stencil(wgpu::CompareFunction::Greater, wgpu::StencilOperation::Keep),
            Fill::Background | Fill::Extras { .. } => wgpu::StencilState::default(),
            Fill::Stencil { .. } => stencil(wgpu::CompareFunction::Always, wgpu::StencilOperation::Replace),
        };
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vs_screen"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil,
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

fn extras_targets(extras: ExtraTargets) -> Vec<Option<wgpu::ColorTargetState>> {
    let number = |wanted: bool| wanted.then(|| wgpu::TextureFormat::R32Uint.into());
    vec![extras.motion.then(|| wgpu::TextureFormat::Rg32Float.into()), number(extras.ids), number(extras.signature)]
}

/// Adds what is drawn times `src_factor`.
fn additive(src_factor: wgpu::BlendFactor) -> wgpu::ColorTargetState {
    let add = wgpu::BlendComponent { src_factor, dst_factor: wgpu::BlendFactor::One, operation: wgpu::BlendOperation::Add };
    wgpu::ColorTargetState {
        format: wgpu::TextureFormat::Rgba32Float,
        blend: Some(wgpu::BlendState { color: add, alpha: add }),
        write_mask: wgpu::ColorWrites::ALL,
    }
}

fn no_color() -> wgpu::ColorTargetState {
    no_color_of(wgpu::TextureFormat::Rgba32Float)
}

fn no_color_of(format: wgpu::TextureFormat) -> wgpu::ColorTargetState {
    wgpu::ColorTargetState { format, blend: None, write_mask: wgpu::ColorWrites::empty() }
}

fn stencil(compare: wgpu::CompareFunction, pass_op: wgpu::StencilOperation) -> wgpu::StencilState {
    let face = wgpu::StencilFaceState { compare, pass_op, ..wgpu::StencilFaceState::IGNORE };
    wgpu::StencilState { front: face, back: face, read_mask: 0xff, write_mask: 0xff }
}

fn surface_depth_stencil(step: Step, format: wgpu::TextureFormat, masked_draw: bool) -> wgpu::DepthStencilState {
    let writes_depth = matches!(step, Step::Color { .. } | Step::Depth);
    let greater = wgpu::CompareFunction::Greater;
    let stencil = match step {
        // The reference is the jitter's number from 1: who passes stores it, so nobody passes here again in this jitter.
        Step::Sum => stencil(greater, wgpu::StencilOperation::Replace),
        Step::Color { .. } | Step::Depth if masked_draw => stencil(greater, wgpu::StencilOperation::Keep),
        _ => wgpu::StencilState::default(),
    };
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(writes_depth),
        // Reversed depth: nearer is greater. Strictly, so that of two surfaces at one depth the first drawn stays.
        depth_compare: Some(if writes_depth { greater } else { wgpu::CompareFunction::Equal }),
        stencil,
        bias: wgpu::DepthBiasState::default(),
    }
}

const POSITION: [wgpu::VertexAttribute; 1] = wgpu::vertex_attr_array![0 => Float32x3];
const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x4, 3 => Float32x2, 4 => Float32x4];

/// Positions lie apart from the rest: a depth-only draw reads nothing else.
fn vertex_buffers(all: bool) -> Vec<Option<wgpu::VertexBufferLayout<'static>>> {
    let layout = |array_stride, attributes| {
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    };
    let mut buffers = vec![layout(12, &POSITION[..])];
    if all {
        buffers.push(layout(52, &ATTRIBUTES[..]));
    }
    buffers
}
