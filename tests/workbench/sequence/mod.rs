//! Methods on frames in motion: what the measures say of sequences that are known to be right or wrong, and what no sequence may do.

mod any_sequence;
mod laggard;
mod measures;
mod probes;
mod truth;

use std::collections::BTreeSet;

use dejag::bench::sequence::{Contestant, Course, FramePicture, FrameSink, Probe, SequenceRequest, run_sequence};
use dejag::capture::Cache;
use dejag::gpu::Gpu;
use dejag::methods::{METHODS, Spec};
use dejag::metrics::Figure;
use dejag::metrics::temporal::MEASURES;
use dejag::picture::DisplayPicture;
use dejag::scene::Scene;
use dejag::suite::{SequenceFigures, SequenceMethod, SequenceOutcome, SequenceResult};

/// Every method as it is without options.
fn methods() -> Vec<Spec> {
    METHODS.iter().map(|method| Spec::parse(method.name).expect(method.name)).collect()
}

fn spec(text: &str) -> Spec {
    Spec::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn scene(name: &str) -> Scene {
    Scene::load(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A small request without probes.
fn request(course: Course, size: [u32; 2], reference: &str) -> SequenceRequest {
    SequenceRequest { course, size, reference: spec(reference), probes: BTreeSet::new() }
}

fn with_probes(mut request: SequenceRequest, probes: &[Probe]) -> SequenceRequest {
    request.probes = probes.iter().copied().collect();
    request
}

fn run(gpu: &Gpu, scene: &Scene, request: &SequenceRequest, contestants: &[Contestant<'_>]) -> SequenceResult {
    run_sequence(gpu, scene, request, contestants, &Cache::none(), &mut (), &mut ()).expect("runs")
}

fn run_specs(gpu: &Gpu, scene: &Scene, request: &SequenceRequest, specs: &[Spec]) -> SequenceResult {
    run(gpu, scene, request, &specs.iter().map(Contestant::of).collect::<Vec<_>>())
}

fn figures(method: &SequenceMethod) -> &SequenceFigures {
    match &method.outcome {
        SequenceOutcome::Measured(figures) => figures,
        SequenceOutcome::Failed { error } => panic!("{}: {error}", method.spec),
    }
}

/// A measure over all frames, by its short name.
fn overall(method: &SequenceMethod, name: &str) -> Figure {
    let id = MEASURES.iter().find(|measure| measure.name == name).unwrap_or_else(|| panic!("no measure {name}")).id;
    figures(method).figure(id).unwrap_or_else(|| panic!("no figure of {name}")).overall
}

fn number(method: &SequenceMethod, name: &str) -> f64 {
    overall(method, name).number().unwrap_or_else(|| panic!("{}: {name} is no number", method.spec))
}

/// Keeps every picture of every method, and of the reference.
#[derive(Debug, Default)]
struct Keep {
    methods: Vec<(usize, i64, DisplayPicture)>,
    references: Vec<DisplayPicture>,
}

impl Keep {
    /// A method's picture of a frame.
    fn picture(&self, method: usize, index: i64) -> &DisplayPicture {
        let found = self.methods.iter().find(|(m, i, _)| (*m, *i) == (method, index));
        &found.unwrap_or_else(|| panic!("method {method} has no frame {index}")).2
    }
}

impl FrameSink for Keep {
    fn method(&mut self, frame: &FramePicture<'_>) -> dejag::Result<()> {
        self.methods.push((frame.method, frame.moment.tick.index, frame.display.clone()));
        Ok(())
    }

    fn reference(&mut self, frame: &FramePicture<'_>) -> dejag::Result<()> {
        self.references.push(frame.display.clone());
        Ok(())
    }
}
