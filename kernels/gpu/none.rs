//! What stands for the GPU in a build without the feature `gpu`: types without values, so that
//! [`Backend`](crate::kernels::Backend) is the same in both.
use crate::error::Validate;
use crate::kernels::op::{Op, RingOp};
use crate::kernels::row::Row;
use crate::{Aabb2, Obb2};
use crate::{Error, GpuFault};
use std::marker::PhantomData;

/// A GPU. There is none in a build without the feature `gpu`.
#[derive(Clone, Copy, Debug)]
pub enum Gpu {}

impl Gpu {
    /// A context, which a build without the feature `gpu` cannot have.
    ///
    /// # Errors
    ///
    /// Always [`GpuFault::NotBuilt`](crate::GpuFault::NotBuilt).
    pub fn new() -> Result<Self, Error> {
        Err(Error::Gpu(GpuFault::NotBuilt))
    }
}

impl std::fmt::Display for Gpu {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {}
    }
}

/// A shape that batches on a GPU take.
pub trait GpuShape: Row<Scalar = f32, Many = Vec<Self>> + Validate + std::fmt::Debug {}
impl GpuShape for Obb2<f32> {}
impl GpuShape for Aabb2<f32> {}

/// An operation of two shapes that a GPU serves.
pub trait GpuPair:
    Op<In<f32> = (<Self as GpuPair>::Shape, <Self as GpuPair>::Shape), Out<f32> = f32>
{
    /// Both shapes.
    type Shape: GpuShape;
}
/// Lists the operations that a GPU serves.
macro_rules! served {
    ($($shape:ident: $($op:ident)*;)*) => { $($(
        impl GpuPair for crate::kernels::$op {
            type Shape = $shape<f32>;
        }
    )*)* };
}
served! {
    Obb2: IntersectionAreaObb2 IouObb2 IofObb2;
    Aabb2: IntersectionAreaAabb2 IouAabb2 IofAabb2;
}

/// An operation of a ring that a GPU serves.
pub trait GpuRing: RingOp {}
impl GpuRing for crate::kernels::SignedArea {}
impl GpuRing for crate::kernels::Perimeter {}
impl GpuRing for crate::kernels::Centroid {}

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
none! { Shapes Values Bars Matrix Bests Founds PairBars Pending HeldColumn Rings RingValues RingBars }
