//! Pictures of differences: what they show, and what they never replace.

use std::fs;

use dejag::picture::load;

use super::desk::{Desk, changed, levels, picture};

fn desk() -> Desk {
    let desk = Desk::new();
    for folder in ["x/deep", "y/deep"] {
        desk.put(format!("{folder}/same.png"), &picture(&levels()));
    }
    desk.put("x/deep/other.png", &picture(&levels()));
    desk.put("y/deep/other.png", &changed(&[(3, 4, 0, 50), (7, 8, 1, 1)]));
    desk
}

#[test]
fn a_heat_map_shows_what_differs() {
    let desk = desk();
    desk.line("x/deep/other.png y/deep/other.png --heat heat.png").ended(1, &["written: heat.png"]);
    let heat = load(&desk.path("heat.png")).expect("a picture").into_display();
    assert_eq!(heat.size(), [32, 24]);
    for y in 0..24 {
        for x in 0..32 {
            let [r, g, b, _] = heat.pixel(x, y);
            assert_eq!(r != g || g != b, [(3, 4), (7, 8)].contains(&(x, y)), "{x},{y}: {r} {g} {b}");
        }
    }
    assert!(heat.pixel(3, 4)[0] > heat.pixel(7, 8)[0], "the larger difference is brighter");
}

#[test]
fn a_triptych_and_a_flip_book_show_both() {
    let desk = desk();
    desk.line("x/deep/other.png y/deep/other.png --triptych three.png --flip-book book.png").ended(1, &["three.png, book.png"]);
    let three = load(&desk.path("three.png")).expect("a picture").into_display();
    assert_eq!(three.size(), [3 * 32 + 8, 24]);
    let (a, b) = (picture(&levels()), changed(&[(3, 4, 0, 50), (7, 8, 1, 1)]));
    assert_eq!(three.crop(0, 0, 32, 24).expect("inside").to_rgba8(), a.to_rgba8());
    assert_eq!(three.crop(36, 0, 32, 24).expect("inside").to_rgba8(), b.to_rgba8());
    let book = fs::read(desk.path("book.png")).expect("written");
    let reader = png::Decoder::new(std::io::Cursor::new(&book)).read_info().expect("a PNG");
    assert_eq!(reader.info().animation_control().map(|control| control.num_frames), Some(2));
}

#[test]
fn a_folder_gets_pictures_of_what_is_different_only() {
    let desk = desk();
    desk.line("x y -o out").ended(1, &["written: out/deep/other.png.heat.png"]);
    let kinds = ["flip-book", "heat", "triptych"];
    let written: Vec<String> = desk.names().into_iter().filter(|name| name.starts_with("out/deep/")).collect();
    assert_eq!(written, kinds.map(|kind| format!("out/deep/other.png.{kind}.png")));
    desk.line("x/deep/same.png y/deep/same.png -o none").ended(0, &[]);
    assert!(!desk.path("none").exists());
    desk.line("x/deep/other.png y/deep/other.png -o one").ended(1, &[]);
    assert!(desk.path("one/other.png.heat.png").is_file());
}

#[test]
fn inputs_are_never_replaced() {
    let desk = desk();
    let before = fs::read(desk.path("x/deep/other.png")).expect("there");
    for (arguments, words) in [
        ("x/deep/other.png y/deep/other.png --heat x/deep/other.png", "one of the pictures"),
        ("x/deep/other.png y/deep/other.png --heat ./x/../x/deep/other.png", "one of the pictures"),
        ("x/deep/other.png y/deep/other.png --heat t.png --triptych t.png", "two pictures"),
        ("x/deep/other.png y/deep/other.png --heat t.jpg", ".png"),
        ("x y -o x", "which is compared"),
        ("x y -o y/new/deeper", "which is compared"),
        ("x y -o x/deep/other.png", ""),
    ] {
        desk.line(arguments).ended(2, &["error: ", words]);
    }
    assert_eq!(fs::read(desk.path("x/deep/other.png")).expect("there"), before);
    assert!(!desk.path("y/new").exists() && !desk.path("t.png").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_said() {
    let desk = desk();
    std::os::unix::fs::symlink("/dev/full", desk.path("full.png")).expect("linked");
    desk.line("x/deep/other.png y/deep/other.png --heat full.png").ended(3, &["free some space"]);
    desk.line("x/deep/other.png y/deep/other.png --json full.png").ended(3, &["free some space"]);
}
