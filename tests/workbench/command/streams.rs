//! Data on stdout, words on stderr, and neither where nobody wants them.

use std::process::Stdio;

use serde_json::Value;

use super::desk::{Desk, SMALL};

const CAPTURE: &str = "capture edges --size 32x18 -o out.png";
const ESCAPE: char = '\u{1b}';

#[test]
fn a_quiet_capture_says_nothing_even_without_a_display() {
    let desk = Desk::new();
    let mut command = desk.command(&format!("{CAPTURE} -q"));
    for display in ["XDG_RUNTIME_DIR", "DISPLAY", "WAYLAND_DISPLAY", "NODEVICE_SELECT"] {
        command.env_remove(display);
    }
    let ran = desk.run_command(command);
    assert_eq!((ran.succeeded().stdout.as_str(), ran.stderr.as_str()), ("", ""), "{ran}");
}

#[test]
fn a_capture_says_in_a_line_what_it_wrote() {
    let desk = Desk::new();
    let ran = desk.run(CAPTURE);
    assert_eq!(ran.succeeded().stdout, "");
    assert_eq!(ran.stderr, "out.png: colour of edges with none, frame 0, 32x18\n");
    let ran = desk.run(&format!("{CAPTURE} -v"));
    assert!(ran.succeeded().stderr.starts_with("adapter: "), "{ran}");
}

#[test]
fn a_piped_score_has_no_colours_and_keeps_words_apart_from_data() {
    let desk = Desk::new();
    for no_color in [None, Some("1")] {
        let mut command = desk.command(&format!("score edges -m none -m msaa {SMALL} --report report"));
        if let Some(value) = no_color {
            command.env("NO_COLOR", value);
        }
        let ran = desk.run_command(command);
        assert!(!ran.succeeded().stdout.contains(ESCAPE) && !ran.stderr.contains(ESCAPE), "{ran}");
        assert!(ran.stdout.contains("PSNR") && ran.stdout.lines().all(|line| line.chars().count() <= 100), "{ran}");
        assert!(ran.stderr.starts_with("report: ") && ran.stderr.ends_with("index.html\n"), "{ran}");
        assert_eq!(ran.stderr.lines().count(), 1, "{ran}");
    }
    let quiet = desk.run(&format!("score edges -m none {SMALL} --report report -q"));
    assert!(quiet.succeeded().stderr.is_empty() && quiet.stdout.contains("PSNR"), "{quiet}");
}

/// Every key of this object is among those, and the other way round.
fn has_keys(value: &Value, keys: &[&str]) {
    let mut found: Vec<&str> = value.as_object().expect("an object").keys().map(String::as_str).collect();
    let mut keys = keys.to_vec();
    found.sort_unstable();
    keys.sort_unstable();
    assert_eq!(found, keys, "in {value}");
}

#[test]
fn json_on_stdout_is_only_json_with_the_documented_keys() {
    let desk = Desk::new();
    let ran = desk.run(&format!("score edges fence -m none -m msaa:resolve=mitchell {SMALL} --json -"));
    assert_eq!(ran.succeeded().stderr, "");
    let json = ran.json();
    has_keys(&json, &["schema_version", "stamp", "command", "size", "scenes"]);
    has_keys(&json["stamp"], &["dejag", "adapter", "kind", "driver", "driver_version", "backend"]);
    assert_eq!(json["stamp"]["dejag"], env!("CARGO_PKG_VERSION"));
    let [edges, fence] = &json["scenes"].as_array().expect("scenes")[..] else { panic!("two scenes: {ran}") };
    has_keys(edges, &["name", "about", "frame", "reference", "methods", "timing"]);
    has_keys(&edges["reference"], &["spec", "noise_floor", "analytic", "timing"]);
    has_keys(&fence["reference"], &["spec", "noise_floor", "timing"]);
    has_keys(&edges["reference"]["timing"], &["seconds", "cached"]);
    for method in edges["methods"].as_array().expect("methods") {
        has_keys(method, &["spec", "status", "samples_per_pixel", "target_bytes", "scores", "timing"]);
        has_keys(&method["timing"], &["draw_ms", "passes", "total_ms", "clock", "unbeaten"]);
        has_keys(&method["timing"]["draw_ms"], &["median", "min", "max", "repeats"]);
        has_keys(&method["scores"][0], &["metric", "value"]);
    }
    has_keys(&edges["methods"][1]["timing"]["passes"][0], &["pass", "runs", "ms"]);

    desk.run(&format!("score edges fence -m none -m msaa:resolve=mitchell {SMALL} --json out.json")).succeeded();
    let file: Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    assert_eq!(file["command"], json["command"], "a file holds what stdout shows");
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_gone_is_no_error() {
    let desk = Desk::new();
    for arguments in ["list methods", "list scenes --json", "completions bash", "man", "--help", "doctor"] {
        let mut command = desk.command(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!((output.status.code(), &*stderr), (Some(0), ""), "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn words_that_nobody_reads_stop_nothing() {
    let desk = Desk::new();
    let run = |arguments: &str| {
        let mut command = desk.command(arguments);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
        drop(child.stderr.take());
        child.wait().expect("it ends").code()
    };
    assert_eq!(run(&format!("{CAPTURE} -v")), Some(0));
    assert_eq!(run(&format!("score edges -m none -v {SMALL}")), Some(0));
    assert_eq!(run("capture no-such-scene -o out.png"), Some(2));
    assert_eq!(desk.names(), ["out.png"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_stdout_is_3_and_says_so() {
    let desk = Desk::new();
    let mut command = desk.command("list methods");
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("the full device");
    let output = command.stdout(full).stderr(Stdio::piped()).output().expect("it runs");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{stderr}");
    assert!(stderr.starts_with("error: could not write to standard output: No space left"), "{stderr}");
}

#[test]
fn what_a_model_lacks_is_said_unless_quiet() {
    let desk = Desk::new();
    let model = serde_json::json!({
        "asset": { "version": "2.0" }, "extensionsUsed": ["KHR_materials_sheen"],
        "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "buffers": [{ "byteLength": 36, "uri": "data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f\
            %00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "accessors": [{
            "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]
        }],
    });
    desk.write("m.gltf", model.to_string());
    let ran = desk.run("capture m.gltf --size 32x18 -o out.png");
    assert!(ran.succeeded().stderr.contains("warning: m.gltf: ") && ran.stderr.contains("KHR_materials_sheen"), "{ran}");
    assert_eq!(desk.run("capture m.gltf --size 32x18 -o out.png -q").succeeded().stderr, "");
}
