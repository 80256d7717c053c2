//! `dejag check` on pictures that something else made; what it draws is tested with the workbench.

mod accepting;
mod bad;
mod killed;
mod learning;
mod outcomes;
mod shards;

use serde_json::Value;

use super::desk::{Desk, changed, levels, picture};
use super::{junit, schema};

const MANIFEST: &str = "[[files]]\nid = 'shots'\nfolder = 'shots'\n";

/// A manifest of one folder with one picture and its golden.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("dejag.toml", MANIFEST);
    desk.put("shots/a.png", &picture(&levels()));
    desk.put("goldens/any/shots/a.png", &picture(&levels()));
    desk
}

/// A picture that nobody takes for the golden.
fn other() -> dejag::picture::DisplayPicture {
    changed(&[(3, 4, 0, 5), (20, 10, 2, -9), (21, 10, 1, 1)])
}

/// What `check --json -` prints, which must fit its schema, and the exit code.
#[track_caller]
fn json(desk: &Desk, line: &str) -> (i32, Value) {
    let ran = desk.dejag(&format!("check {line} --json -"));
    let json = ran.json();
    assert_eq!(schema::validate("check", &json), Ok(()), "{ran}");
    (ran.code.expect("no signal"), json)
}

/// The same without what depends on the clock.
fn without_times(mut results: Value) -> Value {
    let cases = results["cases"].as_array_mut().expect("cases");
    cases.iter_mut().for_each(|case| drop(case.as_object_mut().expect("a case").remove("timing")));
    results
}
