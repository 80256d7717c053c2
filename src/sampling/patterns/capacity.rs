//! Capacity-constrained point distributions: as Lloyd's, but every site has the same number of many random points to itself.
//!
//! Points start at random sites. Two sites swap points as long as each of the two comes nearer to its site; then every site moves
//! to the centre of what it has; until nobody swaps. Swapping whenever the two distances shrink in sum goes on for two to four
//! times as many generations, towards a hexagonal lattice and away from the published discrepancies and spectra. So would a start from
//! near sites: the random one leaves less of the points' own unevenness at low frequencies.
//!
//! Only pairs are asked whose farthest points may reach each other, which after the first generation are few.

use std::ops::{ControlFlow, Range};

use super::grid::Grid;
use super::lloyd::into_square;
use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::stream::Stream;

pub(super) const CCPD: Pattern = Pattern {
    name: "ccpd",
    aliases: &["capacity-constrained"],
    summary: "sites with equal shares of random points, each at the centre of its own: even as Lloyd's, without its regularity",
    source: "Balzer, Schloemer and Deussen 2009, Capacity-Constrained Point Distributions: A Variant of Lloyd's Method",
    cost: "O(n^2 * capacity) for the first generation, O(n * capacity) for each of 15 to 30 more",
    seeded: true,
    progressive: false,
    counts: Counts::Any,
    density: DensityControl::EqualCapacity,
    parameters: &[
        Parameter::whole("capacity", "points a site", 64, [1, 1024]),
        Parameter::whole("generations", "at most; it ends when no two sites gain by swapping", 1000, [0, 10_000]),
        Parameter::switch("torus", "1: opposite sides of the square touch; a disk or a density has borders all the same", false),
    ],
    generate,
};

fn generate(job: &Job<'_>) -> Vec<[f64; 2]> {
    let mut tessellation = Tessellation::new(job);
    for generation in 0..job.whole("generations") {
        let swapped = tessellation.generation(|share| {
            // The first looks at all pairs, and takes about as long as all others.
            if generation == 0 {
                job.progress.tell(0.5 * share);
            }
        });
        job.progress.tell(1.0 - 0.5 * swapped as f64 / f64::from(job.n));
        if swapped == 0 {
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
    /// Points that would gain by going over to another site, each way. Kept for their memory.
    movers: [Vec<(f64, usize)>; 2],
}

impl Tessellation {
    fn new(job: &Job<'_>) -> Self {
        let scatter = |lane: u32, count: usize| {
            let mut chance = Stream::new(job.seed, lane);
            (0..count).map(|_| job.distribution.place(chance.point())).collect()
        };
        let (n, capacity) = (job.n as usize, job.whole("capacity") as usize);
        Self {
            torus: job.switch("torus") && job.distribution.is_plain(),
            capacity,
            sites: scatter(0, n),
            points: scatter(1, n * capacity),
            restless: vec![true; n],
            movers: Default::default(),
        }
    }

    /// All swaps that help, then all moves. The number of sites that have swapped; `progress` hears the share of sites done.
    fn generation(&mut self, progress: impl Fn(f64)) -> usize {
        let count = self.sites.len();
        let grid = Grid::of(&self.sites, self.torus);
        let radii: Vec<f64> = (0..count).map(|site| self.radius(site)).collect();
        let mut swapped = vec![false; count];
        let mut near = Vec::new();
        for site in 0..count {
            self.neighbours(site, &radii, &grid, &mut near);
            for other in &near {
                let asked = self.restless[site] || self.restless[*other] || swapped[site] || swapped[*other];
                if asked && self.swap(site, *other) {
                    (swapped[site], swapped[*other]) = (true, true);
                }
            }
            progress((site + 1) as f64 / count as f64);
        }
        self.sites = (0..count).map(|site| self.centre(site)).collect();
        self.restless = swapped;
        self.restless.iter().filter(|restless| **restless).count()
    }

    /// Sites whose farthest points and this one's may be nearer to each other's. Each pair is found once: from the one that reaches
    /// farther.
    fn neighbours(&self, site: usize, radii: &[f64], grid: &Grid, found: &mut Vec<usize>) {
        let (place, radius) = (self.sites[site], radii[site]);
        let reaches = |other: usize, [x, y]: [f64; 2]| {
            (radius, site) > (radii[other], other) && x * x + y * y < (radius + radii[other]) * (radius + radii[other])
        };
        found.clear();
        let Some(rings) = grid.rings_within(2.0 * radius) else {
            found.extend((0..radii.len()).filter(|other| reaches(*other, self.way(place, self.sites[*other]))));
            return;
        };
        for ring in 0..=rings {
            // Nothing stops it.
            let _ = grid.visit_ring(place, ring, |other, way| {
                if reaches(other, way) {
                    found.push(other);
                }
                ControlFlow::Continue(())
            });
        }
    }

    /// From one place to another, the short way round on a torus.
    fn way(&self, from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
        let way = [to[0] - from[0], to[1] - from[1]];
        if self.torus { way.map(|x| if x.abs() > 0.5 { x - x.signum() } else { x }) } else { way }
    }

    fn distance_squared(&self, from: [f64; 2], to: [f64; 2]) -> f64 {
        let [x, y] = self.way(from, to);
        x * x + y * y
    }

    fn own(&self, site: usize) -> Range<usize> {
        site * self.capacity..(site + 1) * self.capacity
    }

    fn radius(&self, site: usize) -> f64 {
        let own = self.points[self.own(site)].iter();
        own.map(|point| self.distance_squared(self.sites[site], *point)).fold(0.0, f64::max).sqrt()
    }

    fn centre(&self, site: usize) -> [f64; 2] {
        let place = self.sites[site];
        let ways = self.points[self.own(site)].iter().map(|point| self.way(place, *point));
        let sum = ways.fold([0.0; 2], |[a, b], [x, y]| [a + x, b + y]);
        [0, 1].map(|k| into_square(place[k] + sum[k] / self.capacity as f64))
    }

    /// Swaps as many points as gain on both sides, those that gain most.
    fn swap(&mut self, a: usize, b: usize) -> bool {
        let [mut from_a, mut from_b] = std::mem::take(&mut self.movers);
        self.find_movers(a, b, &mut from_a);
        if !from_a.is_empty() {
            self.find_movers(b, a, &mut from_b);
        }
        let count = if from_a.is_empty() { 0 } else { from_a.len().min(from_b.len()) };
        if count > 0 {
            for movers in [&mut from_a, &mut from_b] {
                movers.select_nth_unstable_by(count - 1, |(x, i), (y, k)| y.total_cmp(x).then(i.cmp(k)));
            }
            for ((_, x), (_, y)) in from_a[..count].iter().zip(&from_b) {
                self.points.swap(*x, *y);
            }
        }
        self.movers = [from_a, from_b];
        count > 0
    }

    /// The points of one site that are nearer to another, and by how much.
    fn find_movers(&self, from: usize, to: usize, movers: &mut Vec<(f64, usize)>) {
        // Less is rounding.
        const LEAST: f64 = 1e-14;
        let (from_place, to_place) = (self.sites[from], self.sites[to]);
        movers.clear();
        for index in self.own(from) {
            let point = self.points[index];
            let gain = self.distance_squared(from_place, point) - self.distance_squared(to_place, point);
            if gain > LEAST {
                movers.push((gain, index));
            }
        }
    }
}
