//! Outputs: whole or not at all, and never over what is not ours.

use super::desk::{Desk, SMALL};

const CAPTURE: &str = "capture edges --size 32x18 -o";
const SCORE: &str = "score edges -m none --size 32x18 --reference ssaa:spp=16 --repeats 1";

#[test]
fn a_name_that_is_no_picture_file_is_2() {
    let desk = Desk::new();
    desk.make_folder("folder");
    desk.make_folder("folder.png");
    let formats = [".png (display values)", ".exr (linear values)"];
    desk.refuses(&format!("{CAPTURE} out.jpg"), 2, &["ends in .jpg", formats[0], formats[1]]);
    for name in ["out", ".png", "folder", "-", "out."] {
        desk.refuses(&format!("{CAPTURE} {name}"), 2, &[name, formats[0], formats[1]]);
    }
    desk.refuses(&format!("{CAPTURE} folder.png"), 2, &["folder.png is a folder", "name a file in it"]);
    desk.refuses(&format!("{SCORE} --json folder"), 2, &["folder is a folder", "name a file in it"]);
}

/// Folders that nobody can write into, not even an administrator.
#[cfg(target_os = "linux")]
const UNWRITABLE: [&str; 2] = ["file", "/proc"];
#[cfg(not(target_os = "linux"))]
const UNWRITABLE: [&str; 1] = ["file"];

#[test]
fn a_place_that_cannot_be_written_is_3_before_anything_is_drawn() {
    let desk = Desk::new();
    desk.write("file", "a file");
    for folder in UNWRITABLE {
        let words = ["could not", folder, "check the path"];
        desk.refuses(&format!("{CAPTURE} {folder}/out.png"), 3, &words);
        desk.refuses(&format!("{SCORE} --json {folder}/out.json"), 3, &words);
        desk.refuses(&format!("{SCORE} --report {folder}/report"), 3, &words);
        desk.refuses(&format!("{SCORE} --report {folder}/deeper/report"), 3, &words);
    }
    desk.refuses(&format!("{CAPTURE} no/such/out.png"), 3, &["could not write into no/such", "check the path"]);
    desk.refuses(&format!("{SCORE} --json no/such/out.json"), 3, &["could not write into no/such", "check the path"]);
    assert!(desk.references().is_empty(), "something was drawn first");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_3_and_says_so() {
    let desk = Desk::new();
    std::os::unix::fs::symlink("/dev/full", desk.path("out.png")).expect("a link");
    std::os::unix::fs::symlink("/dev/full", desk.path("out.json")).expect("a link");
    desk.refuses(&format!("{CAPTURE} out.png"), 3, &["could not write out.png", "No space left", "free some space"]);
    desk.refuses(&format!("{SCORE} --json out.json"), 3, &["could not write out.json", "No space left", "free some space"]);
}

/// Files stop growing at a few kilobytes, as they do on a disk that fills up in the middle of one.
#[cfg(target_os = "linux")]
const DISK_FILLS_UP: &str = "trap '' XFSZ && ulimit -f 8";

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_in_the_middle_leaves_the_old_file_and_nothing_else() {
    let desk = Desk::new();
    desk.write("out.png", "the old picture");
    desk.write("out.exr", "the old picture");
    for name in ["out.png", "out.exr"] {
        let capture = format!("capture courtyard --size 320x180 -o {name}");
        desk.refuses_command(desk.limited(DISK_FILLS_UP, &capture), 3, &["could not write", name, "free some space"]);
        assert_eq!(desk.read(name), b"the old picture");
    }
    let score = "score courtyard -m none --size 320x180 --reference ssaa:spp=2 --repeats 1 -q --no-cache --report new/report";
    desk.refuses_command(desk.limited(DISK_FILLS_UP, score), 3, &["could not write", "free some space"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_cache_on_a_full_disk_costs_a_warning_and_not_the_run() {
    let desk = Desk::new();
    let score = "score courtyard -m none --size 320x180 --reference ssaa:spp=2 --repeats 1";
    let ran = desk.run_command(desk.limited(DISK_FILLS_UP, score));
    ran.succeeded();
    assert!(ran.stderr.contains("warning: references are not kept") && ran.stderr.contains("free some space"), "{ran}");
    assert_eq!(std::fs::read_dir(desk.cache()).expect("the cache").count(), 0, "{ran}");
}

#[test]
fn an_output_that_is_there_is_replaced() {
    let desk = Desk::new();
    for name in ["out.png", "out.exr", "out.json"] {
        desk.write(name, vec![b'x'; 1 << 20]);
    }
    desk.run(&format!("{CAPTURE} out.png")).succeeded();
    desk.run(&format!("{CAPTURE} out.exr")).succeeded();
    desk.run(&format!("{SCORE} --json out.json")).succeeded();
    assert_eq!(desk.names(), ["out.exr", "out.json", "out.png"]);
    for name in ["out.png", "out.exr"] {
        let size = dejag::picture::load(&desk.path(name)).expect("a picture").size();
        assert_eq!(size, [32, 18], "{name}");
    }
    let json: serde_json::Value = serde_json::from_slice(&desk.read("out.json")).expect("JSON");
    assert_eq!(json["schema_version"], 1);
}

#[test]
fn a_report_over_what_is_not_one_is_2_and_touches_nothing() {
    let desk = Desk::new();
    desk.make_folder("mine");
    desk.write("mine/thesis.tex", "years of work");
    desk.write("file", "a file");
    for place in ["mine", "file", "."] {
        desk.refuses(&format!("{SCORE} --report {place}"), 2, &["will not be replaced", "name a new or empty folder"]);
    }
    assert_eq!(desk.read("mine/thesis.tex"), b"years of work");
    assert!(desk.references().is_empty(), "something was drawn first");
}

#[test]
fn a_report_takes_an_empty_folder_and_the_place_of_an_older_report() {
    let desk = Desk::new();
    desk.make_folder("report");
    desk.run(&format!("{SCORE} --report report")).succeeded();
    let first = desk.names();
    assert!(first.contains(&"report/index.html".into()) && first.contains(&"report/results.json".into()), "{first:?}");
    assert!(first.contains(&"report/pictures/01-edges-01-none.png".into()), "{first:?}");

    desk.run(&format!("score edges -m msaa {SMALL} --report report")).succeeded();
    let second = desk.names();
    assert!(second.contains(&"report/pictures/01-edges-01-msaa.png".into()), "{second:?}");
    assert!(!second.contains(&"report/pictures/01-edges-01-none.png".into()), "the old one is gone: {second:?}");
    assert_eq!(second.len(), first.len(), "{second:?}");
}

#[test]
fn a_report_that_fails_leaves_the_older_one() {
    let desk = Desk::new();
    desk.run(&format!("{SCORE} --report report")).succeeded();
    let page = desk.read("report/index.html");
    desk.write("bad.toml", "frames = 0");
    desk.refuses(&format!("score edges bad.toml -m none {SMALL} --report report"), 2, &["bad.toml"]);
    desk.refuses(&format!("score edges -m none {SMALL} --frame 7 --report report"), 2, &["no frame 7"]);
    assert_eq!(desk.read("report/index.html"), page);
}

#[test]
fn a_report_makes_the_folders_above_it_and_only_if_it_is_made() {
    let desk = Desk::new();
    desk.refuses(&format!("{SCORE} --frame 7 --report new/er/report"), 2, &["no frame 7"]);
    desk.run(&format!("{SCORE} --report new/er/report")).succeeded();
    assert!(desk.path("new/er/report/index.html").is_file());
}
