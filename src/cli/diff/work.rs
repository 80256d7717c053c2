//! Pairs compared on all cores, as many at once as memory allows.

use std::path::Path;

use rayon::prelude::*;

use super::super::watch::{Bar, check_interrupt};
use super::targets::Plan;
use crate::compare::{Settings, wave_length};
use crate::error::{Blame, Error, Result};
use crate::suite::{DiffOutcome, DiffPair};

pub(super) struct Work<'a> {
    pub(super) settings: &'a Settings,
    pub(super) plans: &'a [Plan],
    /// Whether these are two named files, not what folders hold.
    pub(super) named: bool,
}

impl Work<'_> {
    /// In the order of the plans.
    pub(super) fn run(&self, quiet: bool) -> Result<Vec<DiffPair>> {
        let mut bar = Bar::new(self.plans.len() as u64, quiet || self.plans.len() < 2);
        let mut pairs = Vec::with_capacity(self.plans.len());
        let mut rest = self.plans;
        while !rest.is_empty() {
            check_interrupt()?;
            let wave = wave_length(rest, |plan| [&plan.pair.expected, &plan.pair.actual]);
            let (wave, later) = rest.split_at(wave);
            bar.say(wave[0].pair.path.to_string_lossy().replace(char::is_control, "\u{fffd}"));
            let compared: Vec<DiffPair> = wave.par_iter().map(|plan| self.pair(plan)).collect::<Result<_>>()?;
            pairs.extend(compared);
            bar.advance(wave.len() as u64);
            rest = later;
        }
        bar.finish();
        Ok(pairs)
    }

    /// What is wrong with the files is the pair's matter, what is wrong with the request is everybody's.
    fn pair(&self, plan: &Plan) -> Result<DiffPair> {
        check_interrupt()?;
        let pair = match (&plan.pair.expected, &plan.pair.actual) {
            (Some(expected), Some(actual)) => self.both(plan, expected, actual)?,
            (expected, actual) => {
                let outcome = if actual.is_none() { DiffOutcome::Missing } else { DiffOutcome::New };
                DiffPair::of_sides(expected.as_deref(), actual.as_deref(), outcome)
            }
        };
        let path = (!self.named).then(|| plan.pair.path.to_string_lossy().into_owned());
        Ok(DiffPair { path, ..pair })
    }

    fn both(&self, plan: &Plan, expected: &Path, actual: &Path) -> Result<DiffPair> {
        match self.settings.compare(expected, actual, &plan.targets) {
            Err(error) if error.blame() == Blame::World => {
                Ok(DiffPair::named(expected, actual).ended(DiffOutcome::Unreadable, error.to_string()))
            }
            Err(Error::Request(why)) if !self.named => Err(Error::Request(format!("{}: {why}", plan.pair.path.display()))),
            other => other,
        }
    }
}
