//! Kernels and functions that are compiled in this library for each format of numbers.
use crate::Real;
use crate::error::Error;
use crate::kernels::cpu::arch::{self, Kernels};
use crate::kernels::cpu::drivers::{self, Drivers};
use crate::kernels::cpu::plan::Plan;
use crate::kernels::recording::Call;
use crate::scalar::real::in_format;
use std::sync::Arc;

/// The kernels compiled for every level of vector instructions.
#[inline]
pub(crate) fn kernels_in<T: Real>() -> &'static Kernels<T> {
    in_format([&arch::F32, &arch::F64])
}

/// The functions compiled once, in this library.
#[inline]
pub(crate) fn drivers_in<T: Real>() -> &'static Drivers<T> {
    in_format([&drivers::F32, &drivers::F64])
}

/// The plan by which the CPU computes a call: aligned, or for all pairs with shapes prepared once.
///
/// # Errors
///
/// Errors of recording it.
pub(crate) fn plan_of<T: Real>(call: &Call<T>, framed: bool) -> Result<Arc<Plan<T>>, Error> {
    (drivers_in::<T>().plan)(call, framed)
}
