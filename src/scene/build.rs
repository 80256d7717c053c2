//! From a scene file's text to a [`Scene`].

use std::path::Path;
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::camera::Camera;
use super::document::{ObjectDoc, SceneDoc};
use super::group::{Geometry, Group, Part, has_extent};
use super::model::{self, Model, Rig};
use super::motion::Motion;
use super::place::{Place, Source};
use super::replicas::{MOST_INSTANCES, Replica, replicas};
use super::shapes::Built;
use super::values::MaterialUse;
use super::{Material, Mesh, Scene, Texture, surface};
use crate::error::{Result, unknown};

/// Triangles that a scene file's own shapes may draw in a frame.
const MOST_TRIANGLES: usize = 4_000_000;
/// Coordinates beyond this lose the f32 arithmetic of a GPU.
const FARTHEST: f64 = 1e12;

/// Builds a scene. `path` is how errors name the file, `base_dir` where its models are looked for.
pub(super) fn scene(text: &str, path: &str, base_dir: &Path) -> Result<Scene> {
    let source = Source::parse(path, text)?;
    let doc: SceneDoc = source.deserialize()?;
    let root = source.root();
    let exposure_ev = root.key("exposure_ev").within(doc.exposure_ev, -30.0..=30.0)?;
    let mut builder = Builder::new(base_dir, text);
    builder.named_materials(&doc, &root.key("materials"))?;
    builder.objects(&doc.objects, &root)?;
    let anisotropy = root.key("anisotropy").count(doc.anisotropy, 1..=16)? as u16;
    for texture in &mut builder.textures {
        texture.anisotropy = anisotropy;
    }
    doc.thresholds.check(&root.key("thresholds"))?;
    Ok(Scene {
        name: doc.name.unwrap_or_else(|| stem(path)),
        about: doc.about,
        frames: root.key("frames").count(doc.frames, 1..=1_000_000)?,
        time_step: root.key("time_step").within(doc.time_step, 1e-6..=3600.0)?,
        background: surface::color(doc.background, &root.key("background"))?,
        exposure: exposure_ev.exp2() as f32,
        tone_map: surface::tone_map(doc.tone_map),
        light: surface::light(doc.light.as_ref(), &root.key("light"))?,
        ambient: surface::color(doc.ambient, &root.key("ambient"))?,
        materials: builder.materials,
        textures: builder.textures,
        fingerprint: *builder.hash.finalize().as_bytes(),
        warnings: builder.warnings,
        thresholds: doc.thresholds,
        camera: Camera::build(&doc.camera, &root.key("camera"))?,
        groups: builder.groups.into(),
    })
}

fn stem(path: &str) -> String {
    Path::new(path).file_stem().map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// What grows while the objects are read.
struct Builder<'a> {
    base_dir: &'a Path,
    materials: Vec<Material>,
    /// Names of the first materials.
    material_names: Vec<String>,
    textures: Vec<Texture>,
    groups: Vec<Group>,
    warnings: Vec<String>,
    hash: blake3::Hasher,
    instance_count: usize,
    triangle_count: usize,
}

impl<'a> Builder<'a> {
    fn new(base_dir: &'a Path, text: &str) -> Self {
        let mut hash = blake3::Hasher::new();
        hash.update(text.as_bytes());
        Self {
            base_dir,
            materials: Vec::new(),
            material_names: Vec::new(),
            textures: Vec::new(),
            groups: Vec::new(),
            warnings: Vec::new(),
            hash,
            instance_count: 0,
            triangle_count: 0,
        }
    }

    fn named_materials(&mut self, doc: &SceneDoc, at: &Place<'_>) -> Result<()> {
        for (name, material) in &doc.materials {
            self.materials.push(surface::material(material, &at.key(name))?);
            self.material_names.push(name.clone());
        }
        Ok(())
    }

    fn objects(&mut self, objects: &[ObjectDoc], root: &Place<'_>) -> Result<()> {
        if objects.is_empty() {
            return Err(root.error("the scene has nothing to draw; expected at least one [[objects]]"));
        }
        let at = root.key("objects");
        for (k, object) in objects.iter().enumerate() {
            let at = at.item(k);
            let group = self.group(object, &at)?;
            self.check(&group, &at)?;
            self.groups.push(group);
        }
        Ok(())
    }

    fn group(&mut self, doc: &ObjectDoc, at: &Place<'_>) -> Result<Group> {
        let motion = Motion::build(doc, at)?;
        let replicas = replicas(doc, at)?;
        let group = |motion, replicas, parts, rig| Group { name: doc.name.clone(), motion, replicas, parts, rig };
        let no_join = |what| at.key("join").error(format!("{what} cannot be joined; remove `join`"));
        let geometry = match doc.shape.build(&at.key("shape"))? {
            Built::Model(_) if doc.material.is_some() => {
                return Err(at.key("material").error("a glTF model brings its own materials; remove this one"));
            }
            Built::Model(_) if doc.join => return Err(no_join("glTF models")),
            Built::Model(path) => {
                let (parts, rig) = self.model(&path)?;
                return Ok(group(motion, replicas, parts, Some(rig)));
            }
            Built::Wire(_) if doc.join => return Err(no_join("wires")),
            Built::Wire(wire) => Geometry::Wire(Arc::new(wire)),
            Built::Mesh(mesh) if doc.join => {
                let part = Part { material: self.material(doc, at)?, node: 0, geometry: join(&mesh, &motion, &replicas, at)? };
                let motion = if motion.is_still() { Motion::still() } else { motion };
                return Ok(group(motion, vec![Replica::ITSELF], vec![part], None));
            }
            Built::Mesh(mesh) => Geometry::Mesh(Arc::new(mesh)),
        };
        let part = Part { geometry, material: self.material(doc, at)?, node: 0 };
        Ok(group(motion, replicas, vec![part], None))
    }

    /// The index of an object's material; white where it has none.
    fn material(&mut self, doc: &ObjectDoc, at: &Place<'_>) -> Result<usize> {
        let at = at.key("material");
        let material = match &doc.material {
            None => Material::default(),
            Some(MaterialUse::Inline(doc)) => surface::material(doc, &at)?,
            Some(MaterialUse::Named(name)) => {
                return self.material_names.iter().position(|known| known == name).ok_or_else(|| {
                    let known: Vec<&str> = self.material_names.iter().map(String::as_str).collect();
                    at.error(unknown("material", name, &known).to_string())
                });
            }
        };
        self.materials.push(material);
        Ok(self.materials.len() - 1)
    }

    /// Reads a model and takes over its materials and textures.
    fn model(&mut self, path: &str) -> Result<(Vec<Part>, Arc<Rig>)> {
        let Model { mut parts, rig, materials, textures, warnings, fingerprint } = model::load(&self.base_dir.join(path))?;
        let (first_material, first_texture) = (self.materials.len(), self.textures.len());
        for part in &mut parts {
            part.material += first_material;
        }
        self.materials.extend(materials.into_iter().map(|material| model::shift_textures(material, first_texture)));
        self.textures.extend(textures);
        self.warnings.extend(warnings.into_iter().map(|warning| format!("{path}: {warning}")));
        self.hash.update(&fingerprint);
        Ok((parts, rig))
    }

    /// Adds a group to the totals and refuses what is too much or stands nowhere.
    fn check(&mut self, group: &Group, at: &Place<'_>) -> Result<()> {
        self.instance_count = self.instance_count.saturating_add(group.id_count());
        if self.instance_count > MOST_INSTANCES {
            return Err(at.error(format!("the scene has more than {MOST_INSTANCES} instances; expected fewer, or `join = true`")));
        }
        if group.rig.is_none() {
            let triangles: usize = group.parts.iter().map(|part| part.geometry.triangle_limit()).sum();
            self.triangle_count = self.triangle_count.saturating_add(triangles.saturating_mul(group.replicas.len()));
        }
        if self.triangle_count > MOST_TRIANGLES {
            return Err(at.error(format!("the scene draws more than {MOST_TRIANGLES} triangles; expected fewer")));
        }
        let own = group.motion.at(0.0);
        let reach = group.parts.iter().map(|part| part.geometry.reach()).fold(0.0, f64::max);
        for replica in &group.replicas {
            let world = replica.place(&own);
            let m = &world.matrix3;
            let farthest =
                world.translation.abs().max_element() + reach * (m.x_axis.length() + m.y_axis.length() + m.z_axis.length());
            if !has_extent(&world) || farthest > FARTHEST {
                return Err(at.error("the object is flattened or stands too far away to be drawn; expected a smaller transform"));
            }
        }
        Ok(())
    }
}

/// All replicas as one mesh: in world space where nothing moves, else in the object's own.
fn join(mesh: &Mesh, motion: &Motion, replicas: &[Replica], at: &Place<'_>) -> Result<Geometry> {
    let total = (mesh.indices.len() / 3).saturating_mul(replicas.len());
    if total > MOST_TRIANGLES {
        return Err(at.error(format!("the object has {total} triangles; expected at most {MOST_TRIANGLES}")));
    }
    let own = motion.at(0.0);
    let back = if motion.is_still() { DAffine3::IDENTITY } else { own.inverse() };
    let mut joined = Mesh::default();
    for replica in replicas {
        let first = joined.vertices.len();
        joined.append(mesh, &(back * replica.place(&own)));
        let shade = DVec3::splat(replica.shade).as_vec3().extend(1.0);
        for vertex in &mut joined.vertices[first..] {
            vertex.color *= shade;
        }
    }
    Ok(Geometry::Mesh(Arc::new(joined)))
}
