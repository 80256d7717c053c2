//! Reports of made-up runs: pictures drawn here, figures counted from them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use dejag::metrics::Figure;
use dejag::picture::{BitDepth, DisplayPicture};
use dejag::report::{CasePictures, CheckReport};
use dejag::suite::{
    CHECK_SCHEMA_VERSION, CaseTiming, CheckResults, CheckedCase, DiffOutcome, DiffPair, Environment, Golden, Knob, OutcomeCounts,
    PixelFigures, Stamp, WorstPixel,
};
use tempfile::TempDir;

/// Width and height of all pictures.
pub(super) const SIZE: [u32; 2] = [320, 180];

/// A report in a folder of its own.
pub(super) struct Sample {
    home: TempDir,
}

impl Sample {
    /// Of these cases, after these runs.
    pub(super) fn write(cases: Vec<CheckedCase>, history: &[CheckResults]) -> Self {
        let sample = Self::without_report();
        for (name, edge) in [("expected", 150.0), ("actual", 151.5), ("heat", 150.0)] {
            picture(edge, name == "heat").save_png(&sample.path(name), BitDepth::Eight, &[]).expect("written");
        }
        sample.report(cases, history);
        sample
    }

    pub(super) fn without_report() -> Self {
        Self { home: tempfile::tempdir().expect("a folder") }
    }

    /// Of the pictures that lie in the folder.
    pub(super) fn report(&self, cases: Vec<CheckedCase>, history: &[CheckResults]) {
        let pictures = |case: &CheckedCase| CasePictures {
            expected: case.pair.expected.is_some().then(|| self.path("expected")),
            actual: case.pair.actual.is_some().then(|| self.path(if is_same(case) { "expected" } else { "actual" })),
            heat: (!case.pair.pictures.is_empty()).then(|| self.path("heat")),
        };
        let report = CheckReport::begin(&self.home.path().join("report")).expect("begun");
        report.finish(&results(cases), history, pictures, &mut |_| Ok(())).expect("finished");
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.home.path().join(name).with_extension("png")
    }

    pub(super) fn page(&self) -> PathBuf {
        self.home.path().join("report/index.html")
    }
}

fn is_same(case: &CheckedCase) -> bool {
    case.pair.outcome == DiffOutcome::Same
}

/// A bright disc of soft texture on a dark ground, its right edge at `edge`.
pub(super) fn picture(edge: f32, map: bool) -> DisplayPicture {
    DisplayPicture::from_fn(SIZE[0], SIZE[1], |x, y| {
        let (dx, dy) = (x as f32 + 0.5 - 100.0, y as f32 + 0.5 - 90.0);
        let cover = (edge - 100.0 - dx.hypot(dy) + 0.5).clamp(0.0, 1.0);
        let texture = 0.08 * ((x * 7 + y * 13) % 17) as f32 / 16.0;
        match map {
            true => [cover * (1.0 - cover) * 4.0, 0.05 + texture, 0.2, 1.0],
            false => [0.12 + 0.7 * cover + texture, 0.15 + 0.5 * cover, 0.25 + 0.4 * (x as f32 / 320.0), 1.0],
        }
    })
    .expect("a size")
}

pub(super) fn results(cases: Vec<CheckedCase>) -> CheckResults {
    CheckResults {
        schema_version: CHECK_SCHEMA_VERSION,
        dejag: "0.1.0".into(),
        command: ["check", "suite.toml", "--max-flip", "0.01"].map(String::from).to_vec(),
        manifest: "5f2b".repeat(16),
        environment: Environment {
            key: "llvmpipe-mesa-22.3.6".into(),
            platform: "linux-x86_64".into(),
            stamp: Some(Stamp {
                dejag: "0.1.0".into(),
                adapter: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
                kind: "software".into(),
                driver: "llvmpipe".into(),
                driver_version: "Mesa 22.3.6".into(),
                backend: "vulkan".into(),
            }),
        },
        shard: None,
        counts: OutcomeCounts::of(cases.iter().map(|case| case.pair.outcome)),
        unused_goldens: vec!["goldens/llvmpipe-mesa-22.3.6/old/fence.png".into()],
        cases,
    }
}

/// A case of that outcome, with figures as it has them.
pub(super) fn case(id: &str, outcome: DiffOutcome) -> CheckedCase {
    let (expected, actual) = match outcome {
        DiffOutcome::New => (None, Some("actual")),
        DiffOutcome::Missing | DiffOutcome::Failed => (Some("expected"), None),
        _ => (Some("expected"), Some("actual")),
    };
    let differs = outcome == DiffOutcome::Different;
    let mut pair = DiffPair::of_sides(expected.map(Path::new), actual.map(Path::new), outcome);
    if differs || outcome == DiffOutcome::Same {
        pair.sizes = Some([SIZE; 2]);
        pair.pixels = Some(FIGURES[usize::from(differs)].clone());
        pair.knobs = vec![knob("--max-pixels", "differing-pixels/1", FIGURES[usize::from(differs)].differing as f64, 100.0)];
        pair.knobs.push(knob("--max-flip", "flip-ldr/1.7@67.0206", if differs { 0.0123 } else { 0.0 }, 0.01));
    }
    if differs {
        pair.pictures = vec!["heat.png".into()];
    } else if outcome != DiffOutcome::Same {
        pair.why = Some(format!("what says more of {}", outcome.as_str()));
    }
    let made = BTreeMap::from([("adapter".to_owned(), "llvmpipe".to_owned()), ("driver".to_owned(), "Mesa 22.3.5".to_owned())]);
    CheckedCase {
        id: id.into(),
        entry: id.split('/').next().unwrap_or(id).into(),
        about: "A disc before a dark ground, its edge resampled.".into(),
        golden: expected.map(|_| Golden { environment: "llvmpipe-mesa-22.3.6".into(), hash: None, provenance: made }),
        candidate_hash: None,
        blessed_as: format!("goldens/llvmpipe-mesa-22.3.6/{id}.png"),
        likely_causes: differs
            .then(|| "the golden was drawn by Mesa 22.3.5, this by Mesa 22.3.6".to_owned())
            .into_iter()
            .collect(),
        pair,
        timing: CaseTiming { seconds: 0.25 },
    }
}

/// Of pictures that are equal, and of those that are not.
static FIGURES: LazyLock<[PixelFigures; 2]> = LazyLock::new(|| [false, true].map(pixels));

/// Figures of the sample's two pictures, or of one with itself.
fn pixels(differs: bool) -> PixelFigures {
    let [a, b] = [picture(150.0, false), picture(if differs { 151.5 } else { 150.0 }, false)].map(|picture| picture.to_rgba8());
    let apart: Vec<u8> =
        a.chunks(4).zip(b.chunks(4)).map(|(a, b)| (0..4).map(|c| a[c].abs_diff(b[c])).max().expect("four")).collect();
    let most = *apart.iter().max().expect("pixels");
    let place = apart.iter().position(|apart| *apart == most).expect("one");
    let levels = |of: &[u8]| of[4 * place..4 * place + 4].iter().map(|level| Some(f64::from(*level))).collect();
    PixelFigures {
        compared: apart.len() as u64,
        differing: apart.iter().filter(|apart| **apart > 0).count() as u64,
        bounds: differs.then_some([48, 38, 104, 104]),
        worst: differs.then(|| WorstPixel {
            at: [place as u32 % SIZE[0], place as u32 / SIZE[0]],
            expected: levels(&a),
            actual: levels(&b),
            bits: [8, 8],
            difference: Some(f64::from(most) / 255.0),
        }),
    }
}

fn knob(option: &str, metric: &str, value: f64, limit: f64) -> Knob {
    Knob {
        option: option.into(),
        metric: metric.into(),
        value: Figure::Number(value),
        limit: Some(limit),
        met: Some(value <= limit),
        passes_at: Some(value),
    }
}

/// One of each outcome, some of them twice, the failing ones not first.
pub(super) fn mixed() -> Vec<CheckedCase> {
    use DiffOutcome as O;
    let outcomes = [O::Same, O::Different, O::Same, O::Size, O::Missing, O::New, O::Unreadable, O::Failed, O::Different, O::Same];
    outcomes.iter().enumerate().map(|(i, outcome)| case(&format!("disc/{:02}-{}", i + 1, outcome.as_str()), *outcome)).collect()
}

/// Three earlier runs: in the first FLIP was another version, in the second `disc/02-different` was not there.
pub(super) fn earlier() -> Vec<CheckResults> {
    let runs = [0.004, 0.006, 0.009].map(|flip| {
        let mut cases = mixed();
        for knob in cases.iter_mut().flat_map(|case| &mut case.pair.knobs) {
            knob.value = if knob.option == "--max-flip" { Figure::Number(flip) } else { knob.value };
        }
        results(cases)
    });
    let mut runs = runs.to_vec();
    runs[0]
        .cases
        .iter_mut()
        .flat_map(|case| &mut case.pair.knobs)
        .for_each(|knob| knob.metric = knob.metric.replace("1.7", "1.6"));
    runs[1].cases.retain(|case| case.id != "disc/02-different");
    runs
}
