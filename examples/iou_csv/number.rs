//! The two formats to compute in.
use crate::boxes::{Pairs, Scores, on_cpu};
use geograd::kernels::Runs;
use geograd::kernels::item::Single;
use geograd::kernels::op::ValueGrad;
use geograd::kernels::real::Real;
use geograd::kernels::{Backend, Iof, Iou};
use geograd::{Error, Obb2};
use std::fmt::Debug;
use std::str::FromStr;

/// A format of numbers, and overlaps of rotated boxes computed in it on any machine.
pub trait Number: Real + Single<Scalar = Self> + FromStr + Debug + Into<f64> + Send + Sync {
    /// `true` if GPUs compute in it.
    const ON_GPUS: bool;

    fn iou(
        backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<Self>>,
        grad: bool,
    ) -> Result<Scores<Obb2<Self>>, Error>;

    fn iof(
        backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<Self>>,
        grad: bool,
    ) -> Result<Scores<Obb2<Self>>, Error>;
}

impl Number for f32 {
    const ON_GPUS: bool = true;

    fn iou(
        backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<f32>>,
        grad: bool,
    ) -> Result<Scores<Obb2<f32>>, Error> {
        anywhere(backend, Iou, pairs, grad)
    }

    fn iof(
        backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<f32>>,
        grad: bool,
    ) -> Result<Scores<Obb2<f32>>, Error> {
        anywhere(backend, Iof, pairs, grad)
    }
}

/// On the CPU whatever the backend: nothing else has the format, and [`Number::ON_GPUS`] says so.
impl Number for f64 {
    const ON_GPUS: bool = false;

    fn iou(
        _backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<f64>>,
        grad: bool,
    ) -> Result<Scores<Obb2<f64>>, Error> {
        on_cpu(Iou, pairs, grad)
    }

    fn iof(
        _backend: Backend<'_>,
        pairs: Pairs<'_, Obb2<f64>>,
        grad: bool,
    ) -> Result<Scores<Obb2<f64>>, Error> {
        on_cpu(Iof, pairs, grad)
    }
}

/// On whatever machine the backend is.
fn anywhere<O>(
    backend: Backend<'_>,
    op: O,
    pairs: Pairs<'_, Obb2<f32>>,
    grad: bool,
) -> Result<Scores<Obb2<f32>>, Error>
where
    O: Runs<(Obb2<f32>, Obb2<f32>), Out = f32> + Copy,
{
    if let Backend::Cpu = backend {
        return on_cpu(op, pairs, grad);
    }
    match pairs {
        Pairs::Aligned(a, b) if grad => {
            let (values, (a_bar, b_bar)) = backend.aligned(ValueGrad::of(op), (a, b))?;
            Ok(Scores::with_derivatives(values, a_bar, b_bar))
        }
        Pairs::Aligned(a, b) => Ok(Scores::new(backend.aligned(op, (a, b))?)),
        Pairs::All(a, b) if grad => Ok(Scores::from_table(&backend.all_pairs(
            ValueGrad::of(op),
            a,
            b,
        )?)),
        Pairs::All(a, b) => Ok(Scores::new(backend.all_pairs(op, a, b)?.into_planes())),
    }
}
