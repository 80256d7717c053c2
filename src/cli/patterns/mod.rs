//! `dejag patterns`: point sets measured and drawn.

mod choice;
mod density;
mod discrepancy;
mod draw;
mod drawn_means;
mod integrate;
mod output;
mod pixel_means;
mod report;
mod spectrum;
mod table;

use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

use clap::{Args, Subcommand};

use super::watch::{Bar, check_interrupt};
use crate::capture::Watch as _;
use crate::error::Error;
use crate::sampling::{MAX_SET_POINTS, PatternSpec};

/// Measure and draw point sets: discrepancies, spectra, errors of pixel means
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns table --trials 20
  dejag patterns draw mitchell --prefix 10,40,160,640,2560 -o mitchell.svg
  dejag patterns discrepancy hammersley -n 256 -o map.png
  dejag patterns spectrum jittered poisson-disk -o spectrum.svg
  dejag patterns integrate --test checker --csv errors.csv
  dejag patterns report -o patterns-report

`dejag list patterns` has all patterns with their parameters; a pattern is written NAME or NAME:PARAMETER=VALUE,...")]
pub(super) struct Patterns {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    Table(table::Table),
    Draw(draw::Draw),
    Discrepancy(discrepancy::Discrepancy),
    Spectrum(spectrum::Spectrum),
    Integrate(integrate::Integrate),
    Report(report::Report),
}

impl Patterns {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        match &self.what {
            What::Table(table) => table.run(),
            What::Draw(draw) => draw.run(),
            What::Discrepancy(discrepancy) => discrepancy.run(),
            What::Spectrum(spectrum) => spectrum.run(),
            What::Integrate(integrate) => integrate.run(),
            What::Report(report) => report.run(),
        }
    }
}

/// Which sets.
#[derive(Debug, Args)]
struct Sets {
    /// Points a set
    #[arg(short, long = "points", value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SET_POINTS)))]
    n: u32,
    /// The first trial's seed; each further one's is one more
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
}

impl Sets {
    /// How many different sets there are of a pattern: one if the seed makes no difference.
    fn trials(spec: &PatternSpec, most: u32) -> Result<u32, Error> {
        Ok(if uses_seed(spec)? { most } else { 1 })
    }

    fn of_trial(&self, spec: &PatternSpec, trial: u32) -> Result<Vec<[f64; 2]>, Error> {
        spec.points(self.n, self.seed.wrapping_add(trial))
    }
}

/// Whether the seed makes a difference; under some parameters it does where it does not under the others.
fn uses_seed(spec: &PatternSpec) -> Result<bool, Error> {
    const FEW: u32 = 16;
    Ok(spec.points(FEW, 0)? != spec.points(FEW, 1)?)
}

/// A bar that many threads move.
struct SharedBar(Mutex<Bar>);

impl SharedBar {
    fn new(total: u64, quiet: bool, message: &str) -> Self {
        let bar = Bar::new(total, quiet);
        bar.say(message.to_owned());
        Self(Mutex::new(bar))
    }

    /// So much of the step at hand is done.
    fn reach(&self, done: u32) {
        // Whoever wants to stop is heard when the step is over.
        let _ = self.0.lock().unwrap_or_else(PoisonError::into_inner).tick(done, 0);
    }

    /// So much more is done; an error if the user wants to stop.
    fn advance(&self, amount: u64) -> Result<(), Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).advance(amount);
        check_interrupt()
    }
}
