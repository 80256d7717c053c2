//! `dejag merge`: the parts of a run put together.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use super::check::{RESULTS, ReportOptions, merged_places};
use super::output;
use super::shards::{Kind, read_json, read_results};
use crate::check::{folders_of, gather};
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::report::{self, HtmlReport, SequenceReport};
use crate::suite::{CheckResults, Part, Results, SequenceResults, merge};

/// Put the parts of a check, a score or a sequence together
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag merge shard-*/check.json --report report
  dejag merge dejag-check/shard-*/check.json --json whole.json --output dejag-check
  dejag merge part-*/results.json --report report

Takes what `--shard` runs of check, score or sequence wrote as JSON. The result is that of the whole run but for its times, in its \
order. For a report of scores and sequences name the results.json in the reports of the parts, where their pictures are; pictures \
of checks are looked for beside their results. With --output, a check's candidates and results come together in one folder, from \
which `dejag bless` takes them.

Exit codes: of checks, those of `dejag check`; of others 0; 2 if a part is absent, there twice, or of another run.")]
pub(super) struct Merge {
    /// The results of every part
    #[arg(value_name = "SHARD.json", required = true)]
    shards: Vec<PathBuf>,
    /// Of a check, the manifest, for the goldens in the report
    #[arg(long, value_name = "FILE", default_value = "dejag.toml")]
    manifest: PathBuf,
    /// Of a check, bring candidates, pictures of differences and results together in this folder
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportOptions,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    quiet: bool,
    /// Of a check, show also what is the same
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

type Parts<P> = Vec<(PathBuf, P)>;

impl Merge {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        // The first says what all of them must be.
        let first: Value = read_json(&self.shards[0], "result of a run")?;
        if first.get("scenes").is_some() {
            self.only_of_checks()?;
            self.scores(&self.read()?)
        } else if first.get("methods").is_some() {
            self.only_of_checks()?;
            self.sequences(&self.read()?)
        } else {
            self.checks(&self.read()?)
        }
    }

    fn read<P: Kind>(&self) -> Result<Parts<P>> {
        self.shards.iter().map(|path| Ok((path.clone(), read_results(path)?))).collect()
    }

    fn only_of_checks(&self) -> Result<()> {
        let given = [
            ("--output", self.output.is_some()),
            ("--junit", self.reports.junit.is_some()),
            ("--history", !self.reports.history.is_empty()),
        ];
        match given.iter().find(|(_, given)| *given) {
            Some((option, _)) => Err(Error::Request(format!("{option} is for the results of `dejag check`; leave it out"))),
            None => Ok(()),
        }
    }

    fn checks(&self, shards: &Parts<CheckResults>) -> anyhow::Result<ExitCode> {
        let results = merge(shards)?;
        let reports = self.reports.begin()?;
        let folders = folders_of(shards);
        if let Some(output) = &self.output {
            gather(&results, &folders, output)?;
            write_bytes_atomically(&output.join(RESULTS), report::json(&results).as_bytes())?;
        }
        let root = self.manifest.parent().unwrap_or(Path::new(""));
        reports.finish(&results, &self.manifest, |case| merged_places(case, root, &folders))?;
        let from = self.output.as_deref().map_or_else(|| "SHARD".to_owned(), |output| format!("'{}'", output.display()));
        self.reports.show(&results, self.verbose, self.quiet, &format!("dejag bless --from {from}"))
    }

    fn scores(&self, shards: &Parts<Results>) -> anyhow::Result<ExitCode> {
        let results = merge(shards)?;
        if let Some(folder) = &self.reports.report {
            let mut page = HtmlReport::begin(folder)?;
            for (path, part, place) in dealt(shards, |part| part.scenes.len()) {
                page.take_over(part, folder_of(path), place)?;
            }
            page.finish(&results)?;
        }
        self.tell(&report::json(&results), |color| report::table(&results, color))
    }

    fn sequences(&self, shards: &Parts<SequenceResults>) -> anyhow::Result<ExitCode> {
        let results = merge(shards)?;
        if let Some(folder) = &self.reports.report {
            let mut page = SequenceReport::begin(folder)?;
            for (here, (path, _, there)) in dealt(shards, |part| part.result.methods.len()).into_iter().enumerate() {
                page.take_over(results.result.frames.len(), folder_of(path), &[(there, here)])?;
            }
            page.finish(&results)?;
        }
        self.tell(&report::json(&results), |color| report::sequence_table(&results, color))
    }

    fn tell(&self, json: &str, table: impl Fn(bool) -> String) -> anyhow::Result<ExitCode> {
        match self.reports.json.as_deref() {
            Some(path) if path == Path::new("-") => output::print(json)?,
            Some(path) => write_bytes_atomically(path, json.as_bytes())?,
            None => {}
        }
        if self.reports.json.as_deref() != Some(Path::new("-")) {
            output::print(&table(output::is_colored()))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// What was dealt, in the order of the whole: the part that has it, and its place there. The parts are known to be whole.
fn dealt<P: Part>(shards: &Parts<P>, length: impl Fn(&P) -> usize) -> Vec<(&Path, &P, usize)> {
    let own = |part: &P| part.shard().map(|shard| shard.own.clone()).unwrap_or_default();
    let order = shards[0].1.shard().map(|shard| shard.dealt.clone()).unwrap_or_default();
    let mut found: Vec<(usize, (&Path, &P, usize))> = Vec::new();
    for (path, part) in shards {
        for (place, id) in own(part).iter().enumerate().take(length(part)) {
            found.push((order.iter().position(|dealt| dealt == id).unwrap_or(usize::MAX), (path, part, place)));
        }
    }
    found.sort_by_key(|(order, _)| *order);
    found.into_iter().map(|(_, found)| found).collect()
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}
