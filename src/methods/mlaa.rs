//! MLAA: the shapes that edges form, drawn as lines again, and each pixel blended by what those cut off it.
//!
//! After Reshetov 2009, "Morphological Antialiasing": a line of edges ends where others cross it; what crosses at both ends makes it
//! a Z, a U or an L, which stand for lines through the middles of the crossing edges. Areas are those of the trapezoids, exact.
//!
//! What differs. Reshetov blends along rows first and along columns of the result after that; here each pixel is blended once, with
//! all four neighbours by the area that each covers, so nothing depends on which comes first. Searches end at `max_search`.
//! Colours are mixed in linear light unless told otherwise.
//!
//! Known limits, which SMAA mends: corners are rounded, diagonals are taken for steps, and noise counts as edges.
//!
//! Cost: as SMAA, without diagonals and corners.

use crate::pass::{Kind, Method, OptionSpec, Options};

use super::morphology::{Blend, BlendSides, EdgeRule, LINE_MODULES, LineRules};

pub(super) const METHOD: Method = Method {
    name: "mlaa",
    summary: "morphological: Z, U and L shapes of edges blended by exact trapezoid areas",
    source: "Reshetov 2009, Morphological Antialiasing",
    options: &[
        EdgeRule::OPTION,
        OptionSpec {
            name: "threshold",
            help: "least step of luma or colour; lower finds fainter edges",
            kind: Kind::Number { min: 0.0, max: 0.5 },
            default: "0.1",
        },
        EdgeRule::DEPTH_STEP_OPTION,
        OptionSpec {
            name: "max_search",
            help: "pixels along a line, each way; higher smooths longer lines",
            kind: Kind::Integer { min: 1, max: 224 },
            default: "64",
        },
        Blend::OPTION,
    ],
    configure: |options| Ok(Box::new(rules(options))),
    shaders: &LINE_MODULES,
    layouts: &[],
};

fn rules(options: &Options) -> LineRules {
    let threshold = options.number("threshold").unwrap_or_default();
    LineRules {
        edges: EdgeRule::chosen(options, threshold, 0.0, None),
        line_reach_px: options.integer("max_search"),
        diagonal_reach_px: 0,
        corner_rounding: 1.0,
        soften: false,
        sides: BlendSides::All,
        blend: Blend::named(options.word("blend")),
    }
}
