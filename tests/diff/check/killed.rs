//! Killed at any time, and run twice at once: goldens stay whole, and a rerun succeeds.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use dejag::picture::{DisplayPicture, load};

use super::{Desk, json, without_times};

const PICTURES: usize = 24;

/// Large enough that a kill meets it while it is written.
fn noise(seed: usize) -> DisplayPicture {
    let value =
        |x: u32, y: u32, c: u32| ((x * 7919 + y * 104_729 + c * 31 + seed as u32 * 977).wrapping_mul(2_654_435_761) >> 24) as u8;
    let level = |x, y, c| f32::from(value(x, y, c)) / 255.0;
    DisplayPicture::from_fn(160, 120, |x, y| [level(x, y, 0), level(x, y, 1), level(x, y, 2), 1.0]).expect("a size")
}

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("dejag.toml", super::MANIFEST);
    for k in 0..PICTURES {
        desk.put(format!("shots/{k}.png"), &noise(k));
        desk.put(format!("goldens/any/shots/{k}.png"), &noise(k + 1000));
    }
    desk
}

fn goldens(desk: &Desk) -> BTreeMap<PathBuf, Vec<u8>> {
    let files = fs::read_dir(desk.path("goldens/any/shots")).expect("a folder").map(|entry| entry.expect("an entry").path());
    files
        .filter(|path| path.extension().is_some_and(|e| e == "png"))
        .map(|path| (path.clone(), fs::read(&path).expect("there")))
        .collect()
}

/// Runs a line and kills it, at 25 moments of the time that it takes. Answers how often it was still alive.
fn killed(desk: &Desk, line: &str, mut between: impl FnMut()) -> usize {
    let start = Instant::now();
    desk.dejag(line);
    let whole = start.elapsed();
    let mut hits = 0;
    for k in 0..25 {
        between();
        let results = desk.path("dejag-check/check.json");
        if let Ok(bytes) = fs::read(results) {
            serde_json::from_slice::<serde_json::Value>(&bytes).expect("results are whole or not there");
        }
        let mut command = desk.command();
        command.args(line.split_whitespace()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().expect("it runs");
        sleep(whole.mul_f64(f64::from(k) / 25.0).min(Duration::from_secs(2)));
        child.kill().expect("killed");
        hits += usize::from(child.wait().expect("ended").code().is_none());
    }
    hits
}

#[test]
fn a_killed_check_leaves_goldens_alone_and_a_rerun_succeeds() {
    let desk = desk();
    let before = goldens(&desk);
    let hits = killed(&desk, "check", || ());
    assert!(hits >= 10, "only {hits} of 25 were killed in time");
    assert_eq!(goldens(&desk), before);
    let (code, results) = json(&desk, "");
    assert_eq!((code, results["counts"]["different"].as_u64()), (1, Some(PICTURES as u64)));
    assert!(!desk.names().iter().any(|name| name.contains("dejag-check/dejag-check")));
}

#[test]
fn a_killed_bless_leaves_every_golden_old_or_new() {
    let desk = desk();
    let old = goldens(&desk);
    let restore = || old.iter().for_each(|(path, bytes)| fs::write(path, bytes).expect("written"));
    desk.dejag("check").ended(1, &[]);
    let hits = killed(&desk, "bless", || {
        for (path, bytes) in goldens(&desk) {
            assert!(load(&path).is_ok(), "{} is damaged", path.display());
            let candidate = desk.path("dejag-check/candidates/shots").join(path.file_name().expect("a name"));
            assert!(bytes == old[&path] || bytes == fs::read(candidate).expect("there"), "{} is neither", path.display());
        }
        restore();
    });
    assert!(hits >= 10, "only {hits} of 25 were killed in time");
    restore();
    desk.dejag("bless").ended(0, &[]);
    desk.dejag("check").ended(0, &["24 same"]);
}

#[test]
fn two_runs_at_once_do_each_other_no_harm() {
    let desk = desk();
    let alone = without_times(json(&desk, "").1);
    let running: Vec<_> = (0..2)
        .map(|_| {
            desk.command().args(["check", "--json", "-"]).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it runs")
        })
        .collect();
    for child in running {
        let output = child.wait_with_output().expect("it ends");
        let results = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(without_times(results), alone);
    }
}
