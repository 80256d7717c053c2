//! What is known of a sequence before any method is drawn: motion, followed surfaces, what was uncovered.

use dejag::bench::sequence::Course;
use dejag::capture::{GeometryShot, Studio};
use dejag::scene::Tick;

use super::{request, run_specs, scene, spec};
use crate::common;

const SIZE: [u32; 2] = [160, 90];

#[test]
fn the_way_back_and_the_way_forth_of_a_pan_cancel() {
    let (gpu, scene) = (common::gpu(), scene("courtyard"));
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let mut geometry = GeometryShot::new(&studio, SIZE).expect("prepared");
    let still = Tick::of(&scene, 0).opening();
    let now = Tick { shift_px: [0.37, -1.5], previous_shift_px: [0.0; 2], ..still };
    let forth = Tick { shift_px: [0.0; 2], previous_shift_px: [0.37, -1.5], ..still };
    let [now, forth] = [now, forth].map(|tick| geometry.take(&mut studio, &tick).expect("drawn"));
    for (found, expected) in [(&now, [-0.37, 1.5]), (&forth, [0.37, -1.5])] {
        let off = found.motion_px.iter().flat_map(|m| [m[0] - expected[0], m[1] - expected[1]]);
        assert!(off.map(f32::abs).fold(0.0, f32::max) < 1.0 / 256.0);
    }
    assert_eq!(now.ids.len(), 160 * 90);
    assert!(now.depth.iter().all(|depth| (0.0..=1.0).contains(depth)));
}

#[test]
fn most_of_a_moving_scene_is_followed_and_what_was_hidden_is_found() {
    let course = Course { frames: 4..14, ..Course::default() };
    let result = run_specs(&common::gpu(), &scene("pan"), &request(course, [320, 180], "none"), &[spec("none")]);
    let last = &result.frames[9];
    println!("followed over 1 to 4 frames: {:.3?}, uncovered {} pixels", last.followed, last.uncovered);
    assert!(last.followed[0] > 0.9 && last.followed[3] > 0.75, "{:?}", last.followed);
    assert!(last.followed.windows(2).all(|pair| pair[1] < pair[0]));
    assert!(last.uncovered > 500);
    assert_eq!(result.frames[0].uncovered, 0);
}

#[test]
fn a_still_scene_is_followed_everywhere() {
    let result = run_specs(&common::gpu(), &scene("wheel"), &request(Course::still(7, 3), SIZE, "none"), &[spec("none")]);
    assert_eq!(result.frames[2].followed, [1.0, 1.0, 0.0, 0.0]);
    assert!(result.frames.iter().all(|frame| frame.uncovered == 0));
}
