//! glTF 2.0 models, `.gltf` and `.glb`.
//!
//! The `gltf` crate's structures describe the JSON; everything beyond that is read here, because nothing a file says may be
//! trusted: every index, offset, count and size is checked before it is used, and nothing large is allocated on a claim alone.
//!
//! Drawn: triangles, strips and fans; base colour, metallic-roughness, normal and emissive textures with their factors; masks,
//! unlit and double-sided materials, vertex colours; the node tree and the first animation. Left out with a warning: blending
//! (drawn opaque), skins, morph targets, points and lines, second uv sets.

mod accessor;
mod animation;
mod container;
mod image;
mod material;
mod nodes;
mod primitive;
mod rig;
mod tangents;
mod uri;

#[cfg(test)]
mod fuzz;
#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use gltf::json;
use serde_json::Value;

use super::framing::Framing;
use super::group::{Geometry, Group, Part};
use super::motion::Motion;
use super::replicas::{MOST_INSTANCES, Replica};
use super::{Camera, Light, Material, Scene, Texture, Thresholds, ToneMap, Vertex, load};
use crate::error::{Error, Result};
use image::Textures;

pub(super) use rig::Rig;

/// Of the model's own file, and of each buffer.
const LARGEST_FILE: u64 = 2 << 30;
/// Triangles that a model may draw in a frame.
const MOST_TRIANGLES: usize = 16_000_000;
/// A part so many times as large as the parts' median is not what the camera is to show.
const DWARFING: f64 = 20.0;
/// Coordinates beyond this lose the f32 arithmetic of a GPU.
const FARTHEST: f64 = 1e12;

/// A model as it was read, before it is given a place in a scene.
pub(super) struct Model {
    pub(super) parts: Vec<Part>,
    pub(super) rig: Arc<Rig>,
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    pub(super) warnings: Vec<String>,
    pub(super) fingerprint: [u8; 32],
}

/// What has a path to blame.
trait Failure {
    /// A model that was read but makes no sense.
    fn failure(&self, message: impl Into<String>) -> Error;
}

impl Failure for Path {
    fn failure(&self, message: impl Into<String>) -> Error {
        Error::Model { path: self.display().to_string(), message: message.into() }
    }
}

impl Failure for Document {
    fn failure(&self, message: impl Into<String>) -> Error {
        self.path.failure(message)
    }
}

/// A model's JSON and the buffers it speaks of.
struct Document {
    path: PathBuf,
    root: json::Root,
    /// The JSON again, for the extensions that the crate's structures leave out.
    raw: Value,
    buffers: Vec<Vec<u8>>,
    warnings: Vec<String>,
    hasher: blake3::Hasher,
}

impl Document {
    fn open(path: &Path) -> Result<Self> {
        let bytes = load::read(path, LARGEST_FILE, "glTF model")?;
        let container = container::open(path, &bytes)?;
        let mut warnings = Vec::new();
        let root = container::parse(path, container.json, &mut warnings)?;
        let raw = if root.extensions_used.iter().any(|name| name == "KHR_texture_transform") {
            serde_json::from_slice(container.json).unwrap_or_default()
        } else {
            Value::Null
        };
        let mut document =
            Self { path: path.to_path_buf(), root, raw, buffers: Vec::new(), warnings, hasher: blake3::Hasher::new() };
        document.hash(&bytes);
        document.read_buffers(container.binary)?;
        Ok(document)
    }

    fn read_buffers(&mut self, binary: Option<&[u8]>) -> Result<()> {
        for index in 0..self.root.buffers.len() {
            let buffer = self.root.buffers[index].clone();
            let (mut bytes, path) = match (&buffer.uri, binary) {
                (Some(uri), _) => {
                    let resource = uri::read(&self.path, uri, LARGEST_FILE, "glTF buffer")?;
                    self.hash(&resource.bytes);
                    (resource.bytes, resource.path)
                }
                (None, Some(binary)) if index == 0 => (binary.to_vec(), self.path.clone()),
                (None, _) => return Err(self.failure(format!("buffer {index} has no uri, and the file holds no bytes for it"))),
            };
            let length = buffer.byte_length.0;
            if (bytes.len() as u64) < length {
                let message = format!("buffer {index} should have {length} bytes and has {}", bytes.len());
                return Err(Error::Format { path, expected: "glTF buffer", message });
            }
            // The binary chunk may be padded; what lies beyond the buffer's end is none of it.
            bytes.truncate(length as usize);
            self.buffers.push(bytes);
        }
        Ok(())
    }

    /// An item of one of the model's lists.
    fn get<'a, T>(&self, list: &'a [T], index: usize, what: &str) -> Result<&'a T> {
        list.get(index).ok_or_else(|| self.failure(format!("there is no {what} {index}; the model has {}", list.len())))
    }

    /// Says a thing once.
    fn warn(&mut self, warning: String) {
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }

    /// Takes bytes into the fingerprint, so that no two lists of files have the same.
    fn hash(&mut self, bytes: &[u8]) {
        self.hasher.update(&(bytes.len() as u64).to_le_bytes());
        self.hasher.update(bytes);
    }
}

/// Reads a model.
pub(super) fn load(path: &Path) -> Result<Model> {
    let mut document = Document::open(path)?;
    let mut textures = Textures::default();
    let mut worn = material::materials(&mut document, &mut textures)?;
    worn.push(material::Worn::default_material());
    let tree = nodes::tree(&mut document)?;
    let parts = parts(&mut document, &worn, &tree)?;
    let animation = animation::first(&mut document, &tree)?;
    let rig = Rig::new(tree.nodes, animation);
    check_poses(&document, &rig, &parts)?;
    let fingerprint = *document.hasher.finalize().as_bytes();
    Ok(Model {
        parts,
        rig: Arc::new(rig),
        materials: worn.into_iter().map(|worn| worn.material).collect(),
        textures: textures.list,
        warnings: document.warnings,
        fingerprint,
    })
}

/// One part for each primitive of each node's mesh; nodes share their meshes' triangles.
fn parts(document: &mut Document, worn: &[material::Worn], tree: &nodes::Tree) -> Result<Vec<Part>> {
    let mut meshes: Vec<Option<Vec<primitive::Piece>>> = vec![None; document.root.meshes.len()];
    let mut parts = Vec::new();
    let mut triangle_count: usize = 0;
    for &(node, mesh) in &tree.meshes {
        document.get(&document.root.meshes, mesh, "mesh")?;
        if meshes[mesh].is_none() {
            meshes[mesh] = Some(primitive::pieces(document, mesh, worn)?);
        }
        for piece in meshes[mesh].iter().flatten() {
            triangle_count = triangle_count.saturating_add(piece.mesh.indices.len() / 3);
            parts.push(Part { geometry: Geometry::Mesh(piece.mesh.clone()), material: piece.material, node });
        }
        if parts.len() > MOST_INSTANCES || triangle_count > MOST_TRIANGLES {
            return Err(document.failure(format!(
                "it draws too much; expected at most {MOST_INSTANCES} primitives and {MOST_TRIANGLES} triangles"
            )));
        }
    }
    Ok(parts)
}

/// Node transforms multiply; what they make of the meshes must stay finite and near enough.
fn check_poses(document: &Document, rig: &Rig, parts: &[Part]) -> Result<()> {
    let reaches: Vec<f64> = parts.iter().map(|part| part.geometry.reach()).collect();
    for time in rig.sample_times() {
        let pose = rig.pose(time);
        for (part, reach) in parts.iter().zip(&reaches) {
            let transform = pose[part.node];
            let m = transform.matrix3;
            let spread = reach * (m.x_axis.length() + m.y_axis.length() + m.z_axis.length());
            let farthest = transform.translation.abs().max_element() + spread;
            // Not a number is not near either.
            if !transform.is_finite() || farthest.is_nan() || farthest > FARTHEST {
                return Err(document.failure(format!("node {} is scaled or moved beyond {FARTHEST:e}", rig.node_name(part.node))));
            }
        }
    }
    Ok(())
}

/// A scene around a model: a camera that shows it all, a sun, some light from everywhere, light grey behind.
pub(super) fn scene(path: &Path) -> Result<Scene> {
    let model = load(path)?;
    let framing = Framing::around(points(&model)).ok_or_else(|| path.failure("it has nothing to draw"))?;
    let time_step = 1.0 / 60.0;
    let frames = (model.rig.duration() / time_step).ceil().clamp(1.0, 600.0) as u32;
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let group = Group {
        name: Some(name.clone()),
        motion: Motion::still(),
        replicas: vec![Replica::ITSELF],
        parts: model.parts,
        rig: Some(model.rig),
    };
    Ok(Scene {
        about: format!("the model {}", path.display()),
        name,
        frames,
        time_step,
        background: glam::Vec3::splat(0.62),
        exposure: 1.0,
        tone_map: ToneMap::Clamp,
        light: Light { to_light: glam::Vec3::new(-0.35, 1.0, 0.75).normalize(), color: glam::Vec3::splat(1.0) },
        ambient: glam::Vec3::splat(0.28),
        materials: model.materials,
        textures: model.textures,
        fingerprint: model.fingerprint,
        warnings: model.warnings,
        thresholds: Thresholds::default(),
        camera: Camera::Framing(framing),
        groups: [group].into(),
    })
}

/// All that the model draws over its animation, without a floor or a sky that dwarfs the rest.
fn points(model: &Model) -> impl Iterator<Item = glam::DVec3> {
    let poses: Vec<_> = model.rig.sample_times().map(|time| model.rig.pose(time)).collect();
    let radii: Vec<f64> = model.parts.iter().map(|part| radius(part, &poses[0][part.node])).collect();
    let mut sorted = radii.clone();
    sorted.sort_by(f64::total_cmp);
    let largest = sorted.get(sorted.len() / 2).map_or(0.0, |median| DWARFING * median);
    poses.into_iter().flat_map(move |pose| {
        let shown = model.parts.iter().zip(radii.clone()).filter(move |(_, radius)| *radius <= largest);
        shown.flat_map(move |(part, _)| {
            let transform = pose[part.node];
            vertices(part).iter().map(move |vertex| transform.transform_point3(vertex.position))
        })
    })
}

fn vertices(part: &Part) -> &[Vertex] {
    match &part.geometry {
        Geometry::Mesh(mesh) => &mesh.vertices,
        Geometry::Wire(_) => &[],
    }
}

/// Half the diagonal of a part's box, where it stands.
fn radius(part: &Part, transform: &glam::DAffine3) -> f64 {
    let bounds = match &part.geometry {
        Geometry::Mesh(mesh) => mesh.bounds(),
        Geometry::Wire(_) => None,
    };
    bounds.map_or(0.0, |(low, high)| 0.5 * transform.transform_vector3(high - low).length())
}

/// A material whose textures stand further behind in the scene's list.
pub(super) fn shift_textures(mut material: Material, by: usize) -> Material {
    let textures = [
        &mut material.base_color_texture,
        &mut material.metallic_roughness_texture,
        &mut material.normal_texture,
        &mut material.emissive_texture,
    ];
    for texture in textures.into_iter().flatten() {
        texture.texture += by;
    }
    material
}
