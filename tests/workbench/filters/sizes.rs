//! From one pixel to more than a screen, thin ones and odd ones.

use super::blending::assert_between_neighbors;
use super::picture::{Picture, confetti, random, star};
use super::{Filter, eight_bit, filters, half_float};
use crate::common;

/// 1 pixel thin, below, at and beyond a word of sixteen pixels, and a screen that no word divides.
const SIZES: [[u32; 2]; 6] = [[1, 1], [3, 5], [17, 1], [16, 16], [33, 31], [1921, 1081]];

#[test]
fn every_size_works() {
    let gpu = common::gpu();
    for method in filters() {
        for size in SIZES {
            let mut filter = Filter::new(&gpu, method.name, size, eight_bit());
            let picture = if size[0] > 1000 { star(size) } else { confetti(size, 2) };
            let picture = filter.stored(&picture);
            let filtered = filter.apply(&picture);
            assert_between_neighbors(&filter, &picture, &filtered);
            let changed = filtered.differing(&picture).len();
            println!("{}: {changed} pixels changed", filter.name);
            assert!(changed == 0 || size != [1, 1], "{}", filter.name);
            // In small pictures of many colours, all or none may be edges.
            let share = changed as f64 / picture.pixels.len() as f64;
            assert!(size[0].min(size[1]) < 16 || (0.005..0.8).contains(&share), "{}: {share}", filter.name);
        }
    }
}

/// Steps, ramps and single pixels, whatever the position across.
fn bands(size: [u32; 2]) -> Picture {
    Picture::grey(size, |_, y| match y / 100 % 3 {
        0 => random(1, y),
        1 => f32::from(y / 5 % 2 == 1),
        _ => y as f32 / 1000.0,
    })
}

#[test]
fn a_picture_one_pixel_thin_is_a_wide_one_of_equal_columns() {
    let gpu = common::gpu();
    for method in filters() {
        for surface in [eight_bit(), half_float()] {
            let mut filter = Filter::new(&gpu, method.name, [1, 1000], surface);
            let thin = filter.apply(&bands([1, 1000]));
            assert_between_neighbors(&filter, &filter.stored(&bands([1, 1000])), &thin);
            let wide = Filter::new(&gpu, method.name, [5, 1000], surface).apply(&bands([5, 1000]));
            let widened = Picture::from_fn(wide.size, |_, y| thin.at(0, y));
            let differing = widened.differing(&wide);
            assert!(differing.is_empty(), "{}: {} pixels, {:?}", method.name, differing.len(), differing[0]);
        }
    }
}

#[test]
fn a_picture_one_pixel_flat_is_a_high_one_of_equal_rows() {
    let gpu = common::gpu();
    for method in filters() {
        let flat = Filter::new(&gpu, method.name, [1000, 1], eight_bit()).apply(&bands([1, 1000]).transposed());
        let high = Filter::new(&gpu, method.name, [1000, 5], eight_bit()).apply(&bands([5, 1000]).transposed());
        let heightened = Picture::from_fn(high.size, |x, _| flat.at(x, 0));
        assert_eq!(heightened.differing(&high), Vec::<[u32; 2]>::new(), "{}", method.name);
    }
}
