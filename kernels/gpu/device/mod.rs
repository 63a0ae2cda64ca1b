//! The device behind [`Gpu`]: buffers, pipelines, batches.
//!
//! # Bodies and templates
//!
//! A kernel is a template around a body. A body is a function of numbers in WGSL: `generated/operation.rs` writes one from
//! a recording, `generated/by_hand.rs` has those by hand. The processor prepares its inputs: for all pairs whatever depends
//! on one shape, otherwise the sines of angles, so that both machines start from the same ones. Items lie in tiles as on
//! the CPU.
//!
//! Templates of all pairs are in `wgsl/`: every row with every column (`pairs.wgsl`), reductions (`reduce.wgsl`, with a
//! snippet `take_*`), sums of derivatives of one list (`slopes.wgsl`) or of both at once (`vjp.wgsl`, with a snippet
//! `seed_*`). `generated/template.rs` writes the functions that name a body's numbers. A thread stands for a shape of one
//! list; shapes of the other one are brought near the threads (`walked.wgsl`). No reduction stores a matrix. Sums of
//! derivatives are partial sums, which `fold.wgsl` adds in a fixed order. Templates of single items, of suppression and of
//! folds are in `generated/`.
//!
//! Scores of boxes in the plane have bodies by hand, mirrors of their Rust source, value and adjoint, because they take
//! fewer instructions (BENCHMARKS.md). Such a body gives the derivatives of both shapes at once: a thread keeps sums for
//! its columns, those of a row are added across the subgroup (or workgroup memory). Measures of rings have kernels by hand,
//! too: a thread for each ring, a workgroup for a span of a long one. Constants come from Rust, and naga validates every
//! combination in a test without a GPU.
//!
//! A context keeps pipelines as long as their program lives. Searches are decided on the processor; each trace becomes a
//! list of instructions, which one kernel (`replay.wgsl`) carries out. For suppression the GPU writes which pairs are
//! certainly above the threshold and which are within 1/256 of it; the processor computes the latter. Columns on the device
//! (`generated/held`, `generated/columns.rs`) are kept as given and as each operation wants them prepared.
mod adapter;
mod block;
mod data;
mod download;
mod engine;
mod found;
mod generated;
mod groups;
mod lists;
mod matrix;
mod plans;
mod reduce;
mod reducer;
mod rings;
mod seed;
mod work;
mod written;

pub use adapter::{Adapter, Choice, Options};
use download::Pending;
#[doc(hidden)]
pub use generated::operation::Generated;
pub use generated::{fold_sources, line_sources, op_sources, replay_source};
use matrix::Matrix;
use reduce::Bests;
pub(crate) use rings::Rings;
pub use written::common_sources;

use crate::kernels::cpu::lane::TILE;
use crate::kernels::machine::Machine;
use crate::{Error, GpuFault};
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use written::{GROUP, GROUP_VJP, Kernel};

/// A GPU ready for work. Cheap to clone; clones share device and compiled shaders.
pub type Gpu = Machine<Device>;

/// The engine of a GPU: a context. Clones share device and compiled shaders.
#[derive(Clone)]
pub struct Device {
    inner: Arc<Inner>,
}

/// The part of a context that all clones share.
struct Inner {
    device: wgpu::Device,
    queue: wgpu::Queue,
    adapter: Adapter,
    /// Shapes per buffer and per binding.
    chunk: usize,
    /// Bytes per binding.
    most_bytes: u64,
    /// The most subgroups an adjoint's workgroup can have, zero without subgroup operations.
    slots: usize,
    timing: bool,
    kernel_time: Mutex<Duration>,
    lost: Arc<AtomicBool>,
    pipelines: Mutex<HashMap<(Kernel, &'static str), wgpu::ComputePipeline>>,
    generated: Mutex<generated::Pipelines>,
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

/// A lock that a panic elsewhere cannot spoil.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Machine<Device> {
    /// A context on the best GPU, or the one that the environment variable `GEOGRAD_GPU` names: an
    /// index into [`Gpu::adapters`], a part of a name, or `cpu` for a driver in software.
    ///
    /// # Errors
    ///
    /// [`GpuFault::NoAdapter`], [`GpuFault::NoSuchAdapter`]
    /// or [`GpuFault::AdapterRefused`].
    pub fn new() -> Result<Self, Error> {
        Self::with(&Options::default())
    }

    /// A context as asked for.
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
            // Indices of numbers stay far from 32 bits.
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
            inner: Arc::new(Inner {
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

    /// `true` if it computes faster than the processor: not so for a driver in software, unless the
    /// environment asks for one.
    pub(crate) fn is_worth_it(&self) -> bool {
        !self.adapter().is_software || std::env::var_os("GEOGRAD_GPU").is_some()
    }

    /// Every adapter there is, in the order of their indices.
    #[must_use]
    pub fn adapters() -> Vec<Adapter> {
        adapter::all().into_iter().map(|(_, info)| info).collect()
    }

    /// The adapter that the context runs on.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.engine.inner.adapter
    }

    /// `true` if sums across threads use subgroup operations. Results differ in rounding.
    #[must_use]
    pub fn has_subgroups(&self) -> bool {
        self.engine.inner.slots > 0
    }

    /// The most bytes of one buffer; larger data is split.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        self.engine.inner.most_bytes
    }

    /// Time that kernels took since the last call; `None` unless asked for by
    /// [`Options::timing`] and supported.
    #[must_use]
    pub fn take_kernel_time(&self) -> Option<Duration> {
        self.engine
            .inner
            .timing
            .then(|| std::mem::take(&mut *locked(&self.engine.inner.kernel_time)))
    }

    /// Gives the device up, with everything on it: every later call, of every clone, is
    /// [`GpuFault::DeviceLost`].
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
    /// Refuses a handle of another context.
    fn owns(&self, other: &Device) -> Result<(), Error> {
        if Arc::ptr_eq(&self.inner, &other.inner) {
            Ok(())
        } else {
            Err(Error::Gpu(GpuFault::ForeignBuffer))
        }
    }
}

/// The most bytes of one shape in any buffer, or of one pair in a row of a matrix of derivatives.
const MOST_BYTES_PER_SHAPE: u64 = 64;
/// The least bytes of a buffer.
const LEAST_BYTES: u64 = 4096;
