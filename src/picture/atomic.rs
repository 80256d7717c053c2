//! Files that appear whole or not at all.

use crate::{Error, Result};
use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// Writes a file so that it appears whole or not at all: into a temporary file in the same folder, which then takes the name.
/// Readers see the old bytes or the new ones. A symbolic link keeps pointing where it did; a device or a pipe, which cannot be
/// replaced, is written to once all bytes are made.
///
/// # Errors
///
/// [`Error::Io`] if the folder is absent or not writable, if it is full, or if `write` fails. Nothing is left behind.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<()> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let written = match fs::metadata(&target) {
        Ok(existing) if existing.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(existing) if !existing.is_file() => write_through(&target, write),
        _ => replace(&target, write),
    };
    written.map_err(Error::io("write", path))
}

/// [`write_atomically`] of bytes that are already there.
///
/// # Errors
///
/// As [`write_atomically`].
pub fn write_bytes_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    write_atomically(path, |file| file.write_all(bytes))
}

/// A file that is written over some time and appears whole or not at all. Dropped before [`Staged::publish`], it leaves nothing.
#[derive(Debug)]
pub(super) struct Staged {
    target: PathBuf,
    temporary: NamedTempFile,
}

impl Staged {
    /// Begins a file that is to become `path`.
    pub(super) fn begin(path: &Path) -> Result<Self> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let temporary = temporary_beside(&target).map_err(Error::io("write", path))?;
        Ok(Self { target, temporary })
    }

    /// To write to; flush it before the file is published.
    pub(super) fn writer(&self) -> Result<BufWriter<File>> {
        let file = self.temporary.as_file().try_clone().map_err(Error::io("write", &self.target))?;
        Ok(BufWriter::new(file))
    }

    /// Gives the file its name.
    pub(super) fn publish(self) -> Result<()> {
        self.temporary.persist(&self.target).map_err(|failed| Error::io("write", &self.target)(failed.error))?;
        Ok(())
    }

    /// Where it will be, for errors.
    pub(super) fn target(&self) -> &Path {
        &self.target
    }
}

fn replace(target: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let temporary = temporary_beside(target)?;
    fill(temporary.as_file(), write)?;
    temporary.persist(target).map_err(|failed| failed.error)?;
    Ok(())
}

fn write_through(target: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut staged = tempfile::tempfile()?;
    fill(&staged, write)?;
    staged.seek(SeekFrom::Start(0))?;
    io::copy(&mut staged, &mut fs::OpenOptions::new().write(true).open(target)?)?;
    Ok(())
}

fn fill(file: &File, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut buffered = BufWriter::new(file);
    write(&mut buffered)?;
    // Dropping would flush too, but swallow a full disk.
    buffered.flush()
}

/// What a temporary file's name takes over from its target's at most, in bytes: names end at 255.
const LONGEST_PREFIX: usize = 200;

/// A temporary file in the target's folder, since a rename is atomic only within one file system.
fn temporary_beside(target: &Path) -> io::Result<NamedTempFile> {
    let name = target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "the path names no file"))?;
    let mut prefix = std::ffi::OsString::from(".");
    if name.len() <= LONGEST_PREFIX {
        prefix.push(name);
        prefix.push(".");
    }
    // Opened by us: the file has the rights of any other new one, and an error does not name what has another name each time.
    let create = |path: &Path| File::options().write(true).create_new(true).open(path);
    Builder::new().prefix(&prefix).suffix(".part").make_in(folder_of(target), create)
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").file_name().to_string_lossy().into()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_whole() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.txt");
        write_bytes_atomically(&path, b"a long first version").expect("written");
        write_bytes_atomically(&path, b"second").expect("written");
        assert_eq!(fs::read(&path).expect("readable"), b"second");
        assert_eq!(names(folder.path()), ["out.txt"]);
    }

    #[test]
    fn a_name_may_be_as_long_as_the_system_allows() {
        let folder = tempfile::tempdir().expect("a folder");
        for length in [LONGEST_PREFIX, LONGEST_PREFIX + 1, 255] {
            let path = folder.path().join("n".repeat(length));
            write_bytes_atomically(&path, b"new").expect("written");
            assert_eq!(fs::read(&path).expect("readable"), b"new");
        }
        assert_eq!(names(folder.path()).len(), 3);
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_and_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.txt");
        write_bytes_atomically(&path, b"old").expect("written");
        let failed = write_atomically(&path, |file| {
            file.write_all(b"half of the new")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(failed, Err(Error::Io { .. })), "{failed:?}");
        assert_eq!(fs::read(&path).expect("readable"), b"old");
        assert_eq!(names(folder.path()), ["out.txt"]);
    }

    #[test]
    fn folders_and_absent_folders_are_errors() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(matches!(write_bytes_atomically(folder.path(), b""), Err(Error::Io { .. })));
        let absent = write_bytes_atomically(&folder.path().join("none/out.txt"), b"").expect_err("no such folder");
        assert!(absent.to_string().contains("check the path"), "{absent}");
    }

    #[cfg(unix)]
    #[test]
    fn links_and_devices_stay_what_they_are() {
        use std::os::unix::fs::{FileTypeExt, PermissionsExt};
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        write_bytes_atomically(&file, b"old").expect("written");
        std::os::unix::fs::symlink(&file, &link).expect("linked");
        write_bytes_atomically(&link, b"new").expect("written");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        assert_eq!(fs::read(&file).expect("readable"), b"new");
        assert_ne!(fs::metadata(&file).expect("there").permissions().mode() & 0o044, 0, "as readable as any new file");

        write_bytes_atomically(Path::new("/dev/null"), b"gone").expect("written");
        assert!(fs::metadata("/dev/null").expect("there").file_type().is_char_device());
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_device_is_an_error_that_says_so() {
        let error = write_bytes_atomically(Path::new("/dev/full"), b"too much").expect_err("full");
        assert!(error.to_string().contains("free some space"), "{error}");
    }
}
