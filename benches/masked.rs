//! What drawing under a mask saves: `cargo bench --bench masked [-- SCENES WIDTHxHEIGHT ROUNDS PLOT.svg]`.
//!
//! In one process, in turns, medians. 48 jitters are summed where a mask says so, against the same 48 everywhere; the mask takes a
//! share of the picture in single pixels scattered at random, or in tiles of 32 pixels. Scenes by name, with commas between.

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
    let mut lines = Vec::new();
    for name in names {
        let scene = Scene::load(name)?;
        for grain_px in GRAINS_PX {
            let (full, masked) = measure(&gpu, &scene, size, grain_px, rounds)?;
            let shares: Vec<f64> = masked.iter().map(|ms| ms / full).collect();
            let cells: Vec<String> = shares.iter().map(|share| format!("{share:>5.2}")).collect();
            println!("{name:<12} {grain_px:>8} {full:>9.2}  {}", cells.join(" "));
            lines.push((format!("{name}, {grain_px} px"), shares));
        }
    }
    if let Some(file) = words.get(3) {
        plot(file, &lines).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
    Ok(())
}

/// Time under a mask, in that of all pixels, against the share that is masked.
fn plot(file: &str, lines: &[(String, Vec<f64>)]) -> Result<(), Box<dyn std::error::Error>> {
    use plotters::prelude::*;
    let root = SVGBackend::new(file, (720, 420)).into_drawing_area();
    root.fill(&WHITE)?;
    let top = lines.iter().flat_map(|(_, times)| times).fold(1.2f64, |top, time| top.max(*time));
    let mut chart = ChartBuilder::on(&root)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..1.0f64, 0.0..top)?;
    chart.configure_mesh().x_desc("share of pixels in the mask").y_desc("time, of all pixels = 1").draw()?;
    for (index, (label, times)) in lines.iter().enumerate() {
        let color = Palette99::pick(index).to_rgba();
        chart
            .draw_series(LineSeries::new(SHARES.into_iter().zip(times.iter().copied()), color.stroke_width(2)))?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color));
    }
    chart.configure_series_labels().position(SeriesLabelPosition::LowerRight).border_style(BLACK).draw()?;
    Ok(root.present()?)
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
    let offsets = weighted_offsets(pattern("larcher")?, JITTERS as u32, 0, dejag::sampling::filter("box")?, 0.5);
    let jitters: Vec<Jitter> =
        offsets.iter().map(|o| Jitter { offset_px: o.offset_px.map(|x| x as f32), weight: o.weight as f32 }).collect();
    let mut forward = Forward::new(gpu, scene)?;
    forward.set_frame(&scene.frame(0, size)?, size)?;
    let sum = gpu.target(TextureSpec { label: "sum", size, format: wgpu::TextureFormat::Rgba32Float, samples: 1 });
    let view = sum.create_view(&wgpu::TextureViewDescriptor::default());
    let full = Draw { jitters, target: Target::Sum(Sum { view: view.clone(), clear: true }), ..Draw::default() };
    let mut draws = vec![full.clone()];
    draws.extend(SHARES.map(|share| Draw { mask: Some(Mask::non_zero(mask(gpu, size, grain_px, share))), ..full.clone() }));
    let targets: Vec<Targets> =
        draws.iter().map(|draw| Forward::targets(gpu, size, draw, Extras::default())).collect::<Result<_, _>>()?;
    let mut ms = vec![Vec::new(); draws.len()];
    for round in 0..=rounds {
        for ((draw, targets), ms) in draws.iter().zip(&targets).zip(&mut ms) {
            let start = Instant::now();
            let mut encoder = gpu.encoder();
            forward.draw(&mut Recorder::new(&mut encoder), draw, targets, &view)?;
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
