//! Triangles.

use glam::{DAffine3, DMat3, DVec3, Vec2, Vec3, Vec4};

/// An indexed triangle list in object space. Front faces are counter-clockwise.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// The corners.
    pub vertices: Vec<Vertex>,
    /// Three a triangle, each below `vertices.len()`.
    pub indices: Vec<u32>,
}

/// A corner of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// In object space, metres.
    pub position: DVec3,
    /// Unit length.
    pub normal: Vec3,
    /// Unit tangent along u; w is the sign of the bitangent, +1 or -1.
    pub tangent: Vec4,
    /// Texture and pattern coordinates.
    pub uv: Vec2,
    /// Linear colour and opacity; multiplies the material's.
    pub color: Vec4,
}

impl Default for Vertex {
    fn default() -> Self {
        Self { position: DVec3::ZERO, normal: Vec3::Z, tangent: Vec4::new(1.0, 0.0, 0.0, 1.0), uv: Vec2::ZERO, color: Vec4::ONE }
    }
}

impl Mesh {
    /// The corners of each triangle.
    pub fn triangles(&self) -> impl Iterator<Item = [&Vertex; 3]> {
        self.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|k| &self.vertices[t[k] as usize]))
    }

    /// Smallest and largest corner of the box around all vertices; none for an empty mesh.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let first = self.vertices.first()?.position;
        Some(self.vertices.iter().fold((first, first), |(low, high), v| (low.min(v.position), high.max(v.position))))
    }

    /// Adds a copy of another mesh, transformed. A mirroring transform turns the triangles around, so that front stays front.
    pub(super) fn append(&mut self, other: &Self, transform: &DAffine3) {
        let first = self.vertices.len() as u32;
        let mirrored = transform.matrix3.determinant() < 0.0;
        let moved = VertexTransform::new(transform);
        self.vertices.extend(other.vertices.iter().map(|vertex| moved.apply(vertex)));
        self.indices.extend(other.indices.chunks_exact(3).flat_map(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|index| first + index);
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
    }
}

/// A transform with its normal matrix, computed once a mesh.
struct VertexTransform {
    point: DAffine3,
    normal: DMat3,
    handedness: f32,
}

impl VertexTransform {
    fn new(transform: &DAffine3) -> Self {
        Self {
            point: *transform,
            normal: transform.matrix3.inverse().transpose(),
            handedness: transform.matrix3.determinant().signum() as f32,
        }
    }

    fn apply(&self, vertex: &Vertex) -> Vertex {
        let normal = (self.normal * vertex.normal.as_dvec3()).normalize_or(DVec3::Z);
        let tangent = self.point.transform_vector3(vertex.tangent.truncate().as_dvec3());
        let tangent = tangent.reject_from_normalized(normal).normalize_or(normal.any_orthonormal_vector());
        Vertex {
            position: self.point.transform_point3(vertex.position),
            normal: normal.as_vec3(),
            tangent: tangent.as_vec3().extend(vertex.tangent.w * self.handedness),
            ..*vertex
        }
    }
}
