//! Filters blend: nothing gets brighter, darker, or more or less opaque than the pixels it is made of.

use super::picture::{Picture, hard, random};
use super::{Filter, eight_bit, float, half_float, linear_light, specs};
use crate::common;

const SIZE: [u32; 2] = [45, 37];

/// The largest excess of a channel over what it and its eight neighbours span, and where; in units of the surface's steps.
fn largest_excess(picture: &Picture, filtered: &Picture, step: impl Fn(f32) -> f32) -> (f32, [u32; 2]) {
    let [width, height] = picture.size;
    let mut largest = (0.0, [0, 0]);
    for y in 0..height {
        for x in 0..width {
            let (mut low, mut high) = (picture.at(x, y), picture.at(x, y));
            for ny in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                for nx in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    let neighbor = picture.at(nx, ny);
                    low = [0, 1, 2, 3].map(|c| low[c].min(neighbor[c]));
                    high = [0, 1, 2, 3].map(|c| high[c].max(neighbor[c]));
                }
            }
            let found = filtered.at(x, y);
            for c in 0..4 {
                let beyond = (found[c] - high[c]).max(low[c] - found[c]) / step(high[c].abs().max(low[c].abs()));
                // What is no number is in no range.
                if beyond > largest.0 || beyond.is_nan() {
                    largest = (if beyond.is_nan() { f32::INFINITY } else { beyond }, [x, y]);
                }
            }
        }
    }
    largest
}

/// In 8 bits rounding ends on the very values that were there; elsewhere coding and back is off by a step at most.
pub(super) fn assert_between_neighbors(filter: &Filter<'_>, picture: &Picture, filtered: &Picture) {
    let allowed = if filter.surface == eight_bit() { 0.01 } else { 1.01 };
    let (excess, place) = largest_excess(picture, filtered, |value| filter.step(value));
    let around = filtered.at(place[0], place[1]);
    assert!(excess <= allowed, "{}: {excess} steps beyond its neighbours at {place:?}, {around:?}", filter.name);
}

/// With opacities of all kinds.
fn see_through(picture: &Picture) -> Picture {
    Picture::from_fn(picture.size, |x, y| {
        let [r, g, b, _] = picture.at(x, y);
        [r, g, b, random(77, y / 3 * picture.size[0] + x / 4)]
    })
}

#[test]
fn every_channel_lies_between_its_neighbours() {
    let gpu = common::gpu();
    for spec in specs() {
        for surface in [eight_bit(), half_float(), float(), linear_light()] {
            let mut filter = Filter::new(&gpu, &spec, SIZE, surface);
            for (name, picture) in hard(SIZE) {
                let picture = filter.stored(&see_through(&picture));
                let filtered = filter.apply(&picture);
                assert_between_neighbors(&filter, &picture, &filtered);
                // A checkerboard has no lines: most filters find nothing to do in it.
                let same = filtered.same_bits(&picture);
                assert!(!same || name == "checkerboard", "{}: nothing was filtered", filter.name);
            }
        }
    }
}

#[test]
fn a_filter_that_sharpens_is_noticed() {
    let [_, (_, picture), ..] = hard(SIZE);
    let sharpened = picture.map(|[r, g, b, a]| [1.01 * r, g, b, a]);
    assert!(largest_excess(&picture, &sharpened, |_| 1.0 / 255.0).0 > 1.0);
    let mut holed = picture.clone();
    holed.at_mut(7, 7)[2] = f32::NAN;
    assert_eq!(largest_excess(&picture, &holed, |_| 1.0), (f32::INFINITY, [7, 7]));
}

fn coded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn decoded(coded: f32) -> f32 {
    if coded <= 0.040_45 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// The most by which a colour exceeds its opacity.
fn excess_over_alpha(picture: &Picture, light: fn(f32) -> f32) -> f32 {
    picture.pixels.iter().map(|[r, g, b, a]| light(r.max(*g).max(*b)) - a).fold(f32::MIN, f32::max)
}

#[test]
fn opaque_stays_opaque_and_premultiplied_stays_premultiplied() {
    let gpu = common::gpu();
    for spec in specs() {
        let with = |option: &str| if spec.contains(':') { format!("{spec},{option}") } else { format!("{spec}:{option}") };
        for surface in [eight_bit(), half_float()] {
            let mut in_light = Filter::new(&gpu, &spec, SIZE, surface);
            let mut as_coded = Filter::new(&gpu, &with("blend=coded"), SIZE, surface);
            for (_, opaque) in hard(SIZE) {
                assert!(in_light.apply(&opaque).pixels.iter().all(|pixel| pixel[3] == 1.0), "{spec}");
                let premultiplied = see_through(&opaque).map(|[r, g, b, a]| [r * a, g * a, b * a, a]);
                // Rounding keeps order, so what was no more than alpha stays so to the bit; half floats lose one in a product.
                let beyond = excess_over_alpha(&as_coded.apply(&premultiplied), |value| value);
                let allowed = if surface == eight_bit() { 1e-6 } else { 1.01 * as_coded.step(1.0) };
                assert!(beyond <= allowed, "{}: {beyond}", as_coded.name);
                let in_linear_light = premultiplied.map(|[r, g, b, a]| [coded(r), coded(g), coded(b), a]);
                let beyond = excess_over_alpha(&in_light.apply(&in_linear_light), decoded);
                // Half a step of the coded colour, which is steepest at white (2.3), and half a step of alpha, in and out.
                assert!(beyond <= 3.4 * in_light.step(1.0), "{}: {beyond}", in_light.name);
            }
        }
    }
}
