//! A function over pixels, on the CPU.

use super::super::super::watch::Bar;
use super::super::pixel_means::PixelSets;
use super::super::uses_seed;
use super::source::{Sampled, Source};
use crate::error::Result;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::sampling::PatternSpec;
use crate::sampling::integrals::PixelTest;

/// Of these each pixel has one by chance: that some share theirs does not show.
const POOL: u32 = 1024;

pub(super) struct Function {
    name: &'static str,
    about: &'static str,
    test: PixelTest,
    sets: PixelSets,
}

impl Function {
    pub(super) fn new(name: &'static str, about: &'static str, seed: u32) -> Result<Self> {
        let sets = PixelSets { seed, pool: Some(POOL), shift: false };
        Ok(Self { name, about, test: PixelTest::new(name, 0.0)?, sets })
    }

    /// With the same set in all pixels, as where a scene is drawn.
    pub(super) fn with_one_set(mut self) -> Self {
        self.sets.pool = Some(1);
        self
    }

    fn has_one_set(&self) -> bool {
        self.sets.pool == Some(1)
    }

    /// The exact means and these errors as grey.
    fn picture(&self, error: impl Fn(usize) -> f64) -> Result<DisplayPicture> {
        // These tests are pictures: their pixels fill a square.
        let side = self.test.pixels().isqrt() as u32;
        let grey = |x: u32, y: u32| {
            let pixel = (y * side + x) as usize;
            let value = (self.test.exact(pixel) + error(pixel)) as f32;
            [value, value, value, 1.0]
        };
        Ok(LinearPicture::from_fn(side, side, grey)?.to_display())
    }
}

impl Source for Function {
    fn name(&self) -> String {
        format!("function {}{}", self.name, if self.has_one_set() { ", one set" } else { "" })
    }

    fn about(&self) -> String {
        self.about.into()
    }

    fn known_by(&self) -> String {
        "exact means".into()
    }

    fn work(&self) -> u64 {
        0
    }

    fn exact(&mut self, _: &mut Bar) -> Result<DisplayPicture> {
        self.picture(|_| 0.0)
    }

    fn sampled(&mut self, spec: &PatternSpec, spp: u32, _: &mut Bar) -> Result<Sampled> {
        let seeded = uses_seed(spec)?;
        let errors = self.sets.errors(&self.test, spec, seeded, spp)?;
        // The first part is that of all pixels which have something to show.
        let rms = self.test.rms(&errors)[0].1;
        Ok(Sampled {
            picture: self.picture(|pixel| errors[pixel])?,
            sets: self.sets.describe(seeded && !self.has_one_set()),
            rms,
        })
    }
}
