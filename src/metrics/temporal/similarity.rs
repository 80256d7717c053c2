//! Structural similarity of a frame and the one before, brought to its place.

use super::tracks::fetch;
use super::{Place, Tracks, luma};
use crate::metrics::ssim;
use crate::picture::DisplayPicture;

/// Mean SSIM (Gaussian window of 11x11, luma of display values) between a frame and the one before along the tracks, over the windows
/// whose middle is found again; none where there is no such window. Where a pixel in a window is not found again, it counts as
/// unchanged. In the manner of the inter-frame SSIM of Neural Supersampling for mobile (Yang et al., MNSS, 2023).
#[must_use]
pub fn similarity(now: &DisplayPicture, before: &DisplayPicture, tracks: &Tracks) -> Option<f64> {
    let places = tracks.places(1)?;
    let own: Vec<f64> = now.pixels().iter().map(|pixel| luma(*pixel)).collect();
    let then = |place: Place| fetch(before, place).map(|[r, g, b]| luma([r as f32, g as f32, b as f32, 1.0]));
    let warped: Vec<f64> = places.iter().zip(&own).map(|(place, own)| place.and_then(then).unwrap_or(*own)).collect();
    let width = now.width() as usize;
    ssim::mean_where(width, [&own, &warped], |x, y| places[y * width + x].is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::temporal::sample::pan;

    const SIZE: [u32; 2] = [32, 24];

    fn texture(shift: u32) -> DisplayPicture {
        let level = |x: u32, y: u32| ((5 * (x + shift) + 3 * y) % 17) as f32 / 17.0;
        DisplayPicture::from_fn(SIZE[0], SIZE[1], |x, y| [level(x, y), level(x, y), level(x, y), 1.0]).expect("a size")
    }

    #[test]
    fn a_pan_by_whole_pixels_is_the_same_picture() {
        let tracks = Tracks::follow(SIZE, &[&pan(SIZE, [2.0, 0.0])]);
        assert_eq!(similarity(&texture(2), &texture(0), &tracks), Some(1.0));
        let wrong = similarity(&texture(3), &texture(0), &tracks).expect("windows fit");
        assert!(wrong < 0.9, "{wrong}");
    }

    #[test]
    fn too_small_or_never_seen_is_no_figure() {
        let tracks = Tracks::follow(SIZE, &[&pan(SIZE, [99.0, 0.0])]);
        assert_eq!(similarity(&texture(0), &texture(0), &tracks), None);
        let small = texture(0).crop(0, 0, 10, 24).expect("inside");
        assert_eq!(similarity(&small, &small, &Tracks::follow([10, 24], &[&pan([10, 24], [0.0; 2])])), None);
    }
}
