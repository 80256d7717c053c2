//! A sequence's report: a folder with one page that opens from disk, with curves over time and a film strip.

mod curves;
mod page;

use std::path::Path;

use super::folder::{REPORT, Staging};
use super::json;
use crate::picture::{BitDepth, DisplayPicture, load, write_bytes_atomically};
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

impl Shown {
    /// Relative to the page.
    fn file(self, place: usize) -> String {
        match self {
            Self::Reference => format!("pictures/{place:05}-reference.png"),
            Self::Capture(method) => format!("pictures/{place:05}-{method:02}.png"),
            Self::ErrorMap(method) => format!("pictures/{place:05}-{method:02}-error.png"),
        }
    }
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
        let file = shown.file(place);
        picture.save_png(&self.staging.path().join(&file), BitDepth::Eight, &[])?;
        self.strip.push(StripPicture { place, shown, file });
        Ok(())
    }

    /// Adds the pictures that another report, in `folder`, has of some of the methods: of each its place there and its place here.
    /// Those that could not run have none.
    ///
    /// # Errors
    /// [`Error::Io`] and [`Error::Format`] if its pictures are not there, or cannot be written.
    pub fn take_over(&mut self, frames: usize, folder: &Path, methods: &[(usize, usize)]) -> Result<()> {
        for place in strip_places(frames) {
            let read = |shown: Shown| Ok::<_, Error>(load(&folder.join(shown.file(place)))?.into_display());
            if !self.strip.iter().any(|picture| (picture.place, picture.shown) == (place, Shown::Reference)) {
                self.add(place, Shown::Reference, &read(Shown::Reference)?)?;
            }
            for &(there, here) in methods {
                if folder.join(Shown::Capture(there).file(place)).is_file() {
                    self.add(place, Shown::Capture(here), &read(Shown::Capture(there))?)?;
                    self.add(place, Shown::ErrorMap(here), &read(Shown::ErrorMap(there))?)?;
                }
            }
        }
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
