//! The two formats to compute in, and what computes in them.
use geograd::Error;
use geograd::Obb2;
use geograd::kernels::real::Real;
use geograd::kernels::{Backend, Cpu, IouObb2, Op, Single, Table};
use std::fmt::Debug;
use std::str::FromStr;

/// Results of aligned pairs and their slopes with respect to both boxes.
pub type AlignedGrads<T> = (Vec<T>, Vec<Obb2<T>>, Vec<Obb2<T>>);
/// Results of all pairs and their slopes with respect to both boxes.
pub type PairGrads<T> = Table<(T, (Obb2<T>, Obb2<T>))>;

/// A format of numbers, and overlaps computed in it.
pub trait Number: Real + Single<Scalar = Self> + FromStr + Debug + Send + Sync {
    /// Whether GPUs compute in it.
    const ON_GPUS: bool;

    fn aligned(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, Error>;

    fn aligned_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<Self>, Error>;

    fn all_pairs(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, Error>;

    fn all_pairs_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<Self>, Error>;
}

impl Number for f32 {
    const ON_GPUS: bool = true;

    fn aligned(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, Error> {
        backend.aligned::<IouObb2>(a, b)
    }

    fn aligned_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<Self>, Error> {
        backend.aligned_grad::<IouObb2>(a, b)
    }

    fn all_pairs(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, Error> {
        backend.all_pairs::<IouObb2>(a, b)
    }

    fn all_pairs_grad(
        backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<Self>, Error> {
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
    ) -> Result<Vec<Self>, Error> {
        Ok(Cpu::new().aligned(IouObb2, (a, b))?)
    }

    fn aligned_grad(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<AlignedGrads<Self>, Error> {
        let (values, (a_bar, b_bar)) = Cpu::new().aligned(IouObb2.value_grad(), (a, b))?;
        Ok((values, a_bar, b_bar))
    }

    fn all_pairs(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<Vec<Self>, Error> {
        Ok(Cpu::new().all_pairs(IouObb2, a, b)?.into_planes())
    }

    fn all_pairs_grad(
        _backend: Backend<'_>,
        a: &[Obb2<Self>],
        b: &[Obb2<Self>],
    ) -> Result<PairGrads<Self>, Error> {
        Ok(Cpu::new().all_pairs(IouObb2.value_grad(), a, b)?)
    }
}
