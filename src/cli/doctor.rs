//! `dejag doctor`: what was found, what it can do, and what to install where nothing answers.

use std::fmt::Write as _;
use std::process::ExitCode;

use clap::Args;

use super::output;
use crate::check::environment;
use crate::error::{Error, Result};
use crate::gpu::{AdapterChoice, Gpu};
use crate::methods::{METHODS, Spec};
use crate::suite::Stamp;

/// Say which adapters answer, what they can do, and which methods run on the chosen one
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dejag doctor\n  dejag doctor --adapter software")]
pub(super) struct Doctor {
    /// auto (discrete GPU, integrated, then software), software, or part of an adapter's name
    #[arg(long, value_name = "WHICH", default_value = "auto", env = "DEJAG_ADAPTER")]
    adapter: AdapterChoice,
}

impl Doctor {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let gpu = Gpu::open(&self.adapter)?;
        output::print(&examination(&gpu)?)?;
        Ok(ExitCode::SUCCESS)
    }
}

fn examination(gpu: &Gpu) -> Result<String> {
    let mut text = String::new();
    let mut line = |line: String| writeln!(text, "{line}").map_err(|_| Error::Request("out of memory".into()));
    line(format!("dejag {}", env!("CARGO_PKG_VERSION")))?;
    line("adapters, the preferred first:".into())?;
    for adapter in crate::gpu::adapters() {
        line(format!("  {}", crate::gpu::Card::of(&adapter.get_info())))?;
    }
    line(format!("chosen: {}", gpu.card))?;
    line(format!("  goldens: {}", environment(None, Some(Stamp::from(&gpu.card))).key))?;
    let counts: Vec<String> = gpu.sample_counts().iter().map(u32::to_string).collect();
    line(format!("  samples a pixel: {}", counts.join(", ")))?;
    let limits = gpu.device.limits();
    line(format!("  largest picture: {0}x{0}", limits.max_texture_dimension_2d))?;
    let features: Vec<&str> = gpu.device.features().iter_names().map(|(name, _)| name).collect();
    line(format!("  features in use: {}", features.join(", ")))?;
    line("methods:".into())?;
    for method in METHODS {
        let spec = Spec::parse(method.name)?;
        let verdict = match spec.first_needs().check(method.name, gpu.device.features(), &gpu.sample_counts()) {
            Ok(()) => "runs".into(),
            Err(error) => format!("cannot run: {error}"),
        };
        line(format!("  {:<8} {verdict}", method.name))?;
    }
    for warning in warnings(gpu) {
        line(format!("warning: {warning}"))?;
    }
    Ok(text)
}

/// Settings of the software driver that are known to hurt.
fn warnings(gpu: &Gpu) -> Vec<String> {
    let mut warnings = Vec::new();
    if std::env::var("LP_NATIVE_VECTOR_WIDTH").is_ok_and(|width| width == "512") {
        warnings.push("LP_NATIVE_VECTOR_WIDTH=512 crashes many versions of Mesa; unset it or use 256".into());
    }
    if gpu.is_software() {
        warnings.push("a software adapter: right pictures, but times say little about GPUs".into());
    }
    warnings
}
