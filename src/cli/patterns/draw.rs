//! `dejag patterns draw`: point sets as pictures.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};

use super::choice::{Choice, all};
use super::output::PictureKind;
use super::{Sets, SharedBar, density};
use crate::error::{Error, Result};
use crate::report::{Panel, Panels};
use crate::sampling::{Density, Domain, MAX_SET_POINTS, PatternSpec, Progress, Request};

/// Of a dot, in sides of a point's share of the square.
pub(super) const DOT_RADIUS: f64 = 0.2;

/// Of the dots of a few points, in sides of the square.
const LARGEST_DOT: f64 = 0.02;

/// Of a set's progress on the bar.
const PARTS: u32 = 1000;

/// Draw point sets
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  dejag patterns draw -o all.svg -n 256
  dejag patterns draw lloyd --generation 1,2,3,10,30,90 -o lloyd.png
  dejag patterns draw mitchell --prefix 10,40,160,640,2560 -o mitchell.svg
  dejag patterns draw lloyd -n 8192 --density photo.png --size 1024 -o stippled.png
  dejag patterns draw hammersley --domain disk -o lens.svg

y points down. With --density the photo keeps its proportions in the middle of the square, and dots lie where it is dark; its \
brightness is met in linear light. Without a pattern, --density, --generation and --prefix draw lloyd, lloyd and mitchell.")]
pub(super) struct Draw {
    #[command(flatten)]
    choice: Choice,
    #[command(flatten)]
    sets: Sets,
    /// Where to write: a .png or .svg file
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Of each panel, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=8192))]
    size: u32,
    /// A panel for each of these generations, of patterns that have generations
    #[arg(long, value_name = "LIST", value_delimiter = ',', conflicts_with = "prefix", value_parser = clap::value_parser!(u32).range(1..))]
    generation: Vec<u32>,
    /// A panel for the first so many points of one set, of patterns any prefix of which can be used
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SET_POINTS)))]
    prefix: Vec<u32>,
    /// A photo: points lie as densely as it is dark
    #[arg(long, value_name = "FILE")]
    density: Option<PathBuf>,
    /// Where points lie
    #[arg(long, value_enum, default_value_t)]
    domain: Where,
    /// No progress, only results and errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Where {
    #[default]
    Square,
    Disk,
}

/// One set with its title.
struct Wanted {
    spec: PatternSpec,
    n: u32,
    title: String,
}

impl Draw {
    pub(super) fn run(&self) -> anyhow::Result<ExitCode> {
        let kind = PictureKind::check(&self.output)?;
        let specs = self.choice.specs(|| self.default_patterns())?;
        let density = self.density.as_deref().map(density::of_photo).transpose()?;
        let wanted = self.wanted(&specs)?;
        let bar = SharedBar::new(u64::from(PARTS) * wanted.len() as u64, self.quiet, "points");
        let panels: Vec<Panel> =
            wanted.into_iter().map(|wanted| self.panels(wanted, density.as_ref(), &bar)).collect::<Result<Vec<_>>>()?.concat();
        drop(bar);
        let panels = Panels { panels, side_px: self.size };
        kind.write(&self.output, || Some(panels.svg()), || panels.picture())?;
        Ok(ExitCode::SUCCESS)
    }

    fn default_patterns(&self) -> Vec<PatternSpec> {
        let only = |name: &str| all().into_iter().filter(|spec| spec.pattern().name == name).collect();
        match () {
            () if !self.prefix.is_empty() => only("mitchell"),
            () if !self.generation.is_empty() || self.density.is_some() => only("lloyd"),
            () => all(),
        }
    }

    /// A set for each panel, or for each row of prefixes.
    fn wanted(&self, specs: &[PatternSpec]) -> Result<Vec<Wanted>> {
        let mut wanted = Vec::new();
        for spec in specs {
            if let Some(most) = self.prefix.iter().copied().max() {
                let (spec, title) = (progressive(spec)?, String::new());
                wanted.push(Wanted { spec, n: most, title });
            } else if self.generation.is_empty() {
                let title = format!("{spec}, n = {}", self.sets.n);
                wanted.push(Wanted { spec: spec.clone(), n: self.sets.n, title });
            }
            for generation in &self.generation {
                let title = format!("{}, generation {generation}", spec.pattern().name);
                let spec = spec.clone().with("generations", f64::from(*generation))?;
                wanted.push(Wanted { spec, n: self.sets.n, title });
            }
        }
        Ok(wanted)
    }

    fn panels(&self, wanted: Wanted, density: Option<&Density>, bar: &SharedBar) -> Result<Vec<Panel>> {
        let domain = if self.domain == Where::Disk { Domain::Disk } else { Domain::Square };
        let hear = |share: f64| bar.reach((share * f64::from(PARTS)) as u32);
        let progress = Progress::new(&hear);
        let request = Request { domain, density, progress, ..Request::new(wanted.n, self.sets.seed) };
        let points = wanted.spec.generate(&request)?;
        bar.advance(u64::from(PARTS))?;
        let panel = |title: String, points: &[[f64; 2]]| Panel {
            title,
            ground: None,
            radius: (DOT_RADIUS / (points.len() as f64).sqrt()).min(LARGEST_DOT),
            points: points.to_vec(),
            round: domain == Domain::Disk,
        };
        if self.prefix.is_empty() {
            return Ok(vec![panel(wanted.title, &points)]);
        }
        Ok(self.prefix.iter().map(|&n| panel(format!("{}, n = {n}", wanted.spec), &points[..n as usize])).collect())
    }
}

/// The pattern, if a part of a set of it is of use by itself.
fn progressive(spec: &PatternSpec) -> Result<PatternSpec> {
    if spec.pattern().progressive {
        return Ok(spec.clone());
    }
    let others: Vec<&str> = all().iter().map(PatternSpec::pattern).filter(|p| p.progressive).map(|p| p.name).collect();
    let name = spec.pattern().name;
    Err(Error::Request(format!("--prefix: {name} is only even as a whole; take one of {}", others.join(", "))))
}
