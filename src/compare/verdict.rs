//! Figures held against limits.

use super::edges;
use super::figures::figures;
use super::pixels::Pixels;
use super::sides::Sides;
use super::{Limits, Measure};
use crate::Result;
use crate::metrics::{Figure, Mean};
use crate::suite::{ClassFigures, DiffOutcome, Knob, PixelFigures};

/// What was found, and whether it passes.
#[derive(Debug)]
pub(super) struct Verdict {
    pub(super) outcome: DiffOutcome,
    pub(super) pixels: PixelFigures,
    pub(super) classes: Option<edges::Classes>,
    pub(super) knobs: Vec<Knob>,
}

/// How a pair is judged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judge<'a> {
    pub(super) limits: &'a Limits,
    /// Whether metrics without a limit are looked at too.
    pub(super) sweep: bool,
    /// Asked now and then whether to go on.
    pub(super) watch: fn() -> Result<()>,
}

impl Judge<'_> {
    pub(super) fn verdict(&self, sides: &Sides<'_>) -> Result<Verdict> {
        let tolerance = self.limits.per_channel.unwrap_or(0.0);
        let pixels = Pixels::of(sides, tolerance);
        (self.watch)()?;
        let classes = self.limits.allow_edges.then(|| edges::classify(sides, tolerance));
        let mut knobs = self.pixel_knobs(&pixels, classes.as_ref().map(|classes| &classes.figures));
        knobs.extend(self.metric_knobs(sides, &pixels)?);
        let outcome = match (pixels.figures.compared, knobs.iter().any(|knob| knob.met == Some(false))) {
            (0, _) => DiffOutcome::Uncounted,
            (_, true) => DiffOutcome::Different,
            (_, false) => DiffOutcome::Same,
        };
        Ok(Verdict { outcome, pixels: pixels.figures, classes, knobs })
    }

    /// The two knobs of the plain test are met together or not at all.
    fn pixel_knobs(&self, pixels: &Pixels, classes: Option<&ClassFigures>) -> Vec<Knob> {
        let most = self.limits.max_pixels.map_or(0, |most| most.pixels(pixels.figures.compared));
        let differing = classes.map_or(pixels.figures.differing, |classes| classes.object_pixels);
        let asked = self.limits.asks_pixels();
        let met = asked.then_some(differing <= most);
        let metric = if classes.is_some() { "object-pixels/1" } else { "differing-pixels/1" };
        let mut knobs = vec![Knob {
            option: "--max-pixels".into(),
            metric: metric.into(),
            value: Figure::Number(differing as f64),
            limit: asked.then_some(most as f64),
            met,
            passes_at: Some(differing as f64),
        }];
        if classes.is_none() {
            let tolerance = pixels.tolerance_for(most);
            knobs.push(Knob {
                option: "--per-channel".into(),
                metric: "channel-difference/1".into(),
                value: tolerance.map_or(Figure::Infinite, Figure::Number),
                limit: asked.then_some(self.limits.per_channel.unwrap_or(0.0)),
                met,
                passes_at: tolerance,
            });
        }
        knobs
    }

    fn metric_knobs(&self, sides: &Sides<'_>, pixels: &Pixels) -> Result<Vec<Knob>> {
        let wanted = |measure: &Measure| self.sweep || self.limits.of(*measure).is_some();
        let slow = [(Measure::Psnr, Mean::Psnr), (Measure::Ssim, Mean::Ssim), (Measure::Flip, Mean::Flip)];
        let slow: Vec<(Measure, Mean)> = slow.into_iter().filter(|(measure, _)| wanted(measure)).collect();
        let means: Vec<Mean> = slow.iter().map(|(_, mean)| *mean).collect();
        let found = if pixels.figures.worst.is_none() {
            // Equal pictures pass everything, also where a metric would not apply.
            means.iter().map(|mean| perfect(*mean)).collect()
        } else {
            figures(sides, &means, self.watch)?
        };
        let rmse = Figure::from(pixels.rmse);
        let mut knobs = vec![self.metric_knob(Measure::Rmse, "rmse/1", rmse)];
        knobs.extend(slow.iter().zip(found).map(|((measure, mean), value)| self.metric_knob(*measure, mean.id(), value)));
        Ok(knobs)
    }

    fn metric_knob(&self, measure: Measure, id: &str, value: Figure) -> Knob {
        let limit = self.limits.of(measure);
        let passes = |x: f64, limit: f64| if measure.is_least() { x >= limit } else { x <= limit };
        Knob {
            option: measure.option().into(),
            metric: id.into(),
            value,
            limit,
            // What has no figure has not shown that it passes.
            met: limit.map(|limit| value.number().is_some_and(|x| passes(x, limit))),
            passes_at: value.number().filter(|x| x.is_finite()).map(|x| rounded(x, measure.is_least())),
        }
    }
}

fn perfect(mean: Mean) -> Figure {
    match mean {
        Mean::Psnr => Figure::Infinite,
        Mean::Ssim => Figure::Number(1.0),
        Mean::Flip => Figure::Number(0.0),
    }
}

/// To four digits, away from what would fail.
fn rounded(x: f64, down: bool) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let digits = 3 - x.abs().log10().floor() as i32;
    let (scale, inverse) = (10f64.powi(digits), 10f64.powi(-digits));
    let scaled = if down { (x * scale).floor() } else { (x * scale).ceil() };
    // One of the two is a whole power of ten, and dividing by it is exact where multiplying by its inverse is not.
    let near = if digits >= 0 { scaled / scale } else { scaled * inverse };
    let passes = if down { near <= x } else { near >= x };
    if passes { near } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_pass_is_rounded_to_the_safe_side() {
        assert_eq!(rounded(0.012_345_6, false), 0.01235);
        assert_eq!(rounded(35.200_594, true), 35.20);
        assert_eq!(rounded(0.999_999_9, true), 0.9999);
        assert_eq!(rounded(123_456.0, false), 123_500.0);
        assert_eq!(rounded(0.0, false), 0.0);
        for x in [1e-9, 0.3, 0.7, 9.9999, 1.0, 1234.56, 7e8] {
            assert!(rounded(x, false) >= x && rounded(x, true) <= x && rounded(x, false) <= 1.002 * x, "{x}");
        }
    }
}
