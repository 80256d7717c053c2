//! Where pictures of differences go, checked before the first file is read.

use clap::Args;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::super::output;
use crate::compare::{Listing, PathPair, Targets};
use crate::error::{Error, Result};
use crate::picture::FileFormat;

/// Pictures of a pair that is different.
#[derive(Debug, Args)]
pub(super) struct TargetOptions {
    /// Write heat map, triptych and flip-book of each pair into this folder, which is made
    #[arg(short, long, value_name = "DIR", help_heading = PICTURES)]
    output: Option<PathBuf>,
    /// Of two files, write the differences as colours on the darkened picture
    #[arg(long, value_name = "FILE.png", help_heading = PICTURES)]
    heat: Option<PathBuf>,
    /// Of two files, write expected, actual and heat map side by side
    #[arg(long, value_name = "FILE.png", help_heading = PICTURES)]
    triptych: Option<PathBuf>,
    /// Of two files, write an animation that shows them by turns
    #[arg(long, value_name = "FILE.png", help_heading = PICTURES)]
    flip_book: Option<PathBuf>,
}

const PICTURES: &str = "Pictures of what is different (a pair that is the same gets none)";

/// A pair and its pictures.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) pair: PathPair,
    pub(super) targets: Targets,
}

impl TargetOptions {
    pub(super) fn plans(&self, listing: &Listing, [expected, actual]: [&Path; 2], folders: bool) -> Result<Vec<Plan>> {
        let named = Targets { heat: self.heat.clone(), triptych: self.triptych.clone(), flip_book: self.flip_book.clone() };
        if folders {
            if let Some(path) = named.all().next() {
                let path = path.display();
                return Err(Error::Request(format!(
                    "{path} would be one picture of many pairs; name a folder with --output instead"
                )));
            }
            self.check_outside([expected, actual])?;
        }
        for path in named.all() {
            if output::check_file(path)? != FileFormat::Png {
                return Err(Error::Request(format!("{} is no PNG; pictures of differences are written as .png", path.display())));
            }
        }
        self.output.as_deref().map_or(Ok(()), check_folder)?;
        let plans: Vec<Plan> =
            listing.pairs.iter().map(|pair| Plan { pair: pair.clone(), targets: self.targets(&named, pair) }).collect();
        check_apart(&plans)?;
        Ok(plans)
    }

    /// Those that are named, and for the rest those in the folder.
    fn targets(&self, named: &Targets, pair: &PathPair) -> Targets {
        let within = |kind: &str| {
            let mut name = OsString::from(pair.path.as_os_str());
            name.push(format!(".{kind}.png"));
            self.output.as_ref().map(|folder| folder.join(name))
        };
        Targets {
            heat: named.heat.clone().or_else(|| within("heat")),
            triptych: named.triptych.clone().or_else(|| within("triptych")),
            flip_book: named.flip_book.clone().or_else(|| within("flip-book")),
        }
    }

    /// What is written into a folder that is compared would be compared the next time.
    fn check_outside(&self, compared: [&Path; 2]) -> Result<()> {
        let Some(output) = self.output.as_deref().and_then(resolved) else { return Ok(()) };
        for folder in compared {
            if fs::canonicalize(folder).is_ok_and(|folder| output.starts_with(folder)) {
                let (output, folder) = (output.display(), folder.display());
                return Err(Error::Request(format!("{output} lies in {folder}, which is compared; name a folder outside it")));
            }
        }
        Ok(())
    }
}

/// The path without links, of which the end need not exist yet.
fn resolved(path: &Path) -> Option<PathBuf> {
    let path = std::path::absolute(path).ok()?;
    let there = path.ancestors().find(|ancestor| ancestor.exists())?;
    let rest = path.strip_prefix(there).ok()?;
    Some(fs::canonicalize(there).ok()?.join(rest))
}

/// The folder can be made and written into.
fn check_folder(output: &Path) -> Result<()> {
    if output.exists() && !output.is_dir() {
        return Err(Error::Request(format!("{} is a file; name a folder", output.display())));
    }
    let there = output.ancestors().find(|path| path.exists() && !path.as_os_str().is_empty());
    output::check_writable(there.unwrap_or(Path::new(".")))
}

/// No picture over an input, and no two in one place.
fn check_apart(plans: &[Plan]) -> Result<()> {
    let inputs = plans.iter().flat_map(|plan| [&plan.pair.expected, &plan.pair.actual]).flatten();
    let inputs: BTreeSet<PathBuf> = inputs.filter_map(|path| fs::canonicalize(path).ok()).collect();
    let mut taken = BTreeSet::new();
    for path in plans.iter().flat_map(|plan| plan.targets.all()) {
        let place = fs::canonicalize(path).ok().or_else(|| resolved(path)).unwrap_or_else(|| path.clone());
        if inputs.contains(&place) {
            return Err(Error::Request(format!("{} is one of the pictures that are compared; write elsewhere", path.display())));
        }
        if !taken.insert(place) {
            return Err(Error::Request(format!("{} is named for two pictures; name two files", path.display())));
        }
    }
    Ok(())
}
