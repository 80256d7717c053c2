//! Scores and sequences in parts, and the parts put together.

use serde_json::Value;

use super::desk::{Desk, SMALL};

/// Without what depends on the clock.
fn timeless(mut value: Value) -> Value {
    match &mut value {
        Value::Object(map) => {
            map.remove("timing");
            map.values_mut().for_each(|value| *value = timeless(value.take()));
        }
        Value::Array(list) => list.iter_mut().for_each(|value| *value = timeless(value.take())),
        _ => {}
    }
    value
}

/// Runs a line whole and in three parts at once, and holds the parts together against the whole. Answers the desk.
fn parts_are_the_whole(line: &str) -> Desk {
    let desk = Desk::new();
    desk.run(&format!("{line} -q --report whole --json whole.json")).succeeded();
    for costs in ["", "--costs whole.json"] {
        let running: Vec<_> =
            (1..=3).map(|k| desk.start(desk.command(&format!("{line} -q --shard {k}/3 {costs} --report part-{k}")))).collect();
        for part in running {
            part.end().succeeded();
        }
        let parts = "part-2/results.json part-3/results.json part-1/results.json";
        let merged = desk.run(&format!("merge {parts} --report merged --json -"));
        let whole: Value = serde_json::from_slice(&desk.read("whole.json")).expect("JSON");
        assert_eq!(timeless(merged.succeeded().json()), timeless(whole));
        let pictures = |folder: &str| {
            let prefix = format!("{folder}/pictures/");
            let names = desk.names().into_iter().filter_map(|name| Some(name.strip_prefix(&prefix)?.to_owned()));
            names.map(|name| (desk.read(&format!("{prefix}{name}")), name)).collect::<Vec<_>>()
        };
        assert!(!pictures("merged").is_empty());
        assert!(pictures("merged") == pictures("whole"), "the report's pictures are those of the whole run");
    }
    desk
}

#[test]
fn scores() {
    let desk = parts_are_the_whole(&format!("score edges fence checker text -m none -m smaa -m ssaa:spp=4 {SMALL}"));
    desk.run("merge part-1/results.json part-3/results.json").failed(2, &["shard 2/3 is absent"]);
    desk.run("merge part-1/results.json part-2/results.json part-1/results.json").failed(2, &["1/3 is there twice"]);
    desk.run("merge whole.json").failed(2, &["is no shard"]);
    desk.run("merge part-1/results.json part-2/results.json part-3/results.json --output x").failed(2, &["--output is for"]);
    desk.run(&format!("score edges fence checker text -m none -q --shard 2/3 --report part-2 {SMALL}")).succeeded();
    desk.run("merge part-1/results.json part-2/results.json part-3/results.json").failed(2, &["differ in the command"]);
}

#[test]
fn sequences() {
    let line = "sequence pan -m none -m smaa -m taa -m fxaa --frames 0..4 --size 48x27 --probe none --reference ssaa:spp=16";
    let desk = parts_are_the_whole(line);
    desk.run("merge part-1/results.json part-2/results.json").failed(2, &["shard 3/3 is absent"]);
    desk.write("junk.json", "[]");
    desk.run("merge junk.json part-2/results.json").failed(3, &["junk.json is not a readable result"]);
    desk.run("merge absent.json").failed(3, &["absent.json"]);
}
