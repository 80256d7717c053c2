//! `dejag score`: methods on scenes, speed against error.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context as _;
use clap::Args;

use super::shards::{ShardOptions, is_idle, is_own};
use super::watch::{Bar, check_interrupt};
use super::{Drawing, capture::load, output, parse_size};
use crate::bench::{
    DEMO_METHODS, DEMO_SCENES, Progress, REPEATS, ReferenceChoice, Request, SceneOutcome, edge_errors, score_scene,
};
use crate::capture::{Cache, REFERENCE_SPEC, analytic};
use crate::error::Error;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::picture::write_bytes_atomically;
use crate::report::{self, HtmlReport, MethodPictures};
use crate::scene::{SHIPPED, Scene};
use crate::suite::{Outcome, Results, SCHEMA_VERSION, ShardStamp, Stamp};

/// Capture scenes with methods, time them, and score them against a reference
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag score
  dejag score edges checker -m none -m ssaa:spp=16 -m ssaa:spp=16,pattern=rotated
  dejag score wires --reference analytic -m msaa -m msaa:resolve=gaussian
  dejag score all --size 320x180 --report report --json results.json
  dejag score all --shard 1/4 --report part-1

A star marks the methods that no other beats in time and error (mean FLIP). Against a reference under the box \
filter any other filter's softness counts as error: give --reference the same filter to compare within it. On two \
cores without a GPU a reference of 640x360 takes 2 to 40 seconds; it is kept in the \
cache (`dejag cache`), so an interrupted run goes on where it was.")]
pub(super) struct Score {
    /// Shipped scenes, scene files or models; `all` for every shipped scene [default: the demo set]
    scenes: Vec<String>,
    /// A method with its options; give it again for more [default: the demo set]
    #[arg(short, long = "method", value_name = "METHOD")]
    methods: Vec<String>,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = parse_size)]
    size: [u32; 2],
    /// Which frame, from 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    frame: u32,
    /// A method, or `analytic` for scenes that have an exact answer
    #[arg(long, value_name = "METHOD", default_value = REFERENCE_SPEC)]
    reference: String,
    /// How often each method is timed
    #[arg(long, value_name = "N", default_value_t = REPEATS, value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeats: u32,
    /// Write the results as JSON; - for stdout, instead of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write a report with pictures and plots into this folder
    #[arg(long, value_name = "DIR")]
    report: Option<PathBuf>,
    #[command(flatten)]
    shards: ShardOptions,
    /// Draw every reference anew and keep none
    #[arg(long)]
    no_cache: bool,
    #[command(flatten)]
    drawing: Drawing,
}

impl Score {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let request = self.request()?;
        let json = self.json.as_deref().filter(|path| *path != Path::new("-"));
        if let Some(json) = json {
            output::check_folder_of(json)?;
        }
        let names = self.names();
        let shard = self.shards.deal::<Results>(&names.iter().map(String::as_str).collect::<Vec<_>>())?;
        let own = names.iter().filter(|name| is_own(shard.as_ref(), name));
        let scenes: Vec<Scene> = own.map(|name| load(name, self.drawing.quiet)).collect::<Result<_, _>>()?;
        let mut report = self.report.as_deref().map(HtmlReport::begin).transpose()?;
        let gpu = self.drawing.open()?;
        gpu.check_size(self.size)?;
        self.check(&scenes, &request)?;
        let results = self.score(&gpu, &scenes, &request, shard, report.as_mut())?;

        if let Some(report) = report {
            report.finish(&results)?;
        }
        if let Some(path) = json {
            write_bytes_atomically(path, report::json(&results).as_bytes())?;
        }
        self.show(&results)?;
        if compared(&results) == 0 && !is_idle(results.shard.as_ref()) {
            let card = &gpu.card.name;
            output::say(&format!(
                "error: nothing was compared: none of the methods runs on {card}; the results say why, `dejag doctor` what it has"
            ));
            return Ok(ExitCode::from(4));
        }
        Ok(ExitCode::SUCCESS)
    }

    fn names(&self) -> Vec<String> {
        let shipped = || SHIPPED.iter().map(|s| s.name.to_owned());
        match &self.scenes[..] {
            [] => DEMO_SCENES.iter().map(|s| (*s).to_owned()).collect(),
            names => names.iter().flat_map(|n| if n == "all" { shipped().collect() } else { vec![n.clone()] }).collect(),
        }
    }

    fn request(&self) -> Result<Request, Error> {
        let methods: Vec<&str> =
            if self.methods.is_empty() { DEMO_METHODS.to_vec() } else { self.methods.iter().map(String::as_str).collect() };
        for (i, method) in methods.iter().enumerate() {
            if methods[..i].contains(method) {
                return Err(Error::Request(format!("method {method} is given twice; give it once")));
            }
        }
        Ok(Request {
            methods: methods.into_iter().map(Spec::parse).collect::<Result<_, _>>()?,
            size: self.size,
            frame: self.frame,
            reference: match self.reference.as_str() {
                "analytic" => ReferenceChoice::Analytic,
                spec => ReferenceChoice::Method(Spec::parse(spec).map_err(|error| match error {
                    Error::Request(why) => Error::Request(format!("--reference: {why}; `analytic` is a scene's exact answer")),
                    other => other,
                })?),
            },
            repeats: self.repeats,
        })
    }

    /// Finds out before the first scene is drawn what the last one lacks.
    fn check(&self, scenes: &[Scene], request: &Request) -> Result<(), Error> {
        for (i, scene) in scenes.iter().enumerate() {
            if scenes[..i].iter().any(|other| other.fingerprint == scene.fingerprint && other.name == scene.name) {
                return Err(Error::Request(format!("scene {} is given twice; give it once", scene.name)));
            }
            scene.frame(self.frame, self.size)?;
            // The first scene's answer is asked for next anyway.
            if matches!(request.reference, ReferenceChoice::Analytic) && i > 0 {
                analytic::exact(scene, self.frame, self.size)?;
            }
        }
        Ok(())
    }

    fn score(
        &self,
        gpu: &Gpu,
        scenes: &[Scene],
        request: &Request,
        shard: Option<ShardStamp>,
        mut report: Option<&mut HtmlReport>,
    ) -> anyhow::Result<Results> {
        let cache = if self.no_cache { Cache::none() } else { Cache::of_user() };
        if let (true, Some(folder)) = (self.drawing.verbose, cache.folder()) {
            output::say(&format!("cache: {}", folder.display()));
        }
        let mut bar = Bar::new(request.work() * scenes.len() as u64, self.drawing.quiet);
        let mut results = Results {
            schema_version: SCHEMA_VERSION,
            stamp: Stamp::from(&gpu.card),
            command: self.command(request),
            size: request.size,
            shard,
            scenes: Vec::new(),
            edges: None,
        };
        let mut warn = !self.drawing.quiet;
        for scene in scenes {
            let outcome = score_scene(gpu, scene, request, &cache, &mut bar)?;
            check_interrupt()?;
            if let Some(why) = cache.failure().filter(|_| std::mem::take(&mut warn)) {
                bar.aside(&format!(
                    "warning: references are not kept, so the next run draws them anew: {why}; set DEJAG_CACHE_DIR to a folder \
                     that can be written, or give --no-cache"
                ));
            }
            if let Some(report) = &mut report {
                add_pictures(report, &outcome)?;
            }
            results.scenes.push(outcome.result);
        }
        // They belong to no scene: the first part has them.
        if results.shard.as_ref().is_none_or(|shard| shard.index == 1) {
            bar.say("straight edges".into());
            results.edges = edge_errors(gpu, &request.methods, &mut bar)?;
        }
        bar.finish();
        Ok(results)
    }

    /// The command line that makes this run again, defaults written out.
    fn command(&self, request: &Request) -> Vec<String> {
        let [width, height] = self.size;
        let mut words = vec!["score".to_owned()];
        words.extend(self.names());
        words.extend(request.methods.iter().flat_map(|m| ["-m".to_owned(), m.to_string()]));
        words.extend(["--size".into(), format!("{width}x{height}"), "--frame".into(), self.frame.to_string()]);
        words.extend(["--repeats".into(), self.repeats.to_string()]);
        words.extend(["--reference".into(), self.reference.clone(), "--adapter".into(), self.drawing.adapter.to_string()]);
        words
    }

    fn show(&self, results: &Results) -> anyhow::Result<()> {
        if self.json.as_deref() == Some(Path::new("-")) {
            output::print(&report::json(results))?;
        } else {
            output::print(&report::table(results, output::is_colored()))?;
        }
        if let (Some(folder), false) = (&self.report, self.drawing.quiet) {
            let page = std::path::absolute(folder.join("index.html")).context("finding the report")?;
            output::say(&format!("report: {}", page.display()));
        }
        Ok(())
    }
}

fn compared(results: &Results) -> usize {
    let methods = results.scenes.iter().flat_map(|scene| &scene.methods);
    methods.filter(|m| matches!(m.outcome, Outcome::Scored { .. })).count()
}

fn add_pictures(report: &mut HtmlReport, outcome: &SceneOutcome) -> Result<(), Error> {
    report.add_scene(&outcome.result.name, &outcome.reference)?;
    for (method, pictures) in outcome.result.methods.iter().zip(&outcome.pictures) {
        if let Some(pictures) = pictures {
            let files = MethodPictures { capture: &pictures.capture, error_map: Some(&pictures.error_map) };
            report.add_method(&method.spec, files)?;
        }
    }
    Ok(())
}

impl Progress for Bar {
    fn say(&mut self, what: String) {
        Self::say(self, what);
    }

    fn advance(&mut self, samples: u64) {
        Self::advance(self, samples);
    }
}
