//! Which patterns are meant.

use clap::Args;

use crate::error::{Error, Result};
use crate::sampling::{PATTERNS, PatternSpec};

/// Patterns by name.
#[derive(Debug, Args)]
pub(super) struct Choice {
    /// Patterns with their parameters, such as lloyd:generations=400
    #[arg(value_name = "PATTERN")]
    named: Vec<String>,
    #[command(flatten)]
    listed: Listed,
}

/// Patterns as a list.
#[derive(Debug, Args)]
pub(super) struct Listed {
    /// Patterns, separated by commas [default: all]
    #[arg(long, alias = "pattern", value_name = "LIST")]
    patterns: Vec<String>,
}

impl Choice {
    /// The patterns asked for in order, or what stands for no choice.
    pub(super) fn specs(&self, default: impl FnOnce() -> Vec<PatternSpec>) -> Result<Vec<PatternSpec>> {
        let texts: Vec<&String> = self.named.iter().chain(&self.listed.patterns).collect();
        specs(&texts, default)
    }
}

impl Listed {
    /// The patterns asked for in order, all if none is.
    pub(super) fn specs(&self) -> Result<Vec<PatternSpec>> {
        specs(&self.patterns.iter().collect::<Vec<_>>(), all)
    }
}

/// Every pattern under its defaults.
pub(super) fn all() -> Vec<PatternSpec> {
    PATTERNS.iter().map(PatternSpec::from).collect()
}

fn specs(texts: &[&String], default: impl FnOnce() -> Vec<PatternSpec>) -> Result<Vec<PatternSpec>> {
    if texts.is_empty() {
        return Ok(default());
    }
    let specs: Vec<PatternSpec> =
        texts.iter().flat_map(|text| split(text)).map(|t| PatternSpec::parse(&t)).collect::<Result<_>>()?;
    for (i, spec) in specs.iter().enumerate() {
        let name = spec.to_string();
        if specs[..i].iter().any(|other| other.to_string() == name) {
            return Err(Error::Request(format!("pattern {name} is given twice; give it once")));
        }
    }
    Ok(specs)
}

/// Commas stand between patterns and between a pattern's parameters: what has a value and no name goes with the pattern before.
fn split(list: &str) -> Vec<String> {
    let mut texts: Vec<String> = Vec::new();
    for piece in list.split(',') {
        match texts.last_mut() {
            Some(last) if last.contains(':') && piece.contains('=') && !piece.contains(':') => {
                last.push(',');
                last.push_str(piece);
            }
            _ => texts.push(piece.to_owned()),
        }
    }
    texts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_separate_patterns_and_parameters() {
        assert_eq!(split("random,jittered"), ["random", "jittered"]);
        assert_eq!(
            split("lloyd:generations=40,raster=512,ccpd:capacity=256,r2"),
            ["lloyd:generations=40,raster=512", "ccpd:capacity=256", "r2"]
        );
        assert_eq!(split("r2,raster=512"), ["r2", "raster=512"]);
    }

    #[test]
    fn a_pattern_is_chosen_once() {
        let chosen = |list: &str| Listed { patterns: vec![list.into()] }.specs();
        assert_eq!(chosen("r2,random").expect("two").len(), 2);
        assert!(chosen("r2,random,r2").expect_err("twice").to_string().contains("r2 is given twice"));
        assert!(chosen("").is_err());
        assert_eq!(Listed { patterns: vec![] }.specs().expect("all").len(), PATTERNS.len());
    }
}
