//! Exactly known functions, on the CPU.

use rayon::prelude::*;

use super::super::{SharedBar, check_interrupt, uses_seed};
use super::Integrate;
use crate::error::{Error, Result};
use crate::sampling::integrals::PixelTest;
use crate::sampling::{PatternSpec, hash};
use crate::suite::{IntegralError, IntegralRow};

/// How many points all sets of a pool have together, if nothing else is asked for.
const POOL_POINTS: u32 = 1 << 20;

/// Of fewer, what is common to them by chance would show; more than pixels are of no use.
const POOL_SETS: (u32, u32) = (256, 65_536);

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
        let errors = |job: &Job<'_>| {
            let rms = self.errors(&test, job)?;
            bar.advance(u64::from(job.spp))?;
            Ok(rms)
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
                    sets: self.sets_of(job).to_owned(),
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

    fn sets_of(&self, job: &Job<'_>) -> &'static str {
        match (job.seeded, self.shift) {
            (true, _) => "fresh",
            (false, true) => "shifted",
            (false, false) => "fixed",
        }
    }

    fn errors(&self, test: &PixelTest, job: &Job<'_>) -> Result<Vec<(&'static str, f64)>> {
        let seeded = job.seeded;
        let sets = if seeded { self.pool.unwrap_or((POOL_POINTS / job.spp).clamp(POOL_SETS.0, POOL_SETS.1)) } else { 1 };
        let set = |k: u32| {
            check_interrupt()?;
            job.spec.points(job.spp, self.seed.wrapping_add(k))
        };
        let pool: Vec<Vec<[f64; 2]>> = (0..sets).into_par_iter().map(set).collect::<Result<_>>()?;
        let shifted = !seeded && self.shift;
        let error = |pixel: usize| {
            // By chance: in turn, squares of pixels that are averaged would have the same few sets again and again.
            let points = pool[(hash(pixel as u64) % pool.len() as u64) as usize].iter();
            if shifted {
                let shift = shift_of(self.seed, pixel);
                test.error(pixel, points.map(|p| [0, 1].map(|k| (p[k] + shift[k]).fract())))
            } else {
                test.error(pixel, points.copied())
            }
        };
        let errors: Vec<f64> = (0..test.pixels()).into_par_iter().map(error).collect();
        Ok(test.rms(&errors))
    }
}

/// Cranley and Patterson's (1976): the same for all points of a pixel, uniform over the torus.
fn shift_of(seed: u32, pixel: usize) -> [f64; 2] {
    [0, 1].map(|k| (hash(hash(u64::from(seed)) ^ (2 * pixel as u64 + k)) >> 11) as f64 / (1u64 << 53) as f64)
}
