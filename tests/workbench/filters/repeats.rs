//! The same picture gives the same bits, whatever came before; and a filtered picture needs little more filtering.

use super::picture::{checkerboard, confetti, hard, noise};
use super::{Filter, eight_bit, half_float, specs};
use crate::common;

const SIZE: [u32; 2] = [256, 256];

#[test]
fn the_same_picture_gives_the_same_bits() {
    let gpu = common::gpu();
    for spec in specs() {
        // Lists are filled in an order that nobody promises: noise fills them most.
        let mut filter = Filter::new(&gpu, &spec, SIZE, half_float());
        let mut another = Filter::new(&gpu, &spec, SIZE, half_float());
        for (picture, runs) in [(noise(SIZE, 4), 5), (checkerboard(SIZE), 1)] {
            let first = another.apply(&picture);
            for run in 0..runs {
                assert!(filter.apply(&picture).same_bits(&first), "{}: run {run} differs", filter.name);
            }
        }
    }
}

#[test]
fn nothing_is_left_of_the_picture_before() {
    let gpu = common::gpu();
    let size = [61, 47];
    let pictures = [noise(size, 1), confetti(size, 8), checkerboard(size)];
    for spec in specs() {
        let fresh = pictures.each_ref().map(|picture| Filter::new(&gpu, &spec, size, eight_bit()).apply(picture));
        let mut filter = Filter::new(&gpu, &spec, size, eight_bit());
        for (before, _) in pictures.iter().zip(&fresh) {
            for (picture, expected) in pictures.iter().zip(&fresh) {
                filter.apply(before);
                assert!(filter.apply(picture).same_bits(expected), "{}: a picture before is seen", filter.name);
            }
        }
    }
}

#[test]
fn filtering_twice_changes_little_more() {
    let gpu = common::gpu();
    let size = [61, 61];
    for spec in specs() {
        let mut filter = Filter::new(&gpu, &spec, size, half_float());
        for (name, picture) in &hard(size)[..2] {
            let picture = filter.stored(picture);
            let once = filter.apply(&picture);
            let twice = filter.apply(&once);
            let mean = twice.mean_difference(&once) / once.mean_difference(&picture);
            let largest = twice.largest_difference(&once) / once.largest_difference(&picture);
            println!("{spec}, {name}: the second time changes {mean:.3} of what the first did, at most {largest:.3}");
            assert!(mean > 0.0 && mean < 0.75 && largest < 1.0, "{spec}, {name}: {mean}, {largest}");
        }
    }
}
