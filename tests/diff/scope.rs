//! Masks and ignored regions.

use super::desk::{Desk, changed, levels, picture};
use dejag::picture::DisplayPicture;

fn desk() -> Desk {
    let desk = Desk::new();
    desk.put("a.png", &picture(&levels()));
    desk.put("b.png", &changed(&[(5, 6, 0, 9), (30, 20, 1, 9)]));
    desk
}

fn mask(white: impl Fn(u32, u32) -> bool) -> DisplayPicture {
    DisplayPicture::from_fn(32, 24, |x, y| if white(x, y) { [1.0, 1.0, 1.0, 1.0] } else { [0.0, 0.0, 0.0, 1.0] }).expect("a size")
}

#[test]
fn a_mask_counts_where_it_is_white() {
    let desk = desk();
    for (name, white, code, compared) in
        [("neither.png", (10, 15), 0, 5 * 24), ("first.png", (0, 16), 1, 16 * 24), ("both.png", (0, 32), 1, 768)]
    {
        desk.put(name, &mask(|x, _| (white.0..white.1).contains(&x)));
        let (ended, json) = desk.json(&format!("a.png b.png --mask {name}"));
        assert_eq!((ended, json["pairs"][0]["pixels"]["compared"].as_u64()), (code, Some(compared)), "{name}");
    }
    desk.put("small.png", &mask(|_, _| true).crop(0, 0, 31, 24).expect("inside"));
    desk.line("a.png b.png --mask small.png").ended(2, &["the mask is 31x24 and the pictures are 32x24"]);
    desk.line("a.png b.png --mask absent.png").ended(3, &["absent.png"]);
}

#[test]
fn ignored_regions_are_half_open() {
    let desk = desk();
    for (ignore, code) in [
        ("--ignore 5,6,1,1 --ignore 30,20,1,1", 0),
        ("--ignore 5,6,1,1 --ignore 29,20,1,1", 1),
        ("--ignore 0,0,5,24 --ignore 30,0,2,24", 1),
        ("--ignore 0,0,6,7 --ignore 30,20,2,4", 0),
        ("--ignore 5,6,1,1", 1),
    ] {
        desk.line(&format!("a.png b.png {ignore}")).ended(code, &[]);
    }
    desk.line("a.png b.png --ignore 31,23,2,1").ended(2, &["31,23,2,1 reaches outside a picture of 32x24"]);
    desk.line("a.png b.png --ignore 4294967295,0,2,1").ended(2, &["reaches outside"]);
}

#[test]
fn metrics_look_where_pixels_count() {
    let desk = desk();
    let flip = |options: &str| {
        let (_, json) = desk.json(&format!("a.png b.png --sweep {options}"));
        let knobs = json["pairs"][0]["knobs"].as_array().expect("knobs").clone();
        knobs.iter().find(|knob| knob["option"] == "--max-flip").and_then(|knob| knob["value"].as_f64()).expect("a figure")
    };
    let one = flip("--ignore 5,6,1,1");
    assert!(one > 0.0 && one < flip(""), "{one}");
    assert_eq!(flip("--ignore 5,6,1,1 --ignore 30,20,1,1"), 0.0);
}
