//! How a run goes: bad pictures, bad requests, threads, being stopped, a full disk.

use std::path::PathBuf;

use dejag::picture::{BitDepth, DisplayPicture, load};

use super::{Desk, filter, jagged, put, refused, smoothed};

#[test]
fn a_bad_picture_is_reported_and_the_others_are_written() {
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/a.png", &jagged(16, 9, 1.0));
    put(&desk, "in/z.png", &jagged(16, 9, 1.0));
    let good = desk.read("in/a.png");
    desk.write("in/cut.png", &good[..good.len() / 2]);
    desk.write("in/empty.jpg", "");
    desk.write("in/text.webp", "words");
    desk.write("in/header.exr", [0x76, 0x2f, 0x31, 0x01]);
    let ran = desk.run(&format!("filter in -o out -m {}", filter()));
    ran.failed(3, &["cut.png is not a readable PNG", "empty.jpg", "it is empty", "text.webp", "header.exr"]);
    let order: Vec<&str> =
        ["in/cut.png", "in/empty.jpg", "in/header.exr", "in/text.webp", "out: 2 of 6 pictures"].into_iter().collect();
    for (line, start) in ran.stderr.lines().zip(order) {
        assert!(line.strip_prefix("error: ").unwrap_or(line).starts_with(start), "{start} is not first in {line}");
    }
    assert!(ran.stderr.ends_with("4 failed\n"), "{ran}");
    let out: Vec<String> = desk.names().into_iter().filter(|name| name.starts_with("out/")).collect();
    assert_eq!(out, ["out/a.png", "out/z.png"]);

    refused(&desk, "in/cut.png -o alone.png", 3, &["in/cut.png is not a readable PNG"]);
    refused(&desk, "nowhere.png -o alone.png", 3, &["could not read nowhere.png", "check the path"]);
    refused(&desk, "in nowhere -o elsewhere", 3, &["could not read nowhere", "check the path"]);
}

#[test]
fn requests_that_make_no_sense_are_2_before_anything_is_read() {
    let desk = Desk::new();
    desk.make_folder("empty");
    desk.write("text.png", "not read");
    for (method, words) in
        [("none", "draws the scene itself"), ("ssaa:spp=4", "draws the scene itself"), ("smooth", "unknown method")]
    {
        desk.refuses(&format!("filter text.png -o out.png -m {method}"), 2, &[words, filter()]);
        desk.refuses(&format!("filter nowhere.png -o out.png -m {method}"), 2, &[words]);
    }
    refused(&desk, "empty -o out", 2, &["no picture in empty", ".webp"]);
    refused(&desk, "text.png -o out.jpg --quality 0", 2, &["--quality", "1..=100"]);
    desk.refuses(&format!("filter text.png -m {}", filter()), 2, &["--output"]);
    desk.refuses("filter text.png -o out.png", 2, &["--method"]);
    refused(&desk, "-o out.png", 2, &["<IN>"]);
    refused(&desk, "text.png -o out.png --view nonsense", 2, &["view"]);
}

/// Two sizes, two depths, linear light and a JPEG, several of each.
fn mixed(desk: &Desk) -> Vec<PathBuf> {
    desk.make_folder("in");
    for i in 0..4 {
        put(desk, &format!("in/{i}.png"), &jagged(33 + i, 21, 0.5));
        let deep = jagged(40, 30 + i, 1.0);
        deep.save_png(&desk.path(&format!("in/{i}-deep.png")), BitDepth::Sixteen, &[]).expect("saved");
        deep.to_linear().save_exr(&desk.path(&format!("in/{i}.exr")), &[]).expect("saved");
        smoothed(desk, &format!("in/{i}-deep.png -o in/{i}.jpg -q"));
    }
    let names = desk.names().into_iter().filter_map(|name| name.strip_prefix("in/").map(PathBuf::from));
    names.collect()
}

#[test]
fn the_same_bytes_twice_and_whatever_the_threads() {
    let desk = Desk::new();
    let names = mixed(&desk);
    assert_eq!(names.len(), 16);
    let run = |out: &str, threads: &str| {
        let mut command = desk.command(&format!("filter in -o {out} -m {}", filter()));
        command.env("RAYON_NUM_THREADS", threads);
        let ran = desk.run_command(command);
        ran.succeeded();
        (
            names.iter().map(|name| desk.read(&format!("{out}/{}", name.display()))).collect::<Vec<_>>(),
            ran.stderr.replace(out, ""),
        )
    };
    let first = run("first", "1");
    assert!(first == run("second", "1"), "twice");
    assert!(first == run("third", "8"), "with more threads");
    // And the same as each alone.
    for (name, bytes) in names.iter().zip(first.0) {
        let alone = format!("alone-{}", name.display());
        smoothed(&desk, &format!("in/{} -o {alone}", name.display()));
        assert!(desk.read(&alone) == bytes, "{} alone", name.display());
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_whole_pictures_and_nothing_else() {
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/0.png", &jagged(1280, 720, 1.0));
    for i in 1..200 {
        std::fs::hard_link(desk.path("in/0.png"), desk.path(&format!("in/{i}.png"))).expect("a link");
    }
    let mut running = desk.start(desk.command(&format!("filter in -o out -m {}", filter())));
    running.until("the first was written", |_| desk.path("out/0.png").is_file());
    running.signal("INT");
    let ran = running.end();
    ran.failed(130, &["interrupted", "nothing was left half-written"]);
    let out: Vec<String> = desk.names().into_iter().filter(|name| name.starts_with("out/")).collect();
    assert!(!out.is_empty() && out.len() < 200, "{} were written", out.len());
    for name in out {
        assert_eq!(load(&desk.path(&name)).expect("whole").size(), [1280, 720]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_fills_up_costs_the_pictures_that_do_not_fit() {
    let desk = Desk::new();
    desk.make_folder("in");
    put(&desk, "in/small.png", &jagged(8, 8, 1.0));
    // Noise, which no compression makes fit.
    let level = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8;
    let noise: Vec<u8> = (0..128 * 128 * 4).map(|i| if i % 4 == 3 { 255 } else { level(i) }).collect();
    let large = DisplayPicture::from_rgba8(128, 128, &noise).expect("128x128");
    put(&desk, "in/large.png", &large);
    desk.make_folder("out");
    desk.write("out/large.png", "the old picture");
    let limited = |arguments: &str| {
        desk.run_command(desk.limited("trap '' XFSZ && ulimit -f 8", &format!("filter {arguments} -m {}", filter())))
    };
    limited("in -o out").failed(3, &["could not write out/large.png", "free some space", "1 of 2 pictures"]);
    for name in ["alone.png", "alone.jpg", "alone.webp", "alone.exr"] {
        limited(&format!("in/large.png -o {name}")).failed(3, &["could not write", name, "free some space"]);
    }
    assert_eq!(desk.read("out/large.png"), b"the old picture");
    assert_eq!(load(&desk.path("out/small.png")).expect("whole").size(), [8, 8]);
    assert_eq!(desk.names(), ["in", "in/large.png", "in/small.png", "out", "out/large.png", "out/small.png"]);
}
