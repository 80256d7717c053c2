//! Exactly known functions, on the CPU.

use rayon::prelude::*;

use super::super::pixel_means::PixelSets;
use super::super::{SharedBar, uses_seed};
use super::Integrate;
use crate::error::{Error, Result};
use crate::sampling::PatternSpec;
use crate::sampling::integrals::PixelTest;
use crate::suite::{IntegralError, IntegralRow};

/// Half a gigabyte.
const MOST_POINTS: u64 = 1 << 25;

/// A pattern at one number of samples.
struct Job<'a> {
    spec: &'a PatternSpec,
    seeded: bool,
    spp: u32,
}

impl Integrate {
    /// Patterns and numbers of samples side by side, the sets of a pool too.
    pub(super) fn on_pixels(&self, name: &str, specs: &[PatternSpec], counts: &[u32]) -> Result<Vec<IntegralRow>> {
        self.check_pool(counts)?;
        let test = PixelTest::new(name, self.yaw)?;
        let title = if self.yaw == 0.0 { name.to_owned() } else { format!("{name}, yaw {}", self.yaw) };
        let total = specs.len() as u64 * counts.iter().map(|spp| u64::from(*spp)).sum::<u64>();
        let bar = SharedBar::new(total, self.drawing.quiet, name);
        let seeded: Vec<bool> = specs.iter().map(uses_seed).collect::<Result<_>>()?;
        let of_spec = |(spec, &seeded)| counts.iter().map(move |&spp| Job { spec, seeded, spp });
        let jobs: Vec<Job<'_>> = specs.iter().zip(&seeded).flat_map(of_spec).collect();
        let sets = self.pixel_sets();
        let errors = |job: &Job<'_>| {
            let errors = sets.errors(&test, job.spec, job.seeded, job.spp)?;
            bar.advance(u64::from(job.spp))?;
            Ok(test.rms(&errors))
        };
        let all: Vec<Vec<(&str, f64)>> = jobs.par_iter().with_max_len(1).map(errors).collect::<Result<_>>()?;
        let rows = jobs.chunks(counts.len()).zip(all.chunks(counts.len())).flat_map(|(jobs, by_count)| {
            let (job, title) = (&jobs[0], &title);
            (0..by_count[0].len()).map(move |part| {
                let errors: Vec<IntegralError> =
                    counts.iter().zip(by_count).map(|(&spp, parts)| IntegralError { spp, rms: parts[part].1 }).collect();
                IntegralRow {
                    test: title.clone(),
                    part: by_count[0][part].0.to_owned(),
                    pattern: job.spec.to_string(),
                    sets: sets.describe(job.seeded).to_owned(),
                    slope: IntegralRow::slope_of(&errors),
                    errors,
                }
            })
        });
        Ok(rows.collect())
    }

    fn check_pool(&self, counts: &[u32]) -> Result<()> {
        let most = counts.iter().copied().max().unwrap_or(1);
        match self.pool {
            Some(sets) if u64::from(sets) * u64::from(most) > MOST_POINTS => Err(Error::Request(format!(
                "--pool: {sets} sets of {most} points do not fit; together they may have {MOST_POINTS} points"
            ))),
            _ => Ok(()),
        }
    }

    fn pixel_sets(&self) -> PixelSets {
        PixelSets { seed: self.seed, pool: self.pool, shift: self.shift }
    }
}
