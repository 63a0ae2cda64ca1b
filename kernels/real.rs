//! The two formats that batches serve.
use crate::ad::check::subject::Subject;
use crate::ad::check::trace::Number;
use crate::ad::program::Plain;
use crate::kernels::cpu::arch::Kernels;
use crate::kernels::cpu::drivers::Drivers;
use crate::kernels::cpu::lane::Kept;
use crate::kernels::fuzz::{self, Fuzzed, Job};
use crate::kernels::recorded_subject::RecordedSubject;
use crate::{Pack, Scalar};

/// `f32` or `f64`: the formats that batches serve.
pub trait Real:
    Scalar<Mask = bool, Primal = Self> + Plain + Pack<Scalar = Self> + Default + PartialOrd + Kept
{
    /// What is compiled for every level of vector instructions.
    #[doc(hidden)]
    fn kernels() -> &'static Kernels<Self>;
    /// What is compiled once, in this library.
    #[doc(hidden)]
    fn drivers() -> &'static Drivers<Self>;
    /// Hands a recorded operation to whoever judges it. A function of a concrete format is compiled in this library,
    /// with its optimisation; a generic one would be compiled anew wherever an operation is checked.
    #[doc(hidden)]
    fn judged(subject: &RecordedSubject<'_, Self>, judge: &mut dyn FnMut(&dyn Subject))
    where
        Self: Number;
    /// Fuzzes an operation; for the same reason.
    #[doc(hidden)]
    fn fuzzed(job: &Job<Self>, count: u64, seed: u64) -> Fuzzed;
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
    fn judged(subject: &RecordedSubject<'_, f32>, judge: &mut dyn FnMut(&dyn Subject)) {
        judge(subject);
    }
    fn fuzzed(job: &Job<f32>, count: u64, seed: u64) -> Fuzzed {
        fuzz::run(job, count, seed)
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
    fn judged(subject: &RecordedSubject<'_, f64>, judge: &mut dyn FnMut(&dyn Subject)) {
        judge(subject);
    }
    fn fuzzed(job: &Job<f64>, count: u64, seed: u64) -> Fuzzed {
        fuzz::run(job, count, seed)
    }
}
