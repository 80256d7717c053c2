//! A run in parts, and the parts put together.

use std::fs;
use std::process::Stdio;

use serde_json::Value;

use super::{Desk, json, levels, other, picture, schema, without_times};

/// A dozen entries of one picture each, one of which is different, and one folder.
fn desk() -> Desk {
    let desk = Desk::new();
    let mut manifest = String::new();
    for k in 0..12 {
        manifest += &format!("[[files]]\nid = 'case {k}'\nfile = 'shots/{k}.png'\n");
        desk.put(format!("shots/{k}.png"), &if k == 5 { other() } else { picture(&levels()) });
        desk.put(format!("goldens/any/case {k}.png"), &picture(&levels()));
    }
    desk.write("dejag.toml", manifest + "[[files]]\nid = 'all'\nfolder = 'shots'\nexclude = ['1*']\n");
    for k in (0..12).filter(|k| !k.to_string().starts_with('1')) {
        desk.put(format!("goldens/any/all/{k}.png"), &picture(&levels()));
    }
    desk
}

fn read(desk: &Desk, name: &str) -> Value {
    let json = serde_json::from_slice(&fs::read(desk.path(name)).expect("there")).expect("JSON");
    assert_eq!(schema::validate("check", &json), Ok(()));
    json
}

#[test]
fn shards_together_are_the_whole_run() {
    let desk = desk();
    let (code, whole) = json(&desk, "--output whole");
    assert_eq!((code, whole["cases"].as_array().map(Vec::len)), (1, Some(21)));
    fs::copy(desk.path("whole/check.json"), desk.path("costs.json")).expect("copied");
    for costs in ["", "--costs costs.json"] {
        // As machines would: at once.
        let running: Vec<_> = (1..=4)
            .map(|k| {
                let mut command = desk.command();
                command.args(format!("check -q --shard {k}/4 {costs}").split_whitespace());
                command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it runs")
            })
            .collect();
        let codes: Vec<_> = running.into_iter().map(|mut child| child.wait().expect("it ends").code()).collect();
        assert!(codes.iter().all(|code| matches!(code, Some(0 | 1))), "{codes:?}");
        let shard = |k: u32| format!("dejag-check/shard-{k}-of-4/check.json");
        // In any order.
        let all = [3, 1, 4, 2].map(shard).join(" ");
        let merged = desk.dejag(&format!("merge {all} --json - --report report --junit junit.xml --output together"));
        assert_eq!(merged.code, Some(1), "{merged}");
        assert_eq!(without_times(merged.json()), without_times(whole.clone()));
        let own: usize = (1..=4).map(|k| read(&desk, &shard(k))["shard"]["own"].as_array().expect("own").len()).sum();
        assert_eq!(own, 13);
        assert!(fs::read_to_string(desk.path("report/index.html")).expect("a page").contains("case 5"));

        let some = [1, 2, 4].map(shard).join(" ");
        desk.dejag(&format!("merge {some}")).ended(2, &["shard 3/4 is absent"]);
        desk.dejag(&format!("merge {all} {}", shard(2))).ended(2, &["shard 2/4 is there twice"]);
    }
    desk.dejag("merge whole/check.json").ended(2, &["is no shard"]);
    // What was brought together can be blessed.
    desk.dejag("bless --from together").ended(0, &["replaced case 5", "replaced all/5.png"]);
    desk.dejag("check").ended(0, &["21 same"]);
}

#[test]
fn shards_of_different_runs_are_refused() {
    let desk = desk();
    desk.dejag("check --shard 1/2 -o one").ended(if alone_has_no_difference(&desk) { 0 } else { 1 }, &[]);
    let manifest = fs::read_to_string(desk.path("dejag.toml")).expect("there");
    desk.write("dejag.toml", format!("{manifest}# changed\n"));
    desk.dejag("check --shard 2/2 -o two");
    desk.dejag("merge one/check.json two/check.json").ended(2, &["differ in the manifest"]);
    desk.dejag("check --shard 1/2 -o one --environment x");
    desk.dejag("merge one/check.json two/check.json").ended(2, &["differ in the command"]);
    desk.dejag("check --shard 1/3 -o one");
    desk.dejag("merge one/check.json two/check.json").ended(2, &["dealt differently"]);
}

fn alone_has_no_difference(desk: &Desk) -> bool {
    let own = read(desk, "one/check.json");
    own["counts"]["different"] == 0
}

#[test]
fn a_shard_with_nothing_to_do_is_fine() {
    let desk = super::desk();
    let codes: Vec<_> = (1..=3).map(|k| desk.dejag(&format!("check --shard {k}/3")).code).collect();
    assert_eq!(codes, [Some(0); 3]);
    desk.dejag(
        "merge dejag-check/shard-1-of-3/check.json dejag-check/shard-2-of-3/check.json dejag-check/shard-3-of-3/check.json",
    )
    .ended(0, &["1 same"]);
}
