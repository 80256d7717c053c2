//! The reference: a shot of very many samples, with its own error, kept for the next time.

use std::collections::HashSet;
use std::sync::Arc;

use glam::DAffine3;
use serde::{Deserialize, Serialize};

use super::cache::{Cache, CacheEntry};
use super::present::Present;
use super::shot::{Shot, Studio, Watch};
use crate::error::Result;
use crate::methods::Spec;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::{Frame, Scene, Tick, View};
use crate::{forward, gpu::Card};

/// What candidates are held against unless asked otherwise: see `docs/reference.md` for why this pattern.
pub const REFERENCE_SPEC: &str = "ssaa:spp=2500,pattern=larcher";

/// A picture to hold candidates against.
#[derive(Debug, Clone)]
pub struct Reference {
    /// The method it was made with.
    pub spec: String,
    /// Linear light, not exposed.
    pub linear: LinearPicture,
    /// As the display shows it.
    pub display: DisplayPicture,
    /// How much two halves of its samples differ; none for methods that have no halves.
    pub halves: Option<Halves>,
    /// Whether it came from the cache.
    pub cached: bool,
}

/// Difference of the pictures made of each half of the samples, over all channels, in exposed linear values clamped to [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Halves {
    /// Root mean square.
    pub rms: f64,
    /// Largest.
    pub max: f64,
}

impl Studio<'_> {
    /// The reference of a frame: from the cache, or drawn and put there.
    ///
    /// # Errors
    /// As [`Studio::take`]. A cache that cannot be written is none: [`Cache::failure`] tells of it.
    pub fn reference(
        &mut self,
        spec: &Spec,
        tick: &Tick,
        size: [u32; 2],
        cache: &Cache,
        watch: &mut dyn Watch,
    ) -> Result<Reference> {
        self.gpu.check_size(size)?;
        let key = reference_key(self.scene, tick, spec, size, &self.gpu.card)?;
        if let Some((linear, entry)) = cache.get(&key).filter(|(_, entry)| entry.size == size) {
            let display = self.display_of(&linear)?;
            return Ok(Reference { spec: spec.to_string(), linear, display, halves: entry.halves, cached: true });
        }
        let mut shot = self.shot(spec, 0, size)?;
        shot.move_to(*tick, true);
        self.take(&mut shot, None, watch)?;
        let capture = self.read(&shot)?;
        let linear = capture.linear.unwrap_or_else(|| capture.display.to_linear());
        let halves = self.halves(&mut shot)?;
        let entry = CacheEntry { size, scene: self.scene.name.clone(), spec: spec.to_string(), halves };
        cache.put(&key, &linear, &entry);
        // Shown from what the cache will hand out next time, not from the GPU's own copy: the same bits either way.
        let display = self.display_of(&linear)?;
        Ok(Reference { spec: spec.to_string(), linear, display, halves, cached: false })
    }

    /// A linear picture of this scene as the display shows it.
    ///
    /// # Errors
    /// [`crate::Error::Gpu`].
    pub fn display_of(&self, linear: &LinearPicture) -> Result<DisplayPicture> {
        Present::display_of(self.gpu, self.scene, &self.gpu.upload_linear(linear))
    }

    fn halves(&self, shot: &mut Shot) -> Result<Option<Halves>> {
        if !["half-a", "half-b"].iter().all(|half| shot.views().contains(half)) {
            return Ok(None);
        }
        let mut read = |half| self.gpu.read_linear(shot.view(self.gpu, half)?.texture());
        let (a, b) = (read("half-a")?, read("half-b")?);
        Ok(difference(&a, &b, self.scene.exposure))
    }
}

/// Of two sums that carry their weight in alpha. None where one of them is empty.
fn difference(a: &LinearPicture, b: &LinearPicture, exposure: f32) -> Option<Halves> {
    let shown = |x: f32, weight: f32| f64::from((x / weight * exposure).clamp(0.0, 1.0));
    let (mut sum, mut max) = (0.0, 0.0f64);
    for (p, q) in a.pixels().iter().zip(b.pixels()) {
        if p[3] <= 0.0 || q[3] <= 0.0 {
            return None;
        }
        for channel in 0..3 {
            let d = (shown(p[channel], p[3]) - shown(q[channel], q[3])).abs();
            sum += d * d;
            max = max.max(d);
        }
    }
    Some(Halves { rms: (sum / (a.pixels().len() * 3) as f64).sqrt(), max })
}

/// A hash of everything that shapes a reference: what is drawn, with what, how, how large, and on what.
///
/// # Errors
/// [`crate::Error::Request`] for a picture without pixels.
pub fn reference_key(scene: &Scene, tick: &Tick, spec: &Spec, size: [u32; 2], card: &Card) -> Result<String> {
    let frame = scene.at(tick, size)?;
    // An open shutter sees what comes around the frame's moment.
    let (early, late) = (scene.at(&tick.later(-0.5), size)?, scene.at(&tick.later(0.5), size)?);
    let mut hasher = blake3::Hasher::new();
    // Debug output holds every field, and a technique's holds its sample positions and weights. A method's would hold addresses of
    // functions, which differ from process to process.
    let techniques: Vec<_> = spec.stages.iter().map(|stage| (stage.method.name, &stage.technique)).collect();
    let words = format!(
        "{} {} {size:?} {card:?} {techniques:?} {:?} {:?} {:?} {:?}",
        env!("CARGO_PKG_VERSION"),
        forward::REVISION,
        scene.light,
        (scene.background, scene.ambient, scene.exposure),
        scene.materials,
        [&early, &frame, &late].map(placed),
    );
    hasher.update(words.as_bytes()).update(&scene.fingerprint).update(forward::SHADER.text().as_bytes());
    for shader in spec.stages.iter().flat_map(|stage| stage.method.shaders) {
        hasher.update(shader.text().as_bytes());
    }
    let mut meshes = HashSet::new();
    for instance in &frame.instances {
        if meshes.insert(Arc::as_ptr(&instance.mesh)) {
            for vertex in &instance.mesh.vertices {
                hasher.update(bytemuck::bytes_of(&vertex.position.to_array()));
                hasher.update(bytemuck::bytes_of(&vertex.normal.to_array()));
                hasher.update(bytemuck::bytes_of(&vertex.uv.to_array()));
                hasher.update(bytemuck::bytes_of(&vertex.color.to_array()));
            }
            hasher.update(bytemuck::cast_slice(&instance.mesh.indices));
        }
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Where the camera is and what it sees.
fn placed(frame: &Frame) -> (View, Vec<(usize, DAffine3, u32)>) {
    (frame.view, frame.instances.iter().map(|i| (i.material, i.world_from_object, i.id)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_differ_by_their_means() {
        let sum =
            |value: f32, weight: f32| LinearPicture::new(1, 1, vec![[value * weight, 0.0, 2.0 * weight, weight]]).expect("fits");
        let found = difference(&sum(0.5, 10.0), &sum(0.25, 4.0), 1.0).expect("both have samples");
        assert!((found.max - 0.25).abs() < 1e-7);
        assert!((found.rms - 0.25 / 3.0f64.sqrt()).abs() < 1e-7);
        assert!(difference(&sum(0.5, 10.0), &sum(0.5, 0.0), 1.0).is_none());
    }
}
