//! A run: candidates made, each held against its golden.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use rayon::prelude::*;

use super::Manifest;
use super::causes::likely_causes;
use super::entry::{Drawing, Entry, Format, Subject, slashed};
use super::environment::{ANY, chain};
use super::journal::{Drawn, Journal};
use super::slot::{CANDIDATE_MARK, Slot, beside, copy, hash_of, length_of, make_folder_of};
use crate::compare::{Filter, Scope, Settings, Targets, guarded, list_one, wave_length};
use crate::error::Blame;
use crate::picture::{Loaded, Raster, texts, with_png_texts, write_bytes_atomically};
use crate::suite::{CaseTiming, CheckedCase, DiffOutcome, DiffPair, Environment, Stamp};
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
    /// [`Error::Request`] if masks or regions do not fit; [`Error::Io`] if the journal cannot be written; what [`Run::watch`] answers.
    /// Whatever is wrong with a single picture is its outcome.
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
        let source = drawer.source(&entry.subject)?;
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

    fn store(&self, entry: &Entry, drawing: &Drawing, frame: Option<i64>, picture: &Loaded) -> Result<Drawn> {
        let slot = Slot::drawn(&entry.id, frame, drawing.format.extension());
        let path = self.output.join(slot.candidate());
        make_folder_of(&path)?;
        let which = frame.or(match entry.subject {
            Subject::Capture(_, frame) => Some(frame.into()),
            _ => None,
        });
        let (provenance, frame_text) = (self.provenance(&entry.id), which.map(|frame| frame.to_string()));
        let mut words: Vec<(&str, &str)> = provenance.iter().map(|(key, value)| (*key, value.as_str())).collect();
        words.extend([("scene", drawing.scene.as_str()), ("method", drawing.method.as_str())]);
        words.extend(frame_text.as_deref().map(|frame| ("frame", frame)));
        match drawing.format {
            Format::Exr => picture.clone().into_linear().save_exr(&path, &words)?,
            Format::Png | Format::Png16 => picture.clone().into_display().save_png(&path, drawing.format.depth(), &words)?,
        }
        Ok(Drawn { frame, hash: hash_of(&path)? })
    }

    /// What a candidate's file says of its making.
    fn provenance(&self, id: &str) -> Vec<(&'static str, String)> {
        let Environment { key, platform, stamp } = self.environment;
        let mut words = vec![("Software", format!("dejag {}", env!("CARGO_PKG_VERSION")))];
        words.extend([("environment", key.clone()), ("platform", platform.clone())]);
        if let Some(Stamp { adapter, kind, driver, driver_version, backend, .. }) = stamp {
            words.push(("adapter", format!("{adapter} ({kind}; {driver} {driver_version}; {backend})")));
        }
        words.push(("command", format!("dejag check '{id}' --manifest '{}'", slashed(&self.manifest.path))));
        words
    }

    fn file(&self, entry: &Entry, path: &Path) -> Result<CheckedCase> {
        let slot = Slot::file(&entry.id, path);
        let source = self.manifest.root.join(path);
        let missing = !source.exists() && slot.golden(self.manifest, self.key(entry)).is_some();
        self.supplied(entry, &slot, (!missing).then_some(&source))
    }

    fn folder(&self, entry: &Entry, path: &Path, filter: &Filter) -> Result<Vec<CheckedCase>> {
        let root = self.manifest.root.join(path);
        let (mut found, mut failures) = list_one(&root, filter);
        let ours = self.own_folders_below(&root);
        found.retain(|below| !ours.iter().any(|ours| below.starts_with(ours)));
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
            failures.push(Error::Request(format!("{} holds no pictures that it asks for", root.display())));
        }
        let slot = Slot::file(&entry.id, Path::new(""));
        let unreadable = |error: &Error| self.case(entry, &slot, DiffPair::failed(&root, error));
        cases.extend(failures.first().map(unreadable));
        Ok(cases)
    }

    /// The output folder and the goldens, if they lie below a folder of pictures, whose pictures they are not.
    fn own_folders_below(&self, root: &Path) -> Vec<PathBuf> {
        let goldens = self.manifest.root.join(&self.manifest.goldens);
        let Ok(root) = fs::canonicalize(root) else { return Vec::new() };
        let below = |folder: &Path| fs::canonicalize(folder).ok()?.strip_prefix(&root).ok().map(Path::to_path_buf);
        [self.output, &goldens].into_iter().filter_map(below).collect()
    }

    /// A picture that something else made: taken over, then held against its golden.
    fn supplied(&self, entry: &Entry, slot: &Slot, source: Option<&PathBuf>) -> Result<CheckedCase> {
        let start = Instant::now();
        let mut case = match source {
            None => self.case(entry, slot, DiffPair::of_sides(None, None, DiffOutcome::Missing)),
            Some(source) => match self.take_over(entry, slot, source) {
                Ok(()) => self.judge(entry, slot)?,
                Err(error) => {
                    let pair = DiffPair::of_sides(None, Some(source), DiffOutcome::Unreadable);
                    self.case(entry, slot, pair.ended(DiffOutcome::Unreadable, error.to_string()))
                }
            },
        };
        case.timing.seconds = start.elapsed().as_secs_f64();
        Ok(case)
    }

    /// Copies a file to the candidates, a PNG with words on where it was checked; words that it has already stay.
    fn take_over(&self, entry: &Entry, slot: &Slot, source: &Path) -> Result<()> {
        let target = self.output.join(slot.candidate());
        let length = length_of(source)?;
        if length > self.max_bytes || !starts_like_png(source) {
            return copy(source, &target);
        }
        let bytes = fs::read(source).map_err(Error::io("read", source))?;
        let (known, provenance) = (texts(source), self.provenance(&entry.id));
        let new = provenance.iter().filter(|(key, _)| !known.contains_key(*key));
        let new: Vec<(&str, &str)> = new.map(|(key, value)| (*key, value.as_str())).collect();
        make_folder_of(&target)?;
        write_bytes_atomically(&target, &with_png_texts(&bytes, &new).unwrap_or(bytes))
    }

    /// The environment whose goldens an entry has: what something else made belongs to none that we know.
    fn key(&self, entry: &Entry) -> &str {
        if entry.drawing().is_some() || self.environment_named { &self.environment.key } else { ANY }
    }

    /// Holds a candidate against its golden.
    fn judge(&self, entry: &Entry, slot: &Slot) -> Result<CheckedCase> {
        let candidate = self.output.join(slot.candidate());
        let Some(found) = slot.golden(self.manifest, self.key(entry)) else {
            return Ok(self.without_golden(entry, slot, &candidate));
        };
        let heat = self.output.join(slot.heat());
        let mut pair = match self.compare(entry, slot, &found.path, &candidate) {
            Ok(pair) => pair,
            Err(error) if error.blame() == Blame::World => {
                DiffPair::named(&found.path, &candidate).ended(DiffOutcome::Unreadable, error.to_string())
            }
            Err(Error::Request(why)) => return Err(Error::Request(format!("{}: {why}", slot.id))),
            Err(error) => return Err(error),
        };
        if pair.pictures.is_empty() {
            // Of an earlier run, and wrong now.
            let _ = fs::remove_file(&heat);
        } else {
            pair.pictures = vec![slashed(&slot.heat())];
        }
        pair.expected = Some(slashed(&slot.blessed(self.manifest, &found.golden.environment)));
        pair.actual = Some(slashed(&slot.candidate()));
        let mut case = self.case(entry, slot, pair);
        case.likely_causes = likely_causes(&found.golden, self.key(entry), self.environment);
        case.golden = Some(found.golden);
        case.candidate_hash = hash_of(&candidate).ok();
        Ok(case)
    }

    /// A pair that is different is looked at again, with all metrics: which limit would have passed?
    fn compare(&self, entry: &Entry, slot: &Slot, golden: &Path, candidate: &Path) -> Result<DiffPair> {
        let tolerance = self.manifest.tolerance(entry, &slot.id, self.key(entry), &self.environment.platform);
        let mask = entry.mask.as_ref().map(|mask| Raster::read(&self.manifest.root.join(mask), self.max_bytes)).transpose()?;
        let mut settings = Settings {
            limits: tolerance.limits(),
            scope: Scope::new(mask, entry.ignored.clone()),
            ignore_profile: tolerance.ignore_profile.unwrap_or(false),
            sweep: false,
            max_bytes: self.max_bytes,
            watch: self.watch,
        };
        let pair = settings.compare(golden, candidate, &Targets::default())?;
        if pair.outcome != DiffOutcome::Different {
            return Ok(pair);
        }
        settings.sweep = true;
        settings.compare(golden, candidate, &Targets { heat: Some(self.output.join(slot.heat())), ..Targets::default() })
    }

    /// The candidate is left where its golden should be, to be looked at. What cannot be read must not become one.
    fn without_golden(&self, entry: &Entry, slot: &Slot, candidate: &Path) -> CheckedCase {
        if let Err(error) = guarded(candidate, self.max_bytes) {
            let mut pair =
                DiffPair::of_sides(None, None, DiffOutcome::Unreadable).ended(DiffOutcome::Unreadable, error.to_string());
            pair.actual = Some(slashed(&slot.candidate()));
            return self.case(entry, slot, pair);
        }
        let blessed = slot.blessed(self.manifest, self.key(entry));
        let left = beside(&blessed);
        let place = match copy(candidate, &self.manifest.root.join(&left)) {
            Ok(()) => format!("the candidate is {}", slashed(&left)),
            Err(error) => format!("the candidate is {} ({error})", slashed(&slot.candidate())),
        };
        let mut pair = DiffPair::of_sides(None, None, DiffOutcome::New)
            .ended(DiffOutcome::New, format!("there is no golden {}; {place}; if it is right: dejag bless", slashed(&blessed)));
        pair.actual = Some(slashed(&slot.candidate()));
        CheckedCase { candidate_hash: hash_of(candidate).ok(), ..self.case(entry, slot, pair) }
    }

    fn case(&self, entry: &Entry, slot: &Slot, mut pair: DiffPair) -> CheckedCase {
        pair.lossy = slot.below.to_str().is_none();
        if pair.outcome == DiffOutcome::Missing
            && let Some(found) = slot.golden(self.manifest, self.key(entry))
        {
            pair.expected = Some(slashed(&slot.blessed(self.manifest, &found.golden.environment)));
            pair.why = Some("its golden is there, its picture is not".into());
        }
        CheckedCase {
            id: slot.id.clone(),
            entry: entry.id.clone(),
            about: entry.about(),
            golden: None,
            candidate_hash: None,
            blessed_as: slashed(&slot.blessed(self.manifest, self.key(entry))),
            likely_causes: Vec::new(),
            pair,
            timing: CaseTiming { seconds: 0.0 },
        }
    }

    /// Goldens of the environments in use that no entry of the manifest has, relative to its folder.
    #[must_use]
    pub fn unused_goldens(&self) -> Vec<String> {
        let Ok(pictures) = Filter::new(&[], &[]) else { return Vec::new() };
        let mut unused = Vec::new();
        for key in [self.environment.key.as_str(), ANY] {
            let folder = self.manifest.goldens_of(key);
            if !folder.is_dir() {
                continue;
            }
            let (found, _) = list_one(&folder, &pictures);
            let used = |below: &PathBuf| is_candidate(below) || self.manifest.entries.iter().any(|entry| uses(entry, below));
            let unused_here = found.into_iter().filter(|below| !used(below));
            unused.extend(unused_here.map(|below| slashed(&self.manifest.goldens.join(key).join(below))));
        }
        unused.sort();
        unused.dedup();
        unused
    }
}

/// Whether a golden below an environment's folder is an entry's.
fn uses(entry: &Entry, below: &Path) -> bool {
    match &entry.subject {
        Subject::Capture(drawing, _) => below == Slot::drawn(&entry.id, None, drawing.format.extension()).below,
        Subject::File(path) => below == Slot::file(&entry.id, path).below,
        Subject::Folder(..) => below.starts_with(&entry.id),
        Subject::Sequence(drawing, frames) => {
            let inside = below.strip_prefix(&entry.id).ok();
            let name = inside.and_then(Path::to_str).and_then(|name| name.strip_suffix(drawing.format.extension()));
            let frame = name.and_then(|name| name.strip_suffix('.')).and_then(|name| name.parse::<i64>().ok());
            frame.is_some_and(|frame| frames.contains(&frame))
        }
    }
}

fn is_candidate(below: &Path) -> bool {
    below.file_name().is_some_and(|name| name.to_string_lossy().contains(CANDIDATE_MARK))
}

fn starts_like_png(path: &Path) -> bool {
    let mut head = [0; 8];
    fs::File::open(path)
        .and_then(|mut file| std::io::Read::read_exact(&mut file, &mut head))
        .is_ok_and(|()| head == *b"\x89PNG\r\n\x1a\n")
}
