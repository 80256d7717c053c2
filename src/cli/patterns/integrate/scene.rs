//! A scene, on the GPU.

use super::super::super::capture::load;
use super::super::super::watch::{Bar, check_interrupt};
use super::super::drawn_means::{method, rms};
use super::Integrate;
use crate::capture::{Cache, Studio};
use crate::error::Result;
use crate::methods::Spec;
use crate::sampling::PatternSpec;
use crate::scene::Tick;
use crate::suite::{IntegralError, IntegralRow};

impl Integrate {
    /// Each pattern at each number of samples through `ssaa` under a box filter.
    pub(super) fn on_scene(&self, name: &str, specs: &[PatternSpec], counts: &[u32]) -> Result<Vec<IntegralRow>> {
        let reference = Spec::parse(&self.reference)?;
        let of_spec = |spec: &PatternSpec| counts.iter().map(|&spp| method(spec, self.seed, spp)).collect::<Result<Vec<Spec>>>();
        let methods: Vec<Vec<Spec>> = specs.iter().map(of_spec).collect::<Result<_>>()?;
        let scene = load(name, self.drawing.quiet)?;
        let gpu = self.drawing.open()?;
        gpu.check_size(self.size)?;
        let mut studio = Studio::new(&gpu, &scene)?;
        let samples = specs.len() as u64 * counts.iter().map(|spp| u64::from(*spp)).sum::<u64>();
        let drawn_for_reference = u64::from(reference.first_needs().samples_per_pixel);
        let mut bar = Bar::new(drawn_for_reference + samples, self.drawing.quiet);
        bar.say(format!("{} {reference}", scene.name));
        let exact = studio.reference(&reference, &Tick::of(&scene, 0), self.size, &Cache::of_user(), &mut bar)?.linear;
        bar.advance(drawn_for_reference);
        let mut rows = Vec::new();
        for (spec, methods) in specs.iter().zip(&methods) {
            let mut errors = Vec::new();
            for (method, &spp) in methods.iter().zip(counts) {
                bar.say(format!("{} {method}", scene.name));
                let capture = studio.capture(method, 0, self.size, &mut bar)?;
                check_interrupt()?;
                let linear = capture.linear.unwrap_or_else(|| capture.display.to_linear());
                errors.push(IntegralError { spp, rms: rms(&linear, &exact, scene.exposure) });
                bar.advance(u64::from(spp));
            }
            rows.push(IntegralRow {
                test: scene.name.clone(),
                part: "all".into(),
                pattern: spec.to_string(),
                sets: "fixed".into(),
                slope: IntegralRow::slope_of(&errors),
                errors,
            });
        }
        Ok(rows)
    }
}
