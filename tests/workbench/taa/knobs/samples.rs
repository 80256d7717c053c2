//! Where frames are sampled, and what a sample counts.

use dejag::capture::Studio;
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::sampling::{FILTERS, PATTERNS, jitter_cycle};
use dejag::scene::Scene;

use super::super::rig::{Facts, Rig};
use super::super::{PRESETS, Sequence, psnr, still};
use super::{BASE, MIDDLE, SIZE, close, picture};

pub(super) fn later_presets_are_nearer_to_the_reference(gpu: &Gpu) {
    const SIZE: [u32; 2] = [64, 36];
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(gpu, &scene).expect("uploads");
    let reference = Spec::parse("ssaa:spp=144").expect("exists");
    let exact = studio.capture(&reference, 0, SIZE, &mut ()).expect("draws").display;
    let found = PRESETS.map(|preset| {
        let mut sequence = Sequence::new(&mut studio, preset, SIZE);
        (0..64).for_each(|index| sequence.take(still(&scene, index), index == 0));
        psnr(&sequence.display(), &exact)
    });
    println!("fast, balanced, quality after 64 still frames: {found:.2?} dB");
    assert!(found.is_sorted_by(|worse, better| worse + 0.5 < *better), "{found:?}");
}

fn jitters(gpu: &Gpu, options: &str, count: u32) -> Vec<[f32; 2]> {
    let mut rig = Rig::new(gpu, &format!("taa:{options}"), [1, 1]);
    (0..count)
        .map(|index| {
            rig.frame.index = index;
            rig.jitter_px()
        })
        .collect()
}

pub(super) fn jitters_are_the_patterns_points(gpu: &Gpu) {
    for pattern in PATTERNS.iter().step_by(3) {
        let expected: Vec<[f32; 2]> = jitter_cycle(pattern, 16, 0).iter().map(|p| p.map(|x| x as f32)).collect();
        assert_eq!(jitters(gpu, &format!("jitter={},cycle=16", pattern.name), 16), expected, "{}", pattern.name);
    }
}

pub(super) fn jitters_repeat_after_the_cycle(gpu: &Gpu) {
    for cycle in [1, 5, 16] {
        let found = jitters(gpu, &format!("cycle={cycle}"), 3 * cycle);
        let first = &found[..cycle as usize];
        assert!(found.chunks(cycle as usize).all(|again| again == first), "{cycle}");
        assert!((1..first.len()).all(|i| !first[..i].contains(&first[i])), "{cycle}: {first:?}");
    }
}

pub(super) fn filters_spread_a_sample(gpu: &Gpu) {
    let spot = Facts::still(picture(|x, y| if (x, y) == (16, 8) { 1.0 } else { 0.0 }));
    for filter in FILTERS {
        let found = Rig::new(gpu, &format!("{BASE},input={}", filter.name), SIZE).take(&spot);
        let [own, beside] = [found[MIDDLE][0], found[MIDDLE + 1][0]];
        println!("input={}: {own:.3} where the sample is, {beside:.3} beside", filter.name);
        match filter.name {
            "box" => assert_eq!([own, beside], [1.0, 0.0]),
            // Weights as the filter has them, of the nine pixels that are looked at.
            name => {
                let weight = |dx: i32, dy: i32| filter.weight([f64::from(dx), f64::from(dy)], filter.default_radius_px.min(1.5));
                let sum: f64 = (0..9).map(|i| weight(i % 3 - 1, i / 3 - 1)).sum();
                let expected = [weight(0, 0), weight(1, 0).max(0.0)].map(|weight| (weight / sum) as f32);
                assert!(close(own, expected[0]) && close(beside, expected[1]), "{name}: {own}, {beside}, {expected:?}");
            }
        }
    }
}

pub(super) fn limits_cut_fireflies(gpu: &Gpu) {
    let spot = Facts::still(picture(|x, y| if (x, y) == (16, 8) { 100.0 } else { 0.5 }));
    let with = |limit: &str| Rig::new(gpu, &format!("taa:cycle=1,limit={limit}"), SIZE).take(&spot)[MIDDLE][0];
    let found = ["0", "1", "4", "40"].map(with);
    // Half the brightness all around, so many times; what is no brighter than white is left.
    for (found, expected) in found.into_iter().zip([100.0, 1.0, 2.0, 20.0]) {
        assert!((found / expected - 1.0).abs() < 2e-3, "{found} instead of {expected}");
    }
}

pub(super) fn weights_lose_light(gpu: &Gpu) {
    let with = |weight: &str| {
        let mut rig = Rig::new(gpu, &format!("taa:limit=0,clip=off,sharpen=0,most=64,weight={weight}"), SIZE);
        let [dark, bright] = [0.0, 10.0].map(|value| rig.upload(&Facts::flat([value; 3])));
        (0..16).for_each(|i| rig.show(if i % 2 == 0 { &dark } else { &bright }));
        rig.pixels()[MIDDLE][0]
    };
    let found = ["none", "highlights", "luma"].map(with);
    println!("dark and ten times white by turns: {found:.3?} with weight=none, highlights, luma");
    assert!((found[0] - 5.0).abs() < 0.02 && found[1] < 2.0 && found[2] < found[1] - 0.05, "{found:?}");
}

pub(super) fn halves_are_right_in_the_mean_only(gpu: &Gpu) {
    const VALUE: f32 = 0.100_03;
    let off = |storage: &str| {
        let found = Rig::new(gpu, &format!("taa:limit=0,storage={storage}"), SIZE).take(&Facts::flat([VALUE; 3]));
        let errors: Vec<f32> = found.iter().map(|pixel| pixel[0] - VALUE).collect();
        let mean = errors.iter().sum::<f32>() / errors.len() as f32;
        [errors.iter().fold(0.0, |worst: f32, error| worst.max(error.abs())), mean.abs()]
    };
    let [halves, floats] = ["fp16", "fp32"].map(off);
    println!("largest error and mean one: {halves:?} in halves, {floats:?} in floats");
    assert!(floats[0] < 1e-7 && halves[0] > 1e-5 && halves[0] < VALUE / 1024.0 && halves[1] < halves[0] / 8.0);
}
