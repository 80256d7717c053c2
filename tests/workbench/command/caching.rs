//! The cache of references: believed only if whole, and never worth a run.

use std::fs;

use super::desk::{Desk, Ran, SMALL};

const NOT_KEPT: &str = "warning: references are not kept";

fn score(desk: &Desk) -> Ran {
    let ran = desk.run(&format!("score edges -m none {SMALL} --json -"));
    ran.succeeded();
    ran
}

fn cached(ran: &Ran) -> bool {
    ran.json()["scenes"][0]["reference"]["timing"]["cached"].as_bool().expect("a truth value")
}

fn scores(ran: &Ran) -> serde_json::Value {
    ran.json()["scenes"][0]["methods"][0]["scores"].clone()
}

#[test]
fn a_reference_is_kept_listed_and_cleared() {
    let desk = Desk::new();
    let listed = desk.run("cache");
    assert!(listed.succeeded().stdout.contains(": 0 references"), "{listed}");
    assert!(!cached(&score(&desk)));
    assert!(cached(&score(&desk)));
    let listed = desk.run("cache");
    assert!(listed.succeeded().stdout.contains(": 1 references"), "{listed}");
    assert!(listed.stdout.contains(&*desk.cache().to_string_lossy()), "{listed}");
    let cleared = desk.run("cache --clear");
    assert!(cleared.succeeded().stdout.contains("removed 1 references"), "{cleared}");
    assert!(desk.references().is_empty());
    assert!(!cached(&score(&desk)));
}

#[test]
fn another_size_sample_count_or_scene_is_another_reference() {
    let desk = Desk::new();
    score(&desk);
    for other in [
        "edges --size 33x18 --reference ssaa:spp=16",
        "edges --size 32x18 --reference ssaa:spp=17",
        "far --size 32x18 --reference ssaa:spp=16",
    ] {
        let ran = desk.run(&format!("score {other} -m none --repeats 1 --json -"));
        assert!(!cached(ran.succeeded()), "{ran}");
    }
    assert_eq!(desk.references().len(), 4);
}

#[test]
fn a_damaged_reference_is_drawn_again() {
    let desk = Desk::new();
    let first = score(&desk);
    let path = desk.references().pop().expect("a reference");
    let whole = fs::read(&path).expect("readable");
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    for damaged in [&whole[..0], &whole[..40], &whole[..whole.len() / 2], &whole[..whole.len() - 1], &flipped] {
        fs::write(&path, damaged).expect("writable");
        let again = score(&desk);
        assert!(!cached(&again), "{} bytes were believed", damaged.len());
        assert_eq!(scores(&again), scores(&first));
        assert_eq!(fs::read(&path).expect("readable"), whole);
    }
}

#[test]
fn without_a_cache_nothing_is_kept_nor_believed() {
    let desk = Desk::new();
    let arguments = format!("score edges -m none {SMALL} --json - --no-cache");
    assert!(!cached(desk.run(&arguments).succeeded()));
    assert!(!desk.cache().exists());
    score(&desk);
    assert!(!cached(desk.run(&arguments).succeeded()));
}

#[test]
fn a_cache_that_cannot_be_written_costs_a_warning_and_not_the_run() {
    let desk = Desk::new();
    desk.write("file", "a file");
    let places = [desk.path("file"), desk.path("file/below")];
    #[cfg(target_os = "linux")]
    let places = places.into_iter().chain(["/proc/no-such".into()]);
    for place in places {
        let run = |arguments: &str| {
            let mut command = desk.command(arguments);
            command.env("DEJAG_CACHE_DIR", &place);
            desk.run_command(command)
        };
        let arguments = format!("score edges far -m none {SMALL} --json -");
        let ran = run(&arguments);
        assert_eq!(ran.succeeded().json()["scenes"].as_array().map(Vec::len), Some(2), "{ran}");
        assert_eq!(ran.stderr.matches(NOT_KEPT).count(), 1, "once, not for each scene: {ran}");
        assert!(ran.stderr.contains(&*place.to_string_lossy()) && ran.stderr.contains("DEJAG_CACHE_DIR"), "{ran}");
        assert_eq!(run(&format!("{arguments} -q")).succeeded().stderr, "");
        assert_eq!(run(&format!("{arguments} --no-cache")).succeeded().stderr, "");
    }
    assert_eq!(desk.read("file"), b"a file");
}

#[test]
fn a_cache_folder_that_is_a_file_is_3_to_whoever_asks_for_it() {
    let desk = Desk::new();
    desk.write("file", "a file");
    for arguments in ["cache", "cache --clear"] {
        let mut command = desk.command(arguments);
        command.env("DEJAG_CACHE_DIR", desk.path("file"));
        desk.refuses_command(command, 3, &["could not read the cache", "file", "check the path"]);
    }
}

#[test]
fn clearing_leaves_what_is_not_the_caches() {
    let desk = Desk::new();
    score(&desk);
    let (leftover, foreign) = (desk.cache().join(".0a.reference.Xy12.part"), desk.cache().join("notes.txt"));
    fs::write(&leftover, "half").expect("writable");
    fs::write(&foreign, "mine").expect("writable");
    desk.run("cache --clear").succeeded();
    assert!(desk.references().is_empty() && !leftover.exists() && foreign.exists());
}
