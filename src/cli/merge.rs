//! `dejag merge`: the shards of a run put together.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use super::check::{RESULTS, ReportOptions, merged_places, read_results};
use crate::check::{folders_of, gather, merge};
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::report;
use crate::suite::CheckResults;

/// Put the shards of a check together
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag merge shard-*/check.json --report report
  dejag merge dejag-check/shard-*/check.json --json whole.json --output dejag-check

The result is that of the whole run but for its times, in the manifest's order. Pictures are looked for beside each of the files. \
With --output, candidates and results come together in one folder, from which `dejag bless` takes them.

Exit codes: those of `dejag check`; 2 if a shard is absent, there twice, or of another run.")]
pub(super) struct Merge {
    /// The results of every shard
    #[arg(value_name = "SHARD.json", required = true)]
    shards: Vec<PathBuf>,
    /// The manifest, for the goldens in the report
    #[arg(long, value_name = "FILE", default_value = "dejag.toml")]
    manifest: PathBuf,
    /// Bring candidates, pictures of differences and results together in this folder
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportOptions,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    quiet: bool,
    /// Show also what is the same
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

impl Merge {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let shards: Vec<(PathBuf, CheckResults)> =
            self.shards.iter().map(|path| Ok((path.clone(), read_results(path)?))).collect::<Result<_, Error>>()?;
        let results = merge(&shards)?;
        let reports = self.reports.begin()?;
        let folders = folders_of(&shards);
        if let Some(output) = &self.output {
            gather(&results, &folders, output)?;
            write_bytes_atomically(&output.join(RESULTS), report::json(&results).as_bytes())?;
        }
        let root = self.manifest.parent().unwrap_or(Path::new(""));
        reports.finish(&results, &self.manifest, |case| merged_places(case, root, &folders))?;
        self.reports.show(&results, self.verbose, self.quiet)
    }
}
