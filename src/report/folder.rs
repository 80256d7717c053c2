//! The folder that a report or frames live in: built beside its place, then put there whole.

use crate::picture::write_bytes_atomically;
use crate::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::{Builder, TempDir};

/// What a folder holds, and how it is marked as one that may be replaced.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contents {
    /// The file that marks it.
    marker: &'static str,
    /// What the file says.
    text: &'static [u8],
    /// In words.
    what: &'static str,
}

/// A report.
pub(super) const REPORT: Contents = Contents {
    marker: "dejag-report.txt",
    text: b"This folder is a report of dejag. Open index.html.\n\
        The next report to this place replaces the whole folder; keep nothing of your own in it.\n",
    what: "a report",
};

/// The frames of a sequence.
pub(super) const FRAMES: Contents = Contents {
    marker: "dejag-frames.txt",
    text: b"This folder holds frames that dejag drew, a folder for each method.\n\
        The next frames to this place replace the whole folder; keep nothing of your own in it.\n",
    what: "frames",
};

/// A folder that is being built. Dropped before [`Staging::publish`], it leaves nothing.
#[derive(Debug)]
pub(super) struct Staging {
    contents: Contents,
    target: PathBuf,
    folder: TempDir,
}

impl Staging {
    /// Begins a folder that is to become `target`, whose parents are created when it does. Refuses a target that holds something
    /// else.
    pub(super) fn begin(contents: Contents, target: &Path) -> Result<Self> {
        // A link keeps pointing where it did; what it points to is replaced.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_path_buf());
        contents.refuse_foreign(&target)?;
        let nearest = nearest_existing(&parent_of(&target)?);
        let folder = Builder::new().prefix(".dejag-report-").tempdir_in(&nearest).map_err(Error::io("write into", &nearest))?;
        write_bytes_atomically(&folder.path().join(contents.marker), contents.text)?;
        Ok(Self { contents, target, folder })
    }

    /// Where the folder is being built.
    pub(super) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Puts the folder in its place, and an older report out of it.
    pub(super) fn publish(self) -> Result<()> {
        self.contents.refuse_foreign(&self.target)?;
        let parent = parent_of(&self.target)?;
        fs::create_dir_all(&parent).map_err(Error::io("create the folder", &parent))?;
        // The old report's way back, should the new one not get in: it is deleted only after.
        let attic = Builder::new().prefix(".dejag-report-").tempdir_in(&parent).map_err(Error::io("write into", &parent))?;
        let old = attic.path().join("old");
        let replacing = self.target.exists();
        if replacing {
            fs::rename(&self.target, &old).map_err(Error::io("replace", &self.target))?;
        }
        let new = self.folder.keep();
        fs::rename(&new, &self.target).map_err(|error| {
            let _ = fs::remove_dir_all(&new);
            if replacing {
                let _ = fs::rename(&old, &self.target);
            }
            Error::io("write", &self.target)(error)
        })
    }
}

impl Contents {
    /// Anything but nothing, an empty folder or one of ours is somebody's, and not ours to replace.
    fn refuse_foreign(&self, target: &Path) -> Result<()> {
        let Ok(found) = fs::metadata(target) else { return Ok(()) };
        let Self { marker, what, .. } = self;
        let found = if !found.is_dir() {
            "is a file".to_owned()
        } else if target.join(marker).is_file() || is_empty(target)? {
            return Ok(());
        } else {
            format!("holds files that are not {what} of dejag")
        };
        let target = target.display();
        Err(Error::Request(format!(
            "{target} {found} and will not be replaced; name a new or empty folder, or clear it yourself"
        )))
    }
}

fn is_empty(folder: &Path) -> Result<bool> {
    Ok(fs::read_dir(folder).map_err(Error::io("read", folder))?.next().is_none())
}

fn parent_of(target: &Path) -> Result<PathBuf> {
    if target.file_name().is_none() {
        let target = target.display();
        return Err(Error::Request(format!("'{target}' names no folder that could be written; name a new folder")));
    }
    match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => Ok(parent.to_path_buf()),
        _ => Ok(PathBuf::from(".")),
    }
}

/// The folder that a path's missing folders will be made in: on the same file system, so that a rename can get there.
fn nearest_existing(path: &Path) -> PathBuf {
    let existing = path.ancestors().find(|folder| folder.exists());
    existing.unwrap_or(Path::new(".")).to_path_buf()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder");
        let mut names: Vec<String> = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into()).collect();
        names.sort();
        names
    }

    fn publish(target: &Path, file: &str) -> Result<()> {
        let staging = Staging::begin(REPORT, target)?;
        fs::write(staging.path().join(file), b"content").expect("written");
        staging.publish()
    }

    #[test]
    fn a_report_is_made_and_replaced_whole() {
        let home = tempfile::tempdir().expect("a folder");
        let target = home.path().join("deep/er/report");
        publish(&target, "first").expect("made");
        publish(&target, "second").expect("replaced");
        assert_eq!(names(&target), [REPORT.marker, "second"]);
        assert_eq!(names(target.parent().expect("a parent")), ["report"]);
    }

    #[test]
    fn what_is_dropped_leaves_nothing() {
        let home = tempfile::tempdir().expect("a folder");
        drop(Staging::begin(REPORT, &home.path().join("deep/er/report")).expect("begun"));
        assert!(names(home.path()).is_empty());
    }

    #[test]
    fn empty_folders_are_taken_and_others_refused() {
        let home = tempfile::tempdir().expect("a folder");
        let (empty, foreign, file) = (home.path().join("empty"), home.path().join("foreign"), home.path().join("file"));
        fs::create_dir(&empty).expect("made");
        fs::create_dir(&foreign).expect("made");
        fs::write(foreign.join("thesis.tex"), b"years of work").expect("written");
        fs::write(&file, b"").expect("written");
        publish(&empty, "new").expect("taken");
        for target in [&foreign, &file] {
            let error = publish(target, "new").expect_err("refused");
            assert!(matches!(error, Error::Request(_)), "{error:?}");
            assert!(error.to_string().contains("name a new or empty folder"), "{error}");
        }
        assert_eq!(names(&foreign), ["thesis.tex"]);
        assert_eq!(names(home.path()), ["empty", "file", "foreign"]);
    }

    #[test]
    fn a_folder_that_was_filled_meanwhile_is_refused() {
        let home = tempfile::tempdir().expect("a folder");
        let target = home.path().join("report");
        let staging = Staging::begin(REPORT, &target).expect("begun");
        fs::create_dir(&target).expect("made");
        fs::write(target.join("mine.txt"), b"").expect("written");
        assert!(staging.publish().is_err());
        assert_eq!(names(&target), ["mine.txt"]);
    }

    #[test]
    fn a_root_is_no_report() {
        assert!(matches!(Staging::begin(REPORT, Path::new("/")), Err(Error::Request(_))));
    }
}
