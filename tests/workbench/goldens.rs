//! Did it change? The repository's own manifest, held against the goldens of the environment that draws here.

use std::path::PathBuf;
use std::process::Command;

use dejag::check::{Manifest, environment};
use dejag::suite::Stamp;

use crate::common;

#[test]
fn pictures_are_the_golden_ones() {
    let gpu = common::gpu();
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let manifest = Manifest::read(&root.join("dejag.toml")).expect("it makes sense");
    let here = environment(None, Some(Stamp::from(&gpu.card))).key;
    if !manifest.goldens_of(&here).is_dir() {
        common::not_applicable(&gpu, "golden pictures (there are none for this environment)");
        return;
    }
    let output = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_dejag"));
    command.args(["check", "--adapter", &gpu.card.name, "--output"]).arg(output.path()).current_dir(&root);
    let ran = command.output().expect("it runs");
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let words = format!("{}{}", said(&ran.stdout), said(&ran.stderr));
    assert_eq!(ran.status.code(), Some(0), "{words}\nlook at them: dejag check --report report; then: dejag bless");
    assert!(words.contains(&format!("{} same", manifest.entries.len())), "{words}");
}
