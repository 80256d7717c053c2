//! The folder is complete, names are harmless, figures are those of the results, and what is missing is said.

mod pictures;

use std::fs;

use super::*;
use crate::metrics::Figure;
use crate::picture::{BitDepth, DisplayPicture};
use crate::suite::{
    CHECK_SCHEMA_VERSION, CaseTiming, DiffPair, Environment, Golden, Knob, OutcomeCounts, PixelFigures, ShardStamp, WorstPixel,
};

/// A folder for pictures, and in it one for the report.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A grey PNG of that level.
    fn put(&self, name: &str, level: f32) -> PathBuf {
        let picture = DisplayPicture::from_fn(400, 200, |x, _| [level, x as f32 / 400.0, 0.5, 1.0]).expect("a size");
        picture.save_png(&self.path(name), BitDepth::Eight, &[]).expect("written");
        self.path(name)
    }

    fn write(&self, results: &CheckResults, history: &[CheckResults], pictures: impl Fn(&CheckedCase) -> CasePictures) -> String {
        let report = CheckReport::begin(&self.path("report")).expect("begun");
        report.finish(results, history, pictures, &mut |_| Ok(())).expect("finished");
        fs::read_to_string(self.path("report/index.html")).expect("a page")
    }
}

fn page_of(results: &CheckResults, history: &[CheckResults]) -> String {
    Desk::new().write(results, history, |_| CasePictures::default())
}

fn results(cases: Vec<CheckedCase>) -> CheckResults {
    CheckResults {
        schema_version: CHECK_SCHEMA_VERSION,
        dejag: "0.1.0".into(),
        command: ["check", "a suite.toml"].map(String::from).to_vec(),
        manifest: "beef".into(),
        environment: Environment { key: "card-1".into(), platform: "linux-x86_64".into(), stamp: None },
        shard: None,
        counts: OutcomeCounts::of(cases.iter().map(|case| case.pair.outcome)),
        unused_goldens: Vec::new(),
        cases,
    }
}

/// Of a thousand pixels that many differ, by a FLIP of that many thousandths.
fn case(id: &str, outcome: DiffOutcome, differing: u64) -> CheckedCase {
    let knob = |option: &str, metric: &str, value: f64, limit: f64| Knob {
        option: option.into(),
        metric: metric.into(),
        value: Figure::Number(value),
        limit: Some(limit),
        met: Some(value <= limit),
        passes_at: Some(value),
    };
    let worst = WorstPixel { at: [3, 7], expected: vec![Some(12.0)], actual: vec![None], bits: [8, 8], difference: None };
    let mut pair = DiffPair::of_sides(Some(Path::new("e")), Some(Path::new("a")), outcome);
    pair.pixels = Some(PixelFigures { compared: 1000, differing, bounds: None, worst: (differing > 0).then_some(worst) });
    pair.knobs = vec![
        knob("--max-pixels", "differing-pixels/1", differing as f64, 10.0),
        knob("--max-flip", "flip-ldr/1.7@67.0206", differing as f64 / 1000.0, 0.01),
    ];
    CheckedCase {
        id: id.into(),
        entry: id.into(),
        about: String::new(),
        golden: Some(Golden { environment: "card-1".into(), hash: Some("aa".into()), provenance: Default::default() }),
        candidate_hash: Some("bb".into()),
        blessed_as: format!("goldens/card-1/{id}.png"),
        likely_causes: Vec::new(),
        pair,
        timing: CaseTiming { seconds: 1.0 },
    }
}

fn two() -> CheckResults {
    results(vec![case("calm", DiffOutcome::Same, 0), case("wild", DiffOutcome::Different, 25)])
}

/// The values of all attributes of this name.
fn values<'p>(page: &'p str, attribute: &str) -> Vec<&'p str> {
    let start = format!(" {attribute}=\"");
    page.split(&start).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn the_page_needs_nothing_from_elsewhere_and_suits_every_eye() {
    let desk = Desk::new();
    let (expected, actual) = (desk.put("e.png", 0.2), desk.put("a.png", 0.4));
    let both = CasePictures { expected: Some(expected), actual: Some(actual), heat: None };
    let page = desk.write(&two(), &[], |_| both.clone());
    for source in [values(&page, "src"), values(&page, "data-pixels")].concat() {
        assert!(desk.path("report").join(source).is_file(), "{source}");
    }
    let all = page.clone() + viewer::SCRIPT;
    for word in ["http://", "https://", "src=\"//", "url(", "@import", "fetch(", "eval(", "innerHTML", " onclick=", " onload="] {
        assert!(!all.contains(word), "{word}");
    }
    assert!(page.contains("default-src 'none'") && !page.contains("<script>"));
    for rule in ["prefers-color-scheme: dark", "@media print", "content-visibility: auto", "prefers-reduced-motion"] {
        assert!(all.contains(rule), "{rule}");
    }
    let rows = &page[page.find("<ol").expect("a list")..page.find("</ol>").expect("its end")];
    let images: Vec<&str> = rows.split("<img ").skip(1).filter_map(|rest| rest.split('>').next()).collect();
    assert_eq!(images.len(), 4);
    for image in images {
        let complete = ["loading=\"lazy\"", "width=\"1", "height=\"", "alt=\""].iter().all(|part| image.contains(part));
        assert!(complete && !image.contains("alt=\"\""), "{image}");
    }
}

#[test]
fn counts_environment_command_and_unused_goldens_are_said() {
    let mut run = two();
    run.unused_goldens = vec!["goldens/card-1/<old>.png".into()];
    run.shard = Some(ShardStamp { index: 2, count: 3, dealt: Vec::new(), own: Vec::new() });
    let page = page_of(&run, &[]);
    for words in [
        "2 cases: 1 same, 1 different",
        "<bdi>card-1</bdi> on linux-x86_64",
        "shard 2 of 3",
        "dejag check 'a suite.toml'",
        "goldens/card-1/&lt;old&gt;.png",
        "data-show=\"different\" aria-pressed=\"false\">different <span class=\"count\">1</span>",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("data-show=\"missing\""), "there is none");
}

#[test]
fn the_worst_come_first_and_those_without_figures_before_them() {
    let mut run = two();
    run.cases.extend([case("wilder", DiffOutcome::Different, 900), case("gone", DiffOutcome::Missing, 0)]);
    run.cases[3].pair.pixels = None;
    let page = page_of(&run, &[]);
    assert_eq!(values(&page, "data-id"), ["gone", "wilder", "wild", "calm"]);
    assert_eq!(values(&page, "data-place"), ["4", "3", "2", "1"]);
    assert_eq!(values(&page, "data-flip"), ["0", "0.9", "0.025", "0"]);
}

#[test]
fn limits_are_told_in_words_and_what_would_accept() {
    let page = page_of(&two(), &[]);
    for words in [
        "25 of 1000 pixels differ (2.50 %) · --max-pixels 10: missed at 25 · --max-flip 0.01: missed at 0.025",
        "all 1000 compared pixels are equal · --max-pixels 10: met at 0 · --max-flip 0.01: met at 0",
        "<td>flip-ldr/1.7@67.0206</td><td>0.025</td><td>0.01</td><td class=\"bad\">missed</td><td>0.025</td>",
        "at 3,7: expected (12), actual (not finite)",
        "<code class=\"command\">dejag bless wild</code>",
        "goldens/card-1/wild.png",
        "data-worst=\"3,7\"",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("dejag bless calm"), "there is nothing to accept");
}

#[test]
fn commands_to_accept_are_safe_to_paste() {
    let ids = ["it's", "-x", "a\nrm b", "$(c)"];
    let page = page_of(&results(ids.iter().map(|id| case(id, DiffOutcome::Different, 20)).collect()), &[]);
    for line in ["bless 'it'\\''s'", "bless -- -x", "bless '$(c)'", "its id holds control characters"] {
        assert!(page.contains(line), "{line}");
    }
    assert_eq!(page.matches("class=\"command\"").count(), 3);
}

#[test]
fn names_are_escaped() {
    let name = "<img src=x onerror=alert(1)>\"'</script><script>";
    let mut hostile = case(name, DiffOutcome::Different, 20);
    for text in [&mut hostile.about, &mut hostile.entry, &mut hostile.blessed_as] {
        *text = name.into();
    }
    hostile.pair.why = Some(name.into());
    hostile.likely_causes = vec![name.into()];
    hostile.pair.knobs[0].option = name.into();
    hostile.pair.knobs[1].metric = name.into();
    hostile.golden.as_mut().expect("one").provenance.insert(name.into(), name.into());
    let mut run = results(vec![hostile]);
    (run.manifest, run.environment.key, run.environment.platform) = (name.into(), name.into(), name.into());
    run.command.push(name.into());
    run.unused_goldens.push(name.into());
    let page = page_of(&run, &[run.clone()]);
    assert_eq!((page.matches("<script").count(), page.matches("<img").count()), (1, 1), "the page's own script and heat map");
    assert!(page.matches("&lt;img src=x").count() > 10);
    assert!(values(&page, "data-id")[0].starts_with("%3Cimg%20src%3Dx"));
}

#[test]
fn thousands_of_cases_are_a_small_page() {
    let outcome = |i: u64| if i.is_multiple_of(50) { DiffOutcome::Different } else { DiffOutcome::Same };
    let many = results((0..3000).map(|i| case(&format!("group/{i:04}"), outcome(i), 0)).collect());
    let page = page_of(&many, &[]);
    assert_eq!(page.matches("<li class=\"case").count(), 3000);
    assert!(page.len() < 8_000_000, "{} bytes", page.len());
}

#[test]
fn the_same_results_give_the_same_bytes_whatever_the_clock_says() {
    let mut later = two();
    later.cases[0].timing.seconds = 99.0;
    assert_eq!(page_of(&two(), &[two()]), page_of(&later, &[two()]));
}

#[test]
fn history_is_drawn_and_told_where_metrics_are_the_same() {
    let run = |differing, id: &str| {
        let mut run = results(vec![case(id, DiffOutcome::Different, differing)]);
        run.cases[0].pair.knobs[1].metric = if differing == 30 { "flip-ldr/2".into() } else { "flip-ldr/1.7@67.0206".into() };
        run
    };
    let page = page_of(&run(25, "wild"), &[run(40, "wild"), run(50, "wild"), run(30, "wild"), run(45, "other")]);
    let said = "flip-ldr/1.7@67.0206 over 5 runs, this one last: 0.04 (different), 0.05 (different), not comparable (different), no case, \
                0.025 (different)";
    assert!(page.contains(&format!("<title>{said}</title>")) && page.contains(&format!("aria-label=\"{said}\"")), "{page}");
    assert_eq!(
        (page.matches("<polyline").count(), page.matches("<circle").count()),
        (1, 4),
        "a gap, and no point where there was no case"
    );
    assert!(!page_of(&run(25, "wild"), &[run(40, "other")]).contains("class=\"history\""));
}

#[test]
fn cases_are_watched_in_order_and_an_error_leaves_nothing() {
    let desk = Desk::new();
    let run = results((0..20).map(|i| case(&i.to_string(), DiffOutcome::Same, 0)).collect());
    let mut seen = Vec::new();
    let stop =
        CheckReport::begin(&desk.path("report")).expect("begun").finish(&run, &[], |_| CasePictures::default(), &mut |case| {
            seen.push(case.id.clone());
            if seen.len() < 12 { Ok(()) } else { Err(Error::Request("stopped".into())) }
        });
    assert!(matches!(stop, Err(Error::Request(_))), "{stop:?}");
    assert_eq!(seen, (0..12).map(|i| i.to_string()).collect::<Vec<_>>());
    assert_eq!(fs::read_dir(desk.path("")).expect("a folder").count(), 0);
}

#[test]
fn a_foreign_folder_is_refused_before_anything_is_done() {
    let desk = Desk::new();
    desk.put("mine.png", 0.5);
    assert!(matches!(CheckReport::begin(&desk.path("")), Err(Error::Request(_))));
}
