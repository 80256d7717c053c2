//! The pass of MLAA and SMAA: edges, weights by the lines they form, blending.

use super::patch::{PatchedModules, Patches, Touch, patched};
use super::{AreaTable, Blend, EdgeFinder, EdgeRule, Lists, check_size, storage_texture, texture_bytes};
use crate::error::Result;
use crate::pass::{Binding, ComputePass, Context, Groups, Inputs, Pass, Recorder};
use crate::shader::{Source, part};

/// Weights of the lines and staircases through each pixel with an edge.
pub(crate) const WEIGHTS: Source = Source {
    name: "weights",
    parts: &[part!("morphology/list.wgsl"), part!("morphology/lines.wgsl"), part!("morphology/weights.wgsl")],
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
        let constants = [
            ("LINE_REACH", f64::from(self.line_reach_px)),
            ("DIAGONAL_REACH", f64::from(self.diagonal_reach_px)),
            ("CORNER_ROUNDING", self.corner_rounding),
        ];
        let all_sides = ("BLEND_ALL_SIDES", f64::from(u8::from(self.sides == BlendSides::All)));
        let weights_view = storage_texture(context, "weights", context.size, wgpu::TextureFormat::Rgba16Float);
        Ok(LineFilter {
            lists: Lists::new(context)?,
            edges: EdgeFinder::new(context, &self.edges),
            weigh: ComputePass::new(context.device, "weights", &WEIGHTS, "cs_weights", &constants),
            areas: [&areas.lines, &areas.diagonals].map(|table| Binding::Texture(table.upload(context))),
            weights: Binding::Texture(weights_view.clone()),
            weights_view,
            touch: Touch::new(context),
            patches: Patches::new(context, self.blend, ("blend", &BLEND_MODULES, "cs_blend"), &[all_sides]),
        })
    }
}

#[derive(Debug)]
pub(crate) struct LineFilter {
    lists: Lists,
    edges: EdgeFinder,
    weigh: ComputePass,
    areas: [Binding; 2],
    weights: Binding,
    weights_view: wgpu::TextureView,
    touch: Touch,
    patches: Patches,
}

impl Pass for LineFilter {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        self.edges.record(recorder, &self.lists, inputs, None);
        let [lines, diagonals] = &self.areas;
        let bindings = [&self.edges.masks, lines, diagonals, &self.lists.tally_binding, &self.lists.pixels, &self.weights];
        self.weigh.record(recorder, &bindings, Groups::Indirect(&self.lists.tally, Lists::CANDIDATES));
        self.touch.record(recorder, &self.edges, &self.lists);
        let own = [&self.edges.masks, &self.weights];
        self.patches.record(recorder, (&self.lists, Lists::TOUCHED), (&own, &self.touch.touched), inputs, output);
    }

    fn target_bytes(&self) -> u64 {
        self.lists.bytes() + self.edges.bytes() + texture_bytes(&self.weights_view) + self.touch.bytes() + self.patches.bytes()
    }
}
