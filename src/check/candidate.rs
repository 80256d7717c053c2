//! Candidates: pictures that are drawn or taken over, in the output folder, with words on their making.

use std::fs;
use std::io::{self, Read as _};
use std::path::Path;

use super::entry::{Drawing, Entry, Format, Subject, slashed};
use super::journal::Drawn;
use super::run::Run;
use super::slot::{CANDIDATE_MARK, Slot, copy, hash_of, is_candidate, length_of, make_folder_of};
use crate::picture::{Loaded, texts, with_png_texts, write_bytes_atomically};
use crate::suite::{Environment, Stamp};
use crate::{Error, Result};

impl Run<'_> {
    /// Writes what was drawn for an entry to the candidates.
    pub(super) fn store(&self, entry: &Entry, drawing: &Drawing, frame: Option<i64>, picture: &Loaded) -> Result<Drawn> {
        let slot = Slot::drawn(&entry.id, frame, drawing.format.extension());
        let path = self.output.join(slot.candidate());
        make_folder_of(&path)?;
        let which = frame.or(match entry.subject {
            Subject::Capture(_, frame) => Some(frame.into()),
            _ => None,
        });
        let (provenance, frame_text) = (self.provenance(entry), which.map(|frame| frame.to_string()));
        let mut words: Vec<(&str, &str)> = provenance.iter().map(|(key, value)| (*key, value.as_str())).collect();
        words.extend([("scene", drawing.scene.as_str()), ("method", drawing.method.as_str())]);
        words.extend(frame_text.as_deref().map(|frame| ("frame", frame)));
        match drawing.format {
            Format::Exr => picture.clone().into_linear().save_exr(&path, &words)?,
            Format::Png | Format::Png16 => picture.clone().into_display().save_png(&path, drawing.format.depth(), &words)?,
        }
        Ok(Drawn { frame, hash: hash_of(&path)? })
    }

    /// What a candidate's file says of its making. Of what something else made we know only where it was checked.
    pub(super) fn provenance(&self, entry: &Entry) -> Vec<(&'static str, String)> {
        let Environment { platform, stamp, .. } = self.environment;
        let mut words = vec![("Software", format!("dejag {}", env!("CARGO_PKG_VERSION")))];
        words.extend([("environment", self.key(entry).to_owned()), ("platform", platform.clone())]);
        if let Some(Stamp { adapter, kind, driver, driver_version, backend, .. }) =
            stamp.as_ref().filter(|_| entry.drawing().is_some())
        {
            words.push(("adapter", format!("{adapter} ({kind}; {driver} {driver_version}; {backend})")));
        }
        words.push((
            "command",
            format!("dejag check '{}' --manifest '{}'", entry.id, slashed(&self.manifest.path).replace('\'', r"'\''")),
        ));
        words
    }

    /// Copies a file to the candidates, a PNG with words on where it was checked; words that it has already stay.
    pub(super) fn take_over(&self, entry: &Entry, slot: &Slot, source: &Path) -> Result<()> {
        if is_candidate(&slot.below) {
            let why = io::Error::other(format!(
                "'{CANDIDATE_MARK}' in its name marks what is left where a golden is missing; rename it"
            ));
            return Err(Error::io("take", source)(why));
        }
        let target = self.output.join(slot.candidate());
        let length = length_of(source)?;
        if length > self.max_bytes || !starts_like_png(source) {
            return copy(source, &target);
        }
        let bytes = fs::read(source).map_err(Error::io("read", source))?;
        let (known, provenance) = (texts(source), self.provenance(entry));
        let new = provenance.iter().filter(|(key, _)| !known.contains_key(*key));
        let new: Vec<(&str, &str)> = new.map(|(key, value)| (*key, value.as_str())).collect();
        make_folder_of(&target)?;
        write_bytes_atomically(&target, &with_png_texts(&bytes, &new).unwrap_or(bytes))
    }
}

fn starts_like_png(path: &Path) -> bool {
    let mut head = [0; 8];
    fs::File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok_and(|()| head == *b"\x89PNG\r\n\x1a\n")
}
