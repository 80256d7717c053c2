//! `dejag check` of what it draws itself. What holds for pictures of others too is tested without a GPU, in `tests/diff/check`.

use std::fs;

use serde_json::Value;

use super::desk::Desk;

const MANIFEST: &str = "
[[capture]]
scene = 'edges'
method = ['none', 'ssaa:spp=4']
size = '48x27'

[[capture]]
id = 'light'
scene = 'glint'
size = '48x27'
format = 'exr'

[[sequence]]
scene = 'pan'
method = 'taa'
size = '48x27'
frames = '0..3'
";

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("dejag.toml", MANIFEST);
    desk
}

fn check(desk: &Desk, options: &str) -> Value {
    desk.run(&format!("check --json - {options}")).json()
}

fn ids(results: &Value) -> Vec<&str> {
    results["cases"].as_array().expect("cases").iter().map(|case| case["id"].as_str().expect("an id")).collect()
}

#[test]
fn from_the_first_candidate_to_a_difference() {
    let desk = desk();
    let first = check(&desk, "");
    let expected = ["edges-none", "edges-ssaa-spp-4", "light", "pan-taa/00000", "pan-taa/00001", "pan-taa/00002"];
    assert_eq!(ids(&first), expected);
    assert_eq!(first["counts"]["new"], 6);
    let key = first["environment"]["key"].as_str().expect("a key");
    let golden = format!("goldens/{key}/edges-none.png");
    assert!(desk.path(&format!("goldens/{key}/edges-none.candidate.png")).is_file() && !desk.path(&golden).exists());

    desk.run("bless").succeeded();
    let words = dejag::picture::texts(&desk.path(&golden));
    for key_word in ["adapter", "environment", "platform", "Software", "command", "scene", "method"] {
        assert!(words.contains_key(key_word), "{words:?}");
    }
    assert_eq!(words["environment"], key);
    assert_eq!(check(&desk, "")["counts"]["same"], 6);
    assert_eq!(check(&desk, "pan-taa")["counts"]["same"], 3);

    // The same ids, drawn otherwise.
    desk.write("dejag.toml", MANIFEST.replace("frames = '0..3'", "frames = '0..3'\nid = 'light2'").replace("glint", "edges"));
    let other = check(&desk, "light");
    assert_eq!(other["counts"]["different"], 1);
    assert!(desk.path("dejag-check").join(other["cases"][0]["pictures"][0].as_str().expect("a path")).is_file());
    let unused = check(&desk, "")["unused_goldens"].to_string();
    assert!(unused.contains("pan-taa/00001.png"), "{unused}");
}

#[test]
fn another_driver_is_named_as_the_likely_cause() {
    let desk = desk();
    check(&desk, "edges-none");
    desk.run("bless").succeeded();
    let drawn = check(&desk, "edges-none")["environment"]["key"].as_str().expect("a key").to_owned();
    // The golden of one method against the picture of another, as if the driver had drawn it so.
    desk.write(
        "dejag.toml",
        format!("fallback = ['{drawn}']\n[[capture]]\nid = 'edges-none'\nscene = 'edges'\nmethod = 'smaa'\nsize = '48x27'\n"),
    );
    let ran = desk.run("check --environment elsewhere-1.2");
    assert_eq!(ran.code, Some(1), "{ran}");
    let said = ran.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains(&format!("likely cause: another driver: the golden was drawn by {drawn}")), "{ran}");
}

#[test]
fn what_cannot_be_drawn_fails_and_the_others_are_checked() {
    let desk = desk();
    desk.write("dejag.toml", format!("{MANIFEST}\n[[capture]]\nscene = 'edges'\nmethod = 'msaa:samples=16'\nsize = '48x27'\n"));
    let ran = desk.run("check");
    if ran.code == Some(2) {
        // The method itself knows no 16 samples.
        assert!(ran.stderr.contains("edges-msaa-samples-16"), "{ran}");
    } else {
        assert_eq!(ran.code, Some(3), "{ran}");
        assert!(ran.stdout.contains("failed    edges-msaa-samples-16") && ran.stderr.contains("6 new, 1 failed"), "{ran}");
    }
    desk.write("dejag.toml", MANIFEST.replacen("size = '48x27'\nformat", "size = '99999x1'\nformat", 1));
    let ran = desk.run("check");
    assert_eq!(ran.code, Some(3), "{ran}");
    assert!(ran.stdout.contains("failed    light") && ran.stdout.contains("16384"), "{ran}");
    for (from, to, words) in [
        ("'edges'", "'edgse'", "did you mean 'edges'"),
        ("'taa'", "'tba'", "pan-tba: unknown method"),
        ("size = '48x27'\nformat", "frame = 99999\nformat", "light: "),
    ] {
        desk.write("dejag.toml", MANIFEST.replacen(from, to, 1));
        desk.refuses("check", 2, &[words]);
    }
    desk.write("dejag.toml", MANIFEST);
    desk.refuses("check --adapter nothing-of-that-name", 3, &["no adapter's name contains"]);
}

#[test]
fn scene_files_are_found_beside_the_manifest() {
    let desk = desk();
    desk.make_folder("ci");
    desk.write("ci/mine.toml", fs::read("scenes/edges.toml").expect("shipped"));
    desk.write("ci/dejag.toml", "[[capture]]\nscene = 'mine.toml'\nsize = '48x27'\n");
    assert_eq!(ids(&check(&desk, "--manifest ci/dejag.toml")), ["mine-none"]);
    assert!(desk.path("ci/dejag-check/candidates/mine-none.png").is_file());
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_goes_on_where_it_was() {
    let whole = desk();
    let expected = check(&whole, "");
    for signal in ["INT", "KILL"] {
        let desk = desk();
        // The last case takes long enough to be met in.
        desk.write("dejag.toml", MANIFEST.replace("'taa'", "'ssaa:spp=4096'"));
        let mut running = desk.start(desk.command("check"));
        let journal = desk.path("dejag-check/drawn.jsonl");
        running.until("three entries are drawn", |_| fs::read_to_string(&journal).is_ok_and(|text| text.lines().count() == 3));
        running.signal(signal);
        running.end();
        assert!(!desk.path("dejag-check/check.json").exists());
        let candidate = desk.path("dejag-check/candidates/edges-none.png");
        let drawn = fs::metadata(&candidate).expect("there").modified().expect("a time");
        desk.write("dejag.toml", MANIFEST);
        let resumed = check(&desk, "--resume");
        assert_eq!(fs::metadata(&candidate).expect("there").modified().expect("a time"), drawn, "it is not drawn again");
        let hashes = |results: &Value| {
            let cases = results["cases"].as_array().expect("cases").clone();
            cases.into_iter().map(|case| (case["id"].clone(), case["candidate_hash"].clone())).collect::<Vec<_>>()
        };
        assert_eq!(hashes(&resumed), hashes(&expected), "after {signal}");
        // What is damaged meanwhile is drawn again, and so is what another manifest asks for.
        desk.write("dejag-check/candidates/edges-none.png", "damaged");
        assert_eq!(hashes(&check(&desk, "--resume")), hashes(&expected));
        desk.write("dejag.toml", MANIFEST.replace("'none'", "'fxaa'"));
        assert_ne!(hashes(&check(&desk, "--resume"))[0].1, hashes(&expected)[0].1);
    }
}

#[test]
fn shards_of_what_is_drawn_are_the_whole_run() {
    let desk = desk();
    check(&desk, "");
    desk.run("bless").succeeded();
    let timeless = |mut results: Value| {
        results["cases"].as_array_mut().expect("cases").iter_mut().for_each(|case| {
            case.as_object_mut().expect("a case").remove("timing");
        });
        results
    };
    let whole = timeless(check(&desk, ""));
    for k in 1..=3 {
        desk.run(&format!("check -q --shard {k}/3 --costs dejag-check/check.json")).succeeded();
    }
    let merged = desk.run(
        "merge dejag-check/shard-1-of-3/check.json dejag-check/shard-2-of-3/check.json dejag-check/shard-3-of-3/check.json --json -",
    );
    assert_eq!(timeless(merged.succeeded().json()), whole);
}
