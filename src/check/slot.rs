//! The files of one picture of a case: candidate, golden, heat map.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io;
use std::path::{Component, Path, PathBuf};

use super::entry::slashed;
use super::{Manifest, chain};
use crate::picture::{texts, write_atomically};
use crate::suite::Golden;
use crate::{Error, Result};

/// Folder of candidates below the output folder.
pub(super) const CANDIDATES: &str = "candidates";

/// Folder of heat maps below the output folder.
pub(super) const DIFFERENCES: &str = "differences";

/// What stands in the name of a candidate that lies where its golden is missing.
pub(super) const CANDIDATE_MARK: &str = ".candidate.";

/// A picture of a case, by name.
#[derive(Debug, Clone)]
pub(super) struct Slot {
    /// Unique in the run.
    pub(super) id: String,
    /// Its file, below any folder of goldens or candidates.
    pub(super) below: PathBuf,
}

/// A golden that was found.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) golden: Golden,
    pub(super) path: PathBuf,
}

impl Slot {
    /// What is drawn: the entry itself, or a frame of it.
    pub(super) fn drawn(entry: &str, frame: Option<i64>, extension: &str) -> Self {
        let id = frame.map_or_else(|| entry.to_owned(), |frame| format!("{entry}/{frame:05}"));
        let below = PathBuf::from(format!("{id}.{extension}"));
        Self { id, below }
    }

    /// A file that an entry names.
    pub(super) fn file(entry: &str, file: &Path) -> Self {
        let mut name = std::ffi::OsString::from(entry);
        if let Some(extension) = file.extension() {
            name.push(".");
            name.push(extension);
        }
        Self { id: entry.to_owned(), below: name.into() }
    }

    /// A file below the folder of an entry.
    pub(super) fn in_folder(entry: &str, below: &Path) -> Self {
        let below = Path::new(entry).join(below);
        Self { id: slashed(&below), below }
    }

    /// Below the output folder.
    pub(super) fn candidate(&self) -> PathBuf {
        Path::new(CANDIDATES).join(&self.below)
    }

    /// Below the output folder.
    pub(super) fn heat(&self) -> PathBuf {
        let mut name = Path::new(DIFFERENCES).join(&self.below).into_os_string();
        name.push(".heat.png");
        name.into()
    }

    /// Below the manifest's folder.
    pub(super) fn blessed(&self, manifest: &Manifest, environment: &str) -> PathBuf {
        manifest.goldens.join(environment).join(&self.below)
    }

    /// The nearest golden in the chain, whether it can be read or not. A link that leads nowhere is one that cannot.
    pub(super) fn golden(&self, manifest: &Manifest, environment: &str) -> Option<Found> {
        let levels = chain(environment, &manifest.fallback);
        levels.into_iter().find_map(|environment| {
            let path = manifest.root.join(self.blessed(manifest, &environment));
            // An unreadable folder hides whether there is one; taking it for missing would let it be replaced.
            match fs::symlink_metadata(&path) {
                Err(error) if is_absence(&error) => return None,
                _ => {}
            }
            let provenance = if path.is_file() { texts(&path) } else { BTreeMap::new() };
            Some(Found { golden: Golden { environment, hash: hash_of(&path).ok(), provenance }, path })
        })
    }
}

pub(super) fn is_absence(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}

/// Whether a path that results name stays below the folder that it is relative to.
pub(super) fn is_below(path: &Path) -> bool {
    path.components().all(|part| matches!(part, Component::Normal(_))) && path.file_name().is_some()
}

/// Whether a file is a candidate that was left where its golden is missing.
pub(super) fn is_candidate(below: &Path) -> bool {
    below.file_name().is_some_and(|name| name.to_string_lossy().contains(CANDIDATE_MARK))
}

/// `edges.candidate.png` beside `edges.png`.
pub(super) fn beside(golden: &Path) -> PathBuf {
    let stem = golden.file_stem().unwrap_or_default();
    let extension = golden.extension().unwrap_or_default();
    let mut name = stem.to_os_string();
    name.push(CANDIDATE_MARK);
    name.push(extension);
    golden.with_file_name(name)
}

/// BLAKE3 of a file's bytes, in hexadecimal.
///
/// # Errors
///
/// [`Error::Io`].
pub(super) fn hash_of(path: &Path) -> Result<String> {
    length_of(path)?;
    let mut hasher = blake3::Hasher::new();
    let file = File::open(path).map_err(Error::io("read", path))?;
    hasher.update_reader(file).map_err(Error::io("read", path))?;
    Ok(hasher.finalize().to_hex().to_string())
}

/// Bytes of a file. Refuses pipes and the like: opening one would wait for whoever writes into it.
pub(super) fn length_of(path: &Path) -> Result<u64> {
    let what = fs::metadata(path).map_err(Error::io("read", path))?;
    if what.is_file() {
        return Ok(what.len());
    }
    let why = if what.is_dir() {
        io::ErrorKind::IsADirectory.into()
    } else {
        io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file")
    };
    Err(Error::io("read", path)(why))
}

/// Copies a file, whole or not at all, into folders that are made.
pub(super) fn copy(from: &Path, to: &Path) -> Result<()> {
    length_of(from)?;
    make_folder_of(to)?;
    let mut source = File::open(from).map_err(Error::io("read", from))?;
    write_atomically(to, |file| io::copy(&mut source, file).map(drop))
}

pub(super) fn make_folder_of(path: &Path) -> Result<()> {
    path.parent().map_or(Ok(()), |folder| fs::create_dir_all(folder).map_err(Error::io("create the folder", folder)))
}
