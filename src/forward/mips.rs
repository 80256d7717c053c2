//! Mip levels on the CPU: the same bytes on every adapter.

use crate::picture::{srgb_decode, srgb_encode};
use crate::scene::Texture;

/// The texture and every smaller level down to one texel, each the 2x2 mean of the one before in linear light.
/// Odd sizes drop to the half rounded down; the last texel of an odd row then weighs the border texel in.
pub(super) fn levels(texture: &Texture) -> Vec<Vec<u8>> {
    let (mut width, mut height) = (texture.width as usize, texture.height as usize);
    let mut levels = vec![texture.rgba8.clone()];
    let decode: Vec<f64> =
        (0..=255u8).map(|x| f64::from(x) / 255.0).map(|x| if texture.srgb { srgb_decode(x) } else { x }).collect();
    while width > 1 || height > 1 {
        let (w, h) = ((width / 2).max(1), (height / 2).max(1));
        let last = &levels[levels.len() - 1];
        let mut next = Vec::with_capacity(w * h * 4);
        for y in 0..h {
            for x in 0..w {
                let columns = span(x, w, width);
                let rows = span(y, h, height);
                for channel in 0..4 {
                    next.push(mean(last, width, columns.clone(), rows.clone(), channel, &decode, texture.srgb));
                }
            }
        }
        levels.push(next);
        (width, height) = (w, h);
    }
    levels
}

/// The texels that the `i`-th of `n` comes from, out of `of`: two, or three at the end of an odd row.
fn span(i: usize, n: usize, of: usize) -> std::ops::Range<usize> {
    let end = if i + 1 == n { of } else { 2 * i + 2 };
    (2 * i).min(of - 1)..end
}

fn mean(
    texels: &[u8],
    width: usize,
    columns: std::ops::Range<usize>,
    rows: std::ops::Range<usize>,
    channel: usize,
    decode: &[f64],
    srgb: bool,
) -> u8 {
    let coded = srgb && channel < 3;
    let count = columns.len() * rows.len();
    let sum: f64 = rows
        .flat_map(|y| columns.clone().map(move |x| texels[(y * width + x) * 4 + channel]))
        .map(|texel| if coded { decode[usize::from(texel)] } else { f64::from(texel) / 255.0 })
        .sum();
    let value = sum / count as f64;
    ((if coded { srgb_encode(value) } else { value }) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Wrap;

    fn texture(width: u32, height: u32, srgb: bool, rgba8: Vec<u8>) -> Texture {
        Texture { width, height, rgba8, srgb, wrap: [Wrap::Repeat; 2], nearest: false, anisotropy: 1 }
    }

    #[test]
    fn black_and_white_average_to_half_the_light() {
        let halves = [[0, 0, 0, 255], [255, 255, 255, 255]].concat();
        assert_eq!(levels(&texture(2, 1, false, halves.clone()))[1], [128, 128, 128, 255]);
        assert_eq!(levels(&texture(2, 1, true, halves))[1], [188, 188, 188, 255]);
    }

    #[test]
    fn every_size_ends_in_one_texel() {
        for (width, height) in [(1, 1), (5, 3), (1, 7), (16, 4), (31, 33)] {
            let flat = [10, 20, 30, 40].repeat((width * height) as usize);
            let levels = levels(&texture(width, height, true, flat));
            assert_eq!(levels.len() as u32, width.max(height).ilog2() + 1);
            assert!(levels.iter().all(|level| level.chunks(4).all(|texel| texel == [10, 20, 30, 40])));
            assert_eq!(levels.last().map(Vec::len), Some(4));
        }
    }
}
