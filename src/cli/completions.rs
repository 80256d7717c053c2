//! `dejag completions` and `dejag man`.

use std::process::ExitCode;

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::{Cli, output};

/// Print completions for a shell
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dejag completions bash > ~/.local/share/bash-completion/completions/dejag")]
pub(super) struct Completions {
    /// Which shell
    shell: Shell,
}

impl Completions {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "dejag", &mut text);
        output::print(&String::from_utf8_lossy(&text))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Print the manual page
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dejag man | man -l -\n  dejag man score | man -l -")]
pub(super) struct Man {
    /// Of this verb instead of the whole command
    verb: Option<String>,
}

impl Man {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let mut command = Cli::command();
        command.build();
        if let Some(verb) = &self.verb {
            let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
            let found = command.find_subcommand(verb).cloned();
            command = found.ok_or_else(|| crate::error::unknown("verb", verb, &names))?;
        }
        let mut text = Vec::new();
        clap_mangen::Man::new(command).render(&mut text)?;
        output::print(&String::from_utf8_lossy(&text))?;
        Ok(ExitCode::SUCCESS)
    }
}
