//! Finding a scene by what the user calls it, and reading files without trusting them.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{SHIPPED, Scene, build, model};
use crate::error::{Error, Result, unknown};

/// A scene is written by hand; more than this is something else.
const LARGEST_SCENE_BYTES: u64 = 4 << 20;

/// A shipped scene by name, else a scene or a model by its path.
pub(super) fn load(what: &str) -> Result<Scene> {
    if let Some(shipped) = SHIPPED.iter().find(|shipped| shipped.name == what) {
        return build::scene(shipped.text, &format!("{}.toml", shipped.name), Path::new(""));
    }
    let path = Path::new(what);
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("toml") => scene_file(path, what),
        Some("gltf" | "glb") => model::scene(path),
        _ => Err(not_a_scene(what)),
    }
}

fn scene_file(path: &Path, name: &str) -> Result<Scene> {
    let bytes = read(path, LARGEST_SCENE_BYTES, "scene")?;
    let not_a_scene = |message: &str| Error::Format { path: path.to_path_buf(), expected: "scene", message: message.to_owned() };
    let text = std::str::from_utf8(&bytes).map_err(|_| not_a_scene("it is not UTF-8 text; expected TOML"))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.contains('\0') {
        return Err(not_a_scene("it holds NUL bytes; expected TOML text"));
    }
    if text.trim().is_empty() {
        return Err(not_a_scene("it is empty; expected TOML text"));
    }
    build::scene(text, name, path.parent().unwrap_or(Path::new("")))
}

/// The bytes of a regular file of at most `limit` bytes.
pub(super) fn read(path: &Path, limit: u64, expected: &'static str) -> Result<Vec<u8>> {
    // Before it is opened: a pipe waits there for somebody to write, and it or a device may never end.
    let metadata = std::fs::metadata(path).map_err(Error::io("read", path))?;
    if !metadata.is_file() {
        let kind = if metadata.is_dir() { std::io::ErrorKind::IsADirectory } else { std::io::ErrorKind::InvalidInput };
        let message = if metadata.is_dir() { "it is a folder; expected a file" } else { "it is not a regular file" };
        return Err(Error::io("read", path)(std::io::Error::new(kind, message)));
    }
    let file = File::open(path).map_err(Error::io("read", path))?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(Error::io("read", path))?;
    if bytes.len() as u64 > limit {
        return Err(Error::Format { path: path.to_path_buf(), expected, message: format!("it has more than {limit} bytes") });
    }
    Ok(bytes)
}

fn not_a_scene(what: &str) -> Error {
    let names: Vec<&str> = SHIPPED.iter().map(|shipped| shipped.name).collect();
    Error::Request(format!("{}; a path to a .toml, .gltf or .glb file works too", unknown("scene", what, &names)))
}
