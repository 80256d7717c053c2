//! Whether figures meet the bars that were set for them.

use crate::metrics::Figure;
use crate::metrics::temporal::{GAPS, MEASURES};
use crate::scene::Thresholds;
use crate::suite::{SequenceFigure, SequenceFigures, SequenceMethod, SequenceOutcome};

/// A bar, and the figure that is held against it.
struct Bar {
    /// As on the command line, without its dashes.
    name: &'static str,
    bar: fn(&Thresholds) -> Option<f64>,
    /// The figures must be at least the bar, not at most.
    at_least: bool,
    figure: fn(&SequenceFigures) -> Figure,
}

const BARS: &[Bar] = &[
    Bar { name: "min-psnr", bar: |t| t.min_psnr, at_least: true, figure: |f| overall(f, "psnr") },
    Bar { name: "min-worst-psnr", bar: |t| t.min_worst_psnr, at_least: true, figure: |f| worst(f, "psnr") },
    Bar { name: "min-tpsnr", bar: |t| t.min_tpsnr, at_least: true, figure: |f| overall(f, "tpsnr") },
    Bar { name: "max-flip", bar: |t| t.max_flip, at_least: false, figure: |f| overall(f, "flip") },
    Bar { name: "max-flicker", bar: |t| t.max_flicker, at_least: false, figure: flicker },
    Bar { name: "max-ghost", bar: |t| t.max_ghost, at_least: false, figure: |f| overall(f, "ghost") },
    Bar { name: "max-trail", bar: |t| t.max_trail, at_least: false, figure: |f| f.ghost.trail },
    Bar { name: "min-continuity", bar: |t| t.min_continuity, at_least: true, figure: |f| overall(f, "continuity") },
    Bar { name: "max-energy-error", bar: |t| t.max_energy_error, at_least: false, figure: energy_error },
    Bar {
        name: "max-crawl",
        bar: |t| t.max_crawl,
        at_least: false,
        figure: |f| or_none(f.probes.crawl.as_ref().map(|p| p.mean)),
    },
    Bar {
        name: "max-convergence",
        bar: |t| t.max_convergence,
        at_least: false,
        figure: |f| or_none(f.probes.convergence.as_ref().map(|p| p.frames)),
    },
    Bar {
        name: "max-response",
        bar: |t| t.max_response,
        at_least: false,
        figure: |f| or_none(f.probes.response.as_ref().map(|p| p.frames)),
    },
    Bar {
        name: "max-edge-error",
        bar: |t| t.max_edge_error,
        at_least: false,
        figure: |f| or_none(f.probes.position.as_ref().map(|p| p.rms_px)),
    },
];

/// What each method misses, in words: the method, the figure and the bar. One that could not run misses every bar.
#[must_use]
pub fn misses(methods: &[SequenceMethod], thresholds: &Thresholds) -> Vec<String> {
    let set: Vec<(&Bar, f64)> = BARS.iter().filter_map(|bar| Some((bar, (bar.bar)(thresholds)?))).collect();
    let mut found = Vec::new();
    for SequenceMethod { spec, outcome } in methods {
        match outcome {
            SequenceOutcome::Measured(figures) => {
                found.extend(set.iter().filter_map(|(bar, limit)| Some(format!("{spec}: {}", bar.miss(figures, *limit)?))));
            }
            SequenceOutcome::Failed { error } if !set.is_empty() => found.push(format!("{spec}: could not run: {error}")),
            SequenceOutcome::Failed { .. } => {}
        }
    }
    found
}

impl Bar {
    /// Why a figure does not meet the bar; none if it does.
    fn miss(&self, figures: &SequenceFigures, limit: f64) -> Option<String> {
        let figure = (self.figure)(figures);
        let name = self.name;
        let Some(value) = figure.number() else {
            let why = match figure {
                Figure::NonFinite => "it is no number: pixels are NaN or infinite",
                _ => "there is nothing to measure it on here; leave the bar out, or choose other frames or probes",
            };
            return Some(format!("--{name} {limit}: {why}"));
        };
        let met = if self.at_least { value >= limit } else { value <= limit };
        (!met).then(|| format!("--{name} {limit} is missed: {value:.6}"))
    }
}

fn or_none(figure: Option<Figure>) -> Figure {
    figure.unwrap_or(Figure::NotApplicable)
}

fn found<'f>(figures: &'f SequenceFigures, name: &str) -> Option<&'f SequenceFigure> {
    figures.figure(MEASURES.iter().find(|measure| measure.name == name)?.id)
}

fn overall(figures: &SequenceFigures, name: &str) -> Figure {
    or_none(found(figures, name).map(|figure| figure.overall))
}

fn worst(figures: &SequenceFigures, name: &str) -> Figure {
    or_none(found(figures, name).and_then(|figure| figure.worst).map(|worst| worst.value))
}

/// The largest, either way, of all gaps that have one.
fn flicker(figures: &SequenceFigures) -> Figure {
    let gaps = (1..=GAPS).map(|gap| overall(figures, &format!("flicker-{gap}")));
    let larger = |largest: Figure, figure: Figure| match (largest, figure) {
        (Figure::NonFinite, _) | (_, Figure::NonFinite) => Figure::NonFinite,
        (Figure::Number(a), Figure::Number(b)) => Figure::Number(a.max(b.abs())),
        (_, Figure::Number(b)) => Figure::Number(b.abs()),
        (largest, _) => largest,
    };
    gaps.fold(Figure::NotApplicable, larger)
}

fn energy_error(figures: &SequenceFigures) -> Figure {
    match overall(figures, "energy") {
        Figure::Number(ratio) => Figure::Number((ratio - 1.0).abs()),
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::{Ghost, ProbeFigures, SequenceTiming, Spread};

    /// Methods with these overall figures.
    fn method(figures: &[(&str, Figure)]) -> SequenceMethod {
        let figure = |(name, overall): &(&str, Figure)| SequenceFigure {
            measure: MEASURES.iter().find(|m| m.name == *name).expect(name).id.into(),
            overall: *overall,
            worst: None,
            frames: Vec::new(),
        };
        let figures = SequenceFigures {
            samples_per_pixel: 1.0,
            target_bytes: 0,
            figures: figures.iter().map(figure).collect(),
            ghost: Ghost { ages: Vec::new(), trail: Figure::Infinite },
            non_finite: None,
            probes: ProbeFigures::default(),
            timing: SequenceTiming { frame_ms: Spread::of(vec![1.0]) },
        };
        SequenceMethod { spec: "m".into(), outcome: SequenceOutcome::Measured(Box::new(figures)) }
    }

    fn missed(figures: &[(&str, Figure)], thresholds: Thresholds) -> String {
        misses(&[method(figures)], &thresholds).join("\n")
    }

    #[test]
    fn a_bar_is_met_on_it_and_missed_beyond() {
        let psnr = |x| [("psnr", Figure::Number(x))];
        let bar = Thresholds { min_psnr: Some(30.0), ..Thresholds::default() };
        assert_eq!(missed(&psnr(30.0), bar), "");
        assert_eq!(missed(&psnr(29.5), bar), "m: --min-psnr 30 is missed: 29.500000");
        assert_eq!(missed(&[("psnr", Figure::Infinite)], bar), "");
        let bar = Thresholds { max_ghost: Some(0.1), ..Thresholds::default() };
        assert_eq!(missed(&[("ghost", Figure::Number(0.1))], bar), "");
        assert!(missed(&[("ghost", Figure::Number(0.2))], bar).contains("0.2"));
        let bar = Thresholds { max_trail: Some(4.0), ..Thresholds::default() };
        assert!(missed(&[], bar).contains("inf"));
    }

    #[test]
    fn too_little_flicker_or_light_is_as_wrong_as_too_much() {
        let bar = Thresholds { max_flicker: Some(0.01), max_energy_error: Some(0.01), ..Thresholds::default() };
        let figures = |flicker, energy| [("flicker-2", Figure::Number(flicker)), ("energy", Figure::Number(energy))];
        assert_eq!(missed(&figures(-0.005, 0.995), bar), "");
        let found = missed(&figures(-0.02, 0.95), bar);
        assert!(found.contains("--max-flicker 0.01 is missed: 0.020000") && found.contains("--max-energy-error"), "{found}");
    }

    #[test]
    fn what_could_not_be_measured_is_missed() {
        let bar = Thresholds { max_ghost: Some(0.1), max_crawl: Some(0.1), max_flip: Some(1.0), ..Thresholds::default() };
        let found = missed(&[("ghost", Figure::NotApplicable), ("flip", Figure::NonFinite)], bar);
        assert_eq!(found.lines().count(), 3, "{found}");
        assert!(found.contains("NaN") && found.contains("nothing to measure"), "{found}");
        let failed = SequenceMethod { spec: "f".into(), outcome: SequenceOutcome::Failed { error: "no".into() } };
        assert_eq!(misses(std::slice::from_ref(&failed), &bar), ["f: could not run: no"]);
        assert!(misses(&[failed], &Thresholds::default()).is_empty());
    }

    #[test]
    fn every_bar_reads_its_own_threshold() {
        let all: String = (1..).zip(BARS).map(|(k, bar)| format!("{} = {k}\n", bar.name.replace('-', "_"))).collect();
        let thresholds: Thresholds = toml::from_str(&all).expect("every bar is a threshold");
        for (k, bar) in (1..).zip(BARS) {
            assert_eq!((bar.bar)(&thresholds), Some(f64::from(k)), "{}", bar.name);
        }
        let spoken = format!("{thresholds:?}");
        assert!(!spoken.contains("None"), "a threshold has no bar: {spoken}");
    }
}
