//! Folders: matching, choosing, order, names of every kind, and one bad file among good ones.

use std::fs;

use serde_json::Value;

use super::desk::{Desk, changed, levels, picture};

fn outcomes(json: &Value) -> Vec<(String, String)> {
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    json["pairs"].as_array().expect("pairs").iter().map(|pair| (word(&pair["path"]), word(&pair["outcome"]))).collect()
}

/// Folders `x` and `y` with these files, the same on both sides.
fn desk(names: &[&str]) -> Desk {
    let desk = Desk::new();
    for folder in ["x", "y"] {
        fs::create_dir(desk.path(folder)).expect("made");
        for name in names {
            desk.put(format!("{folder}/{name}"), &picture(&levels()));
        }
    }
    desk
}

#[test]
fn all_outcomes_in_the_order_of_paths() {
    let desk = desk(&["b/2.png", "a.png", "b/1.png", "c.png", "d.png"]);
    desk.put("y/b/1.png", &changed(&[(0, 0, 0, 1)]));
    desk.put("y/c.png", &picture(&levels()).crop(0, 0, 8, 8).expect("inside"));
    fs::remove_file(desk.path("y/d.png")).expect("removed");
    desk.put("y/e.png", &picture(&levels()));
    desk.write("x/f.png", "");
    desk.write("y/f.png", "");
    let (code, json) = desk.json("x y");
    let wanted = [
        ("a.png", "same"),
        ("b/1.png", "different"),
        ("b/2.png", "same"),
        ("c.png", "size"),
        ("d.png", "missing"),
        ("e.png", "new"),
        ("f.png", "unreadable"),
    ];
    assert_eq!(outcomes(&json), wanted.map(|(path, outcome)| (path.to_owned(), outcome.to_owned())));
    assert_eq!(code, 3);
    assert_eq!(json["counts"]["same"], 2);
    let ran = desk.line("x y");
    ran.ended(3, &["2 same, 1 different, 1 size, 1 missing, 1 new, 1 unreadable", "it is empty"]);
    assert!(!ran.stdout.contains("a.png") && desk.line("x y -v").stdout.contains("same      a.png"), "{ran}");
}

#[test]
fn files_are_chosen_by_ending_or_by_glob() {
    let desk = desk(&["a.png", "sub/b.png", "sub/c.jpg"]);
    desk.write("x/notes.txt", "words");
    let paths = |options: &str| {
        let (_, json) = desk.json(&format!("x y {options}"));
        (outcomes(&json).into_iter().map(|(path, _)| path).collect::<Vec<_>>().join(" "), json["skipped"].as_u64().unwrap_or(0))
    };
    assert_eq!(paths(""), ("a.png sub/b.png sub/c.jpg".into(), 1));
    assert_eq!(paths("--include sub/**"), ("sub/b.png sub/c.jpg".into(), 3));
    assert_eq!(paths("--include *.png --exclude sub/*"), ("a.png".into(), 5));
    assert_eq!(paths("--include *.txt"), ("notes.txt".into(), 6));
    desk.line("x y --include none").ended(4, &["nothing was compared"]);
}

#[cfg(unix)]
#[test]
fn links_in_a_circle_and_broken_ones() {
    use std::os::unix::fs::symlink;
    let desk = desk(&["a.png"]);
    symlink(desk.path("x"), desk.path("x/round")).expect("linked");
    symlink("a.png", desk.path("x/link.png")).expect("linked");
    symlink("a.png", desk.path("y/link.png")).expect("linked");
    desk.line("x y").ended(0, &["2 same, 1 other file skipped"]);
    symlink("self.png", desk.path("x/self.png")).expect("linked");
    symlink("self.png", desk.path("y/self.png")).expect("linked");
    desk.line("x y").ended(3, &["2 same", "1 unreadable", "self.png"]);
    symlink(desk.path("x"), desk.path("z")).expect("linked");
    desk.line("z y --exclude self.png").ended(0, &["2 same"]);
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_hard_to_say() {
    use std::os::unix::ffi::OsStrExt as _;
    let strange = ["quote\".png", "it's.png", "line\nfeed.png", "<script>.png", "..png", "\u{1b}[31m.png", " .png", "--json.png"];
    let desk = desk(&strange);
    let raw = std::ffi::OsStr::from_bytes(b"\xff\xfe.png");
    for folder in ["x", "y"] {
        desk.put(desk.path(folder).join(raw), &picture(&levels()));
    }
    let ran = desk.line("x y -v -o out");
    ran.ended(0, &["9 same"]);
    assert!(!ran.stdout.contains('\u{1b}'), "{ran}");
    assert_eq!(ran.stdout.lines().filter(|line| line.starts_with("same")).count(), 9, "{ran}");
    let (_, json) = desk.json("x y");
    let lossy: Vec<&Value> = json["pairs"].as_array().expect("pairs").iter().filter(|pair| pair["lossy"] == true).collect();
    assert_eq!((lossy.len(), &lossy[0]["path"]), (1, &"\u{fffd}\u{fffd}.png".into()));
    // Their pictures lie in the folder, all of them.
    for name in strange {
        desk.put(format!("y/{name}"), &changed(&[(1, 1, 1, 1)]));
    }
    desk.put(desk.path("y").join(raw), &changed(&[(1, 1, 1, 1)]));
    desk.line("x y -o out").ended(1, &["9 different"]);
    assert_eq!(fs::read_dir(desk.path("out")).expect("made").count(), 27);
}

#[test]
fn one_bad_file_stops_nothing() {
    let names: Vec<String> = (0..40).map(|i| format!("{i:02}.png")).collect();
    let desk = desk(&names.iter().map(String::as_str).collect::<Vec<_>>());
    desk.write("y/07.png", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n");
    let ran = desk.line("x y");
    ran.ended(3, &["39 same, 1 unreadable", "07.png", "Git LFS pointer", "git lfs pull"]);
    // The same pointer on both sides is no match.
    desk.write("x/07.png", fs::read(desk.path("y/07.png")).expect("there"));
    desk.line("x y").ended(3, &["39 same, 1 unreadable"]);
}

#[cfg(target_os = "linux")]
#[test]
fn what_may_not_be_read() {
    let desk = desk(&["a.png", "sub/b.png"]);
    desk.permit("y/a.png", 0o000);
    desk.bound("diff x y").ended(3, &["1 same, 1 unreadable", "check the permissions"]);
    desk.permit("y/a.png", 0o644);
    desk.permit("y/sub", 0o000);
    desk.bound("diff x y").ended(3, &["1 same", "1 missing", "1 unreadable", "y/sub"]);
    desk.permit("y/sub", 0o755);
}
