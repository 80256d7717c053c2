//! Discrepancies over all axis-parallel rectangles, wherever they are.

use super::count;
use super::star::counts_below;

/// Root mean square, over all axis-parallel rectangles in the square, of area less share of the points (Stroud 1971; twice the T_N of
/// Morokoff and Caflisch 1994, who divide by more rectangles than there are). Closed form, in O(n^2).
#[must_use]
pub fn stroud(points: &[[f64; 2]]) -> f64 {
    let n = count(points);
    // The share of all intervals that hold both of two places.
    let shared = |a: f64, b: f64| a.min(b) * (1.0 - a.max(b));
    let pairs = sum_over_pairs(points, |a, b| shared(a[0], b[0]) * shared(a[1], b[1]));
    let singles: f64 = points.iter().map(|p| shared(p[0], p[0]) * shared(p[1], p[1])).sum();
    (4.0 * pairs / (n * n) - 2.0 * singles / n + 4.0 / 144.0).max(0.0).sqrt()
}

/// The same over the rectangles of the torus, which leave the square on one side and come back on the other. It does not change
/// when all points are shifted. Closed form, in O(n^2).
#[must_use]
pub fn stroud_torus(points: &[[f64; 2]]) -> f64 {
    let n = count(points);
    let shared = |a: f64, b: f64| {
        let apart = (a - b).abs();
        0.5 * (apart * apart + (1.0 - apart) * (1.0 - apart))
    };
    let pairs = sum_over_pairs(points, |a, b| shared(a[0], b[0]) * shared(a[1], b[1]));
    // Where a point is makes no difference by itself: over all rectangles, area times holding it is 1/9, and so is squared area.
    let rest = if points.is_empty() { 1.0 / 9.0 } else { -1.0 / 9.0 };
    (pairs / (n * n) + rest).max(0.0).sqrt()
}

/// [`stroud`] over those rectangles only whose corners lie on a lattice of `lines` steps a side (at least 1): a quadrature that some
/// published tables were made with, about 1 % larger at 100 steps and 1024 points. Left and lower sides count, far sides do not.
/// O(n + lines^2).
///
/// With D the deviation at a corner, a rectangle's is the alternating sum of D over its four corners. For each axis the sum of squared
/// differences over all pairs is (lines + 1) times the sum of squares less the square of the sum, so no rectangle has to be visited.
#[must_use]
pub fn stroud_on_lattice(points: &[[f64; 2]], lines: u32) -> f64 {
    let (steps, side) = (lines as usize, lines as usize + 1);
    let (n, lines) = (count(points), f64::from(lines));
    let counts = counts_below(points, steps);
    let deviation = |l: usize, k: usize| counts[l * side + k] / n - (k * l) as f64 / (lines * lines);
    let mut columns = vec![0.0; side];
    let (mut squares, mut squared_rows, mut all) = (0.0, 0.0, 0.0);
    for l in 0..side {
        let mut row = 0.0;
        for (k, column) in columns.iter_mut().enumerate() {
            let d = deviation(l, k);
            squares += d * d;
            row += d;
            *column += d;
        }
        squared_rows += row * row;
        all += row;
    }
    let squared_columns: f64 = columns.iter().map(|c| c * c).sum();
    let corners = lines + 1.0;
    let sum = corners * (corners * squares - squared_rows - squared_columns) + all * all;
    let intervals = lines * corners / 2.0;
    (sum / (intervals * intervals)).max(0.0).sqrt()
}

/// The sum of a symmetric function over all ordered pairs, those of a point with itself among them.
pub(super) fn sum_over_pairs(points: &[[f64; 2]], of: impl Fn(&[f64; 2], &[f64; 2]) -> f64) -> f64 {
    let row = |(i, a): (usize, &[f64; 2])| of(a, a) + 2.0 * points[..i].iter().map(|b| of(a, b)).sum::<f64>();
    points.iter().enumerate().map(row).sum()
}
