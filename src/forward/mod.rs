//! The workbench's forward renderer: draws one frame of a scene as a pass asks for it.
//!
//! It answers a [`Draw`]: jitters, hardware samples, a mask, and where the colour goes. Depth is reversed f32. Extras (motion
//! vectors, object ids) are drawn in a pass of their own against the finished depth, and only if asked for.
//!
//! # Sums
//! Many jitters of one [`Target::Sum`] go into a single render pass with additive blending, so that nothing is cleared or stored
//! between them. For each jitter a depth-only draw leaves the nearest surface and a colour draw adds where its depth is equal; it
//! does so in a slice of depth of its own, nearer than those before. The stencil counts the jitters, so that each pixel is added to
//! once in each: surfaces at the very same depth would otherwise both count. The background enters once for all jitters, and
//! surfaces add their difference to it.
//!
//! A slice has 23 bits of depth, evenly spaced, where a plain draw has reversed floating-point depth: far from the near plane
//! surfaces must lie further apart not to fight, at distance z by about z^2 / near / 2^23.

mod draw;
mod mips;
mod outline;
mod pipelines;
mod resources;
mod targets;
mod uniforms;

pub use outline::SHADER as OUTLINE_SHADER;
pub use targets::Targets;

use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::pass::{Draw, Extras, Recorder, Target};
use crate::scene::{Frame, Scene};
use crate::shader::{Source, layout::Layout, part};
use outline::Outline;
use pipelines::Pipelines;
use resources::Resources;

/// The renderer's one module.
pub const SHADER: Source = Source {
    name: "forward",
    parts: &[
        part!("common/color.wgsl"),
        part!("forward/scene.wgsl"),
        part!("forward/pattern.wgsl"),
        part!("forward/light.wgsl"),
        part!("common/screen.wgsl"),
        part!("forward/draw.wgsl"),
    ],
};

/// Raised when what is drawn changes and neither the shader nor the scene does: kept references of earlier revisions are not used.
pub const REVISION: u32 = 1;

/// Every struct the module shares with Rust.
pub const LAYOUTS: &[Layout] = uniforms::LAYOUTS;

/// Most objects in a frame: the instance number keeps 16 bits for them.
pub const MAX_INSTANCES: usize = 1 << 16;

/// Draws frames of one scene on one device.
#[derive(Debug)]
pub struct Forward {
    device: wgpu::Device,
    queue: wgpu::Queue,
    resources: Resources,
    pipelines: Pipelines,
    outline: Option<Outline>,
}

impl Forward {
    /// Uploads the scene's textures and materials.
    ///
    /// # Errors
    /// [`Error::Unsupported`] if a texture is larger than the device allows.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self> {
        let pipelines = Pipelines::new(&gpu.device);
        let resources = Resources::new(gpu, scene, &pipelines)?;
        Ok(Self { device: gpu.device.clone(), queue: gpu.queue.clone(), resources, pipelines, outline: None })
    }

    /// Uploads what stands where at this frame; what follows draws it.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for more instances than [`MAX_INSTANCES`].
    pub fn set_frame(&mut self, frame: &Frame, size: [u32; 2]) -> Result<()> {
        if frame.instances.len() > MAX_INSTANCES {
            return Err(Error::Unsupported(format!(
                "the scene has {} instances; at most {MAX_INSTANCES} can be drawn",
                frame.instances.len()
            )));
        }
        self.resources.set_frame(&self.device, &self.queue, frame, size);
        Ok(())
    }

    /// Makes the targets that a draw needs, beside its sum or output.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where the device lacks a format or a combination is not drawn.
    pub fn targets(gpu: &Gpu, size: [u32; 2], draw: &Draw, extras: Extras) -> Result<Targets> {
        Targets::new(gpu, size, draw, extras)
    }

    /// Records one draw. `output` is where [`Target::Output`] goes.
    ///
    /// # Errors
    /// [`Error::Request`] if several jitters are asked for without a sum, or an outline with one or with samples.
    pub fn draw(
        &mut self,
        recorder: &mut Recorder<'_>,
        request: &Draw,
        targets: &Targets,
        output: &wgpu::TextureView,
    ) -> Result<()> {
        if request.jitters.is_empty() || (request.jitters.len() > 1 && !matches!(request.target, Target::Sum(_))) {
            return Err(Error::Request(format!("a draw of {} jitters can only go into a sum", request.jitters.len())));
        }
        if request.outline.is_some() && (request.samples > 1 || matches!(request.target, Target::Sum(_))) {
            return Err(Error::Request("an outline is drawn against the depth of one plain draw, not of samples or sums".into()));
        }
        self.resources.set_draw(&self.device, &self.queue, request, targets.size);
        if let Some(mask) = &request.mask {
            self.resources.set_mask(&self.device, &self.pipelines, &mask.view);
        }
        draw::record(self, recorder, request, targets, output);
        if let Some(view) = &request.outline {
            let outline = self.outline.get_or_insert_with(|| Outline::new(&self.device));
            self.resources.prepare_outline(&self.device, outline);
            outline.record(&self.device, recorder, &self.resources, &targets.depth, view);
        }
        Ok(())
    }
}
