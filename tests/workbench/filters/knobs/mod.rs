//! Options change pictures the way their help texts say. One that no test turns fails here.

mod color;
mod geometry;
mod lines;
mod modes;
mod multisampled;
mod pictures;

use dejag::gpu::Gpu;

use super::picture::Picture;
use super::{Filter, eight_bit, filters};
use crate::common;

/// An option, and what must be true of it; for options that several methods share, with the method's name.
type Knob = (&'static str, fn(&Lab, &str));

const KNOBS: [(&str, &[Knob]); 4] = [
    (
        "fxaa",
        &[
            ("preset", lines::fxaa_presets_follow_longer_edges),
            ("steps", lines::more_steps_follow_longer_edges),
            ("subpix", color::subpix_fades_single_pixels),
            ("threshold", color::lower_thresholds_find_fainter_edges),
            ("threshold_min", color::threshold_min_spares_dark_places),
            ("luma", color::green_luma_sees_green_alone),
            ("blend", color::light_is_brighter_than_coded_values),
        ],
    ),
    (
        "mlaa",
        &[
            ("edges", geometry::edges_are_what_they_are_of),
            ("threshold", color::lower_thresholds_find_fainter_edges),
            ("depth_step", geometry::a_higher_depth_step_misses_shallow_steps),
            ("max_search", lines::longer_searches_smooth_longer_lines),
            ("blend", color::light_is_brighter_than_coded_values),
        ],
    ),
    (
        "smaa",
        &[
            ("preset", lines::smaa_presets_are_what_they_stand_for),
            ("edges", geometry::edges_are_what_they_are_of),
            ("threshold", color::lower_thresholds_find_fainter_edges),
            ("search", lines::longer_searches_smooth_longer_lines),
            ("diag", lines::diagonals_are_nearer_to_exact_coverage),
            ("corner", lines::corners_stay_sharper_unrounded),
            ("contrast", color::stronger_neighbours_take_edges),
            ("depth_step", geometry::a_higher_depth_step_misses_shallow_steps),
            ("predication", geometry::predication_spares_textures),
            ("scale", geometry::scale_raises_the_threshold),
            ("strength", geometry::strength_takes_it_back_at_silhouettes),
            ("blend", color::light_is_brighter_than_coded_values),
            ("mode", modes::more_samples_are_nearer_to_the_reference),
            ("reproject", modes::followed_motion_is_nearer_to_the_reference),
            ("velocity_scale", modes::a_change_of_speed_takes_weight),
        ],
    ),
    (
        "cmaa2",
        &[
            ("preset", color::cmaa2_presets_are_thresholds),
            ("threshold", color::lower_thresholds_find_fainter_edges),
            ("sharp", color::sharp_blends_less),
            ("blend", color::light_is_brighter_than_coded_values),
        ],
    ),
];

/// Where options are tried.
struct Lab {
    gpu: Gpu,
}

impl Lab {
    fn filtered(&self, spec: &str, picture: &Picture) -> Picture {
        Filter::new(&self.gpu, spec, picture.size, eight_bit()).apply(picture)
    }

    /// How many pixels a filter changes.
    fn changed(&self, spec: &str, picture: &Picture) -> usize {
        let stored = picture.map(|pixel| pixel.map(|value| (value * 255.0).round() / 255.0));
        let changed = self.filtered(spec, picture).differing(&stored).len();
        println!("{spec}: {changed} pixels changed");
        changed
    }

    /// How many are changed with each of an option's values.
    fn changed_by<const N: usize>(&self, option: &str, values: [&str; N], picture: &Picture) -> [usize; N] {
        values.map(|value| self.changed(&format!("{option}={value}"), picture))
    }
}

fn turn_all(method: &str) {
    let lab = Lab { gpu: common::gpu() };
    let (_, knobs) = KNOBS.iter().find(|(name, _)| *name == method).expect("has knobs");
    for (option, test) in *knobs {
        println!("{method}: {option}");
        test(&lab, method);
    }
}

#[test]
fn fxaa_does_what_its_options_say() {
    turn_all("fxaa");
}

#[test]
fn mlaa_does_what_its_options_say() {
    turn_all("mlaa");
}

#[test]
fn smaa_does_what_its_options_say() {
    turn_all("smaa");
}

#[test]
fn cmaa2_does_what_its_options_say() {
    turn_all("cmaa2");
}

#[test]
fn every_option_is_turned() {
    for method in filters() {
        let options: Vec<_> = method.options.iter().map(|option| option.name).collect();
        let knobs = KNOBS.iter().find(|(name, _)| *name == method.name).map_or(&[][..], |(_, knobs)| *knobs);
        assert_eq!(knobs.iter().map(|(option, _)| *option).collect::<Vec<_>>(), options, "{}", method.name);
    }
}
