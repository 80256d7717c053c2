//! Anti-aliasing for wgpu, and the bench that scores it: speed against error.
//!
//! Three feature sets keep what you pay for small:
//!
//! | feature | what it brings | what it pulls in |
//! | --- | --- | --- |
//! | `passes` | methods as passes on your own wgpu device ([`methods`], [`pass`], [`sampling`]) | wgpu, glam, bytemuck |
//! | `score` | pictures, metrics, reports ([`picture`], [`metrics`], [`report`]) | image, flip-rs, maud, ...; no GPU stack |
//! | `workbench` (default) | scenes, the forward renderer, captures, the bench, the command | all of it |
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
//! # A method in a program of your own
//!
//! A technique says what it needs; the pass it builds asks for draws until it has enough, and records its work into your encoder:
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
//! while let Some(draw) = pass.next_draw(k) {
//!     // Draw your scene here as `draw` says: into `color` (here of `draw.samples` samples a pixel), moved by its jitter, or
//!     // into the sum or output that `draw.target` names.
//!     let still = glam::Mat4::IDENTITY.to_cols_array_2d();
//!     let frame = FrameFacts { index: 0, reset: true, exposure: 1.0, previous_clip_from_clip: still };
//!     let inputs = Inputs { color, samples: None, depth: None, motion: None, ids: None, frame };
//!     pass.record(&mut Recorder::new(&mut encoder), k, &inputs, output);
//!     k += 1;
//! }
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! ```

#[cfg(feature = "workbench")]
pub mod bench;
#[cfg(feature = "workbench")]
pub mod capture;
#[cfg(feature = "workbench")]
pub mod cli;
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
