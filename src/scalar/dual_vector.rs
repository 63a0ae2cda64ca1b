//! `num-dual`'s vector duals as scalars (feature `nalgebra`).
//!
//! Only those of a size known at compile time are `Copy` and can be scalars. They cost several
//! times what a [`Jet`](crate::Jet) costs in a default build; take them where other code wants them.
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

#[cfg(test)]
mod tests {
    use crate::Obb2;
    use num_dual::DualSVec64;

    #[test]
    fn a_gradient_by_vector_duals() {
        let at = nalgebra::SVector::from([0.0, 0.0, 2.0, 2.0, 0.1]);
        let other = Obb2::new(0.5, 0.3, 2.0, 1.0, 0.4);
        let shape = |x: &[DualSVec64<5>]| Obb2::new(x[0], x[1], x[2], x[3], x[4]);
        let constant = crate::Pack::map(&other, &mut |&x| DualSVec64::from_re(x));
        let (value, derivatives) = num_dual::gradient(
            |x: nalgebra::SVector<DualSVec64<5>, 5>| shape(x.as_slice()).iou(constant),
            &at,
        );
        let ours = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.1);
        let (same, (a_bar, _)) = crate::ad::adjoint::overlap::iou_obb2_grad(ours, other);
        assert_eq!(value, same);
        for (x, y) in derivatives.iter().zip(crate::Pack::scalars(&a_bar)) {
            assert!((x - y).abs() < 1e-14);
        }
    }
}
