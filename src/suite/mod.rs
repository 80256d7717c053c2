//! What a run of the bench says, as data: no GPU, no layout. `bench` and `compare` fill it, `report` shows it.

mod check;
mod diff;
mod edges;
mod merge;
mod patterns;
mod probes;
mod results;
mod sequence;
mod series;
mod shard;

pub use check::{CHECK_SCHEMA_VERSION, CaseTiming, CheckResults, CheckedCase, Environment, Golden, ShardStamp};
pub use diff::{
    ChangedObject, ClassFigures, DIFF_SCHEMA_VERSION, DiffOutcome, DiffPair, DiffResults, Knob, OutcomeCounts, PixelFigures,
    WorstPixel,
};
pub use edges::{EdgeCurve, EdgeErrors};
pub use merge::{Part, merge};
pub use patterns::{IntegralError, IntegralRow, NearestFigures, PatternRow, PatternTiming, SpectrumRow};
pub use probes::{ConvergenceFigures, CrawlFigures, EdgeAngle, PositionFigures, ProbeFigures, ResponseFigures, SharpnessFigure};
pub use results::{
    AnalyticDistance, MethodResult, NoiseFloor, Outcome, PassTiming, ReferenceResult, ReferenceTiming, Results, SCHEMA_VERSION,
    SceneResult, SceneTiming, Score, Spread, Stamp, Timing,
};
pub use sequence::{
    Ghost, SEQUENCE_SCHEMA_VERSION, SequenceFigure, SequenceFigures, SequenceFrame, SequenceMethod, SequenceNonFinite,
    SequenceOutcome, SequenceReference, SequenceReferenceTiming, SequenceResult, SequenceResults, SequenceTiming, WorstFrame,
};
pub use series::{Chapter, SERIES_SCHEMA_VERSION, SampledPicture, Series, SeriesResults, Subject};
pub use shard::{Shard, check_whole};
