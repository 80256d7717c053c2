//! The command line: one file a verb. Data on stdout, words and progress on stderr.

mod cache;
mod capture;
mod completions;
mod doctor;
mod filter;
mod list;
mod output;
mod patterns;
mod quiet_loader;
mod score;
mod sequence;
mod watch;

use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::error::{Blame, Error};
use crate::gpu::{AdapterChoice, Gpu};

/// Anti-aliasing for wgpu, and the bench that scores it: speed against error.
#[derive(Debug, Parser)]
#[command(name = "dejag", version, arg_required_else_help = true, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

const EXAMPLES: &str = "\
Examples:
  dejag capture courtyard -m msaa:samples=4 -o courtyard.png
  dejag capture model.glb -m ssaa:spp=64 --size 1280x720 -o model.exr
  dejag filter shots -m smaa -o smooth-shots
  dejag score edges fence -m none -m msaa -m ssaa:spp=16 --report report
  dejag sequence pan -m none -m smaa
  dejag patterns table
  dejag list methods
  dejag doctor

Exit codes: 0 fine; 1 a bar was missed; 2 a request that makes no sense; 3 could not run or write; 4 nothing was \
compared; 130 interrupted.";

#[derive(Debug, Subcommand)]
enum Verb {
    Capture(capture::Capture),
    Filter(filter::Filter),
    Score(score::Score),
    Sequence(Box<sequence::Sequence>),
    Patterns(Box<patterns::Patterns>),
    List(list::List),
    Doctor(doctor::Doctor),
    Cache(cache::Cache),
    Completions(completions::Completions),
    #[command(hide = true)]
    Man(completions::Man),
}

/// Options of every verb that draws.
#[derive(Debug, Args)]
struct Drawing {
    /// auto (discrete GPU, integrated, then software), software, or part of an adapter's name
    #[arg(long, value_name = "WHICH", default_value = "auto", env = "DEJAG_ADAPTER")]
    adapter: AdapterChoice,
    /// No progress and no words, only results and errors
    #[arg(short, long)]
    quiet: bool,
    /// Say more: the adapter, where references are kept, each file
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
}

impl Drawing {
    fn open(&self) -> Result<Gpu, Error> {
        let gpu = Gpu::open(&self.adapter)?;
        if self.verbose {
            output::say(&format!("adapter: {}", gpu.card));
        }
        Ok(gpu)
    }
}

/// Parses, runs, and turns what comes of it into an exit code.
#[must_use]
pub fn main() -> ExitCode {
    quiet_loader::without_layer_noise();
    let cli = Cli::parse();
    watch::listen_for_interrupts();
    let outcome = match &cli.verb {
        Verb::Capture(verb) => verb.run(),
        Verb::Filter(verb) => verb.run(),
        Verb::Score(verb) => verb.run(),
        Verb::Sequence(verb) => verb.run(),
        Verb::Patterns(verb) => verb.run(),
        Verb::List(verb) => verb.run(),
        Verb::Doctor(verb) => verb.run(),
        Verb::Cache(verb) => verb.run(),
        Verb::Completions(verb) => verb.run(),
        Verb::Man(verb) => verb.run(),
    };
    match outcome {
        Ok(code) => code,
        // A reader that closed the pipe (`| head`) has what it wanted.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            output::say(&format!("error: {}", words_of(&error)));
            ExitCode::from(code_of(&error))
        }
    }
}

/// The library's errors name their causes themselves, the others have theirs in the chain.
fn words_of(error: &anyhow::Error) -> String {
    error.downcast_ref::<Error>().map_or_else(|| format!("{error:#}"), Error::to_string)
}

fn code_of(error: &anyhow::Error) -> u8 {
    match error.downcast_ref::<Error>().map(Error::blame) {
        Some(Blame::Request) => 2,
        Some(Blame::Interrupt) => 130,
        Some(Blame::World) | None => 3,
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let io = error.chain().find_map(|cause| cause.downcast_ref::<std::io::Error>());
    io.is_some_and(|io| io.kind() == std::io::ErrorKind::BrokenPipe)
}

/// Reads `WIDTHxHEIGHT`.
fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let hint = || format!("'{text}' is no size; write WIDTHxHEIGHT in pixels, such as 1280x720, both at least 1");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(hint)?;
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|s| *s > 0).ok_or_else(hint);
    Ok([side(width)?, side(height)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_is_well_formed() {
        Cli::command().debug_assert();
    }

    #[test]
    fn sizes() {
        assert_eq!(parse_size("640x360"), Ok([640, 360]));
        for bad in ["640", "0x1", "1x0", "-1x5", "axb", "1x2x3", "", "nanxinf", "1e3x5", "99999999999x1"] {
            assert!(parse_size(bad).is_err(), "{bad}");
        }
    }
}
