//! How sharp a picture is beside its reference.

use rayon::prelude::*;

use super::luma;
use crate::picture::DisplayPicture;

/// Gradient energy of a picture over that of its reference: squared differences of neighbours in display luma, along rows and
/// columns. 1 is as sharp, less is blurred, more is jagged or sharpened. None where the reference is flat.
#[must_use]
pub fn sharpness(test: &DisplayPicture, reference: &DisplayPicture) -> Option<f64> {
    let right = gradient_energy(reference);
    (right > 0.0).then(|| gradient_energy(test) / right)
}

fn gradient_energy(picture: &DisplayPicture) -> f64 {
    let luma: Vec<f64> = picture.pixels().iter().map(|pixel| luma(*pixel)).collect();
    let [width, height] = picture.size().map(|side| side as usize);
    let of_row = |y: usize| {
        let row = &luma[y * width..(y + 1) * width];
        let along: f64 = row.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let below = luma.get((y + 1) * width..(y + 2) * width).unwrap_or_default();
        along + row.iter().zip(below).map(|(a, b)| (b - a).powi(2)).sum::<f64>()
    };
    // One sum a row, added in order: the same bits for any number of threads.
    (0..height).into_par_iter().map(of_row).collect::<Vec<f64>>().into_iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(width_px: f32) -> DisplayPicture {
        DisplayPicture::from_fn(32, 8, |x, _| {
            let level = ((x as f32 - 16.0) / width_px + 0.5).clamp(0.0, 1.0);
            [level, level, level, 1.0]
        })
        .expect("a size")
    }

    #[test]
    fn an_edge_twice_as_wide_is_half_as_sharp() {
        assert_eq!(sharpness(&edge(4.0), &edge(4.0)), Some(1.0));
        let found = sharpness(&edge(8.0), &edge(4.0)).expect("it has an edge");
        assert!((found - 0.5).abs() < 1e-6, "{found}");
    }

    #[test]
    fn both_directions_count_and_flat_is_no_figure() {
        let across = DisplayPicture::from_fn(8, 8, |_, y| [y as f32 / 8.0; 4]).expect("a size");
        let flat = DisplayPicture::from_fn(8, 8, |_, _| [0.5; 4]).expect("a size");
        assert_eq!(sharpness(&flat, &across), Some(0.0));
        assert_eq!(sharpness(&across, &flat), None);
        let pixel = DisplayPicture::from_fn(1, 1, |_, _| [0.5; 4]).expect("a size");
        assert_eq!(sharpness(&pixel, &pixel), None);
    }
}
