//! Where figures and pictures go.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::super::output;
use crate::error::{Error, Result};
use crate::picture::{BitDepth, DisplayPicture, write_bytes_atomically};
use crate::report;

/// A picture file's kind, by its ending.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PictureKind {
    Png,
    Svg,
}

impl PictureKind {
    /// Fails early if no picture can be written there.
    pub(super) fn check(path: &Path) -> Result<Self> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let kind = match ending.as_deref() {
            Some("png") => Self::Png,
            Some("svg") => Self::Svg,
            _ => return Err(Error::Request(format!("{}: a picture's name ends in .png or .svg", path.display()))),
        };
        output::check_folder_of(path)?;
        Ok(kind)
    }

    /// Writes whichever it is; only that one is made.
    pub(super) fn write(
        self,
        path: &Path,
        svg: impl FnOnce() -> Option<String>,
        png: impl FnOnce() -> Result<DisplayPicture>,
    ) -> Result<()> {
        match self {
            Self::Png => png()?.save_png(path, BitDepth::Eight, &[("Software", concat!("dejag ", env!("CARGO_PKG_VERSION")))]),
            Self::Svg => {
                let text = svg().ok_or_else(|| Error::Request(format!("{}: there is nothing to draw", path.display())))?;
                write_bytes_atomically(path, text.as_bytes())
            }
        }
    }
}

/// Figures as a table or as JSON.
#[derive(Debug, Args)]
pub(super) struct Figures {
    /// Write the figures as JSON; - for stdout, instead of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// No progress, only results and errors
    #[arg(short, long)]
    pub(super) quiet: bool,
}

impl Figures {
    pub(super) fn new(json: Option<PathBuf>, quiet: bool) -> Self {
        Self { json, quiet }
    }

    /// Fails early if the file cannot be written.
    pub(super) fn check(&self) -> Result<()> {
        self.file().map_or(Ok(()), output::check_folder_of)
    }

    fn file(&self) -> Option<&Path> {
        self.json.as_deref().filter(|path| *path != Path::new("-"))
    }

    /// Writes the JSON where it was asked for, and the table unless the JSON took its place.
    pub(super) fn show<T: Serialize>(&self, rows: &[T], table: impl FnOnce(&[T], bool) -> String) -> anyhow::Result<()> {
        if let Some(path) = self.file() {
            write_bytes_atomically(path, report::json(&rows).as_bytes())?;
        }
        if self.json.is_some() && self.file().is_none() {
            return output::print(&report::json(&rows));
        }
        output::print(&table(rows, output::is_colored()))
    }
}
