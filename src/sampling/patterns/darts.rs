//! Sets whose points keep their distance, made of random candidates: Poisson disks and Mitchell's best candidates.

use super::grid::Grid;
use super::{Counts, DensityControl, Distribution, Job, Parameter, Pattern};
use crate::sampling::stream::Stream;

pub(super) const TORUS: Parameter =
    Parameter::switch("torus", "1: opposite sides of the square touch; a disk or a density has borders all the same", true);

pub(super) const POISSON_DISK: Pattern = Pattern {
    name: "poisson-disk",
    aliases: &[],
    summary: "random points, none nearer to another than a set distance: what the eye's receptors do",
    source: "Cook 1986; where they do not fit, relaxed after McCool and Fiume 1992",
    cost: "O(n), about 50 candidates a point",
    seeded: true,
    progressive: false,
    counts: Counts::Any,
    density: DensityControl::Rejection,
    parameters: &[
        Parameter::number(
            "radius",
            "least distance over that of a hexagonal lattice; above 0.75 not all points fit, and it shrinks until they do",
            0.676,
            [0.0, 1.0],
        ),
        TORUS,
    ],
    generate: poisson_disk,
};

pub(super) const MITCHELL: Pattern = Pattern {
    name: "mitchell",
    summary: "of ever more random candidates the one farthest from all points before: blue noise of which any prefix is",
    source: "Mitchell 1991, Spectrally Optimal Sampling for Distribution Ray Tracing",
    cost: "O(n^2): candidates * n^2 / 2 short searches",
    progressive: true,
    parameters: &[Parameter::whole("candidates", "for each point, times the number of points before it", 10, [1, 1000]), TORUS],
    generate: mitchell,
    ..POISSON_DISK
};

/// Squared distance between neighbours of a hexagonal lattice of as many points to the area as are asked for around `place`.
fn hexagonal_squared(distribution: &Distribution, n: u32, place: [f64; 2]) -> f64 {
    2.0 / (3.0f64.sqrt() * f64::from(n) * distribution.at(place))
}

/// Darts are thrown until n have stuck. So many that miss in a row mean that what is left free is not worth looking for: then the
/// distance shrinks by 2% for the points still to come, so that any n comes back whole.
fn poisson_disk(job: &Job<'_>) -> Vec<[f64; 2]> {
    let patience = 1000 + 50 * u64::from(job.n);
    let mut grid = Grid::new(job.switch("torus") && job.distribution.is_plain());
    let mut chance = Stream::new(job.seed, 0);
    let (mut radius, mut missed) = (job.number("radius"), 0);
    while grid.len() < job.n as usize {
        let dart = job.distribution.place(chance.point());
        let distance = radius * radius * hexagonal_squared(job.distribution, job.n, dart);
        if grid.nearest_beyond(dart, distance, distance).is_some() {
            grid.insert(dart);
            missed = 0;
            job.progress.tell(grid.len() as f64 / f64::from(job.n));
        } else {
            missed += 1;
        }
        if missed == patience {
            radius *= 0.98;
            missed = 0;
        }
    }
    grid.into_points()
}

/// The candidates of each point follow from the seed alone, so that a longer set starts with a shorter one. Under a density,
/// distances are measured in the spacing that it asks for at the candidate.
fn mitchell(job: &Job<'_>) -> Vec<[f64; 2]> {
    let candidates = u64::from(job.whole("candidates"));
    let mut grid = Grid::new(job.switch("torus") && job.distribution.is_plain());
    let mut chance = Stream::new(job.seed, 0);
    for index in 0..u64::from(job.n) {
        let mut best = job.distribution.place(chance.point());
        let mut farthest = 0.0;
        for k in 0..(candidates * index).max(1) {
            let candidate = if k == 0 { best } else { job.distribution.place(chance.point()) };
            let spacing = hexagonal_squared(job.distribution, 1, candidate);
            // Most candidates end here, at the first point that is nearer than the best one's nearest.
            if let Some(distance) = grid.nearest_beyond(candidate, farthest * spacing, f64::INFINITY) {
                (best, farthest) = (candidate, distance / spacing);
            }
        }
        grid.insert(best);
        job.progress.tell((index as f64 / f64::from(job.n)).powi(2));
    }
    grid.into_points()
}
