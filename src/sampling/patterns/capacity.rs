//! Capacity-constrained point distributions: as Lloyd's, but every site has the same number of many random points to itself.
//!
//! Two sites swap points as long as that brings points nearer to their sites; then each site moves to the centre of what it has.
//! When no swap helps any more, the cells are those of a power diagram of equal masses. The paper starts from a random assignment
//! and looks at every pair of sites; here both are dealt out along a Hilbert curve, so that owners are near from the start, and only
//! pairs are looked at whose points can reach each other. The swaps are the paper's.

use std::ops::ControlFlow;

use super::grid::Grid;
use super::lloyd::into_square;
use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::sequences::hilbert_index;
use crate::sampling::stream::Stream;

pub(super) const CCPD: Pattern = Pattern {
    name: "ccpd",
    aliases: &["capacity-constrained"],
    summary: "sites with equal shares of random points, each at the centre of its own: even as Lloyd's, without its regularity",
    source: "Balzer, Schloemer and Deussen 2009, Capacity-Constrained Point Distributions: A Variant of Lloyd's Method",
    cost: "O(n * capacity * log capacity) a generation, 15 to 30 generations",
    seeded: true,
    progressive: false,
    counts: Counts::Any,
    density: DensityControl::EqualCapacity,
    parameters: &[
        Parameter::whole("capacity", "points a site", 64, [1, 4096]),
        Parameter::whole("generations", "at most; it ends when no two sites gain by swapping", 1000, [0, 10_000]),
        Parameter::switch("torus", "1: opposite sides of the square touch; a disk or a density has borders all the same", false),
    ],
    generate,
};

/// Swaps that gain less than this (squared distance) are rounding.
const LEAST_GAIN: f64 = 1e-14;

fn generate(job: &Job<'_>) -> Vec<[f64; 2]> {
    let mut tessellation = Tessellation::new(job);
    for _ in 0..job.whole("generations") {
        let moved = tessellation.generation();
        job.progress.tell(1.0 - moved as f64 / f64::from(job.n));
        if moved == 0 {
            break;
        }
    }
    tessellation.sites
}

#[derive(Debug)]
struct Tessellation {
    torus: bool,
    capacity: usize,
    sites: Vec<[f64; 2]>,
    /// `capacity` points of each site in turn.
    points: Vec<[f64; 2]>,
    /// Whether a site has swapped in the latest generation, so that its neighbours have to be asked again.
    restless: Vec<bool>,
    /// Kept for their memory.
    gains: [Vec<(f64, usize)>; 2],
}

impl Tessellation {
    fn new(job: &Job<'_>) -> Self {
        let along_curve = |lane: u32, count: usize| {
            let mut chance = Stream::new(job.seed, lane);
            let mut points: Vec<_> = (0..count).map(|_| job.distribution.place(chance.point())).collect();
            points.sort_by_cached_key(|p| hilbert_index(*p));
            points
        };
        let (n, capacity) = (job.n as usize, job.whole("capacity") as usize);
        Self {
            torus: job.switch("torus") && job.distribution.is_plain(),
            capacity,
            sites: along_curve(0, n),
            points: along_curve(1, n * capacity),
            restless: vec![true; n],
            gains: Default::default(),
        }
    }

    /// All swaps that help, then all moves. The number of sites that have swapped.
    fn generation(&mut self) -> usize {
        let grid = Grid::of(&self.sites, self.torus);
        let radii: Vec<f64> = (0..self.sites.len()).map(|site| self.radius(site)).collect();
        let mut swapped = vec![false; self.sites.len()];
        let mut near = Vec::new();
        for site in 0..self.sites.len() {
            near.clear();
            neighbours(site, self.sites[site], &radii, &grid, &mut near);
            for other in &near {
                if (self.restless[site] || self.restless[*other] || swapped[site] || swapped[*other]) && self.swap(site, *other) {
                    (swapped[site], swapped[*other]) = (true, true);
                }
            }
        }
        for site in (0..self.sites.len()).filter(|site| swapped[*site] || self.restless[*site]) {
            self.sites[site] = self.centre(site);
        }
        self.restless = swapped;
        self.restless.iter().filter(|restless| **restless).count()
    }

    fn own(&self, site: usize) -> std::ops::Range<usize> {
        site * self.capacity..(site + 1) * self.capacity
    }

    /// From a site to a point, the short way round on a torus.
    fn way(&self, site: usize, point: usize) -> [f64; 2] {
        [0, 1].map(|k| {
            let way = self.points[point][k] - self.sites[site][k];
            if self.torus && way.abs() > 0.5 { way - way.signum() } else { way }
        })
    }

    fn distance(&self, site: usize, point: usize) -> f64 {
        let [x, y] = self.way(site, point);
        x * x + y * y
    }

    fn radius(&self, site: usize) -> f64 {
        self.own(site).map(|point| self.distance(site, point)).fold(0.0, f64::max).sqrt()
    }

    fn centre(&self, site: usize) -> [f64; 2] {
        let sum = self.own(site).map(|point| self.way(site, point)).fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y]);
        [0, 1].map(|k| into_square(self.sites[site][k] + sum[k] / self.capacity as f64))
    }

    /// Swaps the points that gain most against each other as long as both together gain.
    fn swap(&mut self, a: usize, b: usize) -> bool {
        let [mut from_a, mut from_b] = std::mem::take(&mut self.gains);
        let most_a = self.weigh(a, b, &mut from_a);
        let most_b = self.weigh(b, a, &mut from_b);
        let helps = most_a + most_b > LEAST_GAIN;
        if helps {
            keep_largest(&mut from_a, LEAST_GAIN - most_b);
            keep_largest(&mut from_b, LEAST_GAIN - most_a);
            for ((gain_a, point_a), (gain_b, point_b)) in from_a.iter().zip(&from_b) {
                if gain_a + gain_b <= LEAST_GAIN {
                    break;
                }
                self.points.swap(*point_a, *point_b);
            }
        }
        self.gains = [from_a, from_b];
        helps
    }

    /// What each point of one site would gain at another; the largest.
    fn weigh(&self, from: usize, to: usize, gains: &mut Vec<(f64, usize)>) -> f64 {
        gains.clear();
        gains.extend(self.own(from).map(|point| (self.distance(from, point) - self.distance(to, point), point)));
        gains.iter().fold(f64::NEG_INFINITY, |most, (gain, _)| most.max(*gain))
    }
}

/// Those above a limit, largest first; ties in the points' order.
fn keep_largest(gains: &mut Vec<(f64, usize)>, limit: f64) {
    gains.retain(|(gain, _)| *gain > limit);
    gains.sort_by(|(a, _), (b, _)| b.total_cmp(a));
}

/// Sites whose farthest points and this one's may lie in each other's cells. Each pair is found once: from the one that reaches
/// farther.
fn neighbours(site: usize, place: [f64; 2], radii: &[f64], grid: &Grid, found: &mut Vec<usize>) {
    let radius = radii[site];
    for ring in 0..=grid.last_ring() {
        if grid.reach(place, ring) >= 2.0 * radius {
            break;
        }
        // Nothing stops it.
        let _ = grid.visit_ring(place, ring, |other, [x, y]| {
            let farther = (radius, site) > (radii[other], other);
            if farther && x.hypot(y) < radius + radii[other] && !found.contains(&other) {
                found.push(other);
            }
            ControlFlow::Continue(())
        });
    }
}
