//! Lloyd's relaxation: every point moves to the centre of its Voronoi cell, generation after generation.
//!
//! Cells are exact polygons. Without a density their centres are exact too; under one, or with `raster`, a cell's mass is that of
//! the pixels whose centres it holds (Secord 2002, Weighted Voronoi Stippling). Coarse pixels make it stall before it is done,
//! which is how sets of the literature differ.

use super::cell::Cell;
use super::grid::Grid;
use super::raster::{Raster, Spans};
use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::stream::Stream;

pub(super) const LLOYD: Pattern = Pattern {
    name: "lloyd",
    aliases: &[],
    summary: "random points moved to the centres of their Voronoi cells, again and again: towards a hexagonal lattice",
    source: "Lloyd 1982, Least Squares Quantization in PCM; McCool and Fiume 1992",
    cost: "O(n) a generation, about 20 cuts a cell",
    seeded: true,
    progressive: false,
    counts: Counts::Any,
    density: DensityControl::WeightedVoronoi,
    parameters: &[
        Parameter::whole("generations", "how often all points move; fewer if they come to rest", 40, [0, 10_000]),
        Parameter::whole("raster", "0: exact centres; else centres of as many pixels a side, as in the literature", 0, [0, 4096]),
        Parameter::switch("torus", "1: opposite sides of the square touch; a disk or a density has borders all the same", false),
    ],
    generate,
};

fn generate(job: &Job<'_>) -> Vec<[f64; 2]> {
    let mut chance = Stream::new(job.seed, 0);
    let mut sites: Vec<_> = (0..job.n).map(|_| job.distribution.place(chance.point())).collect();
    let torus = job.switch("torus") && job.distribution.is_plain();
    let raster = pixels(job).map(|side| Raster::new(job.distribution, side));
    let generations = job.whole("generations");
    for generation in 0..generations {
        let moved = centres(&sites, torus, raster.as_ref());
        if moved == sites {
            break;
        }
        sites = moved;
        job.progress.tell(f64::from(generation + 1) / f64::from(generations));
    }
    sites
}

/// Pixels a side if masses are to be summed over pixels: as many as asked for, and under a density as many as show it and give
/// each cell some 250.
fn pixels(job: &Job<'_>) -> Option<u32> {
    let asked = job.whole("raster");
    if job.distribution.is_plain() || asked > 0 {
        return (asked > 0).then_some(asked);
    }
    let fine = (16.0 * f64::from(job.n).sqrt()) as u32;
    Some(fine.max(job.distribution.resolution()).clamp(512, 2048))
}

fn centres(sites: &[[f64; 2]], torus: bool, raster: Option<&Raster>) -> Vec<[f64; 2]> {
    let grid = Grid::of(sites, torus);
    let (mut cell, mut rows) = (Cell::default(), Spans::default());
    let centre = |site: &[f64; 2]| {
        cell.fit(*site, &grid, torus);
        let centre = match raster {
            Some(raster) => raster.centre(*site, cell.corners(), &mut rows),
            None => cell.centre().map(|way| [site[0] + way[0], site[1] + way[1]]),
        };
        // A cell without mass leaves its site where it is.
        centre.map_or(*site, |c| c.map(into_square))
    };
    sites.iter().map(centre).collect()
}

/// Back by whole turns. Without a torus centres do not leave the square.
pub(super) fn into_square(x: f64) -> f64 {
    let inside = x - x.floor();
    // What is a hair below 0 rounds to 1.
    if inside < 1.0 { inside } else { 0.0 }
}
