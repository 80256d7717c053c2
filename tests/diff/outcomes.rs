//! Every outcome with its exit code, its text and its JSON.

use std::fs;

use super::desk::{Desk, changed, levels, picture};

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
        let ran = desk.line(&format!("a.png {other}"));
        ran.ended(0, &["same      ", "all 768 compared pixels are equal"]);
        assert_eq!(ran.stderr, "");
    }
    let (code, json) = desk.json("a.png same.png");
    assert_eq!((code, &json["pairs"][0]["outcome"], &json["counts"]["same"]), (0, &"same".into(), &1.into()));
    assert_eq!(json["pairs"][0]["pixels"], serde_json::json!({ "compared": 768, "differing": 0 }));
    assert_eq!(json["schema_version"], 1);
}

#[test]
fn different() {
    let desk = desk();
    let ran = desk.line("a.png b.png");
    ran.ended(1, &[]);
    let levels = levels();
    let worst: Vec<String> = levels[4 * (10 * 32 + 20)..][..4].iter().map(u8::to_string).collect();
    let (expected, blue) = (worst.join(", "), levels[4 * (10 * 32 + 20) + 2] - 9);
    let actual = format!("{}, {}, {blue}, 255", worst[0], worst[1]);
    let text = ran.stdout.lines().collect::<Vec<_>>();
    assert_eq!(text[0], "different b.png");
    assert_eq!(text[1], "    3 of 768 pixels differ (0.3907%), all within 19x7 at 3,4");
    let worst = format!("worst at 20,10: expected ({expected}), actual ({actual}), a channel differs by 9/255");
    let words = ran.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains(&worst), "{worst}: {ran}");
    assert!(words.contains("each would pass alone: --max-pixels 3; --per-channel 9/255; --max-rmse 0.0008"), "{ran}");

    let (code, json) = desk.json("a.png b.png");
    let pair = &json["pairs"][0];
    assert_eq!((code, &pair["outcome"], &json["counts"]["different"]), (1, &"different".into(), &1.into()));
    assert_eq!(pair["pixels"]["bounds"], serde_json::json!([3, 4, 19, 7]));
    assert_eq!(pair["pixels"]["worst"]["at"], serde_json::json!([20, 10]));
    assert_eq!((&pair["expected"], &pair["actual"]), (&"a.png".into(), &"b.png".into()));
}

#[test]
fn size() {
    let desk = desk();
    desk.put("small.png", &picture(&levels()).crop(0, 0, 31, 24).expect("inside"));
    desk.line("a.png small.png").ended(1, &["size      small.png", "expected 32x24, actual 31x24"]);
    let (code, json) = desk.json("a.png small.png");
    assert_eq!((code, &json["pairs"][0]["outcome"]), (1, &"size".into()));
    assert_eq!(json["pairs"][0]["sizes"], serde_json::json!([[32, 24], [31, 24]]));
    assert_eq!(json["pairs"][0].get("pixels"), None);
}

#[test]
fn unreadable() {
    let desk = desk();
    for (pair, words) in [("a.png absent.png", "absent.png"), ("absent.png a.png", "check the path"), ("a.png .", "name two")] {
        let code = if pair.ends_with(" .") { 2 } else { 3 };
        desk.line(pair).ended(code, &["error: ", words]);
    }
    desk.line("absent.png .").ended(3, &["absent.png"]);
    let (code, json) = desk.json("a.png absent.png");
    assert_eq!((code, &json["pairs"][0]["outcome"], &json["counts"]["unreadable"]), (3, &"unreadable".into(), &1.into()));
    assert!(json["pairs"][0]["why"].as_str().is_some_and(|why| why.contains("absent.png")), "{json}");
}

#[test]
fn missing_and_new() {
    let desk = Desk::new();
    desk.put("x/gone.png", &picture(&levels()));
    desk.put("y/come.png", &picture(&levels()));
    let ran = desk.line("x y");
    assert_eq!(ran.stdout, "new       come.png\nmissing   gone.png\n");
    ran.ended(1, &["1 missing, 1 new"]);
    let (code, json) = desk.json("x y");
    assert_eq!(code, 1);
    assert_eq!((&json["pairs"][0]["outcome"], &json["pairs"][1]["outcome"]), (&"new".into(), &"missing".into()));
    assert_eq!((json["pairs"][0].get("expected"), &json["pairs"][0]["path"]), (None, &"come.png".into()));
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
    desk.put("a.png", &picture(&levels()));
    desk.line("a.png a.png --ignore 0,0,32,24").ended(4, &["uncounted a.png", "nothing was compared: 1 uncounted"]);
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
