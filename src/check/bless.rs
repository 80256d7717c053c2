//! Candidates accepted: each becomes its case's golden.

use std::fs;
use std::path::Path;

use super::manifest::is_named;
use super::slot::{beside, copy, hash_of, is_below};
use super::tolerance::glob;
use super::{ANY, Manifest};
use crate::suite::{CheckResults, CheckedCase, DiffOutcome};
use crate::{Error, Result};

/// What became of a case that was to be blessed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Blessing {
    /// The candidate took the golden's place.
    Replaced,
    /// The candidate became the environment's first golden. One that stood in stays.
    Added,
    /// The candidate is the golden already.
    Already,
    /// Nothing was done, and why.
    Refused(String),
    /// It was tried, and why it failed.
    Failed(String),
}

/// Goldens to be.
#[derive(Debug)]
pub struct Bless<'a> {
    /// Whose goldens.
    pub manifest: &'a Manifest,
    /// What was checked.
    pub results: &'a CheckResults,
    /// Where its candidates lie.
    pub output: &'a Path,
    /// Whether nothing is to be written.
    pub dry_run: bool,
}

impl Bless<'_> {
    /// Blesses what failed, or what is named, whether it failed or not, and tells of each as it is done. A file is replaced whole, or
    /// stays.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if nothing of that name was checked; what `tell` answers.
    pub fn bless<E: From<Error>>(
        &self,
        named: &[String],
        tell: &mut dyn FnMut(&CheckedCase, &Blessing) -> Result<(), E>,
    ) -> Result<(), E> {
        for case in self.choose(named)? {
            let blessing = self.one(case).unwrap_or_else(|error| Blessing::Failed(error.to_string()));
            tell(case, &blessing)?;
        }
        Ok(())
    }

    fn choose(&self, named: &[String]) -> Result<Vec<&CheckedCase>> {
        let cases = &self.results.cases;
        if named.is_empty() {
            return Ok(cases.iter().filter(|case| case.pair.outcome != DiffOutcome::Same).collect());
        }
        let mut chosen = vec![false; cases.len()];
        for name in named {
            // A name may look like a pattern: of a file with brackets in its name.
            let exact = cases.iter().any(|case| case.id == *name);
            let glob = if exact { None } else { Some(glob(name).map_err(Error::Request)?) };
            let is_it = |case: &CheckedCase| glob.as_ref().map_or(case.id == *name, |glob| is_named(glob, &case.id));
            if !cases.iter().any(is_it) {
                let known: Vec<&str> = cases.iter().map(|case| case.id.as_str()).collect();
                return Err(crate::error::unknown("case", name, &known));
            }
            chosen.iter_mut().zip(cases).for_each(|(chosen, case)| *chosen |= is_it(case));
        }
        Ok(cases.iter().zip(chosen).filter(|(_, chosen)| *chosen).map(|(case, _)| case).collect())
    }

    fn one(&self, case: &CheckedCase) -> Result<Blessing> {
        let refused = |why: &str| Ok(Blessing::Refused(why.to_owned()));
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
        // Results may come from elsewhere.
        if !is_below(Path::new(actual)) {
            return refused("its candidate's path leads out of the output folder");
        }
        if !self.is_its_golden(case) {
            return refused("the golden that the results name is not this case's: its path leads out of there");
        }
        let candidate = self.output.join(actual);
        if hash_of(&candidate)? != *hash {
            return refused("the candidate is not the one that was checked; run `dejag check` again");
        }
        let golden = self.manifest.root.join(&case.blessed_as);
        let stands_there = hash_of(&golden).ok();
        if stands_there.is_none() && fs::symlink_metadata(&golden).is_ok() {
            return refused("what stands in the golden's place cannot be read; look at it, and remove it yourself");
        }
        if stands_there.as_ref() == Some(hash) {
            return Ok(Blessing::Already);
        }
        let own = case.pair.expected.as_deref() == Some(&case.blessed_as);
        if stands_there != case.golden.as_ref().and_then(|golden| golden.hash.clone()).filter(|_| own) {
            return refused("the golden has changed since the check; run `dejag check` again");
        }
        if !self.dry_run {
            copy(&candidate, &golden)?;
            // The candidate that lay where the golden was missing is the golden now. It may never have been there.
            let _ = fs::remove_file(beside(&golden));
        }
        Ok(if stands_there.is_some() { Blessing::Replaced } else { Blessing::Added })
    }

    /// Whether the golden has the case's own name, in a folder of the run's environment.
    fn is_its_golden(&self, case: &CheckedCase) -> bool {
        [self.results.environment.key.as_str(), ANY].iter().any(|environment| {
            let below = Path::new(&case.blessed_as).strip_prefix(self.manifest.goldens.join(environment));
            below.is_ok_and(|below| {
                is_below(below) && (below == Path::new(&case.id) || below.with_extension("") == Path::new(&case.id))
            })
        })
    }
}
