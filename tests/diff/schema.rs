//! What is printed as JSON, held against the published schemas.

use boon::{Compiler, Schemas};
use dejag::suite::{CheckResults, Golden, ShardStamp};
use serde_json::{Value, json};

use super::checks::{ALL, results};
use super::desk::{Desk, changed, levels, picture};

/// What is wrong with the value by `docs/schema/{name}.schema.json`.
pub(super) fn validate(name: &str, value: &Value) -> Result<(), String> {
    let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
    let path = format!("{}/docs/schema/{name}.schema.json", env!("CARGO_MANIFEST_DIR"));
    let schema = compiler.compile(&path, &mut schemas).unwrap_or_else(|error| panic!("{name}: {error:#}"));
    schemas.validate(value, schema).map_err(|error| format!("{error:#}"))
}

/// As a program that reads it sees it.
fn value(results: &CheckResults) -> Value {
    serde_json::from_str(&dejag::report::json(results)).expect("JSON")
}

/// A run that has whatever a run may have.
fn rich() -> CheckResults {
    let mut results = results(&ALL);
    let names = || vec!["a".to_owned(), "case".to_owned()];
    results.shard = Some(ShardStamp { index: 1, count: 2, dealt: names(), own: names() });
    results.unused_goldens = names();
    let case = &mut results.cases[1];
    case.golden = Some(Golden {
        environment: "llvmpipe".into(),
        hash: Some("a1".repeat(32)),
        provenance: [("adapter".to_owned(), "llvmpipe".to_owned())].into(),
    });
    case.candidate_hash = Some("0f".repeat(32));
    case.likely_causes = names();
    (case.pair.path, case.pair.lossy, case.pair.sizes) = (Some("a.png".into()), true, Some([[1, 2], [3, 4]]));
    results
}

#[test]
fn what_check_says_fits_its_schema() {
    for results in [results(&[]), results(&ALL), rich()] {
        assert_eq!(validate("check", &value(&results)), Ok(()));
    }
}

/// Each change of a sound value must be found.
fn refuses(name: &str, sound: &Value, changes: &[(&str, Value)]) {
    assert_eq!(validate(name, sound), Ok(()));
    for (place, wrong) in changes {
        let mut value = sound.clone();
        let (parent, key) = place.rsplit_once('/').expect("a place");
        value.pointer_mut(parent).unwrap_or_else(|| panic!("no {parent} in {sound:#}"))[key] = wrong.clone();
        assert!(validate(name, &value).is_err(), "{place} may be {wrong}");
    }
}

#[test]
fn what_does_not_fit_the_schema_of_check_is_found() {
    let changes = [
        ("/unknown", json!(1)),
        ("/schema_version", json!(2)),
        ("/manifest", json!("A1".repeat(32))),
        ("/counts/same", json!(-1)),
        ("/counts/other", json!(0)),
        ("/environment/stamp/gpu", json!("x")),
        ("/shard/index", json!(0)),
        ("/cases/0/unknown", json!(1)),
        ("/cases/0/outcome", json!("equal")),
        ("/cases/0/blessed_as", json!(null)),
        ("/cases/0/timing", json!({})),
        ("/cases/1/golden/hash", json!("a1")),
        ("/cases/1/candidate_hash", json!("0f".repeat(31))),
        ("/cases/1/golden/provenance/driver", json!(7)),
    ];
    refuses("check", &value(&rich()), &changes);
}

#[test]
fn what_does_not_fit_the_schema_of_diff_is_found() {
    let desk = Desk::new();
    desk.put("a.png", &picture(&levels()));
    desk.put("b.png", &changed(&[(3, 4, 0, 5)]));
    let (_, sound) = desk.json("a.png b.png --sweep --allow-edges");
    let changes = [
        ("/unknown", json!(1)),
        ("/pairs", json!({})),
        ("/skipped", json!("0")),
        ("/pairs/0/unknown", json!(1)),
        ("/pairs/0/id", json!("a key of check only")),
        ("/pairs/0/lossy", json!(false)),
        ("/pairs/0/outcome", json!("Same")),
        ("/pairs/0/pixels/differing", json!(1.5)),
        ("/pairs/0/pixels/bounds", json!([1, 2, 3])),
        ("/pairs/0/pixels/worst/bits", json!([8, 12])),
        ("/pairs/0/pixels/worst/expected", json!(["1"])),
        ("/pairs/0/classes/largest_objects", json!([{ "bounds": [0, 0, 1, 1] }])),
        ("/pairs/0/knobs/0/option", json!("--max-beauty")),
        ("/pairs/0/knobs/0/metric", json!("flip")),
        ("/pairs/0/knobs/0/value", json!("infinite")),
        ("/pairs/0/knobs/0/met", json!("yes")),
        ("/pairs/0/pictures", json!([1])),
    ];
    refuses("diff", &sound, &changes);
}
