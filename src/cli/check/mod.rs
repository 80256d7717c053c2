//! `dejag check`: the cases of a manifest against their goldens.

mod ci;
mod draw;

use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context as _;
use clap::Args;

use self::draw::DrawOptions;
use super::diff::parse_bytes;
use super::output;
use super::shards::{ShardOptions, is_idle, read_results};
use super::watch::{Bar, check_interrupt};
use crate::check::{Entry, Journal, Manifest, Run, check_key};
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::report::{self, CasePictures, CheckReport};
use crate::suite::{CHECK_SCHEMA_VERSION, CheckResults, CheckedCase, DiffOutcome, OutcomeCounts, Shard, ShardStamp};

/// The results' name in the output folder, where `bless` finds them.
pub(super) const RESULTS: &str = "check.json";

/// Hold the cases of a manifest against their goldens
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag check
  dejag check 'edges-*' shots --report report
  dejag check --manifest ci/dejag.toml --json results.json --junit results.xml
  dejag check --shard 2/4 --costs last.json
  dejag check --resume

A manifest, dejag.toml, names scenes to draw with methods, sequences, and files or folders that something else made, with what \
each must meet (docs/check.md). Goldens lie in a folder for each environment (`dejag doctor` says which this is), and the \
nearest that is there is taken: llvmpipe-mesa-25.0.7, llvmpipe-mesa-25.0, ..., any. What is not right stays to be looked at in the \
output folder; `dejag bless` accepts it.

Outcomes: same; different: a limit is missed; size; profile: the values mean different colours; new: there is no golden; missing: \
there is no picture; unreadable; uncounted: the mask leaves no pixel; failed: it could not be drawn.

Exit codes: 0 all same; 1 any other; 2 a manifest or request that makes no sense; 3 something could not be read, drawn or \
written, whatever else differs; 4 nothing was compared.")]
pub(super) struct Check {
    /// Only cases whose id matches, or a part of it up to a '/': * and ? stand for characters [default: all]
    #[arg(value_name = "ID")]
    cases: Vec<String>,
    /// The manifest; its paths are relative to its folder
    #[arg(long, value_name = "FILE", default_value = "dejag.toml")]
    manifest: PathBuf,
    /// Where candidates, pictures of differences and results go [default: the manifest's, dejag-check beside it if it names none]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    shards: ShardOptions,
    /// Go on with an interrupted run: what was drawn by the same program from the same scenes is not drawn again
    #[arg(long)]
    resume: bool,
    /// Take goldens and tolerances of this environment, for files too [default: the driver's, and `any` for files]
    #[arg(long, value_name = "KEY")]
    environment: Option<String>,
    #[command(flatten)]
    reports: ReportOptions,
    /// List the cases instead
    #[arg(long)]
    list: bool,
    /// Most memory that one picture may take decoded, such as 512MiB; larger ones are not read
    #[arg(long, value_name = "SIZE", default_value = "2GiB", value_parser = parse_bytes)]
    max_memory: u64,
    #[command(flatten)]
    draw: DrawOptions,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    quiet: bool,
    /// Show also what is the same
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

/// Results in other forms.
#[derive(Debug, Args)]
pub(super) struct ReportOptions {
    /// Write the results as JSON too; - for stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    pub(super) json: Option<PathBuf>,
    /// Write the results as JUnit XML
    #[arg(long, value_name = "FILE")]
    pub(super) junit: Option<PathBuf>,
    /// Write a report with pictures into this folder
    #[arg(long, value_name = "DIR")]
    pub(super) report: Option<PathBuf>,
    /// Results of an earlier run, for the report's curves; give it again for more, the oldest first
    #[arg(long, value_name = "FILE", requires = "report")]
    pub(super) history: Vec<PathBuf>,
}

impl Check {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let manifest = Manifest::read(&self.manifest)?;
        self.environment.as_deref().map_or(Ok(()), check_key)?;
        let selected = manifest.select(&self.cases)?;
        let ids: Vec<&str> = selected.iter().map(|entry| entry.id.as_str()).collect();
        let shard = self.shards.deal::<CheckResults>(&ids)?;
        if self.list {
            let own = shard.map_or_else(|| ids.join("\n"), |shard| shard.own.join("\n"));
            output::print(&own)?;
            return Ok(ExitCode::SUCCESS);
        }
        let reports = self.reports.begin()?;
        let output = self.output_folder(&manifest);
        let path = output.join(RESULTS);
        let results = self.check(&manifest, &selected, shard, &output)?;
        write_bytes_atomically(&path, report::json(&results).as_bytes())?;
        let place = |case: &CheckedCase| places(case, &manifest.root, &output);
        reports.finish(&results, &self.manifest, place)?;
        self.reports.show(&results, self.verbose, self.quiet, &self.bless(&output))
    }

    /// The command that accepts what this run found.
    fn bless(&self, output: &Path) -> String {
        let mut words = vec!["dejag bless".to_owned()];
        if self.manifest != Path::new("dejag.toml") {
            words.push(format!("--manifest '{}'", self.manifest.display()));
        }
        if self.output.is_some() || self.shards.shard.is_some() {
            words.push(format!("--from '{}'", output.display()));
        }
        words.join(" ")
    }

    /// Shards of one run must not write over each other.
    fn output_folder(&self, manifest: &Manifest) -> PathBuf {
        let folder = || manifest.root.join(&manifest.output);
        self.output.clone().unwrap_or_else(|| match self.shards.shard {
            Some(Shard { index, count }) => folder().join(format!("shard-{index}-of-{count}")),
            None => folder(),
        })
    }

    fn check(
        &self,
        manifest: &Manifest,
        selected: &[&Entry],
        shard: Option<ShardStamp>,
        output: &Path,
    ) -> anyhow::Result<CheckResults> {
        let own: Option<BTreeSet<&String>> = shard.as_ref().map(|shard| shard.own.iter().collect());
        let is_own = |entry: &&Entry| own.as_ref().is_none_or(|own| own.contains(&entry.id));
        let entries: Vec<&Entry> = selected.iter().copied().filter(is_own).collect();
        let mut drawer = self.draw.open(manifest, selected)?;
        let stamp = drawer.as_ref().map(draw::AnyDrawer::stamp);
        let environment = crate::check::environment(self.environment.as_deref(), stamp);
        let run = Run {
            manifest,
            environment: &environment,
            environment_named: self.environment.is_some(),
            output,
            max_bytes: self.max_memory,
            watch: check_interrupt,
        };
        // Should this run not get to its end, the results of another must not stand for its own.
        remove(&output.join(RESULTS))?;
        let mut journal = Journal::open(output, self.resume)?;
        let mut bar = Bar::new(entries.len() as u64, self.quiet || entries.len() < 2);
        let mut done = 0;
        let mut begin = |entry: &Entry| {
            bar.advance(std::mem::replace(&mut done, 1));
            bar.say(entry.id.clone());
        };
        let cases = run.check(&entries, drawer.as_mut().map(draw::AnyDrawer::as_dyn), &mut journal, &mut begin)?;
        bar.finish();
        Ok(CheckResults {
            schema_version: CHECK_SCHEMA_VERSION,
            dejag: env!("CARGO_PKG_VERSION").to_owned(),
            command: self.command(),
            manifest: manifest.hash.clone(),
            counts: OutcomeCounts::of(cases.iter().map(|case| case.pair.outcome)),
            unused_goldens: run.unused_goldens(),
            environment,
            shard,
            cases,
        })
    }

    /// The command line that makes this run again, without what says where results go and how the work is dealt.
    fn command(&self) -> Vec<String> {
        let mut words = vec!["check".to_owned()];
        words.extend(self.cases.iter().cloned());
        words.extend(["--manifest".into(), self.manifest.to_string_lossy().into_owned()]);
        words.extend(self.environment.iter().flat_map(|key| ["--environment".to_owned(), key.clone()]));
        words.extend(self.draw.words());
        words
    }
}

/// A file that may not be there.
fn remove(path: &Path) -> Result<()> {
    match std::fs::remove_file(path) {
        Err(error) if !matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            Err(Error::io("remove", path)(error))
        }
        _ => Ok(()),
    }
}

/// Where a case's pictures lie on this machine.
fn places(case: &CheckedCase, root: &Path, output: &Path) -> CasePictures {
    CasePictures {
        expected: case.pair.expected.as_ref().map(|path| root.join(path)),
        actual: case.pair.actual.as_ref().map(|path| output.join(path)),
        heat: case.pair.pictures.first().map(|path| output.join(path)),
    }
}

/// As [`places`], each case's files beside the results of its shard.
pub(super) fn merged_places(case: &CheckedCase, root: &Path, folders: &BTreeMap<String, PathBuf>) -> CasePictures {
    folders.get(&case.id).map_or_else(CasePictures::default, |folder| places(case, root, folder))
}

/// Reports that are begun, so that what is in their way is found out before the work.
#[derive(Debug)]
pub(super) struct Reports<'a> {
    options: &'a ReportOptions,
    page: Option<CheckReport>,
    history: Vec<CheckResults>,
}

impl ReportOptions {
    fn json_file(&self) -> Option<&Path> {
        self.json.as_deref().filter(|path| *path != Path::new("-"))
    }

    pub(super) fn begin(&self) -> Result<Reports<'_>> {
        self.json_file().map_or(Ok(()), |path| output::check_results(path, "{"))?;
        self.junit.as_deref().map_or(Ok(()), |path| output::check_results(path, "<?xml"))?;
        let history = self.history.iter().map(|path| read_results(path)).collect::<Result<_>>()?;
        Ok(Reports { options: self, page: self.report.as_deref().map(CheckReport::begin).transpose()?, history })
    }

    /// Says what came of it, and with which exit code.
    pub(super) fn show(&self, results: &CheckResults, verbose: bool, quiet: bool, bless: &str) -> anyhow::Result<ExitCode> {
        if self.json.as_deref() == Some(Path::new("-")) {
            output::print(&report::json(results))?;
        } else {
            let text = report::check_text(results, verbose, output::is_colored());
            if !text.is_empty() {
                output::print(&text)?;
            }
        }
        if let (Some(folder), false) = (&self.report, quiet) {
            let page = std::path::absolute(folder.join("index.html")).context("finding the report")?;
            output::say(&format!("report: {}", page.display()));
        }
        let code = exit_code(results);
        let summary = report::check_summary(results);
        match code {
            3 => output::say(&format!("error: {summary}; some pictures could not be read or drawn")),
            4 => output::say(&format!("error: nothing was compared: {summary}")),
            _ if !quiet => output::say(&summary),
            _ => {}
        }
        let can_be_blessed = |case: &CheckedCase| case.candidate_hash.is_some() && case.pair.outcome != DiffOutcome::Same;
        if code == 1 && !quiet && results.cases.iter().any(can_be_blessed) {
            output::say(&format!("look at them; what is right: {bless} ID..., or without an ID for all"));
        }
        Ok(ExitCode::from(code))
    }
}

/// A shard that was dealt nothing has done all that was asked of it.
fn exit_code(results: &CheckResults) -> u8 {
    if is_idle(results.shard.as_ref()) { 0 } else { results.counts.exit_code() }
}

impl Reports<'_> {
    pub(super) fn finish(
        self,
        results: &CheckResults,
        manifest: &Path,
        places: impl Fn(&CheckedCase) -> CasePictures,
    ) -> anyhow::Result<()> {
        if let Some(path) = self.options.json_file() {
            write_bytes_atomically(path, report::json(results).as_bytes())?;
        }
        if let Some(path) = &self.options.junit {
            write_bytes_atomically(path, report::check_junit(results).as_bytes())?;
        }
        if let Some(page) = self.page {
            page.finish(results, &self.history, places, &mut |_| check_interrupt())?;
        }
        ci::tell_github(results, manifest)
    }
}
