//! Damaged scene files: whatever the text, an answer and never a panic; an error says where.

use std::path::Path;

use proptest::prelude::*;

use super::{Frame, SHIPPED, Scene};
use crate::error::Error;

/// Whether a renderer could draw it: nothing in it is infinite or no number, nothing points nowhere.
pub(super) fn assert_drawable(scene: &Scene, frame: &Frame) {
    assert!(frame.view.position.is_finite() && frame.view.world_from_view.is_finite());
    assert!(scene.background.is_finite() && scene.exposure.is_finite() && scene.light.color.is_finite());
    for instance in &frame.instances {
        assert!(instance.material < scene.materials.len());
        assert!(instance.world_from_object.is_finite() && instance.previous_world_from_object.is_finite());
        assert!(instance.mesh.indices.iter().all(|&index| (index as usize) < instance.mesh.vertices.len()));
        for vertex in &instance.mesh.vertices {
            assert!(vertex.position.is_finite() && vertex.normal.is_finite() && vertex.tangent.is_finite());
            assert!(vertex.uv.is_finite() && vertex.color.is_finite());
        }
    }
}

fn survive(text: &str) {
    match Scene::parse(text, "s.toml", Path::new("")) {
        Ok(scene) => {
            for index in [0, scene.frames - 1] {
                assert_drawable(&scene, &scene.frame(index, [16, 9]).unwrap());
            }
        }
        Err(Error::Document { line, column, message, .. }) => {
            assert!((1..=text.lines().count() + 1).contains(&line), "line {line}: {message}");
            let length = text.split('\n').nth(line - 1).map_or(0, |line| line.chars().count());
            assert!((1..=length + 1).contains(&column), "column {column} of {length}: {message}");
            assert!(!message.trim().is_empty());
        }
        // A path that was made up by a damage.
        Err(Error::Io { .. }) => {}
        Err(other) => panic!("an error without a place: {other:?}\n{text}"),
    }
}

/// What may be done to a scene's text, at a part of its length.
#[derive(Debug, Clone)]
enum Damage {
    Truncate,
    Replace(char),
    Remove(usize),
    Repeat(usize),
    Number(&'static str),
}

const NUMBERS: [&str; 14] =
    ["nan", "-nan", "inf", "-inf", "0", "-1", "-0.0", "1e300", "1e-300", "1e9", "0.5", "65536", "99999999999999999999", "\"1\""];

fn damages() -> impl Strategy<Value = Vec<(f64, Damage)>> {
    let damage = prop_oneof![
        1 => Just(Damage::Truncate),
        3 => any::<char>().prop_map(Damage::Replace),
        2 => (1_usize..40).prop_map(Damage::Remove),
        2 => (1_usize..200).prop_map(Damage::Repeat),
        8 => (0..NUMBERS.len()).prop_map(|k| Damage::Number(NUMBERS[k])),
    ];
    proptest::collection::vec((0.0..1.0, damage), 1..4)
}

fn apply(text: &str, part: f64, damage: &Damage) -> String {
    let at = text.floor_char_boundary((part * text.len() as f64) as usize);
    let (before, after) = text.split_at(at);
    let skip = |count: usize| after.char_indices().nth(count).map_or("", |(index, _)| &after[index..]);
    match *damage {
        Damage::Truncate => before.to_owned(),
        Damage::Replace(c) => format!("{before}{c}{}", skip(1)),
        Damage::Remove(count) => format!("{before}{}", skip(count)),
        Damage::Repeat(count) => format!("{before}{}{after}", &after[..after.len() - skip(count).len()]),
        Damage::Number(number) => {
            let Some(first) = after.find(|c: char| c.is_ascii_digit()) else { return text.to_owned() };
            let start = if after[..first].ends_with('-') { first - 1 } else { first };
            let length = after[first..].find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(after.len() - first);
            format!("{before}{}{number}{}", &after[..start], &after[first + length..])
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_text_never_panics(text in "\\PC{0,200}") {
        survive(&text);
    }

    #[test]
    fn arbitrary_toml_never_panics(
        keys in proptest::collection::vec(
            ("(name|frames|camera|light|ambient|objects|materials|shape|[a-z]{1,4})", "(=|= \\[|= \\{|\\.)", "([0-9.-]{1,4}|nan|'x'|true|\\]|\\}|\n)"),
            0..12,
        ),
        header in "(|\\[camera\\]|\\[\\[objects\\]\\]|\\[materials.a\\])",
    ) {
        let lines: Vec<String> = keys.iter().map(|(key, sign, value)| format!("{key} {sign} {value}")).collect();
        survive(&format!("{header}\n{}", lines.join("\n")));
    }

    #[test]
    fn damaged_scenes_never_panic(which in 0..SHIPPED.len(), damages in damages()) {
        let text = damages.iter().fold(SHIPPED[which].text.to_owned(), |text, (part, damage)| apply(&text, *part, damage));
        survive(&text);
    }
}
