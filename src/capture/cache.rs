//! References on disk, under a hash of everything that shapes them.
//!
//! An entry is a line that names the format, a line of JSON, the pixels as little-endian f32 RGB, and a BLAKE3 hash of all that.
//! Entries are written whole or not at all, and one whose hash does not match is thrown away, so an interrupted run or a full disk
//! costs a reference, never a wrong score and never the run.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use std::time::SystemTime;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::picture::{LinearPicture, write_atomically};

use super::reference::Halves;

const MAGIC: &[u8] = b"dejag reference 1\n";
const HASH_BYTES: usize = 32;
/// All entries together; the least recently used go first.
const DEFAULT_CAP_BYTES: u64 = 2 << 30;

/// A folder of references, or none.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: Option<PathBuf>,
    cap_bytes: u64,
    failure: Arc<OnceLock<Error>>,
}

/// A file of the cache.
struct Kept {
    path: PathBuf,
    bytes: u64,
    used: SystemTime,
    /// Not what a killed process left of one.
    whole: bool,
}

/// An entry's own words.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CacheEntry {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The scene's name, for people.
    pub scene: String,
    /// The reference's method.
    pub spec: String,
    /// How much its two halves differ.
    pub halves: Option<Halves>,
}

impl Cache {
    /// In `$DEJAG_CACHE_DIR`, or else the user's cache folder; without either, nothing is kept.
    #[must_use]
    pub fn of_user() -> Self {
        let own = std::env::var_os("DEJAG_CACHE_DIR").filter(|dir| !dir.is_empty()).map(PathBuf::from);
        Self::new(own.or_else(|| Some(dirs::cache_dir()?.join("dejag"))), DEFAULT_CAP_BYTES)
    }

    /// In this folder, at most so many bytes.
    #[must_use]
    pub fn in_folder(folder: PathBuf, cap_bytes: u64) -> Self {
        Self::new(Some(folder), cap_bytes)
    }

    /// Keeps nothing, finds nothing.
    #[must_use]
    pub fn none() -> Self {
        Self::new(None, 0)
    }

    fn new(folder: Option<PathBuf>, cap_bytes: u64) -> Self {
        Self { folder, cap_bytes, failure: Arc::default() }
    }

    /// Where entries are kept.
    #[must_use]
    pub fn folder(&self) -> Option<&Path> {
        self.folder.as_deref()
    }

    /// The entry of this key, if there is one and it is whole.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<(LinearPicture, CacheEntry)> {
        let path = self.path(key)?;
        let bytes = fs::read(&path).ok()?;
        let Some(found) = decode(&bytes) else {
            // Half-written or damaged. If it cannot be removed either, it will be overwritten.
            let _ = fs::remove_file(&path);
            return None;
        };
        // A read is a use: the oldest uses are evicted first. Without the right to touch it, it ages as written.
        let _ = fs::File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Some(found)
    }

    /// Keeps an entry, and evicts others beyond the cap. If that cannot be done, [`Self::failure`] says why: the entry will have to
    /// be made again, which is no reason to lose it now.
    pub fn put(&self, key: &str, picture: &LinearPicture, entry: &CacheEntry) {
        if let Err(error) = self.try_put(key, picture, entry) {
            self.failure.get_or_init(|| error);
        }
    }

    /// Why the first entry that could not be kept could not.
    #[must_use]
    pub fn failure(&self) -> Option<&Error> {
        self.failure.get()
    }

    fn try_put(&self, key: &str, picture: &LinearPicture, entry: &CacheEntry) -> Result<()> {
        let (Some(path), Some(folder)) = (self.path(key), &self.folder) else {
            return Ok(());
        };
        fs::create_dir_all(folder).map_err(Error::io("create the folder", folder))?;
        let bytes = encode(picture, entry)?;
        write_atomically(&path, |writer| writer.write_all(&bytes))?;
        self.evict(&path)
    }

    /// Removes every entry; how many and how many bytes.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn clear(&self) -> Result<(u64, u64)> {
        let files = self.files()?;
        for file in &files {
            fs::remove_file(&file.path).map_err(Error::io("remove", &file.path))?;
        }
        Ok(totals(&files))
    }

    /// How many entries there are, and how many bytes they take together with what killed processes left.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn usage(&self) -> Result<(u64, u64)> {
        Ok(totals(&self.files()?))
    }

    fn path(&self, key: &str) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.reference")))
    }

    /// Entries and leftovers, the longest unused first. A folder that is not there yet holds none.
    fn files(&self) -> Result<Vec<Kept>> {
        let Some(folder) = &self.folder else { return Ok(Vec::new()) };
        let listing = match fs::read_dir(folder) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            listing => listing.map_err(Error::io("read the cache", folder))?,
        };
        let mut files: Vec<Kept> = listing.filter_map(|item| Kept::of(item.ok()?.path())).collect();
        files.sort_by(|a, b| (a.used, &a.path).cmp(&(b.used, &b.path)));
        Ok(files)
    }

    fn evict(&self, newest: &Path) -> Result<()> {
        let files = self.files()?;
        let (_, mut total) = totals(&files);
        for file in files {
            if total <= self.cap_bytes || file.path == newest {
                continue;
            }
            fs::remove_file(&file.path).map_err(Error::io("remove", &file.path))?;
            total -= file.bytes;
        }
        Ok(())
    }
}

impl Kept {
    /// None for a file that is not the cache's.
    fn of(path: PathBuf) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let whole = name.ends_with(".reference");
        let leftover = name.starts_with('.') && name.contains(".reference.") && name.ends_with(".part");
        if !whole && !leftover {
            return None;
        }
        let data = fs::metadata(&path).ok().filter(fs::Metadata::is_file)?;
        Some(Self { bytes: data.len(), used: data.modified().ok()?, whole, path })
    }
}

/// How many whole entries, and the bytes of all.
fn totals(files: &[Kept]) -> (u64, u64) {
    let entries = files.iter().filter(|file| file.whole).count();
    (entries as u64, files.iter().map(|file| file.bytes).sum())
}

fn encode(picture: &LinearPicture, entry: &CacheEntry) -> Result<Vec<u8>> {
    let header = serde_json::to_string(entry).map_err(|e| Error::Request(format!("a cache entry cannot be written: {e}")))?;
    let mut bytes = [MAGIC, header.as_bytes(), b"\n"].concat();
    for pixel in picture.pixels() {
        for channel in &pixel[..3] {
            bytes.extend_from_slice(&channel.to_le_bytes());
        }
    }
    let hash = blake3::hash(&bytes);
    bytes.extend_from_slice(hash.as_bytes());
    Ok(bytes)
}

fn decode(bytes: &[u8]) -> Option<(LinearPicture, CacheEntry)> {
    let (content, hash) = bytes.split_at_checked(bytes.len().checked_sub(HASH_BYTES)?)?;
    if blake3::hash(content).as_bytes() != hash {
        return None;
    }
    let rest = content.strip_prefix(MAGIC)?;
    let end = rest.iter().position(|b| *b == b'\n')?;
    let entry: CacheEntry = serde_json::from_slice(&rest[..end]).ok()?;
    let pixels = rest[end + 1..].as_chunks::<12>().0.iter().map(|texel| {
        let channel = |i: usize| f32::from_le_bytes([texel[i], texel[i + 1], texel[i + 2], texel[i + 3]]);
        [channel(0), channel(4), channel(8), 1.0]
    });
    let picture = LinearPicture::new(entry.size[0], entry.size[1], pixels.collect()).ok()?;
    Some((picture, entry))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(value: f32) -> (LinearPicture, CacheEntry) {
        let picture = LinearPicture::from_fn(3, 2, |x, y| [value + x as f32, y as f32 / 3.0, 1e-7, 1.0]).expect("fits");
        let entry =
            CacheEntry { size: [3, 2], scene: "s".into(), spec: "ssaa".into(), halves: Some(Halves { rms: 0.25, max: 0.5 }) };
        (picture, entry)
    }

    #[test]
    fn what_is_put_is_found_bit_for_bit() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::in_folder(folder.path().join("new"), 1 << 20);
        assert!(cache.get("a").is_none());
        let (picture, entry) = sample(1.0);
        cache.try_put("a", &picture, &entry).expect("writes");
        assert_eq!(cache.get("a"), Some((picture, entry)));
        assert_eq!(cache.clear().expect("clears").0, 1);
        assert!(cache.get("a").is_none());
    }

    #[test]
    fn a_damaged_entry_is_not_believed() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::in_folder(folder.path().into(), 1 << 20);
        let (picture, entry) = sample(1.0);
        cache.try_put("a", &picture, &entry).expect("writes");
        let path = folder.path().join("a.reference");
        let whole = fs::read(&path).expect("reads");
        for length in [0, 10, MAGIC.len(), whole.len() - 1] {
            fs::write(&path, &whole[..length]).expect("writes");
            assert!(cache.get("a").is_none(), "{length} bytes");
            assert!(!path.exists());
        }
        let mut flipped = whole;
        flipped[60] ^= 1;
        fs::write(&path, flipped).expect("writes");
        assert!(cache.get("a").is_none());
    }

    #[test]
    fn the_cap_holds_and_the_newest_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let (picture, entry) = sample(1.0);
        let one = encode(&picture, &entry).expect("encodes").len() as u64;
        let cache = Cache::in_folder(folder.path().into(), 2 * one);
        for key in ["a", "b", "c", "d"] {
            cache.try_put(key, &picture, &entry).expect("writes");
        }
        assert_eq!(cache.usage().expect("reads"), (2, 2 * one));
        assert!(cache.get("d").is_some());
        Cache::in_folder(folder.path().into(), 0).try_put("e", &picture, &entry).expect("writes");
        assert_eq!(cache.usage().expect("reads").0, 1);
    }

    #[test]
    fn what_a_killed_process_left_is_counted_evicted_and_cleared_and_nothing_else_is() {
        let folder = tempfile::tempdir().expect("a folder");
        let (leftover, foreign) = (folder.path().join(".a.reference.x7Yz.part"), folder.path().join("thesis.part"));
        let cache = Cache::in_folder(folder.path().into(), 1 << 20);
        for path in [&leftover, &foreign] {
            fs::write(path, [0; 1000]).expect("writes");
        }
        assert_eq!(cache.usage().expect("reads"), (0, 1000));
        assert_eq!(cache.clear().expect("clears"), (0, 1000));
        assert!(!leftover.exists() && foreign.exists());

        fs::write(&leftover, vec![0; 1 << 20]).expect("writes");
        let (picture, entry) = sample(1.0);
        cache.try_put("a", &picture, &entry).expect("writes");
        assert!(!leftover.exists() && cache.get("a").is_some());
    }

    #[test]
    fn a_cache_that_cannot_be_written_says_so_and_stops_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("file");
        fs::write(&path, b"not a folder").expect("writes");
        let (picture, entry) = sample(1.0);
        for folder in [path.clone(), path.join("below")] {
            let cache = Cache::in_folder(folder, 1 << 20);
            cache.put("a", &picture, &entry);
            assert!(matches!(cache.clone().failure(), Some(Error::Io { .. })), "{:?}", cache.failure());
            assert!(cache.get("a").is_none());
            assert!(cache.usage().is_err() && cache.clear().is_err());
        }
        assert_eq!(fs::read(&path).expect("reads"), b"not a folder");
    }
}
