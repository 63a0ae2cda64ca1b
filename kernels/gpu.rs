//! Batches on a GPU, through whatever wgpu finds: Vulkan, Metal, DX12, GL, or a driver in software.
//!
//! A [`Gpu`] is a context; cloning it is cheap and clones share everything. Shapes are uploaded
//! once ([`Gpu::upload`]), operations run on handles and give handles, and only what is asked for
//! comes back (`download`, or `start_download` without blocking). Handles of another context are
//! refused.
//!
//! Results are the processor's to within rounding, and the same bits on every run: sums are added
//! in a fixed order, without atomics. More than a dispatch, a binding or a buffer may hold is
//! split, so sizes are limited by memory alone.
//!
//! | what | call |
//! | --- | --- |
//! | row i with row i | [`Gpu::aligned`], [`Gpu::aligned_grad`], [`Gpu::aligned_vjp`] |
//! | every row with every row | [`Gpu::all_pairs`], [`Gpu::all_pairs_grad`], [`Gpu::all_pairs_vjp`] |
//! | the same, reduced where it is | [`Gpu::row_max`], [`Gpu::column_max`], [`Gpu::above`], [`Gpu::sum`] |
//! | a loss with its gradient | [`Gpu::sum_grad`], [`Gpu::mean_grad`] |
//! | a matrix that is there already | [`Matrix::row_max`], [`Matrix::above`], [`Matrix::sum`] |
//! | the best match of each | [`Shapes::pick`] |
//! | other shapes in the same buffers | [`Shapes::update`], [`Values::update`], [`Matrix::update`] |
//! | rings | [`Gpu::ragged`], [`Gpu::ragged_vjp`] |
//!
//! ```no_run
//! use geograd::Obb2;
//! use geograd::kernels::{gpu::Gpu, overlap::IouObb2};
//! let gpu = Gpu::new()?;
//! let boxes = gpu.upload(&[Obb2::new(0.0, 0.0, 4.0, 2.0, 0.3)])?;
//! let best = gpu.row_max::<IouObb2>(&boxes, &boxes)?.download()?;
//! assert_eq!(best[0].value, 1.0);
//! # Ok::<(), geograd::kernels::GpuError>(())
//! ```
#[path = "gpu_adapter.rs"]
mod adapter;
#[path = "gpu_aligned.rs"]
mod aligned;
#[path = "gpu_block.rs"]
mod block;
#[path = "gpu_data.rs"]
mod data;
#[path = "gpu_download.rs"]
mod download;
#[path = "gpu_found.rs"]
mod found;
#[path = "gpu_matrix.rs"]
mod matrix;
#[path = "gpu_pairs.rs"]
mod pairs;
#[path = "gpu_reduce.rs"]
mod reduce;
#[path = "gpu_ring.rs"]
mod ring;
#[path = "gpu_slices.rs"]
mod slices;
#[path = "gpu_source.rs"]
mod source;
#[path = "gpu_table.rs"]
mod table;
#[path = "gpu_work.rs"]
mod work;

pub use adapter::{Adapter, Choice, Options};
pub use data::{Bars, Shapes, Values};
pub use download::Pending;
pub use found::Founds;
pub use matrix::Matrix;
pub use pairs::PairBars;
pub use reduce::{Best, Bests};
pub use ring::{RingBars, RingValues, Rings};
pub use source::{GpuPair, GpuRing, GpuShape, pair_sources, ring_sources};

use crate::kernels::GpuError;
use source::{GROUP, GROUP_VJP, Source, TILE};
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A GPU ready for work. Cheap to clone; clones share device and compiled shaders.
#[derive(Clone)]
pub struct Gpu {
    inner: Arc<Inner>,
}

/// What all clones share.
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
    pipelines: Mutex<HashMap<(Source, &'static str), wgpu::ComputePipeline>>,
}

impl std::fmt::Debug for Gpu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Gpu").field(&self.inner.adapter).finish()
    }
}

impl std::fmt::Display for Gpu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.inner.adapter.fmt(f)
    }
}

/// A lock that a panic elsewhere cannot spoil.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Gpu {
    /// A context on the best GPU, or the one that the environment variable `GEOGRAD_GPU` names: an
    /// index into [`Gpu::adapters`], a part of a name, or `cpu` for a driver in software.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`], [`GpuError::NoSuchAdapter`] or [`GpuError::AdapterRefused`].
    pub fn new() -> Result<Self, GpuError> {
        Self::with(&Options::default())
    }

    /// A context as asked for.
    ///
    /// # Errors
    ///
    /// [`GpuError::NoAdapter`], [`GpuError::NoSuchAdapter`] or [`GpuError::AdapterRefused`].
    pub fn with(options: &Options) -> Result<Self, GpuError> {
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
                GpuError::AdapterRefused
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
            .clamp(MOST_BYTES_PER_SHAPE * TILE as u64, 1 << 31);
        let threads = u64::from(limits.max_compute_workgroups_per_dimension) * GROUP as u64;
        let chunk = (most_bytes / MOST_BYTES_PER_SHAPE).min(threads) as usize / TILE * TILE;
        let subgroups = options.subgroups && device.features().contains(wgpu::Features::SUBGROUP);
        let slots = match chosen.get_info().subgroup_min_size {
            4.. if subgroups => (GROUP_VJP / chosen.get_info().subgroup_min_size as usize).max(1),
            _ => 0,
        };
        let timing = options.timing && device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        log::info!("using {adapter}; {chunk} shapes per buffer, subgroup slots {slots}");
        Ok(Gpu {
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
            }),
        })
    }

    /// Every adapter there is, in the order of their indices.
    #[must_use]
    pub fn adapters() -> Vec<Adapter> {
        adapter::all().into_iter().map(|(_, info)| info).collect()
    }

    /// What the context runs on.
    #[must_use]
    pub fn adapter(&self) -> &Adapter {
        &self.inner.adapter
    }

    /// Whether sums across threads use subgroup operations. Results differ in rounding.
    #[must_use]
    pub fn has_subgroups(&self) -> bool {
        self.inner.slots > 0
    }

    /// The most bytes of one buffer; larger data is split.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        self.inner.most_bytes
    }

    /// Time that kernels took since the last call; `None` unless asked for by
    /// [`Options::timing`] and supported.
    #[must_use]
    pub fn take_kernel_time(&self) -> Option<Duration> {
        self.inner
            .timing
            .then(|| std::mem::take(&mut *locked(&self.inner.kernel_time)))
    }

    /// Gives the device up, with everything on it: every later call, of every clone, is
    /// [`GpuError::DeviceLost`].
    pub fn destroy(&self) {
        self.inner.device.destroy();
        self.inner.lost.store(true, Ordering::Release);
    }

    /// Waits until all work is done.
    ///
    /// # Errors
    ///
    /// [`GpuError::DeviceLost`].
    pub fn wait(&self) -> Result<(), GpuError> {
        self.inner.wait(None)
    }

    /// Whether a handle's context is this one.
    fn owns(&self, other: &Gpu) -> Result<(), GpuError> {
        if Arc::ptr_eq(&self.inner, &other.inner) {
            Ok(())
        } else {
            Err(GpuError::ForeignBuffer)
        }
    }
}

/// The most bytes of one shape in any buffer, or of one pair in a row of a matrix of slopes.
const MOST_BYTES_PER_SHAPE: u64 = 64;
