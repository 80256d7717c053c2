//! The command line.

use std::path::PathBuf;

/// What was asked for.
pub(crate) struct Options {
    /// Pictures to run on, beside those that are made here.
    pub(crate) pictures: Vec<PathBuf>,
    /// Times each is measured, after one warming up.
    pub(crate) rounds: u32,
    /// Methods to measure instead of all.
    pub(crate) only: Vec<String>,
    /// Whether to measure cost by size and by density, too.
    pub(crate) plots: bool,
    /// Whether it only has to be shown that everything runs.
    pub(crate) smoke: bool,
}

impl Options {
    /// None where there is nothing to do: a test harness asks for a list of tests.
    ///
    /// `cargo bench` says `--bench`. Whoever does not wants to know whether it runs, not how fast: `cargo test --benches` and its
    /// likes get small pictures and one round.
    pub(crate) fn read(mut words: impl Iterator<Item = String>) -> Option<Self> {
        let mut options = Self { pictures: Vec::new(), rounds: 11, only: Vec::new(), plots: false, smoke: true };
        while let Some(word) = words.next() {
            match word.as_str() {
                "--list" => return None,
                "--bench" => options.smoke = false,
                "--plots" => options.plots = true,
                "--rounds" => {
                    options.rounds =
                        words.next().and_then(|n| n.parse().ok()).filter(|n| *n > 0).expect("--rounds takes a number");
                }
                "--only" => options.only.push(words.next().expect("--only takes a method")),
                // Whatever else a harness says to its own.
                other if other.starts_with("--") => {}
                path => options.pictures.push(path.into()),
            }
        }
        if options.smoke {
            (options.rounds, options.plots) = (1, false);
            options.pictures.clear();
        }
        Some(options)
    }
}
