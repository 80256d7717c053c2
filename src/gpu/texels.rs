//! Texels as bytes, and as the numbers that they stand for: in and out of every format that a picture may have.
//!
//! Numbers are those stored: an `-srgb` format holds display values, whatever a shader makes of them.

use half::f16;
use wgpu::TextureFormat as Format;

use crate::error::{Error, Result};
use crate::picture::Pixel;

/// Pixels as a texture of this format stores them: rounded to nearest, kept in [0, 1] where the format ends there.
///
/// # Errors
/// [`Error::Unsupported`] for a format that no picture goes into.
pub fn encode_texels(format: Format, pixels: &[Pixel]) -> Result<Vec<u8>> {
    let each = |texel: fn(&Pixel) -> [u8; 4]| pixels.iter().flat_map(texel).collect();
    Ok(match format {
        Format::Rgba8Unorm | Format::Rgba8UnormSrgb => each(|p| p.map(|v| steps(v, 255) as u8)),
        Format::Bgra8Unorm | Format::Bgra8UnormSrgb => each(|[r, g, b, a]| [b, g, r, a].map(|v| steps(*v, 255) as u8)),
        Format::Rgb10a2Unorm => each(|[r, g, b, a]| {
            let [r, g, b] = [r, g, b].map(|v| steps(*v, 1023));
            (r | g << 10 | b << 20 | steps(*a, 3) << 30).to_le_bytes()
        }),
        Format::Rgba16Float => pixels.iter().flatten().flat_map(|v| f16::from_f32(*v).to_ne_bytes()).collect(),
        Format::Rgba32Float => bytemuck::cast_slice(pixels).to_vec(),
        other => return Err(Error::Unsupported(format!("a picture cannot be put into a texture of format {other:?}"))),
    })
}

/// Texels as f32 RGBA. One- and two-channel formats fill red and green, with blue 0 and alpha 1.
///
/// # Errors
/// [`Error::Unsupported`] for a format that holds no colours; [`Error::Gpu`] where there is no room.
pub fn decode_texels(format: Format, bytes: &[u8]) -> Result<Vec<Pixel>> {
    match format {
        Format::Rgba8Unorm | Format::Rgba8UnormSrgb => texels(bytes, |b: [u8; 4]| b.map(|x| f32::from(x) / 255.0)),
        Format::Bgra8Unorm | Format::Bgra8UnormSrgb => {
            texels(bytes, |[b, g, r, a]: [u8; 4]| [r, g, b, a].map(|x| f32::from(x) / 255.0))
        }
        Format::Rgb10a2Unorm => texels(bytes, |b: [u8; 4]| {
            let word = u32::from_le_bytes(b);
            let color = |shift: u32| ((word >> shift) & 1023) as f32 / 1023.0;
            [color(0), color(10), color(20), (word >> 30) as f32 / 3.0]
        }),
        Format::Rgba16Float => texels(bytes, |b: [u8; 8]| bytemuck::cast::<_, [u16; 4]>(b).map(|h| f16::from_bits(h).to_f32())),
        Format::Rgba32Float => texels(bytes, |b: [u8; 16]| bytemuck::cast(b)),
        Format::Rg32Float => texels(bytes, |b: [u8; 8]| {
            let [x, y]: [f32; 2] = bytemuck::cast(b);
            [x, y, 0.0, 1.0]
        }),
        Format::Depth32Float | Format::Depth32FloatStencil8 | Format::R32Float => {
            texels(bytes, |b: [u8; 4]| [f32::from_ne_bytes(b), 0.0, 0.0, 1.0])
        }
        Format::R32Uint => texels(bytes, |b: [u8; 4]| [u32::from_ne_bytes(b) as f32, 0.0, 0.0, 1.0]),
        other => Err(Error::Unsupported(format!("a texture of format {other:?} cannot be looked at"))),
    }
}

/// The nearest of `most` steps from 0 to 1; none for what is no number.
fn steps(value: f32, most: u32) -> u32 {
    (value.clamp(0.0, 1.0) * most as f32).round() as u32
}

fn texels<const N: usize>(bytes: &[u8], decode: impl Fn([u8; N]) -> Pixel) -> Result<Vec<Pixel>> {
    let texels = bytes.as_chunks::<N>().0;
    let mut pixels = memory_for(texels.len())?;
    pixels.extend(texels.iter().map(|texel| decode(*texel)));
    Ok(pixels)
}

/// An empty list with room for `count`: pictures are the one thing here that can be larger than memory.
pub(super) fn memory_for<T>(count: usize) -> Result<Vec<T>> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::Gpu {
        kind: "out of memory",
        message: format!("no room for {} bytes of picture; choose a smaller size", count.saturating_mul(size_of::<T>())),
    })?;
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLOR: Pixel = [1.0, 0.5, 0.25, 2.0 / 3.0];

    fn encoded(format: Format, pixel: Pixel) -> Vec<u8> {
        encode_texels(format, &[pixel]).expect("a picture's format")
    }

    #[test]
    fn channels_lie_where_the_format_says() {
        for format in [Format::Rgba8Unorm, Format::Rgba8UnormSrgb] {
            assert_eq!(encoded(format, COLOR), [255, 128, 64, 170]);
        }
        for format in [Format::Bgra8Unorm, Format::Bgra8UnormSrgb] {
            assert_eq!(encoded(format, COLOR), [64, 128, 255, 170]);
        }
        // Red lowest, alpha highest: 1023, 512 (511.5 rounded away from 0), 256 and 2.
        let word: u32 = 1023 | 512 << 10 | 256 << 20 | 2 << 30;
        assert_eq!(encoded(Format::Rgb10a2Unorm, COLOR), word.to_le_bytes());
    }

    #[test]
    fn what_a_format_cannot_hold_ends_at_its_ends() {
        for format in [Format::Rgba8Unorm, Format::Bgra8UnormSrgb, Format::Rgb10a2Unorm] {
            let pixels = encode_texels(format, &[[-1.0, f32::NAN, 7.0, f32::INFINITY]]).expect("a picture's format");
            assert_eq!(decode_texels(format, &pixels).expect("and back"), [[0.0, 0.0, 1.0, 1.0]], "{format:?}");
        }
    }

    #[test]
    fn every_step_comes_back() {
        let ramp = |most: u32| (0..=most).map(move |i| i as f32 / most as f32);
        let back = |format, pixels: &[Pixel]| {
            let bytes = encode_texels(format, pixels).expect("a picture's format");
            decode_texels(format, &bytes).expect("and back")
        };
        let ten: Vec<Pixel> = ramp(1023).map(|v| [v, 1.0 - v, v * v, (v * 3.0).round() / 3.0]).collect();
        for (pixel, found) in ten.iter().zip(back(Format::Rgb10a2Unorm, &ten)) {
            assert_eq!([pixel[0], pixel[3]], [found[0], found[3]]);
            assert!((pixel[1] - found[1]).abs() < 1e-6 && (pixel[2] - found[2]).abs() <= 0.5001 / 1023.0, "{pixel:?} {found:?}");
        }
        let eight: Vec<Pixel> = ramp(255).map(|v| [v, 0.0, 1.0, v]).collect();
        for format in [Format::Rgba8Unorm, Format::Bgra8Unorm, Format::Rgba32Float] {
            assert_eq!(back(format, &eight), eight, "{format:?}");
        }
    }

    #[test]
    fn formats_without_colours_are_refused() {
        assert!(encode_texels(Format::R32Uint, &[COLOR]).expect_err("no picture").to_string().contains("R32Uint"));
        assert!(decode_texels(Format::Rg8Snorm, &[0; 2]).expect_err("no picture").to_string().contains("Rg8Snorm"));
    }
}
