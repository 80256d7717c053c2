//! Display pictures in 8 and 16 bit integers. Levels are rounded half up; what lies outside [0, 1] is clamped, NaN becomes 0.

use super::DisplayPicture;
use crate::{Error, Result};

/// Bits of a channel in an integer picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BitDepth {
    /// 256 levels.
    Eight,
    /// 65 536 levels.
    Sixteen,
}

impl BitDepth {
    /// The depth of that many bits; anything but 8 and 16 is an [`Error::Request`].
    pub fn from_bits(bits: u32) -> Result<Self> {
        match bits {
            8 => Ok(Self::Eight),
            16 => Ok(Self::Sixteen),
            _ => Err(Error::Request(format!("{bits} bits a channel cannot be written; choose 8 or 16"))),
        }
    }

    /// The highest level: 255 or 65 535.
    #[must_use]
    pub fn max_level(self) -> u16 {
        match self {
            Self::Eight => 255,
            Self::Sixteen => 65_535,
        }
    }
}

/// The nearest of the levels 0 to `max` to a value in [0, 1].
pub(super) fn level(value: f32, max: u16) -> u16 {
    // In f64 the product is exact, so a value that was made from a level always returns to it.
    (f64::from(value.clamp(0.0, 1.0)) * f64::from(max) + 0.5).floor() as u16
}

impl DisplayPicture {
    /// From bytes in the order red, green, blue, alpha. Not exactly `4 * width * height` of them is an [`Error::Request`].
    pub fn from_rgba8(width: u32, height: u32, bytes: &[u8]) -> Result<Self> {
        Self::from_levels(width, height, bytes, |byte| f32::from(byte) / 255.0)
    }

    /// From 16 bit levels in the order red, green, blue, alpha. Not exactly `4 * width * height` of them is an
    /// [`Error::Request`].
    pub fn from_rgba16(width: u32, height: u32, levels: &[u16]) -> Result<Self> {
        Self::from_levels(width, height, levels, |level| f32::from(level) / 65_535.0)
    }

    fn from_levels<T: Copy>(width: u32, height: u32, levels: &[T], value: impl Fn(T) -> f32) -> Result<Self> {
        let (pixels, rest) = levels.as_chunks::<4>();
        if !rest.is_empty() {
            return Err(Error::Request(format!("{} channel values are no whole number of RGBA pixels", levels.len())));
        }
        Self::new(width, height, pixels.iter().map(|pixel| pixel.map(&value)).collect())
    }

    /// Bytes in the order red, green, blue, alpha.
    #[must_use]
    pub fn to_rgba8(&self) -> Vec<u8> {
        self.channels().map(|value| level(value, 255) as u8).collect()
    }

    /// 16 bit levels in the order red, green, blue, alpha.
    #[must_use]
    pub fn to_rgba16(&self) -> Vec<u16> {
        self.channels().map(|value| level(value, 65_535)).collect()
    }

    /// The picture as it comes back from a file of that depth: each channel, alpha too, on one of its levels.
    #[must_use]
    pub fn quantized(&self, depth: BitDepth) -> Self {
        let max = depth.max_level();
        let snap = |value: f32| f32::from(level(value, max)) / f32::from(max);
        Self::assemble(self.size(), self.pixels().iter().map(|pixel| pixel.map(snap)).collect())
    }

    fn channels(&self) -> impl Iterator<Item = f32> + '_ {
        self.pixels().iter().flatten().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_round_half_up_and_clamp() {
        let half = 0.5 / 255.0;
        let picture = DisplayPicture::new(2, 1, vec![[half, half * 0.999, -3.0, 1.5], [f32::NAN, 1.0, 0.5, f32::INFINITY]]);
        assert_eq!(picture.expect("2 pixels").to_rgba8(), [1, 0, 0, 255, 0, 255, 128, 255]);
    }

    #[test]
    fn every_16_bit_level_survives() {
        let levels: Vec<u16> = (0..=65_535).collect();
        let picture = DisplayPicture::from_rgba16(128, 128, &levels).expect("128x128 pixels");
        assert_eq!(picture.to_rgba16(), levels);
        assert_eq!(picture.quantized(BitDepth::Sixteen), picture);
    }

    #[test]
    fn quantizing_is_what_a_file_of_that_depth_does() {
        let picture = DisplayPicture::new(2, 1, vec![[0.1, 0.2, 0.3, 0.4], [0.501, 0.7, 0.9, 1.0]]).expect("2 pixels");
        let through_bytes = DisplayPicture::from_rgba8(2, 1, &picture.to_rgba8()).expect("2 pixels");
        assert_eq!(picture.quantized(BitDepth::Eight), through_bytes);
        assert_ne!(picture.quantized(BitDepth::Sixteen), through_bytes);
    }

    #[test]
    fn other_depths_and_half_pixels_are_refused() {
        assert!(BitDepth::from_bits(12).is_err());
        assert_eq!(BitDepth::from_bits(16).expect("exists"), BitDepth::Sixteen);
        assert!(DisplayPicture::from_rgba8(1, 1, &[0; 5]).is_err());
    }
}
