//! What earlier runs said of a case, as a small curve with words for who does not see it.

use std::collections::HashMap;

use maud::{Markup, html};

use super::case::{flip, number};
use super::page::outcome_class;
use crate::report::words::printable;
use crate::suite::{CheckResults, CheckedCase, DiffOutcome, Knob};

/// Most runs that a curve shows: the latest.
const MOST_RUNS: usize = 30;

/// Height of a curve and the distance of its points, in CSS pixels.
const HEIGHT_PX: f64 = 24.0;
const STEP_PX: f64 = 8.0;
const MARGIN_PX: f64 = 4.0;

/// The cases of earlier runs by their ids, oldest first.
pub(super) struct History<'a> {
    runs: Vec<HashMap<&'a str, &'a CheckedCase>>,
}

/// What one run said of a case: nothing if it had none of that id; no value if it has none of the same metric.
type Point = Option<(DiffOutcome, Option<f64>)>;

impl<'a> History<'a> {
    pub(super) fn of(runs: &'a [CheckResults]) -> Self {
        let latest = &runs[runs.len().saturating_sub(MOST_RUNS)..];
        Self { runs: latest.iter().map(|run| run.cases.iter().map(|case| (case.id.as_str(), case)).collect()).collect() }
    }

    /// The curve of a case, this run last; nothing if no earlier run has it.
    pub(super) fn of_case(&self, case: &CheckedCase) -> Markup {
        let earlier: Vec<_> = self.runs.iter().map(|run| run.get(case.id.as_str()).copied()).collect();
        if earlier.iter().all(Option::is_none) {
            return html! {};
        }
        let Some(metric) = followed(case).or_else(|| earlier.iter().rev().flatten().find_map(|case| followed(case))) else {
            return html! { p.history { (outcomes(&earlier)) } };
        };
        let points: Vec<Point> = earlier.into_iter().chain([Some(case)]).map(|case| point(case?, &metric.metric)).collect();
        curve(&metric.metric, &points)
    }
}

/// The figure that is followed over time: FLIP where it was measured, else differing pixels.
fn followed(case: &CheckedCase) -> Option<&Knob> {
    flip(case).or_else(|| case.pair.knobs.iter().find(|knob| knob.option == "--max-pixels"))
}

fn point(case: &CheckedCase, metric: &str) -> Point {
    let knob = case.pair.knobs.iter().find(|knob| knob.metric == metric);
    Some((case.pair.outcome, knob.and_then(|knob| knob.value.number()).filter(|value| value.is_finite())))
}

fn outcomes(earlier: &[Option<&CheckedCase>]) -> String {
    let words: Vec<&str> = earlier.iter().map(|case| case.map_or("no case", |case| case.pair.outcome.as_str())).collect();
    format!("earlier runs: {}", words.join(", "))
}

fn curve(metric: &str, points: &[Point]) -> Markup {
    let values = || points.iter().flatten().filter_map(|(_, value)| *value);
    let most = values().fold(0.0, f64::max);
    let width = 2.0 * MARGIN_PX + STEP_PX * (points.len() - 1) as f64;
    let at = |place: usize, value: f64| {
        let share = if most > 0.0 { value / most } else { 0.0 };
        (MARGIN_PX + STEP_PX * place as f64, HEIGHT_PX - MARGIN_PX - share * (HEIGHT_PX - 2.0 * MARGIN_PX))
    };
    let said = in_words(metric, points);
    html! {
        p.history {
            svg role="img" aria-label=(said) width=(width) height=(HEIGHT_PX) viewBox={ "0 0 " (width) " " (HEIGHT_PX) } {
                title { (said) }
                @for line in unbroken(points) {
                    polyline points=(line.iter().map(|&(place, value)| { let (x, y) = at(place, value); format!("{x:.0},{y:.1} ") }).collect::<String>()) {}
                }
                @for (place, point) in points.iter().enumerate() {
                    @if let Some((outcome, value)) = point {
                        @let (x, y) = at(place, value.unwrap_or(0.0));
                        circle class=(outcome_class(*outcome)) cx=(format!("{x:.0}")) cy=(format!("{y:.1}"))
                            r=(if value.is_some() { 2.5 } else { 1.5 }) {}
                    }
                }
            }
            " " (printable(metric)) " over " (points.len()) " runs, highest " (number(most))
        }
    }
}

/// Runs of neighbours that have values; a gap breaks the line.
fn unbroken(points: &[Point]) -> Vec<Vec<(usize, f64)>> {
    let value = |point: &Point| point.as_ref().and_then(|(_, value)| *value);
    let placed: Vec<_> = points.iter().enumerate().map(|(place, point)| (place, value(point))).collect();
    let lines = placed.split(|(_, value)| value.is_none()).filter(|line| line.len() > 1);
    lines.map(|line| line.iter().filter_map(|&(place, value)| Some((place, value?))).collect()).collect()
}

fn in_words(metric: &str, points: &[Point]) -> String {
    let word = |point: &Point| match point {
        None => "no case".into(),
        Some((outcome, None)) => format!("not comparable ({})", outcome.as_str()),
        Some((outcome, Some(value))) => format!("{} ({})", number(*value), outcome.as_str()),
    };
    let words: Vec<String> = points.iter().map(word).collect();
    format!("{metric} over {} runs, this one last: {}", points.len(), words.join(", "))
}
