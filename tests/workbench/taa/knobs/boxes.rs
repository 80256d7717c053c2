//! The box that history is held against.

use dejag::gpu::Gpu;

use super::super::rig::Facts;
use super::{MIDDLE, SIZE, checkered, close, history_read, picture};

/// What is left of a flat past at the middle pixel.
fn left(gpu: &Gpu, options: &str, past: [f32; 3], now: &Facts) -> [f32; 3] {
    let [r, g, b, _] = history_read(gpu, options, &Facts::flat(past), now)[MIDDLE];
    [r, g, b]
}

pub(super) fn boxes_along_brightness_take_colour(gpu: &Gpu) {
    // Greys around: in each channel the past is one of them, its colour is not.
    let now = Facts::still(checkered(0.2, 0.8));
    let with = |space: &str| {
        let [r, _, b] = left(gpu, &format!("clip=clamp,box=minmax,memory=0,space={space}"), [0.75, 0.3, 0.3], &now);
        r - b
    };
    let found = ["rgb", "ycocg"].map(with);
    println!("red over blue: {found:.4?} in RGB and YCoCg");
    assert!(close(found[0], 0.45) && found[1].abs() < 0.02, "{found:?}");
}

pub(super) fn history_goes_into_the_box(gpu: &Gpu) {
    let now = Facts::still(checkered(0.4, 0.6));
    for (clip, expected) in [("off", [0.9, 0.5, 0.3]), ("clamp", [0.6, 0.5, 0.4]), ("clip", [0.6, 0.5, 0.45])] {
        let found = left(gpu, &format!("space=rgb,box=minmax,memory=0,clip={clip}"), [0.9, 0.5, 0.3], &now);
        assert!((0..3).all(|c| close(found[c], expected[c])), "{clip}: {found:?} instead of {expected:?}");
    }
}

/// A dark picture with bright spots, so that of the middle pixel's 3 x 3 one corner is bright.
fn with_a_bright_corner() -> Facts {
    Facts::still(picture(|x, y| if x % 3 == 2 && y % 3 == 0 { 1.0 } else { 0.2 }))
}

fn upper_side(gpu: &Gpu, options: &str, now: &Facts) -> f32 {
    left(gpu, &format!("space=rgb,clip=clamp,memory=0,{options}"), [2.0; 3], now)[0]
}

pub(super) fn boxes_are_as_wide_as_they_say(gpu: &Gpu) {
    const BOXES: [&str; 4] = ["minmax", "rounded", "variance", "both"];
    let now = with_a_bright_corner();
    let with = |gamma: f32| BOXES.map(|name| upper_side(gpu, &format!("box={name},gamma={gamma}"), &now));
    let (mean, deviation) = (0.2 + 0.8 / 9.0, 0.8 * 8.0_f32.sqrt() / 9.0);
    let [narrow, wide] = [1.0, 3.0].map(with);
    println!("{BOXES:?} reach up to {narrow:.3?} with gamma=1, {wide:.3?} with 3");
    let expected = |gamma: f32| [1.0, 0.6, mean + gamma * deviation, 1.0_f32.min(mean + gamma * deviation)];
    for (found, gamma) in [(narrow, 1.0), (wide, 3.0)] {
        assert!(found.iter().zip(expected(gamma)).all(|(found, expected)| close(*found, expected)), "gamma={gamma}: {found:?}");
    }
}

pub(super) fn gamma_widens_the_box_at_rest(gpu: &Gpu) {
    let side = |gamma: &str, now: &Facts| upper_side(gpu, &format!("box=variance,gamma_motion=1,gamma={gamma}"), now);
    let (still, moved) = (with_a_bright_corner(), with_a_bright_corner().moved([2.0, 0.0]));
    let found = ["0.5", "1", "2"].map(|gamma| side(gamma, &still));
    assert!(found.is_sorted_by(|narrow, wide| narrow + 0.05 < *wide), "{found:?}");
    assert!(close(side("0.5", &moved), side("2", &moved)), "in motion it is another's");
}

pub(super) fn gamma_motion_widens_the_box_in_motion(gpu: &Gpu) {
    let side = |gamma: &str, now: &Facts| upper_side(gpu, &format!("box=variance,gamma=1,gamma_motion={gamma}"), now);
    let (still, moved) = (with_a_bright_corner(), with_a_bright_corner().moved([2.0, 0.0]));
    let found = ["0.5", "1", "2"].map(|gamma| side(gamma, &moved));
    assert!(found.is_sorted_by(|narrow, wide| narrow + 0.05 < *wide), "{found:?}");
    assert!(close(side("0.5", &still), side("2", &still)), "at rest it is another's");
}

pub(super) fn a_longer_memory_keeps_more(gpu: &Gpu) {
    // What was there of bright things is seen no more.
    let (past, now) = (Facts::still(checkered(0.8, 0.2)), Facts::flat([0.2; 3]));
    let with = |memory: &str| {
        let options = format!("space=rgb,clip=clamp,box=minmax,memory={memory}");
        history_read(gpu, &options, &past, &now)[MIDDLE][0]
    };
    let found = ["0", "2", "8", "64"].map(with);
    println!("of 0.8 there is {found:.3?} left with memory=0, 2, 8, 64 at {SIZE:?}");
    assert!(found.is_sorted_by(|less, more| less + 0.02 < *more) && found[0] < 0.21 && found[3] < 0.81, "{found:?}");
}
