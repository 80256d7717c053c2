//! `dejag list`: everything that has a name.

use std::fmt::Write as _;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use serde_json::{Value, json};

use super::output;
use crate::gpu::{Card, adapters};
use crate::methods::METHODS;
use crate::metrics::METRICS;
use crate::metrics::temporal::MEASURES;
use crate::sampling::{FILTERS, PATTERNS, Parameter};
use crate::scene::SHIPPED;

/// List what there is, with options, ranges and defaults
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dejag list methods\n  dejag list metrics --json")]
pub(super) struct List {
    /// What to list
    what: What,
    /// As JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum What {
    Scenes,
    Methods,
    Filters,
    Patterns,
    Metrics,
    Measures,
    Adapters,
}

impl List {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let entries = match self.what {
            What::Scenes => SHIPPED.iter().map(|s| json!({ "name": s.name, "about": s.about() })).collect(),
            What::Methods => methods(),
            What::Filters => FILTERS
                .iter()
                .map(|f| json!({ "name": f.name, "about": f.summary, "default radius in pixels": f.default_radius_px }))
                .collect(),
            What::Patterns => patterns(),
            What::Metrics => METRICS
                .iter()
                .map(|m| {
                    let (better, reads) = (m.better.as_str(), m.reads.as_str());
                    json!({ "name": m.name, "id": m.id, "about": m.summary, "unit": m.unit, "better": better, "reads": reads })
                })
                .collect(),
            What::Measures => MEASURES
                .iter()
                .map(|m| json!({ "name": m.name, "id": m.id, "about": m.summary, "unit": m.unit, "better": m.better.as_str() }))
                .collect(),
            What::Adapters => adapters().iter().map(|a| adapter(&Card::of(&a.get_info()))).collect(),
        };
        let text = if self.json { serde_json::to_string_pretty(&entries)? } else { plain(&entries) };
        output::print(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}

fn methods() -> Vec<Value> {
    let option =
        |o: &crate::pass::OptionSpec| json!({ "name": o.name, "about": o.help, "range": o.kind.range(), "default": o.default });
    METHODS
        .iter()
        .map(|m| {
            let options: Vec<Value> = m.options.iter().map(option).collect();
            json!({ "name": m.name, "about": m.summary, "source": m.source, "options": options })
        })
        .collect()
}

fn patterns() -> Vec<Value> {
    let parameter =
        |p: &Parameter| json!({ "name": p.name, "about": p.help, "range": p.range(), "default": p.default.to_string() });
    PATTERNS
        .iter()
        .map(|p| {
            let parameters: Vec<Value> = p.parameters.iter().map(parameter).collect();
            json!({
                "name": p.name, "aliases": p.aliases, "about": p.summary, "source": p.source, "cost": p.cost, "uses the seed": p.seeded,
                "any prefix is usable": p.progressive, "counts": p.counts.describe(), "density": p.density.describe(),
                "options": parameters,
            })
        })
        .collect()
}

fn adapter(card: &Card) -> Value {
    json!({
        "name": card.name, "about": format!("{} {}", card.driver, card.driver_version), "kind": card.kind, "backend": card.backend,
    })
}

/// A line an entry, and a line below it for each option.
fn plain(entries: &[Value]) -> String {
    let word = |value: &Value, key: &str| value[key].as_str().unwrap_or_default().to_owned();
    let width = entries.iter().map(|e| word(e, "name").len()).max().unwrap_or(0);
    let mut text = String::new();
    for entry in entries {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{:width$}  {}", word(entry, "name"), word(entry, "about"));
        for option in entry["options"].as_array().into_iter().flatten() {
            let (name, range, default) = (word(option, "name"), word(option, "range"), word(option, "default"));
            let _ = writeln!(text, "{:width$}    {name}={range} (default {default}): {}", "", word(option, "about"));
        }
    }
    text
}
