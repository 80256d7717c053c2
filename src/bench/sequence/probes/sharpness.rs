//! How sharp the picture is at several speeds.

use super::{Lab, Probe};
use crate::bench::Progress;
use crate::bench::sequence::{Course, Moment};
use crate::error::Result;
use crate::metrics::Figure;
use crate::metrics::temporal::sharpness;
use crate::suite::{ProbeFigures, SharpnessFigure};

/// In pixels a frame.
const PANS_PX: [f64; 5] = [0.0, 0.25, 0.5, 1.37, 8.0];

/// Frames at each, of which the last is looked at.
const FRAMES_A_PAN: i64 = 24;

/// Frames of all runs.
pub(super) const FRAMES: u64 = FRAMES_A_PAN as u64 * PANS_PX.len() as u64;

pub(super) fn run(lab: &mut Lab<'_, '_, impl Progress>, found: &mut [ProbeFigures]) -> Result<()> {
    let runs = PANS_PX.map(|pan| moments(lab, pan)).into_iter().collect::<Result<Vec<_>>>()?;
    // All end at the same picture, so that all are held against the same one.
    let reference = lab.reference(&runs[0][FRAMES_A_PAN as usize - 1].tick)?.display;
    for (contestant, found) in found.iter_mut().enumerate() {
        let mut figures = Vec::new();
        for (pan_px, moments) in PANS_PX.into_iter().zip(&runs) {
            let Some(mut subject) = lab.subject(Probe::Sharpness, contestant)? else { break };
            let Some(capture) = subject.last_of(lab.studio, moments, lab.progress)? else { break };
            let ratio = sharpness(&capture.display, &reference).map_or(Figure::NotApplicable, Figure::from);
            figures.push(SharpnessFigure { pan_px, ratio });
        }
        found.sharpness = (!figures.is_empty()).then_some(figures);
    }
    Ok(())
}

/// A pan at whose end the picture is where it is without one.
fn moments(lab: &Lab<'_, '_, impl Progress>, pan_px: f64) -> Result<Vec<Moment>> {
    let course = Course { pan_px: [pan_px, 0.0], ..Course::still(lab.held_frame(), FRAMES_A_PAN) };
    let mut moments = course.timeline(lab.studio.scene)?.moments().to_vec();
    let end_px = pan_px * (FRAMES_A_PAN - 1) as f64;
    for Moment { tick, .. } in &mut moments {
        tick.shift_px[0] -= end_px;
        tick.previous_shift_px[0] -= end_px;
    }
    Ok(moments)
}
