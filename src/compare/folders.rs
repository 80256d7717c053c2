//! Two folders, matched by the paths below them.

use crate::picture::FileKind;
use crate::{Error, Result};
use globset::{Glob, GlobSet, GlobSetBuilder};
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Which files of a folder are taken.
#[derive(Debug, Clone)]
pub struct Filter {
    /// None if those are taken whose names end like a picture's.
    include: Option<GlobSet>,
    exclude: GlobSet,
}

impl Filter {
    /// Of globs for paths below the folders: what any of `include` matches, or without one what is named like a picture, but
    /// nothing that any of `exclude` does. A `*` reaches across folders.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] for what is no glob.
    pub fn new(include: &[String], exclude: &[String]) -> Result<Self> {
        Ok(Self { include: (!include.is_empty()).then(|| globs(include)).transpose()?, exclude: globs(exclude)? })
    }

    /// Whether it takes a path below a folder.
    #[must_use]
    pub fn takes(&self, path: &Path) -> bool {
        let wanted = self.include.as_ref().map_or_else(|| FileKind::is_readable_name(path), |globs| globs.is_match(path));
        wanted && !self.exclude.is_match(path)
    }
}

fn globs(patterns: &[String]) -> Result<GlobSet> {
    let refused = |error: globset::Error| Error::Request(format!("{error}; write a glob such as '*.png' or 'ui/**'"));
    let mut set = GlobSetBuilder::new();
    for pattern in patterns {
        set.add(Glob::new(pattern).map_err(refused)?);
    }
    set.build().map_err(refused)
}

/// What two folders hold.
#[derive(Debug, Default)]
pub struct Listing {
    /// In the order of their paths.
    pub pairs: Vec<PathPair>,
    /// Files that were not taken.
    pub skipped: u64,
    /// Folders that could not be read.
    pub failures: Vec<Error>,
}

/// A path below two folders.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PathPair {
    /// Below the folders.
    pub path: PathBuf,
    /// The file in the first folder, if it is there.
    pub expected: Option<PathBuf>,
    /// The file in the second folder, if it is there.
    pub actual: Option<PathBuf>,
}

/// Lists both folders with all below them. Links to files are taken, links to folders are not followed: they may lead in a circle.
#[must_use]
pub fn list(expected: &Path, actual: &Path, filter: &Filter) -> Listing {
    let mut listing = Listing::default();
    let mut found: BTreeMap<PathBuf, PathPair> = BTreeMap::new();
    for (side, root) in [expected, actual].into_iter().enumerate() {
        for path in listing.files(root) {
            let below = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
            if !filter.takes(&below) {
                listing.skipped += 1;
                continue;
            }
            let pair = found.entry(below.clone()).or_insert(PathPair { path: below, expected: None, actual: None });
            *(if side == 0 { &mut pair.expected } else { &mut pair.actual }) = Some(path);
        }
    }
    listing.pairs = found.into_values().collect();
    listing
}

/// Paths below a folder that the filter takes, in order, and folders in it that could not be read. As [`list`].
#[must_use]
pub fn list_one(root: &Path, filter: &Filter) -> (Vec<PathBuf>, Vec<Error>) {
    let mut listing = Listing::default();
    let below = |path: &PathBuf| path.strip_prefix(root).unwrap_or(path).to_path_buf();
    let mut paths: Vec<PathBuf> = listing.files(root).iter().map(below).filter(|path| filter.takes(path)).collect();
    paths.sort();
    (paths, listing.failures)
}

impl Listing {
    /// Whatever below `root` is no folder and no link to one.
    fn files(&mut self, root: &Path) -> Vec<PathBuf> {
        let mut files = Vec::new();
        for entry in WalkDir::new(root).sort_by_file_name() {
            match entry {
                Ok(entry) if entry.file_type().is_dir() => {}
                Ok(entry) if entry.path_is_symlink() && entry.path().is_dir() => self.skipped += 1,
                Ok(entry) => files.push(entry.into_path()),
                Err(error) => {
                    let path = error.path().unwrap_or(root).to_path_buf();
                    let source = error.into_io_error().unwrap_or_else(|| io::Error::other("it leads in a circle"));
                    self.failures.push(Error::io("read", &path)(source));
                }
            }
        }
        files
    }
}
