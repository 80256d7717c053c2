//! Shards put together again.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::shard::check_whole;
use super::slot::{copy, is_below};
use crate::suite::{CheckResults, OutcomeCounts};
use crate::{Error, Result};

/// The run that these are the shards of, as if it had been made in one; `names` are for errors.
///
/// # Errors
///
/// [`Error::Request`] if a shard is absent or there twice, or if they are not of one run.
pub fn merge(shards: &[(PathBuf, CheckResults)]) -> Result<CheckResults> {
    let stamps = shards.iter().map(|(path, results)| {
        let stamp =
            results.shard.as_ref().ok_or_else(|| format!("{} is no shard: it was run without --shard", path.display()))?;
        Ok((path.to_str().unwrap_or("a file"), stamp))
    });
    let stamps: Vec<_> = stamps.collect::<Result<_, String>>().map_err(Error::Request)?;
    check_whole(&stamps).map_err(Error::Request)?;
    let (first_path, first) = &shards[0];
    for (path, other) in shards {
        if let Some(what) = strangeness(first, other) {
            let (a, b) = (first_path.display(), path.display());
            return Err(Error::Request(format!("{a} and {b} are not shards of one run: they differ in {what}")));
        }
    }
    let order: BTreeMap<&String, usize> = stamps[0].1.dealt.iter().enumerate().map(|(i, entry)| (entry, i)).collect();
    let mut cases: Vec<_> = shards.iter().flat_map(|(_, results)| results.cases.iter().cloned()).collect();
    cases.sort_by_key(|case| order.get(&case.entry).copied());
    Ok(CheckResults {
        shard: None,
        counts: OutcomeCounts::of(cases.iter().map(|case| case.pair.outcome)),
        cases,
        ..first.clone()
    })
}

/// In what the runs of two shards differ, if they do. A shard that drew nothing has no driver to differ in.
fn strangeness(a: &CheckResults, b: &CheckResults) -> Option<&'static str> {
    let facts = [
        ("the version of dejag", a.dejag == b.dejag && a.schema_version == b.schema_version),
        ("the manifest", a.manifest == b.manifest),
        ("the command", a.command == b.command),
        ("the environment", a.environment == b.environment),
    ];
    facts.into_iter().find(|(_, alike)| !alike).map(|(what, _)| what)
}

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
    for case in &results.cases {
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
