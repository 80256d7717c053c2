//! A device whose failures are kept and handed out as errors.

use std::sync::{Arc, Mutex, PoisonError};

use super::adapter::{AdapterChoice, Card, choose};
use crate::error::{Error, Result};

/// Used where the adapter has them; a method that cannot do without says so in its needs.
const WANTED: wgpu::Features = wgpu::Features::FLOAT32_BLENDABLE
    .union(wgpu::Features::FLOAT32_FILTERABLE)
    .union(wgpu::Features::DEPTH32FLOAT_STENCIL8)
    .union(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
    .union(wgpu::Features::TIMESTAMP_QUERY)
    .union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// An open device.
#[derive(Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Where it comes from.
    pub adapter: wgpu::Adapter,
    /// What the adapter says of itself.
    pub card: Card,
    failure: Arc<Mutex<Option<Error>>>,
}

impl Gpu {
    /// Opens the chosen adapter with all its limits.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if none matches; [`Error::Gpu`] if it cannot be opened.
    pub fn open(choice: &AdapterChoice) -> Result<Self> {
        let adapter = choose(choice)?;
        let features = adapter.features() & WANTED;
        let limits = adapter.limits();
        Self::from_adapter(adapter, features, limits)
    }

    /// A device of the no-op backend: everything is validated, nothing is drawn.
    ///
    /// # Errors
    /// [`Error::Gpu`] if it cannot be opened.
    pub fn noop() -> Result<Self> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::NOOP;
        descriptor.backend_options.noop.enable = true;
        let instance = wgpu::Instance::new(descriptor);
        let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::NOOP));
        let adapter = adapters.into_iter().next().ok_or_else(|| Error::NoAdapter("the no-op backend does not answer".into()))?;
        // What the no-op adapter claims for itself is meaningless: WebGPU's guarantees are what validation should go by.
        let features = adapter.features() & (WANTED - wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);
        Self::from_adapter(adapter, features, wgpu::Limits::default())
    }

    fn from_adapter(adapter: wgpu::Adapter, required_features: wgpu::Features, required_limits: wgpu::Limits) -> Result<Self> {
        let descriptor =
            wgpu::DeviceDescriptor { label: Some("dejag"), required_features, required_limits, ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|e| Error::Gpu { kind: "opening the device", message: e.to_string() })?;
        let failure = Arc::new(Mutex::new(None));
        let keep = |failure: &Arc<Mutex<Option<Error>>>, error| {
            // The first failure is the cause; what follows are consequences.
            failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        };
        let on_error = Arc::clone(&failure);
        device.on_uncaptured_error(Arc::new(move |error| keep(&on_error, named(&error))));
        let on_loss = Arc::clone(&failure);
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                keep(&on_loss, Error::Gpu { kind: "device lost", message });
            }
        });
        let card = Card::of(&adapter.get_info());
        Ok(Self { device, queue, adapter, card, failure })
    }

    /// Whether it rasterises on the CPU.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.card.kind == "software"
    }

    /// Hands out what failed since the last check.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn check(&self) -> Result<()> {
        match self.failure.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Submits and checks that nothing failed while recording.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        self.queue.submit([encoder.finish()]);
        self.check()
    }

    /// Waits until all that was submitted is done.
    ///
    /// # Errors
    /// [`Error::Gpu`].
    pub fn wait(&self) -> Result<()> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        polled.map(drop).map_err(|e| Error::Gpu { kind: "waiting", message: e.to_string() })
    }

    /// A fresh encoder.
    #[must_use]
    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("dejag") })
    }

    /// Sample counts that both rgba16float colour and the depth formats have here, ascending, 1 among them.
    #[must_use]
    pub fn sample_counts(&self) -> Vec<u32> {
        if self.device.features().contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES) {
            let flags = |format| self.adapter.get_texture_format_features(format).flags;
            let both = flags(wgpu::TextureFormat::Rgba16Float) & flags(wgpu::TextureFormat::Depth32Float);
            [1, 2, 4, 8, 16].into_iter().filter(|count| both.sample_count_supported(*count)).collect()
        } else {
            vec![1, 4]
        }
    }

    /// Refuses a picture size that the device cannot hold, before anything is allocated.
    ///
    /// # Errors
    /// [`Error::Unsupported`] with the largest side there is.
    pub fn check_size(&self, size: [u32; 2]) -> Result<()> {
        let limit = self.device.limits().max_texture_dimension_2d;
        let [width, height] = size;
        if width == 0 || height == 0 {
            return Err(Error::Request(format!(
                "a picture of {width}x{height} pixels has no pixels; both sides must be at least 1"
            )));
        }
        if width > limit || height > limit {
            return Err(Error::Unsupported(format!(
                "{width}x{height} is more than this adapter holds: its largest side is {limit} pixels ({})",
                self.card.name
            )));
        }
        Ok(())
    }
}

fn named(error: &wgpu::Error) -> Error {
    let kind = match error {
        wgpu::Error::OutOfMemory { .. } => "out of memory",
        wgpu::Error::Validation { .. } => "validation",
        wgpu::Error::Internal { .. } => "internal",
    };
    let advice = if kind == "out of memory" { "; choose a smaller size or another adapter" } else { "" };
    Error::Gpu { kind, message: format!("{error}{advice}") }
}
