//! A scene, on the GPU.

use super::super::super::watch::Bar;
use super::super::drawn_means::{method, rms};
use super::source::{Sampled, Source};
use crate::capture::{Cache, Studio};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::sampling::PatternSpec;
use crate::scene::{Scene, Tick};

pub(super) struct Drawn<'a> {
    scene: &'a Scene,
    studio: Studio<'a>,
    size: [u32; 2],
    seed: u32,
    reference: &'a Spec,
    cache: &'a Cache,
    /// Once it was asked for.
    exact: Option<LinearPicture>,
}

impl<'a> Drawn<'a> {
    pub(super) fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        size: [u32; 2],
        seed: u32,
        reference: &'a Spec,
        cache: &'a Cache,
    ) -> Result<Self> {
        Ok(Self { scene, studio: Studio::new(gpu, scene)?, size, seed, reference, cache, exact: None })
    }
}

impl Source for Drawn<'_> {
    fn name(&self) -> String {
        format!("scene {}", self.scene.name)
    }

    fn about(&self) -> String {
        format!("{}; drawn, one set for all pixels", self.scene.about)
    }

    fn known_by(&self) -> String {
        self.reference.to_string()
    }

    fn work(&self) -> u64 {
        u64::from(self.reference.first_needs().samples_per_pixel)
    }

    fn exact(&mut self, bar: &mut Bar) -> Result<DisplayPicture> {
        let reference = self.studio.reference(self.reference, &Tick::of(self.scene, 0), self.size, self.cache, bar)?;
        self.exact = Some(reference.linear);
        Ok(reference.display)
    }

    fn sampled(&mut self, spec: &PatternSpec, spp: u32, bar: &mut Bar) -> Result<Sampled> {
        let capture = self.studio.capture(&method(spec, self.seed, spp)?, 0, self.size, bar)?;
        let linear = capture.linear.unwrap_or_else(|| capture.display.to_linear());
        let rms = self.exact.as_ref().map_or(f64::NAN, |exact| rms(&linear, exact, self.scene.exposure));
        Ok(Sampled { picture: capture.display, sets: "fixed", rms })
    }
}
