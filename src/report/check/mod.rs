//! The report of `dejag check`: a folder with one page that opens from disk, every case with its pictures and their values.

mod case;
mod facts;
mod files;
mod history;
mod page;
mod plain_png;
mod thumbnail;
mod viewer;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::folder::{REPORT, Staging};
use super::json;
use crate::picture::write_bytes_atomically;
use crate::suite::{CheckResults, CheckedCase, DiffOutcome};
use crate::{Error, Result};
use files::CaseFiles;

/// Cases whose pictures are decoded at once. Each takes some 40 bytes a pixel meanwhile.
const CASES_AT_ONCE: usize = 4;

/// Where the pictures of a case lie on this machine. What is absent is not at hand; what cannot be read is shown as that.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CasePictures {
    /// The golden.
    pub expected: Option<PathBuf>,
    /// The candidate.
    pub actual: Option<PathBuf>,
    /// The heat map of their difference.
    pub heat: Option<PathBuf>,
}

/// A report that takes its place once it is whole. Begun early it finds out early that a folder is taken. Dropped unfinished, it
/// leaves nothing.
#[derive(Debug)]
pub struct CheckReport {
    staging: Staging,
}

impl CheckReport {
    /// Begins a report that is to become the folder `dir`. Nothing is seen there until [`Self::finish`].
    ///
    /// # Errors
    ///
    /// [`Error::Request`] if `dir` holds anything but a report; [`Error::Io`] if it cannot be written.
    pub fn begin(dir: &Path) -> Result<Self> {
        let staging = Staging::begin(REPORT, dir)?;
        for folder in ["pictures", "pixels"] {
            let folder = staging.path().join(folder);
            std::fs::create_dir(&folder).map_err(Error::io("create the folder", &folder))?;
        }
        Ok(Self { staging })
    }

    /// Writes pictures, page and results, and puts the folder in its place. `history` are earlier results, oldest first;
    /// `pictures` says where those of a case lie; `watch` is called in order as cases are done, and stops everything with an error.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written, and whatever `watch` fails with. A picture that cannot be read is none: the page says
    /// why.
    pub fn finish(
        self,
        results: &CheckResults,
        history: &[CheckResults],
        pictures: impl Fn(&CheckedCase) -> CasePictures,
        watch: &mut dyn FnMut(&CheckedCase) -> Result<()>,
    ) -> Result<()> {
        let mut files = Vec::with_capacity(results.cases.len());
        for (batch, cases) in results.cases.chunks(CASES_AT_ONCE).enumerate() {
            let jobs: Vec<_> = cases.iter().zip(batch * CASES_AT_ONCE..).map(|(case, i)| (i + 1, case, pictures(case))).collect();
            let write = |(number, case, pictures): &(usize, &CheckedCase, CasePictures)| {
                CaseFiles::write(self.staging.path(), *number, case, pictures)
            };
            files.extend(jobs.par_iter().map(write).collect::<Result<Vec<_>>>()?);
            cases.iter().try_for_each(&mut *watch)?;
        }
        let page = page::page(results, history, &files);
        self.save("index.html", page.as_bytes())?;
        self.save("check.js", viewer::SCRIPT.as_bytes())?;
        self.save("check.json", json(results).as_bytes())?;
        self.staging.publish()
    }

    fn save(&self, name: &str, bytes: &[u8]) -> Result<()> {
        write_bytes_atomically(&self.staging.path().join(name), bytes)
    }
}

/// Whether nobody has to look at it.
fn is_same(case: &CheckedCase) -> bool {
    case.pair.outcome == DiffOutcome::Same
}

#[cfg(test)]
mod tests;
