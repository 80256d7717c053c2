//! Which frames a sequence has, when each is, and what came before it.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::error::{Error, Result};
use crate::scene::{Scene, Tick};

/// Frames of a scene that stands still, unless told otherwise.
pub const STILL_FRAMES: i64 = 64;

/// Most frames of one sequence.
const MOST_FRAMES: u64 = 1_000_000;

/// How a sequence goes.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// Which frames, the last left out. May begin before the scene's first and end after its last: time goes on.
    pub frames: Range<i64>,
    /// Frames at which everything before must be forgotten. The first one is a cut anyway.
    pub cuts: BTreeSet<i64>,
    /// Frames that are not drawn: the next one moves on from the last that was.
    pub dropped: BTreeSet<i64>,
    /// Seconds between frames, at least 0; the scene's own if none. Frame n is at n times that.
    pub step_s: Option<f64>,
    /// The scene stands still as it is at this one of its frames, while frames and shifts go on counting.
    pub hold: Option<i64>,
    /// How far the whole picture moves each frame, in pixels right and down.
    pub pan_px: [f64; 2],
}

/// The frames that are drawn, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Timeline {
    moments: Vec<Moment>,
}

/// One frame that is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// When it is and when the one before was.
    pub tick: Tick,
    /// Whether what came before must be forgotten: the first frame, a cut.
    pub reset: bool,
}

impl Course {
    /// All frames of a scene in its own time; one that has a single frame is watched standing still.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        let frames = if scene.frames > 1 { i64::from(scene.frames) } else { STILL_FRAMES };
        Self { frames: 0..frames, ..Self::default() }
    }

    /// So many frames of a scene that stands still as in this frame.
    #[must_use]
    pub fn still(frame: i64, frames: i64) -> Self {
        Self { frames: 0..frames, hold: Some(frame), ..Self::default() }
    }

    /// The frames that are drawn.
    ///
    /// # Errors
    /// [`Error::Request`] for no frames or too many, a step or a pan that is no number, or a cut or drop outside of the frames.
    pub fn timeline(&self, scene: &Scene) -> Result<Timeline> {
        self.check()?;
        let step_s = self.step_s.unwrap_or(scene.time_step);
        let scene_step_s = if self.hold.is_some() { 0.0 } else { step_s };
        let time_s = |index: i64| self.hold.map_or(index as f64 * step_s, |frame| frame as f64 * scene.time_step);
        let shift_px = |index: i64| self.pan_px.map(|pan| index as f64 * pan);
        let mut moments: Vec<Moment> = Vec::new();
        let mut cut = true;
        for index in self.frames.clone() {
            // A cut at a frame that is dropped is seen at the next.
            cut |= self.cuts.contains(&index);
            if self.dropped.contains(&index) {
                continue;
            }
            let before = moments.last().map_or(index, |moment| moment.tick.index);
            let tick = Tick {
                index,
                time_s: time_s(index),
                previous_time_s: time_s(before),
                step_s: scene_step_s,
                shift_px: shift_px(index),
                previous_shift_px: shift_px(before),
                shift_step_px: self.pan_px,
            };
            moments.push(Moment { tick: if cut { tick.opening() } else { tick }, reset: cut });
            cut = false;
        }
        if moments.is_empty() {
            return Err(Error::Request("every frame is dropped; leave at least one".into()));
        }
        Ok(Timeline { moments })
    }

    fn check(&self) -> Result<()> {
        let Range { start, end } = self.frames;
        let count = end.checked_sub(start).and_then(|count| u64::try_from(count).ok()).unwrap_or(0);
        if !(1..=MOST_FRAMES).contains(&count) {
            return Err(Error::Request(format!("frames {start}..{end} are {count}; choose 1 to {MOST_FRAMES}")));
        }
        if let Some(outside) = self.cuts.iter().chain(&self.dropped).find(|index| !self.frames.contains(index)) {
            return Err(Error::Request(format!(
                "frame {outside} cannot be cut or dropped: the sequence has frames {start} to {}",
                end - 1
            )));
        }
        if let Some(step) = self.step_s.filter(|step| !(0.0..=3600.0).contains(step)) {
            return Err(Error::Request(format!("a step of {step} seconds between frames is none; choose 0 to 3600")));
        }
        let [x, y] = self.pan_px;
        if !(x.abs() <= 1e4 && y.abs() <= 1e4) {
            return Err(Error::Request(format!("a pan of {x},{y} pixels a frame is too much; choose at most 10000")));
        }
        Ok(())
    }
}

impl Timeline {
    /// The frames, at least one.
    #[must_use]
    pub fn moments(&self) -> &[Moment] {
        &self.moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        Scene::load("pan").expect("shipped")
    }

    fn timeline(course: &Course) -> Vec<Moment> {
        course.timeline(&scene()).expect("sensible").moments
    }

    #[test]
    fn a_frame_follows_the_one_before_and_a_cut_none() {
        let moments = timeline(&Course { frames: -2..3, cuts: [1].into(), pan_px: [0.5, -1.0], ..Course::default() });
        assert_eq!(moments.iter().map(|m| m.tick.index).collect::<Vec<_>>(), [-2, -1, 0, 1, 2]);
        assert_eq!(moments.iter().map(|m| m.reset).collect::<Vec<_>>(), [true, false, false, true, false]);
        for moment in &moments {
            let Tick { index, time_s, previous_time_s, shift_px, previous_shift_px, .. } = moment.tick;
            let before = if moment.reset { index } else { index - 1 } as f64;
            assert_eq!((time_s, previous_time_s), (index as f64 / 60.0, before / 60.0));
            assert_eq!((shift_px, previous_shift_px), ([0.5 * index as f64, -index as f64], [0.5 * before, -before]));
        }
    }

    #[test]
    fn what_follows_a_dropped_frame_moves_from_the_last_that_was_drawn() {
        let moments = timeline(&Course { frames: 0..5, dropped: [0, 2, 3].into(), cuts: [3].into(), ..Course::default() });
        assert_eq!(moments.iter().map(|m| (m.tick.index, m.reset)).collect::<Vec<_>>(), [(1, true), (4, true)]);
        let moments = timeline(&Course { frames: 0..4, dropped: [1, 2].into(), ..Course::default() });
        assert_eq!((moments[1].tick.previous_time_s, moments[1].reset), (0.0, false));
    }

    #[test]
    fn time_stands_still_where_it_should() {
        for course in
            [Course { frames: 3..6, step_s: Some(0.0), ..Course::default() }, Course { frames: 3..6, ..Course::still(0, 1) }]
        {
            let moments = timeline(&course);
            assert!(moments.iter().all(|m| m.tick.time_s == 0.0 && m.tick.step_s == 0.0));
            assert_eq!(moments[2].tick.index, 5);
        }
        assert_eq!(timeline(&Course::still(12, 2))[1].tick.time_s, 0.2);
    }

    #[test]
    fn the_middle_after_a_cut_is_the_same_as_a_start_there() {
        let whole = timeline(&Course { frames: 0..9, cuts: [4].into(), pan_px: [0.37, 0.0], ..Course::default() });
        assert_eq!(whole[4..], timeline(&Course { frames: 4..9, pan_px: [0.37, 0.0], ..Course::default() }));
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        let base = Course { frames: 0..4, ..Course::default() };
        let refused = [
            Course { frames: 4..4, ..base.clone() },
            Course { frames: i64::MIN..i64::MAX, ..base.clone() },
            Course { cuts: [4].into(), ..base.clone() },
            Course { dropped: (0..4).collect(), ..base.clone() },
            Course { step_s: Some(f64::NAN), ..base.clone() },
            Course { step_s: Some(-1.0), ..base.clone() },
            Course { pan_px: [f64::INFINITY, 0.0], ..base },
        ];
        for course in refused {
            assert!(course.timeline(&scene()).is_err(), "{course:?}");
        }
    }
}
