//! A scene's buffers, textures and bind groups on one device.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;
use wgpu::util::DeviceExt as _;

use super::mips::levels;
use super::outline::{Outline, OutlineBuffers};
use super::pipelines::{Kind, Pipelines};
use super::uniforms::{FrameUniforms, JitterData, MaterialUniforms, Object, SceneLight};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::pass::Draw;
use crate::scene::{Frame, Material, Mesh, Scene, Texture, TextureRef, Wrap};

/// Everything that draws read.
#[derive(Debug)]
pub(super) struct Resources {
    light: SceneLight,
    materials: Vec<(Material, wgpu::BindGroup)>,
    /// By the mesh's address; the `Arc` keeps the address taken.
    meshes: HashMap<*const Mesh, MeshBuffers>,
    uniforms: FrameUniforms,
    frame_layout: wgpu::BindGroupLayout,
    uniform_buffer: wgpu::Buffer,
    objects: wgpu::Buffer,
    jitters: wgpu::Buffer,
    pub(super) frame_group: wgpu::BindGroup,
    pub(super) mask_group: Option<(wgpu::TextureView, wgpu::BindGroup)>,
    pub(super) batches: Vec<Batch>,
}

/// A mesh on the GPU.
#[derive(Debug, Clone)]
pub(super) struct MeshBuffers {
    /// Keeps the address, which is its key, from being used again.
    mesh: Arc<Mesh>,
    centre: DVec3,
    pub(super) positions: wgpu::Buffer,
    pub(super) attributes: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) index_count: u32,
    /// Once an outline was asked for.
    pub(super) outline: Option<OutlineBuffers>,
}

/// Consecutive instances of one mesh and one kind of surface: one instanced draw.
#[derive(Debug)]
pub(super) struct Batch {
    pub(super) mesh: *const Mesh,
    pub(super) material: usize,
    pub(super) kind: Kind,
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Resources {
    pub(super) fn new(gpu: &Gpu, scene: &Scene, pipelines: &Pipelines) -> Result<Self> {
        let textures: Vec<wgpu::Texture> = scene.textures.iter().map(|t| upload_texture(gpu, t)).collect::<Result<_>>()?;
        let plain = PlainTextures::new(gpu);
        let bind = |(material, number)| bind_material(gpu, pipelines, (material, number), scene, &textures, &plain);
        let storage = |label, bytes| gpu.device.create_buffer(&descriptor(label, bytes, wgpu::BufferUsages::STORAGE));
        let uniform_buffer =
            gpu.device.create_buffer(&descriptor("frame", size_of::<FrameUniforms>() as u64, wgpu::BufferUsages::UNIFORM));
        let objects = storage("objects", size_of::<Object>() as u64);
        let jitters = storage("jitters", size_of::<JitterData>() as u64);
        let frame_group = bind_frame(&gpu.device, &pipelines.frame_layout, [&uniform_buffer, &objects, &jitters]);
        Ok(Self {
            light: SceneLight::of(scene),
            materials: scene.materials.iter().zip(0..).map(|(m, number)| (m.clone(), bind((m, number)))).collect(),
            meshes: HashMap::new(),
            uniforms: bytemuck::Zeroable::zeroed(),
            frame_layout: pipelines.frame_layout.clone(),
            uniform_buffer,
            objects,
            jitters,
            frame_group,
            mask_group: None,
            batches: Vec::new(),
        })
    }

    pub(super) fn material_group(&self, material: usize) -> &wgpu::BindGroup {
        &self.materials[material].1
    }

    /// What a target is cleared to.
    pub(super) fn background(&self) -> wgpu::Color {
        let [r, g, b, _] = self.uniforms.background.map(f64::from);
        wgpu::Color { r, g, b, a: 1.0 }
    }

    pub(super) fn mesh(&self, mesh: *const Mesh) -> &MeshBuffers {
        &self.meshes[&mesh]
    }

    pub(super) fn set_frame(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, frame: &Frame, size: [u32; 2]) {
        let mut used = HashMap::new();
        for instance in &frame.instances {
            let key = Arc::as_ptr(&instance.mesh);
            used.entry(key).or_insert_with(|| self.meshes.remove(&key).unwrap_or_else(|| upload_mesh(device, &instance.mesh)));
        }
        // Meshes of earlier frames that are gone now (ribbons that follow the camera) are dropped here.
        self.meshes = used;
        self.uniforms = FrameUniforms::of(&self.light, &frame.view, &frame.previous_view, size);
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        let object = |i: &crate::scene::Instance| {
            Object::of(i, self.meshes[&Arc::as_ptr(&i.mesh)].centre, &frame.view, &frame.previous_view, aspect)
        };
        let objects: Vec<Object> = frame.instances.iter().map(object).collect();
        self.batches = self.batch(frame);
        self.fill_storage(device, queue, bytemuck::cast_slice(&objects), |resources| &mut resources.objects);
    }

    fn batch(&self, frame: &Frame) -> Vec<Batch> {
        let mut batches: Vec<Batch> = Vec::new();
        for (instance, index) in frame.instances.iter().zip(0..) {
            if instance.mesh.indices.is_empty() {
                continue;
            }
            let mesh = Arc::as_ptr(&instance.mesh);
            let mirrored = instance.world_from_object.matrix3.determinant() < 0.0;
            let kind = Kind::of(&self.materials[instance.material].0, mirrored);
            match batches.last_mut() {
                Some(last)
                    if last.mesh == mesh
                        && last.material == instance.material
                        && last.kind == kind
                        && last.first + last.count == index =>
                {
                    last.count += 1;
                }
                _ => batches.push(Batch { mesh, material: instance.material, kind, first: index, count: 1 }),
            }
        }
        batches
    }

    /// Jitters, weights and the mask's bits of the draw that follows.
    pub(super) fn set_draw(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, request: &Draw, size: [u32; 2]) {
        let jitters = &request.jitters;
        let data: Vec<JitterData> = jitters.iter().map(|j| JitterData::of(j, size)).collect();
        self.fill_storage(device, queue, bytemuck::cast_slice(&data), |resources| &mut resources.jitters);
        // Summed in f64: the background's share should not drift from the surfaces' over thousands of weights.
        self.uniforms.sum_of_weights = jitters.iter().map(|j| f64::from(j.weight)).sum::<f64>() as f32;
        self.uniforms.mask_bits = request.mask.as_ref().map_or(0, |mask| mask.bits);
        queue.write_buffer(&self.uniform_buffer, 0, bytemuck::bytes_of(&self.uniforms));
    }

    pub(super) fn set_mask(&mut self, device: &wgpu::Device, pipelines: &Pipelines, mask: &wgpu::TextureView) {
        if self.mask_group.as_ref().is_some_and(|(view, _)| view == mask) {
            return;
        }
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("mask"),
            layout: &pipelines.mask_layout,
            entries: &[wgpu::BindGroupEntry { binding: 9, resource: wgpu::BindingResource::TextureView(mask) }],
        });
        self.mask_group = Some((mask.clone(), group));
    }

    /// Uploads the edges of meshes that have none yet.
    pub(super) fn prepare_outline(&mut self, device: &wgpu::Device, outline: &Outline) {
        for mesh in self.batches.iter().map(|batch| batch.mesh) {
            if let Some(buffers) = self.meshes.get_mut(&mesh).filter(|buffers| buffers.outline.is_none()) {
                buffers.outline = Some(outline.upload(device, &buffers.mesh, &buffers.positions));
            }
        }
    }

    /// The frame and the objects, for a pipeline that reads no jitters.
    pub(super) fn bind_outline(&self, device: &wgpu::Device, layout: &wgpu::BindGroupLayout) -> wgpu::BindGroup {
        let entries = [(0, &self.uniform_buffer), (1, &self.objects)]
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() });
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("outline frame"), layout, entries: &entries })
    }

    /// Writes a storage buffer, making it larger (and binding it anew) where it must be.
    fn fill_storage(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        bytes: &[u8],
        buffer: impl Fn(&mut Self) -> &mut wgpu::Buffer,
    ) {
        if bytes.is_empty() {
            return;
        }
        let current = buffer(self);
        if current.size() < bytes.len() as u64 {
            *current = device.create_buffer(&descriptor("scene data", bytes.len() as u64, wgpu::BufferUsages::STORAGE));
            self.frame_group = bind_frame(device, &self.frame_layout, [&self.uniform_buffer, &self.objects, &self.jitters]);
        }
        queue.write_buffer(buffer(self), 0, bytes);
    }
}

fn descriptor(label: &'static str, size: u64, usage: wgpu::BufferUsages) -> wgpu::BufferDescriptor<'static> {
    wgpu::BufferDescriptor { label: Some(label), size, usage: usage | wgpu::BufferUsages::COPY_DST, mapped_at_creation: false }
}

fn bind_frame(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, buffers: [&wgpu::Buffer; 3]) -> wgpu::BindGroup {
    let entries: Vec<_> =
        buffers.iter().zip(0..).map(|(b, binding)| wgpu::BindGroupEntry { binding, resource: b.as_entire_binding() }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("frame"), layout, entries: &entries })
}

fn upload_mesh(device: &wgpu::Device, mesh: &Arc<Mesh>) -> MeshBuffers {
    let centre = mesh.bounds().map_or(DVec3::ZERO, |(low, high)| 0.5 * (low + high));
    let positions: Vec<[f32; 3]> = mesh.vertices.iter().map(|v| (v.position - centre).as_vec3().to_array()).collect();
    let attributes: Vec<f32> = mesh
        .vertices
        .iter()
        .flat_map(|v| [&v.normal.to_array()[..], &v.tangent.to_array(), &v.uv.to_array(), &v.color.to_array()].concat())
        .collect();
    let buffer = |label, contents, usage| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
    };
    MeshBuffers {
        mesh: Arc::clone(mesh),
        centre,
        positions: buffer(
            "positions",
            bytemuck::cast_slice(&positions),
            wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE,
        ),
        attributes: buffer("attributes", bytemuck::cast_slice(&attributes), wgpu::BufferUsages::VERTEX),
        indices: buffer("indices", bytemuck::cast_slice(&mesh.indices), wgpu::BufferUsages::INDEX),
        index_count: mesh.indices.len() as u32,
        outline: None,
    }
}

/// Stand-ins for textures a material does not have.
struct PlainTextures {
    white: wgpu::TextureView,
    sampler: wgpu::Sampler,
}

impl PlainTextures {
    fn new(gpu: &Gpu) -> Self {
        let white = upload_levels(gpu, 1, 1, false, &[vec![255; 4]]);
        Self {
            white: white.create_view(&wgpu::TextureViewDescriptor::default()),
            sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor::default()),
        }
    }
}

fn bind_material(
    gpu: &Gpu,
    pipelines: &Pipelines,
    (material, number): (&Material, u32),
    scene: &Scene,
    textures: &[wgpu::Texture],
    plain: &PlainTextures,
) -> wgpu::BindGroup {
    let uniforms = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("material"),
        contents: bytemuck::bytes_of(&MaterialUniforms::of(material, number)),
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let slots: [Option<TextureRef>; 4] =
        [material.base_color_texture, material.metallic_roughness_texture, material.normal_texture, material.emissive_texture];
    let bound: Vec<(wgpu::TextureView, wgpu::Sampler)> = slots
        .iter()
        .map(|slot| match slot {
            None => (plain.white.clone(), plain.sampler.clone()),
            Some(TextureRef { texture }) => (
                textures[*texture].create_view(&wgpu::TextureViewDescriptor::default()),
                gpu.device.create_sampler(&sampler(&scene.textures[*texture])),
            ),
        })
        .collect();
    let mut entries = vec![wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }];
    for ((view, sampler), slot) in bound.iter().zip(0..) {
        entries.push(wgpu::BindGroupEntry { binding: 1 + 2 * slot, resource: wgpu::BindingResource::TextureView(view) });
        entries.push(wgpu::BindGroupEntry { binding: 2 + 2 * slot, resource: wgpu::BindingResource::Sampler(sampler) });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("material"),
        layout: &pipelines.material_layout,
        entries: &entries,
    })
}

fn sampler(texture: &Texture) -> wgpu::SamplerDescriptor<'static> {
    let address = |wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    // Anisotropy wants linear filters throughout.
    let nearest = texture.nearest && texture.anisotropy <= 1;
    wgpu::SamplerDescriptor {
        label: Some("texture"),
        address_mode_u: address(texture.wrap[0]),
        address_mode_v: address(texture.wrap[1]),
        mag_filter: if nearest { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear },
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        anisotropy_clamp: texture.anisotropy.clamp(1, 16),
        ..Default::default()
    }
}

fn upload_texture(gpu: &Gpu, texture: &Texture) -> Result<wgpu::Texture> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if texture.width.max(texture.height) > limit {
        return Err(Error::Unsupported(format!(
            "a texture of {}x{} is more than this adapter holds ({limit})",
            texture.width, texture.height
        )));
    }
    Ok(upload_levels(gpu, texture.width, texture.height, texture.srgb, &levels(texture)))
}

fn upload_levels(gpu: &Gpu, width: u32, height: u32, srgb: bool, levels: &[Vec<u8>]) -> wgpu::Texture {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("scene texture"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: if srgb { wgpu::TextureFormat::Rgba8UnormSrgb } else { wgpu::TextureFormat::Rgba8Unorm },
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    gpu.device.create_texture_with_data(&gpu.queue, &descriptor, wgpu::util::TextureDataOrder::LayerMajor, &levels.concat())
}
