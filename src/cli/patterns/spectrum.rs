//! `dejag patterns spectrum`: what frequencies sets turn into noise, and which into patterns.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use rayon::prelude::*;

use super::choice::{Choice, all};
use super::output::{Figures, PictureKind};
use super::{Sets, SharedBar};
use crate::error::Error;
use crate::report::{self, Panel, Panels, power_map, spectrum_svg};
use crate::sampling::PatternSpec;
use crate::sampling::measure::{Periodogram, principal_frequency};
use crate::suite::SpectrumRow;

/// How far periodograms reach, in principal frequencies.
const REACH: f64 = 2.0;

/// How many sets are worked on side by side.
const AT_ONCE: usize = 64;

/// Of a periodogram in a picture, in pixels: at least, and times a whole number of its own.
const SIDE_PX: u32 = 384;

/// Power spectra: the periodogram averaged over sets, its radial mean and its anisotropy
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns spectrum jittered poisson-disk -o spectrum.svg
  dejag patterns spectrum lloyd:generations=400 --trials 12 -o lloyd.png --json lloyd.json

A periodogram has frequency 0 in the middle and reaches to 2 sqrt(n) cycles a side; grey is the power of white noise. A .png file \
holds the periodograms, an .svg file the curves too.")]
pub(super) struct Spectrum {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    sets: Sets,
    /// Sets of each pattern that uses the seed
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    trials: u32,
    /// Draw them into this file too: .png or .svg
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    figures: Figures,
}

impl Spectrum {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let specs = self.choice.specs(all)?;
        let kind = self.output.as_deref().map(PictureKind::check).transpose()?;
        self.figures.check()?;
        let trials: Vec<u32> = specs.iter().map(|spec| Sets::trials(spec, self.trials)).collect::<Result<_, Error>>()?;
        let bar = SharedBar::new(trials.iter().map(|t| u64::from(*t)).sum(), self.figures.quiet, "periodograms");
        let each = specs.iter().zip(&trials).map(|(spec, trials)| self.periodogram(spec, *trials, &bar));
        let periodograms: Vec<Periodogram> = each.collect::<Result<_, Error>>()?;
        drop(bar);
        let rows: Vec<SpectrumRow> = specs.iter().zip(&periodograms).map(|(spec, p)| self.row(spec, p)).collect();
        if let (Some(kind), Some(path)) = (kind, &self.output) {
            let panels = panels(&rows, &periodograms)?;
            kind.write(path, || Some(spectrum_svg(&panels, &rows)), || panels.picture())?;
        }
        self.figures.show(&rows, report::spectrum_table)?;
        Ok(ExitCode::SUCCESS)
    }

    /// Sets side by side, added in the order of their seeds, and never many of them in memory.
    fn periodogram(&self, spec: &PatternSpec, trials: u32, bar: &SharedBar) -> Result<Periodogram, Error> {
        let highest = (REACH * principal_frequency(self.sets.n as usize)).ceil() as usize;
        let of_trial = |trial: u32| {
            let periodogram = Periodogram::of(&self.sets.of_trial(spec, trial)?, highest);
            bar.advance(1)?;
            Ok(periodogram)
        };
        let mut sum = of_trial(0)?;
        for first in (1..trials).step_by(AT_ONCE) {
            let together = first..trials.min(first + AT_ONCE as u32);
            let each: Vec<Periodogram> = together.into_par_iter().map(of_trial).collect::<Result<_, Error>>()?;
            each.iter().for_each(|one| sum.add(one));
        }
        Ok(sum)
    }

    fn row(&self, spec: &PatternSpec, periodogram: &Periodogram) -> SpectrumRow {
        let figures = periodogram.figures(self.sets.n as usize);
        SpectrumRow {
            pattern: spec.to_string(),
            n: self.sets.n,
            trials: periodogram.sets(),
            low_quarter: figures.low_quarter,
            low_half: figures.low_half,
            low_largest: figures.low_largest,
            peak: figures.peak,
            peak_frequency: figures.peak_frequency,
            onset_frequency: figures.onset_frequency,
            anisotropy_db: Some(figures.anisotropy_db).filter(|db| db.is_finite()),
            anisotropy_floor_db: 10.0 * f64::from(periodogram.sets()).recip().log10(),
            axis: figures.axis,
            radial_mean: periodogram.radial_mean(),
            radial_anisotropy_db: periodogram
                .radial_anisotropy_db()
                .into_iter()
                .map(|db| db.filter(|db| db.is_finite()))
                .collect(),
        }
    }
}

fn panels(rows: &[SpectrumRow], periodograms: &[Periodogram]) -> Result<Panels, Error> {
    let side = |p: &Periodogram| 2 * p.highest() as u32 + 1;
    let panel = |(row, p): (&SpectrumRow, &Periodogram)| {
        let range = -(p.highest() as i32)..=p.highest() as i32;
        // Frequency 0 only says how many points there are.
        let power = |fx, fy| if (fx, fy) == (0, 0) { 0.0 } else { p.power(fx, fy) };
        let powers: Vec<f64> =
            range.clone().flat_map(|fy| range.clone().map(move |fx| (fx, fy))).map(|(x, y)| power(x, y)).collect();
        let title = format!("{}, {} sets", row.pattern, row.trials);
        Ok(Panel { title, ground: Some(power_map(&powers, side(p))?), points: Vec::new(), radius: 0.0, round: false })
    };
    let widest = periodograms.iter().map(side).max().unwrap_or(1);
    let panels = rows.iter().zip(periodograms).map(panel).collect::<Result<_, Error>>()?;
    Ok(Panels { panels, side_px: widest * SIDE_PX.div_ceil(widest) })
}
