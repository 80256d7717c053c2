//! Sets of one point a cell: the cells share the square out, the patterns differ in where in its cell a point lies.

use super::{Counts, DensityControl, Job, Parameter, Pattern};
use crate::sampling::stream::Stream;

pub(super) const REGULAR: Pattern = Pattern {
    name: "regular",
    aliases: &[],
    summary: "the centres of n equal cells in rows: exact on constant areas, worst on near-axis edges",
    source: "as old as sampling",
    cost: "O(n)",
    seeded: false,
    progressive: false,
    counts: Counts::Squares,
    density: DensityControl::Warping,
    parameters: &[],
    generate: |job| in_cells(job.n, |_| [0.5, 0.5]),
};

pub(super) const ROTATED: Pattern = Pattern {
    name: "rotated",
    summary: "the regular grid sheared both ways, so that no two samples share a row or column (4: RGSS)",
    source: "Shirley 1991; Beets and Barron 2000, Super-sampling Anti-aliasing Analyzed",
    generate: |job| rotated(job.n),
    ..REGULAR
};

pub(super) const JITTERED: Pattern = Pattern {
    name: "jittered",
    summary: "one random point in each of n equal cells (Cook 1986)",
    source: "Cook 1986, Stochastic Sampling in Computer Graphics",
    seeded: true,
    generate: |job| jittered(job, 1.0),
    ..REGULAR
};

pub(super) const SEMI_JITTERED: Pattern = Pattern {
    name: "semi-jittered",
    summary: "one random point in the middle part of each of n equal cells: between regular and jittered",
    parameters: &[Parameter::number("amplitude", "share of its cell's sides that a point moves over", 0.5, [0.0, 1.0])],
    generate: |job| jittered(job, job.number("amplitude")),
    ..JITTERED
};

pub(super) const MULTI_JITTERED: Pattern = Pattern {
    name: "multi-jittered",
    summary: "jittered, with one point in each of n rows and of n columns too; each row and column of cells shuffled by itself",
    source: "Chiu, Shirley and Wang 1994, Multi-jittered Sampling",
    generate: |job| multi_jittered(job, false),
    ..JITTERED
};

pub(super) const CORRELATED_MULTI_JITTERED: Pattern = Pattern {
    name: "correlated-multi-jittered",
    aliases: &["cmj"],
    summary: "multi-jittered, all columns shuffled alike and all rows alike: neighbours keep their distance",
    source: "Kensler 2013, Correlated Multi-Jittered Sampling",
    generate: |job| multi_jittered(job, true),
    ..JITTERED
};

pub(super) const N_ROOKS: Pattern = Pattern {
    name: "n-rooks",
    summary: "a random permutation: one point in each of n rows and of n columns (Latin hypercube)",
    source: "Shirley 1991, Discrepancy as a Quality Measure for Sample Distributions",
    counts: Counts::Any,
    parameters: &[Parameter::switch("centred", "1: at the middles of their fields, 0: anywhere in them", false)],
    generate: n_rooks,
    ..JITTERED
};

/// `n` cells of equal area: rows of nearly equal counts, each as high as its count asks for. For square n, the square grid.
/// Calls `point` with (row, rows, column, columns) and maps the answer from the cell into the square.
fn in_cells(n: u32, mut point: impl FnMut([u32; 4]) -> [f64; 2]) -> Vec<[f64; 2]> {
    let rows = row_count(n);
    let mut points = Vec::with_capacity(n as usize);
    for row in 0..rows {
        // The first `done` points fill the rows above; the difference of two floors spreads the remainder.
        let done = row * n / rows;
        let columns = (row + 1) * n / rows - done;
        for column in 0..columns {
            let [u, v] = point([row, rows, column, columns]);
            let x = (f64::from(column) + u) / f64::from(columns);
            let y = (f64::from(done) + v * f64::from(columns)) / f64::from(n);
            points.push([x, y]);
        }
    }
    points
}

fn row_count(n: u32) -> u32 {
    f64::from(n).sqrt().round() as u32
}

/// The positions that hardware has for 4 samples, and their like for other counts.
pub(super) fn rotated(n: u32) -> Vec<[f64; 2]> {
    in_cells(n, |[row, rows, column, columns]| {
        [1.0 - (f64::from(row) + 0.5) / f64::from(rows), (f64::from(column) + 0.5) / f64::from(columns)]
    })
}

fn jittered(job: &Job<'_>, amplitude: f64) -> Vec<[f64; 2]> {
    let mut chance = Stream::new(job.seed, 0);
    in_cells(job.n, |_| chance.point().map(|u| 0.5 + amplitude * (u - 0.5)))
}

/// Within its cell, a point's column is that of its row of cells, shuffled, and its row that of its column.
fn multi_jittered(job: &Job<'_>, correlated: bool) -> Vec<[f64; 2]> {
    let rows = row_count(job.n);
    let widest = job.n.div_ceil(rows);
    let mut orders = Stream::new(job.seed, 1);
    let mut shuffles = |count: u32, length: u32| -> Vec<Vec<u32>> {
        let first = orders.permutation(length);
        let rest = (1..count).map(|_| if correlated { first.clone() } else { orders.permutation(length) });
        std::iter::once(first.clone()).chain(rest.collect::<Vec<_>>()).collect()
    };
    let (across, down) = (shuffles(widest, rows), shuffles(rows, widest));
    let mut chance = Stream::new(job.seed, 0);
    in_cells(job.n, |[row, _, column, columns]| {
        let [u, v] = chance.point();
        let order = &down[row as usize];
        // In a row of fewer cells than the widest, the places that are left over are closed up.
        let place = order[..columns as usize].iter().filter(|other| **other < order[column as usize]).count();
        let x = f64::from(across[column as usize][row as usize]) + u;
        [x / f64::from(rows), (place as f64 + v) / f64::from(columns)]
    })
}

fn n_rooks(job: &Job<'_>) -> Vec<[f64; 2]> {
    let centred = job.switch("centred");
    let mut chance = Stream::new(job.seed, 0);
    let order = Stream::new(job.seed, 1).permutation(job.n);
    let field = |(column, row): (u32, u32)| {
        let [u, v] = if centred { [0.5, 0.5] } else { chance.point() };
        [(f64::from(column) + u) / f64::from(job.n), (f64::from(row) + v) / f64::from(job.n)]
    };
    (0..job.n).zip(order).map(field).collect()
}
