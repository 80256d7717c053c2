//! What lies at the pixels' centres, without colour: motion, ids and depth as numbers.

use super::shot::{Shot, Studio};
use crate::error::{Error, Result};
use crate::forward::Targets;
use crate::methods::Spec;
use crate::pass::Extras;
use crate::picture::LinearPicture;
use crate::scene::Tick;

/// What lies at each pixel's centre, in reading order.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Un-jittered motion in pixels, right and down, from the tick's time to its previous one.
    pub motion_px: Vec<[f32; 2]>,
    /// Object ids, 0 for the background.
    pub ids: Vec<u32>,
    /// Reversed: 1 near, 0 at infinity.
    pub depth: Vec<f32>,
}

/// A plain draw that is taken for its geometry, again and again.
#[derive(Debug)]
pub struct GeometryShot {
    shot: Shot,
    size: [u32; 2],
}

impl GeometryShot {
    /// Prepares it.
    ///
    /// # Errors
    /// As [`Studio::shot`].
    pub fn new(studio: &Studio<'_>, size: [u32; 2]) -> Result<Self> {
        let plain = Spec::parse("none")?;
        let extras = Extras { depth: true, motion: true, ids: true, signature: false };
        let shot = studio.shot_of(&[("none", &*plain.stages[0].technique)], 0, size, extras)?;
        Ok(Self { shot, size })
    }

    /// Draws and reads it at a tick. A tick whose previous time is a later one gives the motion to there.
    ///
    /// # Errors
    /// As [`Studio::take`].
    pub fn take(&mut self, studio: &mut Studio<'_>, tick: &Tick) -> Result<Geometry> {
        self.shot.move_to(*tick, true);
        studio.take(&mut self.shot, None, &mut ())?;
        let read = |pick: fn(&Targets) -> Option<&wgpu::Texture>| read_drawn(studio, &self.shot, pick);
        let motion = read(|targets| targets.motion.as_ref())?;
        let ids = read(|targets| targets.ids.as_ref())?;
        let depth = read(|targets| Some(&targets.depth))?;
        Ok(Geometry {
            size: self.size,
            motion_px: motion.pixels().iter().map(|[x, y, ..]| [*x, *y]).collect(),
            // Whole numbers below 2^24, which f32 holds exactly.
            ids: ids.pixels().iter().map(|[id, ..]| *id as u32).collect(),
            depth: depth.pixels().iter().map(|[depth, ..]| *depth).collect(),
        })
    }
}

/// One of the extras that were drawn beside a shot's colour, as numbers.
pub(super) fn read_drawn(
    studio: &Studio<'_>,
    shot: &Shot,
    pick: impl Fn(&Targets) -> Option<&wgpu::Texture>,
) -> Result<LinearPicture> {
    let texture = shot.drawn(pick).ok_or_else(|| Error::Request("nothing was drawn".into()))?;
    studio.gpu.read_linear(texture)
}
