//! The machine chosen at run time: the calls of [`Machine`] on the CPU or on a GPU, in `f32`.
mod rings;

pub use rings::Rings;

use crate::kernels::cpu::Cpu;
use crate::kernels::gpu::Gpu;
use crate::kernels::machine::{Engine, Machine};
use crate::{Error, GpuFault};
use std::ops::Deref;

/// The machine on which batches run. There is no silent fallback from one to the other.
///
/// It has the calls of every [`Machine`], for any operation and any program, in `f32`. Columns are slices, or arrays
/// that stay on the machine between calls; see [`resident`](crate::kernels::resident).
///
/// ```
/// use geograd::Obb2;
/// use geograd::kernels::{Backend, Iou};
/// let a = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0)];
/// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0)];
/// assert_eq!(Backend::Cpu.all_pairs(Iou, &a, &b)?.at(0, 0), 1.0 / 3.0);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Backend<'a> {
    /// The CPU: all lanes and cores.
    Cpu,
    /// A GPU.
    Gpu(&'a Gpu),
}

/// The choice of [`Backend::auto`], with its reason.
#[derive(Clone, Debug)]
pub enum Auto {
    /// The CPU, and the error that rules out a GPU.
    Cpu(Error),
    /// A GPU. A software driver is not chosen, because it is slower than the CPU.
    Gpu(Gpu),
}

impl Backend<'_> {
    /// Returns the best GPU, or the CPU and the reason why there is no GPU.
    ///
    /// A software driver counts as no GPU ([`OnlySoftware`](crate::GpuFault::OnlySoftware)) unless the environment
    /// variable `GEOGRAD_GPU` asks for one.
    #[must_use]
    pub fn auto() -> Auto {
        match Gpu::new() {
            Ok(gpu) if !gpu.is_worth_it() => Auto::Cpu(Error::Gpu(GpuFault::OnlySoftware)),
            Ok(gpu) => Auto::Gpu(gpu),
            Err(error) => Auto::Cpu(error),
        }
    }
}

/// The CPU that all backends use.
static CPU: Cpu = Cpu::new();

impl Deref for Backend<'_> {
    type Target = Machine<dyn Engine<f32>>;
    // Inlined, the coercion would compile the engine in the calling crate.
    #[inline(never)]
    fn deref(&self) -> &Self::Target {
        match *self {
            Backend::Cpu => &CPU,
            Backend::Gpu(gpu) => gpu,
        }
    }
}

impl<'a> Backend<'a> {
    /// Returns the machine as a backend, whose calls take arrays on the machine, too.
    #[must_use]
    pub const fn resident(self) -> Backend<'a> {
        self
    }
}

impl Auto {
    /// Returns the chosen backend.
    #[must_use]
    pub fn backend(&self) -> Backend<'_> {
        match self {
            Auto::Cpu(_) => Backend::Cpu,
            Auto::Gpu(gpu) => Backend::Gpu(gpu),
        }
    }
}

impl std::fmt::Display for Auto {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Auto::Cpu(reason) => write!(f, "the CPU ({reason})"),
            Auto::Gpu(gpu) => gpu.fmt(f),
        }
    }
}
