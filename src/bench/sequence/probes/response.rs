//! How long it takes until half the light is seen as half the light.

use super::{Lab, Probe, first_frame};
use crate::bench::Progress;
use crate::bench::sequence::Course;
use crate::capture::Studio;
use crate::error::Result;
use crate::metrics::Figure;
use crate::metrics::temporal::response;
use crate::suite::{ProbeFigures, ResponseFigures};

/// Frames before the change.
const BEFORE: usize = 32;

/// Frames after it.
const AFTER: usize = 48;

/// Frames of the run.
pub(super) const FRAMES: u64 = (BEFORE + AFTER) as u64;

/// The share of a change, of what there is of it in the end, at which it counts as done.
const DONE: f64 = 0.9;

/// Least share in the end: an aliased picture is no multiple of its reference, but one that shows less did not follow.
const FOLLOWED: f64 = 0.8;

pub(super) fn run(lab: &mut Lab<'_, '_, impl Progress>, found: &mut [ProbeFigures]) -> Result<()> {
    let timeline = Course::still(lab.held_frame(), FRAMES as i64).timeline(lab.studio.scene)?;
    let (bright, dim) = timeline.moments().split_at(BEFORE);
    let dimmed = lab.studio.scene.dimmed(0.5);
    let mut after = Studio::new(lab.studio.gpu, &dimmed)?;
    let reference = lab.reference(&bright[0].tick)?.display;
    let reference_after =
        after.reference(&lab.request.reference, &bright[0].tick, lab.request.size, lab.cache, lab.progress)?.display;
    for (contestant, found) in found.iter_mut().enumerate() {
        let Some(mut subject) = lab.subject(Probe::Response, contestant)? else { continue };
        let Some(before) = subject.last_of(lab.studio, bright, lab.progress)? else { continue };
        let mut shares = Vec::new();
        for moment in dim {
            // The same shot: its history is that of the scene before.
            let Some(capture) = subject.capture(&mut after, moment, lab.progress)? else { break };
            let share = response(&capture.display, &before.display, [&reference, &reference_after]);
            shares.push(share.map_or(Figure::NotApplicable, Figure::from));
        }
        found.response = Some(ResponseFigures { frames: frames_until_done(&shares), shares });
    }
    Ok(())
}

fn frames_until_done(shares: &[Figure]) -> Figure {
    match shares.last().copied().unwrap_or(Figure::NotApplicable) {
        Figure::Number(end) if end >= FOLLOWED => first_frame(shares.iter().copied(), |share| share >= DONE * end),
        Figure::Number(_) => Figure::Infinite,
        none => none,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn done_is_nine_tenths_of_what_there_is_in_the_end() {
        let frames = |shares: &[f64]| frames_until_done(&shares.iter().map(|s| Figure::Number(*s)).collect::<Vec<_>>());
        assert_eq!(frames(&[1.0, 1.0]), Figure::Number(1.0));
        assert_eq!(frames(&[0.5, 0.86, 0.95]), Figure::Number(2.0));
        assert_eq!(frames(&[0.1, 0.2, 0.3]), Figure::Infinite, "it does not get there");
        assert_eq!(frames(&[]), Figure::NotApplicable);
        assert_eq!(frames_until_done(&[Figure::NotApplicable]), Figure::NotApplicable);
    }
}
