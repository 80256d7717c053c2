//! The report of `dejag patterns`: a folder with one page that opens from disk, of pictures beside exact ones.

mod page;

use std::path::Path;

use crate::Result;
use crate::error::Error;
use crate::picture::{BitDepth, DisplayPicture, write_bytes_atomically};
use crate::report::folder::{REPORT, Staging};
use crate::report::json;
use crate::suite::SeriesResults;

/// Side of the square part of each picture that is shown magnified, in pixels; less where the picture is smaller.
pub const DETAIL_PX: u32 = 64;

/// A report that is written while pictures are made, so that they need not be kept. Dropped unfinished, it leaves nothing.
#[derive(Debug)]
pub struct SeriesReport {
    staging: Staging,
}

/// Which picture of a chapter, all by their places in the results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesPicture {
    /// A subject as it is known.
    Exact {
        /// Of the chapter's subjects.
        subject: usize,
    },
    /// As samples show it.
    Sampled {
        /// Of the chapter's series.
        series: usize,
        /// Of the series' pictures.
        picture: usize,
    },
}

impl SeriesPicture {
    /// Relative to the page.
    fn file(self, chapter: usize) -> String {
        match self {
            Self::Exact { subject } => format!("pictures/{chapter}-exact-{subject}.png"),
            Self::Sampled { series, picture } => format!("pictures/{chapter}-{series:02}-{picture}.png"),
        }
    }
}

impl SeriesReport {
    /// Begins a report that is to become the folder `dir`. Nothing is seen there until [`Self::finish`].
    ///
    /// # Errors
    /// [`Error::Request`] if `dir` holds anything but a report; [`Error::Io`] if it cannot be written.
    pub fn begin(dir: &Path) -> Result<Self> {
        let staging = Staging::begin(REPORT, dir)?;
        let pictures = staging.path().join("pictures");
        std::fs::create_dir(&pictures).map_err(Error::io("create the folder", &pictures))?;
        Ok(Self { staging })
    }

    /// Adds a picture of a chapter, which counts from 0.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be written.
    pub fn add(&self, chapter: usize, which: SeriesPicture, picture: &DisplayPicture) -> Result<()> {
        picture.save_png(&self.staging.path().join(which.file(chapter)), BitDepth::Eight, &[])
    }

    /// Writes the page and puts the folder in its place.
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be written.
    pub fn finish(self, results: &SeriesResults) -> Result<()> {
        write_bytes_atomically(&self.staging.path().join("index.html"), page::page(results).as_bytes())?;
        write_bytes_atomically(&self.staging.path().join("results.json"), json(results).as_bytes())?;
        self.staging.publish()
    }
}

#[cfg(test)]
mod tests;
