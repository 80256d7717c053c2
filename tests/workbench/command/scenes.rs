//! Scenes that are none.

use std::time::Duration;

use super::desk::Desk;

const CAMERA: &str = "projection = 'perspective'\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nfov_y_deg = 60";
const OBJECT: &str = "shape = { quad = { size = [2, 2] } }";

/// A scene of one quad, with more lines at its top, in its camera and in its object. A line there may replace one of ours.
fn scene(top: &str, camera: &str, object: &str) -> String {
    let with = |ours: &str, theirs: &str| {
        let key = |line: &str| line.split('=').next().map(str::trim).map(str::to_owned);
        let kept = ours.lines().filter(|line| key(line) != key(theirs));
        kept.chain(theirs.lines()).collect::<Vec<_>>().join("\n")
    };
    format!("about = 'a quad'\n{top}\n[camera]\n{}\n[[objects]]\n{}\n", with(CAMERA, camera), with(OBJECT, object))
}

const CAPTURE: &str = "--size 32x18 -o out.png";

#[test]
fn the_scene_that_these_tests_spoil_is_a_good_one() {
    let desk = Desk::new();
    desk.write("s.toml", scene("", "", ""));
    desk.run(&format!("capture s.toml {CAPTURE}")).succeeded();
    assert_eq!(desk.names(), ["out.png", "s.toml"]);
}

#[test]
fn a_file_that_is_absent_or_no_text_is_3() {
    let desk = Desk::new();
    desk.write("empty.toml", "");
    desk.write("blank.toml", " \n\n");
    desk.write("binary.toml", (0..=255).collect::<Vec<u8>>());
    desk.write("nul.toml", "name = 'a'\0\n");
    desk.make_folder("folder.toml");
    let expectations: [(&str, &[&str]); 7] = [
        ("missing.toml", &["could not read missing.toml", "check the path"]),
        ("no/such/folder.toml", &["could not read no/such/folder.toml", "check the path"]),
        ("empty.toml", &["empty.toml", "is empty", "expected TOML"]),
        ("blank.toml", &["blank.toml", "is empty", "expected TOML"]),
        ("binary.toml", &["binary.toml", "not UTF-8", "expected TOML"]),
        ("nul.toml", &["nul.toml", "NUL", "expected TOML"]),
        ("folder.toml", &["folder.toml", "is a folder", "expected a file"]),
    ];
    for (name, words) in expectations {
        desk.refuses(&format!("capture {name} {CAPTURE}"), 3, words);
        desk.refuses(&format!("score {name} -m none --json out.json --report report"), 3, words);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_refused_and_not_waited_for() {
    let desk = Desk::new();
    let made = std::process::Command::new("mkfifo").arg(desk.path("pipe.toml")).status();
    assert!(made.expect("mkfifo runs").success());
    let mut running = desk.start(desk.command(&format!("capture pipe.toml {CAPTURE}")));
    let since = std::time::Instant::now();
    running.until("it refused the pipe", |running| {
        assert!(since.elapsed() < Duration::from_secs(5), "it waits for somebody to write into the pipe");
        !running.stderr().is_empty()
    });
    running.end().failed(3, &["pipe.toml", "not a regular file"]);
}

#[test]
fn a_scene_that_breaks_off_is_2_with_its_place() {
    let desk = Desk::new();
    let whole = include_str!("../../../scenes/courtyard.toml");
    // In the middle of an array, of an inline table, of a string and of a key.
    for end in ["position = [", "material = { ", "name = \"", "[[obj"] {
        let at = whole.find(end).unwrap_or_else(|| panic!("'{end}' is in the scene")) + end.len();
        desk.write("cut.toml", &whole[..at]);
        let line = whole[..at].lines().count();
        desk.refuses(&format!("capture cut.toml {CAPTURE}"), 2, &[&format!("cut.toml:{line}:"), "expected"]);
    }
}

#[test]
fn what_a_scene_lacks_or_has_too_much_is_2() {
    let desk = Desk::new();
    let expectations: [(String, &[&str]); 6] = [
        ("name = 'a'\n".into(), &["camera"]),
        (scene("framse = 3", "", ""), &["s.toml:2:", "framse", "frames"]),
        (scene("", "projection = 'fisheye'", ""), &["fisheye", "perspective"]),
        (scene("", "", "shape = { blob = 1 }"), &["blob", "quad"]),
        (scene("", "", "material = 'no-such'"), &["no-such"]),
        (scene("", "", "position = [1, 2]"), &["expected an array of 3 numbers"]),
    ];
    for (text, words) in expectations {
        desk.write("s.toml", &text);
        desk.refuses(&format!("capture s.toml {CAPTURE}"), 2, words);
    }
}

#[test]
fn numbers_that_make_no_sense_are_2_with_their_place_and_range() {
    let desk = Desk::new();
    let mut texts = Vec::new();
    for bad in ["nan", "inf", "-inf", "0", "-5", "180", "1e300"] {
        texts.push(scene("", &format!("fov_y_deg = {bad}"), ""));
    }
    for bad in ["nan", "inf", "0", "-1"] {
        texts.push(scene("", &format!("near = {bad}"), ""));
        texts.push(scene(&format!("time_step = {bad}"), "", ""));
        texts.push(scene("", "", &format!("shape = {{ quad = {{ size = [2, {bad}] }} }}")));
    }
    for bad in ["nan", "inf", "-inf", "1e300"] {
        texts.push(scene("", &format!("position = [{bad}, 0, 0]"), ""));
        texts.push(scene("", &format!("up = [0, {bad}, 0]"), ""));
        texts.push(scene("", "", &format!("position = [0, {bad}, 0]")));
        texts.push(scene("", "", &format!("rotation_deg = [0, 0, {bad}]")));
        texts.push(scene("", "", &format!("scale = {bad}")));
        texts.push(scene("", "", &format!("motion = {{ velocity = [{bad}, 0, 0] }}")));
        texts.push(scene(&format!("exposure_ev = {bad}"), "", ""));
        texts.push(scene(&format!("background = [0, 0, {bad}]"), "", ""));
    }
    texts.extend(["0", "-1", "1e3", "99999999999"].map(|bad| scene(&format!("frames = {bad}"), "", "")));
    texts.extend(["0", "[1, 0, 1]"].map(|bad| scene("", "", &format!("scale = {bad}"))));
    texts.push(scene("", "target = [0, 0, 5]", ""));
    texts.push(scene("", "up = [0, 0, 0]", ""));
    texts.push(scene("", "", "repeat = [{ count = 4000000000 }]"));
    texts.push(scene("", "", "repeat = [{ count = 60000 }, { count = 60000 }]"));
    for text in texts {
        desk.write("s.toml", &text);
        let before = desk.names();
        let ran = desk.run(&format!("capture s.toml {CAPTURE}"));
        let context = format!("{text}\n{ran}");
        assert_eq!((ran.code, desk.names()), (Some(2), before), "{context}");
        assert!(ran.stderr.starts_with("error: s.toml:"), "{context}");
        assert!(ran.stderr.contains("expected"), "{context}");
        assert!(ran.took < Duration::from_secs(5), "{context}");
    }
}

#[test]
fn a_model_that_a_scene_names_is_looked_for_beside_it() {
    let desk = Desk::new();
    desk.write("s.toml", scene("", "", "shape = { gltf = { path = 'no-such.gltf' } }"));
    desk.refuses(&format!("capture s.toml {CAPTURE}"), 3, &["no-such.gltf", "check the path"]);
}
