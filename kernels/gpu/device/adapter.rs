//! The choice and the description of adapters.
use crate::{Error, GpuFault};
use std::fmt;

/// The choice of the adapter for a context.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Choice {
    /// The adapter that the environment variable `GEOGRAD_GPU` names. Without the variable it is the fastest kind:
    /// discrete, then integrated, virtual, other, and last a software driver.
    #[default]
    Best,
    /// By index into [`Gpu::adapters`](super::Gpu::adapters).
    Index(usize),
    /// By a part of its name, ignoring case.
    Name(String),
    /// A software driver.
    Cpu,
}

impl Choice {
    /// Parses a value of the environment variable: `cpu`, an index, or a part of a name.
    #[must_use]
    pub fn parse(text: &str) -> Self {
        let text = text.trim();
        match text.parse() {
            Ok(index) => Choice::Index(index),
            Err(_) if text.is_empty() => Choice::Best,
            Err(_) if text.eq_ignore_ascii_case("cpu") => Choice::Cpu,
            Err(_) => Choice::Name(text.to_owned()),
        }
    }
}

/// The options of a new context.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// The adapter.
    pub adapter: Choice,
    /// An upper bound of a buffer's size in bytes, below the device's: mostly for tests of splitting.
    pub most_bytes: Option<u64>,
    /// `true` to use subgroup operations if the device has them (the default).
    pub subgroups: bool,
    /// `true` to measure the time of kernels (default: `false`). Every call then waits for its end.
    pub timing: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            adapter: Choice::Best,
            most_bytes: None,
            subgroups: true,
            timing: false,
        }
    }
}

/// A description of an adapter.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Adapter {
    /// The index by which it can be chosen.
    pub index: usize,
    /// The name of the GPU.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// The interface: Vulkan, Metal, Dx12 or Gl.
    pub backend: String,
    /// `true` for a software driver.
    pub is_software: bool,
    /// `true` if it has subgroup operations, which add across threads.
    pub subgroups: bool,
    /// `true` if it can measure the time of kernels.
    pub timestamps: bool,
    /// The largest size in bytes of a buffer that a kernel can read.
    pub most_bytes: u64,
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "[{}] {} ({}, {})",
            self.index, self.name, self.backend, self.driver
        )
    }
}

/// Returns every adapter that can compute.
pub(super) fn all() -> Vec<(wgpu::Adapter, Adapter)> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    // Debug information makes wgpu look up the line of every instruction in a linear search, which takes longer than
    // compiling the shader.
    let debug = wgpu::InstanceFlags::DEBUG;
    descriptor.flags = (wgpu::InstanceFlags::default() - debug).with_env();
    let backends = descriptor.backends;
    let instance = wgpu::Instance::new(descriptor);
    let found = pollster::block_on(instance.enumerate_adapters(backends));
    found
        .into_iter()
        .filter(|adapter| {
            let flags = adapter.get_downlevel_capabilities().flags;
            flags.contains(wgpu::DownlevelFlags::COMPUTE_SHADERS)
                && adapter.limits().max_compute_invocations_per_workgroup
                    >= super::written::GROUP as u32
        })
        .enumerate()
        .map(|(index, adapter)| {
            let info = describe(index, &adapter);
            (adapter, info)
        })
        .collect()
}

fn describe(index: usize, adapter: &wgpu::Adapter) -> Adapter {
    let (info, features, limits) = (adapter.get_info(), adapter.features(), adapter.limits());
    let driver = [info.driver, info.driver_info].join(" ");
    Adapter {
        index,
        name: info.name,
        driver: driver.trim().to_owned(),
        backend: format!("{:?}", info.backend),
        is_software: info.device_type == wgpu::DeviceType::Cpu,
        subgroups: features.contains(wgpu::Features::SUBGROUP),
        timestamps: features.contains(wgpu::Features::TIMESTAMP_QUERY),
        most_bytes: limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size),
    }
}

/// Returns the rank of an adapter; the lowest is preferred.
fn rank(adapter: &wgpu::Adapter) -> (u8, bool) {
    let info = adapter.get_info();
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    // OpenGL exposes fewer features of a GPU than its other interfaces.
    (kind, info.backend == wgpu::Backend::Gl)
}

/// Returns the chosen adapter.
pub(super) fn choose(choice: &Choice) -> Result<(wgpu::Adapter, Adapter), Error> {
    let choice = match (choice, std::env::var("GEOGRAD_GPU")) {
        (Choice::Best, Ok(text)) => Choice::parse(&text),
        _ => choice.clone(),
    };
    let mut adapters = all();
    for (_, info) in &adapters {
        log::debug!("found {info}");
    }
    adapters.sort_by_key(|(adapter, _)| rank(adapter));
    let wanted = |info: &Adapter| match &choice {
        Choice::Best => true,
        Choice::Index(index) => info.index == *index,
        Choice::Name(part) => info.name.to_lowercase().contains(&part.to_lowercase()),
        Choice::Cpu => info.is_software,
    };
    let missing = match adapters.is_empty() {
        true => Error::Gpu(GpuFault::NoAdapter),
        false => Error::Gpu(GpuFault::NoSuchAdapter),
    };
    adapters
        .into_iter()
        .find(|(_, info)| wanted(info))
        .ok_or(missing)
}
