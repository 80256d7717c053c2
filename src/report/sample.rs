//! Made-up results and pictures for the tests.

use crate::metrics::{Figure, METRICS};
use crate::picture::{DisplayPicture, NonFinite};
use crate::suite::*;

/// Size of the sample's pictures in pixels.
pub(super) const SIZE: [u32; 2] = [160, 90];

const SPECS: [&str; 6] =
    ["none", "ssaa:spp=4,pattern=rotated-grid", "msaa:samples=16", "msaa:samples=4,resolve=box", "taa", "ssaa:spp=64"];

/// Two scenes by that many methods. The third method fails, the fifth has broken pixels, the sixth equals the reference.
pub(super) fn results(methods: usize) -> Results {
    let scene = |name: &str, slower: f64| SceneResult {
        name: name.into(),
        about: "Wedges at all angles: edges must be even, without steps.".into(),
        frame: 0,
        reference: ReferenceResult {
            spec: "ssaa:spp=2500".into(),
            noise_floor: Some(NoiseFloor { rms: 1.2e-4, max: 3.1e-3 }),
            analytic: Some(AnalyticDistance { rms: 2.0e-4, max: 4.2e-3 }),
            timing: ReferenceTiming { seconds: 12.0, cached: false },
        },
        methods: (0..methods).map(|i| method(i, slower)).collect(),
    };
    Results {
        schema_version: SCHEMA_VERSION,
        stamp: Stamp {
            dejag: "0.1.0".into(),
            adapter: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
            kind: "software".into(),
            driver: "llvmpipe".into(),
            driver_version: "Mesa 22.3.6 (LLVM 15.0.6)".into(),
            backend: "vulkan".into(),
        },
        command: ["score", "edges", "fence", "-m", "none", "--size", "160x90"].map(String::from).to_vec(),
        size: SIZE,
        scenes: vec![scene("edges", 1.0), scene("fence", 2.5)],
        edges: None,
    }
}

fn method(i: usize, slower: f64) -> MethodResult {
    let spec = SPECS.get(i).map_or_else(|| format!("ssaa:spp={}", i * i), ToString::to_string);
    let outcome = match i {
        2 => Outcome::Failed { error: "this adapter has 1 and 4 samples, not 16; choose one of them".into() },
        _ => scored(i, slower),
    };
    MethodResult { spec, outcome }
}

fn scored(i: usize, slower: f64) -> Outcome {
    let ms = |ms: f64| Spread { median: ms, min: 0.95 * ms, max: 1.1 * ms, repeats: 7 };
    let draw = slower * 1.3 * (1 + i * i) as f64;
    let passes = (1..=i.min(2)).map(|k| PassTiming { pass: format!("pass {k}"), runs: k as u32, ms: ms(0.2 * slower) }).collect();
    Outcome::Scored {
        samples_per_pixel: (1 + i * i) as f64,
        target_bytes: 460_800 * (1 + i as u64),
        scores: METRICS.iter().map(|metric| Score { metric: metric.id.into(), value: value(metric.name, i) }).collect(),
        non_finite: (i == 4).then_some(NonFinite { pixels: 3, first: [4, 2] }),
        timing: Timing {
            draw_ms: ms(draw),
            passes,
            total_ms: ms(draw + 0.2 * slower * i.min(2) as f64),
            clock: "wall clock".into(),
            unbeaten: i != 3 && i != 4,
        },
    }
}

fn value(metric: &str, i: usize) -> Figure {
    let better = 1.0 / (1.0 + i as f64);
    match (metric, i) {
        (_, 4) => Figure::NonFinite,
        ("psnr" | "psnr-linear", 5) => Figure::Infinite,
        ("rel-rmse", 0) => Figure::NotApplicable,
        ("psnr" | "psnr-linear", _) => Figure::Number(24.1 + 3.0 * i as f64),
        ("ssim", _) => Figure::Number(1.0 - 0.08 * better),
        ("energy", _) => Figure::Number(1.0 + 0.001 * better),
        ("max-error", _) => Figure::Number(200.0 * better),
        _ => Figure::Number(0.031 * better),
    }
}

/// A picture of slanted wedges, sharper or softer.
pub(super) fn picture(softness: f32) -> DisplayPicture {
    let [width, height] = SIZE;
    DisplayPicture::from_fn(width, height, |x, y| {
        let (dx, dy) = (x as f32 - 79.5, y as f32 - 44.5);
        let turn = dy.atan2(dx) * 9.0;
        let edge = turn.sin() * dx.hypot(dy) / (9.0 * softness);
        let cover = (0.5 + edge).clamp(0.0, 1.0);
        [0.15 + 0.75 * cover, 0.2 + 0.6 * cover, 0.3 + 0.5 * cover, 1.0]
    })
    .expect("a size")
}
