//! Why a GPU, or a call on one, failed.
use crate::error::Error;
use std::fmt;

/// Why a GPU could not be had or a call on it failed. Inputs are as they were and stay usable,
/// except after [`GpuError::DeviceLost`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum GpuError {
    /// This build has no GPU support: build with the feature `gpu`.
    NotBuilt,
    /// No adapter was found at all: install the GPU's driver, or Mesa's lavapipe, which runs on any
    /// processor.
    NoAdapter,
    /// Adapters were found, but none as asked for: choose another index, name or kind.
    NoSuchAdapter,
    /// Only a driver in software was found, which is slower than the CPU: install the GPU's driver,
    /// or ask for software with `GEOGRAD_GPU=cpu`. Only [`Backend::auto`] says so.
    ///
    /// [`Backend::auto`]: crate::kernels::Backend::auto
    OnlySoftware,
    /// The adapter gave no device, or cannot compute.
    AdapterRefused,
    /// The device is gone (removed, reset by its driver, or destroyed), and everything on it: make
    /// a new context and upload again.
    DeviceLost,
    /// The device has not enough memory: give up some handles, or take smaller batches.
    OutOfMemory,
    /// One item, such as a ring, is larger than any buffer the device allows
    /// ([`Gpu::most_bytes`](crate::kernels::gpu::Gpu)): split it, or compute it on the CPU. Batches
    /// are split as they need.
    TooLarge,
    /// The driver refused a shader or a command: a fault of ours or of the driver's. The log says
    /// more.
    Shader,
    /// A handle that belongs to another context.
    ForeignBuffer,
    /// The input was refused.
    Input(Error),
}

impl fmt::Display for GpuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            GpuError::NotBuilt => "built without GPU support: build with `--features gpu`",
            GpuError::NoAdapter => "no GPU found: install its driver",
            GpuError::NoSuchAdapter => {
                "no GPU found as asked for: choose another with GEOGRAD_GPU (an index, a part of a \
                 name, or `cpu`)"
            }
            GpuError::OnlySoftware => {
                "no GPU found but a driver in software, which is slower than the CPU: install the \
                 GPU's driver, or ask for software with GEOGRAD_GPU=cpu"
            }
            GpuError::AdapterRefused => "the GPU gave no device for computing",
            GpuError::DeviceLost => "the GPU is lost: make a new context and upload again",
            GpuError::OutOfMemory => {
                "the GPU is out of memory: free handles or take smaller batches"
            }
            GpuError::TooLarge => {
                "one item is larger than any buffer of the GPU: split it, or use the CPU"
            }
            GpuError::Shader => "the GPU's driver refused a command: see the log",
            GpuError::ForeignBuffer => "a handle belongs to another GPU context",
            GpuError::Input(error) => return error.fmt(f),
        })
    }
}

impl std::error::Error for GpuError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            GpuError::Input(error) => Some(error),
            _ => None,
        }
    }
}

impl From<Error> for GpuError {
    fn from(error: Error) -> Self {
        GpuError::Input(error)
    }
}
