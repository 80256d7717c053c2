//! Ten thousand frames of a still scene: nothing wanders off, nothing gets stuck, no light is lost.

use dejag::capture::Studio;
use dejag::gpu::Gpu;
use dejag::picture::Pixel;
use dejag::scene::Scene;
use wgpu::TextureFormat as Format;

use super::rig::{Facts, Rig};
use super::{PLAIN, PRESETS, energy, farthest, shown, single};
use crate::common;

const SIZE: [u32; 2] = [32, 18];

/// Both at the same phase of every cycle that divides 64.
const EARLY: u32 = 320;
const LATE: u32 = 10_240;

const BOTH: [&str; 2] = ["fp16", "fp32"];

/// A scene's draws at a cycle's jitters.
fn drawn(gpu: &Gpu, name: &str, cycle: u32) -> Vec<Vec<Pixel>> {
    let scene = Scene::load(name).expect("shipped");
    let mut studio = Studio::new(gpu, &scene).expect("uploads");
    single::draws(&mut studio, &scene, cycle, SIZE)
}

/// The picture after some counts of frames that show draws by turns.
fn after<const N: usize>(gpu: &Gpu, spec: &str, draws: &[Vec<Pixel>], counts: [u32; N]) -> [Vec<Pixel>; N] {
    let mut rig = Rig::with_input(gpu, spec, SIZE, Format::Rgba16Float);
    let shown: Vec<_> = draws.iter().map(|color| rig.upload(&Facts::still(color.clone()))).collect();
    counts.map(|count| {
        while rig.frame.index < count {
            rig.show(&shown[rig.frame.index as usize % shown.len()]);
        }
        rig.pixels()
    })
}

/// How far the late picture is from the early one: in steps of the display at most, and in energy. The worst of the storages.
fn strays(scene: &str, spec: &str, cycle: u32, storages: &[&str]) -> [f64; 2] {
    let gpu = common::gpu();
    let draws = drawn(&gpu, scene, cycle);
    let mut worst = [0.0_f64; 2];
    for storage in storages {
        let spec = format!("{spec},cycle={cycle},storage={storage}");
        let [early, late] = after(&gpu, &spec, &draws, [EARLY, LATE]);
        let apart = f64::from(255.0 * farthest(&early, &late, shown));
        let gained = energy(&late) / energy(&early) - 1.0;
        println!("{scene}, {spec}: {apart:.3}/255 from frame {EARLY} to {LATE}, energy {:+.4} %", 100.0 * gained);
        worst = [worst[0].max(apart), worst[1].max(gained.abs())];
    }
    worst
}

/// A step of the display.
fn stays(scene: &str, spec: &str, cycle: u32, storages: &[&str]) {
    let [apart, _] = strays(scene, spec, cycle, storages);
    assert!(apart <= 1.0, "{scene}, {spec}: {apart}/255");
}

#[test]
fn fast_stays() {
    stays("edges", PRESETS[0], 16, &["fp16"]);
}

#[test]
fn balanced_stays() {
    stays("edges", PRESETS[1], 32, &["fp16"]);
}

#[test]
fn quality_stays() {
    stays("edges", PRESETS[2], 64, &BOTH);
}

#[test]
fn the_light_of_neon_stays() {
    let [apart, gained] = strays("neon", PRESETS[1], 32, &BOTH);
    assert!(apart <= 1.0 && gained < 1e-3, "{apart}/255, energy off by {gained}");
}

/// The longest mean and the longest cycle, where bright light falls on some pixels once in 64 frames.
#[test]
fn the_longest_mean_of_a_preset_has_settled_at_frame_320() {
    stays("neon", PRESETS[2], 64, &BOTH);
}

/// How much light a method makes of a cycle's draws, beside what they hold: after four cycles, when frames have counted alike.
fn gain(gpu: &Gpu, spec: &str, draws: &[Vec<Pixel>]) -> f64 {
    let exact = energy(&single::mean(draws, draws.len()));
    let [found] = after(gpu, &format!("{spec},cycle={}", draws.len()), draws, [4 * draws.len() as u32]);
    energy(&found) / exact - 1.0
}

/// Only the weights of samples cost light, limits and boxes: a plain mean has all of what it was given.
#[test]
fn a_plain_mean_has_all_the_light() {
    let gpu = common::gpu();
    for scene in ["neon", "stars"] {
        let draws = drawn(&gpu, scene, 64);
        let [floats, halves] = ["fp32", "fp16"].map(|storage| gain(&gpu, &format!("{PLAIN},most=256,storage={storage}"), &draws));
        println!("{scene}, plain mean: energy {:+.4} % in fp32, {:+.4} % in fp16", 100.0 * floats, 100.0 * halves);
        assert!(floats.abs() < 1e-3, "{scene}: {floats}");
        // What is rounded by chance is right in the mean: few stars are few chances.
        assert!(halves.abs() < 3e-3, "{scene}: {halves}");
    }
}

/// What the others lose is told, not bounded.
#[test]
fn losses_of_light_are_told() {
    let gpu = common::gpu();
    let draws = drawn(&gpu, "neon", 64);
    let luma = "taa:weight=luma,clip=off,sharpen=0,limit=0,most=256";
    let highlights = "taa:weight=highlights,clip=off,sharpen=0,limit=0,most=256";
    let limited = "taa:weight=none,clip=off,sharpen=0,limit=4,most=256";
    for spec in [PRESETS[0], PRESETS[1], PRESETS[2], highlights, luma, limited] {
        let lost = gain(&gpu, spec, &draws);
        println!("neon, {spec}: energy {:+.2} %", 100.0 * lost);
        assert!((-0.99..0.01).contains(&lost), "{spec} makes light: {lost}");
    }
}
