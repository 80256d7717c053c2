//! Our temporal methods beside what others ship: `cargo bench --bench temporal [-- --only SCENE ... --size 320x180 --frames 32]`.
//!
//! `--cost 1920x1080` times the passes instead.
//!
//! The same sequences for everyone, held against the same supersampled frames. What bevy does is run as a pass of this bench's own
//! (`bevy.rs`), because no registry of ours has it.

#![expect(clippy::print_stdout, reason = "its tables are its output")]

mod bevy;
mod cost;
mod options;

use std::collections::BTreeSet;

use dejag::bench::Progress;
use dejag::bench::sequence::{Contestant, Course, SequenceRequest, run_sequence};
use dejag::capture::{Cache, Watch};
use dejag::gpu::{AdapterChoice, Gpu};
use dejag::methods::Spec;
use dejag::metrics::Figure;
use dejag::pass::Technique;
use dejag::scene::Scene;
use dejag::suite::{SequenceFigures, SequenceOutcome};

use options::Options;

const METHODS: [&str; 5] = ["none", "smaa", "taa:preset=fast", "taa:preset=balanced", "taa:preset=quality"];

/// Columns: a heading, the measure's id, and what to multiply it by.
const COLUMNS: [(&str, &str, f64); 6] = [
    ("PSNR dB", "sequence-psnr/1", 1.0),
    ("FLIP", "sequence-flip/1.7@67.0206", 1.0),
    ("flicker/255", "flicker-1/1", 255.0),
    ("ghost/255", "ghost-4-to-8/1", 255.0),
    ("continuity", "continuity/1", 1.0),
    ("energy", "sequence-energy/1", 1.0),
];

/// Counts of frames after a cut at which a still scene is looked at.
const AFTER_CUT: [usize; 3] = [8, 32, 64];

/// A scene and how it moves.
struct Run {
    scene: &'static str,
    pan_px: f64,
    still: bool,
}

const RUNS: [Run; 8] = [
    Run { scene: "wires", pan_px: 0.37, still: false },
    Run { scene: "fence", pan_px: 0.37, still: false },
    Run { scene: "pan", pan_px: 0.0, still: false },
    Run { scene: "stars", pan_px: 0.0, still: false },
    Run { scene: "foliage", pan_px: 0.0, still: false },
    Run { scene: "wheel", pan_px: 0.0, still: false },
    Run { scene: "edges", pan_px: 0.0, still: true },
    Run { scene: "courtyard", pan_px: 0.0, still: true },
];

/// Nobody watches.
struct Quiet;

impl Watch for Quiet {
    fn tick(&mut self, _: u32, _: u32) -> dejag::Result<()> {
        Ok(())
    }
}

impl Progress for Quiet {
    fn say(&mut self, _: String) {}
    fn advance(&mut self, _: u64) {}
}

fn main() -> dejag::Result<()> {
    let Some(options) = Options::read(std::env::args().skip(1)) else { return Ok(()) };
    let choice = std::env::var("DEJAG_ADAPTER").map_or(AdapterChoice::Auto, |name| name.parse().expect("infallible"));
    let gpu = Gpu::open(&choice)?;
    println!("{}, {}x{}", gpu.card, options.size[0], options.size[1]);
    if options.cost {
        return costs(&gpu, &options);
    }
    for run in RUNS.iter().filter(|run| options.only.is_empty() || options.only.iter().any(|name| name == run.scene)) {
        table(&gpu, run, &options)?;
    }
    Ok(())
}

fn costs(gpu: &Gpu, options: &Options) -> dejag::Result<()> {
    let texts = METHODS.iter().filter(|text| text.starts_with("taa")).chain(&["smaa:mode=t2x"]);
    let specs = texts.map(|text| Ok((*text, Spec::parse(text)?))).collect::<dejag::Result<Vec<_>>>()?;
    let mut lanes: Vec<(&str, &dyn Technique)> = vec![("copy", &cost::Copy), ("bevy 0.20.1", &bevy::BevyTaa)];
    lanes.extend(specs.iter().map(|(text, spec)| (*text, &*spec.stages[0].technique)));
    cost::table(gpu, options.size, options.frames as u32, &lanes)
}

fn course(run: &Run, frames: i64) -> Course {
    match run.still {
        true => Course::still(0, frames),
        false => Course { frames: 0..frames, pan_px: [run.pan_px, 0.0], ..Course::default() },
    }
}

fn table(gpu: &Gpu, run: &Run, options: &Options) -> dejag::Result<()> {
    let scene = Scene::load(run.scene)?;
    let frames = if run.still { (2 * options.frames).max(AFTER_CUT[2] as i64) } else { options.frames };
    let reference = Spec::parse(&format!("ssaa:spp={},pattern=larcher", options.spp))?;
    let request = SequenceRequest { course: course(run, frames), size: options.size, reference, probes: BTreeSet::new() };
    let specs = METHODS.iter().map(|text| Spec::parse(text)).collect::<dejag::Result<Vec<_>>>()?;
    let mut contestants: Vec<_> = specs.iter().map(Contestant::of).collect();
    // After the filters, before ours.
    contestants.insert(2, Contestant { label: "bevy 0.20.1".into(), techniques: vec![("bevy", &bevy::BevyTaa)] });
    let found = run_sequence(gpu, &scene, &request, &contestants, &Cache::of_user(), &mut Quiet, &mut ())?;

    let pan = if run.pan_px == 0.0 { String::new() } else { format!(", panned by {} px a frame", run.pan_px) };
    println!("\n{}{}{pan}, {frames} frames", run.scene, if run.still { ", still" } else { "" });
    print!("{:<22}", "");
    COLUMNS.iter().for_each(|(heading, ..)| print!("{heading:>12}"));
    AFTER_CUT.iter().filter(|_| run.still).for_each(|count| print!("{:>12}", format!("dB after {count}")));
    println!();
    for method in &found.methods {
        match &method.outcome {
            SequenceOutcome::Measured(figures) => println!("{:<22}{}", method.spec, row(figures, run.still)),
            SequenceOutcome::Failed { error } => println!("{:<22}{error}", method.spec),
        }
    }
    Ok(())
}

fn row(figures: &SequenceFigures, still: bool) -> String {
    let overall = |(_, id, factor): &(&str, &str, f64)| cell(figures.figure(id).map(|figure| figure.overall), *factor);
    let mut text: String = COLUMNS.iter().map(overall).collect();
    let errors = figures.figure(COLUMNS[0].1).map_or(&[][..], |figure| &figure.frames);
    text.extend(AFTER_CUT.iter().filter(|_| still).map(|count| cell(errors.get(count - 1).copied(), 1.0)));
    text
}

fn cell(figure: Option<Figure>, factor: f64) -> String {
    figure.and_then(Figure::number).map_or_else(|| format!("{:>12}", "-"), |number| format!("{:>12.4}", factor * number))
}
