//! Linear light to display values, on the GPU: the same code for reference and candidate.

use wgpu::util::DeviceExt as _;

use crate::error::Result;
use crate::gpu::{Gpu, TextureSpec};
use crate::pass::{Binding, Recorder, ScreenPass};
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::{Scene, ToneMap};
use crate::shader::{
    Source,
    layout::{Layout, gpu_struct},
    part,
};

gpu_struct! {
    /// How a scene wants to be shown.
    struct PresentUniforms {
        exposure: f32,
        tone_map: u32,
    }
}

/// A scene's exposure and tone map as a pass.
#[derive(Debug)]
pub struct Present {
    uniforms: wgpu::Buffer,
    pass: ScreenPass,
}

impl Present {
    /// The tone map's module.
    pub const SHADER: Source = Source {
        name: "present",
        parts: &[
            part!("common/screen.wgsl"),
            part!("common/color.wgsl"),
            part!("common/srgb.wgsl"),
            part!("common/tone_map.wgsl"),
            part!("present.wgsl"),
        ],
    };

    /// What the module shares with Rust.
    pub const LAYOUTS: &[Layout] = &[PresentUniforms::LAYOUT];

    /// To targets of this format.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: &Scene, target: wgpu::TextureFormat) -> Self {
        let tone_map = match scene.tone_map {
            ToneMap::Clamp => 0,
            ToneMap::Reinhard => 1,
            ToneMap::Aces => 2,
            ToneMap::AgX => 3,
        };
        let uniforms = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("present"),
            contents: bytemuck::bytes_of(&PresentUniforms { exposure: scene.exposure, tone_map }),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        Self { uniforms, pass: ScreenPass::new(&gpu.device, "present", &Self::SHADER, "fs_present", &[], &[target]) }
    }

    /// Records the pass.
    pub fn record(&mut self, recorder: &mut Recorder<'_>, linear: &wgpu::TextureView, output: &wgpu::TextureView) {
        let bindings = [Binding::Texture(linear.clone()), Binding::Buffer(self.uniforms.clone())];
        self.pass.record(recorder, &bindings.each_ref(), &[output]);
    }

    /// A linear picture as the display shows it, not yet rounded to 8 bits.
    ///
    /// # Errors
    /// [`crate::Error::Gpu`].
    pub fn display_of(gpu: &Gpu, scene: &Scene, linear: &wgpu::Texture) -> Result<DisplayPicture> {
        let target = gpu.target(TextureSpec {
            label: "display",
            size: [linear.width(), linear.height()],
            format: wgpu::TextureFormat::Rgba32Float,
            samples: 1,
        });
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = gpu.encoder();
        Self::new(gpu, scene, target.format()).record(&mut Recorder::new(&mut encoder), &view(linear), &view(&target));
        gpu.submit(encoder)?;
        let coded: LinearPicture = gpu.read_linear(&target)?;
        DisplayPicture::new(coded.width(), coded.height(), coded.into_pixels())
    }
}
