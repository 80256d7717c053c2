//! What came of comparing pictures, for a terminal.

use super::{Ink, TABLE_WIDTH};
use crate::metrics::Figure;
use crate::report::words::{figure, printable, wrap};
use crate::suite::{ClassFigures, DiffOutcome, DiffPair, DiffResults, Knob, OutcomeCounts, PixelFigures, WorstPixel};

/// Below the line of its pair.
pub(super) const INDENT: usize = 4;

/// A paragraph for each pair; of several pairs, those that are the same only with `all`. Lines keep to [`TABLE_WIDTH`] characters
/// where no path is longer. With `color`, ANSI escapes mark what matters.
#[must_use]
pub fn diff_text(results: &DiffResults, all: bool, color: bool) -> String {
    let ink = Ink { color };
    let shown = |pair: &&DiffPair| all || results.pairs.len() == 1 || pair.outcome != DiffOutcome::Same;
    let lines = results.pairs.iter().filter(shown).flat_map(|pair| paragraph(pair, &ink));
    lines.map(|line| line + "\n").collect()
}

/// How many pairs came out how, in a line.
#[must_use]
pub fn diff_summary(results: &DiffResults) -> String {
    let mut words = counted(&results.counts);
    match results.skipped {
        0 => {}
        1 => words.push("1 other file skipped".into()),
        n => words.push(format!("{n} other files skipped")),
    }
    words.join(", ")
}

/// Each outcome that there is, with its count.
pub(super) fn counted(counts: &OutcomeCounts) -> Vec<String> {
    let there = counts.all().into_iter().filter(|(_, count)| *count > 0);
    let words: Vec<String> = there.map(|(outcome, count)| format!("{count} {}", outcome.as_str())).collect();
    if words.is_empty() { vec!["no pictures".into()] } else { words }
}

pub(super) fn paragraph(pair: &DiffPair, ink: &Ink) -> Vec<String> {
    let word = pair.outcome.as_str();
    let marked = match pair.outcome {
        DiffOutcome::Same => ink.green(word),
        DiffOutcome::Different | DiffOutcome::Size | DiffOutcome::Profile | DiffOutcome::Unreadable | DiffOutcome::Failed => {
            ink.red(word)
        }
        DiffOutcome::Missing | DiffOutcome::New | DiffOutcome::Uncounted => ink.yellow(word),
    };
    let name = pair.path.as_deref().or(pair.actual.as_deref()).or(pair.expected.as_deref()).unwrap_or_default();
    let gap = " ".repeat(10 - word.len().min(9));
    let mut lines = vec![format!("{marked}{gap}{}", printable(name))];
    let mut say = |text: &str| {
        lines.extend(wrap(&printable(text), TABLE_WIDTH - INDENT).into_iter().map(|line| " ".repeat(INDENT) + &line));
    };
    if let Some(why) = &pair.why {
        say(why);
    }
    if let Some(pixels) = &pair.pixels {
        of_pixels(pixels).iter().for_each(|line| say(line));
    }
    if let Some(classes) = &pair.classes {
        say(&of_classes(classes));
    }
    of_limits(&pair.knobs).iter().for_each(|line| say(line));
    if pair.outcome == DiffOutcome::Different {
        let bits =
            pair.pixels.as_ref().and_then(|pixels| pixels.worst.as_ref()).map_or(32, |worst| worst.bits[0].max(worst.bits[1]));
        say(&what_would_pass(&pair.knobs, bits));
    }
    if !pair.pictures.is_empty() {
        say(&format!("written: {}", pair.pictures.join(", ")));
    }
    lines
}

fn of_pixels(pixels: &PixelFigures) -> Vec<String> {
    let PixelFigures { compared, differing, bounds, worst } = pixels;
    let Some(worst) = worst else {
        return vec![format!("all {compared} compared pixels are equal")];
    };
    let percent = 100.0 * *differing as f64 / *compared as f64;
    let place = bounds.map_or(String::new(), |[x, y, width, height]| format!(", all within {width}x{height} at {x},{y}"));
    vec![format!("{differing} of {compared} pixels differ ({}%){place}", four_digits(percent)), of_worst(worst)]
}

fn of_worst(worst: &WorstPixel) -> String {
    let [x, y] = worst.at;
    let bits = worst.bits[0].max(worst.bits[1]);
    let by = worst.difference.map_or("a channel is no number".into(), |by| format!("a channel differs by {}", step(by, bits)));
    let (expected, actual) = (channels(&worst.expected, worst.bits[0]), channels(&worst.actual, worst.bits[1]));
    format!("worst at {x},{y}: expected {expected}, actual {actual}, {by}")
}

fn channels(values: &[Option<f64>], bits: u8) -> String {
    let value = |value: &Option<f64>| value.map_or("NaN".into(), four_digits);
    let level = |value: &Option<f64>| value.map_or(String::new(), |value| format!("{value:.0}"));
    let words: Vec<String> = values.iter().map(|v| if bits == 32 { value(v) } else { level(v) }).collect();
    format!("({})", words.join(", "))
}

/// A difference of levels as such, others as a number.
fn step(difference: f64, bits: u8) -> String {
    let levels = match bits {
        8 => 255.0,
        16 => 65_535.0,
        _ => return four_digits(difference),
    };
    format!("{:.0}/{levels}", difference * levels)
}

/// Not rounded down: four digits of a limit must pass.
fn four_digits(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let digits = (3 - x.abs().log10().floor() as i32).clamp(0, 17) as usize;
    let scale = 10f64.powi(digits as i32);
    let text = format!("{:.digits$}", (x * scale - 1e-9).ceil() / scale);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

fn of_classes(classes: &ClassFigures) -> String {
    let ClassFigures { edge_pixels, object_pixels, object_count, largest_objects, .. } = classes;
    let largest = largest_objects.first().map_or(String::new(), |largest| {
        let [x, y, width, height] = largest.bounds;
        format!(", the largest of {} pixels within {width}x{height} at {x},{y}", largest.pixels)
    });
    let objects = if *object_count == 1 { "object" } else { "objects" };
    format!("of these {edge_pixels} lie on resampled edges, {object_pixels} in {object_count} changed {objects}{largest}")
}

/// Each limit of a metric with what it came to; those of pixels are said already.
fn of_limits(knobs: &[Knob]) -> Vec<String> {
    let told = knobs.iter().filter(|knob| !is_of_pixels(knob));
    told.filter_map(|knob| {
        let verdict = if knob.met? { "met" } else { "missed" };
        let value = match knob.value {
            Figure::Number(x) => format!("{x:.6}"),
            other => figure("", other),
        };
        let reason = if knob.value == Figure::NotApplicable { " (does not apply to pictures this small)" } else { "" };
        Some(format!("{} {}: {verdict}, it is {value}{reason}", knob.option, knob.limit?))
    })
    .collect()
}

fn is_of_pixels(knob: &Knob) -> bool {
    matches!(knob.option.as_str(), "--max-pixels" | "--per-channel")
}

fn what_would_pass(knobs: &[Knob], bits: u8) -> String {
    let limit = |knob: &Knob| {
        let at = knob.passes_at?;
        Some(match knob.option.as_str() {
            "--max-pixels" => format!("--max-pixels {at}"),
            "--per-channel" => format!("--per-channel {}", step(at, bits)),
            option => format!("{option} {at}"),
        })
    };
    let all: Vec<String> = knobs.iter().filter_map(limit).collect();
    format!("each would pass alone: {}", all.join("; "))
}
