//! Kernels that are compiled in this library for each format of numbers.
use crate::Real;
use crate::kernels::cpu::arch::{self, Kernels};
use crate::scalar::real::in_format;

/// Returns the kernels compiled for every level of vector instructions.
#[inline]
pub(crate) fn kernels_in<T: Real>() -> &'static Kernels<T> {
    in_format([&arch::F32, &arch::F64])
}
