//! Made-up results of `dejag check`.

use std::path::Path;

use dejag::metrics::Figure;
use dejag::suite::{
    CHECK_SCHEMA_VERSION, CaseTiming, CheckResults, CheckedCase, DiffOutcome, DiffPair, Environment, Knob, OutcomeCounts,
    PixelFigures, Stamp, WorstPixel,
};

/// A name that means something to XML, Markdown, HTML, workflow commands and terminals.
pub(super) const HOSTILE: &str = "a\"b'c<d>&]]>\u{1b}[2J\0\r\n::error::x%0A|`*_[l](u)@all,\u{fffe}é";

pub(super) const ALL: [DiffOutcome; 9] = [
    DiffOutcome::Same,
    DiffOutcome::Different,
    DiffOutcome::Size,
    DiffOutcome::Profile,
    DiffOutcome::Missing,
    DiffOutcome::New,
    DiffOutcome::Unreadable,
    DiffOutcome::Uncounted,
    DiffOutcome::Failed,
];

/// A run with a case for each of these outcomes.
pub(super) fn results(outcomes: &[DiffOutcome]) -> CheckResults {
    let stamp = Stamp {
        dejag: "0.1.0".into(),
        adapter: "llvmpipe (LLVM 15.0.6, 256 bits)".into(),
        kind: "software".into(),
        driver: "llvmpipe".into(),
        driver_version: "Mesa 22.3.6 (LLVM 15.0.6)".into(),
        backend: "vulkan".into(),
    };
    CheckResults {
        schema_version: CHECK_SCHEMA_VERSION,
        dejag: "0.1.0".into(),
        command: vec!["check".into(), "--manifest".into(), "dejag.toml".into()],
        manifest: "00".repeat(32),
        environment: Environment { key: "llvmpipe".into(), platform: "linux-x86_64".into(), stamp: Some(stamp) },
        shard: None,
        counts: OutcomeCounts::of(outcomes.iter().copied()),
        unused_goldens: Vec::new(),
        cases: outcomes.iter().enumerate().map(|(index, outcome)| case(index, *outcome)).collect(),
    }
}

fn case(index: usize, outcome: DiffOutcome) -> CheckedCase {
    let (golden, candidate) = (format!("goldens/{index}.png"), format!("candidates/{index}.png"));
    let pair = DiffPair::of_sides(Some(Path::new(&golden)), Some(Path::new(&candidate)), outcome);
    CheckedCase {
        id: format!("case/{index}"),
        entry: "case".into(),
        about: "A wedge.".into(),
        golden: None,
        candidate_hash: None,
        blessed_as: golden,
        likely_causes: Vec::new(),
        pair: if outcome == DiffOutcome::Different { missed_by_far(pair) } else { pair },
        timing: CaseTiming { seconds: 0.25 },
    }
}

/// Three pixels differ, and FLIP is over its limit.
fn missed_by_far(pair: DiffPair) -> DiffPair {
    let worst = WorstPixel {
        at: [3, 4],
        expected: vec![Some(10.0); 3],
        actual: vec![Some(19.0); 3],
        bits: [8, 8],
        difference: Some(9.0 / 255.0),
    };
    let knob = |option: &str, value, limit, met, passes_at| Knob {
        option: option.into(),
        metric: "metric/1".into(),
        value: Figure::Number(value),
        limit,
        met,
        passes_at: Some(passes_at),
    };
    DiffPair {
        pixels: Some(PixelFigures { compared: 768, differing: 3, bounds: Some([3, 4, 5, 6]), worst: Some(worst) }),
        knobs: vec![
            knob("--max-pixels", 3.0, None, None, 3.0),
            knob("--per-channel", 9.0 / 255.0, None, None, 9.0 / 255.0),
            knob("--max-flip", 0.0321, Some(0.01), Some(false), 0.0321),
        ],
        pictures: vec!["differences/case.heat.png".into()],
        ..pair
    }
}
