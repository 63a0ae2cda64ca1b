//! NaN in, NaN out: the formulas of distances for arguments that nobody has checked.
use super::convex::{Convex, PairFormula};
use crate::scalar::Guard;
use crate::{Aabb2, Fixed, Obb2, Scalar, Vec2};
use std::marker::PhantomData;

/// A formula whose result is NaN where a number of its arguments is.
pub(super) struct Guarded<F>(PhantomData<F>);

impl<S: Scalar, F: PairFormula<S>> PairFormula<S> for Guarded<F>
where
    F::Out: Fixed<Scalar = S>,
{
    type Out = F::Out;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> F::Out {
        b.guarded(a.guarded(Guard::new())).result(F::cores(a, b))
    }
    #[inline(always)]
    fn points(a: Vec2<S>, b: Vec2<S>) -> F::Out {
        match F::POINTS_KEEP_NAN {
            true => F::points(a, b),
            false => Guard::of(&a).and(&b).result(F::points(a, b)),
        }
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> F::Out {
        Guard::of(&a).and(&b).result(F::aabb2(a, b))
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> F::Out {
        Guard::of(&a).and(&b).result(F::obb2(a, b))
    }
}
