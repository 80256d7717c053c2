//! The `dejag` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    dejag::cli::main()
}
