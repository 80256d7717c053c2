//! What a CI service is told where one runs us.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;

use anyhow::Context as _;

use super::super::output;
use crate::report;
use crate::suite::CheckResults;

/// On GitHub: annotations, which are read off our words, and a summary of the job.
pub(super) fn tell_github(results: &CheckResults, manifest: &Path) -> anyhow::Result<()> {
    if std::env::var_os("GITHUB_ACTIONS").is_none_or(|value| value != "true") {
        return Ok(());
    }
    for line in report::annotations(results, &manifest.to_string_lossy()) {
        output::say(&line);
    }
    let Some(path) = std::env::var_os("GITHUB_STEP_SUMMARY").filter(|path| !path.is_empty()) else { return Ok(()) };
    let mut file = OpenOptions::new().append(true).create(true).open(&path).context("could not open the job's summary")?;
    file.write_all(report::job_summary(results).as_bytes()).context("could not write the job's summary")
}
