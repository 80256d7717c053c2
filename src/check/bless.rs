//! Candidates accepted: each becomes its case's golden.

use std::fs;
use std::path::Path;

use super::Manifest;
use super::manifest::is_named;
use super::slot::{beside, copy, hash_of, is_below};
use super::tolerance::glob;
use crate::suite::{CheckResults, CheckedCase, DiffOutcome};
use crate::{Error, Result};

/// What became of a case that was to be blessed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Blessing {
    /// The candidate took the place of a golden.
    Replaced {
        /// The golden's file.
        golden: String,
    },
    /// The candidate became the environment's first golden. One that stood in stays.
    Added {
        /// The golden's file.
        golden: String,
    },
    /// Nothing was done.
    Refused {
        /// Why.
        why: String,
    },
}

/// Blesses what failed in a run, or what of it is named, whether it failed or not. A file is replaced whole, or stays; in a dry run
/// all stay.
///
/// # Errors
///
/// [`Error::Request`] if nothing of that name was checked or the results are of another manifest; [`Error::Io`] if a golden cannot be
/// written.
pub fn bless(
    manifest: &Manifest,
    results: &CheckResults,
    output: &Path,
    named: &[String],
    dry_run: bool,
) -> Result<Vec<(String, Blessing)>> {
    let chosen = choose(results, named)?;
    chosen.into_iter().map(|case| Ok((case.id.clone(), bless_one(manifest, case, output, dry_run)?))).collect()
}

fn choose<'r>(results: &'r CheckResults, named: &[String]) -> Result<Vec<&'r CheckedCase>> {
    if named.is_empty() {
        return Ok(results.cases.iter().filter(|case| case.pair.outcome != DiffOutcome::Same).collect());
    }
    let mut chosen = vec![false; results.cases.len()];
    for pattern in named {
        let glob = glob(pattern).map_err(Error::Request)?;
        let mut any = false;
        for (case, chosen) in results.cases.iter().zip(&mut chosen) {
            // A name may be no pattern at all: of a file with brackets in its name.
            let is_it = case.id == *pattern || is_named(&glob, &case.id);
            (*chosen, any) = (*chosen || is_it, any || is_it);
        }
        if !any {
            let known: Vec<&str> = results.cases.iter().map(|case| case.id.as_str()).collect();
            return Err(crate::error::unknown("case", pattern, &known));
        }
    }
    Ok(results.cases.iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|(case, _)| case).collect())
}

fn bless_one(manifest: &Manifest, case: &CheckedCase, output: &Path, dry_run: bool) -> Result<Blessing> {
    let refused = |why: &str| Ok(Blessing::Refused { why: why.to_owned() });
    let (Some(hash), Some(actual)) = (&case.candidate_hash, &case.pair.actual) else {
        return refused(match case.pair.outcome {
            DiffOutcome::Missing => "its picture is gone; remove the golden yourself if that is right",
            _ => "there is no candidate",
        });
    };
    if case.pair.lossy {
        return refused("its name is not UTF-8; copy the candidate yourself");
    }
    if matches!(case.pair.outcome, DiffOutcome::Unreadable | DiffOutcome::Failed) {
        return refused("golden or candidate cannot be read; look at it, and remove a broken golden yourself");
    }
    let golden_inside = Path::new(&case.blessed_as).strip_prefix(&manifest.goldens).is_ok_and(is_below);
    if !golden_inside || !is_below(Path::new(actual)) {
        return refused("a path in the results leads out of its folder");
    }
    let candidate = output.join(actual);
    if hash_of(&candidate)? != *hash {
        return refused("the candidate is not the one that was checked; run `dejag check` again");
    }
    let golden = manifest.root.join(&case.blessed_as);
    let stands_there = hash_of(&golden).ok();
    if stands_there.is_none() && fs::symlink_metadata(&golden).is_ok() {
        return refused("what stands in the golden's place cannot be read; look at it, and remove it yourself");
    }
    let held_against = case.golden.as_ref().and_then(|golden| golden.hash.clone()).filter(|_| is_own(case));
    if stands_there.as_ref() == Some(hash) {
        return refused("it is the golden already");
    }
    if stands_there != held_against {
        return refused("the golden has changed since the check; run `dejag check` again");
    }
    if !dry_run {
        copy(&candidate, &golden)?;
        remove_marked(&golden);
    }
    let golden = case.blessed_as.clone();
    Ok(if stands_there.is_some() { Blessing::Replaced { golden } } else { Blessing::Added { golden } })
}

/// Whether the golden that was found is the file that a blessing replaces.
fn is_own(case: &CheckedCase) -> bool {
    case.pair.expected.as_deref() == Some(&case.blessed_as)
}

/// The candidate that lay where the golden was missing is the golden now.
fn remove_marked(golden: &Path) {
    // It may never have been there.
    let _ = fs::remove_file(beside(golden));
}
