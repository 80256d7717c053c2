//! Damaged models: whatever the bytes, an answer and never a panic.

use std::path::Path;

use proptest::prelude::*;

use super::sample::Sample;
use crate::scene::fuzz::assert_drawable;
use crate::scene::{Scene, load};

/// Loads what stands in a file and looks at a few frames of it.
fn survive(bytes: &[u8], path: &Path) {
    std::fs::write(path, bytes).unwrap();
    if let Ok(scene) = Scene::load(path.to_str().unwrap()) {
        for index in [0, scene.frames - 1] {
            assert_drawable(&scene, &scene.frame(index, [16, 9]).unwrap());
        }
    }
}

fn samples() -> [Sample; 3] {
    let mut everything = Sample::textured();
    everything.indices(&[0, 1, 2]);
    everything.json["meshes"][0]["primitives"][0]["mode"] = serde_json::json!(5);
    [Sample::textured(), Sample::animated(), everything]
}

/// A damage to bytes: where (as a part of the length), and what.
fn damages() -> impl Strategy<Value = Vec<(f64, u8)>> {
    proptest::collection::vec((0.0..1.0, any::<u8>()), 1..4)
}

/// Numbers that hurt.
const NUMBERS: [&str; 12] =
    ["-1", "0", "1", "2", "255", "65536", "4294967295", "18446744073709551615", "1e39", "-1e300", "0.5", "null"];

/// Replaces the number that follows the given part of a JSON text.
fn replace_number(text: &str, part: f64, number: &str) -> String {
    let start = (part * text.len() as f64) as usize;
    let is_number = |c: char| c.is_ascii_digit() || c == '-' || c == '.';
    let Some(first) = text[start..].find(|c: char| c.is_ascii_digit()).map(|at| at + start) else { return text.to_owned() };
    let end = text[first..].find(|c| !is_number(c)).map_or(text.len(), |at| at + first);
    format!("{}{number}{}", &text[..first], &text[end..])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_containers_never_panic(which in 0_usize..3, damages in damages(), cut in proptest::option::weighted(0.2, 0.0..1.0)) {
        let mut bytes = samples()[which].glb();
        let length = bytes.len() as f64;
        for (part, value) in damages {
            bytes[(part * length) as usize] = value;
        }
        if let Some(part) = cut {
            bytes.truncate((part * length) as usize);
        }
        let folder = tempfile::tempdir().unwrap();
        survive(&bytes, &folder.path().join("m.glb"));
    }

    #[test]
    fn damaged_buffers_never_panic(which in 0_usize..3, damages in damages()) {
        let mut sample = samples().into_iter().nth(which).unwrap();
        let length = sample.binary.len() as f64;
        for (part, value) in damages {
            sample.binary[(part * length) as usize] = value;
        }
        let folder = tempfile::tempdir().unwrap();
        survive(&sample.glb(), &folder.path().join("m.glb"));
    }

    #[test]
    fn json_with_other_numbers_never_panics(which in 0_usize..3, changes in proptest::collection::vec((0.0..1.0, 0_usize..12), 1..3)) {
        let sample = &samples()[which];
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("b.bin"), &sample.binary).unwrap();
        let mut json = sample.json.clone();
        json["buffers"][0] = serde_json::json!({ "uri": "b.bin", "byteLength": sample.binary.len() });
        let mut text = serde_json::to_string(&json).unwrap();
        for (part, number) in changes {
            text = replace_number(&text, part, NUMBERS[number]);
        }
        survive(text.as_bytes(), &folder.path().join("m.gltf"));
    }

    #[test]
    fn arbitrary_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200), binary: bool) {
        let folder = tempfile::tempdir().unwrap();
        let bytes = if binary { [&b"glTF\x02\0\0\0"[..], &bytes].concat() } else { bytes };
        survive(&bytes, &folder.path().join("m.glb"));
    }
}

#[test]
fn reading_stops_at_its_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long");
    std::fs::write(&path, [0; 100]).unwrap();
    assert!(load::read(&path, 100, "test").is_ok());
    assert!(load::read(&path, 99, "test").unwrap_err().to_string().contains("more than 99 bytes"));
}
