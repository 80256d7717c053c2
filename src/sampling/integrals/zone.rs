//! A zone plate.

use super::fresnel::fresnel;
use super::{PixelFunction, SIDE};

/// Of the phase: radians a squared pixel.
const CHIRP: f64 = 4.0 * std::f64::consts::PI / 256.0;

#[derive(Debug)]
struct ZonePlate;

/// The phase is a sum over the axes, so a pixel's mean is the real part of a product of two Fresnel integrals.
pub(super) fn with_means() -> (Box<dyn PixelFunction>, Vec<f64>) {
    let scale = (2.0 * CHIRP / std::f64::consts::PI).sqrt();
    let up_to: Vec<[f64; 2]> = (0..=SIDE).map(|x| fresnel(scale * x as f64).map(|part| part / scale)).collect();
    let of_pixel: Vec<[f64; 2]> = up_to.windows(2).map(|ends| [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]]).collect();
    let mean = |x: &[f64; 2], y: &[f64; 2]| 0.5 + 0.5 * (x[0] * y[0] - x[1] * y[1]);
    let exact = of_pixel.iter().flat_map(|y| of_pixel.iter().map(move |x| mean(x, y))).collect();
    (Box::new(ZonePlate), exact)
}

impl PixelFunction for ZonePlate {
    fn value(&self, pixel: usize, at: [f64; 2]) -> f64 {
        let [x, y] = [(pixel % SIDE) as f64 + at[0], (pixel / SIDE) as f64 + at[1]];
        0.5 + 0.5 * (CHIRP * (x * x + y * y)).cos()
    }
}
