//! The processor or a GPU.
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

/// The GPU of this process: a forked child has none of its parent's.
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
        // Its driver's threads are the parent's.
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
    /// The machine that an argument `backend` names.
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
    /// A function as this machine runs it.
    pub fn of<'f, T: Real>(
        &self,
        function: &'f Function<T>,
    ) -> Result<Cow<'f, Function<T>>, Error> {
        match self {
            Machine::Cpu => Ok(Cow::Borrowed(function)),
            Machine::Gpu(_) => function.on(self.backend()).map(Cow::Owned),
        }
    }
    /// A fold as this machine runs it.
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
