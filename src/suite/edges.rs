//! Filters on straight edges, as `dejag score --json` prints them.

use serde::{Deserialize, Serialize};

/// How far filters are from the exact coverage of straight edges, by the edges' angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeErrors {
    /// Whole degrees from a vertical edge, the same for each curve.
    pub degrees: Vec<u32>,
    /// What a filter is to be held against, then the filters in the order asked for.
    pub curves: Vec<EdgeCurve>,
}

/// One method's errors, in linear light; 1 is the step from the one side of an edge to the other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgeCurve {
    /// The method with its options, or what stands for one.
    pub name: String,
    /// Whether it is not a method of the run but something to hold it against.
    pub baseline: bool,
    /// Root mean square over all angles.
    pub over_all: f64,
    /// Root mean square at each angle.
    pub rms: Vec<f64>,
}
