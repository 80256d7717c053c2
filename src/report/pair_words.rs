//! What came of two pictures, in sentences; shared by the terminal, JUnit and GitHub.

use super::words::figure;
use crate::metrics::Figure;
use crate::suite::{ClassFigures, DiffOutcome, DiffPair, Knob, OutcomeCounts, PixelFigures, WorstPixel};

/// What the pair is called: its path below both folders, or the file that is held against the other.
pub(super) fn name(pair: &DiffPair) -> &str {
    pair.path.as_deref().or(pair.actual.as_deref()).or(pair.expected.as_deref()).unwrap_or_default()
}

/// What is known of the pair beside its outcome, the most telling first. They hold file names as they are, control characters
/// included.
pub(super) fn sentences(pair: &DiffPair) -> Vec<String> {
    let mut said: Vec<String> = pair.why.iter().cloned().collect();
    said.extend(pair.pixels.iter().flat_map(of_pixels));
    said.extend(pair.classes.as_ref().map(of_classes));
    said.extend(missed_and_met(&pair.knobs));
    if pair.outcome == DiffOutcome::Different {
        said.push(format!("each would pass alone: {}", what_would_pass(pair).join("; ")));
    }
    if !pair.pictures.is_empty() {
        said.push(format!("written: {}", pair.pictures.join(", ")));
    }
    said
}

/// How many pairs came out how, such as "3 same, 1 different".
pub(super) fn counted(counts: &OutcomeCounts) -> String {
    let some = counts.all().into_iter().filter(|(_, count)| *count > 0);
    let words: Vec<String> = some.map(|(outcome, count)| format!("{count} {}", outcome.as_str())).collect();
    if words.is_empty() { "no pictures".into() } else { words.join(", ") }
}

/// Options, each with a value that the pair would have passed by itself.
pub(super) fn what_would_pass(pair: &DiffPair) -> Vec<String> {
    pair.knobs.iter().filter_map(|knob| Some(option(pair, knob, knob.passes_at?))).collect()
}

/// Options with the limits that the pair missed.
pub(super) fn missed(pair: &DiffPair) -> Vec<String> {
    let missed = pair.knobs.iter().filter(|knob| knob.met == Some(false));
    missed.filter_map(|knob| Some(option(pair, knob, knob.limit?))).collect()
}

/// The option as it stands on a command line, tolerances of levels as such.
fn option(pair: &DiffPair, knob: &Knob, value: f64) -> String {
    let worst = pair.pixels.as_ref().and_then(|pixels| pixels.worst.as_ref());
    match knob.option.as_str() {
        "--per-channel" => format!("--per-channel {}", step(value, worst.map_or(32, |worst| worst.bits[0].max(worst.bits[1])))),
        option => format!("{option} {value}"),
    }
}

fn of_pixels(pixels: &PixelFigures) -> Vec<String> {
    let PixelFigures { compared, differing, bounds, worst } = pixels;
    if *compared == 0 {
        return vec!["mask and regions leave no pixel to compare".into()];
    }
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
fn missed_and_met(knobs: &[Knob]) -> Vec<String> {
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
