//! What the measures say of methods whose faults are known.

use dejag::bench::sequence::{Contestant, Course};
use dejag::metrics::Figure;

use super::laggard::Laggard;
use super::{figures, number, overall, request, run, run_specs, scene, spec};
use crate::common;

const SIZE: [u32; 2] = [160, 90];

#[test]
fn a_pan_by_whole_pixels_changes_nothing() {
    let course = Course { frames: 0..6, pan_px: [3.0, -2.0], hold: Some(0), ..Course::default() };
    for name in ["courtyard", "wires"] {
        let result = run_specs(&common::gpu(), &scene(name), &request(course.clone(), SIZE, "ssaa:spp=16"), &[spec("none")]);
        let none = &result.methods[0];
        for gap in 1..=4 {
            let flicker = number(none, &format!("flicker-{gap}"));
            println!("{name}: flicker over {gap} frames {:.4}/255", 255.0 * flicker);
            // A sample that lies on an edge may fall to either side: the projection is rounded anew at each place.
            assert!(flicker.abs() < 0.05 / 255.0, "{name}, gap {gap}: {flicker}");
        }
        assert_eq!(overall(none, "ghost"), Figure::NotApplicable, "{name}: nothing moves against anything");
    }
}

#[test]
fn more_samples_flicker_less_and_break_fewer_lines() {
    let course = Course { frames: 0..8, pan_px: [0.37, 0.0], ..Course::default() };
    let specs = ["none", "ssaa:spp=4,pattern=rotated", "ssaa:spp=64"].map(spec);
    let result = run_specs(&common::gpu(), &scene("wires"), &request(course, [320, 180], "ssaa:spp=256"), &specs);
    let of = |name: &str| result.methods.iter().map(|method| number(method, name)).collect::<Vec<_>>();
    for (name, rises) in [("psnr", true), ("tpsnr", true), ("flicker-1", false), ("flicker-1-p99", false), ("continuity", true)] {
        let found = of(name);
        println!("{name}: {found:.4?}");
        let ordered = found.windows(2).all(|pair| if rises { pair[0] < pair[1] } else { pair[0] > pair[1] });
        assert!(ordered, "{name}: {found:?}");
    }
    // A centre sample has the right light on average, if not in the right places.
    assert!(of("energy").iter().all(|energy| (energy - 1.0).abs() < 0.03), "{:?}", of("energy"));
}

#[test]
fn what_is_kept_of_the_last_picture_is_a_ghost_that_decays_as_it_is_kept() {
    let gpu = common::gpu();
    let course = Course { frames: 0..14, ..Course::default() };
    let (right, half) = (spec("ssaa:spp=16"), Laggard { keep: 0.5 });
    let contestants = [Contestant::of(&right), Contestant { label: "half".into(), techniques: vec![("half", &half)] }];
    let result = run(&gpu, &scene("pan"), &request(course, [320, 180], "ssaa:spp=16"), &contestants);
    let [right, half] = [0, 1].map(|k| &result.methods[k]);
    println!("kept by half: {:?}, flicker {}", figures(half).ghost, number(half, "flicker-1"));
    assert_eq!(figures(right).ghost.trail, Figure::Number(0.0));
    assert_eq!(overall(right, "ghost"), Figure::Number(0.0));
    assert!(number(half, "ghost") > 0.01);
    let ages: Vec<f64> = figures(half).ghost.ages.iter().map(|figure| figure.number().expect("uncovered at all ages")).collect();
    // In linear light half is left after a frame. A display shows more of what is brighter and less of what is darker.
    assert!((0.2..0.8).contains(&ages[0]), "{ages:?}");
    for (k, pair) in ages.windows(2).take(4).enumerate() {
        assert!((0.25..0.75).contains(&(pair[1] / pair[0])), "age {}: {ages:?}", k + 2);
    }
    assert!(number(half, "tpsnr") < number(right, "tpsnr"));
    assert!(number(half, "flicker-1") > 2.0 / 255.0, "surfaces that move through what is kept change all the time");
}

#[test]
fn a_cut_that_is_forgotten_leaves_nothing_behind() {
    let gpu = common::gpu();
    let lag = Laggard { keep: 0.9 };
    let contestant = [Contestant { label: "lag".into(), techniques: vec![("lag", &lag)] }];
    let course = Course { frames: 0..6, cuts: (0..6).collect(), ..Course::default() };
    let result = run(&gpu, &scene("pan"), &request(course, SIZE, "none"), &contestant);
    // It kept nothing, so it is the plain draw; and nothing is compared over a cut.
    assert_eq!(overall(&result.methods[0], "psnr"), Figure::Infinite);
    for name in ["tpsnr", "flicker-1", "flicker-4", "if-ssim", "ghost"] {
        assert_eq!(overall(&result.methods[0], name), Figure::NotApplicable, "{name}");
    }
    assert!(result.frames.iter().all(|frame| frame.reset && frame.followed == [0.0; 4]));
}

#[test]
fn an_open_shutter_is_what_the_reference_sees() {
    let gpu = common::gpu();
    let course = Course { frames: 3..6, ..Course::default() };
    let psnr = |reference: &str| {
        let result =
            run_specs(&gpu, &scene("wheel"), &request(course.clone(), SIZE, reference), &[spec("ssaa:spp=64,shutter=0.5")]);
        number(&result.methods[0], "psnr")
    };
    let (open, closed) = (psnr("ssaa:spp=256,shutter=0.5"), psnr("ssaa:spp=256"));
    println!("against an open shutter {open:.2} dB, against a closed one {closed:.2} dB");
    assert!(open > closed + 5.0);
}
