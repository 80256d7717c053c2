//! `dejag diff`: pictures compared.

mod limits;
mod targets;
mod work;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use self::limits::LimitOptions;
pub(super) use self::limits::parse_bytes;
use self::targets::TargetOptions;
use self::work::Work;
use super::output;
use super::watch::check_interrupt;
use crate::compare::{Filter, Listing, PathPair, Settings, list};
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::report;
use crate::suite::{DIFF_SCHEMA_VERSION, DiffPair, DiffResults, OutcomeCounts};

/// Compare pictures, or folders of them
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag diff expected.png actual.png
  dejag diff expected.png actual.png --max-pixels 0.1% --per-channel 2/255 --heat heat.png
  dejag diff goldens shots --max-flip 0.01 --json results.json --junit results.xml -o differences
  dejag diff goldens shots --exclude 'wip/**' --allow-edges
  dejag diff before.exr after.exr --max-rmse 1e-4 --ignore 0,0,200,40

Without a limit a single differing pixel is too many. What is compared are values, in the depth of their files: PNG, JPEG, WebP, \
TIFF and OpenEXR, 8 and 16 bits and floats. Colours under an alpha of 0 do not count. Folders are matched by the paths below \
them; links to folders are not followed.

Outcomes: same; different: a limit is missed; size; profile: the values mean different colours; missing or new: only one folder \
has it; unreadable; uncounted: the mask leaves no pixel.

Exit codes: 0 all same; 1 any other; 2 a request that makes no sense; 3 a picture could not be read or written, whatever else \
differs; 4 nothing was compared.")]
pub(super) struct Diff {
    /// The picture that is expected, or a folder of them
    #[arg(value_name = "EXPECTED")]
    expected: PathBuf,
    /// The picture that is held against it, or a folder
    #[arg(value_name = "ACTUAL")]
    actual: PathBuf,
    #[command(flatten)]
    limits: LimitOptions,
    #[command(flatten)]
    targets: TargetOptions,
    /// Of folders, only files whose path below them matches; give it again for more [default: by the names' endings]
    #[arg(long, value_name = "GLOB")]
    include: Vec<String>,
    /// Of folders, no files whose path matches
    #[arg(long, value_name = "GLOB")]
    exclude: Vec<String>,
    /// Most memory that one picture may take decoded, such as 512MiB; larger ones are not read
    #[arg(long, value_name = "SIZE", default_value = "2GiB", value_parser = limits::parse_bytes)]
    max_memory: u64,
    /// Write the results as JSON; - for stdout, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the results as JUnit XML, each pair as a test case
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    quiet: bool,
    /// Of folders, show also what is the same
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

impl Diff {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let json = self.json.as_deref().filter(|path| *path != Path::new("-"));
        json.map_or(Ok(()), |path| output::check_results(path, "{"))?;
        self.junit.as_deref().map_or(Ok(()), |path| output::check_results(path, "<?xml"))?;
        let settings = self.limits.settings(self.max_memory, check_interrupt)?;
        let results = self.compare(&settings)?;
        if let Some(path) = json {
            write_bytes_atomically(path, report::json(&results).as_bytes())?;
        }
        if let Some(path) = &self.junit {
            write_bytes_atomically(path, report::diff_junit(&results).as_bytes())?;
        }
        self.show(&results)?;
        Ok(ExitCode::from(results.counts.exit_code()))
    }

    fn compare(&self, settings: &Settings) -> Result<DiffResults> {
        let folders = [&self.expected, &self.actual].map(|path| path.is_dir());
        let listing = match folders {
            [false, false] => self.two_files()?,
            [true, true] => {
                let filter = Filter::new(&self.include, &self.exclude)?;
                list(&self.expected, &self.actual, &filter)
            }
            [expected_is_folder, _] => return Err(self.mixed(expected_is_folder)),
        };
        let plans = self.targets.plans(&listing, [&self.expected, &self.actual], folders[0])?;
        let mut pairs = Work { settings, plans: &plans, named: !folders[0] }.run(self.quiet)?;
        pairs.extend(listing.failures.iter().map(|error| DiffPair::failed(&self.expected, error)));
        let counts = OutcomeCounts::of(pairs.iter().map(|pair| pair.outcome));
        let dejag = env!("CARGO_PKG_VERSION").to_owned();
        Ok(DiffResults { schema_version: DIFF_SCHEMA_VERSION, dejag, counts, skipped: listing.skipped, pairs })
    }

    fn two_files(&self) -> Result<Listing> {
        if !self.include.is_empty() || !self.exclude.is_empty() {
            return Err(Error::Request("--include and --exclude choose among the files of folders; these are two files".into()));
        }
        let path = self.actual.file_name().map(PathBuf::from).unwrap_or_default();
        let pair = PathPair { path, expected: Some(self.expected.clone()), actual: Some(self.actual.clone()) };
        Ok(Listing { pairs: vec![pair], ..Listing::default() })
    }

    fn mixed(&self, expected_is_folder: bool) -> Error {
        let (folder, other) = if expected_is_folder { (&self.expected, &self.actual) } else { (&self.actual, &self.expected) };
        // An absent file is the world's fault even where a folder would have been needed.
        match other.metadata() {
            Err(error) => Error::io("read", other)(error),
            Ok(_) => Error::Request(format!(
                "{} is a folder and {} a file; name two folders or two files",
                folder.display(),
                other.display()
            )),
        }
    }

    fn show(&self, results: &DiffResults) -> anyhow::Result<()> {
        if self.json.as_deref() == Some(Path::new("-")) {
            output::print(&report::json(results))?;
        } else {
            let text = report::diff_text(results, self.verbose, output::is_colored());
            if !text.is_empty() {
                output::print(&text)?;
            }
        }
        match results.counts.exit_code() {
            3 => output::say(&format!("error: {}; some pictures could not be read", report::diff_summary(results))),
            4 => output::say(&format!("error: nothing was compared: {}", report::diff_summary(results))),
            _ if !self.quiet && self.expected.is_dir() => output::say(&report::diff_summary(results)),
            _ => {}
        }
        Ok(())
    }
}
