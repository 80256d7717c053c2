//! Words in picture files: what made them, beside the pixels.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use super::save::{add_text, png_failure};
use super::{FileKind, Metadata, load};
use crate::{Error, Result};

/// Signature and header of a PNG, which every other chunk follows.
const PNG_HEAD_BYTES: usize = 33;

/// Largest text that is read, in bytes: more is no provenance.
const MAX_TEXT_BYTES: usize = 1 << 16;

/// The words that [`super::DisplayPicture::save_png`] and [`super::LinearPicture::save_exr`] write beside the pixels. Of other formats, and
/// of files that cannot be read, there are none.
#[must_use]
pub fn texts(path: &Path) -> BTreeMap<String, String> {
    let found = load::open(path, |_, kind| Ok(kind)).ok().and_then(|kind| match kind {
        FileKind::Png => png_texts(path),
        FileKind::Exr => exr_texts(path),
        _ => None,
    });
    found.unwrap_or_default()
}

fn png_texts(path: &Path) -> Option<BTreeMap<String, String>> {
    let limits = png::Limits { bytes: 1 << 24 };
    let reader = png::Decoder::new_with_limits(BufReader::new(File::open(path).ok()?), limits).read_info().ok()?;
    let info = reader.info();
    let latin = info.uncompressed_latin1_text.iter().map(|chunk| (chunk.keyword.clone(), Some(chunk.text.clone())));
    let unicode = info.utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().ok()));
    Some(latin.chain(unicode).filter_map(|(key, text)| Some((key, text.filter(|text| text.len() <= MAX_TEXT_BYTES)?))).collect())
}

fn exr_texts(path: &Path) -> Option<BTreeMap<String, String>> {
    let meta = exr::meta::MetaData::read_from_file(path, false).ok()?;
    let comments = meta.headers.first()?.own_attributes.comments.as_ref()?.to_string();
    let lines = comments.lines().filter_map(|line| line.split_once(": "));
    Some(lines.map(|(key, value)| (key.to_owned(), value.to_owned())).collect())
}

/// A PNG's bytes with more words in them, the pixels untouched. Of keys that it has already the first holds.
///
/// # Errors
///
/// [`Error::Request`] for a key that PNG does not allow, or bytes too few for a PNG.
pub fn with_png_texts(png: &[u8], metadata: Metadata<'_>) -> Result<Vec<u8>> {
    let chunks = text_chunks(metadata).map_err(|error| Error::Request(format!("words for a PNG: {error}")))?;
    let (head, rest) = png.split_at_checked(PNG_HEAD_BYTES).ok_or_else(|| Error::Request("these bytes are no PNG".into()))?;
    Ok([head, &chunks, rest].concat())
}

/// The chunks as the encoder writes them, which knows their checksums.
fn text_chunks(metadata: Metadata<'_>) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    for &(key, value) in metadata {
        add_text(&mut encoder, key, value).map_err(png_failure)?;
    }
    // Dropped without pixels, the writer ends the file, so that only chunks of text are kept.
    drop(encoder.write_header().map_err(png_failure)?);
    Ok(Chunks(&bytes[PNG_HEAD_BYTES..]).filter(|chunk| matches!(&chunk[4..8], b"tEXt" | b"iTXt")).flatten().copied().collect())
}

/// Chunks of a PNG, each with its length, name and checksum.
struct Chunks<'a>(&'a [u8]);

impl<'a> Iterator for Chunks<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let length = u32::from_be_bytes(*self.0.first_chunk()?) as usize;
        let (chunk, rest) = self.0.split_at_checked(12 + length)?;
        self.0 = rest;
        Some(chunk)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{BitDepth, DisplayPicture, load, write_bytes_atomically};
    use super::*;

    #[test]
    fn words_are_found_again_and_added_without_touching_pixels() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        let picture = DisplayPicture::from_fn(5, 3, |x, y| [x as f32 / 5.0, y as f32 / 3.0, 0.0, 1.0]).expect("fits");
        picture.save_png(&path, BitDepth::Eight, &[("Software", "first"), ("umlaut", "über")]).expect("written");
        assert_eq!(texts(&path)["umlaut"], "über");
        let before = load(&path).expect("reads");

        let bytes = std::fs::read(&path).expect("reads");
        let more = with_png_texts(&bytes, &[("environment", "IDAT any"), ("command", "check --µ")]).expect("added");
        write_bytes_atomically(&path, &more).expect("written");
        assert_eq!(load(&path).expect("reads"), before);
        let all = texts(&path);
        let found = ["Software", "environment", "command"].map(|key| all[key].as_str());
        assert_eq!(found, ["first", "IDAT any", "check --µ"]);
    }

    #[test]
    fn words_of_an_exr() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.exr");
        let picture = DisplayPicture::from_fn(5, 3, |_, _| [0.5; 4]).expect("fits").to_linear();
        picture.save_exr(&path, &[("environment", "any: where"), ("case", "x")]).expect("written");
        assert_eq!((texts(&path)["environment"].as_str(), texts(&path)["case"].as_str()), ("any: where", "x"));
    }

    #[test]
    fn files_without_words_have_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        assert!(texts(&path).is_empty());
        std::fs::write(&path, b"\x89PNG\r\n\x1a\n and nothing more").expect("written");
        assert!(texts(&path).is_empty());
        assert!(with_png_texts(b"short", &[]).is_err());
        assert!(with_png_texts(&[0; 40], &[("", "no key")]).is_err());
    }
}
