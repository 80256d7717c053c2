//! Beside bevy's TAA, small: `benches/temporal` has all of it.

use dejag::capture::Studio;
use dejag::methods::Spec;
use dejag::pass::{Extras, Technique};
use dejag::scene::Scene;

use super::{PRESETS, psnr, still};
use crate::common;

#[path = "../../../benches/temporal/bevy.rs"]
mod bevy;

const SIZE: [u32; 2] = [64, 36];
const COUNTS: [i64; 3] = [8, 32, 64];

/// PSNR after the counts of frames of a still scene.
fn convergence(studio: &mut Studio<'_>, scene: &Scene, technique: &dyn Technique) -> [f64; 3] {
    let reference = Spec::parse("ssaa:spp=256,pattern=larcher").expect("exists");
    let exact = studio.capture(&reference, 0, SIZE, &mut ()).expect("draws").display;
    let mut shot = studio.shot_of(&[("taa", technique)], 0, SIZE, Extras::default()).expect("builds");
    let mut taken = 0;
    COUNTS.map(|count| {
        for index in taken..count {
            shot.move_to(still(scene, index), index == 0);
            studio.take(&mut shot, None, &mut ()).expect("draws");
        }
        taken = count;
        psnr(&studio.read(&shot).expect("reads").display, &exact)
    })
}

#[test]
fn every_preset_converges_faster_than_bevys() {
    let gpu = common::gpu();
    let scene = Scene::load("edges").expect("shipped");
    let mut studio = Studio::new(&gpu, &scene).expect("uploads");
    let theirs = convergence(&mut studio, &scene, &bevy::BevyTaa);
    println!("bevy's, after {COUNTS:?} frames: {theirs:.2?} dB");
    for preset in PRESETS {
        let spec = Spec::parse(preset).expect("exists");
        let ours = convergence(&mut studio, &scene, &*spec.stages[0].technique);
        println!("{preset}: {ours:.2?} dB");
        assert!(ours.iter().zip(&theirs).all(|(ours, theirs)| ours > theirs), "{preset}: {ours:?}, {theirs:?}");
    }
}
