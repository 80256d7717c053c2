//! Finding edges: by luma, by colour, or by geometry.

use super::{Blend, Constants, Lists, picture_constants, storage_texture, texture_bytes};
use crate::error::{Error, Result};
use crate::pass::{Binding, ComputePass, Context, Extras, Groups, Inputs, Kind, OptionSpec, Options, Recorder};
use crate::shader::{Part, Source, part};

/// What lies beside the colour and knows silhouettes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Geometry {
    Depth,
    Ids,
}

impl Geometry {
    /// None for a word that names none.
    pub(crate) fn named(name: &str) -> Option<Self> {
        match name {
            "depth" => Some(Self::Depth),
            "ids" => Some(Self::Ids),
            _ => None,
        }
    }
}

/// Which steps are edges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum EdgeRule {
    /// Steps of the colour.
    Color {
        /// By the largest difference of a channel; else by luma.
        by_channel: bool,
        /// In display values.
        threshold: f64,
        /// An edge falls to one this many times stronger beside it; 0 to keep all.
        contrast_factor: f64,
        /// Raises the threshold where the geometry has no step.
        predication: Option<Predication>,
    },
    /// Steps of the geometry.
    Geometry {
        /// Of what.
        of: Geometry,
        /// For depth: relative to the nearer side's.
        step: f64,
    },
}

/// A threshold that geometry guides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Predication {
    /// Of what.
    pub(crate) by: Geometry,
    /// For depth: relative to the nearer side's.
    pub(crate) step: f64,
    /// Factor on the threshold everywhere.
    pub(crate) scale: f64,
    /// How much of that is taken back where the geometry steps, 0 to 1.
    pub(crate) strength: f64,
}

const STRIPS: Part = part!("morphology/strips.wgsl");
const COLOR: Part = part!("morphology/edges_color.wgsl");
const DEPTH: Part = part!("morphology/geometry_depth.wgsl");
const IDS: Part = part!("morphology/geometry_ids.wgsl");
const GEOMETRY: Part = part!("morphology/edges_geometry.wgsl");
const PREDICATE: Part = part!("morphology/predicate_geometry.wgsl");

/// `detect!("name", parts...)`: a module that finds edges by the `edges_of_four` of its parts.
macro_rules! detect {
    ($name:literal, $($part:expr),*) => {
        $crate::shader::Source {
            name: $name,
            parts: &[
                $crate::shader::part!("common/color.wgsl"),
                $crate::shader::part!("common/srgb.wgsl"),
                $crate::shader::part!("morphology/picture.wgsl"),
                $crate::shader::part!("morphology/list.wgsl"),
                $crate::shader::part!("morphology/edges.wgsl"),
                $($part,)*
                $crate::shader::part!("morphology/enlist.wgsl"),
                $crate::shader::part!("morphology/enlist_second.wgsl"),
                $crate::shader::part!("morphology/detect.wgsl"),
            ],
        }
    };
}
pub(crate) use detect;

const BY_COLOR: Source = detect!("edges", STRIPS, COLOR, part!("morphology/predicate_none.wgsl"));
const BY_COLOR_AND_DEPTH: Source = detect!("edges predicated by depth", STRIPS, COLOR, DEPTH, PREDICATE);
const BY_COLOR_AND_IDS: Source = detect!("edges predicated by ids", STRIPS, COLOR, IDS, PREDICATE);
const BY_DEPTH: Source = detect!("edges of depth", DEPTH, GEOMETRY);
const BY_IDS: Source = detect!("edges of ids", IDS, GEOMETRY);

/// Finds the pixels that a resolve has smoothed.
pub(crate) const RESOLVED: Source = Source { name: "resolved pixels", parts: &[part!("morphology/resolved.wgsl")] };

/// Every module that finds edges by a rule.
pub(crate) const MODULES: [Source; 5] = [BY_COLOR, BY_COLOR_AND_DEPTH, BY_COLOR_AND_IDS, BY_DEPTH, BY_IDS];

impl EdgeRule {
    pub(crate) const OPTION: OptionSpec = OptionSpec {
        name: "edges",
        help: "what steps at an edge; depth and ids need a scene",
        kind: Kind::Choice(|| vec!["luma", "color", "depth", "ids"]),
        default: "luma",
    };
    pub(crate) const DEPTH_STEP_OPTION: OptionSpec = OptionSpec {
        name: "depth_step",
        help: "least step of depth, relative to the nearer side's, slopes taken out",
        kind: Kind::Number { min: 0.0, max: 1.0 },
        default: "0.01",
    };

    /// What the two options above ask for; the rest counts for luma and colour.
    pub(crate) fn chosen(options: &Options, threshold: f64, contrast_factor: f64, predication: Option<Predication>) -> Self {
        let kind = options.word("edges");
        match Geometry::named(kind) {
            Some(of) => Self::Geometry { of, step: options.number("depth_step").unwrap_or_default() },
            None => Self::Color { by_channel: kind == "color", threshold, contrast_factor, predication },
        }
    }

    /// What must be drawn beside the colour.
    pub(crate) fn extras(&self) -> Extras {
        match self.geometry() {
            Some(Geometry::Depth) => Extras { depth: true, ..Extras::default() },
            Some(Geometry::Ids) => Extras { ids: true, ..Extras::default() },
            None => Extras::default(),
        }
    }

    fn geometry(&self) -> Option<Geometry> {
        match self {
            Self::Color { predication, .. } => predication.map(|p| p.by),
            Self::Geometry { of, .. } => Some(*of),
        }
    }

    fn source(&self) -> Source {
        match (self, self.geometry()) {
            (Self::Color { .. }, None) => BY_COLOR,
            (Self::Color { .. }, Some(Geometry::Depth)) => BY_COLOR_AND_DEPTH,
            (Self::Color { .. }, Some(Geometry::Ids)) => BY_COLOR_AND_IDS,
            (Self::Geometry { .. }, Some(Geometry::Ids)) => BY_IDS,
            (Self::Geometry { .. }, _) => BY_DEPTH,
        }
    }

    fn constants(&self) -> Constants {
        let step = |by: Geometry, step: f64| (by == Geometry::Depth).then_some(("DEPTH_STEP", step));
        match *self {
            Self::Color { by_channel, threshold, contrast_factor, predication } => {
                let own = [
                    ("EDGES_BY_COLOR", f64::from(u8::from(by_channel))),
                    ("THRESHOLD", threshold),
                    ("CONTRAST_FACTOR", contrast_factor),
                ];
                let guided = predication.into_iter().flat_map(|p| {
                    let guide = [("PREDICATION_SCALE", p.scale), ("PREDICATION_STRENGTH", p.strength)];
                    guide.into_iter().chain(step(p.by, p.step))
                });
                own.into_iter().chain(guided).collect()
            }
            Self::Geometry { of, step: relative } => step(of, relative).into_iter().collect(),
        }
    }
}

/// Finds edges, leaves them as bits (see `morphology/detect.wgsl`) and lists the pixels that have any.
#[derive(Debug)]
pub(crate) struct EdgeFinder {
    geometry: Option<Geometry>,
    resolved: Resolved,
    detect: ComputePass,
    /// The bits.
    pub(crate) masks: Binding,
    masks_view: wgpu::TextureView,
    groups: [u32; 2],
}

impl EdgeFinder {
    /// By a rule.
    pub(crate) fn new(context: &Context<'_>, rule: &EdgeRule) -> Self {
        let finder = Self::with_module(context, &rule.source(), &rule.constants());
        Self { geometry: rule.geometry(), ..finder }
    }

    /// By a module of [`detect`]'s.
    pub(crate) fn with_module(context: &Context<'_>, module: &Source, constants: &[(&'static str, f64)]) -> Self {
        let [width, height] = context.size;
        let groups = [width.div_ceil(32), height.div_ceil(32)];
        let masks_size = [width.div_ceil(16) + height.div_ceil(16), width.max(height)];
        let masks_view = storage_texture(context, "edge masks", masks_size, wgpu::TextureFormat::R32Uint);
        let resolved = Resolved::new(context);
        let spare = [("SPARE_RESOLVED", f64::from(u8::from(resolved.find.is_some())))];
        let picture = picture_constants(context, Blend::Linear);
        let constants: Constants = picture.iter().chain(constants).chain(&spare).copied().collect();
        let detect = ComputePass::new(context.device, "edges", module, "cs_detect", &constants);
        Self { geometry: None, resolved, detect, masks: Binding::Texture(masks_view.clone()), masks_view, groups }
    }

    /// Records the search for edges in a picture. `beside` is what the module reads or writes at binding 6, if that is no geometry.
    pub(crate) fn record(&mut self, recorder: &mut Recorder<'_>, lists: &Lists, inputs: &Inputs<'_>, beside: Option<&Binding>) {
        recorder.clocked("clear lists", |encoder| lists.clear(encoder));
        self.resolved.record(recorder, inputs);
        let color = Binding::Texture(inputs.color.clone());
        let geometry = match self.geometry {
            Some(Geometry::Depth) => inputs.depth,
            Some(Geometry::Ids) => inputs.ids,
            None => None,
        };
        let geometry = geometry.map(|view| Binding::Texture(view.clone()));
        let (tally, pixels) = (&lists.tally_binding, &lists.pixels);
        let own = [&color, &self.masks, tally, pixels, &lists.second_pixels, &self.resolved.bits];
        let bindings: &[&Binding] = match geometry.as_ref().or(beside) {
            Some(beside) => &[own[0], own[1], own[2], own[3], own[4], own[5], beside],
            None => &own,
        };
        self.detect.record(recorder, bindings, Groups::Direct(self.groups));
    }

    pub(crate) fn bytes(&self) -> u64 {
        texture_bytes(&self.masks_view) + self.resolved.bytes
    }
}

/// Which pixels a resolve has smoothed; none where there was no multisampling.
#[derive(Debug)]
struct Resolved {
    find: Option<ComputePass>,
    bits: Binding,
    groups: [u32; 2],
    bytes: u64,
}

impl Resolved {
    fn new(context: &Context<'_>) -> Self {
        let [width, height] = context.size;
        let words = width.div_ceil(16);
        let multisampled = context.input_samples > 1;
        let size = if multisampled { [words, height] } else { [1, 1] };
        // Made as zeroes: no pixel is spared unless a resolve is looked at.
        let bits = storage_texture(context, "resolved pixels", size, wgpu::TextureFormat::R32Uint);
        let samples = [("SAMPLES", f64::from(context.input_samples))];
        Self {
            find: multisampled.then(|| ComputePass::new(context.device, "resolved pixels", &RESOLVED, "cs_resolved", &samples)),
            groups: [words.div_ceil(64), height],
            bytes: texture_bytes(&bits),
            bits: Binding::Texture(bits),
        }
    }

    fn record(&mut self, recorder: &mut Recorder<'_>, inputs: &Inputs<'_>) {
        if let (Some(find), Some(samples)) = (&mut self.find, inputs.samples) {
            find.record(recorder, &[&Binding::Texture(samples.clone()), &self.bits], Groups::Direct(self.groups));
        }
    }
}

/// Checks that the words of rows and columns fit beside each other into a texture.
///
/// # Errors
/// [`Error::Unsupported`].
pub(crate) fn check_size(context: &Context<'_>) -> Result<()> {
    let [width, height] = context.size;
    let most = context.device.limits().max_texture_dimension_2d;
    if width.max(height).max(width.div_ceil(16) + height.div_ceil(16)) > most {
        return Err(Error::Unsupported(format!("{width}x{height} is larger than this device's textures, {most} pixels a side")));
    }
    Ok(())
}
