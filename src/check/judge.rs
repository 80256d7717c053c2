//! A candidate held against its golden: what comes of it, and what may explain it.

use std::fs;
use std::path::{Path, PathBuf};

use super::causes::likely_causes;
use super::entry::{Entry, slashed};
use super::run::Run;
use super::slot::{Slot, beside, copy, hash_of};
use crate::compare::{Scope, Settings, Targets, guarded};
use crate::error::Blame;
use crate::suite::{CaseTiming, CheckedCase, DiffOutcome, DiffPair};
use crate::{Error, Result};

impl Run<'_> {
    /// Holds a candidate against its golden.
    pub(super) fn judge(&self, entry: &Entry, slot: &Slot) -> Result<CheckedCase> {
        let candidate = self.output.join(slot.candidate());
        let Some(found) = slot.golden(self.manifest, self.key(entry)) else {
            return Ok(self.without_golden(entry, slot, &candidate));
        };
        let heat = self.output.join(slot.heat());
        let mut pair = match self.compare(entry, slot, &found.path, &candidate) {
            Ok(pair) => pair,
            Err(error) if error.blame() == Blame::World => self.unreadable(&error),
            Err(error) if error.blame() == Blame::Interrupt => return Err(error),
            Err(error) => {
                let why = format!("its mask or regions do not fit: {error}");
                DiffPair::of_sides(None, None, DiffOutcome::Failed).ended(DiffOutcome::Failed, why)
            }
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
        if case.pair.outcome != DiffOutcome::Same {
            case.likely_causes = likely_causes(&found.golden, self.key(entry), self.environment);
        }
        case.golden = Some(found.golden);
        case.candidate_hash = hash_of(&candidate).ok();
        Ok(case)
    }

    /// A pair that is different is looked at again, with all metrics: which limit would have passed?
    fn compare(&self, entry: &Entry, slot: &Slot, golden: &Path, candidate: &Path) -> Result<DiffPair> {
        let tolerance = self.manifest.tolerance(entry, &slot.id, self.key(entry), &self.environment.platform);
        let read = |mask: &PathBuf| {
            let mask = guarded(&self.manifest.root.join(mask), self.max_bytes);
            mask.map_err(|error| Error::Request(format!("of its mask: {error}")))
        };
        let mask = entry.mask.as_ref().map(read).transpose()?;
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
            let pair = DiffPair { actual: Some(slashed(&slot.candidate())), ..self.unreadable(&error) };
            return self.case(entry, slot, pair);
        }
        let blessed = slot.blessed(self.manifest, self.key(entry));
        let left = beside(&blessed);
        let place = match copy(candidate, &self.manifest.root.join(&left)) {
            Ok(()) => format!("the candidate is {}", slashed(&left)),
            Err(error) => format!("the candidate is {} ({error})", slashed(&slot.candidate())),
        };
        let mut pair = DiffPair::of_sides(None, None, DiffOutcome::New)
            .ended(DiffOutcome::New, format!("there is no golden {}; {place}", slashed(&blessed)));
        pair.actual = Some(slashed(&slot.candidate()));
        CheckedCase { candidate_hash: hash_of(candidate).ok(), ..self.case(entry, slot, pair) }
    }

    /// What could not be read or written, in words that are the same whatever the output folder is called.
    pub(super) fn unreadable(&self, error: &Error) -> DiffPair {
        let output = format!("{}/", self.output.display());
        let why = error.to_string().replace(&output, "");
        DiffPair::of_sides(None, None, DiffOutcome::Unreadable).ended(DiffOutcome::Unreadable, why)
    }

    pub(super) fn case(&self, entry: &Entry, slot: &Slot, mut pair: DiffPair) -> CheckedCase {
        pair.lossy = slot.below.to_str().is_none();
        let mut golden = None;
        if pair.outcome == DiffOutcome::Missing
            && let Some(found) = slot.golden(self.manifest, self.key(entry))
        {
            pair.expected = Some(slashed(&slot.blessed(self.manifest, &found.golden.environment)));
            pair.why = Some("its golden is there, its picture is not".into());
            golden = Some(found.golden);
        }
        CheckedCase {
            id: slot.id.clone(),
            entry: entry.id.clone(),
            about: entry.about(),
            golden,
            candidate_hash: None,
            blessed_as: slashed(&slot.blessed(self.manifest, self.key(entry))),
            likely_causes: Vec::new(),
            pair,
            timing: CaseTiming { seconds: 0.0 },
        }
    }
}
