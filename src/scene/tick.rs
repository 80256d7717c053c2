//! When a frame of a sequence is, and when the one before it was.

use super::Scene;

/// A frame of a sequence: its place in time, and what it shares with the frame before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tick {
    /// Counts frames; may be negative.
    pub index: i64,
    /// When the scene is seen, in seconds.
    pub time_s: f64,
    /// When it was seen before; the same where nothing came before.
    pub previous_time_s: f64,
    /// From one frame to the next, in seconds.
    pub step_s: f64,
    /// How far the whole picture is moved, in pixels right and down.
    pub shift_px: [f64; 2],
    /// How far it was in the frame before.
    pub previous_shift_px: [f64; 2],
    /// From one frame to the next, in pixels.
    pub shift_step_px: [f64; 2],
}

impl Tick {
    /// A frame in the scene's own time, after the one before it.
    #[must_use]
    pub fn of(scene: &Scene, index: i64) -> Self {
        let time = |index: i64| index as f64 * scene.time_step;
        Self {
            index,
            time_s: time(index),
            previous_time_s: time(index - 1),
            step_s: scene.time_step,
            shift_px: [0.0; 2],
            previous_shift_px: [0.0; 2],
            shift_step_px: [0.0; 2],
        }
    }

    /// One of the scene's own frames: nothing comes before the first.
    #[must_use]
    pub fn of_frame(scene: &Scene, frame: u32) -> Self {
        let tick = Self::of(scene, frame.into());
        if frame == 0 { tick.opening() } else { tick }
    }

    /// The same frame with nothing before it.
    #[must_use]
    pub fn opening(self) -> Self {
        Self { previous_time_s: self.time_s, previous_shift_px: self.shift_px, ..self }
    }

    /// The same frame seen `share` of an interval later.
    #[must_use]
    pub fn later(&self, share: f64) -> Self {
        let shift_px = [0, 1].map(|k| self.shift_px[k] + share * self.shift_step_px[k]);
        Self { time_s: self.time_s + share * self.step_s, shift_px, ..*self }
    }
}
