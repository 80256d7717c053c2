//! Two files compared: what can go wrong before pixels are, and what comes of them.

use super::pictures::{self, Targets};
use super::sides::Sides;
use super::verdict::Judge;
use super::{Limits, Scope};
use crate::picture::Raster;
use crate::suite::{DiffOutcome, DiffPair};
use crate::{Error, Result};
use std::fs::{self, File};
use std::io::{self, BufReader, Read as _};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// How files are compared.
#[derive(Debug)]
pub struct Settings {
    /// What a pair must meet.
    pub limits: Limits,
    /// Which pixels count.
    pub scope: Scope,
    /// Whether to compare numbers that mean different colours.
    pub ignore_profile: bool,
    /// Whether to look at every metric, also those without a limit.
    pub sweep: bool,
    /// Bytes that a decoded picture may take.
    pub max_bytes: u64,
    /// Asked now and then whether to go on.
    pub watch: fn() -> Result<()>,
}

impl Settings {
    /// Compares two files and writes the pictures that are asked for, if the pair is not the same.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] and [`Error::Format`] for a file that cannot be read or written; [`Error::Request`] if mask or regions do not
    /// fit; what [`Settings::watch`] answers.
    pub fn compare(&self, expected: &Path, actual: &Path, targets: &Targets) -> Result<DiffPair> {
        let mut pair = DiffPair::named(expected, actual);
        let both = Both::read(expected, actual, self.max_bytes)?;
        let (a, b) = (&both.expected, both.actual());
        let sizes = [a.size(), b.size()];
        pair.sizes = Some(sizes);
        if sizes[0] != sizes[1] {
            let [[w, h], [width, height]] = sizes;
            return Ok(pair.ended(DiffOutcome::Size, format!("expected {w}x{h}, actual {width}x{height}")));
        }
        if a.space() != b.space() && !self.ignore_profile {
            let why = format!("expected {}, actual {}", a.space(), b.space());
            return Ok(pair.ended(DiffOutcome::Profile, why));
        }
        self.scope.check(sizes[0])?;
        let sides = Sides { expected: a, actual: b, scope: &self.scope };
        let judge = Judge { limits: &self.limits, sweep: self.sweep, watch: self.watch };
        let verdict = judge.verdict(&sides)?;
        if verdict.outcome == DiffOutcome::Different {
            pair.pictures = pictures::write(&sides, verdict.classes.as_ref(), self.limits.per_channel.unwrap_or(0.0), targets)?;
        }
        pair.outcome = verdict.outcome;
        pair.pixels = Some(verdict.pixels);
        pair.classes = verdict.classes.map(|classes| classes.figures);
        pair.knobs = verdict.knobs;
        Ok(pair)
    }
}

/// Both pictures; the same one twice if the files are equal byte for byte.
struct Both {
    expected: Raster,
    /// None if it is the expected one.
    other: Option<Raster>,
}

impl Both {
    fn read(expected: &Path, actual: &Path, max_bytes: u64) -> Result<Self> {
        check_file(expected)?;
        check_file(actual)?;
        if are_equal(expected, actual).unwrap_or(false) {
            return Ok(Self { expected: guarded(expected, max_bytes)?, other: None });
        }
        let (a, b) = rayon::join(|| guarded(expected, max_bytes), || guarded(actual, max_bytes));
        Ok(Self { expected: a?, other: Some(b?) })
    }

    fn actual(&self) -> &Raster {
        self.other.as_ref().unwrap_or(&self.expected)
    }
}

/// Opening a pipe would wait for whoever writes into it.
fn check_file(path: &Path) -> Result<()> {
    let what = fs::metadata(path).map_err(Error::io("read", path))?;
    if what.is_dir() {
        return Err(Error::io("read", path)(io::ErrorKind::IsADirectory.into()));
    }
    if !what.is_file() {
        return Err(Error::io("read", path)(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file")));
    }
    Ok(())
}

/// Whether two files hold the same bytes. Errors are left to who decodes them.
fn are_equal(a: &Path, b: &Path) -> io::Result<bool> {
    let (a, b) = (File::open(a)?, File::open(b)?);
    if a.metadata()?.len() != b.metadata()?.len() {
        return Ok(false);
    }
    const PIECE: usize = 1 << 16;
    let (mut a, mut b) = (BufReader::new(a), BufReader::new(b));
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    loop {
        ours.clear();
        theirs.clear();
        a.by_ref().take(PIECE as u64).read_to_end(&mut ours)?;
        b.by_ref().take(PIECE as u64).read_to_end(&mut theirs)?;
        if ours != theirs {
            return Ok(false);
        }
        if ours.len() < PIECE {
            return Ok(true);
        }
    }
}

/// Reads a picture. A decoder that breaks down on one file does not take the others with it.
///
/// # Errors
///
/// As [`Raster::read`].
pub fn guarded(path: &Path, max_bytes: u64) -> Result<Raster> {
    catch_unwind(AssertUnwindSafe(|| Raster::read(path, max_bytes))).unwrap_or_else(|_| {
        let message = "the code for its format broke down, which is a bug: please report it with the file".into();
        Err(Error::Format { path: path.to_path_buf(), expected: "picture", message })
    })
}
