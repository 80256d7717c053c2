//! FXAA: a pixel beside an edge is read a little towards its neighbour across it, by where along the edge it lies.
//!
//! After Lottes 2009 and 2011, FXAA 3.11, the quality path: pixels whose neighbourhood spans little luma are left alone; the others
//! find out which way their edge runs, search along it with growing steps for its two ends, and move towards the neighbour the
//! nearer they are to an end that bends away. Single pixels that stand out are moved besides (`subpix`).
//!
//! What differs. Luma is computed once for every pixel, and only pixels that have work are searched; lumas between pixels are
//! interpolated by arithmetic instead of a sampler.
//!
//! As published, it is not symmetric where an edge runs exactly between two directions, or where both sides or both ends are
//! equally good: one of them is taken. Known limits: text is softened, and lines of one pixel fade.
//!
//! Cost: two passes over all pixels (luma and contrast, output), one more over those with work.

use crate::error::Result;
use crate::pass::{
    Binding, Context, Encoding, Inputs, Kind, Method, Needs, OptionSpec, Options, Pass, Recorder, Role, Technique,
};
use crate::shader::{Source, part};

use super::morphology::{
    Blend, EdgeFinder, Lists, PatchedModules, Patches, SHARED_MODULES, SHOW, Viewer, check_size, detect, patched,
    storage_texture, texture_bytes,
};

const DETECT: Source = detect!("fxaa contrast", part!("fxaa/edges.wgsl"));

const SEARCH: PatchedModules = patched!(
    "fxaa search",
    part!("common/color.wgsl"),
    part!("common/srgb.wgsl"),
    part!("morphology/picture.wgsl"),
    part!("morphology/list.wgsl"),
    part!("fxaa/search.wgsl"),
);

pub(super) const METHOD: Method = Method {
    name: "fxaa",
    summary: "reads pixels beside edges a little across them; fast, soft (FXAA 3.11 quality)",
    source: "Lottes 2009, FXAA; version 3.11, 2011",
    options: &[
        OptionSpec {
            name: "preset",
            help: "search steps: 1.5 3 12, or 1 1.5 2 4 12, or 1 1.5 2x4 4 8, or 1x5 1.5 2x4 4 8 (its 10, 12, 25, 39)",
            kind: Kind::Choice(|| Schedule::PRESETS.iter().map(|(name, _)| *name).collect()),
            default: "high",
        },
        OptionSpec {
            name: "steps",
            help: "so many search steps instead: 1, 1.5, twos, 4, 8; more follow longer edges",
            kind: Kind::IntegerOrAuto { min: 4, max: 64 },
            default: "auto",
        },
        OptionSpec {
            name: "subpix",
            help: "how much single pixels are smoothed: 0 not at all, 1 softest",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0.75",
        },
        OptionSpec {
            name: "threshold",
            help: "least span of luma around a pixel, relative to the highest; lower finds fainter edges",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0.166",
        },
        OptionSpec {
            name: "threshold_min",
            help: "and in absolute terms, which spares dark places",
            kind: Kind::Number { min: 0.0, max: 1.0 },
            default: "0.0833",
        },
        OptionSpec {
            name: "luma",
            help: "of display values: Rec. 601 weights, or green alone",
            kind: Kind::Choice(|| vec!["rec601", "green"]),
            default: "rec601",
        },
        Blend::OPTION,
    ],
    configure: |options| Ok(Box::new(Fxaa::new(options))),
    shaders: &{
        let ([a, b, c], [resolved, _, apply]) = (SEARCH, SHARED_MODULES);
        [DETECT, SHOW, a, b, c, resolved, apply]
    },
    layouts: &[],
};

/// Steps of the search: so many of one pixel, one of 1.5, so many of 2, and two last ones.
#[derive(Debug, Clone, Copy)]
struct Schedule {
    units: u32,
    doubles: u32,
    last: [f64; 2],
}

impl Schedule {
    const PRESETS: [(&'static str, Self); 4] = [
        ("low", Self { units: 0, doubles: 0, last: [3.0, 12.0] }),
        ("medium", Self { units: 1, doubles: 1, last: [4.0, 12.0] }),
        ("high", Self { units: 1, doubles: 4, last: [4.0, 8.0] }),
        ("ultra", Self { units: 5, doubles: 4, last: [4.0, 8.0] }),
    ];

    fn new(options: &Options) -> Self {
        let chosen = options.word("preset");
        let preset = Self::PRESETS.iter().find(|(name, _)| *name == chosen).map_or(Self::PRESETS[2].1, |(_, schedule)| *schedule);
        match options.integer_or("steps", 0) {
            0 => preset,
            steps => Self { units: 1, doubles: steps - 4, last: [4.0, 8.0] },
        }
    }
}

/// FXAA with its options set.
#[derive(Debug)]
struct Fxaa {
    schedule: Schedule,
    subpix: f64,
    detection: [(&'static str, f64); 3],
    blend: Blend,
}

impl Fxaa {
    fn new(options: &Options) -> Self {
        let number = |name| options.number(name).unwrap_or_default();
        let green = f64::from(u8::from(options.word("luma") == "green"));
        Self {
            schedule: Schedule::new(options),
            subpix: number("subpix"),
            detection: [("THRESHOLD", number("threshold")), ("THRESHOLD_MIN", number("threshold_min")), ("LUMA_IS_GREEN", green)],
            blend: Blend::named(options.word("blend")),
        }
    }
}

impl Technique for Fxaa {
    fn needs(&self) -> Needs {
        Needs { role: Role::Filters(Encoding::Display), output: Encoding::Display, ..Needs::default() }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        check_size(context)?;
        let search = [
            ("SUBPIX", self.subpix),
            ("UNIT_STEPS", f64::from(self.schedule.units)),
            ("DOUBLE_STEPS", f64::from(self.schedule.doubles)),
            ("NEXT_TO_LAST_STEP", self.schedule.last[0]),
            ("LAST_STEP", self.schedule.last[1]),
        ];
        let luma = storage_texture(context, "luma", context.size, wgpu::TextureFormat::R32Float);
        Ok(Box::new(FxaaPass {
            lists: Lists::single(context)?,
            contrast: EdgeFinder::with_module(context, &DETECT, &self.detection),
            luma: Binding::Texture(luma.clone()),
            luma_view: luma,
            viewer: Viewer::new(context),
            patches: Patches::new(context, self.blend, ("search", &SEARCH, "cs_search"), &search),
        }))
    }
}

#[derive(Debug)]
struct FxaaPass {
    lists: Lists,
    contrast: EdgeFinder,
    luma: Binding,
    luma_view: wgpu::TextureView,
    viewer: Viewer,
    patches: Patches,
}

impl Pass for FxaaPass {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        self.contrast.record(recorder, &self.lists, inputs, Some(&self.luma));
        // The masks' words of rows say which pixels have work: those are the ones that change.
        let own = (&[&self.luma][..], &self.contrast.masks);
        self.patches.record(recorder, (&self.lists, Lists::ROWS), own, inputs, output);
    }

    fn views(&self) -> &'static [&'static str] {
        &[Viewer::EDGES, "luma"]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        // Pixels with work are shown as if they had an edge above.
        if name == "luma" { Some(self.luma_view.clone()) } else { self.viewer.show(recorder, name, &self.contrast.masks, None) }
    }

    fn target_bytes(&self) -> u64 {
        self.lists.bytes() + self.contrast.bytes() + texture_bytes(&self.luma_view) + self.patches.bytes()
    }
}
