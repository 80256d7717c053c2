//! `dejag score`.
use clap::Args;
use std::process::ExitCode;
/// Score methods on scenes against a reference
#[derive(Debug, Args)]
pub(super) struct Score {}
impl Score {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        Ok(ExitCode::SUCCESS)
    }
}
