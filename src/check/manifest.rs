//! `dejag.toml`: which pictures are held against their goldens, and what they must meet.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use globset::GlobMatcher;
use toml::Spanned;

use super::document::{Document, OverrideDocument};
use super::entry::Entry;
use super::slot::CANDIDATE_MARK;
use super::tolerance::{Override, Tolerance, glob};
use crate::{Error, Result};

/// A manifest that makes sense as far as can be told without drawing.
#[derive(Debug, Clone)]
pub struct Manifest {
    /// As the user named it.
    pub path: PathBuf,
    /// BLAKE3 of its bytes, in hexadecimal.
    pub hash: String,
    /// What paths in it are relative to.
    pub root: PathBuf,
    /// Where goldens lie, a folder for each environment; relative to the root.
    pub goldens: PathBuf,
    /// Where candidates and results go unless the command line says otherwise; relative to the root.
    pub output: PathBuf,
    /// Environments whose goldens stand in where an environment has none of its own.
    pub fallback: Vec<String>,
    /// In the order of the file: captures, sequences, files.
    pub entries: Vec<Entry>,
    overrides: Vec<Override>,
}

/// Largest manifest that is read, in bytes.
const MAX_BYTES: u64 = 16 << 20;

/// Most entries that a manifest may come to.
const MAX_ENTRIES: usize = 100_000;

impl Manifest {
    /// Reads one.
    ///
    /// # Errors
    ///
    /// [`Error::Io`]; [`Error::Document`] with line and column for what makes no sense.
    pub fn read(path: &Path) -> Result<Self> {
        let io = |source: io::Error| {
            let absent = source.kind() == io::ErrorKind::NotFound;
            let hint = || io::Error::other("there is none; write one as docs/check.md shows, or name it with --manifest");
            Error::io("read the manifest", path)(if absent { hint() } else { source })
        };
        if fs::metadata(path).map_err(io)?.len() > MAX_BYTES {
            return Err(Error::at(&path.to_string_lossy(), "", 0, format!("it is larger than {} MiB", MAX_BYTES >> 20)));
        }
        let bytes = fs::read(path).map_err(io)?;
        Self::parse(path, &bytes)
    }

    /// Of a file's bytes.
    ///
    /// # Errors
    ///
    /// [`Error::Document`].
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<Self> {
        let name = path.to_string_lossy();
        let text = str::from_utf8(bytes).map_err(|error| {
            let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
            Error::at(&name, &valid, valid.len(), "it is not UTF-8 text from here on".into())
        })?;
        let document: Document = toml::from_str(text)
            .map_err(|error| Error::at(&name, text, error.span().map_or(0, |span| span.start), error.message().to_owned()))?;
        let place = Place { name: &name, text };
        let mut entries = Vec::new();
        for capture in &document.capture {
            place.add(&mut entries, capture.span().start, capture.get_ref().entries(&document.tolerance))?;
        }
        for sequence in &document.sequence {
            place.add(&mut entries, sequence.span().start, sequence.get_ref().entries(&document.tolerance))?;
        }
        for files in &document.files {
            let entry = files.get_ref().entry(&document.tolerance).map(|entry| vec![entry]);
            place.add(&mut entries, files.span().start, entry)?;
        }
        let (mut ids, mut files) = (BTreeSet::new(), BTreeSet::new());
        for (offset, entry) in &entries {
            // Some systems take names for the same that differ in case only.
            if !ids.insert(entry.id.to_lowercase()) || !files.insert(entry.golden_name().to_lowercase()) {
                return Err(place.error(*offset, format!("id '{}' is taken by an entry above; give each its own `id`", entry.id)));
            }
        }
        // A golden would have to be a file and a folder at once.
        for (offset, entry) in &entries {
            let above =
                entry.id.match_indices('/').map(|(at, _)| &entry.id[..at]).find(|above| ids.contains(&above.to_lowercase()));
            if let Some(above) = above {
                return Err(place.error(*offset, format!("id '{}' lies below another entry's id, '{above}'", entry.id)));
            }
        }
        if document.goldens.as_os_str().is_empty() || document.goldens == document.output {
            return Err(place.error(0, "`goldens` must name a folder, and another one than `output`".into()));
        }
        for level in &document.fallback {
            check_id(level.get_ref()).map_err(|why| place.error(level.span().start, why))?;
        }
        Ok(Self {
            path: path.to_path_buf(),
            hash: blake3::hash(bytes).to_hex().to_string(),
            root: path.parent().unwrap_or(Path::new("")).to_path_buf(),
            goldens: document.goldens,
            output: document.output,
            fallback: document.fallback.into_iter().map(Spanned::into_inner).collect(),
            entries: entries.into_iter().map(|(_, entry)| entry).collect(),
            overrides: document.overrides.iter().map(|over| place.over(over)).collect::<Result<_>>()?,
        })
    }

    /// What a picture of an entry must meet in an environment.
    #[must_use]
    pub fn tolerance(&self, entry: &Entry, id: &str, environment: &str, platform: &str) -> Tolerance {
        let held = self.overrides.iter().filter(|over| over.holds(id, environment, platform));
        held.fold(entry.tolerance, |tolerance, over| tolerance.with(&over.tolerance))
    }

    /// Whether an override sets limits of this picture by environment or platform.
    pub(super) fn differs_by_place(&self, id: &str) -> bool {
        self.overrides.iter().any(|over| over.depends_on_place() && over.concerns(id))
    }

    /// Entries whose ids, or a part of which up to a `/`, match any of these, and those of pictures that are named; all without one.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] for what is no pattern, or matches nothing.
    pub fn select(&self, patterns: &[String]) -> Result<Vec<&Entry>> {
        if patterns.is_empty() {
            return Ok(self.entries.iter().collect());
        }
        let globs: Vec<(&String, GlobMatcher)> =
            patterns.iter().map(|pattern| Ok((pattern, glob(pattern).map_err(Error::Request)?))).collect::<Result<_>>()?;
        for (pattern, glob) in &globs {
            if !self.entries.iter().any(|entry| is_meant(pattern, glob, entry)) {
                let known: Vec<&str> = self.entries.iter().map(|entry| entry.id.as_str()).collect();
                return Err(crate::error::unknown("case", pattern, &known));
            }
        }
        Ok(self.entries.iter().filter(|entry| globs.iter().any(|(pattern, glob)| is_meant(pattern, glob, entry))).collect())
    }

    /// Where goldens of an environment lie.
    #[must_use]
    pub fn goldens_of(&self, environment: &str) -> PathBuf {
        self.root.join(&self.goldens).join(environment)
    }
}

/// Whether a pattern means an entry: by its id, what lies above it, or a picture of it.
fn is_meant(pattern: &str, glob: &GlobMatcher, entry: &Entry) -> bool {
    is_named(glob, &entry.id) || pattern.strip_prefix(&entry.id).is_some_and(|rest| rest.starts_with('/'))
}

/// Whether a pattern matches an id or what stands before one of its `/`.
#[must_use]
pub(super) fn is_named(glob: &GlobMatcher, id: &str) -> bool {
    glob.is_match(id) || id.match_indices('/').any(|(at, _)| glob.is_match(&id[..at]))
}

/// The text, for errors with places.
struct Place<'a> {
    name: &'a str,
    text: &'a str,
}

impl Place<'_> {
    fn error(&self, offset: usize, message: String) -> Error {
        Error::at(self.name, self.text, offset, message)
    }

    fn add(&self, all: &mut Vec<(usize, Entry)>, offset: usize, entries: Result<Vec<Entry>, String>) -> Result<()> {
        let entries = entries.map_err(|why| self.error(offset, why))?;
        if all.len() + entries.len() > MAX_ENTRIES {
            return Err(self.error(offset, format!("with this the manifest comes to more than {MAX_ENTRIES} cases; use several")));
        }
        all.extend(entries.into_iter().map(|entry| (offset, entry)));
        Ok(())
    }

    fn over(&self, document: &OverrideDocument) -> Result<Override> {
        let matcher = |pattern: &Option<Spanned<String>>| {
            let compiled = pattern.as_ref().map(|p| glob(p.get_ref()).map_err(|why| self.error(p.span().start, why)));
            compiled.transpose()
        };
        Ok(Override {
            case: matcher(&document.case)?,
            environment: matcher(&document.environment)?,
            platform: matcher(&document.platform)?,
            tolerance: document.tolerance,
        })
    }
}

/// Ids are paths below the goldens on every system.
pub(super) fn check_id(id: &str) -> Result<(), String> {
    let allowed = |c: char| c.is_alphanumeric() || matches!(c, '.' | '_' | '-' | '/' | '+' | ' ');
    let sane = |part: &str| !part.is_empty() && !part.starts_with(['.', ' ']) && !part.ends_with(['.', ' ']) && part.len() <= 200;
    if format!("{id}.").contains(CANDIDATE_MARK) {
        return Err(format!("'{id}' is no id: '{CANDIDATE_MARK}' marks what is left where a golden is missing"));
    }
    if id.chars().all(allowed) && id.split('/').all(sane) && id.len() <= 1000 {
        return Ok(());
    }
    Err(format!(
        "'{}' is no id; write letters, digits, '.', '_', '-', '+' and blanks with '/' between parts, no part beginning with a dot",
        id.escape_debug()
    ))
}
