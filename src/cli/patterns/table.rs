//! `dejag patterns table`: how even each pattern's sets are.

use std::process::ExitCode;
use std::time::Instant;

use clap::Args;
use rayon::prelude::*;

use super::choice::{Choice, all};
use super::output::Figures;
use super::{Sets, SharedBar};
use crate::error::Error;
use crate::report;
use crate::sampling::PatternSpec;
use crate::sampling::measure::{Nearest, Spread, Surroundings, nearest, star, star_l2, stroud, stroud_on_lattice, stroud_torus};
use crate::suite::{NearestFigures, PatternRow, PatternTiming};

/// Discrepancies and distances of many sets of each pattern
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns table --trials 20
  dejag patterns table random jittered n-rooks --trials 1000 --json figures.json
  dejag patterns table --lattice 100 --patterns regular,lloyd:generations=40,raster=512,ccpd:capacity=256
  dejag patterns table hammersley --points 256 --torus --timing

Each set of a pattern is a trial with a seed of its own. A pattern that does not use the seed has one set. JSON has plain values; \
the table shows them times 1000.")]
pub(super) struct Table {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    sets: Sets,
    /// Sets of each pattern that uses the seed
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Sum T over rectangles with corners on a lattice of so many steps a side, instead of its closed form
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    lattice: Option<u32>,
    /// T over the torus too, where rectangles wrap around
    #[arg(long)]
    torus: bool,
    /// How long a set takes to make, too; that differs from run to run
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    figures: Figures,
}

/// What is measured on one set.
#[derive(Debug, Clone, Copy)]
struct Trial {
    star: f64,
    l2: f64,
    stroud: f64,
    stroud_torus: f64,
    nearest: Option<Nearest>,
    nearest_torus: Option<Nearest>,
    generate_ms: f64,
}

impl Table {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let specs = self.choice.specs(all)?;
        self.figures.check()?;
        let rows = self.rows(&specs)?;
        self.figures.show(&rows, report::pattern_table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Trials of all patterns run side by side; their order in the sums is that of their seeds.
    fn rows(&self, specs: &[PatternSpec]) -> Result<Vec<PatternRow>, Error> {
        let mut jobs: Vec<(usize, u32)> = Vec::new();
        for (i, spec) in specs.iter().enumerate() {
            jobs.extend((0..Sets::trials(spec, self.trials)?).map(|trial| (i, trial)));
        }
        let bar = SharedBar::new(jobs.len() as u64, self.figures.quiet, "sets");
        let measured = |&(i, trial): &(usize, u32)| {
            let figures = self.trial(&specs[i], trial)?;
            bar.advance(1)?;
            Ok((i, figures))
        };
        // One job at a time, or one thread would be left with all the trials of the slowest pattern.
        let trials: Vec<(usize, Trial)> = jobs.par_iter().with_max_len(1).map(measured).collect::<Result<_, Error>>()?;
        let of_spec = |i: usize| trials.iter().filter(|(j, _)| *j == i).map(|(_, trial)| *trial).collect::<Vec<_>>();
        Ok(specs.iter().enumerate().map(|(i, spec)| self.row(spec, &of_spec(i))).collect())
    }

    fn trial(&self, spec: &PatternSpec, trial: u32) -> Result<Trial, Error> {
        let start = Instant::now();
        let points = self.sets.of_trial(spec, trial)?;
        let generate_ms = start.elapsed().as_secs_f64() * 1e3;
        Ok(Trial {
            star: star(&points),
            l2: star_l2(&points),
            stroud: self.lattice.map_or_else(|| stroud(&points), |lines| stroud_on_lattice(&points, lines)),
            stroud_torus: if self.torus { stroud_torus(&points) } else { 0.0 },
            nearest: nearest(&points, Surroundings::Open),
            nearest_torus: nearest(&points, Surroundings::Torus),
            generate_ms,
        })
    }

    fn row(&self, spec: &PatternSpec, trials: &[Trial]) -> PatternRow {
        let spread = |figure: fn(&Trial) -> f64| {
            Spread::of(&trials.iter().map(figure).collect::<Vec<_>>()).expect("a pattern has at least one trial")
        };
        let (star, l2, stroud) = (spread(|t| t.star), spread(|t| t.l2), spread(|t| t.stroud));
        PatternRow {
            pattern: spec.to_string(),
            n: self.sets.n,
            trials: trials.len(),
            star: star.mean,
            star_sd: star.standard_deviation(),
            l2: l2.mean,
            l2_sd: l2.standard_deviation(),
            stroud: stroud.mean,
            stroud_rms: stroud.rms,
            stroud_variance: stroud.variance,
            stroud_sd: stroud.standard_deviation(),
            stroud_se: stroud.standard_error(),
            lattice: self.lattice,
            stroud_torus: self.torus.then(|| spread(|t| t.stroud_torus).mean),
            nearest: mean_nearest(trials.iter().map(|t| t.nearest)),
            nearest_torus: mean_nearest(trials.iter().map(|t| t.nearest_torus)),
            timing: self
                .timing
                .then(|| PatternTiming { generate_ms: trials.iter().map(|t| t.generate_ms).fold(f64::INFINITY, f64::min) }),
        }
    }
}

/// None if the sets have no neighbours.
fn mean_nearest(found: impl Iterator<Item = Option<Nearest>>) -> Option<NearestFigures> {
    let found: Vec<Nearest> = found.collect::<Option<_>>()?;
    let mean = |figure: fn(&Nearest) -> f64| found.iter().map(figure).sum::<f64>() / found.len() as f64;
    Some(NearestFigures { smallest: mean(|nearest| nearest.smallest), mean: mean(|nearest| nearest.mean) })
}
