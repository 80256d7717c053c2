//! Speed against error: methods on scenes, timed a pass at a time and scored against a reference.

mod check;
mod clock;
mod edges;
mod score;
pub mod sequence;

pub use check::Darkroom;
pub use clock::{Clock, PassTime};
pub use edges::edge_errors;
pub use score::{DEMO_METHODS, DEMO_SCENES, Pictures, Progress, REPEATS, ReferenceChoice, Request, SceneOutcome, score_scene};
