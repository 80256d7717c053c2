//! Files of shards, brought together.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::slot::{copy, is_below};
use crate::suite::CheckResults;
use crate::{Error, Result};

/// Where a merged case's own shard wrote its pictures.
#[must_use]
pub fn folders_of(shards: &[(PathBuf, CheckResults)]) -> BTreeMap<String, PathBuf> {
    let folder = |path: &Path| path.parent().unwrap_or(Path::new("")).to_path_buf();
    shards.iter().flat_map(|(path, results)| results.cases.iter().map(move |case| (case.id.clone(), folder(path)))).collect()
}

/// Brings the candidates and pictures of differences of all shards into one folder.
///
/// # Errors
///
/// [`Error::Io`], and [`Error::Request`] for paths that lead out of a shard's folder. The results themselves are left to whoever
/// writes them.
pub fn gather(results: &CheckResults, folders: &BTreeMap<String, PathBuf>, output: &Path) -> Result<()> {
    // Of names that are not UTF-8 the results do not know which they are.
    for case in results.cases.iter().filter(|case| !case.pair.lossy) {
        let Some(folder) = folders.get(&case.id) else { continue };
        let candidate = case.pair.actual.as_ref().filter(|_| case.candidate_hash.is_some());
        for file in candidate.into_iter().chain(&case.pair.pictures) {
            if !is_below(Path::new(file)) {
                return Err(Error::Request(format!("the results name a file outside their folder: {file}")));
            }
            copy(&folder.join(file), &output.join(file))?;
        }
    }
    Ok(())
}
