//! The results of `dejag sequence`, as its `--json` prints them.
//!
//! As in [`super::Results`], whatever depends on the clock stands under a key named `timing`.

use serde::{Deserialize, Serialize};

use super::{NoiseFloor, ProbeFigures, ShardStamp, Spread, Stamp};
use crate::metrics::Figure;

/// Version of the JSON's shape; it rises when a key changes its meaning or goes away.
pub const SEQUENCE_SCHEMA_VERSION: u32 = 1;

/// A whole run: methods on one sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceResults {
    /// [`SEQUENCE_SCHEMA_VERSION`].
    pub schema_version: u32,
    /// What drew the pictures.
    pub stamp: Stamp,
    /// The command line that makes this run again, without the name of the program.
    pub command: Vec<String>,
    /// Which part of the run this is; absent of a whole one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ShardStamp>,
    /// The sequence and how each method did.
    #[serde(flatten)]
    pub result: SequenceResult,
}

/// Methods on one sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceResult {
    /// The scene's name.
    pub scene: String,
    /// What it tests, in a line.
    pub about: String,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// What everything is held against.
    pub reference: SequenceReference,
    /// The frames that were drawn, in order.
    pub frames: Vec<SequenceFrame>,
    /// One entry a method, in the order asked for.
    pub methods: Vec<SequenceMethod>,
}

/// The reference sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceReference {
    /// The method that each frame was made with.
    pub spec: String,
    /// How much two halves of its samples differ: root mean square over all frames, and the largest; absent where there are no halves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise_floor: Option<NoiseFloor>,
    /// Depends on the clock and the cache.
    pub timing: SequenceReferenceTiming,
}

/// How long the reference took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SequenceReferenceTiming {
    /// Seconds to make or load all frames.
    pub seconds: f64,
    /// How many of them came from the cache.
    pub cached: u32,
}

/// One frame, and what could be measured in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceFrame {
    /// Which of the sequence; may be negative.
    pub index: i64,
    /// When, in seconds of the scene's time.
    pub time_s: f64,
    /// How far the whole picture is moved, in pixels right and down.
    pub shift_px: [f64; 2],
    /// Whether what came before was forgotten: the first frame, a cut.
    pub reset: bool,
    /// Share of the pixels whose surface is found again so many frames ago, for each gap from 1.
    pub followed: Vec<f64>,
    /// Pixels that were hidden in one of the last frames and are seen now, off borders: where ghosts are looked for.
    pub uncovered: u64,
    /// Places where the reference has a thin line.
    pub ridges: u64,
}

/// One method on the sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceMethod {
    /// The method with its options, as given.
    pub spec: String,
    /// What came of it.
    #[serde(flatten)]
    pub outcome: SequenceOutcome,
}

/// Measured, or not and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "kebab-case")]
pub enum SequenceOutcome {
    /// All frames were made and measured.
    Measured(Box<SequenceFigures>),
    /// The method could not run here.
    Failed {
        /// Why, and what would help.
        error: String,
    },
}

/// All figures of a method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceFigures {
    /// Samples shaded a pixel and frame.
    pub samples_per_pixel: f64,
    /// Bytes of all the targets that the scene's draw and the method's passes hold.
    pub target_bytes: u64,
    /// One entry a measure, in the registry's order.
    pub figures: Vec<SequenceFigure>,
    /// What is left of a thing where it was.
    pub ghost: Ghost,
    /// Pixels that are NaN or infinite; absent if there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub non_finite: Option<SequenceNonFinite>,
    /// What was found in short runs of their own.
    #[serde(default, skip_serializing_if = "ProbeFigures::is_empty")]
    pub probes: ProbeFigures,
    /// Depends on the clock.
    pub timing: SequenceTiming,
}

/// One measure's verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceFigure {
    /// The measure's versioned id. Figures of different ids must not be compared.
    pub measure: String,
    /// Over all frames.
    pub overall: Figure,
    /// The worst frame; absent where none has a figure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worst: Option<WorstFrame>,
    /// Each frame's, in order; empty for a measure that only the sequence has.
    pub frames: Vec<Figure>,
}

/// The frame that is worst by a measure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct WorstFrame {
    /// Its index.
    pub index: i64,
    /// Its figure.
    pub value: Figure,
}

/// What is left of a thing where it was, as a share of its contrast.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ghost {
    /// For each age from 1, in frames.
    pub ages: Vec<Figure>,
    /// For how many frames 1/255 or more is left; `"inf"` if it is for longer than looked at.
    pub trail: Figure,
}

/// Pixels that are NaN or infinite.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct SequenceNonFinite {
    /// How many, over all frames.
    pub pixels: u64,
    /// In how many frames.
    pub frames: u64,
    /// Index of the first such frame.
    pub first: i64,
}

/// What a method takes. In milliseconds of the wall clock.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SequenceTiming {
    /// One frame, drawn and waited for.
    pub frame_ms: Spread,
}

impl SequenceFigures {
    /// A measure's verdict, by its id.
    #[must_use]
    pub fn figure(&self, id: &str) -> Option<&SequenceFigure> {
        self.figures.iter().find(|figure| figure.measure == id)
    }
}
