//! A model's triangles.

use std::sync::Arc;

use glam::{DVec3, Vec2, Vec3, Vec4};
use gltf::json;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked;

use super::material::Worn;
use super::{Document, FARTHEST, Failure, tangents};
use crate::error::Result;
use crate::scene::{Mesh, Vertex};

/// A primitive as a mesh, and the index of its material.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) mesh: Arc<Mesh>,
    pub(super) material: usize,
}

/// The primitives of a mesh of the model that have triangles.
pub(super) fn pieces(document: &mut Document, mesh_index: usize, worn: &[Worn]) -> Result<Vec<Piece>> {
    let json = document.get(&document.root.meshes, mesh_index, "mesh")?.clone();
    let mut pieces = Vec::new();
    for (k, primitive) in json.primitives.iter().enumerate() {
        let what = format!("mesh {mesh_index} primitive {k}");
        // The default material stands behind the model's own.
        let material = primitive.material.map_or(worn.len() - 1, |material| material.value());
        let surface = document.get(worn, material, "material")?;
        if primitive.targets.as_ref().is_some_and(|targets| !targets.is_empty()) {
            document.warn(format!("mesh {mesh_index} has morph targets; they are left out"));
        }
        let mesh = Reader { document, primitive, what }.mesh(surface)?;
        if !mesh.indices.is_empty() {
            pieces.push(Piece { mesh: Arc::new(mesh), material });
        }
    }
    Ok(pieces)
}

struct Reader<'a> {
    document: &'a mut Document,
    primitive: &'a Primitive,
    what: String,
}

impl Reader<'_> {
    fn mesh(&mut self, surface: &Worn) -> Result<Mesh> {
        let Some(positions) = self.floats::<3>(&Semantic::Positions, None)? else {
            return Err(self.failure("has no POSITION"));
        };
        if positions.iter().flatten().any(|x| f64::from(x.abs()) > FARTHEST) {
            return Err(self.failure(&format!("has a position beyond {FARTHEST:e}")));
        }
        let indices = self.triangles(positions.len())?;
        let normals = self.floats::<3>(&Semantic::Normals, Some(positions.len()))?;
        let given_tangents = self.floats::<4>(&Semantic::Tangents, Some(positions.len()))?.filter(|_| normals.is_some());
        let uvs = self.floats::<2>(&Semantic::TexCoords(0), Some(positions.len()))?;
        let colors = self.colors(positions.len())?;
        let vertex = |k: usize| Vertex {
            position: Vec3::from(positions[k]).as_dvec3(),
            normal: normals.as_ref().map_or(Vec3::ZERO, |normals| normals[k].into()),
            tangent: given_tangents.as_ref().map_or(Vec4::ZERO, |tangents| tangents[k].into()),
            uv: uvs.as_ref().map_or(Vec2::ZERO, |uvs| surface.uv.apply(uvs[k].into())),
            color: colors.as_ref().map_or(Vec4::ONE, |colors| colors[k]),
        };
        let mut mesh = if normals.is_some() {
            Mesh { vertices: (0..positions.len()).map(vertex).collect(), indices }
        } else {
            // Flat faces share no corners.
            Mesh { vertices: indices.iter().map(|&k| vertex(k as usize)).collect(), indices: (0..indices.len() as u32).collect() }
        };
        drop_degenerate(&mut mesh);
        tangents::complete(&mut mesh);
        Ok(mesh)
    }

    /// An attribute, if the primitive has it, one for each vertex.
    fn floats<const N: usize>(&self, semantic: &Semantic, count: Option<usize>) -> Result<Option<Vec<[f32; N]>>> {
        let Some(&accessor) = self.primitive.attributes.get(&Checked::Valid(semantic.clone())) else {
            return Ok(None);
        };
        let what = format!("{} {}", self.what, semantic.to_string());
        let values = self.document.floats::<N>(accessor, &what)?;
        match count {
            Some(count) if count != values.len() => Err(self
                .document
                .failure(format!("{what} has {} elements; expected {count}, as many as positions", values.len()))),
            _ => Ok(Some(values)),
        }
    }

    /// COLOR_0 with or without opacity.
    fn colors(&self, count: usize) -> Result<Option<Vec<Vec4>>> {
        let semantic = Semantic::Colors(0);
        let Some(accessor) = self.primitive.attributes.get(&Checked::Valid(semantic.clone())) else {
            return Ok(None);
        };
        let json = self.document.get(&self.document.root.accessors, accessor.value(), "accessor")?;
        let colors: Option<Vec<Vec4>> = if matches!(json.type_, Checked::Valid(json::accessor::Type::Vec3)) {
            self.floats::<3>(&semantic, Some(count))?
                .map(|colors| colors.into_iter().map(|c| Vec3::from(c).extend(1.0)).collect())
        } else {
            self.floats::<4>(&semantic, Some(count))?.map(|colors| colors.into_iter().map(Vec4::from).collect())
        };
        Ok(colors.map(|colors| colors.into_iter().map(|color| color.max(Vec4::ZERO)).collect()))
    }

    /// Three indices a triangle, each below `vertex_count`.
    fn triangles(&mut self, vertex_count: usize) -> Result<Vec<u32>> {
        let indices = match self.primitive.indices {
            Some(accessor) => self.document.indices(accessor, &format!("{} indices", self.what))?,
            None => (0..vertex_count as u32).collect(),
        };
        if let Some(index) = indices.iter().find(|&&index| index as usize >= vertex_count) {
            return Err(self.failure(&format!("has the index {index} and only {vertex_count} vertices")));
        }
        match self.primitive.mode {
            Checked::Valid(Mode::Triangles) => {
                let whole = indices.len() - indices.len() % 3;
                if whole != indices.len() {
                    self.document.warn(format!("{} ends in the middle of a triangle; the rest is left out", self.what));
                }
                Ok(indices[..whole].to_vec())
            }
            Checked::Valid(Mode::TriangleStrip) => Ok(strip(&indices)),
            Checked::Valid(Mode::TriangleFan) => Ok(fan(&indices)),
            Checked::Valid(Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) => {
                self.document.warn(format!("{} is points or lines; it is left out", self.what));
                Ok(Vec::new())
            }
            Checked::Invalid => Err(self.failure("has a mode that does not exist")),
        }
    }

    fn failure(&self, message: &str) -> crate::error::Error {
        self.document.failure(format!("{} {message}", self.what))
    }
}

/// Every other triangle of a strip runs the other way around.
fn strip(indices: &[u32]) -> Vec<u32> {
    let triangles = indices.windows(3).enumerate();
    triangles.flat_map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[0], t[2], t[1]] }).collect()
}

fn fan(indices: &[u32]) -> Vec<u32> {
    let Some((&hub, rim)) = indices.split_first() else {
        return Vec::new();
    };
    rim.windows(2).flat_map(|pair| [hub, pair[0], pair[1]]).collect()
}

/// Triangles without area cover nothing and have no direction; strips are full of them.
fn drop_degenerate(mesh: &mut Mesh) {
    let Mesh { vertices, indices } = mesh;
    let kept = indices.chunks_exact(3).filter(|t| {
        let [a, b, c] = [t[0], t[1], t[2]].map(|k| vertices[k as usize].position);
        (b - a).cross(c - a) != DVec3::ZERO
    });
    *indices = kept.flatten().copied().collect();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_become_triangles_that_face_the_same_way() {
        assert_eq!(strip(&[0, 1, 2, 3, 4]), [0, 1, 2, 1, 3, 2, 2, 3, 4]);
        assert_eq!(fan(&[0, 1, 2, 3]), [0, 1, 2, 0, 2, 3]);
        assert!(strip(&[0, 1]).is_empty() && fan(&[]).is_empty() && fan(&[7]).is_empty());
    }
}
