//! The two formats that batches serve.
use crate::ad::program::Plain;
use crate::kernels::cpu::arch::Kernels;
use crate::kernels::cpu::drivers::Drivers;
use crate::kernels::cpu::lane::Kept;
use crate::{Pack, Scalar};
use std::any::Any;

/// `f32` or `f64`: the formats that batches serve.
pub trait Real:
    Scalar<Mask = bool, Primal = Self> + Plain + Pack<Scalar = Self> + Default + PartialOrd + Kept
{
    /// The kernels compiled for every level of vector instructions.
    #[doc(hidden)]
    fn kernels() -> &'static Kernels<Self>;
    /// The functions compiled once, in this library.
    #[doc(hidden)]
    fn drivers() -> &'static Drivers<Self>;
}

impl Real for f32 {
    #[inline]
    fn kernels() -> &'static Kernels<f32> {
        &crate::kernels::cpu::arch::F32
    }
    #[inline]
    fn drivers() -> &'static Drivers<f32> {
        &crate::kernels::cpu::drivers::F32
    }
}
impl Real for f64 {
    #[inline]
    fn kernels() -> &'static Kernels<f64> {
        &crate::kernels::cpu::arch::F64
    }
    #[inline]
    fn drivers() -> &'static Drivers<f64> {
        &crate::kernels::cpu::drivers::F64
    }
}

/// The one of two values, in `f32` and in `f64`, that has the type of the format in question.
pub(crate) fn in_format<X: 'static>(both: [&dyn Any; 2]) -> &X {
    let found = both.into_iter().find_map(|one| one.downcast_ref());
    found.unwrap_or_else(|| unreachable!("there are two formats"))
}
