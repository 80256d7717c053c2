//! How even a point set is, as the literature measures it: discrepancies, distances, the spectrum.
//!
//! All take points of the unit square, [0, 1)^2, in any order, and give plain values (tables in print often show them times 1000).
//! Sums run in a fixed order, so the same points give the same bits. Without points the share of points in a box is 0 everywhere,
//! and discrepancies are those of an empty set.

mod distance;
mod rectangles;
mod spectrum;
mod spread;
mod star;
#[cfg(test)]
mod tests;

pub use distance::{Nearest, Surroundings, nearest};
pub use rectangles::{stroud, stroud_on_lattice, stroud_torus};
pub use spectrum::{Periodogram, SpectrumFigures, principal_frequency};
pub use spread::Spread;
pub use star::{deviations, star, star_l2};

/// A share of the points is a count over this.
fn count(points: &[[f64; 2]]) -> f64 {
    points.len().max(1) as f64
}
