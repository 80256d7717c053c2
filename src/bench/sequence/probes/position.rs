//! Where straight edges are, to fractions of a pixel, at angles all around.

use std::path::Path;

use super::{Lab, Probe, Subject};
use crate::bench::Progress;
use crate::bench::sequence::{Contestant, Course};
use crate::capture::{Capture, Studio, analytic};
use crate::error::Result;
use crate::metrics::Figure;
use crate::metrics::temporal::edge_displacements;
use crate::picture::LinearPicture;
use crate::scene::Scene;
use crate::suite::{EdgeAngle, PositionFigures, ProbeFigures};

/// Side of the picture in pixels.
const SIDE: u32 = 48;

/// From an angle to the next, in degrees.
const STEP_DEG: f64 = 7.5;

/// From an upright edge to a level one.
const ANGLES: i64 = 13;

/// Frames at each angle, of which the last is looked at.
const FRAMES: i64 = 24;

/// Linear values of the two sides.
const SIDES: [f64; 2] = [0.2, 0.8];

/// A bright half-plane that turns by an angle's step from frame to frame, around a point in no pixel's middle. Each frame is held.
fn scene() -> Result<Scene> {
    let [dark, bright] = SIDES;
    let text = format!(
        "name = 'edge'
        frames = {ANGLES}
        time_step = 1
        background = [{dark}, {dark}, {dark}]
        [camera]
        projection = 'pixels'
        position = [0, 0, 10]
        target = [0, 0, 0]
        [[objects]]
        position = [0.3, -0.4, 0]
        shape = {{ polygon = {{ points = [[0, -200], [200, -200], [200, 200], [0, 200]] }} }}
        material = {{ color = [{bright}, {bright}, {bright}], unlit = true, double_sided = true }}
        motion = {{ spin_axis = [0, 0, -1], spin_deg_per_s = {STEP_DEG} }}"
    );
    Scene::parse(&text, "edge.toml", Path::new(""))
}

pub(super) fn run(lab: &mut Lab<'_, '_, impl Progress>, found: &mut [ProbeFigures]) -> Result<()> {
    let scene = scene()?;
    let mut studio = Studio::new(lab.studio.gpu, &scene)?;
    let exact = (0..ANGLES).map(|frame| analytic::exact(&scene, frame as u32, [SIDE; 2])).collect::<Result<Vec<_>>>()?;
    for (contestant, found) in lab.contestants.iter().zip(found) {
        lab.progress.say(format!("{}: {}", Probe::Position, contestant.label));
        found.position = position(lab, &mut studio, contestant, &exact)?;
    }
    Ok(())
}

/// None where the adapter cannot run it.
fn position(
    lab: &mut Lab<'_, '_, impl Progress>,
    studio: &mut Studio<'_>,
    contestant: &Contestant<'_>,
    exact: &[LinearPicture],
) -> Result<Option<PositionFigures>> {
    let (mut all, mut angles) = (Vec::new(), Vec::new());
    for (frame, exact) in (0..).zip(exact) {
        let Some(mut subject) = Subject::new(studio, contestant, [SIDE; 2])? else { return Ok(None) };
        // These pictures are too small to count as progress.
        subject.samples = 0;
        let timeline = Course::still(frame, FRAMES).timeline(studio.scene)?;
        let Some(capture) = subject.last_of(studio, timeline.moments(), lab.progress)? else { return Ok(None) };
        let degrees = frame as f64 * STEP_DEG;
        let off = edge_displacements(&linear(capture), exact, degrees.to_radians(), SIDES);
        let (rms_px, max_px) = (rms(&off), max(&off));
        angles.push(EdgeAngle { degrees, rms_px, max_px });
        all.extend(off);
    }
    Ok(Some(PositionFigures { rms_px: rms(&all), max_px: max(&all), angles }))
}

/// The scene is not exposed, nor tone-mapped: display values decode to its linear ones.
fn linear(capture: Capture) -> LinearPicture {
    capture.linear.unwrap_or_else(|| capture.display.to_linear())
}

fn rms(off: &[f64]) -> Figure {
    if off.is_empty() {
        return Figure::NotApplicable;
    }
    Figure::from((off.iter().map(|d| d * d).sum::<f64>() / off.len() as f64).sqrt())
}

fn max(off: &[f64]) -> Figure {
    let larger = |a: f64, b: &f64| if b.abs() > a || b.is_nan() { b.abs() } else { a };
    if off.is_empty() { Figure::NotApplicable } else { Figure::from(off.iter().fold(0.0, larger)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_turns_as_its_angle_says() {
        let scene = scene().expect("well-formed");
        for frame in [0, 3, 6, 9, 12] {
            let exact = analytic::exact(&scene, frame, [SIDE; 2]).expect("exact");
            let angle = (f64::from(frame) * STEP_DEG).to_radians();
            // The bright side lies where the normal points: right at first, then down.
            let probe = |sign: f64| {
                let at = [angle.cos(), angle.sin()].map(|n| (24.0 + sign * 12.0 * n) as u32);
                f64::from(exact.pixel(at[0], at[1])[0])
            };
            assert!((probe(1.0) - SIDES[1]).abs() < 1e-6 && (probe(-1.0) - SIDES[0]).abs() < 1e-6, "{frame}");
            assert!(edge_displacements(&exact, &exact, angle, SIDES).len() >= 20, "{frame}");
        }
    }
}
