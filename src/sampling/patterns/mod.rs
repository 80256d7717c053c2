//! Point sets: `n` points in [0, 1)^2, by name, with parameters, in a domain, under a density.
//!
//! Each file holds patterns of one kind, descriptor and generator side by side; the registry below is one line each.

mod capacity;
mod cell;
mod darts;
mod density;
mod distribution;
mod grid;
mod hardware;
mod lloyd;
mod nets;
mod parameter;
mod raster;
mod request;
mod sequential;
mod spec;
mod stratified;

pub use density::Density;
use distribution::Distribution;
pub use hardware::standard_positions;
use parameter::Job;
pub use parameter::Parameter;
pub use request::{Domain, Progress, Request};
pub use spec::{MAX_SET_POINTS, PatternSpec};

use crate::error::{Result, unknown};

/// The most samples that are spread over a pixel.
pub const MAX_POINTS: u32 = 4096;

/// A way to spread points: what it is and what it can.
#[derive(Debug)]
pub struct Pattern {
    /// As in `pattern=NAME`.
    pub name: &'static str,
    /// Other names that are understood.
    pub aliases: &'static [&'static str],
    /// What it is, in a line.
    pub summary: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// What a set of n points costs.
    pub cost: &'static str,
    /// Whether the seed changes it, with the parameters' defaults.
    pub seeded: bool,
    /// Whether its first points are spread as well as all of them are, so that any prefix is usable.
    pub progressive: bool,
    /// Which numbers of points it is at its best with. It takes any.
    pub counts: Counts,
    /// How it follows a density.
    pub density: DensityControl,
    /// What can be set.
    pub parameters: &'static [Parameter],
    generate: fn(&Job<'_>) -> Vec<[f64; 2]>,
}

/// Which numbers of points a pattern is at its best with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Counts {
    /// One as well as another.
    Any,
    /// Squares: other numbers leave cells of slightly unequal shape.
    Squares,
    /// Powers of two: other numbers leave strata half filled.
    PowersOfTwo,
    /// These alone; others are filled from another pattern.
    These(&'static [u32]),
}

impl Counts {
    /// In words.
    #[must_use]
    pub fn describe(self) -> String {
        match self {
            Self::Any => "any".into(),
            Self::Squares => "any, best squares".into(),
            Self::PowersOfTwo => "any, best powers of two".into(),
            Self::These(counts) => counts.iter().map(u32::to_string).collect::<Vec<_>>().join(", "),
        }
    }
}

/// How a pattern follows a density.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DensityControl {
    /// The square is warped by the inverse of the density's cumulative distribution.
    Warping,
    /// Candidates are drawn from the density, and their distances are measured in the spacing that it asks for.
    Rejection,
    /// Cells are centred on their centres of mass.
    WeightedVoronoi,
    /// Cells have equal shares of the mass.
    EqualCapacity,
}

impl DensityControl {
    /// In words.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Warping => "warping",
            Self::Rejection => "rejection",
            Self::WeightedVoronoi => "weighted Voronoi cells",
            Self::EqualCapacity => "cells of equal mass",
        }
    }
}

/// Every pattern there is.
pub const PATTERNS: &[Pattern] = &[
    stratified::REGULAR,
    stratified::ROTATED,
    stratified::JITTERED,
    stratified::SEMI_JITTERED,
    stratified::MULTI_JITTERED,
    stratified::CORRELATED_MULTI_JITTERED,
    stratified::N_ROOKS,
    sequential::RANDOM,
    sequential::HALTON,
    sequential::R2,
    sequential::SOBOL,
    sequential::SOBOL_OWEN,
    nets::HAMMERSLEY,
    nets::HAMMERSLEY_OWEN,
    nets::LARCHER_PILLICHSHAMMER,
    nets::FIBONACCI,
    hardware::STANDARD_MSAA,
    darts::POISSON_DISK,
    darts::MITCHELL,
    lloyd::LLOYD,
    capacity::CCPD,
];

impl Pattern {
    /// `n` points in the unit square, with the parameters' defaults; none for an `n` of 0.
    #[must_use]
    pub fn points(&self, n: u32, seed: u32) -> Vec<[f64; 2]> {
        self.run(&self.defaults(), &Request::new(n, seed), &Distribution::default())
    }

    /// Whether this is what `name` means.
    #[must_use]
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.aliases.contains(&name)
    }

    fn defaults(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.default).collect()
    }

    fn run(&self, values: &[f64], request: &Request<'_>, distribution: &Distribution) -> Vec<[f64; 2]> {
        let Request { n, seed, progress, .. } = *request;
        if n == 0 {
            return Vec::new();
        }
        let points = (self.generate)(&Job { n, seed, distribution, progress, parameters: self.parameters, values });
        match self.density {
            DensityControl::Warping if !distribution.is_plain() => points.into_iter().map(|p| distribution.place(p)).collect(),
            _ => points,
        }
    }
}

/// The pattern of this name or alias.
///
/// # Errors
/// [`crate::Error::Request`] that lists the names.
pub fn pattern(name: &str) -> Result<&'static Pattern> {
    PATTERNS.iter().find(|p| p.is_called(name)).ok_or_else(|| unknown("pattern", name, &pattern_names()))
}

/// What every pattern is called, then what else some are.
#[must_use]
pub fn pattern_names() -> Vec<&'static str> {
    PATTERNS.iter().map(|p| p.name).chain(PATTERNS.iter().flat_map(|p| p.aliases.iter().copied())).collect()
}

#[cfg(test)]
mod tests;
