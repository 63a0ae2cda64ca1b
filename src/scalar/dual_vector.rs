//! `num-dual`'s vector duals as scalars (feature `nalgebra`).
//!
//! Only those of a size known at compile time are `Copy` and can be scalars. They cost several times what a
//! [`Jet`](crate::Jet) costs in a default build; use them if other code needs them.
use crate::Scalar;
use crate::pack::leaf;
use crate::scalar::dual::Tangent;
use nalgebra::Const;
use num_dual::{DualNum, DualVec};

leaf! {
    [T: DualNum + Copy + Send + Sync + 'static, const N: usize] DualVec<T, Const<N>>,
}

impl<T: Scalar<Mask = bool> + DualNum + nalgebra::Scalar, const N: usize> Tangent
    for DualVec<T, Const<N>>
{
    type Inner = T;
    #[inline]
    fn value(self) -> T {
        self.re
    }
    #[inline]
    fn constant(value: T) -> Self {
        Self::from_re(value)
    }
    #[inline]
    fn chain(self, f: [T; 4]) -> Self {
        Self::new(f[0], self.eps * f[1])
    }
    #[inline]
    fn pick(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline]
    fn half(self) -> Self {
        Self::new(self.re.halved(), self.eps * T::lit(0.5))
    }
}
