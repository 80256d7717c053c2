//! More samples are nearer to the reference, still and in motion.

use dejag::capture::{Cache, Studio};
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::metrics::{Pair, find};
use dejag::scene::{Scene, Tick};

use super::{Sequence, moving};
use crate::common;

const SIZE: [u32; 2] = [640, 360];
const MODES: [&str; 4] = ["1x", "s2x", "t2x", "4x"];

/// Frames that are looked at, after one that is not.
const FRAMES: std::ops::Range<i64> = 4..7;

/// PSNR in dB and mean FLIP of each mode, over the frames.
fn figures(gpu: &Gpu, scene: &str, step_px: [f64; 2]) -> [[f64; 2]; 4] {
    let scene = Scene::load(scene).expect("shipped");
    let mut studio = Studio::new(gpu, &scene).expect("uploads");
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::in_folder(folder.path().into(), 1 << 30);
    let spec = Spec::parse("ssaa:spp=256").expect("exists");
    let reference =
        |studio: &mut Studio<'_>, tick: Tick| studio.reference(&spec, &tick, SIZE, &cache, &mut ()).expect("draws").display;
    let references: Vec<_> = FRAMES.map(|index| reference(&mut studio, moving(&scene, index, step_px))).collect();
    let metrics = ["psnr", "flip"].map(|name| find(name).expect("exists"));
    MODES.map(|mode| {
        let mut sequence = Sequence::new(&mut studio, &format!("smaa:mode={mode}"), SIZE);
        sequence.take(moving(&scene, FRAMES.start - 1, step_px), true);
        let mut sums = [0.0; 2];
        for (index, reference) in FRAMES.zip(&references) {
            let found = sequence.take(moving(&scene, index, step_px), false);
            let pair = Pair::new(&found, reference).expect("one size");
            let figures = metrics.map(|metric| metric.evaluate(&pair).number().expect("a number"));
            sums = [sums[0] + figures[0], sums[1] + figures[1]];
        }
        let mean = sums.map(|sum| sum / references.len() as f64);
        println!("{} by {step_px:?} px, smaa:mode={mode}: {:.2} dB, FLIP {:.4}", scene.name, mean[0], mean[1]);
        mean
    })
}

/// Each mode beats the one before it by so many dB, and in FLIP; S2x stands beside T2x.
fn more_samples_are_better(scene: &str, step_px: [f64; 2], margin_db: f64) {
    let [once, spatial, temporal, four] = figures(&common::gpu(), scene, step_px);
    for (less, more) in [(once, spatial), (once, temporal), (temporal, four)] {
        assert!(more[0] > less[0] + margin_db && more[1] < 0.95 * less[1], "{scene} by {step_px:?}: {less:?}, {more:?}");
    }
}

#[test]
fn still_edges_gain_by_every_sample() {
    more_samples_are_better("edges", [0.0; 2], 1.5);
}

#[test]
fn still_wires_gain_by_every_sample() {
    more_samples_are_better("wires", [0.0; 2], 2.0);
}

#[test]
fn moving_edges_gain_by_every_sample() {
    more_samples_are_better("edges", [0.37, 0.0], 1.0);
    more_samples_are_better("edges", [1.5, 0.22], 1.0);
}

#[test]
fn moving_wires_gain_by_every_sample() {
    more_samples_are_better("wires", [0.37, 0.0], 1.0);
    more_samples_are_better("wires", [1.5, 0.22], 1.0);
}
