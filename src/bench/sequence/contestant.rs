//! A method that runs through a sequence.

use std::time::Instant;

use super::Moment;
use crate::bench::score::exposed;
use crate::capture::{Capture, Shot, Studio, Watch};
use crate::error::{Error, Result};
use crate::methods::Spec;
use crate::metrics::temporal::{Ledger, Truth, Verdict};
use crate::pass::{Extras, Technique};
use crate::suite::{
    Ghost, ProbeFigures, SequenceFigure, SequenceFigures, SequenceNonFinite, SequenceOutcome, SequenceTiming, Spread, WorstFrame,
};

/// A combination of techniques, in a registry or not.
#[derive(Debug, Clone)]
pub struct Contestant<'a> {
    /// What results call it.
    pub label: String,
    /// Name and technique of each stage, in order; at least one.
    pub techniques: Vec<(&'a str, &'a dyn Technique)>,
}

impl<'a> Contestant<'a> {
    /// A method by its spec.
    #[must_use]
    pub fn of(spec: &'a Spec) -> Self {
        let techniques = spec.stages.iter().map(|stage| (stage.method.name, &*stage.technique)).collect();
        Self { label: spec.to_string(), techniques }
    }

    /// Samples shaded a pixel and frame.
    #[must_use]
    pub fn samples_per_pixel(&self) -> u32 {
        self.techniques.first().map_or(1, |(_, technique)| technique.needs().samples_per_pixel)
    }
}

/// A contestant on its way through a sequence.
pub(super) enum Runner {
    Running(Box<Running>),
    Failed(String),
}

pub(super) struct Running {
    shot: Shot,
    ledger: Ledger,
    samples_per_pixel: f64,
    target_bytes: u64,
    frame_ms: Vec<f64>,
}

impl Runner {
    /// Prepares a contestant. What the adapter lacks is its outcome, not an error.
    pub(super) fn new(studio: &Studio<'_>, contestant: &Contestant<'_>, size: [u32; 2]) -> Result<Self> {
        match studio.shot_of(&contestant.techniques, 0, size, Extras::default()) {
            Ok(shot) => {
                let ledger = Ledger::default();
                let running = Running { shot, ledger, samples_per_pixel: 0.0, target_bytes: 0, frame_ms: Vec::new() };
                Ok(Self::Running(Box::new(running)))
            }
            Err(Error::Unsupported(why)) => Ok(Self::Failed(why)),
            Err(error) => Err(error),
        }
    }

    /// Draws a frame; none of a contestant that failed.
    pub(super) fn take(&mut self, studio: &mut Studio<'_>, moment: &Moment, watch: &mut dyn Watch) -> Result<Option<Capture>> {
        let Self::Running(running) = self else { return Ok(None) };
        let start = Instant::now();
        running.shot.move_to(moment.tick, moment.reset);
        match studio.take(&mut running.shot, None, watch) {
            Ok(()) => {}
            Err(Error::Unsupported(why)) => {
                *self = Self::Failed(why);
                return Ok(None);
            }
            Err(error) => return Err(error),
        }
        running.frame_ms.push(start.elapsed().as_secs_f64() * 1e3);
        studio.read(&running.shot).map(Some)
    }

    /// Measures the frame that was drawn.
    pub(super) fn measure(&mut self, capture: Capture, truth: &Truth, exposure: f32) -> Result<()> {
        let Self::Running(running) = self else { return Ok(()) };
        let linear = capture.linear.map(|linear| exposed(&linear, exposure)).transpose()?;
        running.ledger.add(capture.display, linear.as_ref(), truth)?;
        (running.samples_per_pixel, running.target_bytes) = (capture.samples_per_pixel, capture.target_bytes);
        Ok(())
    }

    pub(super) fn outcome(self, moments: &[Moment], probes: ProbeFigures) -> SequenceOutcome {
        let running = match self {
            Self::Running(running) => running,
            Self::Failed(error) => return SequenceOutcome::Failed { error },
        };
        let Running { ledger, samples_per_pixel, target_bytes, frame_ms, .. } = *running;
        let index = |place: usize| moments.get(place).map_or(0, |moment| moment.tick.index);
        let figure = |verdict: Verdict| SequenceFigure {
            measure: verdict.measure.id.to_owned(),
            overall: verdict.overall,
            worst: verdict.worst.map(|worst| WorstFrame { index: index(worst.frame), value: worst.value }),
            frames: verdict.frames,
        };
        SequenceOutcome::Measured(Box::new(SequenceFigures {
            samples_per_pixel,
            target_bytes,
            figures: ledger.verdicts().into_iter().map(figure).collect(),
            ghost: Ghost { ages: ledger.ghost().by_age(), trail: ledger.ghost().trail() },
            non_finite: non_finite(&ledger, index),
            probes,
            timing: SequenceTiming { frame_ms: Spread::of(frame_ms) },
        }))
    }
}

fn non_finite(ledger: &Ledger, index: impl Fn(usize) -> i64) -> Option<SequenceNonFinite> {
    let broken = || ledger.rows().iter().map(|row| row.non_finite).enumerate().filter(|(_, pixels)| *pixels > 0);
    let (first, _) = broken().next()?;
    let pixels = broken().map(|(_, pixels)| pixels).sum();
    Some(SequenceNonFinite { pixels, frames: broken().count() as u64, first: index(first) })
}
