//! The context of a GPU: device, queue, limits and compiled shaders.
use super::adapter::{self, Adapter, Options};
use super::generated::text::{Pipeline, Pipelines};
use super::written::{GROUP, GROUP_VJP, Kernel};
use crate::kernels::cpu::lane::TILE;
use crate::kernels::machine::Machine;
use crate::{Error, GpuFault};
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A context on a GPU. Clones are cheap and share the device and compiled shaders.
pub type Gpu = Machine<Device>;

/// The engine of a GPU: a context. Clones share the device and compiled shaders.
#[derive(Clone)]
pub struct Device {
    pub(super) inner: Arc<SharedContext>,
}

/// The part of a context that all clones share.
pub(super) struct SharedContext {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) adapter: Adapter,
    /// The largest number of shapes in a buffer and in a binding.
    pub(super) chunk: usize,
    /// The largest size of a binding in bytes.
    pub(super) most_bytes: u64,
    /// The largest number of subgroups of an adjoint's workgroup; zero without subgroup operations.
    pub(super) slots: usize,
    pub(super) timing: bool,
    pub(super) kernel_time: Mutex<Duration>,
    pub(super) lost: Arc<AtomicBool>,
    pub(super) pipelines: Mutex<HashMap<(Kernel, &'static str), Pipeline>>,
    pub(super) generated: Mutex<Pipelines>,
}

impl std::fmt::Debug for Device {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Device").field(&self.inner.adapter).finish()
    }
}

impl std::fmt::Display for Machine<Device> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.engine.inner.adapter.fmt(f)
    }
}

/// Locks a mutex even if a thread panicked while it had the lock.
pub(super) fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Machine<Device> {
    /// Returns a context on the best GPU, or the one that the environment variable `GEOGRAD_GPU` names: an index into
    /// [`Gpu::adapters`], a part of a name, or `cpu` for a software driver.
    ///
    /// # Errors
    ///
    /// [`GpuFault::NoAdapter`], [`GpuFault::NoSuchAdapter`]
    /// or [`GpuFault::AdapterRefused`].
    pub fn new() -> Result<Self, Error> {
        Self::with(&Options::default())
    }

    /// Returns a context with the given options.
    ///
    /// # Errors
    ///
    /// [`GpuFault::NoAdapter`], [`GpuFault::NoSuchAdapter`]
    /// or [`GpuFault::AdapterRefused`].
    pub fn with(options: &Options) -> Result<Self, Error> {
        let (chosen, adapter) = adapter::choose(&options.adapter)?;
        let limits = chosen.limits();
        let optional = wgpu::Features::SUBGROUP | wgpu::Features::TIMESTAMP_QUERY;
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("geograd"),
            required_features: chosen.features() & optional,
            required_limits: limits.clone(),
            memory_hints: wgpu::MemoryHints::Performance,
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(chosen.request_device(&descriptor)).map_err(|error| {
                log::warn!("{adapter}: {error}");
                Error::Gpu(GpuFault::AdapterRefused)
            })?;
        let lost = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&lost);
        device.set_device_lost_callback(move |reason, message| {
            log::error!("device lost ({reason:?}): {message}");
            flag.store(true, Ordering::Release);
        });
        device.on_uncaptured_error(Arc::new(|error| log::error!("uncaptured: {error}")));

        let most_bytes = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size)
            .min(options.most_bytes.unwrap_or(u64::MAX))
            // Indices of numbers stay far below 2³².
            .clamp(LEAST_BYTES, 1 << 31);
        let threads = u64::from(limits.max_compute_workgroups_per_dimension) * GROUP as u64;
        let chunk = (most_bytes / MOST_BYTES_PER_SHAPE).min(threads) as usize / TILE * TILE;
        let subgroups = options.subgroups && device.features().contains(wgpu::Features::SUBGROUP);
        let slots = match chosen.get_info().subgroup_min_size {
            4.. if subgroups => (GROUP_VJP / chosen.get_info().subgroup_min_size as usize).max(1),
            _ => 0,
        };
        let timing = options.timing && device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        log::info!("using {adapter}; {chunk} shapes per buffer, subgroup slots {slots}");
        let engine = Device {
            inner: Arc::new(SharedContext {
                device,
                queue,
                adapter,
                chunk,
                most_bytes,
                slots,
                timing,
                kernel_time: Mutex::new(Duration::ZERO),
                lost,
                pipelines: Mutex::new(HashMap::new()),
                generated: Mutex::new(HashMap::new()),
            }),
        };
        Ok(Machine { engine })
    }

    /// Returns `true` if the GPU is faster than the CPU: `false` for a software driver, unless the environment asks for
    /// it.
    pub(crate) fn is_worth_it(&self) -> bool {
        !self.adapter().is_software || std::env::var_os("GEOGRAD_GPU").is_some()
    }

    /// Returns all adapters, in the order of their indices.
    #[must_use]
    pub fn adapters() -> Vec<Adapter> {
        adapter::all().into_iter().map(|(_, info)| info).collect()
    }

    /// Returns the adapter that the context runs on.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.engine.inner.adapter
    }

    /// Returns `true` if sums across threads use subgroup operations. Results differ in rounding.
    #[must_use]
    pub fn has_subgroups(&self) -> bool {
        self.engine.inner.slots > 0
    }

    /// Returns the largest size of a buffer in bytes; larger data is split.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        self.engine.inner.most_bytes
    }

    /// Returns the time of kernels since the last call; `None` unless [`Options::timing`] asks for it and the device
    /// supports it.
    #[must_use]
    pub fn take_kernel_time(&self) -> Option<Duration> {
        self.engine
            .inner
            .timing
            .then(|| std::mem::take(&mut *locked(&self.engine.inner.kernel_time)))
    }

    /// Destroys the device with everything on it: every later call, of every clone, returns [`GpuFault::DeviceLost`].
    pub fn destroy(&self) {
        self.engine.inner.device.destroy();
        self.engine.inner.lost.store(true, Ordering::Release);
    }

    /// Waits until all work is done.
    ///
    /// # Errors
    ///
    /// [`GpuFault::DeviceLost`].
    pub fn wait(&self) -> Result<(), Error> {
        self.engine.inner.wait(None)
    }
}

impl Device {
    /// Checks that a handle belongs to this context.
    pub(super) fn owns(&self, other: &Device) -> Result<(), Error> {
        if Arc::ptr_eq(&self.inner, &other.inner) {
            Ok(())
        } else {
            Err(Error::Gpu(GpuFault::ForeignBuffer))
        }
    }
}

/// The largest size in bytes of one shape in any buffer, or of one pair in a row of a matrix of derivatives.
pub(super) const MOST_BYTES_PER_SHAPE: u64 = 64;
/// The smallest limit of a buffer's size in bytes.
pub(super) const LEAST_BYTES: u64 = 4096;

impl SharedContext {
    /// Returns the pipeline of a shader that has no body of two shapes.
    pub(super) fn written(&self, kernel: Kernel, entry: &'static str) -> wgpu::ComputePipeline {
        self.pipeline(kernel, entry, || kernel.text())
    }
}
