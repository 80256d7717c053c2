//! Structural similarity.
//!
//! Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli: Image Quality Assessment: From Error Visibility to Structural
//! Similarity, IEEE Transactions on Image Processing 13(4), 2004. As there: a circular Gaussian window of 11x11 with a standard
//! deviation of 1.5 pixels, K1 = 0.01, K2 = 0.03, dynamic range 1, population variances and covariance. The index is taken
//! for each colour channel where the window lies wholly inside, that is without a border of 5 pixels, and averaged.

use super::{Figure, Pair};
use crate::picture::DisplayPicture;
use rayon::prelude::*;

/// Side of the window in pixels.
pub(super) const WINDOW: usize = 11;

const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// The weighted means under a window: candidate, reference, their squares, and their product.
type Moments = [f64; 5];

/// Mean SSIM over red, green and blue; does not apply to pictures that are smaller than the window.
pub(super) fn ssim(pair: &Pair<'_>) -> Figure {
    let sides = pair.display();
    if pair.size().into_iter().any(|side| (side as usize) < WINDOW) {
        return Figure::NotApplicable;
    }
    let width = sides.reference.width() as usize;
    let index = |channel| plane_mean(width, &plane(sides.candidate, channel), &plane(sides.reference, channel));
    Figure::from((0..3).map(index).sum::<f64>() / 3.0)
}

/// One channel of a picture.
pub(super) fn plane(picture: &DisplayPicture, channel: usize) -> Vec<f64> {
    picture.pixels().iter().map(|pixel| f64::from(pixel[channel])).collect()
}

/// One dimension of the separable window, its weights summing to 1.
fn gaussian_window() -> [f64; WINDOW] {
    let centre = (WINDOW / 2) as f64;
    let weights: [f64; WINDOW] = std::array::from_fn(|i| (-0.5 * ((i as f64 - centre) / SIGMA).powi(2)).exp());
    let sum: f64 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}

/// Mean index of two planes of one size, at least as large as the window, whose rows are `width` values.
pub(super) fn plane_mean(width: usize, candidate: &[f64], reference: &[f64]) -> f64 {
    mean_where(width, [candidate, reference], |_, _| true).unwrap_or(f64::NAN)
}

/// The mean over those windows whose middle, a column and a row, is wanted; none where no window fits or is wanted.
pub(super) fn mean_where(width: usize, planes: [&[f64]; 2], wanted: impl Fn(usize, usize) -> bool + Sync) -> Option<f64> {
    let (sum, count) = sum_where(width, planes, wanted);
    (count > 0).then(|| sum / count as f64)
}

/// The sum over those windows whose middle is wanted, and how many they are.
pub(super) fn sum_where(width: usize, planes: [&[f64]; 2], wanted: impl Fn(usize, usize) -> bool + Sync) -> (f64, usize) {
    if width < WINDOW || planes[0].len() / width < WINDOW {
        return (0.0, 0);
    }
    let window = gaussian_window();
    let rows: Vec<Vec<Moments>> = planes[0]
        .par_chunks_exact(width)
        .zip(planes[1].par_chunks_exact(width))
        .map(|(candidate, reference)| filter_row(candidate, reference, &window))
        .collect();
    // One sum a row, added in order: the same bits for any number of threads.
    let middle = WINDOW / 2;
    let sums: Vec<(f64, usize)> = rows
        .par_windows(WINDOW)
        .enumerate()
        .map(|(y, rows)| index_sum(rows, &window, |x| wanted(x + middle, y + middle)))
        .collect();
    sums.iter().fold((0.0, 0), |(sum, count), row| (sum + row.0, count + row.1))
}

/// The moments of a row, weighted along it, for each place where the window fits.
fn filter_row(candidate: &[f64], reference: &[f64], window: &[f64; WINDOW]) -> Vec<Moments> {
    let products: Vec<Moments> = candidate.iter().zip(reference).map(|(&t, &r)| [t, r, t * t, r * r, t * r]).collect();
    products.windows(WINDOW).map(|under| weighted(under.iter(), window)).collect()
}

/// The sum of the index along one row of windows, given the filtered rows that the windows span, and how many were wanted.
fn index_sum(rows: &[Vec<Moments>], window: &[f64; WINDOW], wanted: impl Fn(usize) -> bool) -> (f64, usize) {
    let places = (0..rows[0].len()).filter(|x| wanted(*x));
    let indices = places.map(|x| index(weighted(rows.iter().map(|row| &row[x]), window)));
    indices.fold((0.0, 0), |(sum, count), index| (sum + index, count + 1))
}

fn weighted<'m>(moments: impl Iterator<Item = &'m Moments>, window: &[f64; WINDOW]) -> Moments {
    let mut sum = [0.0; 5];
    for (moments, weight) in moments.zip(window) {
        for (sum, moment) in sum.iter_mut().zip(moments) {
            *sum += weight * moment;
        }
    }
    sum
}

/// The index of one window.
fn index([t, r, tt, rr, tr]: Moments) -> f64 {
    let (variance_t, variance_r, covariance) = (tt - t * t, rr - r * r, tr - t * r);
    let luminance = (2.0 * t * r + C1) / (t * t + r * r + C1);
    let contrast_and_structure = (2.0 * covariance + C2) / (variance_t + variance_r + C2);
    luminance * contrast_and_structure
}
