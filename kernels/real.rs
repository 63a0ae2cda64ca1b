//! The two formats that batches serve, each with its bundle of lanes.
use crate::float::Float;
use crate::{Lanes, Pack, Scalar};

/// A bundle of lanes that a batch can fill and read.
pub trait Bundle<T>: Scalar {
    /// How many.
    const WIDTH: usize;
    /// The same number in every lane.
    fn splat(x: T) -> Self;
    /// The lanes.
    fn lanes(&self) -> &[T];
    /// The lanes, to be written.
    fn lanes_mut(&mut self) -> &mut [T];
}

/// `f32` or `f64`: the formats that batches serve.
pub trait Real:
    Scalar<Mask = bool, Primal = Self> + Float + Pack<Scalar = Self> + Default + PartialOrd
{
    /// As many lanes as fill the widest registers.
    type Bundle: Bundle<Self>;
    /// One lane, for what is too rare to be compiled for every instruction set.
    type Single: Bundle<Self>;
}

impl Real for f32 {
    type Bundle = Lanes<f32, 16>;
    type Single = Lanes<f32, 1>;
}
impl Real for f64 {
    type Bundle = Lanes<f64, 8>;
    type Single = Lanes<f64, 1>;
}

/// A bundle of one format.
macro_rules! bundle {
    ($f:ident) => {
        impl<const N: usize> Bundle<$f> for Lanes<$f, N> {
            const WIDTH: usize = N;
            #[inline(always)]
            fn splat(x: $f) -> Self {
                Lanes([x; N])
            }
            #[inline(always)]
            fn lanes(&self) -> &[$f] {
                &self.0
            }
            #[inline(always)]
            fn lanes_mut(&mut self) -> &mut [$f] {
                &mut self.0
            }
        }
    };
}
bundle!(f32);
bundle!(f64);
