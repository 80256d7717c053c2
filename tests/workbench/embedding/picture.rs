//! What the filters are given: colours that every format holds, and every level that 8 bits have.

use dejag::picture::Pixel;

/// Odd, and no multiple of anything that a shader takes at a time.
pub(super) const SIZE: [u32; 2] = [61, 35];

fn picture([width, height]: [u32; 2], at: impl Fn(i64, i64) -> Pixel) -> Vec<Pixel> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| at(x.into(), y.into())).collect()
}

/// Edges of all kinds: a slope, a disk, a steep bar, a line of one pixel, and dots. Display values and alphas are thirds, which
/// 2, 8 and 10 bits hold exactly: what formats differ by is rounded on the way out.
pub(super) fn shapes(size: [u32; 2]) -> Vec<Pixel> {
    const THIRD: f32 = 1.0 / 3.0;
    let (width, height) = (i64::from(size[0]), i64::from(size[1]));
    picture(size, |x, y| {
        let (dx, dy) = (x - width * 2 / 3, y - height / 2);
        if dx * dx + dy * dy < height * height / 10 {
            [THIRD, 0.0, 1.0, 2.0 * THIRD]
        } else if (3 * x - y - 20).abs() < 9 {
            [0.0, 2.0 * THIRD, 0.0, 0.0]
        } else if y == height - 5 || (x % 7 == 3 && y == height - 2) {
            [1.0, 1.0, 1.0, 1.0]
        } else if 5 * y < x + height {
            [1.0, 2.0 * THIRD, THIRD, 1.0]
        } else {
            [0.0, 0.0, THIRD, THIRD]
        }
    })
}

/// Another such picture.
pub(super) fn mirrored(size: [u32; 2]) -> Vec<Pixel> {
    let mut pixels = shapes(size);
    pixels.reverse();
    pixels
}

/// All 256 levels in each colour channel, in steps too small for an edge.
pub(super) fn ramp(size: [u32; 2]) -> Vec<Pixel> {
    picture(size, |x, y| {
        let level = (x + 6 * y).min(255) as f32 / 255.0;
        [level, level, level, (level * 3.0).round() / 3.0]
    })
}
