//! A still picture from its first frame on: how it gets better, and whether it then stands still.

use super::{Lab, Probe, first_frame};
use crate::bench::Progress;
use crate::bench::sequence::Course;
use crate::error::Result;
use crate::metrics::Figure;
use crate::metrics::temporal::{Steadiness, mean_square};
use crate::picture::DisplayPicture;
use crate::suite::{ConvergenceFigures, CrawlFigures, ProbeFigures};

/// Frames before a picture is expected to stand still.
const WARM_UP: usize = 32;

/// Frames that it is watched for then: two cycles of a sequence of sixteen jitters.
const WATCHED: usize = 32;

/// The last frames, whose mean squared error is what a picture settles at.
const SETTLED: usize = 16;

/// Frames of the run.
pub(super) const FRAMES: u64 = (WARM_UP + WATCHED) as u64;

pub(super) fn run(lab: &mut Lab<'_, '_, impl Progress>, found: &mut [ProbeFigures]) -> Result<()> {
    let timeline = Course::still(lab.held_frame(), FRAMES as i64).timeline(lab.studio.scene)?;
    let [crawl, convergence] = [Probe::Crawl, Probe::Convergence].map(|probe| lab.request.probes.contains(&probe));
    let reference = if convergence { Some(lab.reference(&timeline.moments()[0].tick)?.display) } else { None };
    for (contestant, found) in found.iter_mut().enumerate() {
        let probe = if convergence { Probe::Convergence } else { Probe::Crawl };
        let Some(mut subject) = lab.subject(probe, contestant)? else { continue };
        let mut watch = StillWatch { reference: reference.as_ref(), squares: Vec::new(), steadiness: Steadiness::default() };
        for (place, moment) in timeline.moments().iter().enumerate() {
            let Some(capture) = subject.capture(lab.studio, moment, lab.progress)? else { break };
            watch.add(place, &capture.display);
        }
        found.convergence = convergence.then(|| watch.convergence());
        found.crawl = crawl.then(|| watch.crawl());
    }
    Ok(())
}

/// What is kept of a still run.
struct StillWatch<'r> {
    reference: Option<&'r DisplayPicture>,
    /// Mean squared error of each frame.
    squares: Vec<f64>,
    steadiness: Steadiness,
}

impl StillWatch<'_> {
    fn add(&mut self, place: usize, display: &DisplayPicture) {
        self.squares.extend(self.reference.map(|reference| mean_square(display, reference)));
        if place >= WARM_UP {
            self.steadiness.add(display);
        }
    }

    fn crawl(&self) -> CrawlFigures {
        let crawl = self.steadiness.crawl();
        let figure = |value: Option<f64>| value.map_or(Figure::NotApplicable, Figure::from);
        CrawlFigures { mean: figure(crawl.map(|c| c.mean)), p9999: figure(crawl.map(|c| c.p9999)) }
    }

    fn convergence(&self) -> ConvergenceFigures {
        convergence(&self.squares)
    }
}

/// Of mean squared errors, one a frame.
fn convergence(squares: &[f64]) -> ConvergenceFigures {
    let decibels = |square: f64| Figure::from(-10.0 * square.log10());
    let psnr: Vec<Figure> = squares.iter().map(|square| decibels(*square)).collect();
    let last = &squares[squares.len().saturating_sub(SETTLED)..];
    let settled = if last.is_empty() { Figure::NotApplicable } else { decibels(last.iter().sum::<f64>() / last.len() as f64) };
    let frames = match settled.number() {
        Some(bar) => first_frame(psnr.iter().copied(), |psnr| psnr >= bar - 0.5),
        None => Figure::NotApplicable,
    };
    ConvergenceFigures { psnr, settled, frames }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_that_halve_are_settled_when_they_no_longer_do() {
        // 3 dB a frame for ten frames, then none.
        let squares: Vec<f64> = (0..64).map(|n| 0.5f64.powi(n.min(10))).collect();
        let found = convergence(&squares);
        assert!((found.settled.number().expect("finite") - 30.103).abs() < 1e-3);
        assert_eq!(found.frames, Figure::Number(11.0));
        assert_eq!(found.psnr[0], Figure::Number(0.0));
    }

    #[test]
    fn a_perfect_picture_is_settled_at_once_and_no_frame_is_no_figure() {
        let found = convergence(&[0.0; 20]);
        assert_eq!((found.settled, found.frames), (Figure::Infinite, Figure::Number(1.0)));
        assert_eq!(convergence(&[]).settled, Figure::NotApplicable);
    }
}
