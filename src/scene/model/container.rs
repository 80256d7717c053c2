//! The outermost layer of a model: JSON text, or the binary container around it.

use std::path::Path;

use gltf::json;

use super::Failure;
use crate::error::{Error, Result};

/// Extensions of which everything that matters to a picture is drawn.
const SUPPORTED: &[&str] =
    &["KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_texture_transform", "KHR_mesh_quantization"];

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";

/// A model's JSON, and the bytes that came with it in one file.
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) binary: Option<&'a [u8]>,
}

/// Takes the binary container apart; anything else is taken for JSON.
pub(super) fn open<'a>(path: &Path, bytes: &'a [u8]) -> Result<Container<'a>> {
    if !bytes.starts_with(MAGIC) {
        return Ok(Container { json: bytes, binary: None });
    }
    let cut_short = || bad_bytes(path, "the file is cut short".into());
    let version = u32_at(bytes, 4).ok_or_else(cut_short)?;
    if version != 2 {
        return Err(path.failure(format!("it is binary glTF version {version}; expected 2")));
    }
    let length = u32_at(bytes, 8).ok_or_else(cut_short)? as usize;
    let body = bytes.get(12..length).ok_or_else(cut_short)?;
    let (kind, json, rest) = chunk(body).ok_or_else(cut_short)?;
    if kind != JSON_CHUNK {
        return Err(bad_bytes(path, "its first chunk is not JSON".into()));
    }
    let binary = match chunk(rest) {
        Some((BINARY_CHUNK, binary, _)) => Some(binary),
        // Chunks of other kinds are to be skipped.
        Some(_) => None,
        None if rest.is_empty() => None,
        None => return Err(cut_short()),
    };
    Ok(Container { json, binary })
}

/// The first chunk's kind and content, and what follows it.
fn chunk(bytes: &[u8]) -> Option<(&[u8], &[u8], &[u8])> {
    let end = (u32_at(bytes, 0)? as usize).checked_add(8)?;
    Some((bytes.get(4..8)?, bytes.get(8..end)?, bytes.get(end..)?))
}

fn u32_at(bytes: &[u8], offset: usize) -> Option<u32> {
    let bytes = bytes.get(offset..)?.first_chunk::<4>()?;
    Some(u32::from_le_bytes(*bytes))
}

/// The JSON as glTF's structures, once it has been seen that nothing is required of us that we lack.
pub(super) fn parse(path: &Path, bytes: &[u8], warnings: &mut Vec<String>) -> Result<json::Root> {
    let root: json::Root = json::deserialize::from_slice(bytes).map_err(|error| match error.to_string() {
        text if error.is_data() => path.failure(format!("it is not glTF 2.0: {text}")),
        // Good JSON, but more than the reader's 32 bits hold.
        text if text.starts_with("number out of range") => path.failure(format!("a number is not finite: {text}")),
        text => bad_bytes(path, text),
    })?;
    let version = &root.asset.version;
    if version.split('.').next() != Some("2") {
        return Err(path.failure(format!("it is glTF version {version}; expected 2.0")));
    }
    if let Some(name) = root.extensions_required.iter().find(|name| !SUPPORTED.contains(&name.as_str())) {
        return Err(path.failure(format!("it requires the extension {name}; supported are {}", SUPPORTED.join(", "))));
    }
    let ignored: Vec<&str> = root.extensions_used.iter().map(String::as_str).filter(|name| !SUPPORTED.contains(name)).collect();
    if !ignored.is_empty() {
        warnings.push(format!("extensions that are left out: {}", ignored.join(", ")));
    }
    Ok(root)
}

fn bad_bytes(path: &Path, message: String) -> Error {
    Error::Format { path: path.to_path_buf(), expected: "glTF model", message }
}
