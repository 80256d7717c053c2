//! Every outcome with its exit code, its text, its JSON and its JUnit XML.

use std::fs;

use dejag::picture::LinearPicture;

use super::desk::{Desk, changed, levels, picture};
use super::junit;

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("a.png", &picture(&levels()));
    desk.put("same.png", &picture(&levels()));
    desk.put("b.png", &changed(&[(3, 4, 0, 5), (20, 10, 2, -9), (21, 10, 1, 1)]));
    desk
}

#[test]
fn same() {
    let desk = desk();
    for other in ["same.png", "a.png"] {
        let pair = desk.comes_to(&format!("a.png {other}"), "same", 0, &["all 768 compared pixels are equal"]);
        assert_eq!(pair["pixels"], serde_json::json!({ "compared": 768, "differing": 0 }));
        assert_eq!(desk.line(&format!("a.png {other}")).stderr, "");
    }
    assert_eq!(desk.json("a.png same.png").1["schema_version"], 1);
}

#[test]
fn different() {
    let desk = desk();
    let levels = levels();
    let worst: Vec<String> = levels[4 * (10 * 32 + 20)..][..4].iter().map(u8::to_string).collect();
    let (expected, blue) = (worst.join(", "), levels[4 * (10 * 32 + 20) + 2] - 9);
    let actual = format!("{}, {}, {blue}, 255", worst[0], worst[1]);
    let words = [
        "different b.png",
        "3 of 768 pixels differ (0.3907%), all within 19x7 at 3,4",
        &format!("worst at 20,10: expected ({expected}), actual ({actual}), a channel differs by 9/255"),
        "each would pass alone: --max-pixels 3; --per-channel 9/255; --max-rmse 0.0008",
    ];
    let pair = desk.comes_to("a.png b.png", "different", 1, &words);
    assert_eq!(pair["pixels"]["bounds"], serde_json::json!([3, 4, 19, 7]));
    assert_eq!(pair["pixels"]["worst"]["at"], serde_json::json!([20, 10]));
    assert_eq!((&pair["expected"], &pair["actual"]), (&"a.png".into(), &"b.png".into()));
    let words = ["--max-flip 0: missed", "changed object", "written: heat.png"];
    desk.comes_to("a.png b.png --max-flip 0 --allow-edges --heat heat.png", "different", 1, &words);
}

#[test]
fn size() {
    let desk = desk();
    desk.put("small.png", &picture(&levels()).crop(0, 0, 31, 24).expect("inside"));
    let pair = desk.comes_to("a.png small.png", "size", 1, &["size      small.png", "expected 32x24, actual 31x24"]);
    assert_eq!(pair["sizes"], serde_json::json!([[32, 24], [31, 24]]));
    assert_eq!(pair.get("pixels"), None);
}

#[test]
fn profile() {
    let desk = desk();
    let light = LinearPicture::from_fn(32, 24, |_, _| [0.5, 0.5, 0.5, 1.0]).expect("a size");
    light.save_exr(&desk.path("light.exr"), &[]).expect("saved");
    let words = ["profile   light.exr", "expected sRGB, actual linear light"];
    assert_eq!(desk.comes_to("a.png light.exr", "profile", 1, &words).get("pixels"), None);
}

#[test]
fn unreadable() {
    let desk = desk();
    let pair = desk.comes_to("a.png absent.png", "unreadable", 3, &["error: ", "absent.png", "could not be read"]);
    assert!(pair["why"].as_str().is_some_and(|why| why.contains("absent.png")), "{pair}");
    desk.comes_to("absent.png a.png", "unreadable", 3, &["error: ", "check the path"]);
    desk.line("a.png .").ended(2, &["error: ", "name two"]);
    desk.line("absent.png .").ended(3, &["error: ", "absent.png"]);
}

#[test]
fn uncounted() {
    let words = ["uncounted b.png", "error: nothing was compared: 1 uncounted"];
    let pair = desk().comes_to("a.png b.png --ignore 0,0,32,24", "uncounted", 4, &words);
    assert_eq!(pair["pixels"]["compared"], 0);
}

#[test]
fn missing_and_new() {
    let desk = Desk::new();
    desk.put("x/gone.png", &picture(&levels()));
    desk.put("y/come.png", &picture(&levels()));
    let pair = desk.comes_to("x y --include gone.png", "missing", 1, &["missing   gone.png", "1 missing, 1 other file skipped"]);
    assert_eq!((pair.get("actual"), &pair["path"]), (None, &"gone.png".into()));
    let pair = desk.comes_to("x y --include come.png", "new", 1, &["new       come.png"]);
    assert_eq!((pair.get("expected"), &pair["path"]), (None, &"come.png".into()));
    let ran = desk.line("x y");
    assert_eq!(ran.stdout, "new       come.png\nmissing   gone.png\n");
    ran.ended(1, &["1 missing, 1 new"]);
}

#[test]
fn nothing_compared() {
    let desk = Desk::new();
    for folder in ["x", "y"] {
        fs::create_dir(desk.path(folder)).expect("made");
    }
    desk.line("x y").ended(4, &["error: nothing was compared: no pictures"]);
    desk.write("x/notes.txt", "words");
    desk.line("x y").ended(4, &["1 other file skipped"]);
    let (code, json) = desk.json("x y");
    assert_eq!((code, &json["pairs"]), (4, &serde_json::json!([])));
}

#[test]
fn errors_outrank_differences_and_differences_nothing() {
    let desk = desk();
    for (name, from) in [("x/1.png", "a.png"), ("y/1.png", "b.png"), ("x/2.png", "a.png")] {
        desk.write(name, fs::read(desk.path(from)).expect("there"));
    }
    desk.write("y/2.png", "no picture");
    let ran = desk.line("x y");
    ran.ended(3, &["different 1.png", "unreadable 2.png", "1 different, 1 unreadable", "error: "]);
    desk.line("x y --exclude 2.png").ended(1, &["1 different, 2 other files skipped"]);
    desk.line("x y -q").ended(3, &["error: "]);
}

#[test]
fn requests_that_make_no_sense() {
    let desk = desk();
    for (arguments, words) in [
        ("a.png", "ACTUAL"),
        ("a.png b.png --max-pixels many", "whole number"),
        ("a.png b.png --per-channel 2/0", "2/255"),
        ("a.png b.png --min-psnr -3", ""),
        ("a.png b.png --ignore 0,0,33,1", "outside a picture of 32x24"),
        ("a.png b.png --include *.png", "two files"),
        ("a.png b.png --max-memory none", "GiB"),
        (". . --heat x.png", "--output"),
        (". . --include [", "glob"),
        ("a.png b.png --junit .", "is a folder"),
    ] {
        desk.line(arguments).ended(2, &["error: ", words]);
    }
}

#[test]
fn quiet_is_quiet_and_data_stay_apart_from_words() {
    let desk = desk();
    let ran = desk.line("a.png b.png -q");
    assert!(ran.stderr.is_empty() && ran.stdout.starts_with("different"), "{ran}");
    assert!(!ran.stdout.contains('\u{1b}'), "{ran}");
    let ran = desk.line("a.png b.png --json out.json");
    assert!(ran.stdout.starts_with("different"), "{ran}");
    let written: serde_json::Value = serde_json::from_slice(&fs::read(desk.path("out.json")).expect("written")).expect("JSON");
    assert_eq!(written, desk.json("a.png b.png").1);
}

#[test]
fn junit_has_a_case_for_each_pair_and_is_the_same_every_time() {
    let desk = desk();
    for (name, from) in
        [("x/1.png", "a.png"), ("y/1.png", "b.png"), ("x/2.png", "a.png"), ("y/2.png", "a.png"), ("x/3.png", "a.png")]
    {
        desk.write(name, fs::read(desk.path(from)).expect("there"));
    }
    let mut written = Vec::new();
    for _ in 0..2 {
        desk.line("x y --junit out.xml --json -").ended(1, &[]);
        written.push(fs::read_to_string(desk.path("out.xml")).expect("written"));
    }
    assert_eq!(written[0], written[1]);
    let elements = junit::read(&written[0]);
    let names: Vec<&str> = junit::named(&elements, "testcase").into_iter().map(|case| case.get("name")).collect();
    assert_eq!(names, ["1.png", "2.png", "3.png"]);
    let types: Vec<&str> = junit::named(&elements, "failure").into_iter().map(|failure| failure.get("type")).collect();
    assert_eq!(types, ["different", "missing"]);
    desk.line("a.png a.png --junit none/out.xml").ended(3, &["none"]);
}

#[cfg(unix)]
#[test]
fn a_file_may_have_any_name() {
    let desk = desk();
    let name = "<&\"']]>\u{1b}[2J\n|%.png";
    desk.write(format!("x/{name}"), fs::read(desk.path("a.png")).expect("there"));
    desk.line("x y --junit out.xml").ended(3, &[]);
    fs::create_dir(desk.path("y")).expect("made");
    let ran = desk.line("x y --junit out.xml");
    assert!(!ran.ended(1, &[]).stdout.contains('\u{1b}'), "{ran}");
    let elements = junit::read(&fs::read_to_string(desk.path("out.xml")).expect("written"));
    assert_eq!(junit::named(&elements, "testcase")[0].get("name"), name.replace('\u{1b}', "\u{fffd}"));
}
