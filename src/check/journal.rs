//! What a run has drawn so far, so that an interrupted one can go on.
//!
//! A line of JSON for each entry that was drawn whole, appended as it is. A line that a killed process left half-written is no JSON
//! and counts for nothing; a picture whose bytes are not those of its line is drawn again.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::slot::{Slot, hash_of};
use crate::{Error, Result};

/// Its name in the output folder.
pub(super) const FILE: &str = "drawn.jsonl";

/// The journal of an output folder.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    kept: BTreeMap<String, Line>,
}

/// An entry that was drawn.
#[derive(Debug, Serialize, Deserialize)]
struct Line {
    entry: String,
    /// Stands for all that shapes its pictures.
    source: String,
    pictures: Vec<Drawn>,
}

/// A picture of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Drawn {
    pub(super) frame: Option<i64>,
    pub(super) hash: String,
}

impl Journal {
    /// Opens the journal of an output folder, which is made; an earlier one is begun anew unless it is to be gone on with.
    ///
    /// # Errors
    ///
    /// [`Error::Io`].
    pub fn open(output: &Path, resume: bool) -> Result<Self> {
        fs::create_dir_all(output).map_err(Error::io("create the folder", output))?;
        let path = output.join(FILE);
        let text = if resume { fs::read(&path).unwrap_or_default() } else { Vec::new() };
        let lines = text.split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice::<Line>(line).ok());
        let kept = lines.map(|line| (line.entry.clone(), line)).collect();
        let mut options = OpenOptions::new();
        options.create(true).append(resume).write(true).truncate(!resume);
        let mut file = options.open(&path).map_err(Error::io("write", &path))?;
        if text.last().is_some_and(|byte| *byte != b'\n') {
            file.write_all(b"\n").map_err(Error::io("write", &path))?;
        }
        Ok(Self { path, file, kept })
    }

    /// The pictures of an entry that was drawn from the same source and still are as they were.
    pub(super) fn pictures(&self, entry: &str, source: &str, output: &Path, extension: &str) -> Option<Vec<Drawn>> {
        let line = self.kept.get(entry).filter(|line| line.source == source)?;
        let whole = |drawn: &Drawn| {
            let path = output.join(Slot::drawn(entry, drawn.frame, extension).candidate());
            hash_of(&path).is_ok_and(|hash| hash == drawn.hash)
        };
        line.pictures.iter().all(whole).then(|| line.pictures.clone())
    }

    /// Notes an entry that was drawn whole.
    pub(super) fn keep(&mut self, entry: &str, source: &str, pictures: Vec<Drawn>) -> Result<()> {
        let line = Line { entry: entry.to_owned(), source: source.to_owned(), pictures };
        let text = serde_json::to_string(&line).expect("strings and numbers") + "\n";
        self.file.write_all(text.as_bytes()).map_err(Error::io("write", &self.path))
    }
}
