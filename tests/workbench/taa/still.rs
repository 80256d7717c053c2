//! A still picture converges as supersampling with the same jitters does.

use dejag::capture::Studio;
use dejag::methods::Spec;
use dejag::picture::{DisplayPicture, LinearPicture};
use dejag::scene::Scene;

use super::{PLAIN, PRESETS, Sequence, psnr, single, still};
use crate::common;

const SIZE: [u32; 2] = [64, 36];
const COUNTS: [i64; 5] = [8, 16, 32, 64, 256];

fn reference(studio: &mut Studio<'_>) -> DisplayPicture {
    let spec = Spec::parse("ssaa:spp=256,pattern=larcher").expect("exists");
    studio.capture(&spec, 0, SIZE, &mut ()).expect("draws").display
}

/// PSNR of a method after each of the counts of frames.
fn after_frames(studio: &mut Studio<'_>, scene: &Scene, spec: &str, reference: &DisplayPicture) -> [f64; 5] {
    let mut sequence = Sequence::new(studio, spec, SIZE);
    let mut taken = 0;
    COUNTS.map(|count| {
        (taken..count).for_each(|index| sequence.take(still(scene, index), index == 0));
        taken = count;
        psnr(&sequence.display(), reference)
    })
}

/// PSNR of the mean of so many single draws, made in f64.
fn of_means(studio: &mut Studio<'_>, scene: &Scene, cycle: u32, reference: &DisplayPicture) -> [f64; 5] {
    let draws = single::draws(studio, scene, cycle, SIZE);
    COUNTS.map(|count| {
        let mean = LinearPicture::new(SIZE[0], SIZE[1], single::mean(&draws, count as usize)).expect("fits");
        psnr(&studio.display_of(&mean).expect("shows"), reference)
    })
}

fn converges_as_supersampling_does(name: &str) {
    let gpu = common::gpu();
    let scene = Scene::load(name).expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let reference = reference(&mut studio);
    let mut worst: f64 = 0.0;
    for (cycle, storages) in [(16, &["fp16"][..]), (64, &["fp16", "fp32"])] {
        let exact = of_means(&mut studio, &scene, cycle, &reference);
        println!("{name}, cycle={cycle}, after {COUNTS:?}: means in f64 {exact:.3?} dB");
        for storage in storages {
            let spec = format!("{PLAIN},most=256,cycle={cycle},storage={storage}");
            let found = after_frames(&mut studio, &scene, &spec, &reference);
            println!("{name}, cycle={cycle}, {storage}: {found:.3?} dB");
            worst = found.iter().zip(&exact).map(|(found, exact)| (found - exact).abs()).fold(worst, f64::max);
        }
    }
    println!("{name}: {worst:.4} dB apart at most");
    assert!(worst < 0.1, "{name}: {worst} dB from the mean of the same draws");
    for preset in PRESETS {
        let found = after_frames(&mut studio, &scene, preset, &reference);
        println!("{name}, {preset}: {found:.2?} dB");
        // From `most` on frames count by their age, and the box holds what one frame shows against what earlier ones did: that costs
        // less than a decibel of the best there was.
        let best = found.iter().copied().fold(0.0, f64::max);
        assert!(found[4] > best - 1.0, "{preset} gets worse: {found:?}");
    }
}

#[test]
fn edges_converge_as_supersampling_does() {
    converges_as_supersampling_does("edges");
}

#[test]
fn the_courtyard_converges_as_supersampling_does() {
    converges_as_supersampling_does("courtyard");
}
