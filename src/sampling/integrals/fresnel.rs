//! The Fresnel integrals.

use std::f64::consts::{FRAC_PI_2, PI};

/// Below, the power series; above, the continued fraction.
const SERIES_UP_TO: f64 = 1.6;

/// Terms that bring the series to f64's precision up to [`SERIES_UP_TO`].
const TERMS: u32 = 32;

/// Levels that bring the fraction there from [`SERIES_UP_TO`] on.
const LEVELS: u32 = 120;

/// C(t) and S(t): the integrals of cos and sin of pi s^2 / 2 for s from 0 to t, for any t at least 0, to about 1e-14
/// (Abramowitz and Stegun 1964, chapter 7).
pub(super) fn fresnel(t: f64) -> [f64; 2] {
    if t < SERIES_UP_TO { series(t) } else { fraction(t) }
}

/// The sum of (i pi / 2)^k t^(2k+1) / (k! (2k+1)).
fn series(t: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    let mut term = [t, 0.0];
    for k in 0..TERMS {
        let weight = f64::from(2 * k + 1);
        sum = [sum[0] + term[0] / weight, sum[1] + term[1] / weight];
        let step = FRAC_PI_2 * t * t / f64::from(k + 1);
        term = [-step * term[1], step * term[0]];
    }
    sum
}

/// (1 + i) / 2 (1 - erfc z) at z = (1 - i) t sqrt(pi) / 2, with erfc z = exp(-z^2) / sqrt(pi) / (z + 1/2 / (z + 2/2 / (z + ...))).
fn fraction(t: f64) -> [f64; 2] {
    let z = [0.5 * PI.sqrt() * t, -0.5 * PI.sqrt() * t];
    let mut below = z;
    for level in (1..=LEVELS).rev() {
        let step = divide([0.5 * f64::from(level), 0.0], below);
        below = [z[0] + step[0], z[1] + step[1]];
    }
    // The phase modulo 2 pi before the cosine, which would lose digits.
    let (sin, cos) = (FRAC_PI_2 * (t * t).rem_euclid(4.0)).sin_cos();
    let erfc = divide([cos / PI.sqrt(), sin / PI.sqrt()], below);
    let erf = [1.0 - erfc[0], -erfc[1]];
    [0.5 * (erf[0] - erf[1]), 0.5 * (erf[0] + erf[1])]
}

fn divide(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let length = b[0] * b[0] + b[1] * b[1];
    [(a[0] * b[0] + a[1] * b[1]) / length, (a[1] * b[0] - a[0] * b[1]) / length]
}
