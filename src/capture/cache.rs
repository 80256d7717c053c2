//! References on disk, under a hash of everything that shapes them.
//!
//! An entry is a line that names the format, a line of JSON, the pixels as little-endian f32 RGB, and a BLAKE3 hash of all that.
//! Entries are written whole or not at all, and one whose hash does not match is thrown away, so an interrupted or full disk costs
//! a reference, never a wrong score.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
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
        Self { folder: own.or_else(|| Some(dirs::cache_dir()?.join("dejag"))), cap_bytes: DEFAULT_CAP_BYTES }
    }

    /// In this folder, at most so many bytes.
    #[must_use]
    pub fn in_folder(folder: PathBuf, cap_bytes: u64) -> Self {
        Self { folder: Some(folder), cap_bytes }
    }

    /// Keeps nothing, finds nothing.
    #[must_use]
    pub fn none() -> Self {
        Self { folder: None, cap_bytes: 0 }
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

    /// Keeps an entry, and evicts others beyond the cap.
    ///
    /// # Errors
    /// [`Error::Io`].
    pub fn put(&self, key: &str, picture: &LinearPicture, entry: &CacheEntry) -> Result<()> {
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
        let mut removed = (0, 0);
        for (path, bytes, _) in self.files() {
            fs::remove_file(&path).map_err(Error::io("remove", &path))?;
            removed = (removed.0 + 1, removed.1 + bytes);
        }
        Ok(removed)
    }

    /// How many entries there are and how many bytes they take.
    #[must_use]
    pub fn usage(&self) -> (u64, u64) {
        let files = self.files();
        (files.len() as u64, files.iter().map(|(_, bytes, _)| bytes).sum())
    }

    fn path(&self, key: &str) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{key}.reference")))
    }

    /// Entries with their sizes and times of last use, oldest first.
    fn files(&self) -> Vec<(PathBuf, u64, SystemTime)> {
        let Some(listing) = self.folder.as_ref().and_then(|folder| fs::read_dir(folder).ok()) else {
            return Vec::new();
        };
        let mut files: Vec<_> = listing
            .filter_map(|item| {
                let path = item.ok()?.path();
                let data = fs::metadata(&path).ok()?;
                let ours = path.extension().is_some_and(|e| e == "reference");
                ours.then(|| Some((path, data.len(), data.modified().ok()?)))?
            })
            .collect();
        files.sort_by(|a, b| (a.2, &a.0).cmp(&(b.2, &b.0)));
        files
    }

    fn evict(&self, newest: &Path) -> Result<()> {
        let files = self.files();
        let mut total: u64 = files.iter().map(|(_, bytes, _)| bytes).sum();
        for (path, bytes, _) in files {
            if total <= self.cap_bytes || path == newest {
                continue;
            }
            fs::remove_file(&path).map_err(Error::io("remove", &path))?;
            total -= bytes;
        }
        Ok(())
    }
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
        cache.put("a", &picture, &entry).expect("writes");
        assert_eq!(cache.get("a"), Some((picture, entry)));
        assert_eq!(cache.clear().expect("clears").0, 1);
        assert!(cache.get("a").is_none());
    }

    #[test]
    fn a_damaged_entry_is_not_believed() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::in_folder(folder.path().into(), 1 << 20);
        let (picture, entry) = sample(1.0);
        cache.put("a", &picture, &entry).expect("writes");
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
            cache.put(key, &picture, &entry).expect("writes");
        }
        assert_eq!(cache.usage(), (2, 2 * one));
        assert!(cache.get("d").is_some());
        Cache::in_folder(folder.path().into(), 0).put("e", &picture, &entry).expect("writes");
        assert_eq!(cache.usage().0, 1);
    }
}
