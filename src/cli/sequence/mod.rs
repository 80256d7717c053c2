//! `dejag sequence`: methods on frames in motion.

mod bars;
mod pictures;

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;

use self::bars::Bars;
use self::pictures::{PictureOptions, Pictures, Showing};
use super::shards::{ShardOptions, is_idle, is_own};
use super::watch::{Bar, check_interrupt};
use super::{Drawing, capture::load, output, parse_size};
use crate::bench::sequence::{Contestant, Course, Probe, SEQUENCE_REFERENCE, SequenceRequest, misses, run_sequence};
use crate::capture::Cache;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::picture::write_bytes_atomically;
use crate::report;
use crate::scene::Scene;
use crate::suite::{SEQUENCE_SCHEMA_VERSION, SequenceOutcome, SequenceResult, SequenceResults, Stamp};

/// Draw a sequence with methods and measure it: error, flicker, ghosts, thin lines, light
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag sequence pan -m none -m smaa
  dejag sequence wires --pan 0.37 --frames 0..32 -m none -m smaa --json wires.json
  dejag sequence courtyard --hold 0 --frames 0..64 -m ssaa:spp=4
  dejag sequence wheel --shutter 0.5 --cut 20 --drop 31 --probe none -m none
  dejag sequence fence -m none -m smaa --frames 0..32 --out frames --apng fence.png
  dejag sequence pan -m smaa --min-psnr 33 --max-ghost 0.004
  dejag sequence pan -m smaa -m taa --report report

Each frame is held against the same frame supersampled; with --shutter that integrates over time as well. Motion is exact and \
un-jittered. Pictures are measured as displayed, not rounded to 8 bits. On two cores without a GPU a reference frame of 640x360 takes \
about a second; references are kept in the cache (`dejag cache`), so an interrupted run goes on where it was.")]
pub(super) struct Sequence {
    /// A shipped scene, a scene file, or a model
    scene: String,
    /// A method with its options; give it again for more
    #[arg(short, long = "method", value_name = "METHOD", required = true)]
    methods: Vec<String>,
    /// Which frames, B left out; may go beyond the scene's own [default: all of the scene's; 64 of a scene that stands still]
    #[arg(long, value_name = "A..B", value_parser = parse_frames, allow_hyphen_values = true)]
    frames: Option<Range<i64>>,
    /// Forget at frame N all that came before; give it again for more
    #[arg(long = "cut", value_name = "N", allow_hyphen_values = true)]
    cuts: Vec<i64>,
    /// Do not draw frame N: the next one moves on from the one before it; give it again for more
    #[arg(long = "drop", value_name = "N", allow_hyphen_values = true)]
    dropped: Vec<i64>,
    /// Seconds between frames; 0 lets time stand still [default: the scene's]
    #[arg(long, value_name = "SECONDS")]
    step: Option<f64>,
    /// The scene stands still as it is at its frame N
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    hold: Option<i64>,
    /// Move the whole picture by so many pixels a frame, right and down
    #[arg(long, value_name = "X[,Y]", value_parser = parse_pan, allow_hyphen_values = true)]
    pan: Option<[f64; 2]>,
    /// Share of a frame's interval that the reference's shutter is open for, 0 to 1 [default: the reference's own]
    #[arg(long, value_name = "S")]
    shutter: Option<f64>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = parse_size)]
    size: [u32; 2],
    /// What each frame is held against
    #[arg(long, value_name = "METHOD", default_value = SEQUENCE_REFERENCE)]
    reference: String,
    /// Short runs of their own beside the sequence: crawl, convergence, response, sharpness, position, with commas between; all or none
    #[arg(long, value_name = "LIST", default_value = "all", value_parser = parse_probes)]
    probe: Probes,
    /// Write the results as JSON; - for stdout, instead of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    shards: ShardOptions,
    /// Draw every reference anew and keep none
    #[arg(long)]
    no_cache: bool,
    #[command(flatten)]
    pictures: PictureOptions,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    bars: Bars,
}

impl Sequence {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let all = self.specs()?;
        let names: Vec<String> = all.iter().map(ToString::to_string).collect();
        let shard = self.shards.deal::<SequenceResults>(&names.iter().map(String::as_str).collect::<Vec<_>>())?;
        let specs: Vec<&Spec> =
            all.iter().zip(&names).filter(|(_, name)| is_own(shard.as_ref(), name)).map(|(spec, _)| spec).collect();
        let json = self.json.as_deref().filter(|path| *path != Path::new("-"));
        if let Some(json) = json {
            output::check_folder_of(json)?;
        }
        let scene = load(&self.scene, self.drawing.quiet)?;
        let request = self.request(&scene)?;
        let frames = request.course.timeline(&scene)?.moments().len();
        let methods: Vec<String> = specs.iter().map(ToString::to_string).collect();
        let methods: Vec<&str> = methods.iter().map(String::as_str).collect();
        let frame_s = self.step.filter(|step| *step > 0.0).unwrap_or(scene.time_step);
        let mut pictures = self.pictures.begin(&Showing { methods: &methods, size: self.size, frames, frame_s })?;
        let gpu = self.drawing.open()?;
        gpu.check_size(self.size)?;
        let command = self.command(&request, &all);
        let result = self.measure(&gpu, &scene, &request, &specs, &mut pictures)?;
        let stamp = Stamp::from(&gpu.card);
        let results = SequenceResults { schema_version: SEQUENCE_SCHEMA_VERSION, stamp, command, shard, result };
        pictures.finish(&results)?;
        if let Some(path) = json {
            write_bytes_atomically(path, report::json(&results).as_bytes())?;
        }
        self.show(&results)?;
        let measured = results.result.methods.iter().any(|m| matches!(m.outcome, SequenceOutcome::Measured(_)));
        if !measured && !is_idle(results.shard.as_ref()) {
            let card = &gpu.card.name;
            output::say(&format!(
                "error: nothing was measured: none of the methods runs on {card}; the results say why, `dejag doctor` what it has"
            ));
            return Ok(ExitCode::from(4));
        }
        let misses = misses(&results.result.methods, &self.bars.over(scene.thresholds));
        for miss in &misses {
            output::say(&format!("missed: {miss}"));
        }
        Ok(if misses.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }

    fn specs(&self) -> Result<Vec<Spec>, Error> {
        for (i, method) in self.methods.iter().enumerate() {
            if self.methods[..i].contains(method) {
                return Err(Error::Request(format!("method {method} is given twice; give it once")));
            }
        }
        self.methods.iter().map(|text| Spec::parse(text)).collect()
    }

    fn request(&self, scene: &Scene) -> Result<SequenceRequest, Error> {
        let whole = Course::of(scene);
        let course = Course {
            frames: self.frames.clone().unwrap_or(whole.frames),
            cuts: self.cuts.iter().copied().collect::<BTreeSet<_>>(),
            dropped: self.dropped.iter().copied().collect(),
            step_s: self.step,
            hold: self.hold,
            pan_px: self.pan.unwrap_or_default(),
        };
        course.timeline(scene)?;
        let reference = Spec::parse(&self.reference_text()).map_err(|error| match error {
            Error::Request(why) => Error::Request(format!("--reference: {why}")),
            other => other,
        })?;
        Ok(SequenceRequest { course, size: self.size, reference, probes: self.probe.0.clone() })
    }

    /// The reference with its shutter.
    fn reference_text(&self) -> String {
        let reference = self.reference.trim();
        match self.shutter {
            None => reference.to_owned(),
            Some(share) if reference.contains(':') => format!("{reference},shutter={share}"),
            Some(share) => format!("{reference}:shutter={share}"),
        }
    }

    fn measure(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        request: &SequenceRequest,
        specs: &[&Spec],
        pictures: &mut Pictures,
    ) -> anyhow::Result<SequenceResult> {
        let cache = if self.no_cache { Cache::none() } else { Cache::of_user() };
        if let (true, Some(folder)) = (self.drawing.verbose, cache.folder()) {
            output::say(&format!("cache: {}", folder.display()));
        }
        let contestants: Vec<Contestant<'_>> = specs.iter().map(|spec| Contestant::of(spec)).collect();
        let mut bar = Bar::new(request.work(scene, &contestants)?, self.drawing.quiet);
        let result = run_sequence(gpu, scene, request, &contestants, &cache, &mut bar, pictures)?;
        check_interrupt()?;
        if let Some(why) = cache.failure().filter(|_| !self.drawing.quiet) {
            bar.aside(&format!(
                "warning: references are not kept, so the next run draws them anew: {why}; set DEJAG_CACHE_DIR to a folder that can \
                 be written, or give --no-cache"
            ));
        }
        bar.finish();
        Ok(result)
    }

    /// The command line that makes this run again, defaults written out.
    fn command(&self, request: &SequenceRequest, specs: &[Spec]) -> Vec<String> {
        let [width, height] = self.size;
        let Course { frames, cuts, dropped, step_s, hold, pan_px } = &request.course;
        let mut words = vec!["sequence".to_owned(), self.scene.clone()];
        let mut give = |name: &str, value: String| words.extend([name.to_owned(), value]);
        specs.iter().for_each(|spec| give("-m", spec.to_string()));
        give("--frames", format!("{}..{}", frames.start, frames.end));
        cuts.iter().for_each(|index| give("--cut", index.to_string()));
        dropped.iter().for_each(|index| give("--drop", index.to_string()));
        step_s.iter().for_each(|step| give("--step", step.to_string()));
        hold.iter().for_each(|frame| give("--hold", frame.to_string()));
        if *pan_px != [0.0; 2] {
            give("--pan", format!("{},{}", pan_px[0], pan_px[1]));
        }
        give("--size", format!("{width}x{height}"));
        give("--reference", request.reference.to_string());
        give("--probe", probe_list(&request.probes));
        give("--adapter", self.drawing.adapter.to_string());
        words
    }

    fn show(&self, results: &SequenceResults) -> anyhow::Result<()> {
        if self.json.as_deref() == Some(Path::new("-")) {
            return output::print(&report::json(results));
        }
        output::print(&report::sequence_table(results, output::is_colored()))
    }
}

/// Which probes are run.
#[derive(Debug, Clone)]
struct Probes(BTreeSet<Probe>);

/// Reads `all`, `none`, or probes with commas between.
fn parse_probes(text: &str) -> Result<Probes, Error> {
    match text.trim() {
        "all" => Ok(Probes(Probe::ALL.into())),
        "none" => Ok(Probes(BTreeSet::new())),
        list => list.split(',').map(|name| name.trim().parse()).collect::<Result<_, _>>().map(Probes),
    }
}

/// As [`parse_probes`] reads them.
fn probe_list(probes: &BTreeSet<Probe>) -> String {
    let names: Vec<&str> = probes.iter().map(|probe| probe.name()).collect();
    if names.is_empty() { "none".into() } else { names.join(",") }
}

/// Reads `A..B`.
fn parse_frames(text: &str) -> Result<Range<i64>, String> {
    let hint = || format!("'{text}' are no frames; write A..B, such as 0..64, B left out");
    let (start, end) = text.split_once("..").ok_or_else(hint)?;
    let index = |text: &str| text.trim().parse::<i64>().map_err(|_| hint());
    Ok(index(start)?..index(end)?)
}

/// Reads `X` or `X,Y`.
fn parse_pan(text: &str) -> Result<[f64; 2], String> {
    let hint = || format!("'{text}' is no pan; write X or X,Y in pixels a frame, such as 0.37");
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(hint);
    match text.split_once(',') {
        Some((x, y)) => Ok([number(x)?, number(y)?]),
        None => Ok([number(text)?, 0.0]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_and_pans() {
        assert_eq!(parse_frames("-3..64"), Ok(-3..64));
        assert_eq!(parse_pan("-0.37"), Ok([-0.37, 0.0]));
        assert_eq!(parse_pan("1, 2.5"), Ok([1.0, 2.5]));
        for bad in ["5", "a..b", "..", "1..", "1...2"] {
            assert!(parse_frames(bad).is_err(), "{bad}");
        }
        for bad in ["", "nan", "1,inf", "1,2,3", "x"] {
            assert!(parse_pan(bad).is_err(), "{bad}");
        }
    }
}
