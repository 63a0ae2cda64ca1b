//! The stand-in of the GPU in a build without the feature `gpu`: types without values, so that
//! [`Backend`](crate::kernels::Backend) is the same in both.
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

/// Handles without values.
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
none! { Matrix Bests Founds Pending HeldColumn Rings RingValues RingBars }
