//! Time against error: the points of the plots.

use super::labels::{Labels, distinct};
use super::words::score;
use crate::suite::{MethodResult, Outcome, Results, SceneResult};

/// One method in a plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Point {
    /// The method's label.
    pub(super) label: String,
    /// Milliseconds, at least 0.
    pub(super) time_ms: f64,
    /// Mean FLIP error, at least 0.
    pub(super) error: f64,
    /// Whether no other beats it in time and error.
    pub(super) unbeaten: bool,
}

/// The methods that can be plotted, and the labels of those that cannot: without a picture, a time or an error.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Points {
    pub(super) shown: Vec<Point>,
    pub(super) omitted: Vec<String>,
}

/// The points of one scene.
pub(super) fn of_scene(scene: &SceneResult, labels: &Labels) -> Points {
    let mut points = Points::default();
    for method in &scene.methods {
        let label = labels.get(&method.spec);
        match (time_and_error(method), &method.outcome) {
            (Some((time_ms, error)), Outcome::Scored { timing, .. }) => {
                points.shown.push(Point { label, time_ms, error, unbeaten: timing.unbeaten });
            }
            _ => points.omitted.push(label),
        }
    }
    points
}

/// The points over all scenes: geometric mean of times, arithmetic mean of errors, of the methods that have both everywhere.
pub(super) fn over_all(results: &Results, labels: &Labels) -> Points {
    let mut points = Points::default();
    for spec in distinct(results) {
        let label = labels.get(&spec);
        match means(results, &spec) {
            Some((time_ms, error)) => points.shown.push(Point { label, time_ms, error, unbeaten: false }),
            None => points.omitted.push(label),
        }
    }
    let all = points.shown.clone();
    for point in &mut points.shown {
        point.unbeaten = !all.iter().any(|other| other.time_ms < point.time_ms && other.error < point.error);
    }
    points
}

/// Geometric mean of a method's times and mean of its errors; none if a scene lacks one of them.
pub(super) fn means(results: &Results, spec: &str) -> Option<(f64, f64)> {
    let each: Option<Vec<(f64, f64)>> = results
        .scenes
        .iter()
        .map(|scene| scene.methods.iter().find(|method| method.spec == spec).and_then(time_and_error))
        .collect();
    let each = each.filter(|each| !each.is_empty())?;
    let n = each.len() as f64;
    let time = (each.iter().map(|(time, _)| time.ln()).sum::<f64>() / n).exp();
    Some((time, each.iter().map(|(_, error)| error).sum::<f64>() / n))
}

/// Milliseconds in all and mean FLIP, where both are finite.
fn time_and_error(method: &MethodResult) -> Option<(f64, f64)> {
    let Outcome::Scored { timing, .. } = &method.outcome else {
        return None;
    };
    let (time, error) = (timing.total_ms.median, score(&method.outcome, "flip").number()?);
    (time.is_finite() && error.is_finite()).then_some((time.max(0.0), error.max(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::Figure;
    use crate::report::sample;

    #[test]
    fn failed_and_non_finite_methods_are_named_not_drawn() {
        let results = sample::results(6);
        let points = of_scene(&results.scenes[0], &Labels::of(&results));
        assert_eq!(points.omitted, ["msaa:samples=16", "taa"]);
        assert_eq!(points.shown.len(), 4);
    }

    #[test]
    fn over_all_scenes_only_full_rows_count() {
        let mut results = sample::results(6);
        let labels = Labels::of(&results);
        let complete = over_all(&results, &labels);
        let lost = results.scenes[1].methods[0].spec.clone();
        if let Outcome::Scored { scores, .. } = &mut results.scenes[1].methods[0].outcome {
            scores.iter_mut().for_each(|score| score.value = Figure::NotApplicable);
        }
        let partial = over_all(&results, &labels);
        assert!(complete.shown.iter().any(|point| point.label == lost));
        assert!(partial.omitted.contains(&lost));
    }

    #[test]
    fn a_zero_time_gives_a_zero_mean() {
        let mut results = sample::results(1);
        if let Outcome::Scored { timing, .. } = &mut results.scenes[0].methods[0].outcome {
            timing.total_ms.median = 0.0;
        }
        let spec = results.scenes[0].methods[0].spec.clone();
        assert_eq!(means(&results, &spec).map(|(time, _)| time), Some(0.0));
    }
}
