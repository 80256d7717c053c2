//! `dejag bless --update-tolerance`: limits as wide as what machines showed, and no wider.

use std::fs;

use super::{Desk, changed, desk};

/// Runs the check as two machines would, of which the second draws other bits: at most 4/255 in 2 pixels.
fn runs(tolerance: &str) -> Desk {
    let desk = desk();
    manifest(&desk, tolerance);
    desk.dejag("check --environment one --json one.json");
    desk.put("shots/a.png", &changed(&[(3, 4, 0, 4), (9, 9, 1, -1)]));
    desk.dejag("check --environment two --json two.json");
    desk
}

fn manifest(desk: &Desk, tolerance: &str) {
    desk.write("dejag.toml", format!("# ours\n{}tolerance = {{ {tolerance} }} # kept\n", super::MANIFEST));
}

fn text(desk: &Desk) -> String {
    fs::read_to_string(desk.path("dejag.toml")).expect("there")
}

#[test]
fn limits_become_what_the_machines_need() {
    let desk = runs("per-channel = '9/255', max-rmse = 0.5");
    let ran = desk.dejag("bless --update-tolerance one.json two.json");
    ran.ended(0, &["environments seen: one on", "two on", "shots/a.png per-channel:", "shots/a.png max-rmse: 0.5 ->"]);
    let learned = text(&desk);
    assert!(learned.starts_with("# ours") && learned.contains("# kept"), "{learned}");
    assert!(learned.contains("per-channel = \"4/255\""), "{learned}");
    desk.dejag("check --environment two").ended(0, &["1 same"]);
    desk.put("shots/a.png", &changed(&[(3, 4, 0, 5)]));
    desk.dejag("check --environment two").ended(1, &["1 different"]);
    // A second lesson goes where the first went.
    desk.dejag("bless --update-tolerance one.json two.json").ended(0, &["nothing to do"]);
    assert_eq!(text(&desk), learned);
}

#[test]
fn shares_and_counts_of_pixels() {
    let desk = runs("max-pixels = '50%'");
    desk.dejag("bless --update-tolerance one.json two.json").ended(0, &["max-pixels"]);
    assert!(text(&desk).contains("max-pixels = \"0.2605%\""), "{}", text(&desk));
    desk.dejag("check --environment two").ended(0, &[]);
    let desk = runs("max-pixels = 100");
    desk.dejag("bless --update-tolerance one.json two.json").ended(0, &["max-pixels: 100 -> 2"]);
    assert!(text(&desk).contains("max-pixels = 2"), "{}", text(&desk));
}

#[test]
fn nothing_becomes_wider_from_one_environment_or_a_failing_case() {
    let desk = runs("per-channel = '9/255'");
    manifest(&desk, "per-channel = '1/255'");
    let before = text(&desk);
    desk.dejag("bless --update-tolerance two.json").ended(1, &["left alone shots/a.png", "seen in one environment only"]);
    assert_eq!(text(&desk), before);
    // Under limits that were wider then, the case passed on both.
    desk.dejag("bless --update-tolerance one.json two.json --dry-run").ended(0, &["per-channel"]);
    assert_eq!(text(&desk), before);
    desk.dejag("check --environment two --json failing.json").ended(1, &[]);
    desk.dejag("bless --update-tolerance one.json failing.json").ended(1, &["it fails on two"]);
    assert_eq!(text(&desk), before);
    desk.dejag("bless --update-tolerance failing.json --force").ended(0, &["per-channel"]);
    desk.dejag("check --environment two").ended(0, &[]);
}

#[test]
fn the_order_of_runs_and_what_they_lack_make_nothing_wider() {
    let desk = runs("per-channel = '1/255'");
    desk.put("shots/b.png", &changed(&[]));
    desk.put("goldens/any/shots/b.png", &changed(&[]));
    desk.dejag("check --environment three --json three.json").ended(1, &[]);
    let before = text(&desk);
    for runs in ["one.json two.json", "two.json one.json"] {
        desk.dejag(&format!("bless --update-tolerance {runs}")).ended(1, &["left alone shots/a.png", "it fails on two"]);
        assert_eq!(text(&desk), before);
    }
    // Two environments in all, but only one of this picture.
    desk.dejag("check shots --environment four --json four.json");
    desk.write("shots/a.png", fs::read(desk.path("shots/b.png")).expect("there"));
    fs::remove_file(desk.path("shots/a.png")).expect("removed");
    fs::remove_file(desk.path("goldens/any/shots/a.png")).expect("removed");
    desk.dejag("check --environment five --json five.json").ended(0, &[]);
    desk.dejag("bless --update-tolerance two.json five.json")
        .ended(1, &["left alone shots/a.png", "one environment only, two on"]);
}

#[test]
fn limits_by_environment_are_left_to_their_author() {
    let desk = runs("per-channel = '9/255'");
    let over = "[[override]]\nenvironment = 'nobody-*'\ntolerance = { per-channel = '1/255' }\n";
    desk.write("dejag.toml", format!("{}{over}", text(&desk)));
    desk.dejag("bless --update-tolerance one.json two.json").ended(1, &["edit those overrides yourself"]);
}

#[test]
fn a_lesson_holds_over_what_stands_below_it_and_over_any_name() {
    let desk = runs("per-channel = '9/255'");
    let overs = "[[override]]\ncase = 'shots/a.png'\ntolerance = { per-channel = '8/255' }\n\
                 [[override]]\ncase = 'shots/*'\ntolerance = { per-channel = '7/255' }\n";
    desk.write("dejag.toml", format!("{}{overs}", text(&desk)));
    desk.dejag("bless --update-tolerance one.json two.json").ended(0, &["per-channel: \"7/255\" -> \"4/255\""]);
    desk.dejag("bless --update-tolerance one.json two.json").ended(0, &["nothing to do"]);
    desk.dejag("check --environment two").ended(0, &[]);
    desk.put("shots/a.png", &changed(&[(3, 4, 0, 5)]));
    desk.dejag("check --environment two").ended(1, &[]);
}

#[test]
fn runs_that_have_nothing_to_teach() {
    let desk = runs("per-channel = '9/255'");
    fs::remove_file(desk.path("goldens/any/shots/a.png")).expect("removed");
    desk.dejag("check --environment two --json new.json").ended(1, &[]);
    desk.dejag("bless --update-tolerance one.json new.json").ended(1, &["left alone shots/a.png: on two it is new"]);
    desk.write("dejag.toml", "[[files]]\nid = 'others'\nfolder = 'shots'\n");
    desk.dejag("bless --update-tolerance one.json").ended(2, &["no case of this manifest"]);
    desk.dejag("bless --update-tolerance absent.json").ended(3, &["absent.json"]);
    desk.dejag("bless --force").ended(2, &["--update-tolerance"]);
}
