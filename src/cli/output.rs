//! Writing results: checked before the work, whole or not at all.

use std::fs::{self, File};
use std::io::{self, IsTerminal as _, Read as _};
use std::path::Path;

use anyhow::Context as _;

use crate::error::{Error, Result};
use crate::picture::FileFormat;

/// Fails early if a file of this name cannot be written: before minutes of drawing, not after.
pub(super) fn check_file(path: &Path) -> Result<FileFormat> {
    let format = FileFormat::of_path(path)?;
    check_folder_of(path)?;
    Ok(format)
}

/// As [`check_folder_of`], of results that begin like this: what holds something else is somebody's, and not ours to replace.
pub(super) fn check_results(path: &Path, start: &str) -> Result<()> {
    check_folder_of(path)?;
    // Pipes and devices are written to, and must not be waited for.
    let holds_something = fs::metadata(path).is_ok_and(|what| what.is_file() && what.len() > 0);
    if holds_something && !begins_like(path, start) {
        return Err(Error::Request(format!("{} is there already and holds something else; name another file", path.display())));
    }
    Ok(())
}

fn begins_like(path: &Path, start: &str) -> bool {
    let mut head = vec![0; start.len()];
    File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok() && head == start.as_bytes()
}

/// The folder that will hold `path` must exist and take a file.
pub(super) fn check_folder_of(path: &Path) -> Result<()> {
    if path.is_dir() {
        return Err(Error::Request(format!("{} is a folder; name a file in it", path.display())));
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    check_writable(folder)
}

/// The folder must exist and take a file.
pub(super) fn check_writable(folder: &Path) -> Result<()> {
    tempfile::tempfile_in(folder).map(drop).map_err(Error::io("write into", folder))
}

/// Whether what is printed may have colours: on a terminal, unless the user wants none (no-color.org).
pub(super) fn is_colored() -> bool {
    io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// One line of data, or many, on stdout.
pub(super) fn print(text: &str) -> anyhow::Result<()> {
    write_lines(io::stdout().lock(), text).context("could not write to standard output")
}

/// A line of words on stderr. Nobody may be listening there any more; that is no reason to stop.
pub(super) fn say(text: &str) {
    let _ = write_lines(io::stderr().lock(), text);
}

fn write_lines(mut out: impl io::Write, text: &str) -> io::Result<()> {
    out.write_all(text.as_bytes())?;
    if !text.ends_with('\n') {
        out.write_all(b"\n")?;
    }
    out.flush()
}
