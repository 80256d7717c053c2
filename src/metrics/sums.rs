//! The metrics that are means, as sums over part of a picture: strips of a picture that is too large to be held in floats add up
//! to the figure of the whole, and pixels that do not count are left out.

use super::{Figure, Pair, find, ssim};
use std::ops::Range;

/// Rows above and below those that are summed that a strip needs to have, where the picture has them. FLIP's filters reach 10
/// pixels at its viewing distance, SSIM's window 5.
pub const MARGIN: u32 = 10;

/// A metric that is a mean over pixels or windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mean {
    /// Of squared differences: `psnr`.
    Psnr,
    /// Of indices of windows, each standing for its middle pixel: `ssim`.
    Ssim,
    /// Of errors: `flip`.
    Flip,
}

/// A mean in the making.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sum {
    sum: f64,
    count: u64,
    /// A pixel is NaN or infinite, or the metric does not apply.
    spoilt: Option<Spoilt>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Spoilt {
    NonFinite,
    NotApplicable,
}

/// A pair, and which of its pixels are summed.
#[derive(Debug)]
pub struct Strip<'a> {
    /// The rows to sum, with [`MARGIN`] rows above and below them.
    pub pair: &'a Pair<'a>,
    /// The rows to sum, counted in those of the pair.
    pub rows: Range<usize>,
    /// For each pixel of the pair in reading order whether it counts; all do if it is empty.
    pub counted: &'a [bool],
}

impl Mean {
    /// The versioned id of the metric.
    #[must_use]
    pub fn id(self) -> &'static str {
        find(self.name()).map_or("", |metric| metric.id)
    }

    /// The metric's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Psnr => "psnr",
            Self::Ssim => "ssim",
            Self::Flip => "flip",
        }
    }

    /// The sum over a strip.
    #[must_use]
    pub fn sum(self, strip: &Strip<'_>) -> Sum {
        if !strip.pair.is_finite() {
            return Sum { spoilt: Some(Spoilt::NonFinite), ..Sum::default() };
        }
        match self {
            Self::Psnr => strip.squares(),
            Self::Ssim => strip.indices(),
            Self::Flip => strip.errors(),
        }
    }

    /// The figure of all that was summed; does not apply if that is nothing.
    #[must_use]
    pub fn figure(self, sum: &Sum) -> Figure {
        let mean = sum.sum / sum.count as f64;
        match (sum.spoilt, sum.count, self) {
            (Some(Spoilt::NonFinite), ..) => Figure::NonFinite,
            (Some(Spoilt::NotApplicable), ..) | (None, 0, _) => Figure::NotApplicable,
            (None, _, Self::Psnr) => super::difference::psnr_of(mean),
            (None, _, Self::Ssim | Self::Flip) => Figure::from(mean),
        }
    }
}

impl Sum {
    /// With what comes next; in the same order always, so that the last digit stays.
    pub fn add(&mut self, next: Self) {
        self.sum += next.sum;
        self.count += next.count;
        self.spoilt = self.spoilt.or(next.spoilt);
    }
}

impl Strip<'_> {
    fn width(&self) -> usize {
        self.pair.size()[0] as usize
    }

    fn counts(&self, index: usize) -> bool {
        self.counted.get(index).copied().unwrap_or(true)
    }

    /// Indices of the pixels to sum.
    fn pixels(&self) -> impl Iterator<Item = usize> + '_ {
        (self.rows.start * self.width()..self.rows.end * self.width()).filter(|index| self.counts(*index))
    }

    fn squares(&self) -> Sum {
        let sides = self.pair.display();
        let (candidate, reference) = (sides.candidate.pixels(), sides.reference.pixels());
        let mut all = Sum::default();
        for index in self.pixels() {
            let (t, r) = (candidate[index], reference[index]);
            all.sum += (0..3).map(|c| (f64::from(t[c]) - f64::from(r[c])).powi(2)).sum::<f64>();
            all.count += 3;
        }
        all
    }

    fn indices(&self) -> Sum {
        let (sides, width) = (self.pair.display(), self.width());
        let wanted = |x: usize, y: usize| self.rows.contains(&y) && self.counts(y * width + x);
        let mut all = Sum::default();
        for channel in 0..3 {
            let planes = [ssim::plane(sides.candidate, channel), ssim::plane(sides.reference, channel)];
            let (sum, count) = ssim::sum_where(width, planes.each_ref().map(Vec::as_slice), wanted);
            all.add(Sum { sum, count: count as u64, spoilt: None });
        }
        all
    }

    fn errors(&self) -> Sum {
        let Some(map) = self.pair.flip_map() else {
            return Sum { spoilt: Some(Spoilt::NotApplicable), ..Sum::default() };
        };
        let mut all = Sum::default();
        for index in self.pixels() {
            all.sum += f64::from(map[index]);
            all.count += 1;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::super::formula::PAIRS;
    use super::*;
    use crate::picture::DisplayPicture;

    fn rows_of(picture: &DisplayPicture, rows: Range<u32>) -> DisplayPicture {
        picture.crop(0, rows.start, picture.width(), rows.end - rows.start).expect("inside")
    }

    /// The figure, summed over strips of so many rows.
    fn in_strips(mean: Mean, test: &DisplayPicture, reference: &DisplayPicture, step: u32) -> f64 {
        let (height, mut sum) = (test.height(), Sum::default());
        for top in (0..height).step_by(step as usize) {
            let (start, end) = (top.saturating_sub(MARGIN), (top + step + MARGIN).min(height));
            let parts = [test, reference].map(|picture| rows_of(picture, start..end));
            let pair = Pair::new(&parts[0], &parts[1]).expect("one size");
            let rows = (top - start) as usize..(height.min(top + step) - start) as usize;
            sum.add(mean.sum(&Strip { pair: &pair, rows, counted: &[] }));
        }
        mean.figure(&sum).number().expect("a figure")
    }

    #[test]
    fn strips_add_up_to_the_whole() {
        for formula in PAIRS {
            let (test, reference) = (formula.test(), formula.reference());
            let pair = Pair::new(&test, &reference).expect("one size");
            for mean in [Mean::Psnr, Mean::Ssim, Mean::Flip] {
                let whole = find(mean.name()).expect("known").evaluate(&pair).number().expect("a figure");
                for step in [1, 7, 16, 48] {
                    let strips = in_strips(mean, &test, &reference, step);
                    assert!(
                        (strips - whole).abs() < 1e-12 * whole.abs(),
                        "{mean:?} of {} by {step}: {strips}, {whole}",
                        formula.name
                    );
                }
            }
        }
    }

    #[test]
    fn pixels_that_do_not_count_are_left_out() {
        let reference = DisplayPicture::from_fn(32, 32, |_, _| [0.5, 0.5, 0.5, 1.0]).expect("a size");
        let test =
            DisplayPicture::from_fn(32, 32, |x, y| [0.5, if x < 4 { y as f32 / 32.0 } else { 0.5 }, 0.5, 1.0]).expect("a size");
        let pair = Pair::new(&test, &reference).expect("one size");
        let figure = |mean: Mean, counted: &[bool]| mean.figure(&mean.sum(&Strip { pair: &pair, rows: 0..32, counted }));
        let right: Vec<bool> = (0..32 * 32).map(|i| i % 32 >= 16).collect();
        assert_eq!(figure(Mean::Psnr, &right), Figure::Infinite);
        assert_eq!(figure(Mean::Ssim, &right), Figure::Number(1.0));
        assert_eq!(figure(Mean::Flip, &right), Figure::Number(0.0));
        for mean in [Mean::Psnr, Mean::Ssim, Mean::Flip] {
            assert_ne!(figure(mean, &[]), figure(mean, &right), "{mean:?}");
            assert_eq!(figure(mean, &[false; 32 * 32]), Figure::NotApplicable);
        }
    }
}
