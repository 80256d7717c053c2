//! What 2500 jittered draws of a reference cost against 2500 plain draws: `cargo bench --bench sums [-- SCENE WIDTHxHEIGHT ROUNDS]`.
//!
//! In one process, in turns, medians. A plain draw is rgba16float with a cleared depth, 50 to a submission; a sum adds the same 50
//! jitters into one rgba32float target.

#![expect(clippy::print_stdout, reason = "its table is its output")]

use std::time::Instant;

use dejag::forward::{Forward, Targets};
use dejag::gpu::{AdapterChoice, Gpu, TextureSpec};
use dejag::pass::{Draw, Extras, Jitter, Recorder, Sum, Target};
use dejag::sampling::{pattern, weighted_offsets};
use dejag::scene::Scene;
use dejag::suite::Spread;

const JITTERS: usize = 50;

fn main() -> dejag::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let names = match words.first() {
        Some(name) => vec![name.as_str()],
        None => vec!["courtyard", "edges", "fence", "foliage", "checker"],
    };
    let size = words.get(1).map_or([640, 360], |text| {
        let (w, h) = text.split_once('x').expect("WIDTHxHEIGHT");
        [w, h].map(|side| side.parse().expect("a number of pixels"))
    });
    let rounds: u32 = words.get(2).map_or(7, |text| text.parse().expect("a number of rounds"));
    let choice = std::env::var("DEJAG_ADAPTER").map_or(AdapterChoice::Auto, |name| name.parse().expect("infallible"));
    let gpu = Gpu::open(&choice)?;
    println!("{}, {}x{}, {JITTERS} draws a submission, medians of {rounds}", gpu.card, size[0], size[1]);
    println!("{:<12} {:>12} {:>12} {:>7} {:>17}", "scene", "plain ms", "sum ms", "ratio", "2500 summed, s");
    for name in names {
        let (plain, sum) = measure(&gpu, &Scene::load(name)?, size, rounds)?;
        let (plain, sum) = (plain.median, sum.median);
        println!("{name:<12} {plain:>12.2} {sum:>12.2} {:>7.2} {:>17.2}", sum / plain, sum * 2500.0 / JITTERS as f64 / 1e3);
    }
    Ok(())
}

/// Milliseconds of 50 plain draws and of 50 summed ones.
fn measure(gpu: &Gpu, scene: &Scene, size: [u32; 2], rounds: u32) -> dejag::Result<(Spread, Spread)> {
    let offsets = weighted_offsets(pattern("larcher")?, JITTERS as u32, 0, dejag::sampling::filter("box")?, 0.5);
    let jitters: Vec<Jitter> =
        offsets.iter().map(|o| Jitter { offset_px: o.offset_px.map(|x| x as f32), weight: o.weight as f32 }).collect();
    let mut forward = Forward::new(gpu, scene)?;
    forward.set_frame(&scene.frame(0, size)?, size)?;
    let sum = gpu.target(TextureSpec { label: "sum", size, format: wgpu::TextureFormat::Rgba32Float, samples: 1 });
    let view = sum.create_view(&wgpu::TextureViewDescriptor::default());
    let summed =
        Draw { jitters: jitters.clone(), target: Target::Sum(Sum { view: view.clone(), clear: true }), ..Draw::default() };
    let plain: Vec<Draw> = jitters.iter().map(|j| Draw { jitters: vec![*j], ..Draw::default() }).collect();
    let plain_targets = Forward::targets(gpu, size, &plain[0], Extras::default())?;
    let sum_targets = Forward::targets(gpu, size, &summed, Extras::default())?;

    let mut draw = |requests: &[Draw], targets: &Targets| -> dejag::Result<f64> {
        let start = Instant::now();
        let mut encoder = gpu.encoder();
        for request in requests {
            forward.draw(&mut Recorder::new(&mut encoder), request, targets, &view)?;
        }
        gpu.submit(encoder)?;
        gpu.wait()?;
        Ok(1e3 * start.elapsed().as_secs_f64())
    };
    let (mut plain_ms, mut sum_ms) = (Vec::new(), Vec::new());
    for round in 0..=rounds {
        let pair = (draw(&plain, &plain_targets)?, draw(std::slice::from_ref(&summed), &sum_targets)?);
        // The first round compiles.
        if round > 0 {
            plain_ms.push(pair.0);
            sum_ms.push(pair.1);
        }
    }
    Ok((Spread::of(plain_ms), Spread::of(sum_ms)))
}
