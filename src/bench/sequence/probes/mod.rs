//! Short runs of their own: what a sequence of one's choice does not tell of a method.

mod position;
mod response;
mod sharpness;
mod still;

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use super::{Contestant, Moment, SequenceRequest};
use crate::bench::Progress;
use crate::capture::{Cache, Capture, Reference, Shot, Studio};
use crate::error::{Error, Result, unknown};
use crate::metrics::Figure;
use crate::pass::Extras;
use crate::scene::Tick;
use crate::suite::ProbeFigures;

/// A run of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Probe {
    /// Whether a still picture stands still, after warming up.
    Crawl,
    /// How a still picture gets better from frame to frame.
    Convergence,
    /// How long it takes until half the light is seen as half the light.
    Response,
    /// How sharp the picture is at several speeds.
    Sharpness,
    /// Where straight edges are.
    Position,
}

impl Probe {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Crawl, Self::Convergence, Self::Response, Self::Sharpness, Self::Position];

    /// As a user names it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Crawl => "crawl",
            Self::Convergence => "convergence",
            Self::Response => "response",
            Self::Sharpness => "sharpness",
            Self::Position => "position",
        }
    }
}

impl fmt::Display for Probe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Probe {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        let names = Self::ALL.map(Self::name);
        Self::ALL.into_iter().find(|probe| probe.name() == name).ok_or_else(|| unknown("probe", name, &names))
    }
}

/// Frames that a contestant draws in these probes, those of the small edges left out: each is a picture of full size.
pub(super) fn frames(probes: &BTreeSet<Probe>) -> u64 {
    let has = |probe| probes.contains(&probe);
    let still = if has(Probe::Crawl) || has(Probe::Convergence) { still::FRAMES } else { 0 };
    let response = if has(Probe::Response) { response::FRAMES } else { 0 };
    let sharpness = if has(Probe::Sharpness) { sharpness::FRAMES } else { 0 };
    still + response + sharpness
}

/// Runs the probes for every contestant; what the adapter cannot run has none.
pub(super) fn run(
    studio: &mut Studio<'_>,
    request: &SequenceRequest,
    contestants: &[Contestant<'_>],
    cache: &Cache,
    progress: &mut impl Progress,
) -> Result<Vec<ProbeFigures>> {
    let wanted = |probe| request.probes.contains(&probe);
    let mut found = vec![ProbeFigures::default(); contestants.len()];
    let mut lab = Lab { studio, request, contestants, cache, progress };
    if wanted(Probe::Crawl) || wanted(Probe::Convergence) {
        still::run(&mut lab, &mut found)?;
    }
    if wanted(Probe::Response) {
        response::run(&mut lab, &mut found)?;
    }
    if wanted(Probe::Sharpness) {
        sharpness::run(&mut lab, &mut found)?;
    }
    if wanted(Probe::Position) {
        position::run(&mut lab, &mut found)?;
    }
    Ok(found)
}

/// What every probe works with.
struct Lab<'l, 's, P> {
    studio: &'l mut Studio<'s>,
    request: &'l SequenceRequest,
    contestants: &'l [Contestant<'l>],
    cache: &'l Cache,
    progress: &'l mut P,
}

impl<P: Progress> Lab<'_, '_, P> {
    /// The frame at which the scene is held still.
    fn held_frame(&self) -> i64 {
        self.request.course.hold.unwrap_or(self.request.course.frames.start)
    }

    /// The reference of a tick, of the sequence's scene.
    fn reference(&mut self, tick: &Tick) -> Result<Reference> {
        self.progress.say("probes: reference".into());
        self.studio.reference(&self.request.reference, tick, self.request.size, self.cache, self.progress)
    }

    /// A contestant on its way; none where the adapter cannot run it, which its sequence says already.
    fn subject(&mut self, probe: Probe, contestant: usize) -> Result<Option<Subject>> {
        let contestant = &self.contestants[contestant];
        self.progress.say(format!("{probe}: {}", contestant.label));
        Subject::new(self.studio, contestant, self.request.size)
    }
}

/// A contestant's shot.
struct Subject {
    shot: Shot,
    /// A pixel and frame.
    samples: u64,
}

impl Subject {
    /// None where the adapter cannot run the contestant.
    fn new(studio: &Studio<'_>, contestant: &Contestant<'_>, size: [u32; 2]) -> Result<Option<Self>> {
        let shot = runnable(studio.shot_of(&contestant.techniques, 0, size, Extras::default()))?;
        Ok(shot.map(|shot| Self { shot, samples: contestant.samples_per_pixel().into() }))
    }

    /// Draws a moment without reading it; false where the adapter cannot.
    fn take(&mut self, studio: &mut Studio<'_>, moment: &Moment, progress: &mut impl Progress) -> Result<bool> {
        self.shot.move_to(moment.tick, moment.reset);
        let taken = runnable(studio.take(&mut self.shot, None, progress))?.is_some();
        progress.advance(self.samples);
        Ok(taken)
    }

    /// Draws a moment and reads it.
    fn capture(&mut self, studio: &mut Studio<'_>, moment: &Moment, progress: &mut impl Progress) -> Result<Option<Capture>> {
        if self.take(studio, moment, progress)? { studio.read(&self.shot).map(Some) } else { Ok(None) }
    }

    /// Draws all these moments and reads the last.
    fn last_of(&mut self, studio: &mut Studio<'_>, moments: &[Moment], progress: &mut impl Progress) -> Result<Option<Capture>> {
        let Some((last, before)) = moments.split_last() else { return Ok(None) };
        for moment in before {
            if !self.take(studio, moment, progress)? {
                return Ok(None);
            }
        }
        self.capture(studio, last, progress)
    }
}

/// What the adapter lacks is no error here.
fn runnable<T>(result: Result<T>) -> Result<Option<T>> {
    match result {
        Ok(value) => Ok(Some(value)),
        Err(Error::Unsupported(_)) => Ok(None),
        Err(error) => Err(error),
    }
}

/// The first frame, from 1, at which a figure is reached.
fn first_frame(figures: impl IntoIterator<Item = Figure>, reached: impl Fn(f64) -> bool) -> Figure {
    let first = figures.into_iter().position(|figure| figure.number().is_some_and(&reached));
    first.map_or(Figure::Infinite, |place| Figure::Number((place + 1) as f64))
}
