//! Thin lines: whether they are where the reference has them, all along.

use rayon::prelude::*;

use super::luma;
use crate::picture::DisplayPicture;

/// Least contrast of a line in display luma.
const FLOOR: f64 = 0.05;

/// Share of the reference's contrast that a line must keep.
const KEPT: f64 = 0.5;

/// Where the reference has thin lines, bright or dark: pixels whose luma is the extreme of the three along an axis, and differs from
/// both pixels two away in the same sense.
#[derive(Debug, Clone)]
pub struct Ridges {
    ridges: Vec<Ridge>,
}

#[derive(Debug, Clone, Copy)]
struct Ridge {
    /// In reading order, at the middle.
    pixel: usize,
    /// From a pixel to the next along the axis.
    stride: usize,
    /// Signed: above 0 for a bright line.
    contrast: f64,
}

/// How much of the lines is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Continuity {
    /// Places where a line has at least half of its contrast.
    pub kept: u64,
    /// Places where the reference has one; at least 1.
    pub of: u64,
}

impl Continuity {
    /// The share that is there.
    #[must_use]
    pub fn share(self) -> f64 {
        self.kept as f64 / self.of as f64
    }
}

impl Ridges {
    /// Those of a reference.
    #[must_use]
    pub fn of(reference: &DisplayPicture) -> Self {
        let luma = plane(reference);
        let [width, height] = reference.size().map(|side| side as usize);
        let rows = (0..height).into_par_iter().flat_map_iter(|y| {
            let luma = &luma;
            (0..width).flat_map(move |x| {
                let inside = |at: usize, side: usize| at >= 2 && at + 2 < side;
                let pixel = y * width + x;
                let along_x = inside(x, width).then(|| ridge(luma, pixel, 1)).flatten();
                let along_y = inside(y, height).then(|| ridge(luma, pixel, width)).flatten();
                along_x.into_iter().chain(along_y)
            })
        });
        Self { ridges: rows.collect() }
    }

    /// How many places there are, a pixel counting once for each axis.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ridges.len()
    }

    /// How much of them another picture of the same size has; none if there are none.
    #[must_use]
    pub fn kept_in(&self, test: &DisplayPicture) -> Option<Continuity> {
        if self.ridges.is_empty() {
            return None;
        }
        let luma = plane(test);
        let kept = self.ridges.par_iter().filter(|ridge| {
            let Ridge { pixel, stride, contrast } = **ridge;
            let sign = contrast.signum();
            let top = [pixel - stride, pixel, pixel + stride].map(|at| sign * luma[at]).into_iter().fold(f64::MIN, f64::max);
            let beside = 0.5 * sign * (luma[pixel - 2 * stride] + luma[pixel + 2 * stride]);
            top - beside >= KEPT * contrast.abs()
        });
        Some(Continuity { kept: kept.count() as u64, of: self.ridges.len() as u64 })
    }
}

fn plane(picture: &DisplayPicture) -> Vec<f64> {
    picture.pixels().iter().map(|pixel| luma(*pixel)).collect()
}

fn ridge(luma: &[f64], pixel: usize, stride: usize) -> Option<Ridge> {
    let own = luma[pixel];
    let [before, after] = [own - luma[pixel - 2 * stride], own - luma[pixel + 2 * stride]];
    let sign = before.signum();
    let extreme = [pixel - stride, pixel + stride].iter().all(|at| sign * (own - luma[*at]) >= 0.0);
    let found = extreme && sign * before > FLOOR && sign * after > FLOOR;
    found.then_some(Ridge { pixel, stride, contrast: 0.5 * (before + after) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [24, 16];

    fn picture(level: impl Fn(u32, u32) -> f32) -> DisplayPicture {
        DisplayPicture::from_fn(SIZE[0], SIZE[1], |x, y| [level(x, y), level(x, y), level(x, y), 1.0]).expect("a size")
    }

    /// A column of this brightness at x = 9, blurred by nothing.
    fn line(level: impl Fn(u32) -> f32) -> DisplayPicture {
        picture(|x, y| if x == 9 { level(y) } else { 0.2 })
    }

    fn share(reference: &DisplayPicture, test: &DisplayPicture) -> f64 {
        Ridges::of(reference).kept_in(test).expect("there is a line").share()
    }

    #[test]
    fn a_line_is_found_and_an_erased_one_is_gone() {
        let reference = line(|_| 0.8);
        assert_eq!(Ridges::of(&reference).count(), SIZE[1] as usize);
        assert_eq!(share(&reference, &reference), 1.0);
        assert_eq!(share(&reference, &picture(|_, _| 0.2)), 0.0);
        assert_eq!(share(&reference, &line(|y| if y < 4 { 0.8 } else { 0.2 })), 0.25);
        assert_eq!(share(&reference, &line(|_| 0.49)), 0.0);
        assert_eq!(share(&reference, &line(|_| 0.51)), 1.0);
    }

    #[test]
    fn a_dark_line_is_one_too_and_a_bright_one_in_its_place_is_not() {
        let dark = line(|_| 0.0);
        assert_eq!(share(&dark, &dark), 1.0);
        assert_eq!(share(&dark, &line(|_| 0.8)), 0.0);
    }

    #[test]
    fn a_pixel_to_the_side_is_still_the_line() {
        assert_eq!(share(&line(|_| 0.8), &picture(|x, _| if x == 10 { 0.8 } else { 0.2 })), 1.0);
        assert_eq!(share(&line(|_| 0.8), &picture(|x, _| if x == 12 { 0.8 } else { 0.2 })), 0.0);
    }

    #[test]
    fn an_edge_is_no_line_and_small_pictures_have_none() {
        assert_eq!(Ridges::of(&picture(|x, _| f32::from(u8::from(x > 9)))).count(), 0);
        let small = picture(|_, _| 0.5).crop(0, 0, 1, 1).expect("inside");
        assert_eq!(Ridges::of(&small).kept_in(&small), None);
        assert_eq!(Ridges::of(&picture(|_, _| f32::NAN)).count(), 0);
    }
}
