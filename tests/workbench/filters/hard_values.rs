//! What no picture should hold and some do: a renderer's NaN, infinities, negative light, and the largest half float.
//!
//! Searches for edges see [0, 1], and what is no number as black. So a picture with bad pixels must be filtered to the very bits
//! that it is filtered to with stand-ins in their place, except for the bad pixels themselves and the four beside each, which
//! may be blended with it: a bad value does not spread.

use super::picture::{Picture, confetti, star};
use super::{Filter, float, half_float, linear_light, specs};
use crate::common;

const SIZE: [u32; 2] = [37, 33];

/// A bad value, and what a search takes it for.
const BAD: [(f32, f32); 6] =
    [(65504.0, 1.0), (-0.5, 0.0), (-65504.0, 0.0), (f32::NAN, 0.0), (f32::INFINITY, 0.0), (f32::NEG_INFINITY, 0.0)];

/// Corners, borders, and across the middle on flats and edges alike; none near another.
fn places() -> Vec<[u32; 2]> {
    let spread = (0..5).flat_map(|row| (0..5).map(move |column| [3 + 7 * column + row % 2, 4 + 6 * row]));
    spread.chain([[0, 0], [36, 0], [0, 32], [36, 32], [18, 0], [0, 17]]).collect()
}

fn with_pixels(picture: &Picture, value: f32, channels: &[usize]) -> Picture {
    let mut changed = picture.clone();
    for [x, y] in places() {
        for c in channels {
            changed.at_mut(x, y)[*c] = value;
        }
    }
    changed
}

/// What a search takes pixels for that hold a value: black altogether if one channel is no number.
fn with_stand_ins(picture: &Picture, (bad, stand_in): (f32, f32), channels: &[usize]) -> Picture {
    if channels == [3] {
        return picture.clone();
    }
    let channels = if bad.is_finite() { channels } else { &[0, 1, 2] };
    with_pixels(picture, stand_in, channels)
}

/// The pixels that may be blended with a bad one, and those themselves.
fn beside_bad([x, y]: [u32; 2]) -> bool {
    places().iter().any(|[bx, by]| bx.abs_diff(x) + by.abs_diff(y) <= 1)
}

/// What is wrong with a filtered picture, if anything.
fn fault(filtered: &Picture, expected: &Picture, bad: f32) -> Option<String> {
    if let Some([x, y]) = filtered.differing(expected).into_iter().find(|place| !beside_bad(*place)) {
        return Some(format!("{:?} at {:?} for {:?}", filtered.at(x, y), [x, y], expected.at(x, y)));
    }
    let [width, height] = filtered.size;
    let places_of_all = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let bad_places = places();
    let must_be_finite = |place: &[u32; 2]| bad.is_finite() || !bad_places.contains(place);
    let spread = |[x, y]: &[u32; 2]| !filtered.at(*x, *y).iter().all(|channel| channel.is_finite());
    let place = places_of_all.filter(must_be_finite).find(spread)?;
    Some(format!("{:?} at {place:?}", filtered.at(place[0], place[1])))
}

#[test]
fn bad_pixels_do_not_spread() {
    let gpu = common::gpu();
    let flat = Picture::grey(SIZE, |_, _| 0.4);
    for spec in specs() {
        for surface in [half_float(), float(), linear_light()] {
            let mut filter = Filter::new(&gpu, &spec, SIZE, surface);
            for picture in [&flat, &confetti(SIZE, 3)] {
                for bad in BAD {
                    for channels in [&[0, 1, 2, 3][..], &[0], &[3]] {
                        let expected = filter.apply(&with_stand_ins(picture, bad, channels));
                        let filtered = filter.apply(&with_pixels(picture, bad.0, channels));
                        let fault = fault(&filtered, &expected, bad.0);
                        assert!(fault.is_none(), "{}, {} in {channels:?}: {}", filter.name, bad.0, fault.unwrap_or_default());
                    }
                }
            }
        }
    }
}

#[test]
fn the_largest_floats_do_not_spread() {
    let gpu = common::gpu();
    let mut faults = Vec::new();
    for spec in specs() {
        let mut filter = Filter::new(&gpu, &spec, SIZE, float());
        for bad in [(1e30, 1.0), (f32::MAX, 1.0), (f32::MIN, 0.0)] {
            let expected = filter.apply(&with_stand_ins(&star(SIZE), bad, &[0]));
            let fault = fault(&filter.apply(&with_pixels(&star(SIZE), bad.0, &[0])), &expected, bad.0);
            faults.extend(fault.map(|fault| format!("{}, {:e}: {fault}", filter.name, bad.0)));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_bad_value_that_spreads_is_noticed() {
    let picture = star(SIZE);
    let bad = with_pixels(&picture, f32::NAN, &[0]);
    assert_eq!(fault(&bad, &picture, f32::NAN), None);
    let mut beside = bad.clone();
    beside.at_mut(4, 4)[0] = f32::NAN;
    assert!(beside_bad([4, 4]) && fault(&beside, &picture, f32::NAN).is_some(), "no number beside a bad pixel");
    let mut afar = bad;
    afar.at_mut(6, 7)[0] += 0.001;
    assert!(!beside_bad([6, 7]) && fault(&afar, &picture, f32::NAN).is_some(), "another bit far from one");
}
