//! Goldens that nobody holds anything against.

use std::path::{Path, PathBuf};

use super::entry::{Entry, Subject, slashed};
use super::environment::ANY;
use super::run::Run;
use super::slot::{Slot, is_candidate};
use crate::compare::{Filter, list_one};

impl Run<'_> {
    /// Goldens of the environments in use that no entry of the manifest has, relative to its folder.
    #[must_use]
    pub fn unused_goldens(&self) -> Vec<String> {
        let Ok(pictures) = Filter::new(&[], &[]) else { return Vec::new() };
        let mut unused = Vec::new();
        for key in [self.environment.key.as_str(), ANY] {
            let folder = self.manifest.goldens_of(key);
            if !folder.is_dir() {
                continue;
            }
            let (found, _) = list_one(&folder, &pictures);
            let used = |below: &PathBuf| is_candidate(below) || self.manifest.entries.iter().any(|entry| uses(entry, below));
            let unused_here = found.into_iter().filter(|below| !used(below));
            unused.extend(unused_here.map(|below| slashed(&self.manifest.goldens.join(key).join(below))));
        }
        unused.sort();
        unused.dedup();
        unused
    }
}

/// Whether a golden below an environment's folder is an entry's.
fn uses(entry: &Entry, below: &Path) -> bool {
    match &entry.subject {
        Subject::Capture(drawing, _) => below == Slot::drawn(&entry.id, None, drawing.format.extension()).below,
        Subject::File(path) => below == Slot::file(&entry.id, path).below,
        Subject::Folder(_, filter) => below.strip_prefix(&entry.id).is_ok_and(|inside| filter.takes(inside)),
        Subject::Sequence(drawing, frames) => {
            let inside = below.strip_prefix(&entry.id).ok();
            let name = inside.and_then(Path::to_str).and_then(|name| name.strip_suffix(drawing.format.extension()));
            let frame = name.and_then(|name| name.strip_suffix('.')).and_then(|name| name.parse::<i64>().ok());
            frame.is_some_and(|frame| frames.contains(&frame))
        }
    }
}
