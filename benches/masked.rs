//! What drawing under a mask saves: `cargo bench --bench masked [-- SCENE WIDTHxHEIGHT ROUNDS]`.
//!
//! In one process, in turns, medians. 48 jitters are summed where a mask says so, against the same 48 everywhere; the mask takes a
//! share of the picture in single pixels scattered at random, or in tiles of 32 pixels.

#![expect(clippy::print_stdout, reason = "its table is its output")]

use std::time::Instant;

use dejag::forward::{Forward, Targets};
use dejag::gpu::{AdapterChoice, Gpu, TextureSpec};
use dejag::pass::{Draw, Extras, Jitter, Mask, Recorder, Sum, Target};
use dejag::sampling::{pattern, weighted_offsets};
use dejag::scene::Scene;
use dejag::suite::Spread;

const JITTERS: usize = 48;
const SHARES: [f64; 7] = [0.0, 0.02, 0.1, 0.2, 0.4, 0.7, 1.0];
const GRAINS_PX: [u32; 2] = [1, 32];

fn main() -> dejag::Result<()> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let names = match words.first() {
        Some(name) => name.split(',').collect(),
        None => vec!["courtyard", "edges", "fence"],
    };
    let size = words.get(1).map_or([640, 360], |text| {
        let (w, h) = text.split_once('x').expect("WIDTHxHEIGHT");
        [w, h].map(|side| side.parse().expect("a number of pixels"))
    });
    let rounds: u32 = words.get(2).map_or(7, |text| text.parse().expect("a number of rounds"));
    let choice = std::env::var("DEJAG_ADAPTER").map_or(AdapterChoice::Auto, |name| name.parse().expect("infallible"));
    let gpu = Gpu::open(&choice)?;
    println!("{}, {}x{}, {JITTERS} jitters in a sum, medians of {rounds}", gpu.card, size[0], size[1]);
    println!("{:<12} {:>8} {:>9}  of it by share masked: {SHARES:?}", "scene", "grain px", "full ms");
    for name in names {
        let scene = Scene::load(name)?;
        for grain_px in GRAINS_PX {
            let (full, masked) = measure(&gpu, &scene, size, grain_px, rounds)?;
            print!("{name:<12} {grain_px:>8} {full:>9.2} ");
            for ms in masked {
                print!(" {:>5.2}", ms / full);
            }
            println!();
        }
    }
    Ok(())
}

/// 1 in a share of the picture's squares of so many pixels, by a hash of where they are.
fn mask(gpu: &Gpu, [width, height]: [u32; 2], grain_px: u32, share: f64) -> wgpu::TextureView {
    let bytes: Vec<u8> = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x / grain_px, y / grain_px)))
        .map(|(x, y)| {
            let mut hash = (x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77)).wrapping_mul(0xc2b2_ae3d);
            hash = (hash ^ hash >> 15).wrapping_mul(0x27d4_eb2f);
            u8::from(f64::from(hash ^ hash >> 13) < share * 2f64.powi(32))
        })
        .collect();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("mask"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R8Uint,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    use wgpu::util::DeviceExt as _;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, wgpu::util::TextureDataOrder::LayerMajor, &bytes);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Milliseconds without a mask, and with one of each share.
fn measure(gpu: &Gpu, scene: &Scene, size: [u32; 2], grain_px: u32, rounds: u32) -> dejag::Result<(f64, Vec<f64>)> {
    let samples: u32 = std::env::var("S").map_or(1, |s| s.parse().expect("a number of samples"));
    let offsets = weighted_offsets(pattern("larcher")?, JITTERS as u32 / samples, 0, dejag::sampling::filter("box")?, 0.5);
    let jitters: Vec<Jitter> =
        offsets.iter().map(|o| Jitter { offset_px: o.offset_px.map(|x| x as f32), weight: o.weight as f32 }).collect();
    let mut forward = Forward::new(gpu, scene)?;
    forward.set_frame(&scene.frame(0, size)?, size)?;
    let sum = gpu.target(TextureSpec { label: "sum", size, format: wgpu::TextureFormat::Rgba32Float, samples });
    let view = sum.create_view(&wgpu::TextureViewDescriptor::default());
    let full = Draw { jitters, samples, target: Target::Sum(Sum { view: view.clone(), clear: true }), ..Draw::default() };
    let mut draws = vec![full.clone()];
    let plain = std::env::var("P").is_ok();
    draws.extend(SHARES.map(|share| {
        let mask = Some(Mask::non_zero(mask(gpu, size, grain_px, share)));
        match plain {
            true => Draw { mask, jitters: full.jitters[..1].to_vec(), ..Draw::default() },
            false => Draw { mask, ..full.clone() },
        }
    }));
    let targets: Vec<Targets> =
        draws.iter().map(|draw| Forward::targets(gpu, size, draw, Extras::default())).collect::<Result<_, _>>()?;
    let mut ms = vec![Vec::new(); draws.len()];
    for round in 0..=rounds {
        for ((draw, targets), ms) in draws.iter().zip(&targets).zip(&mut ms) {
            let start = Instant::now();
            let mut encoder = gpu.encoder();
            let n = if matches!(draw.target, Target::Input) { full.jitters.len() } else { 1 };
            for _ in 0..n {
                forward.draw(&mut Recorder::new(&mut encoder), draw, targets, &view)?;
            }
            gpu.submit(encoder)?;
            gpu.wait()?;
            // The first round compiles.
            if round > 0 {
                ms.push(1e3 * start.elapsed().as_secs_f64());
            }
        }
    }
    let mut medians = ms.into_iter().map(|ms| Spread::of(ms).median);
    Ok((medians.next().unwrap_or_default(), medians.collect()))
}
