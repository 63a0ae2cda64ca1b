//! What stands for the GPU in a build without the feature `gpu`: types without values, so that
//! [`Backend`](crate::kernels::Backend) is the same in both.
use crate::Fixed;
use crate::error::Validate;
use crate::kernels::GpuError;
use crate::kernels::op::{PairOp, RingOp};
use std::marker::PhantomData;

/// A GPU. There is none in a build without the feature `gpu`.
#[derive(Clone, Copy, Debug)]
pub enum Gpu {}

impl Gpu {
    /// A context, which a build without the feature `gpu` cannot have.
    ///
    /// # Errors
    ///
    /// Always [`GpuError::NotBuilt`].
    pub fn new() -> Result<Self, GpuError> {
        Err(GpuError::NotBuilt)
    }
}

impl std::fmt::Display for Gpu {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {}
    }
}

/// A shape that batches on a GPU take.
pub trait GpuShape: Fixed<Scalar = f32> + Validate + 'static {}
impl<P: Fixed<Scalar = f32> + Validate + 'static> GpuShape for P {}

/// An operation of two shapes that a GPU serves.
pub trait GpuPair:
    PairOp<A<f32> = <Self as GpuPair>::Shape, B<f32> = <Self as GpuPair>::Shape>
{
    /// Both shapes.
    type Shape: GpuShape;
}
impl<P: GpuShape, O: PairOp<A<f32> = P, B<f32> = P>> GpuPair for O {
    type Shape = P;
}

/// An operation of a ring that a GPU serves.
pub trait GpuRing: RingOp {}
impl<O: RingOp> GpuRing for O {}

/// Handles that nobody can have.
macro_rules! none {
    ($($name:ident)*) => { $(
        /// Stands for what is on a GPU.
        #[derive(Clone, Debug)]
        pub enum $name<T = ()> {
            /// Never made.
            #[doc(hidden)]
            Never(Gpu, PhantomData<fn() -> T>),
        }
    )* };
}
none! { Shapes Values Bars Matrix Bests Founds PairBars Pending Rings RingValues RingBars }
