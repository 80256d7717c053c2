//! The verbs that draw or know what could be drawn, and what they share. All of them need the whole workbench.

use std::process::ExitCode;

use clap::{Args, Subcommand};

use super::watch::{Bar, check_interrupt};
use super::{cache, capture, doctor, filter, list, output, patterns, quiet_loader, score, sequence};
use crate::capture::Watch;
use crate::error::Result;
use crate::gpu::{AdapterChoice, Gpu};

#[derive(Debug, Subcommand)]
pub(super) enum DrawingVerb {
    Capture(capture::Capture),
    Filter(filter::Filter),
    Score(score::Score),
    Sequence(Box<sequence::Sequence>),
    Patterns(Box<patterns::Patterns>),
    List(list::List),
    Doctor(doctor::Doctor),
    Cache(cache::Cache),
}

impl DrawingVerb {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        quiet_loader::without_layer_noise();
        match self {
            Self::Capture(verb) => verb.run(),
            Self::Filter(verb) => verb.run(),
            Self::Score(verb) => verb.run(),
            Self::Sequence(verb) => verb.run(),
            Self::Patterns(verb) => verb.run(),
            Self::List(verb) => verb.run(),
            Self::Doctor(verb) => verb.run(),
            Self::Cache(verb) => verb.run(),
        }
    }
}

/// Options of every verb that draws.
#[derive(Debug, Args)]
pub(super) struct Drawing {
    /// auto (discrete GPU, integrated, then software), software, or part of an adapter's name
    #[arg(long, value_name = "WHICH", default_value = "auto", env = "DEJAG_ADAPTER")]
    pub(super) adapter: AdapterChoice,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    pub(super) quiet: bool,
    /// Say more: the adapter, where references are kept, each file
    #[arg(short, long, conflicts_with = "quiet")]
    pub(super) verbose: bool,
}

impl Drawing {
    pub(super) fn open(&self) -> Result<Gpu> {
        let gpu = Gpu::open(&self.adapter)?;
        if self.verbose {
            output::say(&format!("adapter: {}", gpu.card));
        }
        Ok(gpu)
    }
}

impl Watch for Bar {
    fn tick(&mut self, done: u32, _: u32) -> Result<()> {
        self.reach(done.into());
        check_interrupt()
    }
}

/// Reads `WIDTHxHEIGHT`.
pub(super) fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let hint = || format!("'{text}' is no size; write WIDTHxHEIGHT in pixels, such as 1280x720, both at least 1");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(hint)?;
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|s| *s > 0).ok_or_else(hint);
    Ok([side(width)?, side(height)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(parse_size("640x360"), Ok([640, 360]));
        for bad in ["640", "0x1", "1x0", "-1x5", "axb", "1x2x3", "", "nanxinf", "1e3x5", "99999999999x1"] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
    }
}
