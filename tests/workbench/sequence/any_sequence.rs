//! What holds for every method on any sequence.

use dejag::bench::sequence::{Contestant, Course, run_sequence};
use dejag::capture::Cache;
use dejag::picture::DisplayPicture;
use dejag::scene::Scene;
use dejag::suite::SequenceOutcome;

use super::{Keep, methods, request, run_specs, scene, spec};
use crate::common;

const SIZE: [u32; 2] = [67, 41];

/// The pictures of every method on a sequence.
fn pictures(scene: &Scene, course: Course) -> Keep {
    let (specs, mut keep) = (methods(), Keep::default());
    let contestants: Vec<_> = specs.iter().map(Contestant::of).collect();
    let request = request(course, SIZE, "ssaa:spp=4");
    run_sequence(&common::gpu(), scene, &request, &contestants, &Cache::none(), &mut (), &mut keep).expect("runs");
    assert_eq!(keep.references.len() * specs.len(), keep.methods.len());
    keep
}

fn same(a: &DisplayPicture, b: &DisplayPicture, what: &str) {
    let bits = |picture: &DisplayPicture| picture.pixels().iter().flatten().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert!(bits(a) == bits(b), "{what}");
}

#[test]
fn started_in_the_middle_it_goes_on_as_after_a_cut_there() {
    let scene = scene("pan");
    let pan_px = [0.37, 0.0];
    let whole = pictures(&scene, Course { frames: 3..12, cuts: [7].into(), pan_px, ..Course::default() });
    let middle = pictures(&scene, Course { frames: 7..12, pan_px, ..Course::default() });
    for (method, spec) in methods().iter().enumerate() {
        for index in 7..12 {
            same(whole.picture(method, index), middle.picture(method, index), &format!("{spec}, frame {index}"));
        }
    }
}

#[test]
fn the_same_sequence_twice_is_the_same() {
    let course = Course { frames: 0..4, dropped: [2].into(), ..Course::default() };
    let results: Vec<_> = (0..2)
        .map(|_| {
            let mut result = run_specs(&common::gpu(), &scene("wheel"), &request(course.clone(), SIZE, "ssaa:spp=4"), &methods());
            result.reference.timing.seconds = 0.0;
            for method in &mut result.methods {
                if let SequenceOutcome::Measured(figures) = &mut method.outcome {
                    figures.timing.frame_ms = dejag::suite::Spread::of(vec![0.0]);
                }
            }
            serde_json::to_string(&result).expect("serialisable")
        })
        .collect();
    assert_eq!(results[0], results[1]);
}

#[test]
fn time_that_stands_still_dropped_frames_and_cuts_everywhere_are_no_trouble() {
    let courses = [
        Course { frames: 2..6, step_s: Some(0.0), ..Course::default() },
        Course { frames: 0..7, dropped: [1, 3, 4].into(), ..Course::default() },
        Course { frames: 0..4, cuts: (0..4).collect(), ..Course::default() },
        Course { frames: -3..2, step_s: Some(0.5), pan_px: [-40.0, 17.3], ..Course::default() },
        Course { frames: 62..68, hold: Some(5), ..Course::default() },
    ];
    for course in courses {
        let keep = pictures(&scene("pan"), course.clone());
        for (method, index, picture) in &keep.methods {
            assert!(picture.non_finite().is_none(), "method {method}, frame {index} of {course:?}");
        }
    }
}

#[test]
fn still_time_gives_the_still_picture() {
    let keep = pictures(&scene("pan"), Course { frames: 0..3, step_s: Some(0.0), ..Course::default() });
    let none = methods().iter().position(|spec| spec.to_string() == "none").expect("exists");
    same(keep.picture(none, 0), keep.picture(none, 2), "time stood still");
}

#[test]
fn small_and_odd_sizes_are_no_trouble() {
    for size in [[1, 1], [2, 3], [9, 1], [13, 11]] {
        let course = Course { frames: 0..6, pan_px: [0.5, 0.0], ..Course::default() };
        let result = run_specs(&common::gpu(), &scene("pan"), &request(course, size, "ssaa:spp=4"), &methods());
        for method in &result.methods {
            assert!(matches!(&method.outcome, SequenceOutcome::Measured(f) if f.non_finite.is_none()), "{size:?}: {method:?}");
        }
    }
}

#[test]
fn what_the_adapter_cannot_run_is_an_entry_and_not_the_end() {
    let gpu = common::gpu();
    if gpu.sample_counts().contains(&16) {
        common::not_applicable(&gpu, "what_the_adapter_cannot_run_is_an_entry_and_not_the_end");
        return;
    }
    let course = Course { frames: 0..2, ..Course::default() };
    let specs = [spec("msaa:samples=16"), spec("none")];
    let result = run_specs(&gpu, &scene("pan"), &request(course, SIZE, "ssaa:spp=4"), &specs);
    assert!(matches!(&result.methods[0].outcome, SequenceOutcome::Failed { error } if error.contains("16")));
    assert!(matches!(result.methods[1].outcome, SequenceOutcome::Measured(_)));
}
