//! A sequence as it should be, frame by frame: what all methods are held against, computed once.

use std::collections::VecDeque;
use std::sync::Arc;

use super::{AGES, Change, Flow, GAPS, Ridges, Tracks, change, similarity};
use crate::picture::{DisplayPicture, LinearPicture};

/// The right pictures so far: no more of them than are looked back at.
#[derive(Debug, Default)]
pub struct Yardstick {
    /// The latest first.
    flows: VecDeque<Flow>,
    /// The latest first.
    displays: VecDeque<Arc<DisplayPicture>>,
}

/// One frame as it should be.
#[derive(Debug)]
pub struct Truth {
    /// As displayed.
    pub display: Arc<DisplayPicture>,
    /// Exposed linear values.
    pub linear: LinearPicture,
    /// Where its surfaces were before.
    pub tracks: Tracks,
    /// Its thin lines.
    pub ridges: Ridges,
    /// How much its surfaces change, at each gap.
    pub(super) changes: [Option<Change>; GAPS],
    /// How similar it is to the frame before.
    pub(super) similarity: Option<f64>,
    /// What it looked like before, the latest first; empty after a cut.
    pub(super) earlier: Vec<Arc<DisplayPicture>>,
}

impl Yardstick {
    /// The next frame. `flow` is the motion from the frame before; none forgets all that came before: a first frame, a cut.
    pub fn next(&mut self, display: DisplayPicture, linear: LinearPicture, flow: Option<Flow>) -> Truth {
        match flow {
            Some(flow) => self.flows.push_front(flow),
            None => (self.flows, self.displays) = Default::default(),
        }
        self.flows.truncate(AGES);
        let flows: Vec<&Flow> = self.flows.iter().take(self.displays.len()).collect();
        let tracks = Tracks::follow(display.size(), &flows);
        let earlier: Vec<_> = self.displays.iter().cloned().collect();
        let changes = std::array::from_fn(|k| change(&display, earlier.get(k)?, &tracks, k + 1));
        let similarity = earlier.first().and_then(|before| similarity(&display, before, &tracks));
        let ridges = Ridges::of(&display);
        let display = Arc::new(display);
        self.displays.push_front(display.clone());
        self.displays.truncate(AGES);
        Truth { display, linear, tracks, ridges, changes, similarity, earlier }
    }
}

impl Truth {
    /// Whether nothing came before it.
    #[must_use]
    pub fn is_first(&self) -> bool {
        self.earlier.is_empty()
    }
}
