//! `dejag patterns report`: what each pattern makes of a picture, beside the exact one.

mod chapter;
mod function;
mod plans;
mod scene;
mod source;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::super::watch::Bar;
use super::super::{Drawing, capture::load, output, parse_size};
use super::choice::Listed;
use super::drawn_means;
use crate::capture::{Cache, REFERENCE_SPEC};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::report::SeriesReport;
use crate::sampling::PatternSpec;
use crate::suite::{SERIES_SCHEMA_VERSION, SeriesResults, Stamp};
use chapter::Plan;
use scene::Drawn;
use source::boxed;

/// Write a report with pictures: what few and many samples of each pattern make of a floor and of a zone plate
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns report
  dejag patterns report --patterns random,jittered,ccpd,larcher-pillichshammer -o few
  dejag patterns report --spp 1,4,256 --size 320x180

The folder has a page, index.html, that opens from disk, and takes about 25 MB. A floor and a zone plate are sampled on the CPU, \
where patterns that use the seed have another set in each pixel (of 1024, as `integrate --pool 1024`): their errors are noise. Beside \
that the same set is in all pixels, as always where a scene is drawn: on the scene `checker` with `ssaa`, and on the zone plate. Errors \
are patterns then. First come `checker` and `fence` at 1 sample a pixel, in its middle, and at 256 jittered ones. Takes half a minute on \
two cores without a GPU, and as long again for the references of a new --size.")]
pub(super) struct Report {
    #[command(flatten)]
    choice: Listed,
    /// Samples a pixel
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "1,16,64", value_parser = clap::value_parser!(u32).range(1..=4096))]
    spp: Vec<u32>,
    /// Of drawn pictures, in pixels
    #[arg(long, value_name = "WxH", default_value = "256x256", value_parser = parse_size)]
    size: [u32; 2],
    /// Of the patterns that use chance
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u32,
    /// Where to write: a new or empty folder, or a report, which is replaced
    #[arg(short, long, value_name = "DIR", default_value = "patterns-report")]
    output: PathBuf,
    #[command(flatten)]
    drawing: Drawing,
}

impl Report {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let specs = self.choice.specs()?;
        let counts = self.counts();
        // What cannot be drawn is refused before anything is.
        for spec in &specs {
            drawn_means::method(spec, self.seed, counts[0])?;
        }
        let report = SeriesReport::begin(&self.output)?;
        let gpu = self.drawing.open()?;
        gpu.check_size(self.size)?;
        let results = self.results(&specs, &counts, &gpu, &report)?;
        report.finish(&results)?;
        if !self.drawing.quiet {
            output::say(&format!("wrote {}", self.output.join("index.html").display()));
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Rising, each once.
    fn counts(&self) -> Vec<u32> {
        let mut counts = self.spp.clone();
        counts.sort_unstable();
        counts.dedup();
        counts
    }

    fn results(&self, specs: &[PatternSpec], counts: &[u32], gpu: &Gpu, report: &SeriesReport) -> Result<SeriesResults> {
        let [checker, fence] = ["checker", "fence"].map(|name| load(name, self.drawing.quiet));
        let (checker, fence) = (checker?, fence?);
        let reference = Spec::parse(REFERENCE_SPEC)?;
        let cache = Cache::of_user();
        let drawn = |scene| Drawn::new(gpu, scene, self.size, self.seed, &reference, &cache).map(boxed);
        let plans = [
            plans::moire(drawn(&checker)?, drawn(&fence)?)?,
            plans::floor(drawn(&checker)?, self.seed, specs, counts)?,
            plans::zone_plate(self.seed, specs, counts)?,
        ];
        let mut bar = Bar::new(plans.iter().map(Plan::work).sum(), self.drawing.quiet);
        let chapters = plans.into_iter().enumerate().map(|(number, plan)| plan.carry_out(number, report, &mut bar));
        Ok(SeriesResults {
            schema_version: SERIES_SCHEMA_VERSION,
            stamp: Stamp::from(&gpu.card),
            command: self.command(specs, counts),
            chapters: chapters.collect::<Result<_>>()?,
        })
    }

    /// The command line that makes this report again, defaults written out.
    fn command(&self, specs: &[PatternSpec], counts: &[u32]) -> Vec<String> {
        let list = |words: Vec<String>| words.join(",");
        let [width, height] = self.size;
        let options = [
            ("--patterns", list(specs.iter().map(PatternSpec::to_string).collect())),
            ("--spp", list(counts.iter().map(u32::to_string).collect())),
            ("--size", format!("{width}x{height}")),
            ("--seed", self.seed.to_string()),
            ("--adapter", self.drawing.adapter.to_string()),
        ];
        let words = options.into_iter().flat_map(|(name, value)| [name.to_owned(), value]);
        ["patterns".to_owned(), "report".to_owned()].into_iter().chain(words).collect()
    }
}
