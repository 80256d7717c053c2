//! `dejag cache`: where references are kept, how many, and away with them.

use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::capture::Cache as References;

/// Show or clear the cache of references
#[derive(Debug, Args)]
#[command(after_help = "The folder is $DEJAG_CACHE_DIR, or else `dejag` in the user's cache folder. It holds at most 2 GiB; \
the least recently used references go first.\n\nExamples:\n  dejag cache\n  dejag cache --clear")]
pub(super) struct Cache {
    /// Remove every reference
    #[arg(long)]
    clear: bool,
}

impl Cache {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let cache = References::of_user();
        let Some(folder) = cache.folder() else {
            output::print("no cache: neither $DEJAG_CACHE_DIR nor a user's cache folder is set")?;
            return Ok(ExitCode::SUCCESS);
        };
        let megabytes = |bytes: u64| bytes as f64 / 1e6;
        if self.clear {
            let (entries, bytes) = cache.clear()?;
            output::print(&format!("{}: removed {entries} references, {:.1} MB", folder.display(), megabytes(bytes)))?;
        } else {
            let (entries, bytes) = cache.usage()?;
            output::print(&format!("{}: {entries} references, {:.1} MB", folder.display(), megabytes(bytes)))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
