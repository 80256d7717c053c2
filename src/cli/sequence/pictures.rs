//! The pictures of a sequence: numbered files, and an animation.

use std::path::{Path, PathBuf};

use clap::Args;

use super::super::output;
use crate::bench::sequence::{FramePicture, FrameSink};
use crate::error::{Error, Result};
use crate::metrics::{Pair, error_map};
use crate::picture::{Apng, BitDepth, DisplayPicture, FileFormat, side_by_side};
use crate::report::{FramesFolder, SequenceReport, Shown, strip_places};
use crate::suite::SequenceResults;

/// Between the pictures of an animation.
const GAP_PX: u32 = 4;

/// Where pictures go.
#[derive(Debug, Args)]
pub(super) struct PictureOptions {
    /// Write every frame of every method and of the reference into this folder, numbered from 00000
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Of these files: png (display values) or exr (linear values, not exposed)
    #[arg(long, value_name = "FORMAT", default_value = "png", value_parser = ["png", "exr"], requires = "out")]
    format: String,
    /// Write an animation that loops, a PNG; of several methods side by side, the reference last
    #[arg(long, value_name = "FILE")]
    apng: Option<PathBuf>,
    /// Write a report into this folder: figures, a film strip with the error under it, curves over time; open its index.html
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
}

/// What is written while the run goes on.
#[derive(Debug)]
pub(super) struct Pictures {
    folder: Option<FramesFolder>,
    animation: Option<Animation>,
    report: Option<Strip>,
    methods: usize,
}

/// The film strip of a report.
#[derive(Debug)]
struct Strip {
    report: SequenceReport,
    /// Which frames it shows, by their place in the sequence.
    places: Vec<usize>,
    /// That of the frame at hand, in 8 bits.
    reference: Option<DisplayPicture>,
}

#[derive(Debug)]
struct Animation {
    file: Apng,
    size: [u32; 2],
    /// Of the frame at hand: a place for each method, and one for the reference if there are several.
    panels: Vec<Option<DisplayPicture>>,
}

/// What there is to show.
pub(super) struct Showing<'a> {
    pub(super) methods: &'a [&'a str],
    pub(super) size: [u32; 2],
    pub(super) frames: usize,
    /// For how long each is seen.
    pub(super) frame_s: f64,
}

impl PictureOptions {
    /// Finds out early what cannot be written.
    pub(super) fn begin(&self, showing: &Showing<'_>) -> Result<Pictures> {
        let format = if self.format == "exr" { FileFormat::Exr } else { FileFormat::Png };
        let names = [showing.methods, &["reference"]].concat();
        let folder = self.out.as_deref().map(|dir| FramesFolder::begin(dir, format, &names)).transpose()?;
        let animation = self.apng.as_deref().map(|path| Animation::begin(path, showing)).transpose()?;
        let report = self.report.as_deref().map(|dir| Strip::begin(dir, showing.frames)).transpose()?;
        Ok(Pictures { folder, animation, report, methods: showing.methods.len() })
    }
}

impl Animation {
    fn begin(path: &Path, showing: &Showing<'_>) -> Result<Self> {
        if output::check_file(path)? != FileFormat::Png {
            return Err(Error::Request(format!("{} is no PNG; name a .png file for --apng", path.display())));
        }
        let methods = showing.methods.len();
        let panels = if methods > 1 { methods + 1 } else { 1 };
        let [width, height] = showing.size.map(u64::from);
        let whole = panels as u64 * (width + u64::from(GAP_PX)) - u64::from(GAP_PX);
        // More than a file can hold is refused as such.
        let size = [u32::try_from(whole).unwrap_or(u32::MAX), height as u32];
        let file = Apng::begin(path, size, showing.frames as u32, showing.frame_s)?;
        Ok(Self { file, size: showing.size, panels: vec![None; panels] })
    }

    /// Writes the frame at hand, if there is one. A method that could not run is black.
    fn flush(&mut self) -> Result<()> {
        if self.panels.iter().all(Option::is_none) {
            return Ok(());
        }
        let black = DisplayPicture::from_fn(self.size[0], self.size[1], |_, _| [0.0, 0.0, 0.0, 1.0])?;
        let panels: Vec<&DisplayPicture> = self.panels.iter().map(|panel| panel.as_ref().unwrap_or(&black)).collect();
        self.file.add(&side_by_side(&panels, GAP_PX)?)?;
        self.panels.fill(None);
        Ok(())
    }
}

impl Strip {
    fn begin(dir: &Path, frames: usize) -> Result<Self> {
        Ok(Self { report: SequenceReport::begin(dir)?, places: strip_places(frames), reference: None })
    }

    fn reference(&mut self, frame: &FramePicture<'_>) -> Result<()> {
        if !self.places.contains(&frame.place) {
            return Ok(());
        }
        let reference = frame.display.quantized(BitDepth::Eight);
        self.report.add(frame.place, Shown::Reference, &reference)?;
        self.reference = Some(reference);
        Ok(())
    }

    fn method(&mut self, frame: &FramePicture<'_>) -> Result<()> {
        let Some(reference) = self.reference.as_ref().filter(|_| self.places.contains(&frame.place)) else {
            return Ok(());
        };
        let capture = frame.display.quantized(BitDepth::Eight);
        let error = error_map(&Pair::new(&capture, reference)?)?;
        self.report.add(frame.place, Shown::Capture(frame.method), &capture)?;
        self.report.add(frame.place, Shown::ErrorMap(frame.method), &error)
    }
}

impl Pictures {
    /// Puts everything in its place.
    pub(super) fn finish(self, results: &SequenceResults) -> Result<()> {
        if let Some(strip) = self.report {
            strip.report.finish(results)?;
        }
        if let Some(mut animation) = self.animation {
            animation.flush()?;
            animation.file.finish()?;
        }
        self.folder.map_or(Ok(()), FramesFolder::finish)
    }

    fn add(&mut self, place: usize, frame: &FramePicture<'_>) -> Result<()> {
        if let Some(folder) = &self.folder {
            folder.add(place, frame.place, frame.display, frame.linear)?;
        }
        if let Some(panel) = self.animation.as_mut().and_then(|animation| animation.panels.get_mut(place)) {
            *panel = Some(frame.display.clone());
        }
        Ok(())
    }
}

impl FrameSink for Pictures {
    fn method(&mut self, frame: &FramePicture<'_>) -> Result<()> {
        if let Some(strip) = &mut self.report {
            strip.method(frame)?;
        }
        self.add(frame.method, frame)
    }

    fn reference(&mut self, frame: &FramePicture<'_>) -> Result<()> {
        if let Some(animation) = &mut self.animation {
            animation.flush()?;
        }
        if let Some(strip) = &mut self.report {
            strip.reference(frame)?;
        }
        self.add(self.methods, frame)
    }
}
