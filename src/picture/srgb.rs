//! The sRGB transfer function (IEC 61966-2-1) in its exact piecewise form, and pictures converted by it.

use super::{DisplayPicture, LinearPicture, Pixel};
use rayon::prelude::*;

/// sRGB-codes one linear value. Values outside [0, 1] are not clamped here: the linear segment continues below 0, the power
/// above 1.
#[must_use]
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// The linear value of one sRGB-coded value: the inverse of [`srgb_encode`].
#[must_use]
pub fn srgb_decode(coded: f64) -> f64 {
    if coded <= 0.040_45 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

impl LinearPicture {
    /// Clamps to [0, 1], then sRGB-codes red, green and blue; alpha is coverage and only clamped. NaN stays NaN, so that it can
    /// still be counted.
    #[must_use]
    pub fn to_display(&self) -> DisplayPicture {
        self.convert(|[r, g, b, a]| {
            let code = |x: f32| srgb_encode(f64::from(x.clamp(0.0, 1.0))) as f32;
            [code(r), code(g), code(b), a.clamp(0.0, 1.0)]
        })
    }
}

impl DisplayPicture {
    /// Decodes red, green and blue to linear light; alpha is coverage and stays as it is.
    #[must_use]
    pub fn to_linear(&self) -> LinearPicture {
        self.convert(|[r, g, b, a]| {
            let decode = |x: f32| srgb_decode(f64::from(x)) as f32;
            [decode(r), decode(g), decode(b), a]
        })
    }
}

impl<E: Sync> super::Picture<E> {
    /// A picture of the same size and another encoding, pixel by pixel.
    fn convert<F>(&self, convert: impl Fn(Pixel) -> Pixel + Sync) -> super::Picture<F> {
        super::Picture::assemble(self.size(), self.pixels().par_iter().map(|&pixel| convert(pixel)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coding_meets_known_values() {
        for (linear, coded) in [(0.0, 0.0), (1.0, 1.0), (0.5, 0.735_356_983_052), (0.18, 0.461_356_129_500), (0.001, 0.01292)] {
            assert!((srgb_encode(linear) - coded).abs() < 1e-9, "{linear} -> {}", srgb_encode(linear));
            assert!((srgb_decode(coded) - linear).abs() < 1e-9, "{coded} -> {}", srgb_decode(coded));
        }
    }

    #[test]
    fn every_8_bit_level_survives_the_way_to_linear_and_back() {
        let levels: Vec<u8> = (0..=255).flat_map(|v| [v, 255 - v, v / 2, v]).collect();
        let picture = DisplayPicture::from_rgba8(256, 1, &levels).expect("256 pixels");
        assert_eq!(picture.to_linear().to_display().to_rgba8(), levels);
    }

    #[test]
    fn display_values_are_clamped_but_nan_remains() {
        let picture =
            LinearPicture::new(2, 1, vec![[-1.0, 9.0, f32::INFINITY, 2.0], [f32::NAN, 0.0, 0.0, 1.0]]).expect("2 pixels");
        let display = picture.to_display();
        assert_eq!(display.pixel(0, 0), [0.0, 1.0, 1.0, 1.0]);
        assert!(display.pixel(1, 0)[0].is_nan());
    }
}
