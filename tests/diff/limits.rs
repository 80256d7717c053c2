//! Each limit is met and missed, alone and with others, and what is said to pass does.

use super::desk::{Desk, changed, levels, picture};

/// Every pixel off by 1, and ten by 7.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("a.png", &picture(&levels()));
    let mut changes: Vec<(usize, usize, usize, i32)> = (0..32 * 24).map(|i| (i % 32, i / 32, i % 3, 1)).collect();
    changes.extend((0..10).map(|i| (i, 5, (i + 5 * 32) % 3, 6)));
    desk.put("b.png", &changed(&changes));
    desk
}

#[test]
fn pixels() {
    let desk = desk();
    for (limits, code) in [
        ("--max-pixels 768", 0),
        ("--max-pixels 767", 1),
        ("--max-pixels 100%", 0),
        ("--max-pixels 99.9%", 1),
        ("--per-channel 7/255", 0),
        ("--per-channel 6/255", 1),
        ("--per-channel 6.99/255", 1),
        ("--per-channel 1/255", 1),
        ("--per-channel 1/255 --max-pixels 10", 0),
        ("--per-channel 1/255 --max-pixels 9", 1),
        ("--per-channel 1/255 --max-pixels 1.31%", 0),
        ("--per-channel 1/255 --max-pixels 1.3%", 1),
    ] {
        desk.line(&format!("a.png b.png {limits}")).ended(code, &[]);
    }
}

/// The figure and the value that passes, of an option.
fn knob(desk: &Desk, option: &str) -> (f64, f64) {
    let (_, json) = desk.json("a.png b.png --sweep");
    let knobs = json["pairs"][0]["knobs"].as_array().expect("knobs").clone();
    let knob = knobs.into_iter().find(|knob| knob["option"] == option).unwrap_or_else(|| panic!("no {option}"));
    (knob["value"].as_f64().expect("a figure"), knob["passes_at"].as_f64().expect("a limit"))
}

#[test]
fn metrics_and_what_would_pass() {
    let desk = desk();
    for (option, higher) in [("--max-flip", false), ("--max-rmse", false), ("--min-psnr", true), ("--min-ssim", true)] {
        let (value, passes) = knob(&desk, option);
        let tighter = if higher { value * 1.000_01 } else { value * 0.999_99 };
        assert!((passes - value).abs() < 0.002 * value, "{option}: {passes} for {value}");
        desk.line(&format!("a.png b.png {option} {passes}")).ended(0, &[&format!("{option} {passes}: met")]);
        desk.line(&format!("a.png b.png {option} {tighter}")).ended(1, &["missed, it is"]);
        // A limit of pixels beside it must be met too.
        desk.line(&format!("a.png b.png {option} {passes} --max-pixels 767")).ended(1, &["met"]);
        desk.line(&format!("a.png b.png {option} {passes} --max-pixels 768")).ended(0, &["met"]);
        desk.line(&format!("a.png b.png {option} {tighter} --max-pixels 768")).ended(1, &["missed"]);
    }
    for (option, passes) in [("--max-pixels", 768.0), ("--per-channel", 7.0 / 255.0)] {
        assert_eq!(knob(&desk, option).1, passes);
    }
}

#[test]
fn results_name_metrics_with_version_and_parameters() {
    let (_, json) = desk().json("a.png b.png --sweep");
    let ids: Vec<&str> =
        json["pairs"][0]["knobs"].as_array().expect("knobs").iter().filter_map(|k| k["metric"].as_str()).collect();
    let known = ["differing-pixels/1", "channel-difference/1", "rmse/1", "psnr/1", "ssim-gaussian11/1", "flip-ldr/1.7@67.0206"];
    assert_eq!(ids, known);
}

#[test]
fn a_metric_that_does_not_apply_does_not_pass_unless_the_pictures_are_equal() {
    let desk = Desk::new();
    let small = |level: u8| dejag::picture::DisplayPicture::from_rgba8(4, 4, &[level; 64]).expect("4x4");
    desk.put("a.png", &small(100));
    desk.put("b.png", &small(101));
    desk.line("a.png b.png --min-ssim 0.5").ended(1, &["does not apply"]);
    desk.line("a.png a.png --min-ssim 0.5").ended(0, &["met"]);
    desk.line("a.png b.png --max-flip 0.5").ended(0, &["met"]);
}

#[test]
fn the_same_files_give_the_same_bytes_on_any_number_of_threads() {
    let desk = desk();
    let first = desk.line("a.png b.png --sweep --allow-edges --json -").stdout;
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_dejag"));
    command.args("diff a.png b.png --sweep --allow-edges --json -".split(' ')).current_dir(desk.path(""));
    let one = command.env("RAYON_NUM_THREADS", "1").output().expect("it runs");
    assert_eq!(String::from_utf8_lossy(&one.stdout), first);
}
