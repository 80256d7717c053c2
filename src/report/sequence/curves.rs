//! What changes from frame to frame, as curves.

use crate::metrics::Figure;
use crate::metrics::temporal::MEASURES;
use crate::report::lines::{LinePlot, Scale, Series};
use crate::suite::{SequenceFigures, SequenceOutcome, SequenceResult};

/// A plot with a line of words above it.
pub(super) struct Curves {
    pub(super) title: &'static str,
    pub(super) about: &'static str,
    pub(super) plot: LinePlot,
}

/// One curve of a plot: how a figure of a frame is drawn.
struct OverTime {
    measure: &'static str,
    title: &'static str,
    about: &'static str,
    axis: &'static str,
    value: fn(f64) -> f64,
}

const OVER_TIME: [OverTime; 6] = [
    OverTime {
        measure: "psnr",
        title: "Error",
        about: "PSNR of each frame; higher is better.",
        axis: "PSNR in dB",
        value: |x| x,
    },
    OverTime {
        measure: "flip",
        title: "Visible error",
        about: "Mean FLIP of each frame; lower is better.",
        axis: "FLIP",
        value: |x| x,
    },
    OverTime {
        measure: "flicker-1",
        title: "Flicker",
        about: "How much more, or less, than the reference's the surfaces change from one frame to the next; 0 is right.",
        axis: "excess in 1/255, without its sign",
        value: |x| 255.0 * x.abs(),
    },
    OverTime {
        measure: "ghost",
        title: "Ghosts over time",
        about: "Share that is left of a thing where it was 4 to 8 frames ago; lower is better.",
        axis: "share left",
        value: |x| x,
    },
    OverTime {
        measure: "continuity",
        title: "Thin lines",
        about: "Share of the reference's thin lines that are there; higher is better.",
        axis: "share",
        value: |x| x,
    },
    OverTime {
        measure: "energy",
        title: "Light",
        about: "Light over the reference's; 1 is right.",
        axis: "light over the reference's",
        value: |x| x,
    },
];

/// Every plot that has something to show.
pub(super) fn all(result: &SequenceResult) -> Vec<Curves> {
    let over_time = OVER_TIME.iter().map(|kind| Curves {
        title: kind.title,
        about: kind.about,
        plot: plot(result, ("frame", Scale::Linear), (kind.axis, Scale::Linear), |figures| frames(result, figures, kind)),
    });
    let ages = Curves {
        title: "Ghosts by age",
        about: "Share that is left of a thing where it was so many frames ago; lower is better.",
        plot: plot(result, ("frames ago", Scale::Linear), ("share left", Scale::Linear), |figures| {
            by_number(&figures.ghost.ages)
        }),
    };
    let convergence = Curves {
        title: "Convergence",
        about: "A still picture after a reset: PSNR by the number of frames; higher is better.",
        plot: plot(result, ("frames since the reset", Scale::Linear), ("PSNR in dB", Scale::Linear), |figures| {
            figures.probes.convergence.as_ref().map_or_else(Vec::new, |found| by_number(&found.psnr))
        }),
    };
    let response = Curves {
        title: "Response to light",
        about: "All light is halved: share of the change that is seen after so many frames.",
        plot: plot(result, ("frames since the change", Scale::Linear), ("share", Scale::Linear), |figures| {
            figures.probes.response.as_ref().map_or_else(Vec::new, |found| by_number(&found.shares))
        }),
    };
    let sharpness = Curves {
        title: "Sharpness in motion",
        about: "Gradient energy over the reference's while the picture moves; 1 is right, more is jagged, less is blurred.",
        plot: plot(result, ("pixels a frame", Scale::Linear), ("over the reference's", Scale::Linear), |figures| {
            let speeds = figures.probes.sharpness.iter().flatten();
            speeds.filter_map(|speed| Some((speed.pan_px, speed.ratio.number()?))).collect()
        }),
    };
    let mut curves: Vec<Curves> = over_time.chain([ages, convergence, response, sharpness]).collect();
    curves.retain(|curves| curves.plot.series.iter().any(|series| series.points.len() > 1));
    curves
}

fn plot(
    result: &SequenceResult,
    x: (&str, Scale),
    y: (&str, Scale),
    points: impl Fn(&SequenceFigures) -> Vec<(f64, f64)>,
) -> LinePlot {
    let series = result.methods.iter().filter_map(|method| match &method.outcome {
        SequenceOutcome::Measured(figures) => {
            Some(Series { label: method.spec.clone(), baseline: method.spec == "none", points: points(figures) })
        }
        SequenceOutcome::Failed { .. } => None,
    });
    LinePlot { x: (x.0.to_owned(), x.1), y: (y.0.to_owned(), y.1), series: series.collect() }
}

/// By the place in the sequence: indices may begin anywhere.
fn frames(result: &SequenceResult, figures: &SequenceFigures, kind: &OverTime) -> Vec<(f64, f64)> {
    let id = MEASURES.iter().find(|measure| measure.name == kind.measure).map(|measure| measure.id);
    let Some(found) = id.and_then(|id| figures.figure(id)) else { return Vec::new() };
    let places = (0..result.frames.len()).map(|place| place as f64);
    places.zip(&found.frames).filter_map(|(place, figure)| Some((place, (kind.value)(figure.number()?)))).collect()
}

/// The first is of 1.
fn by_number(figures: &[Figure]) -> Vec<(f64, f64)> {
    let numbers = (1..).map(f64::from);
    numbers.zip(figures).filter_map(|(number, figure)| Some((number, figure.number()?))).collect()
}
