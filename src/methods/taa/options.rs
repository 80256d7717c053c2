//! What can be set, and what the presets set.

use crate::pass::{Kind, OptionSpec, Options};
use crate::sampling::{FILTERS, pattern_names};

/// A preset and what it sets where an option says `auto`.
struct Preset {
    name: &'static str,
    history: &'static str,
    box_kind: &'static str,
    gamma: f64,
    gamma_motion: f64,
    memory: u32,
    most: u32,
    most_motion: u32,
    reject: &'static str,
    sharpen: f64,
    cycle: u32,
    fallback: &'static str,
}

const PRESETS: [Preset; 3] = [
    Preset {
        name: "fast",
        history: "bilinear",
        box_kind: "minmax",
        gamma: 1.0,
        gamma_motion: 1.0,
        memory: 0,
        most: 16,
        most_motion: 4,
        reject: "depth",
        sharpen: 0.0,
        cycle: 16,
        fallback: "off",
    },
    Preset {
        name: "balanced",
        history: "areas",
        box_kind: "minmax",
        gamma: 1.5,
        gamma_motion: 1.0,
        memory: 6,
        most: 32,
        most_motion: 8,
        reject: "ids",
        sharpen: 0.0,
        cycle: 32,
        fallback: "off",
    },
    Preset {
        name: "quality",
        history: "areas",
        box_kind: "minmax",
        gamma: 1.5,
        gamma_motion: 1.0,
        memory: 8,
        most: 64,
        most_motion: 8,
        reject: "ids",
        sharpen: 0.0,
        cycle: 64,
        fallback: "smaa",
    },
];

/// Every option set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Settings {
    pub(super) jitter: &'static str,
    pub(super) cycle: u32,
    pub(super) input: &'static str,
    pub(super) limit: f64,
    pub(super) dilation: &'static str,
    pub(super) camera_moves_background: bool,
    pub(super) motion_in_halves: bool,
    pub(super) history: &'static str,
    pub(super) in_halves: bool,
    pub(super) weight: &'static str,
    pub(super) in_ycocg: bool,
    pub(super) clip: &'static str,
    pub(super) box_kind: &'static str,
    pub(super) gamma: f64,
    pub(super) gamma_motion: f64,
    pub(super) memory: u32,
    pub(super) most: u32,
    pub(super) most_motion: u32,
    pub(super) reject: &'static str,
    pub(super) depth_step: f64,
    pub(super) sharpen: f64,
    pub(super) fallback: &'static str,
}

pub(super) const WEIGHTS: [&str; 3] = ["none", "luma", "highlights"];
pub(super) const HISTORIES: [&str; 4] = ["bilinear", "catmull-rom", "lanczos", "areas"];
pub(super) const BOXES: [&str; 4] = ["minmax", "rounded", "variance", "both"];
pub(super) const DILATIONS: [&str; 3] = ["off", "cross", "full"];
pub(super) const CLIPS: [&str; 3] = ["off", "clamp", "clip"];

fn index_of(names: &[&str], name: &str) -> f64 {
    names.iter().position(|n| *n == name).unwrap_or(0) as f64
}

impl Settings {
    pub(super) const OPTIONS: &'static [OptionSpec] = &[
        OptionSpec {
            name: "preset",
            help: "what auto means below",
            kind: Kind::Choice(|| PRESETS.iter().map(|p| p.name).collect()),
            default: "balanced",
        },
        OptionSpec {
            name: "jitter",
            help: "where in the pixel each frame samples, one point of this set after another",
            kind: Kind::Choice(pattern_names),
            default: "halton",
        },
        OptionSpec {
            name: "cycle",
            help: "frames until the jitter repeats",
            kind: Kind::IntegerOrAuto { min: 1, max: 1024 },
            default: "auto",
        },
        OptionSpec {
            name: "input",
            help: "filter by which a frame's 3x3 samples count for a pixel; box takes its own as it is",
            kind: Kind::Choice(|| FILTERS.iter().map(|f| f.name).collect()),
            default: "box",
        },
        OptionSpec {
            name: "limit",
            help: "fireflies: the brightest of 3x3 samples is limited to this many times the second; 0 limits none",
            kind: Kind::Number { min: 0.0, max: 1000.0 },
            default: "4",
        },
        OptionSpec {
            name: "weight",
            help: "which samples count less: none, those brighter than white, or all by 1/(1+luminance); less flicker, less light",
            kind: Kind::Choice(|| WEIGHTS.to_vec()),
            default: "none",
        },
        OptionSpec {
            name: "dilation",
            help: "whose motion a pixel follows: its own, or that of the nearest surface of five, or of 3x3",
            kind: Kind::Choice(|| DILATIONS.to_vec()),
            default: "full",
        },
        OptionSpec {
            name: "background",
            help: "how the background moves: by its motion vectors, or as the camera does where nothing is drawn",
            kind: Kind::Choice(|| vec!["drawn", "camera"]),
            default: "drawn",
        },
        OptionSpec {
            name: "motion",
            help: "precision that motion vectors are taken to have",
            kind: Kind::Choice(|| vec!["fp32", "fp16"]),
            default: "fp32",
        },
        OptionSpec {
            name: "history",
            help: "interpolation of earlier frames' pixels, of 2x2, 4x4 or 6x6 of them: the wider, the sharper in motion",
            kind: Kind::Choice(|| [&["auto"], &HISTORIES[..]].concat()),
            default: "auto",
        },
        OptionSpec {
            name: "storage",
            help: "what earlier frames are kept in; fp16 is rounded by chance, so that nothing stalls",
            kind: Kind::Choice(|| vec!["fp16", "fp32"]),
            default: "fp16",
        },
        OptionSpec {
            name: "space",
            help: "axes of the box that history is held against",
            kind: Kind::Choice(|| vec!["rgb", "ycocg"]),
            default: "rgb",
        },
        OptionSpec {
            name: "clip",
            help: "history outside the box: left, limited a channel, or pulled towards the box's middle",
            kind: Kind::Choice(|| CLIPS.to_vec()),
            default: "clip",
        },
        OptionSpec {
            name: "box",
            help: "of the 3x3 samples: least to greatest, that and the cross's in the mean, deviations around the mean, both",
            kind: Kind::Choice(|| [&["auto"], &BOXES[..]].concat()),
            default: "auto",
        },
        OptionSpec {
            name: "gamma",
            help: "deviations from the mean to the box's sides, at rest",
            kind: Kind::NumberOrAuto { min: 0.1, max: 10.0 },
            default: "auto",
        },
        OptionSpec {
            name: "gamma_motion",
            help: "the same from a pixel a frame on",
            kind: Kind::NumberOrAuto { min: 0.1, max: 10.0 },
            default: "auto",
        },
        OptionSpec {
            name: "memory",
            help: "frames in which a remembered box gives way to the newest; 0 remembers none, and what is thin flickers",
            kind: Kind::IntegerOrAuto { min: 0, max: 256 },
            default: "auto",
        },
        OptionSpec {
            name: "most",
            help: "frames in the mean, at most, at rest: the first n count equally, then each new one 1/most",
            kind: Kind::IntegerOrAuto { min: 1, max: 1024 },
            default: "auto",
        },
        OptionSpec {
            name: "most_motion",
            help: "the same in motion, and once a pixel was interpolated",
            kind: Kind::IntegerOrAuto { min: 1, max: 1024 },
            default: "auto",
        },
        OptionSpec {
            name: "reject",
            help: "what tells that history was of another surface: object ids, depth; off asks for neither",
            kind: Kind::Choice(|| vec!["auto", "off", "depth", "ids"]),
            default: "auto",
        },
        OptionSpec {
            name: "depth_step",
            help: "least step of depth between surfaces, relative to the nearer's",
            kind: Kind::Number { min: 0.0001, max: 1.0 },
            default: "0.02",
        },
        OptionSpec {
            name: "sharpen",
            help: "how much softness is taken back",
            kind: Kind::NumberOrAuto { min: 0.0, max: 2.0 },
            default: "auto",
        },
        OptionSpec {
            name: "fallback",
            help: "what smooths a pixel that has no history yet",
            kind: Kind::Choice(|| vec!["auto", "off", "fxaa", "mlaa", "smaa", "cmaa2"]),
            default: "auto",
        },
    ];

    pub(super) fn new(options: &Options) -> Self {
        let chosen = options.word("preset");
        let preset = PRESETS.iter().find(|p| p.name == chosen).unwrap_or(&PRESETS[1]);
        let word_or = |name, auto: &'static str| match options.word(name) {
            "auto" => auto,
            word => word,
        };
        let number = |name| options.number(name).unwrap_or_default();
        Self {
            jitter: options.word("jitter"),
            cycle: options.integer_or("cycle", preset.cycle),
            input: options.word("input"),
            limit: number("limit"),
            dilation: options.word("dilation"),
            camera_moves_background: options.word("background") == "camera",
            motion_in_halves: options.word("motion") == "fp16",
            history: word_or("history", preset.history),
            in_halves: options.word("storage") == "fp16",
            weight: options.word("weight"),
            in_ycocg: options.word("space") == "ycocg",
            clip: options.word("clip"),
            box_kind: word_or("box", preset.box_kind),
            gamma: options.number("gamma").unwrap_or(preset.gamma),
            gamma_motion: options.number("gamma_motion").unwrap_or(preset.gamma_motion),
            memory: options.integer_or("memory", preset.memory),
            most: options.integer_or("most", preset.most),
            most_motion: options.integer_or("most_motion", preset.most_motion),
            reject: word_or("reject", preset.reject),
            depth_step: number("depth_step"),
            sharpen: options.number("sharpen").unwrap_or(preset.sharpen),
            fallback: word_or("fallback", preset.fallback),
        }
    }

    pub(super) fn rejects_by(&self, what: &str) -> bool {
        self.reject == what
    }

    /// Whether the nearest surface is looked for, or the background, or a surface hidden before.
    pub(super) fn reads_depth(&self) -> bool {
        self.dilation != "off" || self.camera_moves_background || self.rejects_by("depth")
    }

    /// `(name, value)` of the resolve's `override`s.
    pub(super) fn resolve_constants(&self) -> Vec<(&'static str, f64)> {
        let switch = |on: bool| f64::from(u8::from(on));
        let mut constants = self.space_constants();
        constants.extend([
            ("LIMIT", self.limit),
            ("BOX", index_of(&BOXES, self.box_kind)),
            ("GAMMA_STILL", self.gamma),
            ("GAMMA_MOTION", self.gamma_motion),
            ("DILATION", index_of(&DILATIONS, self.dilation)),
            ("CAMERA_MOVES_BACKGROUND", switch(self.camera_moves_background)),
            ("MOTION_IN_HALVES", switch(self.motion_in_halves)),
            ("REFUSE_BY_DEPTH", switch(self.rejects_by("depth"))),
            ("REFUSE_BY_IDS", switch(self.rejects_by("ids"))),
            ("DEPTH_STEP", self.depth_step),
            ("HISTORY_FILTER", index_of(&HISTORIES, self.history)),
            ("RECTIFY", index_of(&CLIPS, self.clip)),
            ("FORGETTING", if self.memory == 0 { 1.0 } else { 1.0 / f64::from(self.memory) }),
            ("MOST_STILL", f64::from(self.most)),
            ("MOST_MOTION", f64::from(self.most_motion)),
            ("IN_HALVES", switch(self.in_halves)),
            ("FALLBACK", switch(self.fallback != "off")),
        ]);
        constants
    }

    /// And of what shows the mean.
    pub(super) fn space_constants(&self) -> Vec<(&'static str, f64)> {
        vec![("COMPRESSION", index_of(&WEIGHTS, self.weight)), ("IN_YCOCG", f64::from(u8::from(self.in_ycocg)))]
    }
}
