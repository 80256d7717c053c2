//! What is drawn at frame n: pure data, no GPU.
//!
//! A [`Scene`] comes from a TOML file, from a glTF model, or from code. [`Scene::frame`] answers what stands where at one frame
//! and where it stood the frame before; `forward` draws that answer, `capture::analytic` integrates it exactly.
//!
//! World space is right-handed with y up, lengths in metres. Positions are f64 until the camera's own are taken off them, so a
//! scene a million metres from the origin looks like one at the origin.

mod build;
mod camera;
mod document;
mod frame;
mod framing;
mod group;
mod load;
mod material;
mod mesh;
mod model;
mod motion;
mod place;
mod random;
mod replicas;
mod shapes;
mod shipped;
mod surface;
mod thresholds;
mod tick;
mod values;

pub use frame::{Frame, Instance, Projection, View};
pub use material::{AlphaMode, Material, Pattern, Texture, TextureRef, Wrap};
pub use mesh::{Mesh, Vertex};
pub use shipped::{SHIPPED, Shipped};
pub use thresholds::Thresholds;
pub use tick::Tick;

use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, Vec3};

use crate::error::{Error, Result};
use camera::Camera;
use group::{Group, Moment};

/// A test scene: one artefact class, or a model that was framed automatically.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Short name, as in `dejag list scenes`.
    pub name: String,
    /// What it tests, in a line.
    pub about: String,
    /// How many frames it has, at least 1.
    pub frames: u32,
    /// Seconds between frames, above 0.
    pub time_step: f64,
    /// Linear colour where nothing is.
    pub background: Vec3,
    /// Factor on linear colour before the tone map, above 0.
    pub exposure: f32,
    /// From exposed linear colour to [0, 1].
    pub tone_map: ToneMap,
    /// The one directional light.
    pub light: Light,
    /// Linear light from everywhere.
    pub ambient: Vec3,
    /// What the instances' `material` points into.
    pub materials: Vec<Material>,
    /// What the materials' textures point into.
    pub textures: Vec<Texture>,
    /// BLAKE3 of everything the scene was made from: its text and its assets' bytes.
    pub fingerprint: [u8; 32],
    /// What was left out of a model or replaced, for the user to know.
    pub warnings: Vec<String>,
    /// Bars that its file sets for the figures of its sequence.
    pub thresholds: Thresholds,
    camera: Camera,
    groups: Arc<[Group]>,
}

impl Scene {
    /// A shipped scene by name, or a `.toml`, `.gltf` or `.glb` file by path. A model gets a camera, a light and a background.
    ///
    /// # Errors
    /// An unknown name, an unreadable file, or a scene or model that makes no sense, with the place in the file.
    pub fn load(what: &str) -> Result<Self> {
        load::load(what)
    }

    /// From a scene file's text. Errors call it `path`; models are looked for beside `base_dir`.
    ///
    /// # Errors
    /// [`Error::Document`] with line and column, or what the models it names meet.
    pub fn parse(text: &str, path: &str, base_dir: &Path) -> Result<Self> {
        build::scene(text, path, base_dir)
    }

    /// What stands where at a frame, for a picture of `size` pixels. The same arguments give the same answer; meshes that do not
    /// change are shared with the frames before.
    ///
    /// # Errors
    /// [`Error::Request`] for a frame that the scene does not have, or a picture without pixels.
    pub fn frame(&self, index: u32, size: [u32; 2]) -> Result<Frame> {
        if index >= self.frames {
            let last = self.frames - 1;
            return Err(Error::Request(format!("scene '{}' has no frame {index}; choose one from 0 to {last}", self.name)));
        }
        self.at(&Tick::of_frame(self, index), size)
    }

    /// What stands where at a tick of any sequence, also before the scene's first frame or after its last.
    ///
    /// # Errors
    /// [`Error::Request`] for a picture without pixels.
    pub fn at(&self, tick: &Tick, size: [u32; 2]) -> Result<Frame> {
        if size.contains(&0) {
            return Err(Error::Request(format!("a picture of {}x{} has no pixels; choose at least 1x1", size[0], size[1])));
        }
        let times = [tick.time_s, tick.previous_time_s];
        let seen = |time: f64, shift_px: [f64; 2]| {
            let mut view = self.camera.view(time, size);
            view.shift_ndc = DVec2::new(2.0 * shift_px[0] / f64::from(size[0]), -2.0 * shift_px[1] / f64::from(size[1]));
            view
        };
        let view = seen(times[0], tick.shift_px);
        let moment = Moment { times, view, size };
        let mut instances = Vec::new();
        let mut first_id = 1;
        for group in self.groups.iter() {
            group.instances(&moment, first_id, &mut instances);
            first_id += group.id_count() as u32;
        }
        Ok(Frame { view, previous_view: seen(times[1], tick.previous_shift_px), instances })
    }

    /// The same scene with all its light multiplied by a factor: lights, background, and what shines by itself.
    #[must_use]
    pub fn dimmed(&self, factor: f32) -> Self {
        let mut scene = self.clone();
        scene.light.color *= factor;
        scene.ambient *= factor;
        scene.background *= factor;
        scene.materials.iter_mut().for_each(|material| material.dim(factor));
        scene
    }

    /// The name that the scene file gives to the object with this id; none for the background and for nameless ones.
    #[must_use]
    pub fn object_name(&self, id: u32) -> Option<&str> {
        let mut first_id = 1;
        for group in self.groups.iter() {
            let end = first_id + group.id_count() as u32;
            if (first_id..end).contains(&id) {
                return group.name.as_deref();
            }
            first_id = end;
        }
        None
    }
}

/// A light infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Unit vector from the surface to the light, in world space.
    pub to_light: Vec3,
    /// Linear irradiance on a surface that faces it, divided by pi: a white Lambert surface shows this colour.
    pub color: Vec3,
}

/// From exposed linear colour to [0, 1] before the sRGB coding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToneMap {
    /// Cut off at 1.
    Clamp,
    /// x / (1 + x) a channel.
    Reinhard,
    /// Narkowicz's fit of the ACES curve (2015).
    Aces,
    /// Sobotka's AgX, in the polynomial fit by Wrensch.
    AgX,
}

#[cfg(test)]
mod fuzz;
#[cfg(test)]
mod tests;
