//! Discrepancies over boxes that are anchored at the origin.

use super::count;

/// The star discrepancy: the largest difference between the volume of a box anchored at the origin and its share of the points
/// (Zaremba 1968 for its use in integration). Exact, in O(n^2).
///
/// The supremum is met at corners whose coordinates are coordinates of points, or 1: with the points on the box's far sides left out
/// where the box has too few, counted where it has too many. Points enter from left to right, so each column of corners is one walk
/// over the sorted heights. Points of equal coordinates are counted too early or too late at some corners, but only
/// where that makes the difference smaller than at their last or first one.
#[must_use]
pub fn star(points: &[[f64; 2]]) -> f64 {
    let n = count(points);
    let mut by_x: Vec<usize> = (0..points.len()).collect();
    by_x.sort_by(|&i, &j| points[i][0].total_cmp(&points[j][0]));
    let mut by_y = by_x.clone();
    by_y.sort_by(|&i, &j| points[i][1].total_cmp(&points[j][1]));
    let heights: Vec<f64> = by_y.iter().map(|&i| points[i][1]).collect();
    let mut rank = vec![0; points.len()];
    for (r, &i) in by_y.iter().enumerate() {
        rank[i] = r;
    }

    let mut present = vec![0u32; points.len()];
    let mut most = 0.0f64;
    for &i in &by_x {
        let x = points[i][0];
        most = most.max(too_few(x, &heights, &present, n));
        present[rank[i]] = 1;
        most = most.max(too_many(x, &heights, &present, n));
    }
    most.max(too_few(1.0, &heights, &present, n))
}

/// The most that the volume of a box of this width exceeds its share of the points that are present, its far sides left out.
fn too_few(width: f64, heights: &[f64], present: &[u32], n: f64) -> f64 {
    let (mut most, mut below) = (0.0f64, 0);
    for (height, there) in heights.iter().zip(present) {
        most = most.max(width * height - f64::from(below) / n);
        below += there;
    }
    most.max(width - f64::from(below) / n)
}

/// The most that its share of the points exceeds the volume of a box of this width, its far sides counted.
fn too_many(width: f64, heights: &[f64], present: &[u32], n: f64) -> f64 {
    let (mut most, mut below) = (0.0f64, 0);
    for (height, there) in heights.iter().zip(present) {
        below += there;
        most = most.max(f64::from(below) / n - width * height);
    }
    most
}

/// The root mean square of the same difference over all boxes, by Warnock's closed form (1972), in O(n^2).
#[must_use]
pub fn star_l2(points: &[[f64; 2]]) -> f64 {
    let n = count(points);
    let shared = |a: &[f64; 2], b: &[f64; 2]| (1.0 - a[0].max(b[0])) * (1.0 - a[1].max(b[1]));
    let singles: f64 = points.iter().map(|p| (1.0 - p[0] * p[0]) * (1.0 - p[1] * p[1])).sum();
    let pairs: f64 = super::rectangles::sum_over_pairs(points, shared);
    (1.0 / 9.0 - singles / (2.0 * n) + pairs / (n * n)).max(0.0).sqrt()
}

/// Share of the points in a box less its volume, for boxes from the origin to each corner ((k + 1) / `side`, (l + 1) / `side`), far
/// sides left out: rows of `side` values, l outside. A map of what [`star`] is the largest value of. O(n + side^2).
#[must_use]
pub fn deviations(points: &[[f64; 2]], side: usize) -> Vec<f64> {
    let counts = counts_below(points, side);
    let (n, side_length) = (count(points), side as f64);
    let corner = |l: usize, k: usize| counts[l * (side + 1) + k] / n - (k * l) as f64 / (side_length * side_length);
    (1..=side).flat_map(|l| (1..=side).map(move |k| (l, k))).map(|(l, k)| corner(l, k)).collect()
}

/// Points below and left of each corner (k / `lines`, l / `lines`), k and l from 0: a summed-area table of `lines` + 1 a side.
pub(super) fn counts_below(points: &[[f64; 2]], lines: usize) -> Vec<f64> {
    let side = lines + 1;
    let mut table = vec![0.0; side * side];
    for p in points {
        // Into the first corner that has the point strictly within.
        let [k, l] = p.map(|u| ((u * lines as f64).floor() as usize + 1).min(lines));
        table[l * side + k] += 1.0;
    }
    for l in 1..side {
        let mut row = 0.0;
        for k in 1..side {
            row += table[l * side + k];
            table[l * side + k] = row + table[(l - 1) * side + k];
        }
    }
    table
}
