//! Reconstruction filters: a sample's weight by its distance from the pixel's centre, a product of one function an axis.

use std::f64::consts::PI;

use crate::error::{Result, unknown};

/// A reconstruction filter. Weights are not normalised: whoever uses them divides by their sum.
#[derive(Debug)]
pub struct Filter {
    /// As in `filter=NAME`.
    pub name: &'static str,
    /// What it is, in a line.
    pub summary: &'static str,
    /// Radius of the support in pixels unless another is asked for.
    pub default_radius_px: f64,
    /// Distance along one axis in pixels, radius in pixels -> weight. Asked only within the radius.
    profile: fn(f64, f64) -> f64,
}

impl Filter {
    /// Weight of a sample at `offset_px` from the pixel's centre under a support of `radius_px` (above 0). Zero outside.
    #[must_use]
    pub fn weight(&self, offset_px: [f64; 2], radius_px: f64) -> f64 {
        if offset_px.iter().any(|x| x.abs() > radius_px) {
            return 0.0;
        }
        offset_px.iter().map(|x| (self.profile)(x.abs(), radius_px)).product()
    }
}

/// Every filter there is.
pub const FILTERS: &[Filter] = &[
    Filter {
        name: "box",
        summary: "the mean over the support; radius 0.5 is the pixel itself",
        default_radius_px: 0.5,
        profile: |_, _| 1.0,
    },
    Filter { name: "tent", summary: "falls linearly to zero at the radius", default_radius_px: 1.0, profile: |x, r| 1.0 - x / r },
    Filter {
        name: "gaussian",
        summary: "a bell of standard deviation radius/3, lowered to reach zero at the radius",
        default_radius_px: 1.5,
        profile: gaussian,
    },
    Filter {
        name: "blackman-harris",
        summary: "the four-term window (Harris 1978): bell-shaped, zero at the radius",
        default_radius_px: 1.5,
        profile: blackman_harris,
    },
    Filter {
        name: "b-spline",
        summary: "the cubic B-spline: very smooth, blurs",
        default_radius_px: 2.0,
        profile: |x, r| cubic(1.0, 0.0, 2.0 * x / r),
    },
    Filter {
        name: "mitchell",
        summary: "B = C = 1/3 (Mitchell and Netravali 1988): the compromise of blur and ringing",
        default_radius_px: 2.0,
        profile: |x, r| cubic(1.0 / 3.0, 1.0 / 3.0, 2.0 * x / r),
    },
    Filter {
        name: "catmull-rom",
        summary: "B = 0, C = 1/2 (Catmull and Rom 1974): sharp, rings at hard edges",
        default_radius_px: 2.0,
        profile: |x, r| cubic(0.0, 0.5, 2.0 * x / r),
    },
    Filter {
        name: "lanczos",
        summary: "a windowed sinc with as many lobes as the radius: sharpest, rings most",
        default_radius_px: 3.0,
        profile: |x, r| sinc(x) * sinc(x / r),
    },
];

/// The filter of this name.
///
/// # Errors
/// [`crate::Error::Request`] that lists the names.
pub fn filter(name: &str) -> Result<&'static Filter> {
    FILTERS.iter().find(|f| f.name == name).ok_or_else(|| {
        let names: Vec<_> = FILTERS.iter().map(|f| f.name).collect();
        unknown("filter", name, &names)
    })
}

fn gaussian(x: f64, radius: f64) -> f64 {
    let bell = |x: f64| (-4.5 * (x / radius) * (x / radius)).exp();
    bell(x) - bell(radius)
}

fn blackman_harris(x: f64, radius: f64) -> f64 {
    const TERMS: [f64; 4] = [0.35875, 0.48829, 0.14128, 0.01168];
    let phase = PI * x / radius;
    // Counted from the window's middle all signs are plus.
    TERMS.iter().zip(0u8..).map(|(a, k)| a * (f64::from(k) * phase).cos()).sum()
}

/// The two-parameter family of cubics (Mitchell and Netravali 1988, eq. 8) times 6, on [0, 2].
fn cubic(b: f64, c: f64, x: f64) -> f64 {
    if x < 1.0 {
        ((12.0 - 9.0 * b - 6.0 * c) * x + (-18.0 + 12.0 * b + 6.0 * c)) * x * x + (6.0 - 2.0 * b)
    } else {
        (((-b - 6.0 * c) * x + (6.0 * b + 30.0 * c)) * x + (-12.0 * b - 48.0 * c)) * x + (8.0 * b + 24.0 * c)
    }
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-9 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_filter_peaks_at_the_centre_and_ends_at_the_radius() {
        for f in FILTERS {
            for radius in [0.25, 0.5, 1.0, 1.7, f.default_radius_px] {
                let weight = |x: f64, y: f64| f.weight([x * radius, y * radius], radius);
                assert!(weight(0.0, 0.0) > 0.0, "{}", f.name);
                assert_eq!(weight(1.001, 0.0), 0.0, "{}", f.name);
                for step in 0..=20 {
                    let x = f64::from(step) / 20.0;
                    assert!(weight(x, 0.3) <= weight(0.0, 0.3) + 1e-12, "{} at {x}", f.name);
                    assert_eq!(weight(x, 0.3), weight(-x, 0.3), "{} at {x}", f.name);
                    assert_eq!(weight(x, 0.3), weight(0.3, -x), "{} at {x}", f.name);
                }
                if f.name != "box" {
                    assert!(weight(1.0, 0.0).abs() < 1e-3 * weight(0.0, 0.0), "{}", f.name);
                }
            }
        }
    }

    #[test]
    fn cubics_at_their_natural_radius_sum_to_one_over_the_pixels() {
        for name in ["b-spline", "mitchell", "catmull-rom"] {
            let f = filter(name).expect("exists");
            for phase in [0.0, 0.1, 0.37, 0.5] {
                let sum: f64 = (-3..=3).map(|i| (f.profile)((f64::from(i) + phase).abs().min(2.0), 2.0)).sum();
                assert!((sum / 6.0 - 1.0).abs() < 1e-12, "{name} {phase}: {sum}");
            }
        }
    }

    #[test]
    fn sharp_filters_have_negative_lobes_and_soft_ones_none() {
        let lowest = |name: &str| {
            let f = filter(name).expect("exists");
            (0..100).map(|i| (f.profile)(f64::from(i) * 0.01 * f.default_radius_px, f.default_radius_px)).fold(0.0, f64::min)
        };
        assert!(["mitchell", "catmull-rom", "lanczos"].iter().all(|n| lowest(n) < -0.01));
        assert!(["box", "tent", "gaussian", "blackman-harris", "b-spline"].iter().all(|n| lowest(n) > -1e-4));
    }
}
