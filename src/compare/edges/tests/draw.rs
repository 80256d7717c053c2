//! Shapes drawn with many samples under a filter.

use super::text::{COLUMNS, Glyph, ROWS};
use crate::picture::{DisplayPicture, srgb_encode};

/// Side of the pictures in pixels; shapes are placed from their middle.
pub(super) const SIDE: u32 = 24;

/// Red, green and blue in linear light.
pub(super) type Light = [f64; 3];

pub(super) enum Shape {
    /// What lies before a line at an angle, `offset` pixels from the middle.
    HalfPlane { angle: f64, offset: f64 },
    /// Ten pixels wide.
    Square { angle: f64, centre: [f64; 2] },
    /// A letter whose strokes are so wide.
    Glyph { glyph: Glyph, stroke_px: f64, corner: [f64; 2] },
}

impl Shape {
    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        let middle = f64::from(SIDE) / 2.0;
        match self {
            Self::HalfPlane { .. } => self.signed([x, y]) < 0.0,
            Self::Square { angle, centre } => {
                let ((sine, cosine), u, v) = (angle.sin_cos(), x - middle - centre[0], y - middle - centre[1]);
                (u * cosine + v * sine).abs() < 5.0 && (v * cosine - u * sine).abs() < 5.0
            }
            Self::Glyph { glyph, stroke_px, corner } => {
                let (u, v) = ((x - corner[0]) / stroke_px, (y - corner[1]) / stroke_px);
                let inside = u >= 0.0 && v >= 0.0 && u < COLUMNS as f64 && v < ROWS as f64;
                inside && glyph[v as usize].as_bytes()[u as usize] == b'#'
            }
        }
    }

    /// Signed distance of a half plane's line from a pixel's centre, negative inside.
    pub(super) fn distance(&self, [x, y]: [u32; 2]) -> f64 {
        self.signed([f64::from(x) + 0.5, f64::from(y) + 0.5])
    }

    fn signed(&self, [x, y]: [f64; 2]) -> f64 {
        let middle = f64::from(SIDE) / 2.0;
        match self {
            Self::HalfPlane { angle, offset } => (x - middle) * angle.cos() + (y - middle) * angle.sin() - offset,
            _ => f64::NAN,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Filter {
    Box,
    /// One sample a pixel.
    Alone,
    /// Two by two samples.
    Grid,
    /// Four samples, no two in a row or a column.
    Rotated,
    /// Mixed in coded values.
    CodedBox,
    Tent,
    Gaussian,
    Mitchell,
    BlackmanHarris,
}

impl Filter {
    pub(super) const OTHERS: [Self; 8] = [
        Self::Alone,
        Self::Grid,
        Self::Rotated,
        Self::CodedBox,
        Self::Tent,
        Self::Gaussian,
        Self::Mitchell,
        Self::BlackmanHarris,
    ];

    fn radius(self) -> f64 {
        match self {
            Self::Tent => 1.0,
            Self::Gaussian => 1.5,
            Self::Mitchell | Self::BlackmanHarris => 2.0,
            _ => 0.5,
        }
    }

    fn weight(self, x: f64) -> f64 {
        let a = x.abs();
        match self {
            Self::Tent => 1.0 - a,
            Self::Gaussian => (-2.0 * x * x).exp(),
            Self::Mitchell if a < 1.0 => (7.0 * a * a * a - 12.0 * a * a + 16.0 / 3.0) / 6.0,
            Self::Mitchell => (-7.0 / 3.0 * a * a * a + 12.0 * a * a - 20.0 * a + 32.0 / 3.0) / 6.0,
            Self::BlackmanHarris => {
                let t = (x / 2.0 + 1.0) * std::f64::consts::PI;
                0.358_75 - 0.488_29 * t.cos() + 0.141_28 * (2.0 * t).cos() - 0.011_68 * (3.0 * t).cos()
            }
            _ => 1.0,
        }
    }

    /// Offsets from a pixel's centre and weights.
    fn samples(self) -> Vec<([f64; 2], f64)> {
        if self == Self::Rotated {
            return [[-1.0, -3.0], [3.0, -1.0], [-3.0, 1.0], [1.0, 3.0]]
                .map(|at| (at.map(|eighths| eighths / 8.0), 1.0))
                .to_vec();
        }
        let (count, radius) = match self {
            Self::Alone => (1, 0.5),
            Self::Grid => (2, 0.5),
            other => ((20.0 * other.radius()) as u32, other.radius()),
        };
        let place = |k: u32| ((f64::from(k) + 0.5) / f64::from(count) * 2.0 - 1.0) * radius;
        let all = (0..count).flat_map(|j| (0..count).map(move |i| [i, j]));
        all.map(|at| at.map(place)).map(|at| (at, self.weight(at[0]) * self.weight(at[1]))).collect()
    }
}

pub(super) fn draw(shape: &Shape, filter: Filter, [fore, back]: [Light; 2]) -> DisplayPicture {
    let samples = filter.samples();
    let weights: f64 = samples.iter().map(|(_, weight)| weight).sum();
    let coded = |light: Light| light.map(srgb_encode);
    let picture = DisplayPicture::from_fn(SIDE, SIDE, |x, y| {
        let held = samples.iter().filter(|(at, _)| shape.holds([f64::from(x) + 0.5 + at[0], f64::from(y) + 0.5 + at[1]]));
        let share = held.map(|(_, weight)| weight).sum::<f64>() / weights;
        let mix = |a: Light, b: Light| -> Light { std::array::from_fn(|k| share * a[k] + (1.0 - share) * b[k]) };
        let [r, g, b] = if filter == Filter::CodedBox {
            mix(coded(fore), coded(back))
        } else {
            coded(mix(fore, back).map(|light| light.clamp(0.0, 1.0)))
        };
        [r as f32, g as f32, b as f32, 1.0]
    });
    picture.expect("a size").quantized(crate::picture::BitDepth::Eight)
}

/// A number that looks random, of a counter (splitmix64).
pub(super) fn mixed(counter: u64) -> u64 {
    let mut z = counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// In [0, 1).
pub(super) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
