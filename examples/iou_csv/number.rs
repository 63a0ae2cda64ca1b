//! The two formats to compute in, and what computes in them.
use geograd::Obb2;
use geograd::kernels::cpu::{self, AlignedGrads, PairGrads};
use geograd::kernels::overlap::IouObb2;
use geograd::kernels::real::Real;
use geograd::kernels::{Backend, GpuError};
use std::fmt::Debug;
use std::str::FromStr;

/// A format of numbers, and overlaps computed in it.
pub trait Number: Real + FromStr + Debug + Send + Sync {
    /// Whether GPUs compute in it.
    const ON_GPUS: bool;

    fn aligned(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError>;

    fn aligned_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<IouObb2, Self>, GpuError>;

    fn all_pairs(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError>;

    fn all_pairs_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<IouObb2, Self>, GpuError>;
}

impl Number for f32 {
    const ON_GPUS: bool = true;

    fn aligned(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError> {
        backend.aligned::<IouObb2>(a, b)
    }

    fn aligned_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<IouObb2, Self>, GpuError> {
        backend.aligned_grad::<IouObb2>(a, b)
    }

    fn all_pairs(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError> {
        backend.all_pairs::<IouObb2>(a, b)
    }

    fn all_pairs_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<IouObb2, Self>, GpuError> {
        backend.all_pairs_grad::<IouObb2>(a, b)
    }
}

/// On the CPU whatever the backend: nothing else has the format, and [`Number::ON_GPUS`] says so.
impl Number for f64 {
    const ON_GPUS: bool = false;

    fn aligned(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError> {
        Ok(cpu::aligned::<IouObb2, Self>(a, b)?)
    }

    fn aligned_grad(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<IouObb2, Self>, GpuError> {
        Ok(cpu::aligned_grad::<IouObb2, Self>(a, b)?)
    }

    fn all_pairs(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, GpuError> {
        Ok(cpu::all_pairs::<IouObb2, Self>(a, b)?)
    }

    fn all_pairs_grad(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<IouObb2, Self>, GpuError> {
        Ok(cpu::all_pairs_grad::<IouObb2, Self>(a, b)?)
    }
}
