//! Which adapter is used, and what it says of itself.

use std::fmt;
use std::str::FromStr;

use crate::error::{Error, Result};

/// Which adapter to use.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum AdapterChoice {
    /// A discrete GPU, else an integrated one, else a virtual one, else software.
    #[default]
    Auto,
    /// A software rasteriser, never a GPU.
    Software,
    /// The first whose name contains this, whatever the case.
    Named(String),
}

impl FromStr for AdapterChoice {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text {
            "auto" => Self::Auto,
            "software" => Self::Software,
            name => Self::Named(name.to_owned()),
        })
    }
}

impl fmt::Display for AdapterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Software => f.write_str("software"),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// What an adapter says of itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Card {
    /// Its name.
    pub name: String,
    /// `discrete`, `integrated`, `virtual`, `software` or `other`.
    pub kind: &'static str,
    /// The driver's name.
    pub driver: String,
    /// The driver's version, as it states it.
    pub driver_version: String,
    /// `vulkan`, `metal`, `dx12`, ...
    pub backend: String,
}

impl Card {
    /// From wgpu's own answer.
    #[must_use]
    pub fn of(info: &wgpu::AdapterInfo) -> Self {
        Self {
            name: info.name.clone(),
            kind: kind(info.device_type),
            driver: info.driver.clone(),
            driver_version: info.driver_info.clone(),
            backend: info.backend.to_str().to_owned(),
        }
    }
}

impl fmt::Display for Card {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}; {} {}; {})", self.name, self.kind, self.driver, self.driver_version, self.backend)
    }
}

fn kind(device_type: wgpu::DeviceType) -> &'static str {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => "discrete",
        wgpu::DeviceType::IntegratedGpu => "integrated",
        wgpu::DeviceType::VirtualGpu => "virtual",
        wgpu::DeviceType::Cpu => "software",
        wgpu::DeviceType::Other => "other",
    }
}

/// Lower is preferred by [`AdapterChoice::Auto`].
fn rank(device_type: wgpu::DeviceType) -> u8 {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

/// Every adapter of the primary backends, in the order that `auto` prefers.
#[must_use]
pub fn adapters() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::PRIMARY;
    descriptor.flags = wgpu::InstanceFlags::empty();
    let instance = wgpu::Instance::new(descriptor);
    let mut found = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    // Stable: the driver's own order among equals.
    found.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    found
}

/// What to do where nothing answers.
const INSTALL: &str = "on Debian or Ubuntu install Mesa's software driver: sudo apt-get install -y mesa-vulkan-drivers libvulkan1; \
                       elsewhere install your GPU's Vulkan driver, then run `dejag doctor`";

pub(super) fn choose(choice: &AdapterChoice) -> Result<wgpu::Adapter> {
    let found = adapters();
    let names: Vec<String> = found.iter().map(|a| a.get_info().name).collect();
    let wanted = |adapter: &wgpu::Adapter| {
        let info = adapter.get_info();
        match choice {
            AdapterChoice::Auto => true,
            AdapterChoice::Software => info.device_type == wgpu::DeviceType::Cpu,
            AdapterChoice::Named(part) => info.name.to_lowercase().contains(&part.to_lowercase()),
        }
    };
    found.into_iter().find(wanted).ok_or_else(|| {
        Error::NoAdapter(if names.is_empty() {
            format!("no graphics adapter answers; {INSTALL}")
        } else if *choice == AdapterChoice::Software {
            format!("no software adapter answers (there are: {}); {INSTALL}", names.join(", "))
        } else {
            format!("no adapter's name contains '{choice}' (there are: {})", names.join(", "))
        })
    })
}
