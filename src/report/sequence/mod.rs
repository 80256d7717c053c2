//! A sequence's report: a folder with one page that opens from disk, with curves over time and a film strip.

mod curves;
mod page;

use std::path::Path;

use super::folder::{REPORT, Staging};
use super::json;
use crate::picture::{BitDepth, DisplayPicture, write_bytes_atomically};
use crate::suite::SequenceResults;
use crate::{Error, Result};

/// Frames in a film strip, at most: as many as can be seen beside each other.
const MOST_FRAMES: usize = 8;

/// Places in a sequence of so many frames that a film strip shows: the first, the last, and some evenly between.
#[must_use]
pub fn strip_places(frames: usize) -> Vec<usize> {
    let shown = frames.min(MOST_FRAMES);
    (0..shown).map(|k| if shown == 1 { 0 } else { k * (frames - 1) / (shown - 1) }).collect()
}

/// A report that is written while the sequence goes on, so that its pictures need not be kept. Dropped unfinished, it leaves
/// nothing.
#[derive(Debug)]
pub struct SequenceReport {
    staging: Staging,
    strip: Vec<StripPicture>,
}

/// Which picture of a film strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// What everything is held against.
    Reference,
    /// A method's, by its place in the results.
    Capture(usize),
    /// And where it is wrong.
    ErrorMap(usize),
}

#[derive(Debug)]
struct StripPicture {
    place: usize,
    shown: Shown,
    /// Relative to the page.
    file: String,
}

impl SequenceReport {
    /// Begins a report that is to become the folder `dir`. Nothing is seen there until [`Self::finish`].
    ///
    /// # Errors
    /// [`Error::Request`] if `dir` holds anything but a report; [`Error::Io`] if it cannot be written.
    pub fn begin(dir: &Path) -> Result<Self> {
        let staging = Staging::begin(REPORT, dir)?;
        let pictures = staging.path().join("pictures");
        std::fs::create_dir(&pictures).map_err(Error::io("create the folder", &pictures))?;
        Ok(Self { staging, strip: Vec::new() })
    }

    /// Adds a picture to the film strip: of the frame at this place of the sequence, from 0.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be written.
    pub fn add(&mut self, place: usize, shown: Shown, picture: &DisplayPicture) -> Result<()> {
        let file = match shown {
            Shown::Reference => format!("pictures/{place:05}-reference.png"),
            Shown::Capture(method) => format!("pictures/{place:05}-{method:02}.png"),
            Shown::ErrorMap(method) => format!("pictures/{place:05}-{method:02}-error.png"),
        };
        picture.save_png(&self.staging.path().join(&file), BitDepth::Eight, &[])?;
        self.strip.push(StripPicture { place, shown, file });
        Ok(())
    }

    /// Writes the page and puts the folder in its place.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be written.
    pub fn finish(self, results: &SequenceResults) -> Result<()> {
        let page = page::page(results, &self.strip);
        write_bytes_atomically(&self.staging.path().join("index.html"), page.as_bytes())?;
        write_bytes_atomically(&self.staging.path().join("results.json"), json(results).as_bytes())?;
        self.staging.publish()
    }
}

#[cfg(test)]
mod tests;
