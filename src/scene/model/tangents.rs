//! Normals and tangents that a model lacks.
//!
//! Tangents are averaged over the triangles that share a vertex. That is not MikkTSpace: where a model brings normal textures
//! baked for MikkTSpace without tangents, seams may show slightly.

use glam::{DVec3, Vec3, Vec4};

use crate::scene::{Mesh, Vertex};

/// Gives every vertex a unit normal and a unit tangent, keeping those that it has.
pub(super) fn complete(mesh: &mut Mesh) {
    let frames = frames(mesh);
    for (vertex, frame) in mesh.vertices.iter_mut().zip(frames) {
        let face_normal = frame.normal.normalize_or(DVec3::Z).as_vec3();
        vertex.normal = vertex.normal.try_normalize().unwrap_or(face_normal);
        vertex.tangent = tangent(vertex, &frame);
    }
}

/// What the triangles around a vertex say, weighted by their area.
#[derive(Debug, Clone, Copy, Default)]
struct Frame {
    normal: DVec3,
    along_u: DVec3,
    along_v: DVec3,
}

fn frames(mesh: &Mesh) -> Vec<Frame> {
    let mut frames = vec![Frame::default(); mesh.vertices.len()];
    for corners in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| &mesh.vertices[corners[k] as usize]);
        let (ab, ac) = (b.position - a.position, c.position - a.position);
        let (uv1, uv2) = ((b.uv - a.uv).as_dvec2(), (c.uv - a.uv).as_dvec2());
        let normal = ab.cross(ac);
        // Only directions count: the sign of the determinant is kept, its size is not.
        let mirrored = uv1.perp_dot(uv2).signum();
        let weight = normal.length() * mirrored;
        let along_u = (ab * uv2.y - ac * uv1.y).normalize_or_zero() * weight;
        let along_v = (ac * uv1.x - ab * uv2.x).normalize_or_zero() * weight;
        for &corner in corners {
            let frame = &mut frames[corner as usize];
            frame.normal += normal;
            frame.along_u += along_u;
            frame.along_v += along_v;
        }
    }
    frames
}

fn tangent(vertex: &Vertex, frame: &Frame) -> Vec4 {
    let across = |direction: Vec3| direction.reject_from_normalized(vertex.normal).try_normalize();
    if let Some(given) = across(vertex.tangent.truncate()) {
        return given.extend(if vertex.tangent.w < 0.0 { -1.0 } else { 1.0 });
    }
    let tangent = across(frame.along_u.normalize_or_zero().as_vec3()).unwrap_or_else(|| vertex.normal.any_orthonormal_vector());
    // The picture's up is where v falls: glTF's v points down.
    let up = -frame.along_v;
    let handedness = if vertex.normal.cross(tangent).as_dvec3().dot(up) < 0.0 { -1.0 } else { 1.0 };
    tangent.extend(handedness)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn quad(uv: impl Fn(f32, f32) -> Vec2) -> Mesh {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let vertices = corners
            .map(|(x, y)| Vertex {
                position: DVec3::new(f64::from(x), f64::from(y), 0.0),
                normal: Vec3::ZERO,
                tangent: Vec4::ZERO,
                uv: uv(x, y),
                color: Vec4::ONE,
            })
            .to_vec();
        Mesh { vertices, indices: vec![0, 1, 2, 0, 2, 3] }
    }

    #[test]
    fn tangents_run_along_u_and_the_bitangent_is_the_pictures_up() {
        let mut mesh = quad(|x, y| Vec2::new(x, 1.0 - y));
        complete(&mut mesh);
        assert!(mesh.vertices.iter().all(|v| v.normal == Vec3::Z && v.tangent == Vec4::new(1.0, 0.0, 0.0, 1.0)));
    }

    #[test]
    fn mirrored_uv_turn_the_handedness_around() {
        let mut mesh = quad(|x, y| Vec2::new(-x, 1.0 - y));
        complete(&mut mesh);
        assert!(mesh.vertices.iter().all(|v| v.tangent == Vec4::new(-1.0, 0.0, 0.0, -1.0)));
    }

    #[test]
    fn without_uv_there_is_still_some_tangent() {
        let mut mesh = quad(|_, _| Vec2::ZERO);
        complete(&mut mesh);
        for vertex in &mesh.vertices {
            assert!(
                (vertex.tangent.truncate().length() - 1.0).abs() < 1e-6 && vertex.tangent.truncate().dot(vertex.normal) == 0.0
            );
        }
    }

    #[test]
    fn given_normals_and_tangents_are_kept_but_made_unit_and_perpendicular() {
        let mut mesh = quad(Vec2::new);
        for vertex in &mut mesh.vertices {
            vertex.normal = Vec3::Y * 3.0;
            vertex.tangent = Vec4::new(2.0, 2.0, 0.0, -0.5);
        }
        complete(&mut mesh);
        assert!(mesh.vertices.iter().all(|v| v.normal == Vec3::Y && v.tangent == Vec4::new(1.0, 0.0, 0.0, -1.0)));
    }
}
