//! Shapes as lists of scalars, in one order of fields for derivatives, batches and kernels.
//!
//! [`Pack`] flattens a shape into scalars, and `With<T>` is this shape over `T`: a gradient is a shape, a Hessian a
//! shape of gradients. [`Fixed`] adds a constant length, loads and stores slices, and names every scalar for errors.
use crate::error::{Field, Flaw, Validate};
use crate::{Real, Scalar};

pub use crate::scalar::number::{Fixed, Pack};

/// A lone number is a pack of one.
macro_rules! leaf {
    ($([$($generic:tt)*] $type:ty),* $(,)?) => { $(
        impl<$($generic)*> $crate::Pack for $type {
            type Scalar = Self;
            type With<R: Clone> = R;
            #[inline(always)]
            fn remake<R: Clone>(&self, f: &mut impl FnMut(&Self) -> R) -> R {
                f(self)
            }
            #[inline(always)]
            fn each(&mut self, f: &mut impl FnMut(&mut Self)) {
                f(self)
            }
        }
        impl<$($generic)*> $crate::Fixed for $type {
            type Of<R: $crate::Scalar> = R;
            const LEN: usize = 1;
            #[inline(always)]
            fn load(from: &[Self]) -> Self {
                from[0]
            }
            #[inline(always)]
            fn store(self, to: &mut [Self]) {
                to[0] = self;
            }
            #[inline(always)]
            fn filled(scalar: Self) -> Self {
                scalar
            }
            fn name(_: usize) -> $crate::error::Field {
                $crate::error::Field::VALUE
            }
        }
    )* };
}

pub(crate) use leaf;

leaf! {
    [] f32,
    [] f64,
    [T: Scalar, const N: usize] crate::Jet<T, N>,
    [T: Real, const N: usize] crate::Lanes<T, N>,
    [T: Copy + Send + Sync + 'static] num_dual::Real<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual2<T>,
    [T: Copy + Send + Sync + 'static] num_dual::Dual3<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperDual<T>,
    [T: Copy + Send + Sync + 'static] num_dual::HyperHyperDual<T>,
}

impl<S: Scalar<Mask = bool>> Validate for S {
    const FINITE_SUFFICES: bool = true;
    #[inline(always)]
    fn validate(&self) -> Result<(), Flaw> {
        if self.finite() {
            Ok(())
        } else {
            Err(Flaw::NotFinite(Field::VALUE))
        }
    }
}
