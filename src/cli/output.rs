//! Writing results: checked before the work, whole or not at all.

use std::io;
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
