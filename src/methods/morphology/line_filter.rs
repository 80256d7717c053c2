//! The pass of MLAA and SMAA: edges, weights by the lines they form, blending.

use super::patch::{PatchedModules, Patches, Touch, patched};
use super::show::Viewer;
use super::{AreaSet, Blend, EdgeFinder, EdgeRule, Lists, Weights, check_size};
use crate::error::Result;
use crate::pass::{ComputePass, Context, Encoding, Groups, Inputs, Needs, Pass, Recorder, Role, Technique};
use crate::shader::{Source, part};

/// Weights of the lines through each pixel with an edge.
pub(crate) const WEIGHTS: Source = Source {
    name: "weights",
    parts: &[
        part!("morphology/list.wgsl"),
        part!("morphology/lines.wgsl"),
        part!("morphology/areas.wgsl"),
        part!("morphology/weights.wgsl"),
        part!("morphology/by_axis.wgsl"),
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
    part!("morphology/neighbor.wgsl"),
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

impl LineRules {
    /// Exact areas for pictures whose samples lie at these places, from the pixels' centres in pixels, y down.
    pub(crate) fn exact_areas(&self, context: &Context<'_>, places_px: &[[f64; 2]]) -> Vec<AreaSet> {
        AreaSet::exact(context, [self.line_reach_px, self.diagonal_reach_px], self.soften, places_px)
    }

    /// `areas` are those to choose from for each picture.
    pub(crate) fn build_with(&self, context: &Context<'_>, areas: Vec<AreaSet>) -> Result<LineFilter> {
        check_size(context)?;
        let constants = [("LINE_REACH", f64::from(self.line_reach_px)), ("CORNER_ROUNDING", self.corner_rounding)];
        let all_sides = ("BLEND_ALL_SIDES", f64::from(u8::from(self.sides == BlendSides::All)));
        let reach = [("DIAGONAL_REACH", f64::from(self.diagonal_reach_px))];
        let diagonals = (self.diagonal_reach_px > 0)
            .then(|| ComputePass::new(context.device, "diagonals", &DIAGONALS, "cs_diagonals", &reach));
        Ok(LineFilter {
            lists: Lists::new(context)?,
            edges: EdgeFinder::new(context, &self.edges),
            weights: Weights::new(context, &WEIGHTS, &constants),
            areas,
            viewer: Viewer::new(context),
            touch: if diagonals.is_some() { Touch::with_diagonals(context) } else { Touch::new(context) },
            diagonals,
            patches: Patches::new(context, self.blend, ("blend", &BLEND_MODULES, "cs_blend"), &[all_sides]),
        })
    }
}

impl Technique for LineRules {
    fn needs(&self) -> Needs {
        Needs {
            role: Role::Filters(Encoding::Display),
            output: Encoding::Display,
            extras: self.edges.extras(),
            ..Needs::default()
        }
    }

    fn build(&self, context: &Context<'_>) -> Result<Box<dyn Pass>> {
        Ok(Box::new(self.build_with(context, self.exact_areas(context, &[[0.0; 2]]))?))
    }
}

#[derive(Debug)]
pub(crate) struct LineFilter {
    lists: Lists,
    edges: EdgeFinder,
    areas: Vec<AreaSet>,
    weights: Weights,
    /// Finds staircases.
    diagonals: Option<ComputePass>,
    touch: Touch,
    patches: Patches,
    viewer: Viewer,
}

impl LineFilter {
    /// Records the filter on a picture whose samples lie where the set of this number is for.
    pub(crate) fn record_at(
        &mut self,
        recorder: &mut Recorder<'_>,
        place: usize,
        inputs: &Inputs<'_>,
        output: &wgpu::TextureView,
    ) {
        let Self { lists, edges, areas, weights, diagonals, touch, patches, .. } = self;
        let areas = &areas[place];
        edges.record(recorder, lists, inputs, None);
        weights.record(recorder, &edges.masks, Some([&areas.rows, &areas.columns]), lists);
        touch.record(recorder, edges, lists);
        if let Some(diagonals) = diagonals {
            let (tally, pixels) = (&lists.tally_binding, &lists.second_pixels);
            let [rising, falling] = &areas.diagonals;
            let bindings = [&edges.masks, rising, tally, pixels, &weights.rows, &weights.columns, falling];
            diagonals.record(recorder, &bindings, Groups::Indirect(&lists.tally, Lists::DIAGONALS));
        }
        let own = [&edges.masks, &weights.rows, &weights.columns];
        patches.record(recorder, (lists, Lists::TOUCHED), (&own, &touch.touched), inputs, output);
    }
}

impl Pass for LineFilter {
    fn record(&mut self, recorder: &mut Recorder<'_>, _: u32, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        self.record_at(recorder, 0, inputs, output);
    }

    fn views(&self) -> &'static [&'static str] {
        &[Viewer::EDGES, Viewer::WEIGHTS]
    }

    fn view(&mut self, recorder: &mut Recorder<'_>, name: &str) -> Option<wgpu::TextureView> {
        self.viewer.show(recorder, name, &self.edges.masks, Some((&self.weights, 16)))
    }

    fn target_bytes(&self) -> u64 {
        self.lists.bytes() + self.edges.bytes() + self.weights.bytes() + self.touch.bytes() + self.patches.bytes()
    }
}
