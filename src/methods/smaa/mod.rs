//! SMAA: edges, the lines and staircases that they form, and each pixel blended by what those cut off it.
//!
//! After Jimenez, Echevarria, Sousa, Gutierrez 2012, "SMAA: Enhanced Subpixel Morphological Antialiasing": edges by luma, colour,
//! depth or object with local contrast adaptation and predicated thresholds, searches along lines and diagonals, corner rounding.
//! The modes beyond 1x, which filter pictures sampled at several places of each pixel, stand in [`modes`] and [`history`].
//!
//! What differs. Edges are bits and searches look at sixteen at a time, so there is no search table, and searches reach equally
//! far both ways (published: 2n - 1 pixels to the left and up, 2n to the right and down). Areas are exact at every distance instead
//! of compressed to 16 steps, and in 16 bits. Nothing beyond the picture's border is repeated. Colours are mixed in linear light
//! unless told otherwise.
//!
//! As published, it is not symmetric in three places: contrast adaptation looks beyond an edge on one side only, staircases are
//! looked for from edges above pixels only, and where both axes weigh the same it is blended up and down. On a star of spokes that
//! shows in 1.2% of the pixels, on white noise in 41% (`tests/workbench/filters/symmetry`).
//!
//! Cost: two passes over all pixels (edges, output), three more over those near an edge.

mod history;
mod modes;

use crate::pass::{Kind, Method, OptionSpec, Options};
use crate::shader::Source;

use super::morphology::{Blend, BlendSides, EdgeRule, Geometry, LINE_MODULES, LineRules, Predication};
use modes::{Mode, Several};

const MODULES: [Source; 17] = {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = LINE_MODULES;
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, history::AVERAGE, history::RESOLVE]
};

pub(super) const METHOD: Method = Method {
    name: "smaa",
    summary: "morphological: edges as lines, staircases and corners, blended by exact areas (SMAA 1x, S2x, T2x, 4x)",
    source: "Jimenez et al. 2012, SMAA: Enhanced Subpixel Morphological Antialiasing",
    options: &[
        OptionSpec {
            name: "preset",
            help: "what auto means below: threshold .15 .1 .1 .05, search 4 8 16 32, diag 0 0 8 16, corner 100 100 25 25",
            kind: Kind::Choice(|| Preset::ALL.iter().map(|p| p.name).collect()),
            default: "high",
        },
        EdgeRule::OPTION,
        OptionSpec {
            name: "threshold",
            help: "least step of luma or colour; lower finds fainter edges",
            kind: Kind::NumberOrAuto { min: 0.0, max: 0.5 },
            default: "auto",
        },
        OptionSpec {
            name: "search",
            help: "steps of two pixels along a line, each way; higher smooths longer lines",
            kind: Kind::IntegerOrAuto { min: 1, max: 112 },
            default: "auto",
        },
        OptionSpec {
            name: "diag",
            help: "pixels along a diagonal, each way; 0 looks for none",
            kind: Kind::IntegerOrAuto { min: 0, max: 20 },
            default: "auto",
        },
        OptionSpec {
            name: "corner",
            help: "how much corners are rounded: 0 sharp, 100 as if they were none",
            kind: Kind::IntegerOrAuto { min: 0, max: 100 },
            default: "auto",
        },
        OptionSpec {
            name: "contrast",
            help: "an edge is dropped beside one this many times stronger; 0 drops none",
            kind: Kind::Number { min: 0.0, max: 10.0 },
            default: "2",
        },
        EdgeRule::DEPTH_STEP_OPTION,
        OptionSpec {
            name: "predication",
            help: "raise the threshold where depth or object ids do not step; needs a scene",
            kind: Kind::Choice(|| vec!["off", "depth", "ids"]),
            default: "off",
        },
        OptionSpec {
            name: "scale",
            help: "of the threshold under predication",
            kind: Kind::Number { min: 1.0, max: 5.0 },
            default: "2",
        },
        OptionSpec {
            name: "strength",
            help: "share of that threshold taken back where the geometry steps",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0.4",
        },
        Blend::OPTION,
        OptionSpec {
            name: "mode",
            help: "1x; s2x: two jittered draws a frame (no hardware 2x MSAA needed, so shaded twice); t2x: one, and the frame before; \
                   4x: both",
            kind: Kind::Choice(|| Mode::ALL.iter().map(|(name, _)| *name).collect()),
            default: "1x",
        },
        OptionSpec {
            name: "reproject",
            help: "t2x and 4x: find the frame before by motion vectors; else it is mixed in where it stands",
            kind: Kind::Switch,
            default: "on",
        },
        OptionSpec {
            name: "velocity_scale",
            help: "t2x and 4x with reproject: how fast the frame before loses weight where speed changes; 0 trusts it everywhere",
            kind: Kind::Number { min: 0.0, max: 80.0 },
            default: "30",
        },
    ],
    configure: |options| {
        let rules = rules(options);
        Ok(match Mode::named(options.word("mode")) {
            None => Box::new(rules),
            Some(mode) => Box::new(Several::new(rules, mode, options)),
        })
    },
    shaders: &MODULES,
    layouts: &[],
};

struct Preset {
    name: &'static str,
    threshold: f64,
    search: u32,
    diag: u32,
    corner: u32,
}

impl Preset {
    const ALL: [Self; 4] = [
        Self { name: "low", threshold: 0.15, search: 4, diag: 0, corner: 100 },
        Self { name: "medium", threshold: 0.1, search: 8, diag: 0, corner: 100 },
        Self { name: "high", threshold: 0.1, search: 16, diag: 8, corner: 25 },
        Self { name: "ultra", threshold: 0.05, search: 32, diag: 16, corner: 25 },
    ];
}

fn rules(options: &Options) -> LineRules {
    let chosen = options.word("preset");
    let preset = Preset::ALL.iter().find(|p| p.name == chosen).unwrap_or(&Preset::ALL[2]);
    let predication = Geometry::named(options.word("predication")).map(|by| Predication {
        by,
        step: options.number("depth_step").unwrap_or_default(),
        scale: options.number("scale").unwrap_or_default(),
        strength: options.number("strength").unwrap_or_default(),
    });
    let threshold = options.number("threshold").unwrap_or(preset.threshold);
    let contrast_factor = options.number("contrast").unwrap_or_default();
    LineRules {
        edges: EdgeRule::chosen(options, threshold, contrast_factor, predication),
        line_reach_px: 2 * options.integer_or("search", preset.search),
        diagonal_reach_px: options.integer_or("diag", preset.diag),
        corner_rounding: f64::from(options.integer_or("corner", preset.corner)) / 100.0,
        soften: true,
        sides: BlendSides::StrongerAxis,
        blend: Blend::named(options.word("blend")),
    }
}

#[cfg(all(test, feature = "workbench"))]
mod tests;
