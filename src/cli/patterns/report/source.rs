//! What is sampled, and known exactly.

use super::super::super::watch::Bar;
use crate::error::Result;
use crate::picture::DisplayPicture;
use crate::sampling::PatternSpec;

/// A picture that can be had exactly and by samples.
pub(super) trait Source {
    /// What it is called.
    fn name(&self) -> String;
    /// How it is sampled, in a line.
    fn about(&self) -> String;
    /// What errors are measured against.
    fn known_by(&self) -> String;
    /// Samples a pixel that the exact picture takes.
    fn work(&self) -> u64;
    /// As it is.
    fn exact(&mut self, bar: &mut Bar) -> Result<DisplayPicture>;
    /// As so many samples of a pattern show it. The exact one is asked for before.
    fn sampled(&mut self, spec: &PatternSpec, spp: u32, bar: &mut Bar) -> Result<Sampled>;
}

/// A picture of pixel means.
pub(super) struct Sampled {
    pub(super) picture: DisplayPicture,
    /// `fresh` or `fixed`.
    pub(super) sets: &'static str,
    /// Root mean square error of linear values.
    pub(super) rms: f64,
}

pub(super) fn boxed<'a>(source: impl Source + 'a) -> Box<dyn Source + 'a> {
    Box::new(source)
}
