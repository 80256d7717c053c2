//! Every outcome with its exit code, its text, its JSON and its JUnit XML.

use std::fs;

use serde_json::{Value, json};

use super::{Desk, desk, json, junit, levels, other, picture};

/// Holds the only case against an outcome in every way there is to hear of it. Answers the case in JSON.
#[track_caller]
fn comes_to(desk: &Desk, outcome: &str, code: i32, words: &[&str]) -> Value {
    let ran = desk.dejag("check --verbose --junit junit.xml");
    ran.ended(code, words);
    assert!(ran.stdout.starts_with(&format!("{outcome} ")), "{ran}");
    let (json_code, json) = json(desk, "");
    let [case] = &json["cases"].as_array().expect("cases")[..] else { panic!("one case: {json}") };
    assert_eq!((json_code, &case["outcome"]), (code, &outcome.into()));
    for (counted, count) in json["counts"].as_object().expect("counts") {
        assert_eq!(count, u64::from(counted == outcome), "{counted}");
    }
    let elements = junit::read(&fs::read_to_string(desk.path("junit.xml")).expect("written"));
    let expected = match outcome {
        "same" => [0, 0],
        "unreadable" | "failed" => [0, 1],
        _ => [1, 0],
    };
    assert_eq!(["failure", "error"].map(|name| junit::named(&elements, name).len()), expected, "{elements:?}");
    case.clone()
}

#[test]
fn same() {
    let desk = desk();
    let case = comes_to(&desk, "same", 0, &["same shots/a.png", "all 768 compared pixels are equal", "1 same"]);
    assert_eq!((&case["expected"], &case["actual"]), (&"goldens/any/shots/a.png".into(), &"candidates/shots/a.png".into()));
    desk.dejag("check").ended(0, &["1 same"]);
    assert_eq!(desk.dejag("check -q").stdout, "");
}

#[test]
fn different() {
    let desk = desk();
    desk.put("shots/a.png", &other());
    let words = [
        "3 of 768 pixels differ",
        "each would pass alone: --max-pixels 3; --per-channel 9/255; --max-rmse 0.0008",
        "--max-flip",
        "written: differences/shots/a.png.heat.png",
        "what is right: dejag bless",
    ];
    let case = comes_to(&desk, "different", 1, &words);
    assert!(desk.path("dejag-check").join(case["pictures"][0].as_str().expect("a path")).is_file());
    // A near miss: the manifest's limits decide, and a heat map of what is fine now does not stay.
    desk.write("dejag.toml", format!("{}tolerance = {{ max-pixels = 3 }}\n", super::MANIFEST));
    desk.dejag("check").ended(0, &["1 same"]);
    assert!(!desk.path("dejag-check/differences/shots/a.png.heat.png").exists());
    desk.write("dejag.toml", format!("{}tolerance = {{ max-pixels = 2 }}\n", super::MANIFEST));
    desk.dejag("check").ended(1, &["1 different"]);
}

#[test]
fn size() {
    let desk = desk();
    desk.put("shots/a.png", &picture(&levels()).crop(0, 0, 31, 24).expect("inside"));
    comes_to(&desk, "size", 1, &["expected 32x24, actual 31x24"]);
}

#[test]
fn profile() {
    let desk = desk();
    let light = dejag::picture::LinearPicture::from_fn(32, 24, |_, _| [0.5, 0.5, 0.5, 1.0]).expect("a size");
    light.save_exr(&desk.path("shots/a.png"), &[]).expect("saved");
    comes_to(&desk, "profile", 1, &["expected sRGB, actual linear light"]);
}

#[test]
fn new() {
    let desk = desk();
    fs::remove_file(desk.path("goldens/any/shots/a.png")).expect("removed");
    let words = ["there is no golden goldens/any/shots/a.png", "goldens/any/shots/a.candidate.png", "dejag bless"];
    comes_to(&desk, "new", 1, &words);
    assert!(desk.path("goldens/any/shots/a.candidate.png").is_file(), "the candidate is left to be looked at");
    assert!(!desk.path("goldens/any/shots/a.png").exists(), "but not blessed");
    // Nor does it count as a golden, or as one without a case.
    comes_to(&desk, "new", 1, &words);
}

#[test]
fn missing() {
    let desk = desk();
    fs::remove_file(desk.path("shots/a.png")).expect("removed");
    comes_to(&desk, "missing", 1, &["its golden is there, its picture is not"]);
    desk.write("dejag.toml", "[[files]]\nid = 'shots/a'\nfile = 'shots/a.png'\n");
    comes_to(&desk, "missing", 1, &[]);
    fs::remove_file(desk.path("goldens/any/shots/a.png")).expect("removed");
    comes_to(&desk, "unreadable", 3, &["check the path"]);
}

#[test]
fn unreadable() {
    let desk = desk();
    for broken in ["goldens/any/shots/a.png", "shots/a.png"] {
        let whole = fs::read(desk.path(broken)).expect("there");
        for bytes in [&whole[..whole.len() / 2], b"", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"] {
            desk.write(broken, bytes);
            comes_to(&desk, "unreadable", 3, &["could not be read"]);
            desk.dejag("bless").ended(1, &["left alone"]);
            assert_eq!(fs::read(desk.path(broken)).expect("there"), bytes, "nothing replaces it");
        }
        desk.write(broken, &whole);
    }
    comes_to(&desk, "same", 0, &[]);
    // A broken picture without a golden is no candidate for one.
    fs::remove_file(desk.path("goldens/any/shots/a.png")).expect("removed");
    desk.write("shots/a.png", "no picture");
    comes_to(&desk, "unreadable", 3, &["begins like none"]);
    desk.dejag("bless").ended(1, &["left alone"]);
    assert!(!desk.path("goldens/any/shots/a.png").exists() && !desk.path("goldens/any/shots/a.candidate.png").exists());
    fs::remove_dir_all(desk.path("shots")).expect("removed");
    desk.dejag("check").ended(3, &["unreadable", "could not read shots"]);
}

#[test]
fn uncounted() {
    let desk = desk();
    desk.put("shots/a.png", &other());
    desk.write("dejag.toml", format!("{}scope = {{ ignore = ['0,0,32,24'] }}\n", super::MANIFEST));
    comes_to(&desk, "uncounted", 4, &["nothing was compared"]);
    desk.write("dejag.toml", format!("{}scope = {{ mask = 'mask.png' }}\n", super::MANIFEST));
    desk.put("mask.png", &picture(&[0; 32 * 24 * 4]));
    comes_to(&desk, "uncounted", 4, &[]);
    desk.put("mask.png", &picture(&[255; 32 * 24 * 4]));
    comes_to(&desk, "different", 1, &[]);
    desk.put("mask.png", &picture(&levels()).crop(0, 0, 31, 24).expect("inside"));
    comes_to(&desk, "failed", 3, &["its mask or regions do not fit", "31x24"]);
    fs::remove_file(desk.path("mask.png")).expect("removed");
    comes_to(&desk, "failed", 3, &["of its mask: could not read"]);
    desk.dejag("bless").ended(1, &["left alone"]);
}

#[test]
fn what_is_said_first_is_outranked_by_what_is_worse() {
    let desk = desk();
    desk.put("shots/b.png", &other());
    desk.put("goldens/any/shots/b.png", &picture(&levels()));
    desk.dejag("check").ended(1, &["1 same, 1 different"]);
    desk.write("shots/c.png", "no picture");
    desk.write("goldens/any/shots/c.png", "no picture");
    desk.dejag("check").ended(3, &["1 same, 1 different, 1 unreadable"]);
}

#[test]
fn manifests_that_make_no_sense_and_requests_that_do_not_either() {
    let desk = desk();
    desk.dejag("check --manifest absent.toml").ended(3, &["absent.toml", "docs/check.md"]);
    desk.dejag("check nothing").ended(2, &["unknown case 'nothing'", "known: shots"]);
    desk.dejag("check shots").ended(0, &[]);
    desk.dejag("check shots/a.png").ended(0, &["1 same"]);
    for taken in ["dejag.toml", "shots/a.png", "goldens/any/shots/a.png"] {
        let before = fs::read(desk.path(taken)).expect("there");
        for option in ["--json", "--junit"] {
            desk.dejag(&format!("check {option} {taken}")).ended(2, &["is there already and holds something else"]);
        }
        assert_eq!(fs::read(desk.path(taken)).expect("there"), before);
    }
    desk.dejag("check --json r.json --junit r.xml").ended(0, &[]);
    desk.dejag("check --json r.json --junit r.xml").ended(0, &[]);
    desk.dejag("check --costs x.json").ended(2, &["--shard"]);
    desk.dejag("check --shard 3/2").ended(2, &["is no shard"]);
    desk.dejag("check --list").ended(0, &["shots"]);
    for key in ["../../elsewhere", "/tmp/elsewhere", "a//b"] {
        desk.dejag(&format!("check --environment {key}")).ended(2, &["--environment", "is no id"]);
    }
    desk.write("dejag.toml", "[[files]]\nid = 'shots'\n");
    desk.dejag("check").ended(2, &["dejag.toml:1:1", "need either `file` or `folder`"]);
    desk.write("dejag.toml", "");
    desk.dejag("check").ended(4, &["nothing was compared"]);
}

#[test]
fn goldens_that_no_case_uses_are_named() {
    let desk = desk();
    desk.put("goldens/any/gone.png", &other());
    desk.dejag("check").ended(0, &["1 golden that no case uses: goldens/any/gone.png"]);
    assert_eq!(json(&desk, "").1["unused_goldens"], json!(["goldens/any/gone.png"]));
}

#[test]
fn goldens_and_tolerances_of_environments() {
    let desk = desk();
    desk.put("goldens/mine-2/shots/a.png", &other());
    let environment = |desk: &Desk, key: &str| json(desk, &format!("--environment {key}")).1["cases"][0].clone();
    // The nearest golden is taken, from the whole key down to `any`.
    assert_eq!(environment(&desk, "mine-2.7")["expected"], "goldens/mine-2/shots/a.png");
    assert_eq!(environment(&desk, "mine-2.7")["blessed_as"], "goldens/mine-2.7/shots/a.png");
    assert_eq!(environment(&desk, "mine-3")["expected"], "goldens/any/shots/a.png");
    assert_eq!(environment(&desk, "mine-3")["outcome"], "same");
    desk.dejag("check --environment mine-2.7").ended(1, &["likely cause: mine-2.7 has no golden of its own; that of mine-2"]);
    desk.write("dejag.toml", format!("fallback = ['mine-2']\n{}", super::MANIFEST));
    assert_eq!(environment(&desk, "yours")["expected"], "goldens/mine-2/shots/a.png");
    let over = "[[override]]\nenvironment = 'mine-*'\ntolerance = { max-pixels = 3 }\n";
    desk.write("dejag.toml", format!("{}{over}", super::MANIFEST));
    assert_eq!(environment(&desk, "mine-2.7")["outcome"], "same");
    assert_eq!(environment(&desk, "mine-2.7")["knobs"][0]["limit"], 3.0);
    assert_eq!(environment(&desk, "yours")["knobs"][0]["limit"], 0.0);
}

#[test]
fn where_github_listens_it_is_told() {
    let desk = desk();
    desk.put("shots/a.png", &other());
    let mut command = desk.command();
    command.arg("check").env("GITHUB_ACTIONS", "true").env("GITHUB_STEP_SUMMARY", desk.path("summary.md"));
    super::super::desk::Ran::of(&mut command).ended(1, &["::error file=dejag.toml", "shots/a.png"]);
    assert!(fs::read_to_string(desk.path("summary.md")).expect("written").contains("different"));
    let quiet = desk.dejag("check");
    assert!(!quiet.stderr.contains("::error"), "{quiet}");
}

#[test]
fn a_report_is_written_and_a_foreign_folder_is_not_replaced() {
    let desk = desk();
    desk.put("shots/a.png", &other());
    desk.dejag("check --report report").ended(1, &["report/index.html"]);
    assert!(fs::read_to_string(desk.path("report/index.html")).expect("a page").contains("shots/a.png"));
    fs::copy(desk.path("dejag-check/check.json"), desk.path("earlier.json")).expect("copied");
    desk.dejag("check --report report --history earlier.json").ended(1, &[]);
    desk.dejag("check --report shots").ended(2, &["will not be replaced"]);
    desk.dejag("check --report report --history dejag.toml").ended(3, &["dejag.toml", "result of `dejag check`"]);
}
