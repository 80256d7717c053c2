//! Recording GPU passes, with an optional clock around each.

/// Wraps the host's encoder. Passes begin their render and compute passes through it, so that a bench can time each by itself.
#[derive(Debug)]
pub struct Recorder<'a> {
    encoder: &'a mut wgpu::CommandEncoder,
    timer: Option<&'a mut dyn Timer>,
}

/// Is told where each GPU pass begins and ends. It may submit the encoder and put a fresh one in its place.
pub trait Timer: std::fmt::Debug {
    /// Before the pass is begun.
    fn before(&mut self, encoder: &mut wgpu::CommandEncoder);
    /// After the pass has ended.
    fn after(&mut self, encoder: &mut wgpu::CommandEncoder, label: &str);
}

impl<'a> Recorder<'a> {
    /// Without a clock.
    #[must_use]
    pub fn new(encoder: &'a mut wgpu::CommandEncoder) -> Self {
        Self { encoder, timer: None }
    }

    /// With a clock around each pass.
    #[must_use]
    pub fn timed(encoder: &'a mut wgpu::CommandEncoder, timer: &'a mut dyn Timer) -> Self {
        Self { encoder, timer: Some(timer) }
    }

    /// One render pass.
    pub fn render(&mut self, descriptor: &wgpu::RenderPassDescriptor<'_>, record: impl FnOnce(&mut wgpu::RenderPass<'_>)) {
        self.clocked(descriptor.label.unwrap_or_default(), |encoder| record(&mut encoder.begin_render_pass(descriptor)));
    }

    /// One compute pass.
    pub fn compute(&mut self, label: &str, record: impl FnOnce(&mut wgpu::ComputePass<'_>)) {
        let descriptor = wgpu::ComputePassDescriptor { label: Some(label), timestamp_writes: None };
        self.clocked(label, |encoder| record(&mut encoder.begin_compute_pass(&descriptor)));
    }

    /// Anything else on the encoder, such as a copy, under one label.
    pub fn clocked(&mut self, label: &str, record: impl FnOnce(&mut wgpu::CommandEncoder)) {
        if let Some(timer) = &mut self.timer {
            timer.before(self.encoder);
        }
        record(self.encoder);
        if let Some(timer) = &mut self.timer {
            timer.after(self.encoder, label);
        }
    }
}
