//! How far a picture has come after the light changed.

use rayon::prelude::*;

use super::rgb;
use crate::picture::DisplayPicture;

/// The share of a change that is done: the one that fits T - T0 = s (R1 - R0) best over all pixels, where T0 is what a method showed
/// before, and R0 and R1 are the references before and after. None where nothing changes.
#[must_use]
pub fn response(now: &DisplayPicture, before: &DisplayPicture, references: [&DisplayPicture; 2]) -> Option<f64> {
    let [width, height] = now.size().map(|side| side as usize);
    let of_pixel = |i: usize| {
        let [t, t0, r0, r1] = [now, before, references[0], references[1]].map(|picture| rgb(picture.pixels()[i]));
        (0..3).fold([0.0; 2], |[over, below], c| {
            let change = r1[c] - r0[c];
            [over + (t[c] - t0[c]) * change, below + change * change]
        })
    };
    let add = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
    // One sum a row, added in order: the same bits for any number of threads.
    let of_row = |y: usize| (0..width).map(|x| of_pixel(y * width + x)).fold([0.0; 2], add);
    let rows: Vec<[f64; 2]> = (0..height).into_par_iter().map(of_row).collect();
    let [over, below] = rows.into_iter().fold([0.0; 2], add);
    (below > 0.0).then(|| over / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(level: f32) -> DisplayPicture {
        DisplayPicture::from_fn(5, 4, |x, _| [level * x as f32, level, 0.25, 1.0]).expect("a size")
    }

    #[test]
    fn a_known_share_is_found_whatever_the_picture_was_before() {
        let references = [&picture(1.0), &picture(0.5)];
        for share in [0.0, 0.3, 0.9, 1.0] {
            // Darker than the reference by as much before as after.
            let own = |level: f32| picture(level - 0.125);
            let found = response(&own(1.0 - 0.5 * share), &own(1.0), references).expect("it changes");
            assert!((found - f64::from(share)).abs() < 1e-6, "{share}: {found}");
        }
    }

    #[test]
    fn no_change_is_no_figure() {
        assert_eq!(response(&picture(0.5), &picture(1.0), [&picture(1.0), &picture(1.0)]), None);
    }
}
