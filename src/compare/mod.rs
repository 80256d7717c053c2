//! Picture files compared: what differs, by how much, and whether that is within limits.
//!
//! Pixels are compared in the depth of their files; metrics are computed a strip at a time. So a pair needs little more memory than
//! its two decoded pictures. Nothing depends on the number of threads.

mod edges;
mod figures;
mod files;
mod folders;
mod histogram;
mod limits;
mod pictures;
mod pixels;
mod scope;
mod sides;
#[cfg(test)]
mod tests;
mod verdict;
mod waves;

pub use files::{Settings, guarded};
pub use folders::{Filter, Listing, PathPair, list, list_one};
pub use limits::{Allowance, Limits, Measure, MetricLimit, parse_difference, parse_limit};
pub use pictures::Targets;
pub use scope::{Rectangle, Scope};
pub use waves::wave_length;
