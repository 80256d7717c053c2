//! Tolerances learnt from runs on several machines: as wide as what was seen, and no wider.

use std::collections::{BTreeMap, BTreeSet};

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

use super::tolerance::escape;
use super::{Entry, Manifest, Subject, Tolerance};
use crate::compare::Allowance;
use crate::metrics::Figure;
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
    /// What it was, as a manifest writes it.
    pub before: String,
    /// What it is.
    pub after: String,
}

type Run<'a> = (&'a CheckResults, &'a CheckedCase);

/// All that was seen of a case.
struct Seen<'a> {
    entry: &'a Entry,
    cases: Vec<Run<'a>>,
}

/// Sets the limits that a manifest has to what the pictures of these runs needed.
///
/// A limit becomes wider only if the case was seen in at least two environments and passed in all of them under the limits that its runs
/// were made with; with `force` in any case. Limits that the manifest sets by environment or platform are left to their author.
///
/// # Errors
///
/// [`Error::Request`] if the runs name no case of the manifest, or if its overrides are written in a way that cannot be added to.
pub fn learn(manifest: &Manifest, text: &str, runs: &[CheckResults], force: bool) -> Result<Learned> {
    let mut document: DocumentMut = text.parse().map_err(|error| Error::Request(format!("the manifest: {error}")))?;
    let environments: BTreeSet<String> = runs.iter().map(environment_of).collect();
    let mut learned = Learned {
        text: String::new(),
        environments: environments.into_iter().collect(),
        lessons: Vec::new(),
        refused: Vec::new(),
    };
    let seen = seen(manifest, runs);
    if seen.is_empty() {
        return Err(Error::Request(
            "the runs have no case of this manifest; name the JSON of `dejag check` with this manifest".into(),
        ));
    }
    for (pattern, seen) in seen {
        match seen.lessons(manifest, force) {
            Err(why) => learned.refused.push((pattern, why)),
            Ok(needs) if needs.is_empty() => {}
            Ok(needs) => {
                set(&mut document, &pattern, &needs)?;
                learned.lessons.extend(needs.into_iter().map(|need| need.lesson(&pattern)));
            }
        }
    }
    learned.text = document.to_string();
    Ok(learned)
}

fn environment_of(run: &CheckResults) -> String {
    format!("{} on {}", run.environment.key, run.environment.platform)
}

/// By what the override's `case` will say: a sequence as a whole, everything else picture by picture.
fn seen<'a>(manifest: &'a Manifest, runs: &'a [CheckResults]) -> BTreeMap<String, Seen<'a>> {
    let entries: BTreeMap<&str, &Entry> = manifest.entries.iter().map(|entry| (entry.id.as_str(), entry)).collect();
    let mut all: BTreeMap<String, Seen<'a>> = BTreeMap::new();
    for run in runs {
        for case in &run.cases {
            let Some(entry) = entries.get(case.entry.as_str()) else { continue };
            let pattern = match entry.subject {
                Subject::Sequence(..) => format!("{}/*", escape(&case.entry)),
                _ => escape(&case.id),
            };
            all.entry(pattern).or_insert_with(|| Seen { entry, cases: Vec::new() }).cases.push((run, case));
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
    before_written: Value,
    after_written: Value,
}

impl Need {
    fn is_wider(&self) -> bool {
        if self.key.starts_with("min") { self.after < self.before } else { self.after > self.before }
    }

    fn lesson(&self, pattern: &str) -> Lesson {
        let text = |value: &Value| value.to_string().trim().to_owned();
        Lesson { case: pattern.to_owned(), key: self.key, before: text(&self.before_written), after: text(&self.after_written) }
    }
}

impl Seen<'_> {
    /// Limits that must be set anew; an error says why none may be.
    fn lessons(&self, manifest: &Manifest, force: bool) -> Result<Vec<Need>, String> {
        let tolerance = self.tolerance(manifest)?;
        let mut needs = self.needs(&tolerance)?;
        needs.retain(|need| need.after != need.before);
        let wider = needs.iter().any(Need::is_wider);
        match self.refusal().filter(|_| wider && !force) {
            Some(why) => Err(why),
            None => Ok(needs),
        }
    }

    /// Why its tolerance must not become wider, if it must not.
    fn refusal(&self) -> Option<String> {
        let environments: BTreeSet<String> = self.cases.iter().map(|(run, _)| environment_of(run)).collect();
        if environments.len() < 2 {
            let one = environments.first().map_or("none", String::as_str);
            return Some(format!("it would become wider, and it was seen in one environment only, {one}; --force widens it"));
        }
        let failing = self.cases.iter().find(|(_, case)| case.pair.outcome != DiffOutcome::Same)?;
        Some(format!("it would become wider, and it fails on {}; mend it, or give --force", failing.0.environment.key))
    }

    /// The one tolerance that holds for all that was seen of it.
    fn tolerance(&self, manifest: &Manifest) -> Result<Tolerance, String> {
        let of =
            |(run, case): &Run<'_>| manifest.tolerance(self.entry, &case.id, &run.environment.key, &run.environment.platform);
        let first = of(&self.cases[0]);
        if self.cases.iter().any(|run| of(run) != first) || self.cases.iter().any(|(_, case)| manifest.differs_by_place(&case.id))
        {
            return Err("the manifest sets its limits by environment, platform or frame; edit those overrides yourself".into());
        }
        Ok(first)
    }

    fn needs(&self, tolerance: &Tolerance) -> Result<Vec<Need>, String> {
        let compared = |case: &CheckedCase| matches!(case.pair.outcome, DiffOutcome::Same | DiffOutcome::Different);
        if let Some((run, case)) = self.cases.iter().find(|(_, case)| !compared(case)) {
            return Err(format!("on {} it is {}", run.environment.key, case.pair.outcome.as_str()));
        }
        let limits = tolerance.limits();
        let mut needs = Vec::new();
        if limits.asks_pixels() {
            needs.push(match tolerance.max_pixels {
                Some(Allowance::Share(share)) => self.share(share)?,
                Some(Allowance::Count(count @ 1..)) => self.count(count)?,
                _ if limits.allow_edges => self.count(0)?,
                _ => self.channel(tolerance.per_channel.unwrap_or(0.0))?,
            });
        }
        for limit in &limits.metrics {
            let option = limit.measure.option();
            let key = option.trim_start_matches("--");
            let after = self.worst(option, key.starts_with("min"))?;
            // Where all pictures are the golden ones a least PSNR has nothing to learn from.
            if after.is_finite() {
                let (before_written, after_written) = (Value::from(limit.limit), Value::from(after));
                needs.push(Need { key, before: limit.limit, after, before_written, after_written });
            }
        }
        Ok(needs)
    }

    /// A knob of each run, all of one metric.
    fn knobs(&self, option: &str) -> Result<Vec<&Knob>, String> {
        let knob = |(run, case): &Run<'_>| {
            let place = case.pair.knobs.iter().position(|knob| knob.option == option);
            place.ok_or_else(|| format!("the run on {} does not say {option} of it", run.environment.key))
        };
        let places: Vec<usize> = self.cases.iter().map(knob).collect::<Result<_, _>>()?;
        let knobs: Vec<&Knob> = self.cases.iter().zip(places).map(|((_, case), place)| &case.pair.knobs[place]).collect();
        if knobs.iter().any(|knob| knob.metric != knobs[0].metric) {
            return Err(format!("the runs measured {option} in different ways"));
        }
        Ok(knobs)
    }

    /// The worst that passes in all runs.
    fn worst(&self, option: &str, least: bool) -> Result<f64, String> {
        let passing: Vec<f64> = self.knobs(option)?.into_iter().map(passing).collect::<Result<_, _>>()?;
        let worst = |a: f64, b: f64| if least { a.min(b) } else { a.max(b) };
        Ok(passing.into_iter().fold(if least { f64::INFINITY } else { 0.0 }, worst))
    }

    fn count(&self, before: u64) -> Result<Need, String> {
        let after = self.worst("--max-pixels", false)?;
        let (before_written, after_written) = (Value::from(before as i64), Value::from(after as i64));
        Ok(Need { key: "max-pixels", before: before as f64, after, before_written, after_written })
    }

    /// In percent of the compared pixels, to four digits upwards.
    fn share(&self, before: f64) -> Result<Need, String> {
        let mut percent: f64 = 0.0;
        for (knob, (_, case)) in self.knobs("--max-pixels")?.into_iter().zip(&self.cases) {
            let compared = case.pair.pixels.as_ref().map_or(1, |pixels| pixels.compared.max(1)) as f64;
            percent = percent.max((passing(knob)? / compared * 1e6).ceil() / 1e4);
        }
        let written = |percent: f64| Value::from(format!("{percent}%"));
        let (before_written, after_written) = (written(100.0 * before), written(percent));
        Ok(Need { key: "max-pixels", before, after: percent / 100.0, before_written, after_written })
    }

    fn channel(&self, before: f64) -> Result<Need, String> {
        if self.knobs("--max-pixels")?.iter().any(|knob| knob.limit != Some(0.0)) {
            return Err("a run let pixels differ, so it does not say what tolerance none of them needs; run it again".into());
        }
        let (after, after_written) = in_levels(self.worst("--per-channel", false)?);
        let before_written = in_levels(before).1;
        Ok(Need { key: "per-channel", before, after, before_written, after_written })
    }
}

/// As levels of 8 bits where it is a whole number of them.
fn in_levels(difference: f64) -> (f64, Value) {
    let levels = (difference * 255.0).round();
    let whole = (difference * 255.0 - levels).abs() < 1e-9;
    if whole { (levels / 255.0, Value::from(format!("{levels}/255"))) } else { (difference, Value::from(difference)) }
}

/// What a knob passes at; nothing limits what is equal. No limit may be less than 0.
fn passing(knob: &Knob) -> Result<f64, String> {
    match (knob.passes_at, knob.value) {
        (Some(at), _) if at >= 0.0 => Ok(at),
        (None, Figure::Infinite) if knob.option.starts_with("--min") => Ok(f64::INFINITY),
        _ => Err(format!("no {} would pass", knob.option)),
    }
}

/// Writes limits into an override of exactly this case. It goes to the end, where it holds over all others, with what it said before.
fn set(document: &mut DocumentMut, case: &str, needs: &[Need]) -> Result<()> {
    let overrides = document.entry("override").or_insert(Item::ArrayOfTables(ArrayOfTables::new()));
    let foreign = || Error::Request("write the manifest's overrides as [[override]] tables, so that one can be added".into());
    let overrides = overrides.as_array_of_tables_mut().ok_or_else(foreign)?;
    let mut limits = InlineTable::new();
    let is_it = |table: &Table| {
        table.len() == 2 && table.contains_key("tolerance") && table.get("case").and_then(Item::as_str) == Some(case)
    };
    let known: Vec<usize> = overrides.iter().enumerate().filter(|(_, table)| is_it(table)).map(|(index, _)| index).collect();
    for index in known.into_iter().rev() {
        if let Some(known) = overrides.get(index).and_then(|table| table.get("tolerance")).and_then(Item::as_table_like) {
            limits.extend(known.iter().filter_map(|(key, item)| Some((key.to_owned(), item.as_value()?.clone()))));
        }
        overrides.remove(index);
    }
    limits.extend(needs.iter().map(|need| (need.key.to_owned(), need.after_written.clone())));
    limits.fmt();
    let mut table = Table::new();
    table["case"] = toml_edit::value(case);
    table["tolerance"] = toml_edit::value(limits);
    overrides.push(table);
    Ok(())
}
