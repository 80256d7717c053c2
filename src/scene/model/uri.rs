//! What a model's URIs lead to: bytes written into the URI itself, or a file beside the model.

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::Failure;
use crate::error::{Error, Result};
use crate::scene::load;

/// Base64 with or without its padding: exporters write both.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &base64::alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// A buffer's or an image's bytes, and the file they came from.
pub(super) struct Resource {
    pub(super) bytes: Vec<u8>,
    pub(super) path: PathBuf,
}

/// Reads what a URI of the model at `model` leads to.
pub(super) fn read(model: &Path, uri: &str, limit: u64, expected: &'static str) -> Result<Resource> {
    if let Some(data) = uri.strip_prefix("data:") {
        return Ok(Resource { bytes: inline(model, data)?, path: model.to_path_buf() });
    }
    if let Some(scheme) = scheme(uri) {
        return Err(model.failure(format!("it leads to {scheme}: URIs; expected files beside the model or data: URIs")));
    }
    let path = beside(model, uri);
    let bytes = load::read(&path, limit, expected).map_err(|error| match error {
        // Who asks for a file that the user never named.
        Error::Io { path, source, .. } => Error::Io { action: "read what the model names,", path, source },
        other => other,
    })?;
    Ok(Resource { bytes, path })
}

fn inline(model: &Path, data: &str) -> Result<Vec<u8>> {
    let Some((head, body)) = data.split_once(',') else {
        return Err(model.failure("a data: URI has no comma; expected data:[type][;base64],content"));
    };
    if !head.ends_with(";base64") {
        return Ok(percent_decode(body));
    }
    BASE64.decode(body).map_err(|error| model.failure(format!("a data: URI is not base64: {error}")))
}

/// A scheme has at least two letters: one alone is a drive.
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let valid = scheme.len() > 1 && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c));
    valid.then_some(scheme)
}

/// The file a relative URI means: as a URI should be read, else as it stands, else with Windows' separators.
fn beside(model: &Path, uri: &str) -> PathBuf {
    let folder = model.parent().unwrap_or(Path::new(""));
    let decoded = String::from_utf8(percent_decode(uri)).unwrap_or_else(|_| uri.to_owned());
    let readings = [decoded.clone(), uri.to_owned(), decoded.replace('\\', "/")];
    readings.iter().map(|name| folder.join(name)).find(|path| path.is_file()).unwrap_or_else(|| folder.join(decoded))
}

/// Turns %XX into bytes; a % that begins no such group stays as it is.
fn percent_decode(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let digits = tail.get(..2).and_then(|digits| std::str::from_utf8(digits).ok()).filter(|_| first == b'%');
        match digits.filter(|digits| !digits.starts_with('+')).and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            None => {
                bytes.push(first);
                rest = tail;
            }
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percent_groups_are_decoded_and_stray_percents_kept() {
        assert_eq!(percent_decode("a%20b%C3%A9%2F"), "a bé/".as_bytes());
        for text in ["100%", "%", "%g1", "%+1", "%1", "é%é"] {
            assert_eq!(percent_decode(text), text.as_bytes());
        }
    }

    #[test]
    fn only_real_schemes_count_as_such() {
        assert_eq!(scheme("http://x/y.bin"), Some("http"));
        assert_eq!(scheme("file:///x"), Some("file"));
        for name in ["a.bin", "C:\\a.bin", "folder/a:b.bin", "a b:c"] {
            assert_eq!(scheme(name), None, "{name}");
        }
    }

    #[test]
    fn inline_data_may_lack_padding_and_may_be_plain() {
        let model = Path::new("m.gltf");
        for data in ["application/octet-stream;base64,AQID", ";base64,AQID", ",%01%02%03"] {
            assert_eq!(inline(model, data).unwrap(), [1, 2, 3], "{data}");
        }
        assert_eq!(inline(model, ";base64,AQ==").unwrap(), inline(model, ";base64,AQ").unwrap());
        for bad in ["", "base64", ";base64,!!", ";base64,A"] {
            assert!(inline(model, bad).is_err(), "{bad}");
        }
    }
}
