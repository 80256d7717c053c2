//! How much pictures change from frame to frame: in place, and along their surfaces.

use rayon::prelude::*;

use super::tracks::fetch;
use super::{Tracks, percentile, rgb};
use crate::picture::DisplayPicture;

/// How much the surfaces of a picture changed since an earlier frame: of the absolute differences of display values, averaged over
/// red, green and blue, at all pixels that are found again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Change {
    /// The mean.
    pub mean: f64,
    /// What 99 % of the pixels do not exceed.
    pub p99: f64,
}

/// The change since `gap` frames ago along the tracks; none if no pixel is found again.
#[must_use]
pub fn change(now: &DisplayPicture, before: &DisplayPicture, tracks: &Tracks, gap: usize) -> Option<Change> {
    let places = tracks.places(gap)?;
    let differences = places.par_iter().zip(now.pixels()).filter_map(|(place, pixel)| {
        let (then, now) = (fetch(before, (*place)?)?, rgb(*pixel));
        Some(((0..3).map(|c| (now[c] - then[c]).abs()).sum::<f64>() / 3.0) as f32)
    });
    let differences: Vec<f32> = differences.collect();
    let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
    Some(Change { mean, p99: percentile(differences, 0.99)? })
}

/// Mean squared difference of two pictures of one size, over all pixels and red, green and blue.
#[must_use]
pub fn mean_square(test: &DisplayPicture, reference: &DisplayPicture) -> f64 {
    mean_of_rows(test, |index| {
        let (t, r) = (rgb(test.pixels()[index]), rgb(reference.pixels()[index]));
        (0..3).map(|c| (t[c] - r[c]).powi(2)).sum()
    })
}

/// Mean squared difference of what two sequences do from one frame to the next, without following anything: it sees flicker and lag
/// alike. Each pair is now and before.
#[must_use]
pub fn mean_square_of_steps(test: [&DisplayPicture; 2], reference: [&DisplayPicture; 2]) -> f64 {
    mean_of_rows(test[0], |index| {
        let [t, u, r, s] = [test[0], test[1], reference[0], reference[1]].map(|picture| rgb(picture.pixels()[index]));
        (0..3).map(|c| ((t[c] - u[c]) - (r[c] - s[c])).powi(2)).sum()
    })
}

/// A mean over pixels and three channels. One sum a row, added in order: the same bits for any number of threads.
fn mean_of_rows(picture: &DisplayPicture, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let [width, height] = picture.size().map(|side| side as usize);
    let sums: Vec<f64> = (0..height).into_par_iter().map(|y| (0..width).map(|x| term(y * width + x)).sum()).collect();
    sums.iter().sum::<f64>() / (3 * width * height) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::temporal::sample::pan;

    const SIZE: [u32; 2] = [16, 5];

    fn picture(pixel: impl Fn(u32, u32) -> f32) -> DisplayPicture {
        let grey = |x, y| [pixel(x, y), pixel(x, y), pixel(x, y), 1.0];
        DisplayPicture::from_fn(SIZE[0], SIZE[1], grey).expect("a size")
    }

    fn texture(x: u32, y: u32) -> f32 {
        ((7 * x + 13 * y) % 11) as f32 / 11.0
    }

    #[test]
    fn a_pan_by_whole_pixels_changes_nothing() {
        let tracks = Tracks::follow(SIZE, &[&pan(SIZE, [3.0, -1.0])]);
        let (now, before) = (picture(|x, y| texture(x + 3, y)), picture(|x, y| texture(x, y + 1)));
        assert_eq!(change(&now, &before, &tracks, 1), Some(Change { mean: 0.0, p99: 0.0 }));
        assert!(mean_square(&now, &before) > 0.01, "in place it does");
    }

    #[test]
    fn one_blinking_pixel_is_seen() {
        let tracks = Tracks::follow(SIZE, &[&pan(SIZE, [0.0; 2])]);
        let (on, off) = (picture(|x, y| f32::from(u8::from((x, y) == (4, 2)))), picture(|_, _| 0.0));
        let found = change(&on, &off, &tracks, 1).expect("all is found again");
        assert!((found.mean - 1.0 / 80.0).abs() < 1e-12);
        // Between the highest and the second highest of eighty values.
        assert!((found.p99 - 0.21).abs() < 1e-9, "{}", found.p99);
        assert!((mean_square(&on, &off) - 1.0 / 80.0).abs() < 1e-12);
    }

    #[test]
    fn a_sequence_that_lags_steps_otherwise() {
        let at = |frame: u32| picture(move |x, _| f32::from(u8::from(x == frame)));
        assert_eq!(mean_square_of_steps([&at(3), &at(2)], [&at(3), &at(2)]), 0.0);
        assert!(mean_square_of_steps([&at(2), &at(1)], [&at(3), &at(2)]) > 0.1);
        let brighter = picture(|_, _| 0.5);
        assert_eq!(mean_square_of_steps([&brighter, &brighter], [&at(1), &at(1)]), 0.0, "what rests is no step");
    }

    #[test]
    fn nothing_found_again_is_no_figure() {
        let tracks = Tracks::follow(SIZE, &[&pan(SIZE, [99.0, 0.0])]);
        let black = picture(|_, _| 0.0);
        assert_eq!(change(&black, &black, &tracks, 1), None);
        assert_eq!(change(&black, &black, &tracks, 2), None);
    }
}
