//! The command line: one file a verb. Data on stdout, words and progress on stderr.

mod bless;
mod check;
mod completions;
mod diff;
mod merge;
mod output;
mod shards;
mod watch;

// The verbs that need the whole workbench.
#[cfg(feature = "workbench")]
mod cache;
#[cfg(feature = "workbench")]
mod capture;
#[cfg(feature = "workbench")]
mod doctor;
#[cfg(feature = "workbench")]
mod drawing;
#[cfg(feature = "workbench")]
mod filter;
#[cfg(feature = "workbench")]
mod list;
#[cfg(feature = "workbench")]
mod patterns;
#[cfg(feature = "workbench")]
mod quiet_loader;
#[cfg(feature = "workbench")]
mod score;
#[cfg(feature = "workbench")]
mod sequence;

#[cfg(feature = "workbench")]
use drawing::{Drawing, parse_size};

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::error::{Blame, Error};

/// Anti-aliasing for wgpu, and the bench that scores it: speed against error.
#[derive(Debug, Parser)]
#[command(name = "dejag", version, arg_required_else_help = true, after_help = closing_words())]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

const DRAWING_EXAMPLES: &str = "
  dejag capture courtyard -m msaa:samples=4 -o courtyard.png
  dejag capture model.glb -m ssaa:spp=64 --size 1280x720 -o model.exr
  dejag filter shots -m smaa -o smooth-shots
  dejag score edges fence -m none -m msaa -m ssaa:spp=16 --report report
  dejag sequence pan -m none -m smaa
  dejag patterns table
  dejag list methods
  dejag doctor";

fn closing_words() -> String {
    let drawing = if cfg!(feature = "workbench") { DRAWING_EXAMPLES } else { "" };
    format!(
        "Examples:{drawing}
  dejag diff expected.png actual.png
  dejag diff goldens shots --max-flip 0.01 -o differences
  dejag check --report report
  dejag bless

Exit codes: 0 fine; 1 pictures differ or a bar was missed; 2 a request that makes no sense; 3 could not run, read or write; \
4 nothing was compared; 130 interrupted."
    )
}

#[derive(Debug, Subcommand)]
enum Verb {
    #[cfg(feature = "workbench")]
    #[command(flatten)]
    Drawing(drawing::DrawingVerb),
    Diff(Box<diff::Diff>),
    Check(Box<check::Check>),
    Bless(bless::Bless),
    Merge(merge::Merge),
    Completions(completions::Completions),
    #[command(hide = true)]
    Man(completions::Man),
}

/// Parses, runs, and turns what comes of it into an exit code.
#[must_use]
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    watch::listen_for_interrupts();
    let outcome = match &cli.verb {
        #[cfg(feature = "workbench")]
        Verb::Drawing(verb) => verb.run(),
        Verb::Diff(verb) => verb.run(),
        Verb::Check(verb) => {
            #[cfg(feature = "workbench")]
            quiet_loader::without_layer_noise();
            verb.run()
        }
        Verb::Bless(verb) => verb.run(),
        Verb::Merge(verb) => verb.run(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory as _;

    #[test]
    fn the_command_is_well_formed() {
        Cli::command().debug_assert();
    }
}
