//! Sequences again, from the middle, cut, with frames missing, in every size.

use dejag::capture::Studio;
use dejag::methods::Spec;
use dejag::picture::{DisplayPicture, LinearPicture};
use dejag::scene::{Scene, Tick};

use super::{PRESETS, Sequence, psnr, still};
use crate::common;

const SIZE: [u32; 2] = [64, 36];

/// Every preset, and what else keeps something from frame to frame.
const SPECS: [&str; 5] =
    [PRESETS[0], PRESETS[1], PRESETS[2], "taa:reject=depth,background=camera,storage=fp32", "taa:fallback=smaa,sharpen=0.5"];

/// `pan` from one frame to another, cut at some of them.
fn frames(studio: &mut Studio<'_>, scene: &Scene, spec: &str, range: std::ops::Range<i64>, cuts: &[i64]) -> Vec<LinearPicture> {
    let mut sequence = Sequence::new(studio, spec, SIZE);
    let first = range.start;
    let take = |index: i64| {
        let cut = index == first || cuts.contains(&index);
        let tick = Tick::of(scene, index);
        sequence.take(if cut { tick.opening() } else { tick }, cut);
        sequence.linear()
    };
    range.map(take).collect()
}

fn in_pan(test: impl Fn(&mut Studio<'_>, &Scene)) {
    let gpu = common::gpu();
    let scene = Scene::load("pan").expect("shipped");
    test(&mut Studio::new(&gpu, &scene).expect("uploads"), &scene);
}

#[test]
fn the_same_frames_give_the_same_bytes() {
    in_pan(|studio, scene| {
        for spec in SPECS {
            let [once, again] = [(); 2].map(|()| frames(studio, scene, spec, 0..7, &[]));
            assert!(once == again, "{spec}");
        }
    });
}

#[test]
fn the_middle_after_a_cut_is_a_beginning() {
    in_pan(|studio, scene| {
        for spec in SPECS {
            let whole = frames(studio, scene, spec, 0..9, &[4]);
            assert!(whole[4..] == frames(studio, scene, spec, 4..9, &[])[..], "{spec}");
            // So this test sees what it is meant to see.
            assert!(whole[4] != frames(studio, scene, spec, 0..5, &[])[4], "{spec}");
        }
    });
}

#[test]
fn a_cut_each_frame_is_a_beginning_each_frame() {
    in_pan(|studio, scene| {
        for spec in SPECS {
            let cut = frames(studio, scene, spec, 0..3, &[1, 2]);
            for index in 1..3 {
                assert!(cut[index as usize] == frames(studio, scene, spec, index..index + 1, &[])[0], "{spec} at {index}");
            }
        }
    });
}

fn reference(studio: &mut Studio<'_>, tick: Tick) -> DisplayPicture {
    let mut shot = studio.shot(&Spec::parse("ssaa:spp=64").expect("exists"), 0, SIZE).expect("builds");
    shot.move_to(tick, true);
    studio.take(&mut shot, None, &mut ()).expect("draws");
    studio.read(&shot).expect("reads").display
}

/// The frame after a gap is nearer to its reference than one that begins anew, or nearly: what smears would be farther.
#[test]
fn a_dropped_frame_leaves_no_smear() {
    in_pan(|studio, scene| {
        let last = Tick::of(scene, 9);
        let exact = reference(studio, last);
        for spec in SPECS {
            let mut of = |gap: i64| {
                let mut sequence = Sequence::new(studio, spec, SIZE);
                (0..9 - gap).for_each(|index| sequence.take(Tick::of(scene, index), index == 0));
                let previous_time_s = Tick::of(scene, 9 - gap).previous_time_s;
                sequence.take(Tick { previous_time_s, ..last }, false);
                psnr(&sequence.display(), &exact)
            };
            let found = [0, 1, 3].map(&mut of);
            let mut anew = Sequence::new(studio, spec, SIZE);
            anew.take(last, true);
            let anew = psnr(&anew.display(), &exact);
            println!("{spec}: {found:.2?} dB after no, one and three dropped frames, {anew:.2} dB begun anew");
            assert!(found.iter().all(|found| *found > anew - 0.5), "{spec}: {found:?}, {anew} begun anew");
        }
    });
}

/// Time that stands still is a still picture.
#[test]
fn no_time_between_frames_leaves_no_smear() {
    in_pan(|studio, scene| {
        let now = Tick { previous_time_s: Tick::of(scene, 6).time_s, step_s: 0.0, ..Tick::of(scene, 6) };
        let exact = reference(studio, now);
        for spec in SPECS {
            let mut sequence = Sequence::new(studio, spec, SIZE);
            (0..=6).for_each(|index| sequence.take(Tick::of(scene, index), index == 0));
            let before = psnr(&sequence.display(), &exact);
            (7..23).for_each(|index| sequence.take(Tick { index, ..now }, false));
            let after = psnr(&sequence.display(), &exact);
            println!("{spec}: {before:.2} dB in motion, {after:.2} dB after 16 frames without time");
            assert!(after > before, "{spec}: {before}, {after}");
        }
    });
}

/// Another size is another pass: what one has seen is nothing to the other.
#[test]
fn another_size_begins_anew() {
    in_pan(|studio, scene| {
        for spec in SPECS {
            let alone = frames(studio, scene, spec, 5..8, &[]);
            let mut small = Sequence::new(studio, spec, [40, 23]);
            (0..5).for_each(|index| small.take(Tick::of(scene, index), index == 0));
            assert!(frames(studio, scene, spec, 5..8, &[]) == alone, "{spec}");
        }
    });
}

#[test]
fn small_and_odd_sizes_work() {
    let gpu = common::gpu();
    let scene = Scene::load("wires").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    for size in [[1, 1], [3, 5], [17, 2]] {
        for spec in &SPECS[2..] {
            let mut sequence = Sequence::new(&mut studio, spec, size);
            for index in 0..5 {
                let tick = if index < 3 { still(&scene, index) } else { super::panned(&scene, index, [0.7, -1.3]) };
                sequence.take(tick, index == 0);
                assert!(sequence.linear().non_finite().is_none(), "{spec} {size:?}");
            }
        }
    }
}
