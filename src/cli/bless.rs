//! `dejag bless`: candidates accepted as goldens, and tolerances learnt from runs.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::check::RESULTS;
use super::output;
use super::shards::read_results;
use super::watch::check_interrupt;
use crate::check::{self, Blessing, Lesson, Manifest, learn};
use crate::error::{Error, Result};
use crate::picture::write_bytes_atomically;
use crate::suite::{CheckResults, CheckedCase};

/// Accept candidates of the last check as goldens
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag bless
  dejag bless edges-smaa 'shots/menu*'
  dejag bless --from downloaded/dejag-check
  dejag bless --update-tolerance linux.json windows.json

Takes what failed in the last `dejag check`, or what is named, and says what it replaced. A candidate becomes the golden of the \
environment that it was drawn in. What cannot be read is never replaced, nor is a golden that has changed since the check.

--update-tolerance sets the limits that the manifest has for each case to what the runs needed, tighter or wider, in overrides of \
their own. Wider only if the runs are from two environments or more and none of them fails the case; --force widens in any case.

Exit codes: 0 all was done; 1 something was left alone, and why is said; 2 a request that makes no sense; 3 something could not be \
read or written; 4 there was nothing to do.")]
pub(super) struct Bless {
    /// Cases by id, or by a part of it up to a '/': * and ? stand for characters [default: all that failed]
    #[arg(value_name = "ID")]
    cases: Vec<String>,
    /// The manifest
    #[arg(long, value_name = "FILE", default_value = "dejag.toml")]
    manifest: PathBuf,
    /// The output folder of the check [default: the manifest's]
    #[arg(long, value_name = "DIR")]
    from: Option<PathBuf>,
    /// Learn tolerances from these results instead
    #[arg(long, value_name = "RUN.json", num_args = 1.., conflicts_with_all = ["cases", "from"])]
    update_tolerance: Vec<PathBuf>,
    /// Widen tolerances from one environment, and of cases that fail
    #[arg(long, requires = "update_tolerance")]
    force: bool,
    /// Say what would be done, and do nothing
    #[arg(long)]
    dry_run: bool,
    /// No words but errors
    #[arg(short, long)]
    quiet: bool,
}

impl Bless {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let manifest = Manifest::read(&self.manifest)?;
        if self.update_tolerance.is_empty() { self.bless(&manifest) } else { self.learn(&manifest) }
    }

    fn bless(&self, manifest: &Manifest) -> anyhow::Result<ExitCode> {
        let folder = self.from.clone().unwrap_or_else(|| manifest.root.join(&manifest.output));
        let path = folder.join(RESULTS);
        if !path.exists() {
            return Err(Error::Request(format!(
                "{} is not there; run `dejag check` first, or name its folder with --from",
                path.display()
            ))
            .into());
        }
        let results: CheckResults = read_results(&path)?;
        if results.manifest != manifest.hash {
            self.say("the manifest has changed since the check; its cases are taken as they were checked");
        }
        let bless = check::Bless { manifest, results: &results, output: &folder, dry_run: self.dry_run };
        let (mut done, mut code) = (0, 0);
        bless.bless(&self.cases, &mut |case, blessing| {
            check_interrupt()?;
            done += 1;
            code = code.max(match blessing {
                Blessing::Failed(_) => 3,
                Blessing::Refused(_) => 1,
                _ => 0,
            });
            self.tell(case, blessing)
        })?;
        if done == 0 {
            output::say("nothing to do: nothing failed in the last check");
            return Ok(ExitCode::from(4));
        }
        Ok(ExitCode::from(code))
    }

    fn tell(&self, case: &CheckedCase, blessing: &Blessing) -> anyhow::Result<()> {
        let plain = |text: &str| text.replace(char::is_control, "\u{fffd}");
        let (id, golden) = (plain(&case.id), plain(&case.blessed_as));
        match blessing {
            Blessing::Refused(why) => output::print(&format!("left alone {id}: {}", plain(why))),
            Blessing::Failed(why) => output::print(&format!("failed     {id}: {}", plain(why))),
            _ if self.quiet => Ok(()),
            Blessing::Replaced => output::print(&format!("replaced   {id}: {golden}")),
            Blessing::Added => output::print(&format!("added      {id}: {golden}")),
            Blessing::Already => output::print(&format!("golden     {id}: {golden} already")),
        }
    }

    fn learn(&self, manifest: &Manifest) -> anyhow::Result<ExitCode> {
        let runs: Vec<CheckResults> = self.update_tolerance.iter().map(|path| read_results(path)).collect::<Result<_>>()?;
        let text = std::fs::read_to_string(&manifest.path).map_err(Error::io("read", &manifest.path))?;
        let learned = learn(manifest, &text, &runs, self.force)?;
        self.say(&format!("environments seen: {}", learned.environments.join(", ")));
        if !self.dry_run && learned.text != text {
            // What is written must read back; it is our fault if it does not.
            Manifest::parse(&manifest.path, learned.text.as_bytes())?;
            write_bytes_atomically(&manifest.path, learned.text.as_bytes())?;
        }
        for lesson in &learned.lessons {
            let Lesson { case, key, before, after } = lesson;
            output::print(&format!("{case} {key}: {before} -> {after}"))?;
        }
        for (case, why) in &learned.refused {
            output::print(&format!("left alone {case}: {why}"))?;
        }
        if learned.lessons.is_empty() && learned.refused.is_empty() {
            self.say("nothing to do: the limits are what these runs need");
        }
        Ok(if learned.refused.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }

    fn say(&self, words: &str) {
        if !self.quiet {
            output::say(words);
        }
    }
}
