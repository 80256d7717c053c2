//! Options change pictures the way their help texts say. One that no test turns fails here.

mod boxes;
mod counts;
mod places;
mod samples;

use dejag::gpu::Gpu;
use dejag::methods::METHODS;
use dejag::picture::Pixel;

use super::rig::{Facts, Rig};
use crate::common;

const SIZE: [u32; 2] = [32, 18];

/// An option, and what must be true of it.
type Knob = (&'static str, fn(&Gpu));

/// In the options' own order.
const KNOBS: [Knob; 23] = [
    ("preset", samples::later_presets_are_nearer_to_the_reference),
    ("jitter", samples::jitters_are_the_patterns_points),
    ("cycle", samples::jitters_repeat_after_the_cycle),
    ("input", samples::filters_spread_a_sample),
    ("limit", samples::limits_cut_fireflies),
    ("weight", samples::weights_lose_light),
    ("dilation", places::dilation_follows_what_is_near),
    ("background", places::the_background_moves_as_the_camera),
    ("motion", places::halves_lose_a_part_of_a_pixel),
    ("history", places::wider_filters_keep_contrast),
    ("storage", samples::halves_are_right_in_the_mean_only),
    ("space", boxes::boxes_along_brightness_take_colour),
    ("clip", boxes::history_goes_into_the_box),
    ("box", boxes::boxes_are_as_wide_as_they_say),
    ("gamma", boxes::gamma_widens_the_box_at_rest),
    ("gamma_motion", boxes::gamma_motion_widens_the_box_in_motion),
    ("memory", boxes::a_longer_memory_keeps_more),
    ("most", counts::a_frame_counts_one_in_most),
    ("most_motion", counts::a_frame_in_motion_counts_one_in_most_motion),
    ("reject", places::what_was_of_another_surface_is_refused),
    ("depth_step", places::a_larger_depth_step_refuses_less),
    ("sharpen", counts::sharpening_steepens_edges),
    ("fallback", counts::only_what_has_no_history_is_smoothed),
];

/// A plain mean in f32 of frames sampled at the centre.
const BASE: &str = "taa:limit=0,weight=none,storage=fp32,cycle=1,most=64,most_motion=64,sharpen=0";

/// What is made of history that has no part in the frame: two frames, the second `now`. Twice the mean less the second frame.
fn history_read(gpu: &Gpu, options: &str, past: &Facts, now: &Facts) -> Vec<Pixel> {
    let mut rig = Rig::new(gpu, &format!("{BASE},{options}"), SIZE);
    rig.take(past);
    let mean = rig.take(now);
    let own = |i: usize| if now.color.len() == 1 { now.color[0] } else { now.color[i] };
    mean.iter().enumerate().map(|(i, mean)| std::array::from_fn(|c| 2.0 * mean[c] - own(i)[c])).collect()
}

fn picture(at: impl Fn(u32, u32) -> f32) -> Vec<Pixel> {
    let place = |i: u32| (i % SIZE[0], i / SIZE[0]);
    (0..SIZE[0] * SIZE[1]).map(place).map(|(x, y)| at(x, y)).map(|value| [value, value, value, 1.0]).collect()
}

/// Two greys by turns.
fn checkered(dark: f32, bright: f32) -> Vec<Pixel> {
    picture(|x, y| if (x + y) % 2 == 0 { dark } else { bright })
}

/// Of a pixel far from the borders, with even coordinates.
const MIDDLE: usize = (8 * SIZE[0] + 16) as usize;

fn close(found: f32, expected: f32) -> bool {
    (found - expected).abs() < 2e-3
}

#[test]
fn taa_does_what_its_options_say() {
    let gpu = common::gpu();
    for (option, test) in KNOBS {
        println!("{option}");
        test(&gpu);
    }
}

#[test]
fn every_option_is_turned() {
    let taa = METHODS.iter().find(|method| method.name == "taa").expect("exists");
    let options: Vec<_> = taa.options.iter().map(|option| option.name).collect();
    assert_eq!(KNOBS.map(|(option, _)| option).to_vec(), options);
}
