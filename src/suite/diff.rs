//! The results of `dejag diff`, as its `--json` prints them: the same for the same files and options, byte for byte.

use serde::{Deserialize, Serialize};
use std::path::Path;

use crate::Error;
use crate::metrics::Figure;

/// Version of the JSON's shape; it rises when a key changes its meaning or goes away.
pub const DIFF_SCHEMA_VERSION: u32 = 1;

/// All pairs of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiffResults {
    /// [`DIFF_SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Version of this crate.
    pub dejag: String,
    /// How many pairs came out how.
    pub counts: OutcomeCounts,
    /// Files in folders whose names are not those of pictures, or that were not asked for.
    pub skipped: u64,
    /// In the order of their paths.
    pub pairs: Vec<DiffPair>,
}

/// How many pairs came out how.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each is the outcome of its name")]
pub struct OutcomeCounts {
    pub same: u64,
    pub different: u64,
    pub size: u64,
    pub profile: u64,
    pub missing: u64,
    pub new: u64,
    pub unreadable: u64,
    pub uncounted: u64,
    pub failed: u64,
}

/// What came of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DiffOutcome {
    /// Every limit is met.
    Same,
    /// A limit is missed.
    Different,
    /// The pictures differ in size, so nothing else was asked.
    Size,
    /// Their values mean different colours, so comparing numbers would say nothing.
    Profile,
    /// Only the first folder has it.
    Missing,
    /// Only the second folder has it.
    New,
    /// One of the two cannot be read.
    Unreadable,
    /// Mask and ignored regions leave no pixel to compare.
    Uncounted,
    /// The candidate could not be drawn, or its mask or regions do not fit it. Only of `check`.
    Failed,
}

impl DiffOutcome {
    /// The word that stands for it in JSON and on the terminal.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Different => "different",
            Self::Size => "size",
            Self::Profile => "profile",
            Self::Missing => "missing",
            Self::New => "new",
            Self::Unreadable => "unreadable",
            Self::Uncounted => "uncounted",
            Self::Failed => "failed",
        }
    }
}

/// Two pictures, and what came of comparing them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiffPair {
    /// The path below both folders; absent for two named files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
    /// Whether a path is not UTF-8, so that what stands here shows its bytes only in part.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub lossy: bool,
    /// The picture that is expected, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected: Option<String>,
    /// The picture that is held against it, where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actual: Option<String>,
    /// What came of it.
    pub outcome: DiffOutcome,
    /// What says more of it: sizes, spaces, or an error.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
    /// Width and height in pixels, expected and actual, where both could be read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sizes: Option<[[u32; 2]; 2]>,
    /// Differing pixels; absent if they were not compared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixels: Option<PixelFigures>,
    /// Edges told from objects; absent if not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub classes: Option<ClassFigures>,
    /// Every limit that could have been set and was looked at, with the value that would have passed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub knobs: Vec<Knob>,
    /// Pictures of the comparison that were written.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pictures: Vec<String>,
}

/// The pixels that differ by more than the tolerance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PixelFigures {
    /// Pixels that were compared: those inside the mask and outside ignored regions.
    pub compared: u64,
    /// Pixels of which a channel differs by more than the tolerance.
    pub differing: u64,
    /// Columns and rows that hold all of them, half-open: `[x, y, width, height]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bounds: Option<[u32; 4]>,
    /// The one that differs most; the first in reading order of several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<WorstPixel>,
}

/// The pixel that differs most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorstPixel {
    /// Column and row.
    pub at: [u32; 2],
    /// The expected channels as the file stores them: levels, or floats, of which NaN and infinities are absent.
    pub expected: Vec<Option<f64>>,
    /// The actual channels.
    pub actual: Vec<Option<f64>>,
    /// Bits of a channel, expected and actual: 8 and 16 are levels, 32 floats.
    pub bits: [u8; 2],
    /// Largest difference of a channel, 1 being the highest level; absent if it is not finite.
    pub difference: Option<f64>,
}

/// Differing pixels that a resampled edge explains, and those that only a changed object does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassFigures {
    /// Version of what tells them apart.
    pub classifier: String,
    /// Pixels of resampled edges.
    pub edge_pixels: u64,
    /// Pixels of changed objects.
    pub object_pixels: u64,
    /// Connected changed objects.
    pub object_count: u64,
    /// The largest ten of them.
    pub largest_objects: Vec<ChangedObject>,
}

/// Pixels of a changed object that touch each other, diagonally too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ChangedObject {
    /// Columns and rows that hold it, half-open: `[x, y, width, height]`.
    pub bounds: [u32; 4],
    /// How many pixels.
    pub pixels: u64,
}

/// A limit: what was met, what was asked, and what would pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Knob {
    /// The option that sets it, such as `--max-flip`.
    pub option: String,
    /// The versioned id of what it limits. Figures of different ids must not be compared.
    pub metric: String,
    /// The pair's figure.
    pub value: Figure,
    /// The limit; absent if none was set.
    pub limit: Option<f64>,
    /// Whether the figure is within the limit.
    pub met: Option<bool>,
    /// A value of the option that this pair passes, rounded away from the figure; absent if there is none.
    pub passes_at: Option<f64>,
}

impl DiffPair {
    /// A pair of files of which nothing is known yet.
    #[must_use]
    pub fn named(expected: &Path, actual: &Path) -> Self {
        Self::of_sides(Some(expected), Some(actual), DiffOutcome::Unreadable)
    }

    /// A pair of which one side may be absent.
    #[must_use]
    pub fn of_sides(expected: Option<&Path>, actual: Option<&Path>, outcome: DiffOutcome) -> Self {
        let text = |path: Option<&Path>| path.map(|path| path.to_string_lossy().into_owned());
        Self {
            path: None,
            lossy: [expected, actual].into_iter().flatten().any(|path| path.to_str().is_none()),
            expected: text(expected),
            actual: text(actual),
            outcome,
            why: None,
            sizes: None,
            pixels: None,
            classes: None,
            knobs: Vec::new(),
            pictures: Vec::new(),
        }
    }

    /// Of a folder that could not be read.
    #[must_use]
    pub fn failed(folder: &Path, error: &Error) -> Self {
        Self::of_sides(Some(folder), None, DiffOutcome::Unreadable).ended(DiffOutcome::Unreadable, error.to_string())
    }

    /// With its outcome and what says more of it.
    #[must_use]
    pub fn ended(self, outcome: DiffOutcome, why: String) -> Self {
        Self { outcome, why: Some(why), ..self }
    }
}

impl OutcomeCounts {
    /// Of these outcomes.
    #[must_use]
    pub fn of(outcomes: impl IntoIterator<Item = DiffOutcome>) -> Self {
        let mut counts = Self::default();
        for outcome in outcomes {
            *match outcome {
                DiffOutcome::Same => &mut counts.same,
                DiffOutcome::Different => &mut counts.different,
                DiffOutcome::Size => &mut counts.size,
                DiffOutcome::Profile => &mut counts.profile,
                DiffOutcome::Missing => &mut counts.missing,
                DiffOutcome::New => &mut counts.new,
                DiffOutcome::Unreadable => &mut counts.unreadable,
                DiffOutcome::Uncounted => &mut counts.uncounted,
                DiffOutcome::Failed => &mut counts.failed,
            } += 1;
        }
        counts
    }

    /// Every outcome with its count, in a fixed order.
    #[must_use]
    pub fn all(&self) -> [(DiffOutcome, u64); 9] {
        [
            (DiffOutcome::Same, self.same),
            (DiffOutcome::Different, self.different),
            (DiffOutcome::Size, self.size),
            (DiffOutcome::Profile, self.profile),
            (DiffOutcome::Missing, self.missing),
            (DiffOutcome::New, self.new),
            (DiffOutcome::Unreadable, self.unreadable),
            (DiffOutcome::Uncounted, self.uncounted),
            (DiffOutcome::Failed, self.failed),
        ]
    }

    /// The exit code: 3 if a picture could not be read or drawn, else 1 if any pair differs, else 4 if nothing was compared, else 0.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        if self.unreadable + self.failed > 0 {
            3
        } else if self.different + self.size + self.profile + self.missing + self.new > 0 {
            1
        } else if self.same == 0 || self.uncounted > 0 {
            4
        } else {
            0
        }
    }
}
