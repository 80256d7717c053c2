//! What is kept from frame to frame: nothing that a cut, a dropped or a repeated frame could show.

use dejag::capture::Studio;
use dejag::gpu::Gpu;
use dejag::picture::DisplayPicture;
use dejag::scene::{Scene, Tick};

use super::{Sequence, moving};
use crate::common;

const SIZE: [u32; 2] = [160, 90];
const TEMPORAL: [&str; 4] =
    ["smaa:mode=t2x", "smaa:mode=4x", "smaa:mode=t2x,reproject=off", "smaa:mode=4x,preset=ultra,edges=depth,blend=coded"];

/// Frames of `pan`, where camera and objects move by themselves; after each, whether it is a cut.
fn frames(gpu: &Gpu, method: &str, frames: &[(u32, bool)]) -> Vec<DisplayPicture> {
    let scene = Scene::load("pan").expect("shipped");
    let mut studio = Studio::new(gpu, &scene).expect("uploads");
    let mut sequence = Sequence::new(&mut studio, method, SIZE);
    frames.iter().map(|(frame, reset)| sequence.take(Tick::of(&scene, (*frame).into()), *reset)).collect()
}

#[test]
fn the_same_frames_are_the_same_wherever_a_sequence_starts() {
    let gpu = common::gpu();
    for method in TEMPORAL {
        let whole = frames(&gpu, method, &[(0, true), (1, false), (2, false), (3, true), (4, false), (5, false)]);
        let again = frames(&gpu, method, &[(0, true), (1, false), (2, false), (3, true), (4, false), (5, false)]);
        assert!(whole == again, "{method}: twice the same");
        let late = frames(&gpu, method, &[(3, true), (4, false), (5, false)]);
        assert!(whole[3..] == late, "{method}: a cut leaves nothing of what came before");
        let uncut = frames(&gpu, method, &[(0, true), (1, false), (2, false), (3, false)]);
        assert!(whole[3] != uncut[3], "{method}: without a cut something is left");
    }
}

/// As after a cut, so there is no smear: motion vectors lead to a frame that was never taken.
#[test]
fn after_a_dropped_frame_there_is_no_history() {
    let gpu = common::gpu();
    for method in TEMPORAL {
        let dropped = frames(&gpu, method, &[(0, true), (1, false), (3, false), (4, false)]);
        let cut = frames(&gpu, method, &[(3, true), (4, false)]);
        assert!(dropped[2..] == cut, "{method}");
        // The frame between two that are far apart, and back in time.
        let back = frames(&gpu, method, &[(5, true), (4, false)]);
        assert!(back[1] == frames(&gpu, method, &[(4, true)])[0], "{method}");
    }
}

#[test]
fn a_repeated_frame_is_the_same_picture() {
    let gpu = common::gpu();
    for method in TEMPORAL {
        let once = frames(&gpu, method, &[(0, true), (1, false), (2, false)]);
        let repeated = frames(&gpu, method, &[(0, true), (1, false), (1, false), (1, false), (2, false)]);
        assert!(repeated[1] == once[1] && repeated[2] == once[1] && repeated[3] == once[1] && repeated[4] == once[2], "{method}");
    }
}

#[test]
fn the_frames_index_may_wrap() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    // The index is the tick's, in 32 bits.
    let last = i64::from(u32::MAX);
    let mut sequence = Sequence::new(&mut studio, "smaa:mode=t2x", SIZE);
    let wrapped = [last, last + 1].map(|index| sequence.take(moving(&scene, index, [0.0; 2]), index == last));
    let mut sequence = Sequence::new(&mut studio, "smaa:mode=t2x", SIZE);
    let plain = [1, 2].map(|index| sequence.take(moving(&scene, index, [0.0; 2]), index == 1));
    assert!(wrapped == plain);
}

/// Both frames count alike, so their order cannot be seen.
#[test]
fn a_still_picture_does_not_flicker() {
    let gpu = common::gpu();
    let scene = Scene::load("wires").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    for method in ["smaa:mode=t2x", "smaa:mode=4x"] {
        let mut sequence = Sequence::new(&mut studio, method, SIZE);
        let frames: Vec<_> = (0..6).map(|index| sequence.take(moving(&scene, index, [0.0; 2]), index == 0)).collect();
        assert!(frames[0] != frames[1], "{method}: the first has no history");
        assert!(frames[1..].windows(2).all(|pair| pair[0] == pair[1]), "{method}");
    }
}

/// Moved by whole pixels, the frame before is found pixel by pixel: as if nothing had moved.
#[test]
fn whole_pixels_are_found() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    for method in ["smaa:mode=t2x,velocity_scale=0", "smaa:mode=4x", "smaa:mode=4x,velocity_scale=80"] {
        let mut sequence = Sequence::new(&mut studio, method, SIZE);
        let moved = (4..7).map(|index| sequence.take(moving(&scene, index, [3.0, -2.0]), index == 4)).last().expect("some");
        let mut sequence = Sequence::new(&mut studio, method, SIZE);
        let standing =
            |index| Tick { shift_px: moving(&scene, 6, [3.0, -2.0]).shift_px, ..moving(&scene, index, [0.0; 2]) }.opening();
        let still = (4..7).map(|index| sequence.take(standing(index), index == 4)).last().expect("some");
        let mut differing = 0;
        for y in 4..SIZE[1] - 4 {
            for x in 4..SIZE[0] - 4 {
                differing += u32::from(moved.pixel(x, y) != still.pixel(x, y));
            }
        }
        println!("{method}: {differing} pixels differ");
        // Where an edge goes right through a sample, the rasteriser may take it for either side.
        assert!(differing <= 30, "{method}: {differing}");
    }
}

/// What an object uncovers shows nothing of it a frame later.
#[test]
fn what_comes_into_view_is_not_mixed_with_what_went() {
    let gpu = common::gpu();
    let scene = Scene::parse(PASSING, "test.toml", std::path::Path::new(".")).expect("a good scene");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let mut smear = |method: &str| {
        let mut sequence = Sequence::new(&mut studio, method, SIZE);
        let picture = (0..3).map(|index| sequence.take(Tick::of(&scene, index), index == 0)).last().expect("some");
        let row: Vec<f32> = (0..SIZE[0]).map(|x| picture.pixel(x, SIZE[1] / 2)[0]).collect();
        let object = row.iter().rposition(|value| *value > 0.5).expect("the object") + 1 - OBJECT_PX;
        // It has left as many pixels as it has moved; those beside an edge are mixed of what is on both sides.
        row[object - STEP_PX + 2..object - 2].iter().fold(0.0, |a: f32, b| a.max(*b))
    };
    let [followed, in_place] = ["smaa:mode=t2x", "smaa:mode=t2x,reproject=off"].map(&mut smear);
    println!("behind an object: {followed:.3}, without motion vectors {in_place:.3}");
    assert!(followed < 0.002 && in_place > 0.3, "{followed}, {in_place}");
}

const OBJECT_PX: usize = 20;
const STEP_PX: usize = 16;

/// A unit is a pixel.
const PASSING: &str = "
background = '#000000'
time_step = 1
frames = 4
[camera]
projection = 'orthographic'
height = 90
near = 0
far = 20
position = [0, 0, 10]
target = [0, 0, 0]
[[objects]]
position = [-40, 0, 0]
shape = { quad = { size = [20, 40] } }
material = { color = '#ffffff', unlit = true }
motion = { velocity = [16, 0, 0] }
";
