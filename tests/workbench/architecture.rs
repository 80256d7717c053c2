//! Holds `src/` against the table of layers in ARCHITECTURE.md: what a module may import.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Module -> what it may import, from the table's rows `| module | responsibility | a, b |`.
fn layers() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md is there");
    let rows = text.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim().strip_prefix("| `")?.split('|').map(str::trim).collect();
        let [name, _, imports, ..] = cells[..] else { return None };
        let imports = imports.split(',').map(|i| i.trim().trim_matches('`').to_owned()).filter(|i| !i.is_empty());
        Some((name.trim_matches('`').to_owned(), imports.collect()))
    });
    rows.collect()
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// Top-level modules that a file names in `crate::module`, tests left out.
fn imports(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = BTreeSet::new();
    for line in code.lines().filter(|line| !line.trim_start().starts_with("//")) {
        for (at, _) in line.match_indices("crate::") {
            let rest = &line[at + "crate::".len()..];
            // `use crate::{a, b::C}` and `crate::a::B` alike.
            let names = match rest.strip_prefix('{') {
                Some(list) => list.split('}').next().unwrap_or_default().split(',').map(str::trim).collect(),
                None => vec![rest],
            };
            for name in names {
                let module: String = name.chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect();
                if !module.is_empty() && !name[module.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '!') {
                    found.insert(module);
                }
            }
        }
    }
    found
}

#[test]
fn modules_import_only_what_their_layer_may() {
    let layers = layers();
    assert!(layers.len() > 10, "the table is not read: {layers:?}");
    let source = root().join("src");
    let mut files = Vec::new();
    rust_files(&source, &mut files);
    let mut wrong = Vec::new();
    for file in &files {
        let inside = file.strip_prefix(&source).expect("below src");
        let module = inside.components().next().expect("a name").as_os_str().to_string_lossy().replace(".rs", "");
        if ["lib", "main"].contains(&module.as_str()) || file.ends_with("tests.rs") {
            continue;
        }
        let allowed = layers.get(&module).unwrap_or_else(|| panic!("ARCHITECTURE.md has no row for {module}"));
        for import in imports(&fs::read_to_string(file).expect("readable")) {
            if import != module && layers.contains_key(&import) && !allowed.contains(&import) {
                wrong.push(format!("{} imports {import}", inside.display()));
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
    assert!(files.len() > 50);
}

#[test]
fn imports_are_found() {
    let text = "use crate::error::Result;\nuse crate::{forward, gpu::Card};\n// crate::nothing\nlet x = crate::scene::Scene;\n#[cfg(test)]\nuse crate::cli;";
    assert_eq!(imports(text).into_iter().collect::<Vec<_>>(), ["error", "forward", "gpu", "scene"]);
}

#[test]
fn the_readme_names_every_method_with_its_options_and_every_scene() {
    let readme = fs::read_to_string(root().join("README.md")).expect("README.md is there");
    for method in dejag::methods::METHODS {
        let row = readme.lines().find(|line| line.starts_with(&format!("| `{}` |", method.name)));
        let row = row.unwrap_or_else(|| panic!("README.md has no row for {}", method.name));
        for option in method.options {
            assert!(row.contains(&format!("`{}`", option.name)), "README.md: {} without {}", method.name, option.name);
        }
    }
    for scene in dejag::scene::SHIPPED {
        assert!(readme.contains(&format!("`{}`", scene.name)), "README.md does not name {}", scene.name);
    }
}
