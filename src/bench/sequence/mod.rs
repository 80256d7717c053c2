//! Methods on a sequence: drawn frame by frame, each held against the supersampled frame and against what came before.
//!
//! Frames stream: of pictures, motion and references no more are kept than figures look back at.

mod contestant;
mod course;
mod probes;
mod reference;
mod thresholds;

pub use contestant::Contestant;
pub use course::{Course, Moment, STILL_FRAMES, Timeline};
pub use probes::Probe;
pub use thresholds::misses;

use std::collections::BTreeSet;

use super::Progress;
use crate::capture::{Cache, Capture, Studio};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::metrics::temporal::{GAPS, Truth};
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::Scene;
use crate::suite::{SequenceFrame, SequenceMethod, SequenceResult};
use contestant::Runner;
use reference::ReferenceRun;

/// What each frame is held against unless told otherwise.
pub const SEQUENCE_REFERENCE: &str = "ssaa:spp=256,pattern=larcher";

/// What to measure.
#[derive(Debug)]
pub struct SequenceRequest {
    /// Which frames.
    pub course: Course,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What each frame is held against. One with an open shutter integrates over time as well.
    pub reference: Spec,
    /// Which runs of their own are made beside the sequence.
    pub probes: BTreeSet<Probe>,
}

/// Is handed the pictures of each frame as they are made.
pub trait FrameSink {
    /// A frame of a method.
    ///
    /// # Errors
    /// What ends the run.
    fn method(&mut self, frame: &FramePicture<'_>) -> Result<()>;

    /// A frame of the reference; comes before those of the methods.
    ///
    /// # Errors
    /// What ends the run.
    fn reference(&mut self, frame: &FramePicture<'_>) -> Result<()>;
}

/// One picture of a sequence.
#[derive(Debug)]
pub struct FramePicture<'a> {
    /// Place of the method in the list; 0 for the reference.
    pub method: usize,
    /// Place in the sequence, from 0.
    pub place: usize,
    /// Which frame.
    pub moment: &'a Moment,
    /// As displayed, not rounded.
    pub display: &'a DisplayPicture,
    /// Linear light, not exposed; none where the method only makes display values.
    pub linear: Option<&'a LinearPicture>,
}

/// Looks at nothing.
impl FrameSink for () {
    fn method(&mut self, _: &FramePicture<'_>) -> Result<()> {
        Ok(())
    }

    fn reference(&mut self, _: &FramePicture<'_>) -> Result<()> {
        Ok(())
    }
}

impl SequenceRequest {
    /// Work in samples a pixel, for a progress bar.
    ///
    /// # Errors
    /// As [`Course::timeline`].
    pub fn work(&self, scene: &Scene, contestants: &[Contestant<'_>]) -> Result<u64> {
        let frames = self.course.timeline(scene)?.moments().len() as u64;
        let methods: u64 = contestants.iter().map(|c| u64::from(c.samples_per_pixel())).sum();
        let reference = u64::from(self.reference.first_needs().samples_per_pixel);
        Ok(frames * reference + (frames + probes::frames(&self.probes)) * methods)
    }
}

/// Draws the sequence with each contestant and measures it.
///
/// One that the adapter cannot run is a [`crate::suite::SequenceOutcome::Failed`]; everything else that fails ends the run.
///
/// # Errors
/// [`crate::Error::Gpu`], [`crate::Error::Interrupted`], [`crate::Error::Request`] for frames or a size that make no sense, and
/// what `sink` answers.
pub fn run_sequence(
    gpu: &Gpu,
    scene: &Scene,
    request: &SequenceRequest,
    contestants: &[Contestant<'_>],
    cache: &Cache,
    progress: &mut impl Progress,
    sink: &mut dyn FrameSink,
) -> Result<SequenceResult> {
    let timeline = request.course.timeline(scene)?;
    let mut studio = Studio::new(gpu, scene)?;
    let mut reference = ReferenceRun::new(&studio, request, cache)?;
    let mut runners = contestants.iter().map(|c| Runner::new(&studio, c, request.size)).collect::<Result<Vec<_>>>()?;
    let mut frames = Vec::new();
    for (place, moment) in timeline.moments().iter().enumerate() {
        let at = format!("{} {}/{}", scene.name, place + 1, timeline.moments().len());
        progress.say(format!("{at}: reference"));
        let (truth, linear) = reference.next(&mut studio, moment, progress)?;
        progress.advance(u64::from(request.reference.first_needs().samples_per_pixel));
        sink.reference(&FramePicture { method: 0, place, moment, display: &truth.display, linear: Some(&linear) })?;
        frames.push(facts(moment, &truth));
        for (method, (runner, contestant)) in runners.iter_mut().zip(contestants).enumerate() {
            progress.say(format!("{at}: {}", contestant.label));
            if let Some(capture) = runner.take(&mut studio, moment, progress)? {
                let Capture { display, linear, .. } = &capture;
                sink.method(&FramePicture { method, place, moment, display, linear: linear.as_ref() })?;
                runner.measure(capture, &truth, scene.exposure)?;
            }
            progress.advance(u64::from(contestant.samples_per_pixel()));
        }
    }
    let probes = probes::run(&mut studio, request, contestants, cache, progress)?;
    let methods = contestants.iter().zip(runners).zip(probes).map(|((contestant, runner), probes)| SequenceMethod {
        spec: contestant.label.clone(),
        outcome: runner.outcome(timeline.moments(), probes),
    });
    Ok(SequenceResult {
        scene: scene.name.clone(),
        about: scene.about.clone(),
        size: request.size,
        reference: reference.result(),
        methods: methods.collect(),
        frames,
    })
}

fn facts(moment: &Moment, truth: &Truth) -> SequenceFrame {
    SequenceFrame {
        index: moment.tick.index,
        time_s: moment.tick.time_s,
        shift_px: moment.tick.shift_px,
        reset: moment.reset,
        followed: (1..=GAPS).map(|gap| truth.tracks.followed(gap)).collect(),
        uncovered: truth.tracks.uncovered().len() as u64,
        ridges: truth.ridges.count() as u64,
    }
}
