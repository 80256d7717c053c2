//! Methods on one scene: captured, timed in turns, scored.

use std::time::Instant;

use super::clock::{Clock, PassTime};
use crate::capture::{Cache, Capture, Reference, Shot, Studio, Watch, analytic};
use crate::error::{Error, Result};
use crate::gpu::{Card, Gpu};
use crate::methods::Spec;
use crate::metrics::{self, METRICS, Pair};
use crate::picture::{BitDepth, DisplayPicture, LinearPicture, NonFinite};
use crate::scene::{Scene, Tick};
use crate::suite::{
    AnalyticDistance, MethodResult, NoiseFloor, Outcome, PassTiming, ReferenceResult, ReferenceTiming, SceneResult, SceneTiming,
    Score, Spread, Stamp, Timing,
};

/// What `dejag score` and `make demo` draw unless told otherwise.
pub const DEMO_SCENES: &[&str] = &["edges", "fence", "foliage", "courtyard"];

/// The methods they draw them with. At most eight: the demo has three minutes. Only the box filter, which is the reference's: any
/// other filter's softness would count as error.
pub const DEMO_METHODS: &[&str] =
    &["none", "fxaa", "mlaa", "smaa", "cmaa2", "msaa:samples=4", "msaa:samples=4+cmaa2", "ssaa:spp=16"];

/// How often a method is timed unless told otherwise.
pub const REPEATS: u32 = 5;

/// Label that the renderer gives the scene's own cost.
const DRAW: &str = "draw";

/// What candidates are held against.
#[derive(Debug)]
pub enum ReferenceChoice {
    /// A capture by this method.
    Method(Spec),
    /// The exact answer; only some scenes have one.
    Analytic,
}

/// What to score.
#[derive(Debug)]
pub struct Request {
    /// The candidates.
    pub methods: Vec<Spec>,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Which frame, from 0.
    pub frame: u32,
    /// What they are held against.
    pub reference: ReferenceChoice,
    /// How often each is timed, after one warming up.
    pub repeats: u32,
}

/// Is told how far a run is, in samples a pixel, and asked whether to go on.
pub trait Progress: Watch {
    /// What is being done now.
    fn say(&mut self, what: String);
    /// A step worth so many samples is over.
    fn advance(&mut self, samples: u64);
}

/// Tells nobody.
impl Progress for () {
    fn say(&mut self, _: String) {}
    fn advance(&mut self, _: u64) {}
}

/// A scene's results and, if wanted, its pictures.
#[derive(Debug)]
pub struct SceneOutcome {
    /// The figures.
    pub result: SceneResult,
    /// The reference as shown.
    pub reference: DisplayPicture,
    /// One a method, in order; none for those that failed.
    pub pictures: Vec<Option<Pictures>>,
}

/// A method's picture and where it is wrong.
#[derive(Debug)]
pub struct Pictures {
    /// As shown, in 8 bits.
    pub capture: DisplayPicture,
    /// FLIP, coloured.
    pub error_map: DisplayPicture,
}

impl Request {
    /// Work of one scene in samples a pixel, for a progress bar.
    #[must_use]
    pub fn work(&self) -> u64 {
        let reference = match &self.reference {
            ReferenceChoice::Method(spec) => spec.first_needs().samples_per_pixel,
            ReferenceChoice::Analytic => 1,
        };
        u64::from(reference) + self.methods.iter().map(|m| self.work_of(m)).sum::<u64>()
    }

    fn work_of(&self, spec: &Spec) -> u64 {
        u64::from(spec.first_needs().samples_per_pixel) * u64::from(1 + self.repeats)
    }
}

/// What results are stamped with.
impl From<&Card> for Stamp {
    fn from(card: &Card) -> Self {
        Self {
            dejag: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: card.name.clone(),
            kind: card.kind.to_owned(),
            driver: card.driver.clone(),
            driver_version: card.driver_version.clone(),
            backend: card.backend.clone(),
        }
    }
}

/// Captures, times and scores every method on one scene.
///
/// A method that the adapter cannot run is a [`Outcome::Failed`]; everything else that fails ends the run.
///
/// # Errors
/// [`Error::Gpu`], [`Error::Interrupted`], [`Error::Request`] for a frame, size or analytic reference that the scene does not have.
pub fn score_scene(
    gpu: &Gpu,
    scene: &Scene,
    request: &Request,
    cache: &Cache,
    progress: &mut impl Progress,
) -> Result<SceneOutcome> {
    let start = Instant::now();
    let mut studio = Studio::new(gpu, scene)?;
    progress.say(format!("{}: reference", scene.name));
    let (target, reference) = make_reference(&mut studio, request, cache, progress)?;
    progress.advance(request.work() - request.methods.iter().map(|m| request.work_of(m)).sum::<u64>());

    let mut candidates = Vec::new();
    for spec in &request.methods {
        progress.say(format!("{}: {spec}", scene.name));
        candidates.push(prepare(&mut studio, spec, request, &target, progress)?);
    }
    for _ in 0..request.repeats {
        for (candidate, spec) in candidates.iter_mut().zip(&request.methods) {
            if let Candidate::Ready(ready) = candidate {
                progress.say(format!("{}: timing {spec}", scene.name));
                ready.time(&mut studio, progress)?;
                progress.advance(u64::from(spec.first_needs().samples_per_pixel));
            }
        }
    }
    let mut methods = Vec::new();
    let mut pictures = Vec::new();
    for (candidate, spec) in candidates.into_iter().zip(&request.methods) {
        let (outcome, seen) = candidate.outcome(gpu);
        methods.push(MethodResult { spec: spec.to_string(), outcome });
        pictures.push(seen);
    }
    mark_unbeaten(&mut methods);
    let timing = SceneTiming { seconds: start.elapsed().as_secs_f64() };
    let (name, about) = (scene.name.clone(), scene.about.clone());
    let result = SceneResult { name, about, frame: request.frame, reference, methods, timing };
    Ok(SceneOutcome { result, reference: target.display, pictures })
}

/// What candidates are compared with.
struct Truth {
    /// Exposed.
    linear: LinearPicture,
    /// In 8 bits.
    display: DisplayPicture,
}

fn make_reference(
    studio: &mut Studio<'_>,
    request: &Request,
    cache: &Cache,
    progress: &mut impl Progress,
) -> Result<(Truth, ReferenceResult)> {
    let start = Instant::now();
    let scene = studio.scene;
    let (reference, exact) = match &request.reference {
        ReferenceChoice::Method(spec) => {
            let reference = studio.reference(spec, &Tick::of(scene, request.frame.into()), request.size, cache, progress)?;
            // Most scenes have no exact answer, and need none.
            (reference, analytic::exact(scene, request.frame, request.size).ok())
        }
        ReferenceChoice::Analytic => {
            let linear = analytic::exact(scene, request.frame, request.size)?;
            let display = studio.display_of(&linear)?;
            (Reference { spec: "analytic".into(), linear, display, halves: None, cached: false }, None)
        }
    };
    let linear = exposed(&reference.linear, scene.exposure)?;
    let exact = exact.map(|exact| exposed(&exact, scene.exposure)).transpose()?;
    let result = ReferenceResult {
        spec: reference.spec,
        noise_floor: reference.halves.map(|h| NoiseFloor { rms: h.rms, max: h.max }),
        analytic: exact.map(|exact| analytic_distance(&linear, &exact)),
        timing: ReferenceTiming { seconds: start.elapsed().as_secs_f64(), cached: reference.cached },
    };
    Ok((Truth { linear, display: reference.display.quantized(BitDepth::Eight) }, result))
}

pub(super) fn exposed(linear: &LinearPicture, exposure: f32) -> Result<LinearPicture> {
    let scale = |[r, g, b, a]: [f32; 4]| [r * exposure, g * exposure, b * exposure, a];
    LinearPicture::new(linear.width(), linear.height(), linear.pixels().iter().map(|p| scale(*p)).collect())
}

fn analytic_distance(reference: &LinearPicture, exact: &LinearPicture) -> AnalyticDistance {
    let (mut sum, mut max) = (0.0, 0.0f64);
    for (p, q) in reference.pixels().iter().zip(exact.pixels()) {
        for channel in 0..3 {
            let difference = f64::from(p[channel].clamp(0.0, 1.0)) - f64::from(q[channel].clamp(0.0, 1.0));
            sum += difference * difference;
            max = max.max(difference.abs());
        }
    }
    AnalyticDistance { rms: (sum / (3 * reference.pixels().len()) as f64).sqrt(), max }
}

enum Candidate {
    Ready(Box<Ready>),
    Failed(String),
}

/// A method whose picture is scored; what is left is timing.
struct Ready {
    shot: Shot,
    scores: Vec<Score>,
    non_finite: Option<NonFinite>,
    samples_per_pixel: f64,
    target_bytes: u64,
    pictures: Pictures,
    runs: Vec<Vec<PassTime>>,
}

fn prepare(
    studio: &mut Studio<'_>,
    spec: &Spec,
    request: &Request,
    truth: &Truth,
    progress: &mut impl Progress,
) -> Result<Candidate> {
    let shot = studio.shot(spec, request.frame, request.size);
    let taken = shot.and_then(|mut shot| studio.take_alone(&mut shot, progress).map(|()| shot));
    let shot = match taken {
        Ok(shot) => shot,
        Err(Error::Unsupported(why)) => {
            progress.advance(request.work_of(spec));
            return Ok(Candidate::Failed(why));
        }
        Err(error) => return Err(error),
    };
    let capture = studio.read(&shot)?;
    progress.advance(u64::from(spec.first_needs().samples_per_pixel));
    let (scores, non_finite, pictures) = held_against(&capture, truth, studio.scene.exposure)?;
    Ok(Candidate::Ready(Box::new(Ready {
        shot,
        scores,
        non_finite,
        samples_per_pixel: capture.samples_per_pixel,
        target_bytes: capture.target_bytes,
        pictures,
        runs: Vec::new(),
    })))
}

fn held_against(capture: &Capture, truth: &Truth, exposure: f32) -> Result<(Vec<Score>, Option<NonFinite>, Pictures)> {
    // Scored as saved: the figures can be had again from the PNG files.
    let display = capture.display.quantized(BitDepth::Eight);
    let linear = capture.linear.as_ref().map(|linear| exposed(linear, exposure)).transpose()?;
    let pair = match &linear {
        Some(linear) => Pair::new(&display, &truth.display)?.with_linear(linear, &truth.linear)?,
        None => Pair::new(&display, &truth.display)?,
    };
    let scores = METRICS.iter().map(|metric| Score { metric: metric.id.to_owned(), value: metric.evaluate(&pair) }).collect();
    let non_finite = linear.as_ref().and_then(LinearPicture::non_finite);
    let error_map = metrics::error_map(&pair)?;
    Ok((scores, non_finite, Pictures { capture: display, error_map }))
}

impl Ready {
    fn time(&mut self, studio: &mut Studio<'_>, progress: &mut impl Progress) -> Result<()> {
        let mut clock = Clock::new(studio.gpu);
        studio.take(&mut self.shot, Some(&mut clock), progress)?;
        self.runs.push(clock.finish()?);
        Ok(())
    }
}

impl Candidate {
    fn outcome(self, gpu: &Gpu) -> (Outcome, Option<Pictures>) {
        match self {
            Self::Failed(error) => (Outcome::Failed { error }, None),
            Self::Ready(ready) => {
                let timing = timing(&ready.runs, Clock::new(gpu).name());
                let outcome = Outcome::Scored {
                    samples_per_pixel: ready.samples_per_pixel,
                    target_bytes: ready.target_bytes,
                    scores: ready.scores,
                    non_finite: ready.non_finite,
                    timing,
                };
                (outcome, Some(ready.pictures))
            }
        }
    }
}

/// Each run's passes, put together by label, in the order they first ran.
fn timing(runs: &[Vec<PassTime>], clock: &str) -> Timing {
    let mut labels: Vec<&str> = Vec::new();
    for pass in runs.iter().flatten() {
        if !labels.contains(&pass.label.as_str()) {
            labels.push(&pass.label);
        }
    }
    let of = |run: &[PassTime], label: &str| run.iter().filter(|p| p.label == label).map(|p| p.ms).sum::<f64>();
    let spread = |label: &str| Spread::of(runs.iter().map(|run| of(run, label)).collect());
    let passes = labels.iter().filter(|label| !label.starts_with(DRAW)).map(|label| {
        let count = runs.first().map_or(0, |run| run.iter().filter(|p| p.label == **label).count());
        PassTiming { pass: (*label).to_owned(), runs: count as u32, ms: spread(label) }
    });
    let drawn = |run: &Vec<PassTime>| run.iter().filter(|p| p.label.starts_with(DRAW)).map(|p| p.ms).sum::<f64>();
    Timing {
        draw_ms: Spread::of(runs.iter().map(drawn).collect()),
        passes: passes.collect(),
        total_ms: Spread::of(runs.iter().map(|run| run.iter().map(|p| p.ms).sum()).collect()),
        clock: clock.to_owned(),
        unbeaten: false,
    }
}

/// Marks the methods that no other beats: is at least as fast and as near to the reference by mean FLIP, and better in one.
fn mark_unbeaten(methods: &mut [MethodResult]) {
    let figures: Vec<Option<(f64, f64)>> = methods.iter().map(|m| cost_and_error(&m.outcome)).collect();
    for (method, own) in methods.iter_mut().zip(&figures) {
        let (Outcome::Scored { timing, .. }, Some((ms, error))) = (&mut method.outcome, own) else {
            continue;
        };
        // At equal error the faster wins, at equal time the nearer.
        let beats = |(other_ms, other): &(f64, f64)| other_ms <= ms && other <= error && (other_ms < ms || other < error);
        timing.unbeaten = !figures.iter().flatten().any(beats);
    }
}

fn cost_and_error(outcome: &Outcome) -> Option<(f64, f64)> {
    let Outcome::Scored { scores, timing, .. } = outcome else {
        return None;
    };
    let flip = METRICS.iter().find(|m| m.name == "flip")?;
    let error = scores.iter().find(|s| s.metric == flip.id)?.value.number()?;
    Some((timing.total_ms.median, error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::Figure;

    fn pass(label: &str, ms: f64) -> PassTime {
        PassTime { label: label.into(), ms }
    }

    #[test]
    fn runs_are_put_together_by_label() {
        let runs = vec![
            vec![pass("draw", 1.0), pass("blend", 0.5), pass("draw", 2.0), pass("blend", 0.25)],
            vec![pass("draw", 3.0), pass("blend", 1.0), pass("draw", 4.0), pass("blend", 1.0)],
        ];
        let timing = timing(&runs, "wall clock");
        assert_eq!((timing.draw_ms.min, timing.draw_ms.max), (3.0, 7.0));
        assert_eq!(timing.passes.len(), 1);
        assert_eq!((timing.passes[0].runs, timing.passes[0].ms.min), (2, 0.75));
        assert_eq!(timing.total_ms.max, 9.0);
    }

    #[test]
    fn only_the_beaten_lose_their_star() {
        let flip = METRICS.iter().find(|m| m.name == "flip").expect("exists").id;
        let method = |ms: f64, error: f64| MethodResult {
            spec: "m".into(),
            outcome: Outcome::Scored {
                samples_per_pixel: 1.0,
                target_bytes: 0,
                scores: vec![Score { metric: flip.into(), value: Figure::Number(error) }],
                non_finite: None,
                timing: timing(&[vec![pass("draw", ms)]], "wall clock"),
            },
        };
        let mut methods = [method(1.0, 0.5), method(2.0, 0.1), method(3.0, 0.2), method(3.0, 0.05), method(2.5, 0.1)];
        mark_unbeaten(&mut methods);
        let stars: Vec<bool> =
            methods.iter().map(|m| matches!(&m.outcome, Outcome::Scored { timing, .. } if timing.unbeaten)).collect();
        assert_eq!(stars, [true, true, false, true, false]);
    }
}
