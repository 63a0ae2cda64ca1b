//! The processor or a GPU.
use crate::raised;
use geograd::kernels::Groups;
use geograd::kernels::dynamic::{Function, OnPaths, Rows};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::reduce::{Best, Found};
use geograd::{Error, kernels::Backend};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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
    fn backend(&self) -> Backend<'_> {
        match self {
            Machine::Cpu => Backend::Cpu,
            Machine::Gpu(gpu) => Backend::Gpu(gpu),
        }
    }
}

/// Lists of derivatives with a number before them.
pub type Loss<T> = (f64, Vec<T>, Vec<T>);

/// A function of a format on a machine. A GPU has no `f64`: calls refuse it before they come here.
pub trait OnMachine: geograd::Real {
    fn aligned(
        f: &Function<Self>,
        on: &Machine,
        rows: &[Rows<'_, Self>],
        out: &mut [Option<&mut [Self]>],
        is_new: bool,
    ) -> Result<(), Error>;
    fn all_pairs(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        out: &mut [Self],
    ) -> Result<(), Error>;
    fn row_max(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
    ) -> Result<Vec<Best<Self>>, Error>;
    fn column_max(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
    ) -> Result<Vec<Best<Self>>, Error>;
    fn pairs_above(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        threshold: Self,
    ) -> Result<Vec<Found<Self>>, Error>;
    fn above_grouped(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        groups: Groups<'_>,
        threshold: Self,
    ) -> Result<Vec<Found<Self>>, Error>;
    fn row_max_grouped(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<Self>>>, Error>;
    fn column_max_grouped(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        groups: Groups<'_>,
    ) -> Result<Vec<Option<Best<Self>>>, Error>;
    fn count_above(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        threshold: Self,
    ) -> Result<u64, Error>;
    fn sum(f: &Function<Self>, on: &Machine, lists: [Rows<'_, Self>; 2]) -> Result<f64, Error>;
    fn mean(f: &Function<Self>, on: &Machine, lists: [Rows<'_, Self>; 2]) -> Result<f64, Error>;
    fn sum_grad(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
    ) -> Result<Loss<Self>, Error>;
    fn mean_grad(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
    ) -> Result<Loss<Self>, Error>;
    fn all_pairs_vjp(
        f: &Function<Self>,
        on: &Machine,
        lists: [Rows<'_, Self>; 2],
        upstream: &[Self],
    ) -> Result<(Vec<Self>, Vec<Self>), Error>;
    fn paths(
        f: &OnPaths<Self>,
        on: &Machine,
        rows: &[Rows<'_, Self>],
        vertices: &[Self],
        offsets: &[usize],
    ) -> Result<Vec<Self>, Error>;
    fn paths_vjp(
        f: &OnPaths<Self>,
        on: &Machine,
        rows: &[Rows<'_, Self>],
        vertices: &[Self],
        offsets: &[usize],
        upstream: &[Self],
    ) -> Result<(Vec<Vec<Self>>, Vec<Self>), Error>;
}

/// The same calls in a format; `$on` of a machine gives the method and what it takes first.
macro_rules! on_machine {
    ($T:ty, $on:ident => $all_pairs:expr, $aligned:expr, $($backend:expr)?; $row_max:ident $column_max:ident $above:ident
     $above_grouped:ident $row_max_grouped:ident $column_max_grouped:ident $count_above:ident $sum:ident $mean:ident $sum_grad:ident $mean_grad:ident $all_pairs_vjp:ident $values:ident $vjp:ident) => {
        impl OnMachine for $T {
            fn aligned(f: &Function<$T>, $on: &Machine, rows: &[Rows<'_, $T>], out: &mut [Option<&mut [$T]>], is_new: bool) -> Result<(), Error> {
                $aligned(f, $on, rows, out, is_new)
            }
            fn all_pairs(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2], out: &mut [$T]) -> Result<(), Error> {
                $all_pairs(f, $on, [a, b], out)
            }
            fn row_max(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<Vec<Best<$T>>, Error> {
                f.$row_max($($backend,)? a, b)
            }
            fn column_max(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<Vec<Best<$T>>, Error> {
                f.$column_max($($backend,)? a, b)
            }
            fn pairs_above(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2], threshold: $T) -> Result<Vec<Found<$T>>, Error> {
                f.$above($($backend,)? a, b, threshold)
            }
            fn above_grouped(
                f: &Function<$T>,
                $on: &Machine,
                [a, b]: [Rows<'_, $T>; 2],
                groups: Groups<'_>,
                threshold: $T,
            ) -> Result<Vec<Found<$T>>, Error> {
                f.$above_grouped($($backend,)? a, b, groups, threshold)
            }
            fn row_max_grouped(
                f: &Function<$T>,
                $on: &Machine,
                [a, b]: [Rows<'_, $T>; 2],
                groups: Groups<'_>,
            ) -> Result<Vec<Option<Best<$T>>>, Error> {
                f.$row_max_grouped($($backend,)? a, b, groups)
            }
            fn column_max_grouped(
                f: &Function<$T>,
                $on: &Machine,
                [a, b]: [Rows<'_, $T>; 2],
                groups: Groups<'_>,
            ) -> Result<Vec<Option<Best<$T>>>, Error> {
                f.$column_max_grouped($($backend,)? a, b, groups)
            }
            fn count_above(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2], threshold: $T) -> Result<u64, Error> {
                f.$count_above($($backend,)? a, b, threshold)
            }
            fn sum(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<f64, Error> {
                f.$sum($($backend,)? a, b)
            }
            fn mean(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<f64, Error> {
                f.$mean($($backend,)? a, b)
            }
            fn sum_grad(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<Loss<$T>, Error> {
                f.$sum_grad($($backend,)? a, b)
            }
            fn mean_grad(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2]) -> Result<Loss<$T>, Error> {
                f.$mean_grad($($backend,)? a, b)
            }
            fn all_pairs_vjp(f: &Function<$T>, $on: &Machine, [a, b]: [Rows<'_, $T>; 2], upstream: &[$T]) -> Result<(Vec<$T>, Vec<$T>), Error> {
                f.$all_pairs_vjp($($backend,)? a, b, upstream)
            }
            fn paths(f: &OnPaths<$T>, $on: &Machine, rows: &[Rows<'_, $T>], vertices: &[$T], offsets: &[usize]) -> Result<Vec<$T>, Error> {
                f.$values($($backend,)? rows, vertices, offsets)
            }
            fn paths_vjp(
                f: &OnPaths<$T>,
                $on: &Machine,
                rows: &[Rows<'_, $T>],
                vertices: &[$T],
                offsets: &[usize],
                upstream: &[$T],
            ) -> Result<(Vec<Vec<$T>>, Vec<$T>), Error> {
                f.$vjp($($backend,)? rows, vertices, offsets, upstream)
            }
        }
    };
}
on_machine!(f64, _on => |f: &Function<f64>, _: &Machine, [a, b]: [Rows<'_, f64>; 2], out: &mut [f64]| f.all_pairs_into(a, b, out),
    |f: &Function<f64>, _: &Machine, rows: &[Rows<'_, f64>], out: &mut [Option<&mut [f64]>], is_new: bool| aligned_on_cpu(f, rows, out, is_new), ;
    row_max column_max above above_grouped row_max_grouped column_max_grouped count_above sum mean sum_grad mean_grad all_pairs_vjp values vjp);
on_machine!(f32, on => pairs_of_singles, aligned_singles, on.backend();
    row_max_on column_max_on above_on above_grouped_on row_max_grouped_on column_max_grouped_on count_above_on sum_on mean_on sum_grad_on mean_grad_on all_pairs_vjp_on values_on vjp_on);

/// Into arrays of the caller, or into new ones, which an error may leave written.
fn aligned_on_cpu<T: geograd::Real>(
    f: &Function<T>,
    rows: &[Rows<'_, T>],
    out: &mut [Option<&mut [T]>],
    is_new: bool,
) -> Result<(), Error> {
    match is_new {
        true => f.aligned_into_new(rows, out),
        false => f.aligned_into(rows, out),
    }
}

fn aligned_singles(
    f: &Function<f32>,
    on: &Machine,
    rows: &[Rows<'_, f32>],
    out: &mut [Option<&mut [f32]>],
    is_new: bool,
) -> Result<(), Error> {
    let Machine::Gpu(_) = on else {
        return aligned_on_cpu(f, rows, out, is_new);
    };
    let lists = f.aligned_on(on.backend(), rows)?;
    for (list, out) in lists.iter().zip(out) {
        if let Some(out) = out {
            out.copy_from_slice(list);
        }
    }
    Ok(())
}

fn pairs_of_singles(
    f: &Function<f32>,
    on: &Machine,
    [a, b]: [Rows<'_, f32>; 2],
    out: &mut [f32],
) -> Result<(), Error> {
    let Machine::Gpu(_) = on else {
        return f.all_pairs_into(a, b, out);
    };
    out.copy_from_slice(&f.all_pairs_on(on.backend(), a, b)?);
    Ok(())
}
