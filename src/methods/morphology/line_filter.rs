//! The pass of MLAA and SMAA: edges, weights by the lines they form, blending.

use super::patch::{PatchedModules, Patches, Touch, patched};
use super::show::Viewer;
use super::{AreaTable, Blend, EdgeFinder, EdgeRule, Lists, check_size, storage_texture, texture_bytes};
use crate::error::Result;
use crate::pass::{Binding, ComputePass, Context, Groups, Inputs, Pass, Recorder};
use crate::shader::{Source, part};

/// Weights of the lines through each pixel with an edge.
pub(crate) const WEIGHTS: Source = Source {
    name: "weights",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/areas.wgsl"),
        part!("morphology/weights.wgsl"),
    ],
};

/// And of staircases.
pub(crate) const DIAGONALS: Source = Source {
    name: "diagonals",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/areas.wgsl"),
        part!("morphology/diagonals.wgsl"),
    ],
};

/// Blending by those weights.
pub(crate) const BLEND_MODULES: PatchedModules = patched!(
    "blend",
    part!("common/color.wgsl"),
    part!("common/srgb.wgsl"),
    part!("morphology/picture.wgsl"),
    part!("morphology/list.wgsl"),
    part!("morphology/lines.wgsl"),
    part!("morphology/blend.wgsl"),
);

/// Which neighbours a pixel is blended with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BlendSides {
    /// The two across the axis of the largest weight, each side's blend weighted by its weight (SMAA).
    StrongerAxis,
    /// All four, each by what it covers (MLAA).
    All,
}

/// What is looked for, and what comes of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LineRules {
    pub(crate) edges: EdgeRule,
    /// Pixels that a search along a line may go, each way.
    pub(crate) line_reach_px: u32,
    /// And along a diagonal; 0 looks for none.
    pub(crate) diagonal_reach_px: u32,
    /// 0 keeps corners sharp, 1 blends them as if they were none.
    pub(crate) corner_rounding: f64,
    /// Whether short U shapes are softened.
    pub(crate) soften: bool,
    pub(crate) sides: BlendSides,
    pub(crate) blend: Blend,
}

/// Areas beside lines and beside staircases.
#[derive(Debug)]
pub(crate) struct Areas {
    pub(crate) lines: AreaTable,
    pub(crate) diagonals: AreaTable,
}

impl LineRules {
    /// Exact ones, for samples at the pixels' centres.
    pub(crate) fn exact_areas(&self) -> Areas {
        Areas {
            lines: AreaTable::lines(self.line_reach_px, 0.0, self.soften),
            diagonals: AreaTable::diagonals(self.diagonal_reach_px, [0.0; 2]),
        }
    }

    pub(crate) fn build(&self, context: &Context<'_>, areas: &Areas) -> Result<LineFilter> {
        check_size(context)?;
        let constants = [("LINE_REACH", f64::from(self.line_reach_px)), ("CORNER_ROUNDING", self.corner_rounding)];
        let all_sides = ("BLEND_ALL_SIDES", f64::from(u8::from(self.sides == BlendSides::All)));
        let weights_view = storage_texture(context, "weights", context.size, wgpu::TextureFormat::Rgba16Float);
        let reach = [("DIAGONAL_REACH", f64::from(self.diagonal_reach_px))];
        let diagonals = (self.diagonal_reach_px > 0).then(|| Diagonals {
            weigh: ComputePass::new(context.device, "diagonals", &DIAGONALS, "cs_diagonals", &reach),
            areas: Binding::Texture(areas.diagonals.upload(context)),
            pixels: Lists::room(context),
        });
        Ok(LineFilter {
            lists: Lists::new(context)?,
            edges: EdgeFinder::new(context, &self.edges),
            weigh: ComputePass::new(context.device, "weights", &WEIGHTS, "cs_weights", &constants),
            areas: Binding::Texture(areas.lines.upload(context)),
            weights: Binding::Texture(weights_view.clone()),
            weights_view,
            viewer: Viewer::new(context),
            touch: if diagonals.is_some() { Touch::with_diagonals(context) } else { Touch::new(context) },
            diagonals,
            patches: Patches::new(context, self.blend, ("blend", &BLEND_MODULES, "cs_blend"), &[all_sides]),
        })
    }
}

/// What finds staircases.
#[derive(Debug)]
struct Diagonals {
    weigh: ComputePass,
    areas: Binding,
    /// Pixels that one may go through.
    pixels: Binding,
}

#[derive(Debug)]
pub(crate) struct LineFilter {
    lists: Lists,
    edges: EdgeFinder,
    weigh: ComputePass,
    areas: Binding,
    diagonals: Option<Diagonals>,
    weights: Binding,
    weights_view: wgpu::TextureView,
    viewer: Viewer,
    touch: Touch,
    patches: Patches,
}

impl Pass for LineFilter {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        self.edges.record(recorder, &self.lists, inputs, None);
        let (tally, pixels) = (&self.lists.tally_binding, &self.lists.pixels);
        let bindings = [&self.edges.masks, &self.areas, tally, pixels, &self.weights];
        self.weigh.record(recorder, &bindings, Groups::Indirect(&self.lists.tally, Lists::CANDIDATES));
        let list = self.diagonals.as_ref().map(|diagonals| &diagonals.pixels);
        self.touch.record(recorder, &self.edges, &self.lists, list);
        if let Some(Diagonals { weigh, areas, pixels }) = &mut self.diagonals {
            let bindings = [&self.edges.masks, areas, &self.lists.tally_binding, pixels, &self.weights];
            weigh.record(recorder, &bindings, Groups::Indirect(&self.lists.tally, Lists::DIAGONALS));
        }
        let own = [&self.edges.masks, &self.weights];
        self.patches.record(recorder, (&self.lists, Lists::TOUCHED), (&own, &self.touch.touched), inputs, output);
    }

    fn views(&self) -> &'static [&'static str] {
        &[Viewer::EDGES, Viewer::WEIGHTS]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        self.viewer.show(recorder, name, &self.edges.masks, Some(&self.weights))
    }

    fn target_bytes(&self) -> u64 {
        let lists = self.lists.bytes() * if self.diagonals.is_some() { 2 } else { 1 };
        lists + self.edges.bytes() + texture_bytes(&self.weights_view) + self.touch.bytes() + self.patches.bytes()
    }
}
