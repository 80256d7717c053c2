//! A picture that moves by whole pixels is the still one, moved, to the bit.

use std::path::Path;

use dejag::capture::Studio;
use dejag::picture::LinearPicture;
use dejag::scene::Scene;

use super::rig::{Facts, Rig};
use super::{PLAIN, PRESETS, Sequence, panned, still};
use crate::common;

/// Powers of two, so that moving by a pixel is exact in clip space.
const SIZE: [u32; 2] = [128, 64];
const FRAMES: i64 = 12;

/// In whole pixels: slanted edges, thin and broad, in front of the background and of each other.
const SCENE: &str = "
background = [0.1, 0.2, 0.4]
[camera]
projection = 'pixels'
near = 0
far = 20
position = [0, 0, 10]
target = [0, 0, 0]
[[objects]]
rotation_deg = [0, 0, 17]
shape = { quad = { size = [40, 24] } }
material = { color = [0.9, 0.6, 0.2], unlit = true }
[[objects]]
position = [3, -2, 1]
rotation_deg = [0, 0, -31]
shape = { quad = { size = [60, 0.7] } }
material = { color = [0.0, 0.0, 0.1], unlit = true }
[[objects]]
position = [-9, 5, 2]
rotation_deg = [0, 0, 60]
shape = { quad = { size = [9, 30] } }
material = { color = [0.2, 0.8, 0.5], unlit = true }
";

fn last(studio: &mut Studio<'_>, scene: &Scene, spec: &str, step_px: [f64; 2]) -> LinearPicture {
    let mut sequence = Sequence::new(studio, spec, SIZE);
    for index in 0..FRAMES {
        let tick = if step_px == [0.0; 2] { still(scene, index) } else { panned(scene, index, step_px) };
        sequence.take(tick, index == 0);
    }
    sequence.linear()
}

/// Pixels of the moved picture that are not those of the still one, of how many that were looked at.
fn differing(still: &LinearPicture, moved: &LinearPicture, step_px: [f64; 2]) -> [usize; 2] {
    let by = step_px.map(|step| (step * (FRAMES - 1) as f64) as i64);
    let mut found = [0; 2];
    // What came in over the border has been seen for less long; three more pixels hear of it from their neighbours.
    let reach = by.map(|by| by.abs() + 3);
    let [width, height] = SIZE.map(i64::from);
    for y in reach[1]..height - reach[1] {
        for x in reach[0]..width - reach[0] {
            let at = |picture: &LinearPicture, x: i64, y: i64| picture.pixel(x as u32, y as u32).map(f32::to_bits);
            found[1] += 1;
            found[0] += usize::from(at(still, x - by[0], y - by[1]) != at(moved, x, y));
        }
    }
    found
}

fn whole_pixels_are_exact(spec: &str) {
    let gpu = common::gpu();
    let scene = Scene::parse(SCENE, "test.toml", Path::new(".")).expect("a good scene");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let still = last(&mut studio, &scene, spec, [0.0; 2]);
    for step_px in [[1.0, 0.0], [0.0, -1.0], [-2.0, 1.0]] {
        let [different, of] = differing(&still, &last(&mut studio, &scene, spec, step_px), step_px);
        println!("{spec}, {step_px:?} px a frame: {different} of {of} pixels differ");
        assert!(of > 2000 && different == 0, "{spec} by {step_px:?}: {different} of {of}");
    }
    // It would notice: half a pixel is not a whole one.
    let half = last(&mut studio, &scene, spec, [0.5, 0.0]);
    assert!(differing(&still, &half, [0.5, 0.0])[0] > 50);
}

/// With options that are the same at rest and in motion. Halves are rounded by chance, pixel by pixel: only f32 can be the same.
#[test]
fn whole_pixels_of_a_pan_are_exact() {
    whole_pixels_are_exact(&format!("{PLAIN},storage=fp32,most=64,most_motion=64"));
}

#[test]
fn whole_pixels_of_a_clipped_pan_are_exact() {
    for preset in PRESETS {
        whole_pixels_are_exact(&format!("{preset},storage=fp32,most=64,most_motion=64,gamma=1.25,gamma_motion=1.25"));
    }
}

/// What motion vectors lose on their way does not blur: so near to a whole pixel, it is meant.
#[test]
fn nearly_whole_pixels_are_whole() {
    let gpu = common::gpu();
    let place = |i: u32| ((i % SIZE[0]) * 37 % 64) as f32 / 64.0;
    let color = || (0..SIZE[0] * SIZE[1]).map(place).map(|value| [value, value, value, 1.0]).collect();
    let moved = |motion_px: [f32; 2]| {
        let mut rig = Rig::new(&gpu, &format!("{PLAIN},storage=fp32"), SIZE);
        rig.take(&Facts::still(color()));
        rig.take(&Facts::flat([0.0; 3]).moved(motion_px))
    };
    let whole = moved([3.0, -2.0]);
    for near in [[3.0009, -2.0], [2.9991, -2.0009], [3.0, -1.9991]] {
        assert!(moved(near) == whole, "{near:?}");
    }
    assert!(moved([3.002, -2.0]) != whole);
}
