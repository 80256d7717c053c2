//! Where nothing steps, nothing changes, not by a bit.

use super::picture::Picture;
use super::{Filter, eight_bit, float, half_float, linear_light, specs};
use crate::common;

const LEVELS: [[f32; 3]; 6] =
    [[0.0; 3], [1.0; 3], [1.0 / 255.0, 127.0 / 255.0, 254.0 / 255.0], [0.2, 0.7, 0.1], [0.003, 0.04, 0.5], [1.0, 0.0, 0.333]];

#[test]
fn a_flat_picture_comes_back_bit_for_bit() {
    let gpu = common::gpu();
    for spec in specs() {
        for surface in [eight_bit(), half_float(), float(), linear_light()] {
            let mut filter = Filter::new(&gpu, &spec, [19, 13], surface);
            for [r, g, b] in LEVELS {
                for alpha in [0.0, 0.5, 1.0] {
                    let flat = Picture::from_fn([19, 13], |_, _| [r, g, b, alpha]);
                    let expected = filter.stored(&flat);
                    let found = filter.apply(&flat);
                    assert!(found.same_bits(&expected), "{}: {:?} for {:?}", filter.name, found.at(0, 0), expected.at(0, 0));
                }
            }
        }
    }
}

#[test]
fn the_comparison_sees_a_single_bit() {
    let flat = Picture::grey([5, 3], |_, _| 0.5);
    let mut other = flat.clone();
    other.at_mut(4, 2)[3] = f32::from_bits(1.0f32.to_bits() - 1);
    assert_eq!(other.differing(&flat), [[4, 2]]);
    let zero = Picture::grey([1, 1], |_, _| 0.0);
    assert!(!zero.same_bits(&zero.map(|_| [-0.0, 0.0, 0.0, 1.0])));
}
