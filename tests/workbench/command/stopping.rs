//! Being stopped in the middle: Ctrl-C, a polite end, and a kill.
#![cfg(unix)]

use std::fs;
use std::thread::sleep;
use std::time::Duration;

use super::desk::{Desk, Ran, Running, SMALL};
use crate::common;

/// How long somebody who pressed Ctrl-C should wait at most.
const PROMPT: Duration = Duration::from_secs(3);

fn long_score(desk: &Desk) -> Running {
    let score = "score edges -m none -m ssaa:spp=4096 --reference ssaa:spp=4096 --repeats 1000 --size 640x360";
    let mut running = desk.start(desk.command(&format!("{score} -v --report new/report --json out.json")));
    running.until("it began", |running| running.stderr().contains("cache: "));
    running
}

fn long_capture(desk: &Desk) -> Running {
    let size = if common::gpu().is_software() { "640x360" } else { "7680x4320" };
    let mut running = desk.start(desk.command(&format!("capture edges -m ssaa:spp=4096 -v --size {size} -o out.png")));
    running.until("it began", |running| running.stderr().contains("adapter: "));
    running
}

fn report_in_the_making(desk: &Desk) -> bool {
    desk.names().iter().any(|name| name.contains("dejag-report"))
}

/// Is stopped by these signals, promptly, with the folder as it was before.
fn stopped(desk: &Desk, mut running: Running, signals: &[&str], before: &[&str]) -> Ran {
    // Into the drawing, not only into the set-up.
    sleep(Duration::from_millis(400));
    for signal in signals {
        running.signal(signal);
    }
    let ran = running.end();
    ran.failed(130, &["interrupted", "nothing was left half-written"]);
    assert_eq!(ran.stdout, "", "{ran}");
    assert!(ran.took < PROMPT, "{ran}");
    assert_eq!(desk.names(), before, "something was left behind by {ran}");
    ran
}

/// What is done next works, and so does the cache.
fn all_is_well(desk: &Desk) {
    let before = desk.references().len();
    let run = || desk.run(&format!("score edges -m none {SMALL} --json - --report report"));
    let cached = |ran: &Ran| ran.succeeded().json()["scenes"][0]["reference"]["timing"]["cached"].clone();
    assert_eq!((cached(&run()), cached(&run())), (false.into(), true.into()));
    assert_eq!(desk.references().len(), before + 1);
    assert!(desk.path("report/index.html").is_file());
    assert!(desk.path("report/pictures/01-edges-01-none.png").is_file());
}

#[test]
fn ctrl_c_in_a_score() {
    let desk = Desk::new();
    let running = long_score(&desk);
    assert!(report_in_the_making(&desk));
    stopped(&desk, running, &["INT"], &[]);
    all_is_well(&desk);
}

#[test]
fn a_polite_end_of_a_score() {
    let desk = Desk::new();
    stopped(&desk, long_score(&desk), &["TERM"], &[]);
    all_is_well(&desk);
}

#[test]
fn ctrl_c_in_a_sequence() {
    let desk = Desk::new();
    let sequence = "sequence pan -m none -m ssaa:spp=1024 --reference ssaa:spp=4 --probe none --size 320x180";
    let mut running = desk.start(desk.command(&format!("{sequence} --out frames --apng all.png --json out.json -v")));
    running.until("it began", |running| running.stderr().contains("cache: "));
    stopped(&desk, running, &["INT"], &[]);
}

#[test]
fn ctrl_c_in_a_capture() {
    let desk = Desk::new();
    stopped(&desk, long_capture(&desk), &["INT"], &[]);
}

#[test]
fn a_polite_end_of_a_capture() {
    let desk = Desk::new();
    stopped(&desk, long_capture(&desk), &["TERM"], &[]);
}

#[test]
fn a_nervous_finger_on_ctrl_c_leaves_nothing_either() {
    let desk = Desk::new();
    stopped(&desk, long_score(&desk), &["INT"; 3], &[]);
}

#[test]
fn an_older_output_survives_ctrl_c() {
    let desk = Desk::new();
    desk.write("out.png", "the old picture");
    stopped(&desk, long_capture(&desk), &["INT"], &["out.png"]);
    assert_eq!(desk.read("out.png"), b"the old picture");
}

#[test]
fn a_score_goes_on_where_it_was_stopped() {
    let desk = Desk::new();
    let options = "--reference ssaa:spp=1024 --size 320x180";
    let score = format!("score edges -m none -m ssaa:spp=4096 --repeats 1000 {options}");
    let mut running = desk.start(desk.command(&score));
    running.until("the first reference was kept", |_| !desk.references().is_empty());
    stopped(&desk, running, &["INT"], &[]);
    let again = desk.run(&format!("score edges -m none --repeats 1 --json - {options}"));
    assert_eq!(again.succeeded().json()["scenes"][0]["reference"]["timing"]["cached"], true, "{again}");
}

#[test]
fn after_a_kill_the_next_run_works() {
    let desk = Desk::new();
    let mut running = long_score(&desk);
    running.until("the report was begun", |_| report_in_the_making(&desk));
    running.signal("KILL");
    assert_eq!(running.end().code, None);
    assert!(!desk.path("new").exists() && !desk.path("out.json").exists(), "half a report: {:?}", desk.names());
    // What a kill in the middle of writing a reference leaves is no reference.
    fs::create_dir_all(desk.cache()).expect("a new folder");
    fs::write(desk.cache().join(".0123.reference.aBcDeF.part"), "dejag reference 1\n{").expect("writable");
    all_is_well(&desk);
}

/// Half of them while entries are written, half while they are read.
#[test]
fn killed_at_fifty_moments_the_cache_is_whole_and_a_rerun_succeeds() {
    let desk = Desk::new();
    let line = format!("score edges wires checker text -m none {SMALL} --json out.json --report report");
    let whole = [(); 2].map(|()| desk.run(&line).succeeded().took);
    let mut hits = 0;
    for k in 0..50 {
        if k % 2 == 0 {
            desk.references().iter().for_each(|path| fs::remove_file(path).expect("removed"));
        }
        let mut running = desk.start(desk.command(&line));
        sleep(whole[k as usize % 2].mul_f64(f64::from(k) / 50.0));
        running.kill();
        hits += usize::from(running.end().code.is_none());
        for path in desk.references() {
            let bytes = fs::read(&path).expect("there");
            let (content, hash) = bytes.split_at(bytes.len().saturating_sub(32));
            assert_eq!(blake3::hash(content).as_bytes(), hash, "{} is not whole after kill {k}", path.display());
        }
        let results: serde_json::Value = serde_json::from_slice(&desk.read("out.json")).expect("whole JSON");
        assert_eq!(results["scenes"].as_array().map(Vec::len), Some(4), "after kill {k}");
        assert!(desk.path("report/index.html").is_file() || !desk.path("report").exists(), "half a report after kill {k}");
    }
    assert!(hits >= 20, "only {hits} of 50 were killed in time");
    desk.run(&line).succeeded();
}
