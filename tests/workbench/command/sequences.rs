//! `dejag sequence` as a user runs it.

use std::fs::File;
use std::io::BufReader;

use serde_json::Value;

use super::desk::{Desk, Ran};

const SMALL: &str = "--size 32x18 --frames 0..4 --reference ssaa:spp=4 --probe none";

/// Without what depends on the clock.
fn timeless(mut value: Value) -> Value {
    fn strip(value: &mut Value) {
        match value {
            Value::Object(map) => {
                map.remove("timing");
                map.values_mut().for_each(strip);
            }
            Value::Array(list) => list.iter_mut().for_each(strip),
            _ => {}
        }
    }
    strip(&mut value);
    value
}

fn results(ran: &Ran) -> Value {
    timeless(ran.succeeded().json())
}

#[test]
fn the_command_that_results_name_makes_them_again() {
    let desk = Desk::new();
    let options = "--cut 2 --drop 1 --step 0.01 --pan 0.37,-1 --shutter 0.5 --probe crawl,response";
    let first =
        results(&desk.run(&format!("sequence pan -m none -m fxaa {} {options} --json -", SMALL.replace("--probe none", ""))));
    let words: Vec<&str> = first["command"].as_array().expect("words").iter().filter_map(Value::as_str).collect();
    assert_eq!(first, results(&desk.run(&format!("{} --json -", words.join(" ")))));
    assert_eq!(first["frames"].as_array().map(Vec::len), Some(3));
    assert_eq!(first["reference"]["spec"], "ssaa:spp=4,shutter=0.5");
    let method = &first["methods"][0];
    assert_eq!(method["status"], "measured");
    assert!(method["probes"]["crawl"].is_object() && method["probes"]["sharpness"].is_null(), "{method}");
}

#[test]
fn a_warm_cache_changes_nothing() {
    let desk = Desk::new();
    let run = |options: &str| results(&desk.run(&format!("sequence wheel -m smaa {SMALL} --json - {options}")));
    let cold = run("");
    assert_eq!(desk.references().len(), 4);
    assert_eq!(cold, run(""));
    assert_eq!(cold, run("--no-cache"));
}

#[test]
fn a_still_scene_needs_one_reference() {
    let desk = Desk::new();
    desk.run(&format!("sequence wheel --hold 3 -m none {SMALL}")).succeeded();
    assert_eq!(desk.references().len(), 1);
}

#[test]
fn a_missed_bar_is_exit_code_1_and_says_by_how_much() {
    let desk = Desk::new();
    let met = desk.run(&format!("sequence pan -m none {SMALL} --min-psnr 5 --max-energy-error 0.5"));
    assert!(!met.succeeded().stderr.contains("missed"), "{met}");
    let missed = desk.run(&format!("sequence pan -m none -m fxaa {SMALL} --min-psnr 80 --max-flip 0.5"));
    assert_eq!(missed.code, Some(1), "{missed}");
    for method in ["none", "fxaa"] {
        assert!(missed.stderr.contains(&format!("missed: {method}: --min-psnr 80 is missed: ")), "{missed}");
    }
    assert!(!missed.stderr.contains("max-flip") && missed.stdout.contains("PSNR"), "{missed}");
    let unmeasured = desk.run(&format!("sequence pan -m none {SMALL} --max-crawl 0.1"));
    assert_eq!(unmeasured.code, Some(1), "{unmeasured}");
    assert!(unmeasured.stderr.contains("nothing to measure"), "{unmeasured}");
}

#[test]
fn a_scene_file_sets_bars_and_the_command_line_overrides_them() {
    let desk = Desk::new();
    let scene = |bars: &str| {
        format!(
            "[camera]\nprojection = 'orthographic'\nheight = 2\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\n\
             [[objects]]\nshape = {{ quad = {{ size = [1, 1] }} }}\nmaterial = {{ unlit = true }}\n{bars}"
        )
    };
    desk.write("strict.toml", scene("[thresholds]\nmin_psnr = 150\n"));
    let run = |options: &str| desk.run(&format!("sequence strict.toml -m none {SMALL} --pan 0.3 {options}"));
    assert_eq!(run("").code, Some(1));
    assert!(run("").stderr.contains("--min-psnr 150 is missed"));
    run("--min-psnr 3").succeeded();
    run("--no-thresholds").succeeded();
    desk.write("wrong.toml", scene("[thresholds]\nmin_psmr = 1\n"));
    desk.refuses(&format!("sequence wrong.toml -m none {SMALL}"), 2, &["wrong.toml:10:1", "min_psmr", "min_psnr"]);
    desk.write("wrong.toml", scene("[thresholds]\nmin_continuity = 2\n"));
    desk.refuses(&format!("sequence wrong.toml -m none {SMALL}"), 2, &["wrong.toml:10:18", "0 to 1"]);
}

#[test]
fn frames_are_written_together() {
    let desk = Desk::new();
    desk.run(&format!("sequence pan -m none -m smaa:threshold=0.2 {SMALL} --out new/frames --apng all.png")).succeeded();
    for folder in ["none", "smaa-threshold-0-2", "reference"] {
        for frame in 0..4 {
            let name = format!("new/frames/{folder}/{frame:05}.png");
            let size = dejag::picture::measure(&desk.path(&name)).expect("a picture");
            assert_eq!(size, [32, 18], "{name}");
        }
    }
    let reader = png::Decoder::new(BufReader::new(File::open(desk.path("all.png")).expect("there"))).read_info().expect("a PNG");
    let info = reader.info();
    assert_eq!(info.animation_control().expect("animated").num_frames, 4);
    assert_eq!((info.width, info.height), (3 * 32 + 2 * 4, 18));
    desk.run(&format!("sequence pan -m none {SMALL} --out new/frames --format exr")).succeeded();
    assert!(desk.path("new/frames/reference/00003.exr").is_file());
    assert!(!desk.path("new/frames/reference/00003.png").exists(), "the older frames are replaced whole");
}

#[test]
fn what_cannot_be_written_is_refused_before_anything_is_drawn() {
    let desk = Desk::new();
    desk.make_folder("mine");
    desk.write("mine/thesis.tex", "years of work");
    desk.refuses(&format!("sequence pan -m none {SMALL} --out mine"), 2, &["mine", "name a new or empty folder"]);
    desk.refuses(&format!("sequence pan -m none {SMALL} --apng a.exr"), 2, &["a.exr", ".png"]);
    desk.refuses(&format!("sequence pan -m none {SMALL} --apng absent/a.png"), 3, &["absent", "check the path"]);
    desk.refuses(&format!("sequence pan -m none {SMALL} --json absent/a.json"), 3, &["absent"]);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let desk = Desk::new();
    for (options, words) in [
        ("--frames 4..4", &["choose 1 to"][..]),
        ("--frames 4", &["write A..B"]),
        ("--frames 0..4 --cut 9", &["frame 9", "frames 0 to 3"]),
        ("--frames 0..2 --drop 0 --drop 1", &["at least one"]),
        ("--step -1", &["-1"]),
        ("--pan x", &["write X or X,Y"]),
        ("--shutter 2", &["--reference", "shutter"]),
        ("--reference smaa --shutter 0.5", &["--reference", "shutter"]),
        ("--probe crawl,crwl", &["did you mean 'crawl'"]),
        ("--min-psnr nan", &["no bar"]),
        ("-m none", &["given twice"]),
    ] {
        let ran = desk.run(&format!("sequence pan -m none {options}"));
        assert_eq!(ran.code, Some(2), "{ran}");
        for word in words {
            assert!(ran.stderr.contains(word), "'{word}' is not said by {ran}");
        }
    }
}
