//! The temporal half of T2x and 4x: a frame averaged with the one before it.
//!
//! After Jimenez et al. 2012 and Jimenez's shader of 2013. Both frames count alike, the one before as it was filtered and not as it
//! was resolved, so nothing is older than a frame: no drift, no long trail, and a still picture does not flicker. It is found by
//! motion vectors, and it loses weight as its speed differs from the pixel's own, `0.5 * (1 - scale * sqrt(change))`: what has
//! just come into view has been another surface's, which mostly moved in another way. Speed counts in picture sizes a frame.
//!
//! What differs. Speeds are kept as they are instead of in an alpha channel, each of the four pixels that a motion vector points
//! between is weighed by its own, and what lies off screen has no weight. The published bilinear fetch blurs so much that T2x in motion
//! falls behind 1x; here a pixel between two pixels is put together from where edges cross them (`shaders/smaa/moved.wgsl`).
//! `edges` at 640x360 on lavapipe, moving right by 0.37 px a frame, PSNR against 1024 samples: 1x 29.2 dB; T2x with areas as
//! published and a bilinear fetch 28.1, with Catmull-Rom's 29.0, with this 30.8, with our areas besides 31.3 (still: 31.9).
//!
//! Two slots take turns, by the frame's index. So a frame that is taken again gives the same picture, and one that does not follow
//! on the last (a frame was dropped, time went back) has no history, as after a reset: motion vectors lead to the frame before only.

use crate::methods::morphology::{Blend, picture_constants, texture_bytes};
use crate::pass::{Binding, Context, FrameFacts, Inputs, Recorder, ScreenPass};
use crate::shader::{Source, part};

/// The mean of two pictures.
pub(super) const AVERAGE: Source = Source {
    name: "average",
    parts: &[
        part!("common/screen.wgsl"),
        part!("common/color.wgsl"),
        part!("common/srgb.wgsl"),
        part!("morphology/picture.wgsl"),
        part!("smaa/number.wgsl"),
        part!("smaa/average.wgsl"),
    ],
};

/// A frame with the one before it.
pub(super) const RESOLVE: Source = Source {
    name: "resolve",
    parts: &[
        part!("common/screen.wgsl"),
        part!("common/color.wgsl"),
        part!("common/srgb.wgsl"),
        part!("morphology/picture.wgsl"),
        part!("smaa/number.wgsl"),
        part!("common/moved.wgsl"),
        part!("smaa/moved.wgsl"),
        part!("smaa/resolve.wgsl"),
    ],
};

const SPEED: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// A pass that averages two pictures of the context's input into one of its output.
pub(super) fn average(context: &Context<'_>, blend: Blend) -> ScreenPass {
    let constants = picture_constants(context, blend);
    ScreenPass::new(context.device, "average", &AVERAGE, "fs_average", &constants, &[context.output.format])
}

/// A private texture of the picture's size that passes write to either way.
pub(super) fn target(context: &Context<'_>, label: &str, format: wgpu::TextureFormat) -> wgpu::TextureView {
    use wgpu::TextureUsages as Usages;
    let [width, height] = context.size;
    let texture = context.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: Usages::RENDER_ATTACHMENT
            | Usages::STORAGE_BINDING
            | Usages::TEXTURE_BINDING
            | Usages::COPY_SRC
            | Usages::COPY_DST,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// This frame and the one before, and what makes a picture of them.
#[derive(Debug)]
pub(super) struct History {
    slots: [wgpu::TextureView; 2],
    /// The frames that the slots hold.
    held: [Option<u32>; 2],
    /// The slot that was filled last.
    latest: usize,
    resolve: Resolve,
}

#[derive(Debug)]
enum Resolve {
    /// Mixed in where it stands.
    InPlace(ScreenPass),
    /// Found by motion vectors.
    Followed(Box<Followed>),
}

#[derive(Debug)]
struct Followed {
    /// Of a frame without one before it.
    first: ScreenPass,
    resolve: ScreenPass,
    speeds: [wgpu::TextureView; 2],
}

impl History {
    /// `context` has the filtered frames' surface as its input. Without a scale, no motion vectors are asked for.
    pub(super) fn new(context: &Context<'_>, blend: Blend, velocity_scale: Option<f64>) -> Self {
        let pair = |label, format| [(); 2].map(|()| target(context, label, format));
        let resolve = match velocity_scale {
            None => Resolve::InPlace(average(context, blend)),
            Some(scale) => {
                let picture = picture_constants(context, blend);
                let pass = |label, fragment, own: &[(&'static str, f64)]| {
                    let constants: Vec<_> = picture.iter().chain(own).copied().collect();
                    ScreenPass::new(context.device, label, &RESOLVE, fragment, &constants, &[context.output.format, SPEED])
                };
                Resolve::Followed(Box::new(Followed {
                    first: pass("first frame", "fs_first", &[]),
                    resolve: pass("resolve", "fs_resolve", &[("VELOCITY_SCALE", scale)]),
                    speeds: pair("speed", SPEED),
                }))
            }
        };
        Self { slots: pair("filtered frame", context.input.format), held: [None; 2], latest: 0, resolve }
    }

    fn slot(frame: &FrameFacts) -> usize {
        (frame.index & 1) as usize
    }

    /// Where the frame is to be put once it is filtered.
    pub(super) fn target(&self, frame: &FrameFacts) -> &wgpu::TextureView {
        &self.slots[Self::slot(frame)]
    }

    /// Records the picture of the frame in its slot and the one before, if that is there.
    pub(super) fn record(&mut self, recorder: &mut Recorder<'_>, inputs: &Inputs<'_>, output: &wgpu::TextureView) {
        let now = Self::slot(&inputs.frame);
        let before = 1 - now;
        if inputs.frame.reset {
            self.held = [None; 2];
        }
        let follows = self.held[before] == Some(inputs.frame.index.wrapping_sub(1));
        self.held[now] = Some(inputs.frame.index);
        self.latest = now;
        let slots = self.slots.clone().map(Binding::Texture);
        match &mut self.resolve {
            Resolve::InPlace(average) => {
                let other = if follows { before } else { now };
                average.record(recorder, &[&slots[now], &slots[other]], &[output]);
            }
            Resolve::Followed(followed) => {
                let Followed { first, resolve, speeds } = &mut **followed;
                let motion = Binding::Texture(inputs.motion.expect("motion vectors, as `Needs` asks for").clone());
                let targets = [output, &speeds[now]];
                if follows {
                    let previous_speed = Binding::Texture(speeds[before].clone());
                    resolve.record(recorder, &[&slots[now], &motion, &slots[before], &previous_speed], &targets);
                } else {
                    first.record(recorder, &[&slots[now], &motion], &targets);
                }
            }
        }
    }

    pub(super) const VIEWS: [&str; 2] = ["current", "history"];

    /// The frame that was filtered last, or what lies in the other slot.
    pub(super) fn view(&self, name: &str) -> Option<wgpu::TextureView> {
        let back = Self::VIEWS.iter().position(|known| *known == name)?;
        Some(self.slots[self.latest ^ back].clone())
    }

    pub(super) fn bytes(&self) -> u64 {
        let speeds = match &self.resolve {
            Resolve::InPlace(_) => &[][..],
            Resolve::Followed(followed) => &followed.speeds,
        };
        self.slots.iter().chain(speeds).map(texture_bytes).sum()
    }
}
