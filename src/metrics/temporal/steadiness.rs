//! Whether a picture that should stand still does.

use rayon::prelude::*;

use super::{percentile, rgb};
use crate::picture::DisplayPicture;

/// Mean and spread of every pixel over frames that should all be the same (Welford 1962), so that equal frames have a spread of 0.
#[derive(Debug, Default)]
pub struct Steadiness {
    frames: u32,
    /// For each pixel and channel: the mean, and the sum of squared deviations from it.
    moments: Vec<[[f64; 2]; 3]>,
}

/// Standard deviation over time of display values, the root mean square of red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crawl {
    /// Mean over all pixels.
    pub mean: f64,
    /// What 99.99 % of the pixels do not exceed.
    pub p9999: f64,
}

impl Steadiness {
    /// Takes a frame in. All must be of one size.
    pub fn add(&mut self, frame: &DisplayPicture) {
        self.moments.resize(frame.pixels().len(), [[0.0; 2]; 3]);
        self.frames += 1;
        let count = f64::from(self.frames);
        self.moments.par_iter_mut().zip(frame.pixels()).for_each(|(moments, pixel)| {
            for ([mean, squares], value) in moments.iter_mut().zip(rgb(*pixel)) {
                let off = value - *mean;
                *mean += off / count;
                *squares += off * (value - *mean);
            }
        });
    }

    /// The spread over the frames so far; none before the first.
    #[must_use]
    pub fn crawl(&self) -> Option<Crawl> {
        let count = 3.0 * f64::from(self.frames);
        let spreads = self.moments.iter().map(|m| (m.iter().map(|[_, squares]| squares).sum::<f64>() / count).sqrt() as f32);
        let spreads: Vec<f32> = spreads.collect();
        let mean = spreads.iter().map(|s| f64::from(*s)).sum::<f64>() / spreads.len() as f64;
        Some(Crawl { mean, p9999: percentile(spreads, 0.9999)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crawl(levels: impl Fn(u32, u32) -> f32) -> Crawl {
        let mut steadiness = Steadiness::default();
        for frame in 0..32 {
            let grey = |x| [levels(frame, x), levels(frame, x), levels(frame, x), 1.0];
            steadiness.add(&DisplayPicture::from_fn(100, 1, |x, _| grey(x)).expect("a size"));
        }
        steadiness.crawl().expect("frames")
    }

    #[test]
    fn what_stands_still_does_not_crawl() {
        assert_eq!(crawl(|_, x| x as f32 / 7.0), Crawl { mean: 0.0, p9999: 0.0 });
        assert_eq!(Steadiness::default().crawl(), None);
    }

    #[test]
    fn a_pixel_that_blinks_is_seen_in_both_figures() {
        let found = crawl(|frame, x| if x == 40 { (frame % 2) as f32 } else { 0.3 });
        assert!((found.mean - 0.005).abs() < 1e-9, "half a step in one pixel of a hundred: {found:?}");
        assert!((found.p9999 - 0.495).abs() < 0.01, "{found:?}");
    }
}
