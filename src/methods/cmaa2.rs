//! CMAA2: conservative morphological anti-aliasing. Long steps become slopes, corners are blurred a little, the rest is left alone.
//!
//! After Strugar 2018, "Conservative Morphological Anti-Aliasing 2.0", its published structure and constants: edges that hold against
//! the local contrast, simple shapes of two to four edges around a pixel, Z shapes with a score of how sure they are, and a weighted
//! mean of all shapes through a pixel.
//!
//! What differs. Shapes are gathered, not scattered: each pixel with an edge looks for the Z shapes at both ends of its line and adds
//! up what they give it, so there is no list of blended colours that could overflow, no atomics on colours, and the same input gives
//! the same bits. The list of pixels has room for all. Searches look at sixteen pixels at a time; a line ends where an edge crosses on
//! either side. Mirrored or transposed pictures give mirrored or transposed results. Colours are mixed in linear light unless told
//! otherwise.
//!
//! After `msaa`, pixels whose samples differ are left alone: the resolve has smoothed them, and what it left of the edge is no step
//! any more. Elsewhere the threshold rises with the samples (1 + 0.06 for each sample more than one).
//!
//! Cost: two passes over all pixels (edges, output), three more over those near an edge.

use crate::error::Result;
use crate::pass::{Context, Encoding, Inputs, Kind, Method, Needs, OptionSpec, Options, Pass, Recorder, Role, Technique};
use crate::shader::{Source, part};

use super::morphology::{
    Blend, EdgeFinder, Lists, PatchedModules, Patches, SHARED_MODULES, SHOW, Touch, Viewer, Weights, check_size, detect, patched,
};

const DETECT: Source = detect!("cmaa2 edges", part!("morphology/strips.wgsl"), part!("cmaa2/edges.wgsl"));

const WEIGHTS: Source = Source {
    name: "cmaa2 weights",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("cmaa2/weights.wgsl"),
        part!("morphology/by_axis.wgsl"),
    ],
};

const BLEND: PatchedModules = patched!(
    "cmaa2 blend",
    part!("common/color.wgsl"),
    part!("common/srgb.wgsl"),
    part!("morphology/picture.wgsl"),
    part!("morphology/list.wgsl"),
    part!("morphology/lines.wgsl"),
    part!("morphology/neighbor.wgsl"),
    part!("cmaa2/blend.wgsl"),
);

const PRESETS: [(&str, f64); 4] = [("low", 0.15), ("medium", 0.10), ("high", 0.07), ("ultra", 0.05)];

pub(super) const METHOD: Method = Method {
    name: "cmaa2",
    summary: "conservative morphological: long steps become slopes, the rest stays sharp (CMAA2)",
    source: "Strugar 2018, Conservative Morphological Anti-Aliasing 2.0",
    options: &[
        OptionSpec {
            name: "preset",
            help: "threshold of an edge: .15 .1 .07 .05",
            kind: Kind::Choice(|| PRESETS.iter().map(|(name, _)| *name).collect()),
            default: "high",
        },
        OptionSpec {
            name: "threshold",
            help: "least step of luma instead; lower finds fainter edges",
            kind: Kind::NumberOrAuto { min: 0.0, max: 0.5 },
            default: "auto",
        },
        OptionSpec { name: "sharp", help: "blend less everywhere", kind: Kind::Switch, default: "off" },
        Blend::OPTION,
    ],
    configure: |options| Ok(Box::new(Cmaa2::new(options))),
    shaders: &{
        let ([a, b, c], [resolved, touch, apply]) = (BLEND, SHARED_MODULES);
        [DETECT, WEIGHTS, SHOW, a, b, c, resolved, touch, apply]
    },
    layouts: &[],
};

/// CMAA2 with its options set.
#[derive(Debug)]
struct Cmaa2 {
    threshold: f64,
    sharp: bool,
    blend: Blend,
}

impl Cmaa2 {
    fn new(options: &Options) -> Self {
        let chosen = options.word("preset");
        let preset = PRESETS.iter().find(|(name, _)| *name == chosen).map_or(PRESETS[2].1, |(_, threshold)| *threshold);
        Self {
            threshold: options.number("threshold").unwrap_or(preset),
            sharp: options.switch("sharp"),
            blend: Blend::named(options.word("blend")),
        }
    }
}

impl Technique for Cmaa2 {
    fn needs(&self) -> Needs {
        Needs { role: Role::Filters(Encoding::Display), output: Encoding::Display, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        check_size(context)?;
        let either = |sharp: f64, soft: f64| if self.sharp { sharp } else { soft };
        let threshold = self.threshold * (1.0 + 0.06 * f64::from(context.input_samples.saturating_sub(1)));
        let edges = [("THRESHOLD", threshold), ("LOCAL_CONTRAST", either(0.15, 0.10)), ("LUMA_IS_REC601", 1.0)];
        let shapes =
            [("LONGER_FACTOR", either(1.20, 1.25)), ("LONGER_OFFSET", either(0.20, 0.25)), ("DAMPENING", either(0.11, 0.15))];
        let simple =
            [("SIMPLE_BLUR", either(0.07, 0.10)), ("CROWDED_FROM", either(1.15, 1.30)), ("CROWDED_SHARE", either(0.125, 0.1))];
        Ok(Box::new(Cmaa2Pass {
            lists: Lists::new(context)?,
            edges: EdgeFinder::with_module(context, &DETECT, &edges),
            weights: Weights::new(context, &WEIGHTS, &shapes),
            viewer: Viewer::new(context),
            touch: Touch::new(context),
            patches: Patches::new(context, self.blend, ("blend", &BLEND, "cs_blend"), &simple),
        }))
    }
}

#[derive(Debug)]
struct Cmaa2Pass {
    lists: Lists,
    edges: EdgeFinder,
    weights: Weights,
    touch: Touch,
    patches: Patches,
    viewer: Viewer,
}

impl Pass for Cmaa2Pass {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let Self { lists, edges, weights, touch, patches, .. } = self;
        edges.record(recorder, lists, inputs, None);
        weights.record(recorder, &edges.masks, None, lists);
        touch.record(recorder, edges, lists);
        let own = [&edges.masks, &weights.rows, &weights.columns];
        patches.record(recorder, (lists, Lists::TOUCHED), (&own, &touch.touched), inputs, output);
    }

    fn views(&self) -> &'static [&'static str] {
        &[Viewer::EDGES, Viewer::WEIGHTS]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        self.viewer.show(recorder, name, &self.edges.masks, Some((&self.weights, 14)))
    }

    fn target_bytes(&self) -> u64 {
        self.lists.bytes() + self.edges.bytes() + self.weights.bytes() + self.touch.bytes() + self.patches.bytes()
    }
}
