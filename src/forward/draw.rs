//! Recording one draw: which render pass, in which order.

use super::Forward;
use super::pipelines::{ExtraTargets, Fill, MOST_JITTERS, STENCIL_FORBIDDEN, Step};
use super::targets::Targets;
use crate::pass::{Draw, Recorder, Sum, Target};

/// Label of everything the scene itself costs.
const LABEL: &str = "draw";

pub(super) fn record(
    forward: &mut Forward,
    recorder: &mut Recorder<'_>,
    request: &Draw,
    targets: &Targets,
    output: &wgpu::TextureView,
) {
    prepare_pipelines(forward, request, targets, output);
    let depth = targets.depth.create_view(&wgpu::TextureViewDescriptor::default());
    match &request.target {
        Target::Sum(sum) => record_sum(forward, recorder, request, sum, &depth),
        Target::Output => record_color(forward, recorder, request, targets, output, &depth),
        Target::Input => {
            if let Some(color) = &targets.color {
                let view = color.create_view(&wgpu::TextureViewDescriptor::default());
                record_color(forward, recorder, request, targets, &view, &depth);
            }
        }
    }
    record_extras(forward, recorder, targets, &depth);
}

/// The steps of a request's surfaces, in order.
fn steps(request: &Draw, targets: &Targets, output: &wgpu::TextureView) -> Vec<Step> {
    let alpha_to_coverage = request.alpha_to_coverage && request.samples > 1;
    let mut steps = match &request.target {
        Target::Sum(_) => vec![Step::Depth, Step::Sum],
        Target::Output => vec![Step::Color { format: output.texture().format(), alpha_to_coverage }],
        Target::Input => vec![Step::Color { format: Targets::color_format(), alpha_to_coverage }],
    };
    steps.extend(extras_step(targets));
    steps
}

/// What is drawn beside the colour in a pass of its own; depth needs none.
fn extra_targets(targets: &Targets) -> Option<ExtraTargets> {
    let extras =
        ExtraTargets { motion: targets.motion.is_some(), ids: targets.ids.is_some(), signature: targets.signature.is_some() };
    (extras != ExtraTargets::default()).then_some(extras)
}

fn extras_step(targets: &Targets) -> Option<Step> {
    extra_targets(targets).map(Step::Extras)
}

fn extras_fill(targets: &Targets) -> Option<Fill> {
    extra_targets(targets).map(|extras| Fill::Extras { extras, depth: targets.depth.format() })
}

fn fills(request: &Draw, color: Option<wgpu::TextureFormat>) -> Vec<Fill> {
    let mut fills = Vec::new();
    if request.mask.is_some() {
        fills.push(Fill::Stencil { color });
    }
    if matches!(request.target, Target::Sum(_)) {
        fills.push(Fill::Background);
    }
    fills
}

fn color_format(request: &Draw, output: &wgpu::TextureView) -> wgpu::TextureFormat {
    match &request.target {
        Target::Sum(_) => wgpu::TextureFormat::Rgba32Float,
        Target::Output => output.texture().format(),
        Target::Input => Targets::color_format(),
    }
}

/// Makes every pipeline before the first pass: a recorder's clock should not time compilers.
fn prepare_pipelines(forward: &mut Forward, request: &Draw, targets: &Targets, output: &wgpu::TextureView) {
    for step in steps(request, targets, output) {
        // Extras need no stencil: equal depth says where the mask let something through.
        let masked = request.mask.is_some() && !matches!(step, Step::Extras(_));
        for batch in &forward.resources.batches {
            forward.pipelines.surface(batch.kind, step, targets.samples, targets.depth.format(), masked);
        }
    }
    for fill in fills(request, Some(color_format(request, output))) {
        forward.pipelines.fill(fill, targets.samples, request.mask.is_some());
    }
    if let Some(fill) = extras_fill(targets) {
        forward.pipelines.fill(fill, 1, false);
    }
}

fn depth_attachment<'a>(
    view: &'a wgpu::TextureView,
    depth: wgpu::LoadOp<f32>,
    targets_format: wgpu::TextureFormat,
) -> wgpu::RenderPassDepthStencilAttachment<'a> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: depth, store: wgpu::StoreOp::Store }),
        stencil_ops: targets_format
            .has_stencil_aspect()
            .then_some(wgpu::Operations { load: wgpu::LoadOp::Clear(0), store: wgpu::StoreOp::Discard }),
    }
}

fn color_attachment(view: &wgpu::TextureView, load: wgpu::LoadOp<wgpu::Color>) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    })
}

fn record_color(
    forward: &mut Forward,
    recorder: &mut Recorder<'_>,
    request: &Draw,
    targets: &Targets,
    color: &wgpu::TextureView,
    depth: &wgpu::TextureView,
) {
    let background = forward.resources.background();
    let format = color.texture().format();
    let descriptor = wgpu::RenderPassDescriptor {
        label: Some(LABEL),
        color_attachments: &[color_attachment(color, wgpu::LoadOp::Clear(background))],
        depth_stencil_attachment: Some(depth_attachment(depth, wgpu::LoadOp::Clear(0.0), targets.depth.format())),
        ..Default::default()
    };
    let alpha_to_coverage = request.alpha_to_coverage && request.samples > 1;
    recorder.render(&descriptor, |pass| {
        forward.begin(pass, request, Some(format), targets.samples);
        let step = Step::Color { format, alpha_to_coverage };
        forward.surfaces(pass, step, 0, targets.samples, targets.depth.format(), request.mask.is_some());
    });
}

fn record_sum(forward: &mut Forward, recorder: &mut Recorder<'_>, request: &Draw, sum: &Sum, depth: &wgpu::TextureView) {
    let format = depth.texture().format();
    let [width, height] = [depth.texture().width(), depth.texture().height()].map(|side| side as f32);
    let masked = request.mask.is_some();
    let jitters: Vec<u32> = (0..request.jitters.len() as u32).collect();
    for (chunk, nth) in jitters.chunks(MOST_JITTERS).zip(0..) {
        let clear = sum.clear && nth == 0;
        let load = if clear { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { wgpu::LoadOp::Load };
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some(LABEL),
            color_attachments: &[color_attachment(&sum.view, load)],
            depth_stencil_attachment: Some(depth_attachment(depth, wgpu::LoadOp::Clear(0.0), format)),
            ..Default::default()
        };
        recorder.render(&descriptor, |pass| {
            forward.begin(pass, request, Some(wgpu::TextureFormat::Rgba32Float), 1);
            if nth == 0 {
                forward.screen(pass, Fill::Background, masked);
            }
            for (&jitter, place) in chunk.iter().zip(1..) {
                let [far, near] = depth_slice(place, chunk.len() as u32);
                pass.set_viewport(0.0, 0.0, width, height, far, near);
                pass.set_stencil_reference(place);
                let weight = f64::from(request.jitters[jitter as usize].weight);
                pass.set_blend_constant(wgpu::Color { r: weight, g: weight, b: weight, a: weight });
                forward.surfaces(pass, Step::Depth, jitter, 1, format, masked);
                forward.surfaces(pass, Step::Sum, jitter, 1, format, masked);
            }
        });
    }
}

/// The range of depth that the `place`-th of `count` jitters draws into (from 1): nearer than all before it, so that nothing must
/// be cleared between them. Each reaches from one power of two to the next and so has all 23 bits of an f32's fraction to itself,
/// however many there are; slices of equal size would share them.
fn depth_slice(place: u32, count: u32) -> [f32; 2] {
    let near = 0.5f32.powi((count - place) as i32);
    [0.5 * near, near]
}

fn record_extras(forward: &mut Forward, recorder: &mut Recorder<'_>, targets: &Targets, depth: &wgpu::TextureView) {
    let Some(step) = extras_step(targets) else {
        return;
    };
    let view = |texture: &Option<wgpu::Texture>| texture.as_ref().map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
    let views = [&targets.motion, &targets.ids, &targets.signature].map(view);
    let clear = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
    let attachments = views.each_ref().map(|v| v.as_ref().and_then(|v| color_attachment(v, clear)));
    let descriptor = wgpu::RenderPassDescriptor {
        label: Some("draw extras"),
        color_attachments: &attachments,
        depth_stencil_attachment: Some(depth_attachment(depth, wgpu::LoadOp::Load, targets.depth.format())),
        ..Default::default()
    };
    let (format, fill) = (targets.depth.format(), extras_fill(targets));
    recorder.render(&descriptor, |pass| {
        pass.set_bind_group(0, &forward.resources.frame_group, &[]);
        if let Some(fill) = fill {
            forward.screen(pass, fill, false);
        }
        forward.surfaces(pass, step, 0, targets.samples, format, false);
    });
}

impl Forward {
    /// Binds the frame; forbids drawing where a mask says so. Leaves a stencil reference that passes elsewhere.
    fn begin(&mut self, pass: &mut wgpu::RenderPass<'_>, request: &Draw, color: Option<wgpu::TextureFormat>, samples: u32) {
        pass.set_bind_group(0, &self.resources.frame_group, &[]);
        if request.mask.is_some() {
            pass.set_stencil_reference(STENCIL_FORBIDDEN);
            pass.set_pipeline(self.pipelines.fill(Fill::Stencil { color }, samples, true));
            pass.set_bind_group(1, self.resources.mask_group.as_ref().map(|(_, group)| group), &[]);
            pass.draw(0..3, 0..1);
            pass.set_stencil_reference(1);
        }
    }

    fn screen(&mut self, pass: &mut wgpu::RenderPass<'_>, fill: Fill, masked: bool) {
        pass.set_pipeline(self.pipelines.fill(fill, 1, masked));
        pass.draw(0..3, 0..1);
    }

    fn surfaces(
        &mut self,
        pass: &mut wgpu::RenderPass<'_>,
        step: Step,
        jitter: u32,
        samples: u32,
        depth: wgpu::TextureFormat,
        masked: bool,
    ) {
        for batch in &self.resources.batches {
            let mesh = self.resources.mesh(batch.mesh);
            pass.set_pipeline(self.pipelines.surface(batch.kind, step, samples, depth, masked));
            pass.set_bind_group(1, self.resources.material_group(batch.material), &[]);
            pass.set_vertex_buffer(0, mesh.positions.slice(..));
            if step != Step::Depth || batch.kind.masked {
                pass.set_vertex_buffer(1, mesh.attributes.slice(..));
            }
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            let first = jitter << 16 | batch.first;
            pass.draw_indexed(0..mesh.index_count, 0, first..first + batch.count);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_are_disjoint_and_come_nearer() {
        let slices: Vec<[f32; 2]> = (1..=MOST_JITTERS as u32).map(|place| depth_slice(place, MOST_JITTERS as u32)).collect();
        assert!(slices[0][0] > f32::MIN_POSITIVE, "normal numbers only");
        assert!(slices.windows(2).all(|pair| pair[0][1] <= pair[1][0]));
        assert_eq!(slices.last().map(|s| s[1]), Some(1.0));
    }
}
