//! Made-up results and pictures for the tests.

use crate::metrics::temporal::{MEASURES, Measure};
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
        timing: SceneTiming { seconds: 20.0 * slower },
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
        shard: None,
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

/// A sequence of four frames by two methods, the second without probes.
pub(super) fn sequence() -> SequenceResults {
    let frame = |index: i64| SequenceFrame {
        index,
        time_s: index as f64 / 60.0,
        shift_px: [0.0; 2],
        reset: index == 0,
        followed: vec![0.95, 0.9, 0.85, 0.8],
        uncovered: 123,
        ridges: 45,
    };
    let noise_floor = Some(NoiseFloor { rms: 1.2e-4, max: 3.1e-3 });
    let timing = SequenceReferenceTiming { seconds: 1.0, cached: 2 };
    let result = SequenceResult {
        scene: "pan".into(),
        about: "camera and objects move".into(),
        size: SIZE,
        reference: SequenceReference { spec: "ssaa:spp=256".into(), noise_floor, timing },
        frames: (0..4).map(frame).collect(),
        methods: vec![sequence_method("none", probes()), sequence_method("smaa", ProbeFigures::default())],
    };
    let Results { schema_version, stamp, .. } = results(1);
    SequenceResults { schema_version, stamp, command: ["sequence", "pan"].map(String::from).to_vec(), shard: None, result }
}

fn sequence_method(spec: &str, probes: ProbeFigures) -> SequenceMethod {
    let value = |name: &str| match name {
        "psnr" | "tpsnr" => Figure::Number(24.1),
        "ghost" => Figure::NotApplicable,
        "continuity" | "energy" => Figure::Number(0.99),
        _ => Figure::Number(0.004),
    };
    let figure = |measure: &Measure| SequenceFigure {
        measure: measure.id.into(),
        overall: value(measure.name),
        worst: Some(WorstFrame { index: 2, value: value(measure.name) }),
        frames: vec![value(measure.name); 4],
    };
    let figures = SequenceFigures {
        samples_per_pixel: 1.0,
        target_bytes: 460_800,
        figures: MEASURES.iter().map(figure).collect(),
        ghost: Ghost { ages: vec![Figure::Number(0.1); 8], trail: Figure::Infinite },
        non_finite: Some(SequenceNonFinite { pixels: 6, frames: 2, first: 3 }),
        probes,
        timing: SequenceTiming { frame_ms: Spread { median: 12.0, min: 11.0, max: 14.0, repeats: 4 } },
    };
    SequenceMethod { spec: spec.into(), outcome: SequenceOutcome::Measured(Box::new(figures)) }
}

fn probes() -> ProbeFigures {
    let number = Figure::Number;
    ProbeFigures {
        crawl: Some(CrawlFigures { mean: number(0.002), p9999: number(0.1) }),
        convergence: Some(ConvergenceFigures { psnr: vec![number(30.0); 64], settled: number(30.0), frames: number(1.0) }),
        response: Some(ResponseFigures { shares: vec![number(0.1); 48], frames: Figure::Infinite }),
        sharpness: Some(vec![SharpnessFigure { pan_px: 0.0, ratio: number(1.5) }]),
        position: None,
    }
}
