//! Domain and density in one: where a uniform point of the square goes, and how dense points are there.

use std::f64::consts::{FRAC_PI_4, PI};

use super::density::Inversion;
use super::{Density, Domain, Request};
use crate::error::Result;

/// The largest number below 1: points lie in [0, 1).
const BELOW_ONE: f64 = 1.0 - f64::EPSILON / 2.0;

/// What points are distributed by.
#[derive(Debug, Clone, Default)]
pub(super) struct Distribution {
    domain: Domain,
    weighted: Option<Weighted>,
}

#[derive(Debug, Clone)]
struct Weighted {
    density: Density,
    /// Over the domain.
    mean: f64,
    /// In the square that becomes the domain.
    inversion: Inversion,
}

impl Distribution {
    pub(super) fn new(request: &Request<'_>) -> Result<Self> {
        let weighted = request.density.map(|density| {
            // A disk sees the density through its own map, whose areas are all alike.
            let side = density.size().into_iter().max().unwrap_or(1);
            let seen = match request.domain {
                Domain::Square => density.clone(),
                Domain::Disk => Density::from_fn(side, side, |u| density.at(concentric(u)))?,
            };
            Ok(Weighted { density: density.clone(), mean: seen.mean(), inversion: Inversion::new(&seen) })
        });
        Ok(Self { domain: request.domain, weighted: weighted.transpose()? })
    }

    /// Whether it is the uniform square, the only one whose opposite sides may touch.
    pub(super) fn is_plain(&self) -> bool {
        self.domain == Domain::Square && self.weighted.is_none()
    }

    /// Where a point of the unit square goes; equal areas become equal shares.
    pub(super) fn place(&self, u: [f64; 2]) -> [f64; 2] {
        let warped = self.weighted.as_ref().map_or(u, |w| w.inversion.place(u));
        let placed = if self.domain == Domain::Disk { concentric(warped) } else { warped };
        placed.map(|x| x.min(BELOW_ONE))
    }

    /// Probability density at a point: its integral over the unit square is 1.
    pub(super) fn at(&self, point: [f64; 2]) -> f64 {
        let relative = self.weighted.as_ref().map_or(1.0, |w| w.density.at(point) / w.mean);
        match self.domain {
            Domain::Square => relative,
            Domain::Disk if point.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>() <= 0.25 => relative / FRAC_PI_4,
            Domain::Disk => 0.0,
        }
    }

    /// Columns and rows that a raster needs to show every cell of the density.
    pub(super) fn resolution(&self) -> u32 {
        self.weighted.as_ref().map_or(1, |w| w.density.size().into_iter().max().unwrap_or(1))
    }
}

/// The square's rings onto the disk's, areas kept in proportion and neighbours together (Shirley and Chiu 1997, A Low Distortion
/// Map Between Disk and Square).
fn concentric(u: [f64; 2]) -> [f64; 2] {
    let [x, y] = u.map(|x| 2.0 * x - 1.0);
    if x == 0.0 && y == 0.0 {
        return [0.5, 0.5];
    }
    let (radius, angle) = if x.abs() > y.abs() { (x, PI / 4.0 * (y / x)) } else { (y, PI / 2.0 - PI / 4.0 * (x / y)) };
    [0.5 + 0.5 * radius * angle.cos(), 0.5 + 0.5 * radius * angle.sin()]
}
