//! Where edges of the geometry pass: silhouettes, borders, creases, each widened to half a pixel's diagonal.
//!
//! Every pixel that such an edge touches is marked, however thin the geometry that it bounds; edges behind what a draw saw around
//! the pixel are left out. After Sander, Hoppe, Snyder and Gortler 2001, Discontinuity Edge Overdraw, which smooths those edges by
//! drawing them again as lines; here they only say where samples are worth taking.
//!
//! Cost: each edge is a quad, six vertices of four positions; two to three times the vertices of a draw.

use std::collections::HashMap;

use glam::Vec3;
use wgpu::util::DeviceExt as _;

use super::resources::Resources;
use crate::pass::Recorder;
use crate::scene::{Mesh, Vertex};
use crate::shader::{Source, part};

/// Its module.
pub const SHADER: Source =
    Source { name: "forward outline", parts: &[part!("forward/scene.wgsl"), part!("forward/outline.wgsl")] };

/// Stands for the fourth corner where an edge is drawn from wherever it is seen.
const ALWAYS: u32 = u32::MAX;

/// Two faces are one flat face where the cosine between them is more.
const FLAT_COSINE: f32 = 1.0 - 1e-6;

const VERTICES_AN_EDGE: u32 = 6;

/// An edge of a mesh: its ends, and the third corners of the faces on either side; [`ALWAYS`] where it has one face, or where the
/// faces differ in more than direction. The faces are (0, 1, 2) and (1, 0, 3).
type Edge = [u32; 4];

/// The edges that may be seen as such. Vertices at the same place count as one; edges inside flat faces are left out.
fn edges(mesh: &Mesh) -> Vec<Edge> {
    let welded = weld(mesh);
    let mut found: Vec<Edge> = Vec::new();
    let mut open: HashMap<[u32; 2], usize> = HashMap::new();
    for triangle in mesh.indices.chunks_exact(3) {
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|i| triangle[(k + i) % 3]);
            let [from, to] = [a, b].map(|v| welded[v as usize]);
            if from == to {
                continue;
            }
            match open.remove(&[to, from]) {
                Some(first) => found[first][3] = if is_hard(mesh, found[first], [a, b]) { ALWAYS } else { c },
                None => {
                    open.insert([from, to], found.len());
                    found.push([a, b, c, ALWAYS]);
                }
            }
        }
    }
    found.retain(|edge| edge[3] == ALWAYS || !is_flat(mesh, *edge));
    found
}

/// The first vertex at each vertex's place.
fn weld(mesh: &Mesh) -> Vec<u32> {
    let mut first: HashMap<[u64; 3], u32> = HashMap::new();
    let place = |v: &Vertex| v.position.to_array().map(|x| (x + 0.0).to_bits());
    mesh.vertices.iter().zip(0..).map(|(v, index)| *first.entry(place(v)).or_insert(index)).collect()
}

/// Whether what is drawn breaks off at an edge whose second face has these vertices at its ends.
fn is_hard(mesh: &Mesh, edge: Edge, second: [u32; 2]) -> bool {
    let at = |index: u32| &mesh.vertices[index as usize];
    let differ = |a: &Vertex, b: &Vertex| a.normal != b.normal || a.uv != b.uv || a.color != b.color || a.tangent != b.tangent;
    differ(at(edge[0]), at(second[1])) || differ(at(edge[1]), at(second[0]))
}

fn is_flat(mesh: &Mesh, [a, b, c, d]: Edge) -> bool {
    let at = |index: u32| mesh.vertices[index as usize].position;
    let along = at(b) - at(a);
    let normal = |corner| along.cross(at(corner) - at(a)).normalize_or_zero().as_vec3();
    let (left, right): (Vec3, Vec3) = (normal(c), -normal(d));
    left.dot(right) > FLAT_COSINE
}

/// The edges of one mesh on the GPU.
#[derive(Debug, Clone)]
pub(super) struct OutlineBuffers {
    group: wgpu::BindGroup,
    edge_count: u32,
}

/// Draws outlines; made when first asked for.
#[derive(Debug)]
pub(super) struct Outline {
    pipeline: wgpu::RenderPipeline,
}

impl Outline {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let module = SHADER.module(device);
        let stage = wgpu::PipelineCompilationOptions::default();
        Self {
            pipeline: device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("outline"),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vs_outline"),
                    compilation_options: stage.clone(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fs_outline"),
                    compilation_options: stage,
                    targets: &[Some(wgpu::TextureFormat::R8Uint.into())],
                }),
                multiview_mask: None,
                cache: None,
            }),
        }
    }

    /// Binds a mesh's edges, positions as they are on the GPU.
    pub(super) fn upload(&self, device: &wgpu::Device, mesh: &Mesh, positions: &wgpu::Buffer) -> OutlineBuffers {
        let edges = edges(mesh);
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("edges"),
            // A binding may not be empty.
            contents: bytemuck::cast_slice(if edges.is_empty() { &[[0; 4]] } else { &edges[..] }),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("outline"),
            layout: &self.pipeline.get_bind_group_layout(1),
            entries: &[
                wgpu::BindGroupEntry { binding: 10, resource: positions.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 11, resource: buffer.as_entire_binding() },
            ],
        });
        OutlineBuffers { group, edge_count: edges.len() as u32 }
    }

    /// Marks where edges pass that are not behind `depth`.
    pub(super) fn record(
        &self,
        device: &wgpu::Device,
        recorder: &mut Recorder<'_>,
        resources: &Resources,
        depth: &wgpu::Texture,
        outline: &wgpu::TextureView,
    ) {
        let frame = resources.bind_outline(device, &self.pipeline.get_bind_group_layout(0));
        let aspect = wgpu::TextureAspect::DepthOnly;
        let seen = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("outline depth"),
            layout: &self.pipeline.get_bind_group_layout(2),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(
                    &depth.create_view(&wgpu::TextureViewDescriptor { aspect, ..Default::default() }),
                ),
            }],
        });
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some("draw outline"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: outline,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
            })],
            ..Default::default()
        };
        recorder.render(&descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &frame, &[]);
            pass.set_bind_group(2, &seen, &[]);
            for batch in &resources.batches {
                let Some(edges) = &resources.mesh(batch.mesh).outline else { continue };
                pass.set_bind_group(1, &edges.group, &[]);
                pass.draw(0..VERTICES_AN_EDGE * edges.edge_count, batch.first..batch.first + batch.count);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec2};

    use super::*;

    /// Triangles of these corners, each corner a vertex of its own unless `shared`.
    fn mesh(triangles: &[[DVec3; 3]], shared: bool) -> Mesh {
        let mut mesh = Mesh::default();
        for position in triangles.iter().flatten() {
            let vertex = Vertex { position: *position, ..Vertex::default() };
            let known = mesh.vertices.iter().position(|v| shared && *v == vertex);
            mesh.indices.push(known.unwrap_or(mesh.vertices.len()) as u32);
            if known.is_none() {
                mesh.vertices.push(vertex);
            }
        }
        mesh
    }

    const ROOF: [[DVec3; 3]; 2] = [[DVec3::ZERO, DVec3::X, DVec3::Y], [DVec3::X, DVec3::ZERO, DVec3::new(0.0, -1.0, -1.0)]];

    fn always(edges: &[Edge]) -> usize {
        edges.iter().filter(|edge| edge[3] == ALWAYS).count()
    }

    #[test]
    fn a_fold_is_an_edge_where_one_side_is_seen_and_its_borders_always() {
        for shared in [true, false] {
            let edges = edges(&mesh(&ROOF, shared));
            assert_eq!((edges.len(), always(&edges)), (5, 4), "shared: {shared}");
        }
    }

    #[test]
    fn a_fold_with_a_seam_is_an_edge_always() {
        let mut mesh = mesh(&ROOF, false);
        mesh.vertices[3].uv = Vec2::ONE;
        assert_eq!(always(&edges(&mesh)), 5);
    }

    #[test]
    fn flat_faces_have_no_edges_inside() {
        let square = [[DVec3::ZERO, DVec3::X, DVec3::Y], [DVec3::Y, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]];
        assert_eq!(edges(&mesh(&square, false)).len(), 4);
    }

    #[test]
    fn what_has_no_area_does_no_harm() {
        assert!(edges(&Mesh::default()).is_empty());
        let point = [[DVec3::ONE; 3]];
        assert!(edges(&mesh(&point, false)).is_empty());
        // A needle of two equal corners, and three triangles on one edge.
        let fan = [ROOF[0], ROOF[1], [DVec3::ZERO, DVec3::X, DVec3::Z], [DVec3::X, DVec3::X, DVec3::Y]];
        assert!(always(&edges(&mesh(&fan, false))) >= 6);
    }
}
