//! The two formats to compute in.
use common::compute;
use geograd::kernels::item::Single;
use std::fmt::Debug;

/// A format of numbers.
pub trait Number:
    compute::Number + Single<Scalar = Self> + Debug + Into<f64> + Send + Sync
{
    /// `true` if GPUs compute in it.
    const ON_GPUS: bool;
}

impl Number for f32 {
    const ON_GPUS: bool = true;
}

impl Number for f64 {
    const ON_GPUS: bool = false;
}
