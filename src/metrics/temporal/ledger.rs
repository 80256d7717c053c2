//! A method's figures over a sequence, a frame at a time.

use std::collections::VecDeque;

use super::{
    Change, Continuity, GAPS, GhostSums, MEASURES, Measure, Truth, change, mean_square, mean_square_of_steps, similarity,
};
use crate::Result;
use crate::metrics::{Better, Figure, Pair, find};
use crate::picture::{DisplayPicture, LinearPicture};

/// Keeps what a method's figures are made of, and no more pictures than are looked back at.
#[derive(Debug, Default)]
pub struct Ledger {
    /// The latest first.
    earlier: VecDeque<DisplayPicture>,
    rows: Vec<FrameRow>,
    ghost: GhostSums,
}

/// One frame's part in every figure.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameRow {
    /// Mean squared error of display values.
    pub square: f64,
    /// Mean FLIP.
    pub flip: Figure,
    /// Mean squared error of the difference to the frame before.
    pub step_square: Option<f64>,
    /// Change along the surfaces beyond the reference's, at each gap.
    pub excess: [Option<Change>; GAPS],
    /// Similarity to the frame before, less the reference's.
    pub similarity: Option<f64>,
    /// What is left of what was in front.
    pub ghost: GhostSums,
    /// How much of the reference's thin lines is there.
    pub continuity: Option<Continuity>,
    /// Sum over pixels and channels of linear values, and the reference's.
    pub energy: [f64; 2],
    /// Pixels that are NaN or infinite.
    pub non_finite: u64,
}

/// A measure's outcome.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Which.
    pub measure: &'static Measure,
    /// Over all frames.
    pub overall: Figure,
    /// The worst frame; none where no frame has a figure.
    pub worst: Option<Worst>,
    /// Each frame's; empty for a measure that only a sequence has.
    pub frames: Vec<Figure>,
}

/// The frame that is worst by a measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// Its place in the sequence, from 0.
    pub frame: usize,
    /// Its figure.
    pub value: Figure,
}

impl Ledger {
    /// Takes a frame in: as displayed, and its exposed linear values if it has any.
    ///
    /// # Errors
    /// [`crate::Error::SizeMismatch`] if it is not of the reference's size.
    pub fn add(&mut self, display: DisplayPicture, linear: Option<&LinearPicture>, truth: &Truth) -> Result<&FrameRow> {
        let pair = Pair::new(&display, &truth.display)?;
        if truth.is_first() {
            self.earlier.clear();
        }
        let excess = |k: usize| {
            let before = self.earlier.get(k)?;
            let (own, right) = (change(&display, before, &truth.tracks, k + 1)?, truth.changes[k]?);
            Some(Change { mean: own.mean - right.mean, p99: own.p99 - right.p99 })
        };
        let before = self.earlier.front().zip(truth.earlier.first());
        let ghost = GhostSums::of(&display, &truth.display, truth.tracks.uncovered(), |age| {
            truth.earlier.get(age - 1).map(|picture| &**picture)
        });
        let row = FrameRow {
            square: mean_square(&display, &truth.display),
            flip: find("flip")?.evaluate(&pair),
            step_square: before.map(|(own, right)| mean_square_of_steps([&display, own], [&truth.display, right])),
            excess: std::array::from_fn(excess),
            similarity: before.and_then(|(own, _)| Some(similarity(&display, own, &truth.tracks)? - truth.similarity?)),
            ghost,
            continuity: truth.ridges.kept_in(&display),
            energy: energy(&display, linear, truth),
            non_finite: linear.map_or_else(|| display.non_finite(), LinearPicture::non_finite).map_or(0, |found| found.pixels),
        };
        self.ghost.add(&row.ghost);
        self.rows.push(row);
        self.earlier.push_front(display);
        self.earlier.truncate(GAPS);
        Ok(&self.rows[self.rows.len() - 1])
    }

    /// Each measure's outcome, in the registry's order.
    #[must_use]
    pub fn verdicts(&self) -> Vec<Verdict> {
        let verdict = |measure: &'static Measure| {
            let frames: Vec<Figure> = measure.frame.map_or_else(Vec::new, |frame| self.rows.iter().map(frame).collect());
            Verdict { measure, overall: (measure.overall)(&self.rows), worst: worst(&frames, measure.better), frames }
        };
        MEASURES.iter().map(verdict).collect()
    }

    /// What is left of what was in front, over all frames.
    #[must_use]
    pub fn ghost(&self) -> &GhostSums {
        &self.ghost
    }

    /// The frames so far.
    #[must_use]
    pub fn rows(&self) -> &[FrameRow] {
        &self.rows
    }
}

/// Where there are no linear values, display values of both sides are decoded: light as it leaves the display.
fn energy(display: &DisplayPicture, linear: Option<&LinearPicture>, truth: &Truth) -> [f64; 2] {
    let sum = |picture: &LinearPicture| picture.rows().map(|row| row.iter().flat_map(|p| super::rgb(*p)).sum::<f64>()).sum();
    match linear {
        Some(linear) => [sum(linear), sum(&truth.linear)],
        None => [sum(&display.to_linear()), sum(&truth.display.to_linear())],
    }
}

/// A figure that is none because a pixel is none is the worst there can be.
fn worst(frames: &[Figure], better: Better) -> Option<Worst> {
    let badness = |figure: Figure| match (figure, better) {
        (Figure::NonFinite, _) => Some(f64::INFINITY),
        (figure, Better::Higher) => Some(-figure.number()?),
        (figure, Better::Lower) => figure.number(),
        (figure, Better::NearOne) => Some((figure.number()? - 1.0).abs()),
        (figure, Better::NearZero) => Some(figure.number()?.abs()),
    };
    let rated = frames.iter().enumerate().filter_map(|(frame, value)| Some((badness(*value)?, Worst { frame, value: *value })));
    rated.reduce(|worst, other| if other.0 > worst.0 { other } else { worst }).map(|(_, worst)| worst)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::temporal::sample::pan;
    use crate::metrics::temporal::{Flow, Yardstick};

    const SIZE: [u32; 2] = [24, 16];

    fn picture(level: impl Fn(u32, u32) -> f32) -> DisplayPicture {
        DisplayPicture::from_fn(SIZE[0], SIZE[1], |x, y| [level(x, y), level(x, y), level(x, y), 1.0]).expect("a size")
    }

    fn still() -> Flow {
        pan(SIZE, [0.0; 2])
    }

    /// A sequence of test pictures against one right picture, with cuts at some frames.
    fn ledger(right: &DisplayPicture, tests: &[DisplayPicture], cuts: &[usize]) -> Ledger {
        let (mut yardstick, mut ledger) = (Yardstick::default(), Ledger::default());
        for (frame, test) in tests.iter().enumerate() {
            let flow = (frame > 0 && !cuts.contains(&frame)).then(still);
            let truth = yardstick.next(right.clone(), right.to_linear(), flow);
            ledger.add(test.clone(), Some(&test.to_linear()), &truth).expect("of one size");
        }
        ledger
    }

    fn verdict(ledger: &Ledger, name: &str) -> Verdict {
        ledger.verdicts().into_iter().find(|v| v.measure.name == name).unwrap_or_else(|| panic!("no measure {name}"))
    }

    fn line(level: f32) -> DisplayPicture {
        picture(move |x, _| if x == 9 { level } else { 0.25 })
    }

    #[test]
    fn the_right_sequence_is_perfect() {
        let right = line(0.75);
        let ledger = ledger(&right, &[right.clone(), right.clone(), right.clone()], &[]);
        for verdict in ledger.verdicts() {
            let perfect = match (verdict.measure.name, verdict.measure.better) {
                ("ghost" | "flicker-3" | "flicker-4" | "flicker-3-p99" | "flicker-4-p99", _) => Figure::NotApplicable,
                ("psnr" | "tpsnr", _) => Figure::Infinite,
                (_, Better::Higher | Better::NearOne) => Figure::Number(1.0),
                (_, Better::Lower | Better::NearZero) => Figure::Number(0.0),
            };
            assert_eq!(verdict.overall, perfect, "{}", verdict.measure.name);
        }
    }

    #[test]
    fn a_line_that_blinks_is_seen_by_all_that_look_at_time() {
        let right = line(0.75);
        let tests: Vec<_> = (0..6).map(|frame| if frame % 2 == 0 { line(0.75) } else { line(0.25) }).collect();
        let ledger = ledger(&right, &tests, &[]);
        let number = |name: &str| verdict(&ledger, name).overall.number().unwrap_or_else(|| panic!("{name}"));
        assert!((number("flicker-1") - 0.5 / 24.0).abs() < 1e-9, "one column of 24 changes by a half");
        assert_eq!(number("flicker-2"), 0.0, "it is back two frames later");
        assert!((number("tpsnr") - -10.0 * (0.25f64 / 24.0).log10()).abs() < 1e-6);
        assert_eq!(number("continuity"), 0.5);
        assert_eq!(number("continuity-sd"), 0.5);
        assert!(number("if-ssim") < -0.01);
        assert!(number("energy") < 0.999);
        assert_eq!(verdict(&ledger, "continuity").worst.map(|w| w.frame), Some(1));
    }

    #[test]
    fn nothing_is_compared_over_a_cut() {
        let right = line(0.75);
        let ledger = ledger(&right, &[line(0.25), line(0.75), line(0.75)], &[1]);
        assert_eq!(verdict(&ledger, "flicker-1").frames[1], Figure::NotApplicable);
        assert_eq!(verdict(&ledger, "flicker-1").overall, Figure::Number(0.0));
        assert_eq!(verdict(&ledger, "tpsnr").overall, Figure::Infinite);
    }

    #[test]
    fn squared_errors_are_pooled_before_they_are_decibels() {
        let right = picture(|_, _| 0.5);
        let tests = [picture(|_, _| 0.5), picture(|_, _| 0.7)];
        let found = verdict(&ledger(&right, &tests, &[]), "psnr");
        assert!((found.overall.number().expect("finite") - -10.0 * 0.02f64.log10()).abs() < 1e-5);
        assert_eq!(found.frames[0], Figure::Infinite);
        assert_eq!(found.worst.map(|w| w.frame), Some(1));
    }

    #[test]
    fn one_nan_is_counted_and_is_the_worst() {
        let right = line(0.75);
        let broken = picture(|x, y| if (x, y) == (3, 3) { f32::NAN } else { 0.25 });
        let ledger = ledger(&right, &[right.clone(), broken, right.clone()], &[]);
        assert_eq!(ledger.rows().iter().map(|row| row.non_finite).collect::<Vec<_>>(), [0, 1, 0]);
        let energy = verdict(&ledger, "energy");
        assert_eq!(energy.overall, Figure::NonFinite);
        assert_eq!(energy.worst.map(|w| w.frame), Some(1));
        assert_eq!(verdict(&ledger, "flip").overall, Figure::NonFinite);
    }
}
