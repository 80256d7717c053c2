//! Tolerances learnt from runs on several machines: as wide as what was seen, and no wider.

use std::collections::{BTreeMap, BTreeSet};

use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, Value};

use super::{Entry, Manifest, Subject};
use crate::compare::Allowance;
use crate::suite::{CheckResults, CheckedCase, DiffOutcome, Knob};
use crate::{Error, Result};

/// A manifest with what was learnt written into it.
#[derive(Debug, Clone, PartialEq)]
pub struct Learned {
    /// The manifest's new text.
    pub text: String,
    /// The environments that were seen.
    pub environments: Vec<String>,
    /// What is new.
    pub lessons: Vec<Lesson>,
    /// Cases whose tolerance stays, and why.
    pub refused: Vec<(String, String)>,
}

/// A limit that was set anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    /// What the override's `case` says.
    pub case: String,
    /// The limit's key in the manifest, such as `max-flip`.
    pub key: &'static str,
    /// What it was.
    pub before: f64,
    /// What it is.
    pub after: f64,
}

/// All that was seen of a case.
struct Seen<'a> {
    entry: &'a Entry,
    /// A picture of it, to ask for its tolerance.
    id: &'a str,
    cases: Vec<(&'a CheckResults, &'a CheckedCase)>,
}

/// Sets the limits that a manifest has to what the pictures of these runs needed.
///
/// A limit becomes wider only if the runs are from at least two environments and the case passed in all of them under the limits that
/// they were made with; with `force` in any case.
///
/// # Errors
///
/// [`Error::Request`] if the runs name no case of the manifest, or if its overrides are written in a way that cannot be added to.
pub fn learn(manifest: &Manifest, text: &str, runs: &[CheckResults], force: bool) -> Result<Learned> {
    let environments: BTreeSet<String> =
        runs.iter().map(|run| format!("{} on {}", run.environment.key, run.environment.platform)).collect();
    let mut document: DocumentMut = text.parse().map_err(|error| Error::Request(format!("the manifest: {error}")))?;
    let mut learned = Learned { text: String::new(), environments: Vec::new(), lessons: Vec::new(), refused: Vec::new() };
    let seen = seen(manifest, runs);
    if seen.is_empty() {
        return Err(Error::Request(
            "the runs have no case of this manifest; name the JSON of `dejag check` with this manifest".into(),
        ));
    }
    for (pattern, seen) in seen {
        match seen.needs(manifest) {
            Err(why) => learned.refused.push((pattern, why)),
            Ok(needs) => {
                let wider = needs.iter().any(Need::is_wider);
                match seen.refusal(environments.len()).filter(|_| wider && !force) {
                    Some(why) => learned.refused.push((pattern, why)),
                    None => {
                        for need in needs.into_iter().filter(Need::is_new) {
                            set(&mut document, &pattern, need.key, need.written.clone())?;
                            let Need { key, before, after, .. } = need;
                            learned.lessons.push(Lesson { case: pattern.clone(), key, before, after });
                        }
                    }
                }
            }
        }
    }
    learned.text = document.to_string();
    learned.environments = environments.into_iter().collect();
    Ok(learned)
}

/// By what the override's `case` will say: a sequence as a whole, everything else picture by picture.
fn seen<'a>(manifest: &'a Manifest, runs: &'a [CheckResults]) -> BTreeMap<String, Seen<'a>> {
    let entries: BTreeMap<&str, &Entry> = manifest.entries.iter().map(|entry| (entry.id.as_str(), entry)).collect();
    let mut all: BTreeMap<String, Seen<'a>> = BTreeMap::new();
    for run in runs {
        for case in &run.cases {
            let Some(entry) = entries.get(case.entry.as_str()) else { continue };
            let pattern = match entry.subject {
                Subject::Sequence(..) => format!("{}/*", globset::escape(&case.entry)),
                _ => globset::escape(&case.id),
            };
            all.entry(pattern).or_insert_with(|| Seen { entry, id: &case.id, cases: Vec::new() }).cases.push((run, case));
        }
    }
    all
}

/// A limit, and what it must be.
#[derive(Debug)]
struct Need {
    key: &'static str,
    before: f64,
    after: f64,
    /// Whether it is a least one.
    least: bool,
    written: Value,
}

impl Need {
    fn is_wider(&self) -> bool {
        if self.least { self.after < self.before } else { self.after > self.before }
    }

    fn is_new(&self) -> bool {
        self.after != self.before
    }
}

/// The metrics, by option and key.
const METRICS: [(&str, &str); 4] =
    [("--max-rmse", "max-rmse"), ("--min-psnr", "min-psnr"), ("--min-ssim", "min-ssim"), ("--max-flip", "max-flip")];

impl Seen<'_> {
    /// Why its tolerance must not become wider, if it must not.
    fn refusal(&self, environments: usize) -> Option<String> {
        if environments < 2 {
            return Some(
                "it would become wider, and the runs are from one environment only; run it on another, or give --force".into(),
            );
        }
        let failing = self.cases.iter().find(|(_, case)| case.pair.outcome != DiffOutcome::Same)?;
        Some(format!("it would become wider, and it fails on {}; mend it, or give --force", failing.0.environment.key))
    }

    fn needs(&self, manifest: &Manifest) -> Result<Vec<Need>, String> {
        let compared = |case: &CheckedCase| matches!(case.pair.outcome, DiffOutcome::Same | DiffOutcome::Different);
        if let Some((run, case)) = self.cases.iter().find(|(_, case)| !compared(case)) {
            return Err(format!("on {} it is {}", run.environment.key, case.pair.outcome.as_str()));
        }
        let (run, case) = self.cases[0];
        let tolerance = manifest.tolerance(self.entry, self.id, &run.environment.key, &run.environment.platform);
        let limits = tolerance.limits();
        let mut needs = Vec::new();
        if limits.asks_pixels() {
            needs.push(match tolerance.max_pixels {
                Some(Allowance::Share(share)) => self.share(share)?,
                Some(Allowance::Count(count @ 1..)) => self.number("--max-pixels", "max-pixels", count as f64)?,
                _ if limits.allow_edges => self.number("--max-pixels", "max-pixels", 0.0)?,
                _ => self.channel(tolerance.per_channel.unwrap_or(0.0))?,
            });
        }
        for limit in &limits.metrics {
            let option = limit.measure.option();
            let key = METRICS.iter().find(|(theirs, _)| *theirs == option).map(|(_, key)| *key);
            // Where all pictures are the golden ones a least PSNR has nothing to learn from.
            let found = key.map(|key| self.number(option, key, limit.limit)).transpose()?;
            needs.extend(found.filter(|need| need.after.is_finite()));
        }
        if needs.is_empty() { Err(format!("nothing is limited for {}", case.id)) } else { Ok(needs) }
    }

    /// The worst that passes in all runs.
    fn worst(&self, option: &str, least: bool) -> Result<f64, String> {
        let mut worst = if least { f64::INFINITY } else { 0.0 };
        for (run, case) in &self.cases {
            let knob = case.pair.knobs.iter().find(|knob| knob.option == option);
            let at = knob
                .ok_or_else(|| format!("the run on {} does not say {option} of it", run.environment.key))
                .and_then(passing)?;
            worst = if least { f64::min(worst, at) } else { f64::max(worst, at) };
        }
        Ok(worst)
    }

    fn number(&self, option: &str, key: &'static str, before: f64) -> Result<Need, String> {
        let least = key.starts_with("min");
        let after = self.worst(option, least)?;
        let written = if key == "max-pixels" { Value::from(after as i64) } else { Value::from(after) };
        Ok(Need { key, before, after, least, written })
    }

    /// In percent of the compared pixels, to four digits upwards.
    fn share(&self, before: f64) -> Result<Need, String> {
        let mut percent: f64 = 0.0;
        for (_, case) in &self.cases {
            let compared = case.pair.pixels.as_ref().map_or(1, |pixels| pixels.compared.max(1)) as f64;
            let knob = case.pair.knobs.iter().find(|knob| knob.option == "--max-pixels");
            let count = knob.ok_or_else(|| "a run does not say how many pixels differ".to_owned()).and_then(passing)?;
            percent = percent.max((count / compared * 1e6).ceil() / 1e4);
        }
        let written = Value::from(format!("{percent}%"));
        Ok(Need { key: "max-pixels", before, after: percent / 100.0, least: false, written })
    }

    fn channel(&self, before: f64) -> Result<Need, String> {
        let after = self.worst("--per-channel", false)?;
        let levels = after * 255.0;
        let whole = (levels - levels.round()).abs() < 1e-9;
        let written = if whole { Value::from(format!("{}/255", levels.round())) } else { Value::from(after) };
        let after = if whole { levels.round() / 255.0 } else { after };
        Ok(Need { key: "per-channel", before, after, least: false, written })
    }
}

/// What a knob passes at; nothing limits what is equal.
fn passing(knob: &Knob) -> Result<f64, String> {
    match (knob.passes_at, knob.value) {
        (Some(at), _) => Ok(at),
        (None, crate::metrics::Figure::Infinite) if knob.option.starts_with("--min") => Ok(f64::INFINITY),
        _ => Err(format!("no {} would pass", knob.option)),
    }
}

/// Writes a limit into the override of exactly this case, which is added if there is none.
fn set(document: &mut DocumentMut, case: &str, key: &str, value: Value) -> Result<()> {
    let overrides = document.entry("override").or_insert(Item::ArrayOfTables(ArrayOfTables::new()));
    let foreign = || Error::Request("write the manifest's overrides as [[override]] tables, so that one can be added".into());
    let overrides = overrides.as_array_of_tables_mut().ok_or_else(foreign)?;
    let is_it = |table: &Table| {
        table.get("case").and_then(Item::as_str) == Some(case) && table.len() == 2 && table.contains_key("tolerance")
    };
    let found = overrides.iter().position(is_it);
    let index = found.unwrap_or_else(|| {
        let mut table = Table::new();
        table["case"] = toml_edit::value(case);
        table["tolerance"] = toml_edit::value(toml_edit::InlineTable::new());
        overrides.push(table);
        overrides.len() - 1
    });
    let table = overrides.get_mut(index).ok_or_else(foreign)?;
    let limits = table.get_mut("tolerance").and_then(Item::as_table_like_mut).ok_or_else(foreign)?;
    limits.insert(key, Item::Value(value));
    Ok(())
}
