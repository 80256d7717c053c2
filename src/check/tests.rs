//! Manifests: what they mean, and what is said of those that mean nothing.

use std::path::Path;

use super::*;
use crate::Error;

fn parse(text: &str) -> Result<Manifest, Error> {
    Manifest::parse(Path::new("dejag.toml"), text.as_bytes())
}

fn refusal(text: &str) -> String {
    match parse(text) {
        Ok(manifest) => panic!("{:?}", manifest.entries),
        Err(error @ Error::Document { .. }) => error.to_string(),
        Err(other) => panic!("without a place: {other}"),
    }
}

const WHOLE: &str = r#"
goldens = "g"
output = "o"
fallback = ["llvmpipe-mesa-22.3.6"]

[tolerance]
max-pixels = "1%"
per-channel = "1/255"

[[override]]
environment = "llvmpipe-mesa-25*"
case = "edges-*"
tolerance = { max-flip = 0.5 }

[[capture]]
scene = ["edges", "my/wires.toml"]
method = ["none", "smaa:mode=s2x"]
size = "160x90"

[[capture]]
id = "ui/deep one"
scene = "text"
frame = 3
format = "png16"
tolerance = { max-pixels = 7 }
scope = { ignore = ["0,0,9,9"] }

[[sequence]]
scene = "pan"
method = "taa"
frames = "-1..2"

[[files]]
id = "shots"
folder = "out/shots"
exclude = ["wip/**"]
"#;

#[test]
fn a_manifest_is_read() {
    let manifest = parse(WHOLE).expect("it makes sense");
    let ids: Vec<&str> = manifest.entries.iter().map(|entry| entry.id.as_str()).collect();
    let expected = ["edges-none", "edges-smaa-mode-s2x", "wires-none", "wires-smaa-mode-s2x", "ui/deep one", "pan-taa", "shots"];
    assert_eq!(ids, expected);
    assert_eq!(manifest.entries[4].about(), "text with none, 640x360, frame 3");
    let flip = |id: &str, environment: &str| {
        let entry = manifest.entries.iter().find(|entry| entry.id == id).expect("there");
        manifest.tolerance(entry, id, environment, "linux-x86_64").max_flip
    };
    assert_eq!(flip("edges-none", "llvmpipe-mesa-25.0.7"), Some(0.5));
    assert_eq!(flip("edges-none", "llvmpipe-mesa-22.3.6"), None);
    assert_eq!(flip("wires-none", "llvmpipe-mesa-25.0.7"), None);
    let selected: Vec<&str> =
        manifest.select(&["ui".into(), "*-none".into()]).expect("there").iter().map(|entry| entry.id.as_str()).collect();
    assert_eq!(selected, ["edges-none", "wires-none", "ui/deep one"]);
    let unknown = manifest.select(&["edges-nome".into()]).expect_err("there is none").to_string();
    assert!(unknown.contains("did you mean 'edges-none'"), "{unknown}");
}

#[test]
fn what_makes_no_sense_is_refused_with_its_place() {
    let cases = [
        ("goldens = 3", "1:11"),
        ("golden = 'g'", "unknown field"),
        ("[[capture]]\nsize = '1x1'", "missing field `scene`"),
        ("[[capture]]\nscene = 'edges'\nsize = '0x9'", "3:8: '0x9' is no size"),
        ("[[capture]]\nscene = []", "2:9"),
        ("[[capture]]\nscene = 'edges'\nmethod = ['none', 'msaa']\nid = 'x'", "an `id` names one scene with one method"),
        ("[[capture]]\nscene = 'edges'\nformat = 'gif'", "3:10"),
        ("[[capture]]\nscene = 'edges'\n[[capture]]\nscene = 'edges'", "3:1: id 'edges-none' is taken"),
        ("[[capture]]\nscene = 'edges'\nid = 'a'\n[[capture]]\nscene = 'edges'\nid = 'a/b'", "lies below"),
        ("[[capture]]\nscene = 'edges'\nid = '../a'", "'../a' is no id"),
        ("[[capture]]\nscene = 'edges'\nid = 'a//b'", "is no id"),
        ("[[capture]]\nscene = 'edges'\nid = '/a'", "is no id"),
        ("[[capture]]\nscene = 'edges'\nid = \"a\\nb\"", "is no id"),
        ("fallback = ['../x']", "is no id"),
        ("[tolerance]\nmax-pixels = '101%'", "2:14: '101%' is no number of pixels"),
        ("[tolerance]\nmax-pixels = -1", "2:14: '-1' is no number of pixels"),
        ("[tolerance]\nmax-flip = nan", "2:12"),
        ("[tolerance]\nmax-flop = 1", "unknown field `max-flop`"),
        ("[[override]]\ncase = '['\ntolerance = {}", "2:8"),
        ("[[override]]\ncase = 'a'", "missing field `tolerance`"),
        ("[[sequence]]\nscene = 'pan'\nframes = '3..3'", "3:10: '3..3' are no frames"),
        ("[[sequence]]\nscene = 'pan'\nframes = '-9223372036854775808..9223372036854775807'", "are no frames"),
        ("[[sequence]]\nscene = 'pan'\nframes = '-9223372036854775808..-9223372036854775806'", "are no frames"),
        ("[[files]]\nid = 'x'\nfile = 'a.png'\n[[files]]\nid = 'x.png'\nfile = 'b'", "id 'x.png' is taken"),
        ("[[files]]\nid = 'x'\nfile = 'a'\n[[files]]\nid = 'X'\nfile = 'b'", "id 'X' is taken"),
        ("[[files]]\nid = 'x.candidate'\nfile = 'a.png'", "marks what is left"),
        ("goldens = ''", "must name a folder"),
        ("goldens = 'a'\noutput = 'a'", "another one than `output`"),
        ("[[files]]\nid = 'a'", "need either `file` or `folder`"),
        ("[[files]]\nid = 'a'\nfile = 'x'\nfolder = 'y'", "need either"),
        ("[[files]]\nid = 'a'\nfile = 'x'\ninclude = ['*.png']", "choose among the files"),
        ("[[files]]\nid = 'a'\nfolder = 'x'\ninclude = ['[']", "write a glob"),
        ("a = ", "1:5"),
    ];
    for (text, expected) in cases {
        let message = refusal(text);
        assert!(message.starts_with("dejag.toml:"), "{message}");
        assert!(message.contains(expected), "{text}\n{message}");
    }
    let error = Manifest::parse(Path::new("m"), b"# \xff").expect_err("no text").to_string();
    assert!(error.contains("m:1:3: it is not UTF-8"), "{error}");
}

/// 20,000 damaged manifests: none makes the reader panic, and each is refused with a place or read.
#[test]
fn damaged_manifests_are_refused_or_read() {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut refused = 0;
    for _ in 0..20_000 {
        let mut bytes = WHOLE.as_bytes().to_vec();
        for _ in 0..1 + random(4) {
            let at = random(bytes.len().max(1)).min(bytes.len() - 1);
            match random(5) {
                0 => bytes[at] = random(256) as u8,
                1 if bytes.len() > 1 => drop(bytes.remove(at)),
                2 => bytes.truncate(at.max(1)),
                3 => {
                    let end = (at + random(40)).min(bytes.len());
                    let piece = bytes[at..end].to_vec();
                    let to = random(bytes.len());
                    bytes.splice(to..to, piece);
                }
                _ => bytes[at] = b"0-9\"'[]{}=.,/%\n"[random(15)],
            }
        }
        match Manifest::parse(Path::new("m"), &bytes) {
            Ok(manifest) => assert!(manifest.entries.iter().all(|entry| !entry.id.contains(".."))),
            Err(Error::Document { .. }) => refused += 1,
            Err(other) => panic!("without a place: {other}"),
        }
    }
    assert!((1000..20_000).contains(&refused), "{refused}");
}
