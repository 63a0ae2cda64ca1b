//! The machines of calls: the CPU or a GPU.
use crate::raised;
use geograd::kernels::dynamic::{Function, OnPaths};
use geograd::kernels::gpu::Gpu;
use geograd::{Error, Real, kernels::Backend};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;

/// The machine that runs a call.
pub enum Machine {
    Cpu,
    Gpu(Gpu),
}

/// Returns the GPU of this process. A forked child cannot use its parent's.
#[cfg(feature = "gpu")]
fn gpu() -> PyResult<Gpu> {
    use std::sync::{Mutex, PoisonError};
    static GPU: Mutex<Option<(u32, Gpu)>> = Mutex::new(None);
    let mut kept = GPU.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    if let Some((of, gpu)) = &*kept
        && *of == process
    {
        return Ok(gpu.clone());
    }
    let gpu = Gpu::new().map_err(raised)?;
    if let Some((of, old)) = kept.replace((process, gpu.clone())) {
        // The threads of its driver run in the parent only.
        if of != process {
            std::mem::forget(old);
        }
    }
    Ok(gpu)
}
#[cfg(not(feature = "gpu"))]
fn gpu() -> PyResult<Gpu> {
    Gpu::new().map_err(raised)
}

impl Machine {
    /// Returns the machine that the argument `backend` names.
    pub fn named(name: Option<&str>) -> PyResult<Machine> {
        match name {
            None | Some("cpu") => Ok(Machine::Cpu),
            Some("gpu") => gpu().map(Machine::Gpu),
            Some(other) => Err(PyValueError::new_err(format!(
                "backend: \"cpu\" or \"gpu\" is needed, not {other:?}"
            ))),
        }
    }
    pub fn is_gpu(&self) -> bool {
        matches!(self, Machine::Gpu(_))
    }
    /// Returns a function on this machine.
    pub fn of<'f, T: Real>(
        &self,
        function: &'f Function<T>,
    ) -> Result<Cow<'f, Function<T>>, Error> {
        match self {
            Machine::Cpu => Ok(Cow::Borrowed(function)),
            Machine::Gpu(_) => function.on(self.backend()).map(Cow::Owned),
        }
    }
    /// Returns a fold on this machine.
    pub fn of_paths<'f, T: Real>(
        &self,
        fold: &'f OnPaths<T>,
    ) -> Result<Cow<'f, OnPaths<T>>, Error> {
        match self {
            Machine::Cpu => Ok(Cow::Borrowed(fold)),
            Machine::Gpu(_) => fold.on(self.backend()).map(Cow::Owned),
        }
    }
    fn backend(&self) -> Backend<'_> {
        match self {
            Machine::Cpu => Backend::Cpu,
            Machine::Gpu(gpu) => Backend::Gpu(gpu),
        }
    }
}
