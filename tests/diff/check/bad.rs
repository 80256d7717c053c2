//! Files and names that are not what they should be: the other cases still run, and nothing is written outside the output folder.

use std::fs;

use super::{Desk, desk, json, levels, other, picture};

/// Counts by outcome in the order of their names, those that are not 0.
fn counts(desk: &Desk) -> Vec<(String, u64)> {
    let (_, results) = json(desk, "");
    let counts = results["counts"].as_object().expect("counts").clone();
    counts.into_iter().filter_map(|(outcome, count)| Some((outcome, count.as_u64().filter(|count| *count > 0)?))).collect()
}

/// Everything but what a run may write.
fn outside(desk: &Desk) -> Vec<String> {
    desk.names().into_iter().filter(|name| !name.starts_with("dejag-check")).collect()
}

#[cfg(unix)]
#[test]
fn hostile_names() {
    use std::os::unix::ffi::OsStrExt as _;
    let desk = desk();
    let names: [&[u8]; 7] = [
        b"\"quoted\" & 'this' <b>.png",
        b"line\nbreak\r.png",
        b"..png",
        b"... .. .png",
        b"$(touch pwned);`id`.png",
        b"bytes \xff\xfe.png",
        b"[a-z]*?{x}\\.png",
    ];
    for name in names {
        let name = std::ffi::OsStr::from_bytes(name);
        desk.put(std::path::Path::new("shots").join(name), &picture(&levels()));
        desk.put(std::path::Path::new("goldens/any/shots").join(name), &other());
    }
    let before = outside(&desk);
    let found = counts(&desk);
    assert_eq!(found, [("different".to_owned(), 7), ("same".to_owned(), 1)]);
    desk.dejag("check --junit dejag-check/j.xml --report dejag-check/report").ended(1, &[]);
    assert_eq!(outside(&desk), before, "nothing is written outside");
    // All can be blessed but the one whose name JSON cannot hold.
    desk.dejag("bless").ended(1, &["left alone", "not UTF-8"]);
    assert_eq!(counts(&desk), [("different".to_owned(), 1), ("same".to_owned(), 7)]);
    let named = super::super::desk::Ran::of(desk.command().args(["bless", "shots/[a-z]*?{x}\\.png", "--dry-run"]));
    named.ended(0, &["golden shots/[a-z]*?{x}\\.png:", "already"]);
}

#[cfg(unix)]
#[test]
fn links_pipes_and_folders_in_the_way() {
    let desk = desk();
    let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, desk.path(name)).expect("linked");
    link("loop.png", "shots/loop.png");
    link("..", "shots/parent");
    link("nowhere.png", "shots/dangling.png");
    let made = std::process::Command::new("mkfifo").arg(desk.path("shots/pipe.png")).status().expect("mkfifo runs");
    assert!(made.success());
    let before = outside(&desk);
    let (code, results) = json(&desk, "");
    assert_eq!((code, &results["counts"]["same"], &results["counts"]["unreadable"]), (3, &1.into(), &3.into()));
    assert_eq!(outside(&desk), before);
    // A golden that leads nowhere is broken, not missing.
    desk.put("shots/b.png", &other());
    link("nowhere.png", "goldens/any/shots/b.png");
    let (_, results) = json(&desk, "");
    let case = results["cases"].as_array().expect("cases").iter().find(|case| case["id"] == "shots/b.png").expect("there");
    assert_eq!(case["outcome"], "unreadable");
    desk.dejag("bless shots/b.png").ended(1, &["left alone"]);
    link("nowhere.png", "shots/lost.png");
    desk.write("dejag.toml", "[[files]]\nid = 'shots/a'\nfile = 'shots/lost.png'\n");
    desk.dejag("check").ended(3, &["unreadable", "shots/lost.png"]);
    assert!(fs::symlink_metadata(desk.path("goldens/any/shots/b.png")).expect("there").is_symlink());
}

#[test]
fn a_png_cut_off_at_every_byte_as_picture_and_as_golden() {
    let desk = Desk::new();
    desk.write("dejag.toml", super::MANIFEST);
    let small = dejag::picture::DisplayPicture::from_rgba8(3, 2, &[9; 24]).expect("3x2");
    desk.put("whole.png", &small);
    let whole = fs::read(desk.path("whole.png")).expect("there");
    for length in 0..whole.len() {
        desk.write(format!("shots/picture {length:03}.png"), &whole[..length]);
        desk.write(format!("goldens/any/shots/picture {length:03}.png"), &whole);
        desk.write(format!("shots/golden {length:03}.png"), &whole);
        desk.write(format!("goldens/any/shots/golden {length:03}.png"), &whole[..length]);
    }
    let (code, results) = json(&desk, "");
    let count = |outcome: &str| results["counts"][outcome].as_u64().expect("a count");
    assert_eq!((code, count("same") + count("unreadable")), (3, 2 * whole.len() as u64));
    assert!(count("unreadable") >= 2 * (whole.len() as u64 - 12), "{}", count("unreadable"));
}

/// A file may grow to 64 KiB, as on a full disk.
#[cfg(target_os = "linux")]
#[test]
fn where_a_file_cannot_be_written_the_others_are() {
    let desk = desk();
    let mixed = |x: u32, y: u32| (x.wrapping_mul(7919) ^ y.wrapping_mul(104_729)).wrapping_mul(2_654_435_761);
    let noise = |x: u32, y: u32| (mixed(x, y) >> 24) as f32 / 255.0;
    let large = dejag::picture::DisplayPicture::from_fn(300, 300, |x, y| [noise(x, y), noise(y, x), noise(x, x * y), 1.0])
        .expect("a size");
    desk.put("shots/large.png", &large);
    desk.put("goldens/any/shots/large.png", &large);
    let mut command = std::process::Command::new("bash");
    let script = format!("trap '' XFSZ; ulimit -f 64; exec '{}' check --json -", env!("CARGO_BIN_EXE_dejag"));
    command.args(["-c", &script]).current_dir(desk.path(""));
    let ran = super::super::desk::Ran::of(&mut command);
    assert_eq!(ran.code, Some(3), "{ran}");
    let results = ran.json();
    assert_eq!((&results["counts"]["same"], &results["counts"]["unreadable"]), (&1.into(), &1.into()), "{ran}");
    assert!(ran.stdout.contains("free some space"), "{ran}");
    assert!(!desk.names().iter().any(|name| name.ends_with(".part")), "nothing half-written stays");
}

#[test]
fn a_picture_named_like_a_left_candidate_takes_no_golden_s_place() {
    let desk = desk();
    desk.put("shots/b.png", &other());
    desk.put("shots/b.candidate.png", &other());
    desk.put("goldens/any/shots/b.candidate.png", &picture(&levels()));
    let (code, results) = json(&desk, "");
    assert_eq!((code, &results["counts"]["new"], &results["counts"]["unreadable"]), (3, &1.into(), &1.into()));
    desk.dejag("check").ended(3, &["'.candidate.' in its name"]);
}

#[test]
fn a_folder_that_holds_the_goldens_and_the_output_is_not_its_own_picture() {
    let desk = desk();
    desk.write("dejag.toml", "[[files]]\nid = 'all'\nfolder = '.'\n");
    for _ in 0..2 {
        let (_, results) = json(&desk, "");
        let ids: Vec<_> = results["cases"].as_array().expect("cases").iter().map(|case| case["id"].clone()).collect();
        assert_eq!(ids, ["all/shots/a.png"]);
        desk.put("goldens/any/all/shots/a.png", &picture(&levels()));
        desk.dejag("check --report some/report --output elsewhere").ended(0, &["1 same"]);
        desk.dejag("check --shard 1/1").ended(0, &["1 same"]);
    }
    // Pictures may lie in the output folder itself.
    desk.write("dejag.toml", "output = 'shots'\n[[files]]\nid = 'all/shots'\nfolder = 'shots'\n");
    desk.dejag("check").ended(0, &["1 same"]);
    desk.dejag("check").ended(0, &["1 same"]);
    desk.write("dejag.toml", "[[files]]\nid = 'a'\nfolder = 'shots/a.png'\n");
    desk.dejag("check").ended(3, &["is a file; name it with `file`"]);
}

#[cfg(unix)]
#[test]
fn what_came_into_the_golden_s_place_is_not_replaced() {
    let desk = desk();
    desk.put("shots/b.png", &other());
    desk.dejag("check").ended(1, &["1 new"]);
    std::os::unix::fs::symlink("nowhere.png", desk.path("goldens/any/shots/b.png")).expect("linked");
    desk.dejag("bless").ended(1, &["left alone shots/b.png", "cannot be read"]);
    assert!(fs::symlink_metadata(desk.path("goldens/any/shots/b.png")).expect("there").is_symlink());
}

#[cfg(target_os = "linux")]
#[test]
fn without_permission() {
    let desk = desk();
    desk.put("shots/locked.png", &other());
    desk.permit("shots/locked.png", 0o000);
    desk.bound("check").ended(3, &["1 same, 1 unreadable", "locked.png", "check the permissions"]);
    desk.permit("shots/locked.png", 0o644);
    desk.put("shots/a.png", &other());
    // The golden may not be read.
    desk.permit("goldens/any/shots/a.png", 0o000);
    desk.bound("check shots/a.png").ended(3, &["unreadable", "goldens/any/shots/a.png", "check the permissions"]);
    desk.permit("goldens/any/shots/a.png", 0o644);
    // Goldens that are for reading only are enough to check; their places are not enough to bless.
    desk.permit("goldens/any/shots", 0o555);
    let found = desk.bound("check");
    found.ended(1, &["1 different, 1 new", "could not write goldens/any/shots/locked.candidate.png: Permission denied"]);
    assert_eq!(desk.bound("check").stdout, found.stdout);
    desk.bound("bless shots/a.png").ended(3, &["check the permissions"]);
    desk.permit("goldens/any/shots", 0o755);
    desk.bound("check").ended(1, &["1 different, 1 new"]);
    desk.bound("bless").ended(0, &["shots/a.png", "shots/locked.png"]);
    // Nowhere to put candidates.
    desk.permit("dejag-check", 0o555);
    desk.bound("check").ended(3, &["dejag-check", "check the permissions"]);
    desk.permit("dejag-check", 0o755);
}
