//! What can be set on a pattern, and what a generator is told.

use super::{Distribution, Progress};
use crate::error::{Error, Result};

/// One parameter of a pattern: a number, as `list` and the error texts show it.
#[derive(Debug, Clone, Copy)]
pub struct Parameter {
    /// As in `NAME=VALUE`.
    pub name: &'static str,
    /// What it does, in a line.
    pub help: &'static str,
    /// The value if none is given.
    pub default: f64,
    /// The least.
    pub min: f64,
    /// The greatest.
    pub max: f64,
    /// Whether only whole numbers are taken.
    pub whole: bool,
}

impl Parameter {
    pub(super) const fn whole(name: &'static str, help: &'static str, default: u32, [min, max]: [u32; 2]) -> Self {
        Self { name, help, default: default as f64, min: min as f64, max: max as f64, whole: true }
    }

    pub(super) const fn number(name: &'static str, help: &'static str, default: f64, [min, max]: [f64; 2]) -> Self {
        Self { name, help, default, min, max, whole: false }
    }

    /// 0 or 1.
    pub(super) const fn switch(name: &'static str, help: &'static str, default: bool) -> Self {
        Self::whole(name, help, default as u32, [0, 1])
    }

    /// The range in words.
    #[must_use]
    pub fn range(&self) -> String {
        match (self.whole, [self.min, self.max]) {
            (true, [0.0, 1.0]) => "0 or 1".into(),
            (true, [min, max]) => format!("a whole number from {min} to {max}"),
            (false, [min, max]) => format!("{min} to {max}"),
        }
    }

    /// Whether `value` may be given; the error shows it as it was `written`.
    pub(super) fn check(&self, pattern: &str, value: f64, written: &str) -> Result<()> {
        if (self.min..=self.max).contains(&value) && (!self.whole || value.fract() == 0.0) {
            return Ok(());
        }
        let Self { name, .. } = self;
        Err(Error::Request(format!("{pattern}: {name}={written} is out of range; {name} takes {}", self.range())))
    }
}

/// All that a generator needs to know.
#[derive(Debug, Clone, Copy)]
pub(super) struct Job<'a> {
    pub(super) n: u32,
    pub(super) seed: u32,
    pub(super) distribution: &'a Distribution,
    pub(super) progress: Progress<'a>,
    pub(super) parameters: &'static [Parameter],
    /// One for each parameter, in range.
    pub(super) values: &'a [f64],
}

impl Job<'_> {
    /// # Panics
    /// If the pattern does not list the parameter.
    pub(super) fn number(&self, name: &str) -> f64 {
        let index = self.parameters.iter().position(|p| p.name == name);
        self.values[index.unwrap_or_else(|| panic!("no parameter '{name}'"))]
    }

    pub(super) fn whole(&self, name: &str) -> u32 {
        self.number(name) as u32
    }

    pub(super) fn switch(&self, name: &str) -> bool {
        self.number(name) != 0.0
    }
}
