//! What is read and where it is written: settled, and checked, before the first picture is opened.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf, is_separator};

use super::super::output::{check_folder_of, check_writable};
use crate::error::{Error, Result};
use crate::picture::FileKind;

/// One picture to make.
#[derive(Debug)]
pub(super) struct Job {
    pub(super) input: PathBuf,
    pub(super) output: PathBuf,
    /// What is written.
    pub(super) kind: FileKind,
}

/// All pictures to make.
#[derive(Debug)]
pub(super) struct Plan {
    /// In the order they were named, folders in the order of their entries' names.
    pub(super) jobs: Vec<Job>,
    /// Where they go, if that is a folder.
    pub(super) folder: Option<PathBuf>,
    /// How many files in folders do not look like pictures.
    pub(super) skipped: usize,
    /// Folders below the given ones that could not be read.
    pub(super) failures: Vec<Error>,
}

impl Plan {
    pub(super) fn of(inputs: &[PathBuf], output: &Path, force: bool) -> Result<Self> {
        let mut plan = Self { jobs: Vec::new(), folder: None, skipped: 0, failures: Vec::new() };
        match inputs {
            [input] if !is_folder(input)? && !wants_folder(output) => {
                let kind = FileKind::of_path(output)?;
                check_folder_of(output)?;
                plan.jobs.push(Job { input: input.clone(), output: output.to_path_buf(), kind });
            }
            inputs => plan.fill_folder(inputs, output)?,
        }
        check_outputs(&plan.jobs, force)?;
        Ok(plan)
    }

    fn fill_folder(&mut self, inputs: &[PathBuf], output: &Path) -> Result<()> {
        check_folder(output)?;
        self.folder = Some(output.to_path_buf());
        let own = fs::canonicalize(output).ok();
        for input in inputs {
            if is_folder(input)? {
                let entries = entries(input)?;
                self.walk(entries, output, own.as_deref());
            } else {
                // A path that ends in .. is a folder.
                let output = output.join(input.file_name().unwrap_or_default());
                self.jobs.push(Job { kind: FileKind::of_path(&output)?, input: input.clone(), output });
            }
        }
        if self.jobs.is_empty() && self.failures.is_empty() {
            let names: Vec<String> = inputs.iter().map(|input| input.display().to_string()).collect();
            return Err(Error::Request(format!(
                "there is no picture in {}; pictures end in .png, .jpg, .jpeg, .webp or .exr",
                names.join(", ")
            )));
        }
        Ok(())
    }

    /// Takes what is in a folder; what goes to `into`. Links to folders are not followed, they may lead in a circle.
    fn walk(&mut self, entries: Vec<Entry>, into: &Path, own: Option<&Path>) {
        for Entry { path, name } in entries {
            let output = into.join(&name);
            let kind = FileKind::of_path(&path).ok().filter(|_| path.is_file());
            if path.is_dir() && !path.is_symlink() {
                if own.is_none() || fs::canonicalize(&path).ok().as_deref() != own {
                    match self::entries(&path) {
                        Ok(entries) => self.walk(entries, &output, own),
                        Err(error) => self.failures.push(error),
                    }
                }
            } else if let Some(kind) = kind {
                self.jobs.push(Job { input: path, output, kind });
            } else {
                self.skipped += 1;
            }
        }
    }
}

struct Entry {
    path: PathBuf,
    name: std::ffi::OsString,
}

/// What is in a folder, in the order of the names' bytes.
fn entries(folder: &Path) -> Result<Vec<Entry>> {
    let listing = fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>).map_err(Error::io("read", folder))?;
    let mut entries: Vec<Entry> =
        listing.into_iter().map(|entry| Entry { path: entry.path(), name: entry.file_name() }).collect();
    entries.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(entries)
}

/// Whether an input is a folder; what is neither that nor a file, such as a pipe, is refused.
fn is_folder(input: &Path) -> Result<bool> {
    let what = fs::metadata(input).map_err(Error::io("read", input))?;
    if !what.is_dir() && !what.is_file() {
        return Err(Error::Request(format!("{} is neither a file nor a folder; name one of them", input.display())));
    }
    Ok(what.is_dir())
}

/// Whether the user means a folder: there is one, or the name ends as a folder's does.
fn wants_folder(output: &Path) -> bool {
    output.is_dir() || output.to_string_lossy().ends_with(is_separator)
}

/// The folder can be made and take files; nothing is made yet.
fn check_folder(output: &Path) -> Result<()> {
    if !output.is_dir() {
        let name = output.display();
        if output.exists() {
            return Err(Error::Request(format!("{name} is a file; several pictures need a folder, name a new one")));
        }
        if FileKind::of_path(output).is_ok() && !wants_folder(output) {
            return Err(Error::Request(format!(
                "{name} names one picture, and there may be several; name a folder, or end it in / if you mean one"
            )));
        }
    }
    let there = output.ancestors().find(|path| path.exists()).unwrap_or(Path::new("."));
    check_writable(if there.as_os_str().is_empty() { Path::new(".") } else { there })
}

/// No two outputs in one place, and none over an input unless `force` lets it replace its own.
fn check_outputs(jobs: &[Job], force: bool) -> Result<()> {
    let inputs: HashMap<PathBuf, usize> =
        jobs.iter().enumerate().filter_map(|(index, job)| Some((fs::canonicalize(&job.input).ok()?, index))).collect();
    let mut outputs: HashMap<&Path, &Path> = HashMap::new();
    for (index, job) in jobs.iter().enumerate() {
        let (input, output) = (job.input.display(), job.output.display());
        if let Some(other) = outputs.insert(&job.output, &job.input) {
            if fs::canonicalize(other).ok() == fs::canonicalize(&job.input).ok() {
                return Err(Error::Request(format!("{input} is named twice; name it once")));
            }
            return Err(Error::Request(format!(
                "{} and {input} would both become {output}; filter them one after the other into different folders",
                other.display()
            )));
        }
        match fs::canonicalize(&job.output).ok().and_then(|path| inputs.get(&path)) {
            Some(&own) if own == index && force => {}
            Some(&own) if own == index => {
                return Err(Error::Request(format!(
                    "{output} is the input itself; write elsewhere, or give --force to replace it"
                )));
            }
            Some(_) => {
                return Err(Error::Request(format!("{input} would replace {output}, another input; write elsewhere")));
            }
            None => {}
        }
    }
    Ok(())
}
