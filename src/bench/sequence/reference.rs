//! The reference sequence: each frame supersampled, and the motion between them.

use std::time::Instant;

use super::{Moment, SequenceRequest};
use crate::bench::score::exposed;
use crate::capture::{Cache, GeometryShot, Halves, Studio, Watch};
use crate::error::Result;
use crate::metrics::temporal::{Flow, Truth, Yardstick};
use crate::picture::LinearPicture;
use crate::scene::Tick;
use crate::suite::{NoiseFloor, SequenceReference, SequenceReferenceTiming};

/// Makes the reference a frame at a time.
pub(super) struct ReferenceRun<'a> {
    request: &'a SequenceRequest,
    cache: &'a Cache,
    geometry: GeometryShot,
    yardstick: Yardstick,
    before: Option<Tick>,
    /// Of the frames so far.
    halves: Vec<Option<Halves>>,
    seconds: f64,
    cached: u32,
}

impl<'a> ReferenceRun<'a> {
    pub(super) fn new(studio: &Studio<'_>, request: &'a SequenceRequest, cache: &'a Cache) -> Result<Self> {
        let geometry = GeometryShot::new(studio, request.size)?;
        let yardstick = Yardstick::default();
        Ok(Self { request, cache, geometry, yardstick, before: None, halves: Vec::new(), seconds: 0.0, cached: 0 })
    }

    /// The next frame, and its linear values as they are without exposure.
    pub(super) fn next(
        &mut self,
        studio: &mut Studio<'_>,
        moment: &Moment,
        watch: &mut dyn Watch,
    ) -> Result<(Truth, LinearPicture)> {
        let start = Instant::now();
        let SequenceRequest { reference, size, .. } = self.request;
        let right = studio.reference(reference, &moment.tick, *size, self.cache, watch)?;
        let flow = match self.before.replace(moment.tick) {
            Some(before) if !moment.reset => Some(self.flow(studio, &before, &moment.tick)?),
            _ => None,
        };
        let linear = exposed(&right.linear, studio.scene.exposure)?;
        let truth = self.yardstick.next(right.display, linear, flow);
        self.halves.push(right.halves);
        self.cached += u32::from(right.cached);
        self.seconds += start.elapsed().as_secs_f64();
        Ok((truth, right.linear))
    }

    /// The way back from now, and the way forth from before.
    fn flow(&mut self, studio: &mut Studio<'_>, before: &Tick, now: &Tick) -> Result<Flow> {
        let forth = Tick { previous_time_s: now.time_s, previous_shift_px: now.shift_px, ..*before };
        let [back, forth] = [now, &forth].map(|tick| self.geometry.take(studio, tick));
        Flow::new(self.request.size, back?.motion_px, forth?.motion_px)
    }

    pub(super) fn result(&self) -> SequenceReference {
        let halves: Option<Vec<Halves>> = self.halves.iter().copied().collect();
        let noise_floor = halves.filter(|halves| !halves.is_empty()).map(|halves| NoiseFloor {
            rms: (halves.iter().map(|h| h.rms * h.rms).sum::<f64>() / halves.len() as f64).sqrt(),
            max: halves.iter().map(|h| h.max).fold(0.0, f64::max),
        });
        let timing = SequenceReferenceTiming { seconds: self.seconds, cached: self.cached };
        SequenceReference { spec: self.request.reference.to_string(), noise_floor, timing }
    }
}
