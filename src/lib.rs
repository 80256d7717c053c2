//! Anti-aliasing for wgpu, and the bench that scores it: speed against error.
//!
//! # In a program of your own
//!
//! A pass on your wgpu device, in your encoder, between your own passes (`examples/embed.rs` is a whole program):
//!
//! ```
//! # #[cfg(feature = "passes")]
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use dejag::methods::Spec;
//! use dejag::pass::{Context, Inputs, Recorder, Surface};
//! use wgpu::TextureUsages as Usages;
//!
//! # let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
//! # descriptor.backends = wgpu::Backends::NOOP;
//! # descriptor.backend_options.noop.enable = true;
//! # let adapter = pollster::block_on(wgpu::Instance::new(descriptor).request_adapter(&Default::default()))?;
//! # let limits = wgpu::DeviceDescriptor { required_limits: wgpu::Limits::downlevel_defaults(), ..Default::default() };
//! # let (device, queue) = pollster::block_on(adapter.request_device(&limits))?;
//! # let size = [640, 360];
//! # let target = |usage| {
//! #     let texture = device.create_texture(&wgpu::TextureDescriptor {
//! #         label: None,
//! #         size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
//! #         mip_level_count: 1,
//! #         sample_count: 1,
//! #         dimension: wgpu::TextureDimension::D2,
//! #         format: wgpu::TextureFormat::Rgba8UnormSrgb,
//! #         usage,
//! #         view_formats: &[],
//! #     });
//! #     texture.create_view(&Default::default())
//! # };
//! // Once, and again for another size or other options:
//! let scene = target(Usages::RENDER_ATTACHMENT | Usages::TEXTURE_BINDING); // your picture: the pass reads it
//! let output = target(Usages::RENDER_ATTACHMENT); // the pass writes it
//! let surface = Surface::display(wgpu::TextureFormat::Rgba8UnormSrgb);
//! let spec = Spec::parse("smaa:preset=high")?;
//! let technique = &spec.stages[0].technique;
//! technique.needs().check("smaa", device.features(), &[1, 4])?;
//! let context = Context { device: &device, queue: &queue, size, input: surface, input_samples: 1, output: surface };
//! let mut smaa = technique.build(&context)?;
//!
//! // Every frame:
//! let mut encoder = device.create_command_encoder(&Default::default());
//! // ... draw your scene into `scene` ...
//! smaa.record(&mut Recorder::new(&mut encoder), 0, &Inputs::picture(&scene), &output);
//! // ... draw text and menus over `output`, where they stay sharp ...
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "passes"))]
//! # fn main() {}
//! ```
//!
//! - A spec is what the command line takes: a method, its options, `+` and the next stage ([`methods::METHODS`] has all of them).
//!   Each stage is a pass of its own that reads what the one before it wrote.
//! - A [`pass::Surface`] says what numbers mean. [`display`](pass::Surface::display) is a finished picture; through an `-srgb`
//!   format shaders see it in linear light, and the pass knows. [`linear`](pass::Surface::linear) is light in [0, 1], as before an
//!   `-srgb` swap chain; tone-map first. Input and output may differ in format. The format is the view's, and so is the size.
//! - What a pass reads has the usage `TEXTURE_BINDING`, what it writes `RENDER_ATTACHMENT`; they are two textures. A view of one
//!   mip or one layer will do.
//! - [`pass::Needs`] tells before anything is built whether a method filters or draws, which device features it asks for, and
//!   whether it reads depth or object ids. Filters ask for no features and no more than `wgpu::Limits::downlevel_defaults()`.
//! - A frame makes no pipelines, buffers or textures and reads nothing back. Bind groups are kept while the input view stays the
//!   same: keep the view, do not make it anew each frame.
//! - Alpha is kept: blended as the colours are where pixels blend, untouched elsewhere.
//!
//! # Methods that draw
//!
//! `ssaa` and `msaa` ask for draws until they have enough:
//!
//! ```no_run
//! # #[cfg(feature = "passes")]
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue, output: &wgpu::TextureView, color: &wgpu::TextureView) -> dejag::Result<()> {
//! use dejag::methods::Spec;
//! use dejag::pass::{Context, FrameFacts, Inputs, Recorder, Surface};
//!
//! let spec = Spec::parse("msaa:samples=4,resolve=mitchell,weight=luma")?;
//! let surface = Surface::linear(wgpu::TextureFormat::Rgba16Float);
//! let size = [1280, 720];
//! let mut pass = spec.stages[0].technique.build(&Context { device, queue, size, input: surface, input_samples: 1, output: surface })?;
//!
//! let mut encoder = device.create_command_encoder(&Default::default());
//! let mut k = 0;
//! while let Some(draw) = pass.next_draw(k, &FrameFacts::default()) {
//!     // Draw your scene here as `draw` says: into `color` (here of `draw.samples` samples a pixel), moved by its jitter, or
//!     // into the sum or output that `draw.target` names.
//!     pass.record(&mut Recorder::new(&mut encoder), k, &Inputs::picture(color), output);
//!     k += 1;
//! }
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! # fn main() {}
//! ```
//!
//! # Methods with history
//!
//! `taa` draws once a frame, and the frames before are part of its picture:
//!
//! ```no_run
//! # #[cfg(feature = "passes")]
//! # struct Camera;
//! # #[cfg(feature = "passes")]
//! # impl Camera {
//! #     fn cut(&self) -> bool { false }
//! #     fn previous_clip_from_clip(&self) -> [[f32; 4]; 4] { [[0.0; 4]; 4] }
//! # }
//! # #[cfg(feature = "passes")]
//! # fn frames(device: &wgpu::Device, queue: &wgpu::Queue, camera: &Camera, output: &wgpu::TextureView,
//! #     [color, motion, depth, ids]: [&wgpu::TextureView; 4]) -> dejag::Result<()> {
//! use dejag::methods::Spec;
//! use dejag::pass::{Context, FrameFacts, Inputs, Recorder, Surface};
//!
//! let spec = Spec::parse("taa:preset=balanced")?;
//! let technique = &spec.stages[0].technique;
//! let extras = technique.needs().extras; // which of motion, depth and ids it reads
//! let surface = Surface::linear(wgpu::TextureFormat::Rgba16Float);
//! let size = [1280, 720];
//! let mut taa = technique.build(&Context { device, queue, size, input: surface, input_samples: 1, output: surface })?;
//!
//! for index in 0.. {
//!     let mut frame = FrameFacts {
//!         index,
//!         reset: index == 0 || camera.cut(),
//!         // Of the camera without jitter, both times.
//!         previous_clip_from_clip: camera.previous_clip_from_clip(),
//!         ..FrameFacts::default()
//!     };
//!     let mut encoder = device.create_command_encoder(&Default::default());
//!     let Some(draw) = taa.next_draw(0, &frame) else { break };
//!     // In pixels from the pixel's centre, y down: this is where the scene is sampled, so move it the other way. In clip space,
//!     // times w, that is by [-2.0 * x / width, 2.0 * y / height].
//!     frame.jitter_px = draw.jitters[0].offset_px;
//!     // ... draw your scene so into `color` and `depth`, and into `motion` and `ids` beside them ...
//!     let beside = Inputs { motion: Some(motion), depth: Some(depth), ids: Some(ids), ..Inputs::picture(color) };
//!     taa.record(&mut Recorder::new(&mut encoder), 0, &Inputs { frame, ..beside }, output);
//!     // ... tone-map `output`, draw text and menus over it ...
//!     queue.submit([encoder.finish()]);
//! }
//! # Ok(())
//! # }
//! # fn main() {}
//! ```
//!
//! - **Motion** is in pixels, right and down, from where a surface is now to where it was in the frame before, of both cameras
//!   *without* jitter. Any float format with two channels will do; a half holds 10 px to 1/128 px. Where nothing is drawn, write
//!   how the sky moves, or leave zeroes there and say `background=camera`.
//! - **Depth** is reversed, 1 near and 0 far: a depth texture, without its stencil. **Ids** are an r32uint texture, the same number
//!   for the same object in each frame, 0 for the background. Both are drawn with the frame's jitter, as the colour is.
//! - **Reset** where the frame before has nothing to do with this one: a cut, a teleport. A new size is a new pass. A frame that was
//!   not drawn needs no reset if motion leads from this frame to the last one that was.
//! - **One frame a submission**: what a frame is told is written through the queue, so two frames of a pass in one submission would
//!   both be told the later one's.
//! - The index only says which jitter is next; count it up for each frame that is drawn.
//! - `smaa:mode=t2x` and `4x` are driven in the same way, on display values. `4x` asks for two draws a frame (`next_draw(0)`,
//!   `next_draw(1)`), and to both an index that does not follow the last one is a reset.
//!
//! # A capture
//!
//! ```no_run
//! use dejag::capture::Studio;
//! use dejag::gpu::{AdapterChoice, Gpu};
//! use dejag::methods::Spec;
//! use dejag::picture::BitDepth;
//! use dejag::scene::Scene;
//!
//! # #[cfg(feature = "workbench")]
//! fn main() -> dejag::Result<()> {
//!     let gpu = Gpu::open(&AdapterChoice::Auto)?;
//!     let scene = Scene::load("courtyard")?;
//!     let spec = Spec::parse("ssaa:spp=64,filter=mitchell")?;
//!     let capture = Studio::new(&gpu, &scene)?.capture(&spec, 0, [1280, 720], &mut ())?;
//!     capture.display.save_png("courtyard.png".as_ref(), BitDepth::Eight, &[])
//! }
//! # #[cfg(not(feature = "workbench"))]
//! # fn main() {}
//! ```
//!
//! # Features
//!
//! Three feature sets keep what you pay for small:
//!
//! | feature | what it brings | what it pulls in |
//! | --- | --- | --- |
//! | `passes` | methods as passes on your own wgpu device ([`methods`], [`pass`], [`sampling`]) | wgpu, glam, bytemuck |
//! | `score` | pictures, metrics, reports ([`picture`], [`metrics`], [`report`]), and of the command what needs no GPU | image, flip-rs, maud, clap, ...; no GPU stack |
//! | `workbench` (default) | scenes, the forward renderer, captures, the bench, the whole command | all of it |

#[cfg(feature = "workbench")]
pub mod bench;
#[cfg(feature = "workbench")]
pub mod capture;
#[cfg(feature = "score")]
pub mod check;
#[cfg(feature = "score")]
pub mod cli;
#[cfg(feature = "score")]
pub mod compare;
pub mod error;
#[cfg(feature = "workbench")]
pub mod forward;
#[cfg(feature = "workbench")]
pub mod gpu;
#[cfg(feature = "passes")]
pub mod methods;
#[cfg(feature = "score")]
pub mod metrics;
#[cfg(feature = "passes")]
pub mod pass;
#[cfg(feature = "score")]
pub mod picture;
#[cfg(feature = "score")]
pub mod report;
#[cfg(feature = "passes")]
pub mod sampling;
#[cfg(feature = "workbench")]
pub mod scene;
#[cfg(feature = "passes")]
pub mod shader;
#[cfg(feature = "score")]
pub mod suite;

pub use error::{Error, Result};
