//! `dejag bless`: takes what failed, says what it replaced, and replaces nothing that it does not know.

use std::fs;

use dejag::picture::texts;

use super::{Desk, changed, desk, levels, other, picture};

/// Two pictures, of which one is different and one is new.
fn failing() -> Desk {
    let desk = desk();
    desk.put("shots/a.png", &other());
    desk.put("shots/deep/b.png", &other());
    desk.put("shots/same.png", &picture(&levels()));
    desk.put("goldens/any/shots/same.png", &picture(&levels()));
    desk.dejag("check").ended(1, &["1 same, 1 different, 1 new"]);
    desk
}

fn bytes(desk: &Desk, name: &str) -> Vec<u8> {
    fs::read(desk.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn what_failed_is_blessed_and_said() {
    let desk = failing();
    let before = bytes(&desk, "goldens/any/shots/same.png");
    let dry = desk.dejag("bless --dry-run");
    dry.ended(0, &["replaced shots/a.png: goldens/any/shots/a.png", "added shots/deep/b.png: goldens/any/shots/deep/b.png"]);
    assert!(!desk.path("goldens/any/shots/deep/b.png").exists(), "a dry run writes nothing");
    let ran = desk.dejag("bless");
    assert_eq!(ran.stdout, dry.stdout);
    assert_eq!(bytes(&desk, "goldens/any/shots/a.png"), bytes(&desk, "dejag-check/candidates/shots/a.png"));
    assert_eq!(bytes(&desk, "goldens/any/shots/same.png"), before, "what did not fail stays");
    assert!(!desk.path("goldens/any/shots/deep/b.candidate.png").exists(), "the candidate beside it is the golden now");
    desk.dejag("check").ended(0, &["3 same"]);
    desk.dejag("bless").ended(4, &["nothing to do"]);
}

#[test]
fn goldens_say_where_they_come_from() {
    let desk = failing();
    desk.dejag("bless").ended(0, &[]);
    let words = texts(&desk.path("goldens/any/shots/a.png"));
    assert!(words["Software"].starts_with("dejag "), "{words:?}");
    assert_eq!(words["environment"], "any");
    assert!(words["command"].contains("dejag check") && words.contains_key("platform"), "{words:?}");
}

#[test]
fn only_what_is_named_is_blessed() {
    let desk = failing();
    desk.dejag("bless shots/deep").ended(0, &["added shots/deep/b.png"]);
    desk.dejag("check").ended(1, &["2 same, 1 different"]);
    desk.dejag("bless shots/same.png").ended(0, &["replaced shots/same.png"]);
    desk.dejag("bless shots/nothing").ended(2, &["unknown case 'shots/nothing'"]);
    desk.dejag("bless shots/*").ended(0, &["replaced shots/a.png", "golden shots/same.png: goldens/any/shots/same.png already"]);
}

#[test]
fn what_changed_since_the_check_is_left_alone() {
    let desk = failing();
    let mine = changed(&[(1, 1, 1, 1)]);
    desk.put("goldens/any/shots/a.png", &mine);
    desk.dejag("bless shots/a.png").ended(1, &["left alone", "the golden has changed since the check"]);
    let checked = desk.dejag("check");
    checked.ended(1, &[]);
    desk.put("dejag-check/candidates/shots/a.png", &mine);
    desk.dejag("bless shots/a.png").ended(1, &["the candidate is not the one that was checked"]);
    desk.put("goldens/any/shots/deep/b.png", &mine);
    desk.dejag("bless shots/deep/b.png").ended(1, &["the golden has changed since the check"]);
}

#[test]
fn pictures_that_are_gone_and_checks_that_never_were() {
    let desk = desk();
    desk.dejag("bless").ended(2, &["run `dejag check` first"]);
    fs::remove_file(desk.path("shots/a.png")).expect("removed");
    desk.dejag("check").ended(1, &["1 missing"]);
    desk.dejag("bless").ended(1, &["left alone shots/a.png: its picture is gone"]);
    assert!(desk.path("goldens/any/shots/a.png").exists());
    desk.write("dejag-check/check.json", "{}");
    desk.dejag("bless").ended(3, &["check.json is not a readable result of `dejag check`"]);
}

#[test]
fn an_output_folder_from_elsewhere() {
    let desk = failing();
    fs::rename(desk.path("dejag-check"), desk.path("downloaded")).expect("moved");
    desk.dejag("bless").ended(2, &["--from"]);
    desk.dejag("bless --from downloaded").ended(0, &["replaced shots/a.png", "added shots/deep/b.png"]);
    desk.dejag("check").ended(0, &["3 same"]);
}

#[test]
fn what_cannot_be_blessed_does_not_stop_the_others_and_each_is_told() {
    let desk = desk();
    for name in ["a", "b", "c"] {
        desk.put(format!("shots/{name}.png"), &other());
        desk.put(format!("goldens/any/shots/{name}.png"), &picture(&levels()));
    }
    desk.dejag("check").ended(1, &["3 different"]);
    fs::remove_file(desk.path("dejag-check/candidates/shots/b.png")).expect("removed");
    desk.dejag("bless").ended(3, &["replaced shots/a.png", "failed shots/b.png: could not read", "replaced shots/c.png"]);
    desk.dejag("check").ended(1, &["2 same, 1 different"]);
}

#[test]
fn a_name_that_looks_like_a_pattern_is_a_name_first() {
    let desk = desk();
    for name in ["a", "b", "[ab]"] {
        desk.put(format!("shots/{name}.png"), &other());
        desk.put(format!("goldens/any/shots/{name}.png"), &picture(&levels()));
    }
    desk.dejag("check").ended(1, &["3 different"]);
    let ran = desk.dejag("bless shots/[ab].png");
    ran.ended(0, &["replaced shots/[ab].png"]);
    assert_eq!(ran.stdout.lines().count(), 1, "{ran}");
    desk.dejag("bless shots/[a]*").ended(0, &["replaced shots/a.png"]);
    desk.dejag("check").ended(1, &["2 same, 1 different"]);
}

#[test]
fn results_that_lead_out_of_their_folders_are_refused() {
    let desk = failing();
    let text = fs::read_to_string(desk.path("dejag-check/check.json")).expect("there");
    for (key, inside, outside) in [
        ("blessed_as", "goldens/any/shots/a.png", "../outside.png"),
        ("blessed_as", "goldens/any/shots/a.png", "/tmp/outside.png"),
        ("blessed_as", "goldens/any/shots/a.png", "goldens/any/shots/same.png"),
        ("blessed_as", "goldens/any/shots/a.png", "goldens/other/shots/a.png"),
        ("actual", "candidates/shots/a.png", "../../secret.png"),
    ] {
        desk.write(
            "dejag-check/check.json",
            text.replace(&format!("\"{key}\": \"{inside}\""), &format!("\"{key}\": \"{outside}\"")),
        );
        desk.dejag("bless shots/a.png").ended(1, &["left alone", "leads out of"]);
    }
}
