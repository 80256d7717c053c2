//! What a manifest asks for, entry by entry.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::slot::Slot;
use super::tolerance::Tolerance;
use crate::compare::{Filter, Rectangle};
use crate::picture::BitDepth;

/// An entry: what is drawn, dealt and resumed as a whole.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Unique in the manifest; with `/` between its parts.
    pub id: String,
    /// Where its pictures come from.
    pub subject: Subject,
    /// The manifest's tolerance with the entry's own over it.
    pub(super) tolerance: Tolerance,
    /// Relative to the manifest.
    pub(super) mask: Option<PathBuf>,
    pub(super) ignored: Vec<Rectangle>,
}

/// Where the pictures of an entry come from.
#[derive(Debug, Clone)]
pub enum Subject {
    /// One frame of a scene.
    Capture(Drawing, u32),
    /// Frames of a scene, of which methods with history know the ones before.
    Sequence(Drawing, Range<i64>),
    /// A picture that something else made.
    File(PathBuf),
    /// All pictures of a folder.
    Folder(PathBuf, Filter),
}

/// What is drawn, as words: whether they make sense is known to what draws.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Drawing {
    /// A shipped scene, or a file.
    pub scene: String,
    /// A method with its options.
    pub method: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How it is stored.
    pub format: Format,
}

/// How what is drawn is stored.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase", expecting = "png, png16 or exr")]
pub enum Format {
    /// Display values, 8 bits.
    #[default]
    Png,
    /// Display values, 16 bits.
    Png16,
    /// Linear values, 32-bit floats.
    Exr,
}

impl Format {
    /// Of its files' names.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png | Self::Png16 => "png",
            Self::Exr => "exr",
        }
    }

    pub(super) fn depth(self) -> BitDepth {
        if self == Self::Png16 { BitDepth::Sixteen } else { BitDepth::Eight }
    }
}

impl Entry {
    /// The file of its golden, or the folder of its goldens, below an environment's.
    pub(super) fn golden_name(&self) -> String {
        match &self.subject {
            Subject::Capture(drawing, _) => slashed(&Slot::drawn(&self.id, None, drawing.format.extension()).below),
            Subject::File(path) => slashed(&Slot::file(&self.id, path).below),
            Subject::Sequence(..) | Subject::Folder(..) => self.id.clone(),
        }
    }

    /// What is drawn for it, if anything is.
    #[must_use]
    pub fn drawing(&self) -> Option<&Drawing> {
        match &self.subject {
            Subject::Capture(drawing, _) | Subject::Sequence(drawing, _) => Some(drawing),
            Subject::File(_) | Subject::Folder(..) => None,
        }
    }

    /// What it shows, in a line.
    pub(super) fn about(&self) -> String {
        let drawn = |drawing: &Drawing| {
            let Drawing { scene, method, size: [width, height], .. } = drawing;
            format!("{scene} with {method}, {width}x{height}")
        };
        match &self.subject {
            Subject::Capture(drawing, 0) => drawn(drawing),
            Subject::Capture(drawing, frame) => format!("{}, frame {frame}", drawn(drawing)),
            Subject::Sequence(drawing, frames) => format!("{}, frames {}..{}", drawn(drawing), frames.start, frames.end),
            Subject::File(path) => slashed(path),
            Subject::Folder(path, _) => format!("a picture of {}", slashed(path)),
        }
    }
}

/// A path as JSON has it: with `/`, and what is not UTF-8 only in part.
pub(super) fn slashed(path: &Path) -> String {
    let text = path.to_string_lossy();
    if std::path::MAIN_SEPARATOR == '/' { text.into_owned() } else { text.replace(std::path::MAIN_SEPARATOR, "/") }
}
