//! Small pictures for the overview.

use std::sync::LazyLock;

use crate::Result;
use crate::picture::{DisplayPicture, srgb_decode, srgb_encode};

/// The light of each 8 bit level.
static LIGHT: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|level| srgb_decode(level as f64 / 255.0)));

/// The picture reduced by a whole number so that it fits into `most` pixels, each the mean light of a box; none if it fits as it is.
pub(super) fn thumbnail(picture: &DisplayPicture, most: [u32; 2]) -> Result<Option<DisplayPicture>> {
    let [width, height] = picture.size();
    let factor = width.div_ceil(most[0]).max(height.div_ceil(most[1]));
    if factor == 1 {
        return Ok(None);
    }
    let levels = picture.to_rgba8();
    let mean = |x: u32, y: u32| {
        let mut sum = Sum::default();
        for row in y * factor..((y + 1) * factor).min(height) {
            let at = |column: u32| 4 * (row as usize * width as usize + column as usize);
            levels[at(x * factor)..at(((x + 1) * factor).min(width))].chunks_exact(4).for_each(|pixel| sum.add(pixel));
        }
        sum.mean()
    };
    DisplayPicture::from_fn(width.div_ceil(factor), height.div_ceil(factor), mean).map(Some)
}

/// Light weighted by alpha: what is transparent has no colour.
#[derive(Default)]
struct Sum {
    light: [f64; 3],
    alpha: f64,
    pixels: f64,
}

impl Sum {
    fn add(&mut self, pixel: &[u8]) {
        let alpha = f64::from(pixel[3]) / 255.0;
        for (sum, level) in self.light.iter_mut().zip(pixel) {
            *sum += alpha * LIGHT[usize::from(*level)];
        }
        self.alpha += alpha;
        self.pixels += 1.0;
    }

    fn mean(&self) -> [f32; 4] {
        let [r, g, b] = self.light.map(|sum| if self.alpha > 0.0 { srgb_encode(sum / self.alpha) as f32 } else { 0.0 });
        [r, g, b, (self.alpha / self.pixels) as f32]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(width: u32, height: u32, pixel: impl FnMut(u32, u32) -> [f32; 4]) -> DisplayPicture {
        thumbnail(&DisplayPicture::from_fn(width, height, pixel).expect("a size"), [2, 2]).expect("made").expect("reduced")
    }

    #[test]
    fn light_is_averaged_and_odd_rests_count_as_what_they_are() {
        let board = of(4, 3, |x, y| if x == 3 { [1.0; 4] } else { [((x + y) % 2) as f32, 0.0, 0.0, 1.0] });
        assert_eq!(board.size(), [2, 2]);
        // Half the light is level 188, not 128.
        assert_eq!(board.quantized(crate::picture::BitDepth::Eight).pixel(0, 0)[0], 188.0 / 255.0);
        // The last row has one row of pixels: black and white.
        assert!((f64::from(board.pixel(1, 1)[1]) - srgb_encode(0.5)).abs() < 1e-6);
    }

    #[test]
    fn what_is_transparent_has_no_colour() {
        let half = of(4, 4, |x, _| if x % 2 == 0 { [1.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 0.0] });
        assert_eq!(half.pixel(0, 0), [1.0, 0.0, 0.0, 0.5]);
        assert_eq!(of(4, 4, |_, _| [1.0, 1.0, 1.0, 0.0]).pixel(0, 0), [0.0; 4]);
    }

    #[test]
    fn what_fits_stays() {
        let small = DisplayPicture::from_fn(2, 1, |_, _| [0.5; 4]).expect("a size");
        assert_eq!(thumbnail(&small, [2, 2]).expect("made"), None);
    }
}
