//! Adaptive supersampling: a few probes everywhere, more samples only where they disagree or an edge passes.
//!
//! Probes miss what is thin: a wire of a tenth of a pixel is in none of four probes two times of three. So the first probe asks its
//! host for an outline too, in which silhouettes, borders and creases mark every pixel they touch. Pixels of the outline get all
//! `max` samples; those whose probes disagree (and their neighbours) get four times as many with each round, until a round's mean
//! tells nothing new. Rounds are drawn under a mask, so settled pixels are not shaded; every sample taken counts.
//!
//! Where it is wrong: what is no geometry (a texture, a highlight) and missed by all probes of a pixel and of its neighbours is never
//! refined. And stopping on what was seen is biased: a pixel whose first samples happen to agree keeps them. `independent=on` decides
//! by probes that do not count, once, and takes what counts from other samples: unbiased, for more samples.
//!
//! All that is `scheme=flat`; `scheme=whitted` halves squares instead, see [`whitted`].
//!
//! Source: Whitted 1980, An Improved Illumination Model; Mitchell 1987, Generating Antialiased Images at Low Sampling Densities;
//! Sander et al. 2001, Discontinuity Edge Overdraw, for the outline.
//! Cost: the probes' draws, the outline, a masked draw a further sample, six full-screen passes.

mod flat;
mod frame;
mod samples;
mod targets;
mod whitted;

use crate::error::{Error, Result};
use crate::pass::{Context, Extras, Jitter, Kind, Method, Needs, OptionSpec, Options, Pass, Technique};
use crate::sampling::{jitter_cycle, pattern, pattern_names};

const SCHEMES: [&str; 2] = ["flat", "whitted"];

const CRITERIA: [&str; 7] = ["color", "gradient", "variance", "depth", "ids", "signature", "all"];

pub(super) const METHOD: Method = Method {
    name: "adaptive",
    summary: "supersampling where geometry has edges or a few probes disagree",
    source: "Whitted 1980; Mitchell 1987",
    options: &[
        OptionSpec {
            name: "scheme",
            help: "flat: rounds of samples all over a pixel; whitted: its corners and centre, again in quadrants that differ (threshold alone)",
            kind: Kind::Choice(|| SCHEMES.to_vec()),
            default: "flat",
        },
        OptionSpec {
            name: "probe",
            help: "samples that every pixel gets",
            kind: Kind::Integer { min: 1, max: 16 },
            default: "4",
        },
        OptionSpec {
            name: "max",
            help: "samples that a pixel gets at most",
            kind: Kind::Integer { min: 1, max: 1024 },
            default: "64",
        },
        OptionSpec {
            name: "criterion",
            help: "what the probes must agree on: colour, its slope, its standard error, depth, object ids, all of these; signature: material and side of the light, whatever the texture",
            kind: Kind::Choice(|| CRITERIA.to_vec()),
            default: "color",
        },
        OptionSpec {
            name: "threshold",
            help: "how far apart they may be, in roots of exposed linear colour from 0 to 1",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0.02",
        },
        OptionSpec {
            name: "dilate",
            help: "pixels to each side of one in doubt that are refined with it",
            kind: Kind::Integer { min: 0, max: 8 },
            default: "1",
        },
        OptionSpec { name: "pattern", help: "where the samples lie", kind: Kind::Choice(pattern_names), default: "sobol-owen" },
        OptionSpec {
            name: "seed",
            help: "of the patterns that use chance",
            kind: Kind::Integer { min: 0, max: u32::MAX },
            default: "0",
        },
        OptionSpec {
            name: "independent",
            help: "whether the probes only decide, once, and do not count: unbiased",
            kind: Kind::Choice(|| vec!["off", "on"]),
            default: "off",
        },
        OptionSpec {
            name: "outline",
            help: "whether edges of the geometry are refined wherever they pass, seen by a probe or not",
            kind: Kind::Choice(|| vec!["on", "off"]),
            default: "on",
        },
    ],
    configure: |options| match options.word("scheme") {
        "whitted" => Ok(Box::new(whitted::Recursive::new(options)?)),
        _ => Ok(Box::new(Adaptive::new(options)?)),
    },
    shaders: &[
        flat::KEEP,
        flat::DETECT,
        flat::SPREAD,
        flat::SETTLE,
        frame::SHOW,
        whitted::REFINE,
        whitted::GATHER,
        whitted::MEAN,
    ],
    layouts: &[frame::AdaptiveFrame::LAYOUT],
};

/// What the probes must agree on.
#[derive(Debug, Clone, Copy)]
struct Criteria {
    color: bool,
    gradient: bool,
    variance: bool,
    depth: bool,
    ids: bool,
    /// Instead of all others.
    signature: bool,
}

impl Criteria {
    fn of(name: &str) -> Self {
        let has = |own| name == own || name == "all";
        Self {
            color: has("color"),
            gradient: has("gradient"),
            variance: has("variance"),
            depth: has("depth"),
            ids: has("ids"),
            signature: name == "signature",
        }
    }

    fn extras(self) -> Extras {
        let wanted = self.reads_surfaces();
        Extras { depth: wanted, ids: wanted && !self.signature, signature: self.signature, motion: false }
    }

    fn reads_surfaces(self) -> bool {
        self.depth || self.ids || self.signature
    }
}

#[derive(Debug)]
struct Adaptive {
    probes: Vec<Jitter>,
    /// In the order in which pixels in doubt get them. The probes come first, if they count.
    samples: Vec<Jitter>,
    criteria: Criteria,
    threshold: f64,
    dilate: u32,
    independent: bool,
    outline: bool,
}

impl Adaptive {
    fn new(options: &Options) -> Result<Self> {
        let (probe, max) = (options.integer("probe"), options.integer("max"));
        if max < probe {
            return Err(Error::Request(format!("adaptive: max={max} is less than probe={probe}; every pixel gets the probes")));
        }
        let (pattern, seed) = (pattern(options.word("pattern"))?, options.integer("seed"));
        let independent = options.word("independent") == "on";
        let jitters = |count, seed| {
            let cycle = jitter_cycle(pattern, count, seed);
            cycle.into_iter().map(|p| Jitter { offset_px: p.map(|x| x as f32), weight: 1.0 }).collect::<Vec<_>>()
        };
        let samples = jitters(max, seed);
        let probes = if independent { jitters(probe, seed.wrapping_add(1)) } else { samples[..probe as usize].to_vec() };
        Ok(Self {
            probes,
            samples,
            criteria: Criteria::of(options.word("criterion")),
            threshold: options.number("threshold").unwrap_or_default(),
            dilate: options.integer("dilate"),
            independent,
            outline: options.word("outline") == "on",
        })
    }
}

impl Technique for Adaptive {
    fn needs(&self) -> Needs {
        let beside = if self.independent { self.probes.len() } else { 0 };
        Needs {
            wide_output: true,
            features: wgpu::Features::FLOAT32_BLENDABLE,
            extras: self.criteria.extras(),
            samples_per_pixel: (self.samples.len() + beside) as u32,
            ..Needs::default()
        }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        Ok(Box::new(flat::Flat::new(context, self)))
    }
}
