//! A run: candidates made, each held against its golden.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;

use super::Manifest;
use super::entry::{Entry, Subject, slashed};
use super::environment::{ANY, chain};
use super::journal::{self, Journal};
use super::slot::{CANDIDATES, DIFFERENCES, Slot, is_absence, is_candidate};
use crate::compare::{Filter, list_one, wave_length};
use crate::error::Blame;
use crate::picture::Loaded;
use crate::suite::{CheckedCase, DiffOutcome, DiffPair, Environment, Stamp};
use crate::{Error, Result};

/// Draws what entries ask for. Implemented where there is a GPU.
pub trait Drawer {
    /// What draws.
    fn stamp(&self) -> Stamp;

    /// Stands for all that shapes pictures: what has the same is drawn alike. Finds out early what cannot be drawn.
    ///
    /// # Errors
    ///
    /// Of a scene, frame or method that does not exist or makes no sense.
    fn source(&mut self, subject: &Subject) -> Result<String>;

    /// Draws one frame, or several in a row of which each knows the ones before, and hands each over.
    ///
    /// # Errors
    ///
    /// Of drawing, and what `found` answers.
    fn draw(&mut self, subject: &Subject, found: &mut dyn FnMut(Option<i64>, Loaded) -> Result<()>) -> Result<()>;
}

/// What a run takes place in.
#[derive(Debug)]
pub struct Run<'a> {
    /// What is checked.
    pub manifest: &'a Manifest,
    /// Where.
    pub environment: &'a Environment,
    /// Whether the environment was named by the user, who then means files too.
    pub environment_named: bool,
    /// Where candidates and pictures of differences go.
    pub output: &'a Path,
    /// Bytes that a decoded picture may take.
    pub max_bytes: u64,
    /// Asked now and then whether to go on.
    pub watch: fn() -> Result<()>,
}

impl Run<'_> {
    /// Checks these entries in turn; `begin` is called before each.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if the journal cannot be written; what [`Run::watch`] answers. Whatever is wrong with a single picture is its
    /// outcome.
    pub fn check(
        &self,
        entries: &[&Entry],
        mut drawer: Option<&mut (dyn Drawer + '_)>,
        journal: &mut Journal,
        begin: &mut dyn FnMut(&Entry),
    ) -> Result<Vec<CheckedCase>> {
        let mut cases = Vec::new();
        for entry in entries {
            (self.watch)()?;
            begin(entry);
            cases.extend(match (&entry.subject, &mut drawer) {
                (Subject::File(path), _) => vec![self.file(entry, path)?],
                (Subject::Folder(path, filter), _) => self.folder(entry, path, filter)?,
                (_, Some(drawer)) => self.drawn(entry, *drawer, journal)?,
                (_, None) => return Err(Error::Request(format!("{} is drawn, and nothing here can draw", entry.id))),
            });
        }
        Ok(cases)
    }

    fn drawn(&self, entry: &Entry, drawer: &mut dyn Drawer, journal: &mut Journal) -> Result<Vec<CheckedCase>> {
        let start = Instant::now();
        let drawing = entry.drawing().expect("only what is drawn gets here");
        let extension = drawing.format.extension();
        // What its file says of its making is a part of it too.
        let source = format!("{} {:?}", drawer.source(&entry.subject)?, self.provenance(entry));
        let mut pictures = journal.pictures(&entry.id, &source, self.output, extension).unwrap_or_default();
        let mut failure = None;
        if pictures.is_empty() {
            let made = drawer.draw(&entry.subject, &mut |frame, picture| {
                (self.watch)()?;
                pictures.push(self.store(entry, drawing, frame, &picture)?);
                Ok(())
            });
            match made {
                Ok(()) => journal.keep(&entry.id, &source, pictures.clone())?,
                Err(error) if error.blame() == Blame::Interrupt => return Err(error),
                Err(error) => failure = Some(error.to_string()),
            }
        }
        let slots = pictures.iter().map(|drawn| Slot::drawn(&entry.id, drawn.frame, extension));
        let mut cases: Vec<CheckedCase> = slots.map(|slot| self.judge(entry, &slot)).collect::<Result<_>>()?;
        if let Some(why) = failure {
            let slot = Slot::drawn(&entry.id, None, extension);
            let pair = DiffPair::of_sides(None, None, DiffOutcome::Failed).ended(DiffOutcome::Failed, why);
            cases.push(self.case(entry, &slot, pair));
        }
        let seconds = start.elapsed().as_secs_f64() / cases.len().max(1) as f64;
        cases.iter_mut().for_each(|case| case.timing.seconds = seconds);
        Ok(cases)
    }

    fn file(&self, entry: &Entry, path: &Path) -> Result<CheckedCase> {
        let slot = Slot::file(&entry.id, path);
        let source = self.manifest.root.join(path);
        let absent = fs::symlink_metadata(&source).is_err_and(|error| is_absence(&error));
        let missing = absent && slot.golden(self.manifest, self.key(entry)).is_some();
        self.supplied(entry, &slot, (!missing).then_some(&source))
    }

    fn folder(&self, entry: &Entry, path: &Path, filter: &Filter) -> Result<Vec<CheckedCase>> {
        let root = self.manifest.root.join(path);
        let (mut found, mut failures) = list_one(&root, filter);
        let ours = self.own_folders_below(&root);
        found.retain(|below| !ours.iter().any(|ours| below.starts_with(ours)) && !is_put_out(&root, below));
        let mut slots: Vec<(Slot, Option<PathBuf>)> =
            found.into_iter().map(|below| (Slot::in_folder(&entry.id, &below), Some(root.join(below)))).collect();
        for environment in chain(self.key(entry), &self.manifest.fallback) {
            let goldens = self.manifest.goldens_of(&environment).join(&entry.id);
            if goldens.is_dir() {
                let (kept, failed) = list_one(&goldens, filter);
                let slots_of = kept.iter().filter(|below| !is_candidate(below)).map(|below| Slot::in_folder(&entry.id, below));
                slots.extend(slots_of.map(|slot| (slot, None)));
                failures.extend(failed);
            }
        }
        // Of one name the file comes before the golden, since sorting keeps the order of equals.
        slots.sort_by(|(a, _), (b, _)| a.below.cmp(&b.below));
        slots.dedup_by(|(later, _), (first, _)| later.below == first.below);
        let mut cases = Vec::with_capacity(slots.len());
        let mut rest = &slots[..];
        while !rest.is_empty() {
            (self.watch)()?;
            let (wave, later) = rest.split_at(wave_length(rest, |(_, source)| [source, source]));
            let checked: Vec<CheckedCase> =
                wave.par_iter().map(|(slot, source)| self.supplied(entry, slot, source.as_ref())).collect::<Result<_>>()?;
            cases.extend(checked);
            rest = later;
        }
        if cases.is_empty() && failures.is_empty() {
            let what = if root.is_file() { "is a file; name it with `file`" } else { "holds no pictures that it asks for" };
            failures.push(Error::Request(format!("{} {what}", root.display())));
        }
        let slot = Slot::file(&entry.id, Path::new(""));
        let unreadable = |error: &Error| self.case(entry, &slot, DiffPair::failed(&root, error));
        cases.extend(failures.first().map(unreadable));
        Ok(cases)
    }

    /// Goldens and the manifest's output folder, if they lie below a folder of pictures, whose pictures they are not.
    fn own_folders_below(&self, root: &Path) -> Vec<PathBuf> {
        let Ok(root) = fs::canonicalize(root) else { return Vec::new() };
        let below = |folder: &Path| Some(fs::canonicalize(folder).ok()?.strip_prefix(&root).ok()?.to_path_buf());
        let own = [&self.manifest.goldens, &self.manifest.output].map(|folder| below(&self.manifest.root.join(folder)));
        // Pictures may lie in the output folder itself.
        own.into_iter().flatten().filter(|below| below != Path::new("")).collect()
    }

    /// A picture that something else made: taken over, then held against its golden.
    fn supplied(&self, entry: &Entry, slot: &Slot, source: Option<&PathBuf>) -> Result<CheckedCase> {
        let start = Instant::now();
        let mut case = match source {
            None => self.case(entry, slot, DiffPair::of_sides(None, None, DiffOutcome::Missing)),
            Some(source) => match self.take_over(entry, slot, source) {
                Ok(()) => named_after(source, slot, self.judge(entry, slot)?),
                Err(error) => self.case(entry, slot, self.unreadable(&error)),
            },
        };
        case.timing.seconds = start.elapsed().as_secs_f64();
        Ok(case)
    }

    /// The environment whose goldens an entry has: what something else made belongs to none that we know.
    pub(super) fn key(&self, entry: &Entry) -> &str {
        if entry.drawing().is_some() || self.environment_named { &self.environment.key } else { ANY }
    }
}

/// Words on an unreadable copy are on the picture that it is a copy of.
fn named_after(source: &Path, slot: &Slot, mut case: CheckedCase) -> CheckedCase {
    if case.pair.outcome == DiffOutcome::Unreadable {
        let copy = slashed(&slot.candidate());
        case.pair.why = case.pair.why.map(|why| why.replace(&copy, &source.to_string_lossy()));
    }
    case
}

/// Whether a picture is one that a run put out: in a report, or among the candidates and differences beside a journal.
fn is_put_out(root: &Path, below: &Path) -> bool {
    below.ancestors().skip(1).any(|folder| {
        let named = |name: &str| folder.file_name().is_some_and(|own| own == name);
        let folder = root.join(folder);
        folder.join("dejag-report.txt").is_file()
            || (named(CANDIDATES) || named(DIFFERENCES)) && folder.with_file_name(journal::FILE).is_file()
    })
}
