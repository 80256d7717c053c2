//! A wgpu program of somebody else's, which takes an anti-aliasing pass into its own encoder.
//!
//! ```sh
//! cargo run --example embed --no-default-features --features passes [-- PICTURE.png]
//! ```
//!
//! In your own `Cargo.toml`, wgpu's backends are yours to choose; the passes ask for none:
//!
//! ```toml
//! dejag = { version = "0.1", default-features = false, features = ["passes"] }
//! wgpu = "30"
//! ```
//!
//! It draws a turning fan, smooths it with `smaa`, draws a sharp frame over it, and does that for a few frames: half way it is
//! resized, and later its user asks for other options. Then it writes the last frame.

#![expect(clippy::print_stdout, reason = "it is a program of its own")]

use std::error::Error;
use std::path::{Path, PathBuf};

use dejag::methods::Spec;
use dejag::pass::{Context, Inputs, Pass, Recorder, Surface};

/// What the scene is drawn into and what comes out: display values, in and out of shaders as linear light.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("captures/out/embed.png"), PathBuf::from);
    let (device, queue) = pollster::block_on(open())?;
    let scene = Scene::new(&device);
    let mut stage = Stage::new(&device, &queue, [640, 360], "smaa")?;
    for frame in 0..12 {
        match frame {
            // Another size or other options: another pass. Everything else of a frame stays as it is.
            4 => stage = Stage::new(&device, &queue, [854, 480], "smaa")?,
            8 => stage = Stage::new(&device, &queue, stage.size, "smaa:preset=ultra,blend=coded")?,
            _ => {}
        }
        stage.draw(&device, &queue, &scene, frame);
    }
    write_png(&out, stage.size, &read_back(&device, &queue, &stage.output)?)?;
    println!("{}", out.display());
    Ok(())
}

/// The least of devices: the passes ask for no features and no more than these limits.
async fn open() -> Result<(wgpu::Device, wgpu::Queue), Box<dyn Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await?;
    println!("{}", adapter.get_info().name);
    let descriptor = wgpu::DeviceDescriptor { required_limits: wgpu::Limits::downlevel_defaults(), ..Default::default() };
    Ok(adapter.request_device(&descriptor).await?)
}

/// Everything that depends on the size: the host's own targets, and the pass between them.
struct Stage {
    size: [u32; 2],
    /// What the host draws. A pass reads it: it needs `TEXTURE_BINDING`.
    scene: wgpu::TextureView,
    /// What the pass writes, `RENDER_ATTACHMENT`. The host goes on drawing over it.
    output: wgpu::TextureView,
    pass: Box<dyn Pass>,
}

impl Stage {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue, size: [u32; 2], method: &str) -> dejag::Result<Self> {
        let spec = Spec::parse(method)?;
        let technique = &spec.stages[0].technique;
        // Only a method that draws with other sample counts than these, or sums, would ask for more.
        technique.needs().check(method, device.features(), &[1, 4])?;
        let surface = Surface::display(FORMAT);
        let pass = technique.build(&Context { device, queue, size, input: surface, input_samples: 1, output: surface })?;
        let target = |usage| target(device, size, wgpu::TextureUsages::RENDER_ATTACHMENT | usage);
        let (scene, output) = (target(wgpu::TextureUsages::TEXTURE_BINDING), target(wgpu::TextureUsages::COPY_SRC));
        Ok(Self { size, scene, output, pass })
    }

    /// One frame, in one encoder: the host's scene, the pass, the host's overlay.
    fn draw(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, scene: &Scene, frame: u16) {
        scene.turn_to(queue, self.size, 0.03 * f32::from(frame));
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        scene.fan(&mut encoder, &self.scene);
        self.pass.record(&mut Recorder::new(&mut encoder), 0, &Inputs::picture(&self.scene), &self.output);
        scene.overlay(&mut encoder, &self.output, self.size);
        queue.submit([encoder.finish()]);
    }
}

fn target(device: &wgpu::Device, [width, height]: [u32; 2], usage: wgpu::TextureUsages) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// What the host draws by itself.
struct Scene {
    fan: wgpu::RenderPipeline,
    overlay: wgpu::RenderPipeline,
    turn: wgpu::Buffer,
    bindings: wgpu::BindGroup,
}

impl Scene {
    fn new(device: &wgpu::Device) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("embed.wgsl"));
        let pipeline = |vertex| {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(vertex),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fs_color"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(FORMAT.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let (fan, overlay) = (pipeline("vs_fan"), pipeline("vs_overlay"));
        let turn = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("turn"),
            size: 64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let entries = [wgpu::BindGroupEntry { binding: 0, resource: turn.as_entire_binding() }];
        let layout = fan.get_bind_group_layout(0);
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        Self { fan, overlay, turn, bindings }
    }

    fn turn_to(&self, queue: &wgpu::Queue, [width, height]: [u32; 2], angle: f32) {
        let round = glam::Mat4::from_scale(glam::vec3(height as f32 / width as f32, 1.0, 1.0));
        let rotation = round * glam::Mat4::from_rotation_z(angle);
        queue.write_buffer(&self.turn, 0, bytemuck::bytes_of(&rotation.to_cols_array()));
    }

    fn fan(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView) {
        let dark = wgpu::Color { r: 0.01, g: 0.012, b: 0.02, a: 1.0 };
        let mut pass = begin(encoder, target, wgpu::LoadOp::Clear(dark));
        pass.set_pipeline(&self.fan);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.draw(0..3 * 17, 0..1);
    }

    /// What has to stay sharp, text or a cursor, is drawn after the pass.
    fn overlay(&self, encoder: &mut wgpu::CommandEncoder, target: &wgpu::TextureView, [width, height]: [u32; 2]) {
        let mut pass = begin(encoder, target, wgpu::LoadOp::Load);
        pass.set_pipeline(&self.overlay);
        for [x, y, w, h] in [[0, 0, width, 2], [0, height - 2, width, 2], [0, 0, 2, height], [width - 2, 0, 2, height]] {
            pass.set_scissor_rect(x, y, w, h);
            pass.draw(0..3, 0..1);
        }
    }
}

fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'e> {
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    let attachment = wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor { color_attachments: &[Some(attachment)], ..Default::default() })
}

/// The picture's bytes, without the padding that rows of a copy have.
fn read_back(device: &wgpu::Device, queue: &wgpu::Queue, view: &wgpu::TextureView) -> Result<Vec<u8>, Box<dyn Error>> {
    let texture = view.texture();
    let row = 4 * texture.width();
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: u64::from(padded) * u64::from(texture.height()),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    // Without a mapping there is no range to be had below, and that says so.
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let mapped = buffer.get_mapped_range(..)?;
    Ok(mapped.chunks(padded as usize).flat_map(|padded| &padded[..row as usize]).copied().collect())
}

fn write_png(path: &Path, [width, height]: [u32; 2], bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut encoder = png::Encoder::new(std::io::BufWriter::new(std::fs::File::create(path)?), width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.write_header()?.write_image_data(bytes)?;
    Ok(())
}
