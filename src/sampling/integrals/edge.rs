//! Straight edges across a pixel.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::PixelFunction;
use crate::sampling::hash;

const EDGES: u64 = 200_000;

/// Half-planes, one a pixel: x with normal . (x - centre) < offset.
#[derive(Debug)]
struct HalfPlanes {
    planes: Vec<HalfPlane>,
}

#[derive(Debug, Clone, Copy)]
struct HalfPlane {
    normal: [f64; 2],
    /// In pixels from the pixel's centre along the normal.
    offset: f64,
}

/// Directions uniform over the circle.
pub(super) fn any_direction() -> (Box<dyn PixelFunction>, Vec<f64>) {
    half_planes(|[direction, _]| direction * TAU)
}

/// Directions uniform within atan(1/8) of the four axes.
pub(super) fn near_axes() -> (Box<dyn PixelFunction>, Vec<f64>) {
    let most = (1.0f64 / 8.0).atan();
    half_planes(|[direction, quarter]| (4.0 * quarter).floor() * FRAC_PI_2 + (2.0 * direction - 1.0) * most)
}

/// With offsets uniform over those that cross the pixel.
fn half_planes(angle: impl Fn([f64; 2]) -> f64) -> (Box<dyn PixelFunction>, Vec<f64>) {
    let plane = |i: u64| {
        let [direction, quarter, offset] = [0, 1, 2].map(|k| uniform(3 * i + k));
        let (sin, cos) = angle([direction, quarter]).sin_cos();
        HalfPlane { normal: [cos, sin], offset: (offset - 0.5) * (cos.abs() + sin.abs()) }
    };
    let planes: Vec<HalfPlane> = (0..EDGES).map(plane).collect();
    let exact = planes.iter().map(HalfPlane::area).collect();
    (Box::new(HalfPlanes { planes }), exact)
}

fn uniform(index: u64) -> f64 {
    (hash(index) >> 11) as f64 / (1u64 << 53) as f64
}

impl PixelFunction for HalfPlanes {
    fn value(&self, pixel: usize, at: [f64; 2]) -> f64 {
        let HalfPlane { normal, offset } = self.planes[pixel];
        f64::from(normal[0] * (at[0] - 0.5) + normal[1] * (at[1] - 0.5) < offset)
    }
}

impl HalfPlane {
    /// Of its part of the pixel: the projection of the pixel onto the normal is a trapezoid, and this is its integral.
    fn area(&self) -> f64 {
        let [a, b] = self.normal.map(|x| 0.5 * x.abs());
        let (long, short) = (a.max(b), a.min(b));
        // The two ramps' difference would vanish in rounding.
        if short < 1e-9 {
            return (self.offset / (2.0 * long) + 0.5).clamp(0.0, 1.0);
        }
        let ramp = |t: f64| (self.offset + t).max(0.0).powi(2);
        let area = ramp(long + short) - ramp(long - short) - ramp(short - long) + ramp(-long - short);
        area / (8.0 * long * short)
    }
}
