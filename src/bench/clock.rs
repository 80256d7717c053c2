//! How long each GPU pass takes.
//!
//! On a GPU: timestamps on the encoder before and after each pass. On a software adapter timestamps lie for compute and for light
//! passes in mixed submissions, so each pass gets a submission of its own and the wall clock runs from submitting to its end;
//! recording is not counted.

use std::time::Instant;

use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::pass::Timer;

/// Pairs of timestamps kept before they are read: more passes than that in one picture are not timed.
const MOST_PASSES: u32 = 2048;

/// A pass and how long one run of it took.
#[derive(Debug, Clone, PartialEq)]
pub struct PassTime {
    /// Its label.
    pub label: String,
    /// Milliseconds.
    pub ms: f64,
}

/// A clock for one taking of a shot.
#[derive(Debug)]
pub struct Clock<'a> {
    gpu: &'a Gpu,
    kind: Kind,
    passes: Vec<PassTime>,
    failure: Option<Error>,
}

#[derive(Debug)]
enum Kind {
    Wall,
    Stamps { queries: wgpu::QuerySet, labels: Vec<String> },
}

impl<'a> Clock<'a> {
    /// The kind that tells the truth on this device.
    #[must_use]
    pub fn new(gpu: &'a Gpu) -> Self {
        let wanted = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
        let kind = if gpu.is_software() || !gpu.device.features().contains(wanted) {
            Kind::Wall
        } else {
            let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("clock"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST_PASSES,
            });
            Kind::Stamps { queries, labels: Vec::new() }
        };
        Self { gpu, kind, passes: Vec::new(), failure: None }
    }

    /// What kind of clock it is, in words.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self.kind {
            Kind::Wall => "wall clock",
            Kind::Stamps { .. } => "timestamps",
        }
    }

    /// Every pass that ran, in order.
    ///
    /// # Errors
    /// [`Error::Gpu`] if a submission failed or timestamps could not be read.
    pub fn finish(self) -> Result<Vec<PassTime>> {
        if let Some(failure) = self.failure {
            return Err(failure);
        }
        match self.kind {
            Kind::Wall => Ok(self.passes),
            Kind::Stamps { queries, labels } => read_stamps(self.gpu, &queries, labels),
        }
    }

    fn submit(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let recorded = std::mem::replace(encoder, self.gpu.encoder()).finish();
        self.gpu.queue.submit([recorded]);
        self.keep(self.gpu.wait());
    }

    fn keep(&mut self, outcome: Result<()>) {
        if let Err(error) = outcome {
            self.failure.get_or_insert(error);
        }
    }
}

impl Timer for Clock<'_> {
    fn before(&mut self, encoder: &mut wgpu::CommandEncoder) {
        match &self.kind {
            // Whatever was recorded before must not be timed with the pass.
            Kind::Wall => self.submit(encoder),
            Kind::Stamps { queries, labels } if labels.len() < MOST_PASSES as usize => {
                encoder.write_timestamp(queries, 2 * labels.len() as u32);
            }
            Kind::Stamps { .. } => {}
        }
    }

    fn after(&mut self, encoder: &mut wgpu::CommandEncoder, label: &str) {
        match &mut self.kind {
            Kind::Wall => {
                let recorded = std::mem::replace(encoder, self.gpu.encoder()).finish();
                let start = Instant::now();
                self.gpu.queue.submit([recorded]);
                let outcome = self.gpu.wait();
                self.passes.push(PassTime { label: label.to_owned(), ms: 1e3 * start.elapsed().as_secs_f64() });
                self.keep(outcome);
            }
            Kind::Stamps { queries, labels } => {
                if labels.len() < MOST_PASSES as usize {
                    encoder.write_timestamp(queries, 2 * labels.len() as u32 + 1);
                    labels.push(label.to_owned());
                }
            }
        }
    }
}

fn read_stamps(gpu: &Gpu, queries: &wgpu::QuerySet, labels: Vec<String>) -> Result<Vec<PassTime>> {
    let count = 2 * labels.len() as u32;
    if count == 0 {
        return Ok(Vec::new());
    }
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("timestamps"),
        size: u64::from(count) * 8,
        usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.encoder();
    encoder.resolve_query_set(queries, 0..count, &buffer, 0);
    gpu.submit(encoder)?;
    let bytes = gpu.read_buffer(&buffer)?;
    let ticks: Vec<u64> = bytes.as_chunks::<8>().0.iter().map(|b| u64::from_ne_bytes(*b)).collect();
    let ms_per_tick = f64::from(gpu.queue.get_timestamp_period()) * 1e-6;
    let times = ticks.as_chunks::<2>().0.iter().map(|[start, end]| end.saturating_sub(*start) as f64 * ms_per_tick);
    Ok(labels.into_iter().zip(times).map(|(label, ms)| PassTime { label, ms }).collect())
}
