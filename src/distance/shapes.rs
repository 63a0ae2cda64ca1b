//! Every shape as an inflated core.
use super::box_core::BoundsCore;
use super::convex::Convex;
use super::convex::PairFormula;
use super::cores::{BoxCore, EdgeCore, PointCore, PolygonCore};
use crate::scalar::Guard;
use crate::{
    Aabb2, Capsule2, Circle, ConvexPolygon, Line2, Obb2, Ray2, Rotation2, Scalar, Segment2,
    Triangle2, Vec2,
};

impl<S: Scalar> Convex<S> for Vec2<S> {
    type Core = PointCore<S>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> PointCore<S> {
        PointCore(self)
    }
    #[inline(always)]
    fn take_formula<F: PairFormula<S>, B: Convex<S>>(self, other: B) -> F::Out {
        other.take_formula_after_point::<F>(self)
    }
    #[inline(always)]
    fn take_formula_after_point<F: PairFormula<S>>(self, first: Vec2<S>) -> F::Out {
        F::points(first, self)
    }
}

impl<S: Scalar> Convex<S> for Line2<S> {
    type Core = EdgeCore<S, 1, 2>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        EdgeCore::endless(self.point, self.direction)
    }
}

impl<S: Scalar> Convex<S> for Ray2<S> {
    type Core = EdgeCore<S, 1, 1>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        EdgeCore::endless(self.point, self.direction)
    }
}

impl<S: Scalar> Convex<S> for Segment2<S> {
    type Core = EdgeCore<S, 2, 0>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        EdgeCore::segment(self.from, self.to)
    }
}

impl<S: Scalar> Convex<S> for Triangle2<S> {
    type Core = PolygonCore<S, 3, true>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        PolygonCore(self.counter_clockwise())
    }
}

impl<S: Scalar> Convex<S> for Aabb2<S> {
    type Core = BoundsCore<S>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        BoundsCore {
            min: self.min,
            max: self.max,
        }
    }
    #[inline]
    fn take_formula<F: PairFormula<S>, B: Convex<S>>(self, other: B) -> F::Out {
        other.take_formula_after_aabb2::<F>(self)
    }
    #[inline]
    fn take_formula_after_aabb2<F: PairFormula<S>>(self, first: Aabb2<S>) -> F::Out {
        F::aabb2(first, self)
    }
}

impl<S: Scalar> Convex<S> for Obb2<S> {
    type Core = BoxCore<S, Rotation2<S>>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        BoxCore {
            center: self.center,
            half: Vec2::new(self.size.x.halved(), self.size.y.halved()),
            turn: Rotation2::from_angle(self.heading),
        }
    }
    #[inline]
    fn take_formula<F: PairFormula<S>, B: Convex<S>>(self, other: B) -> F::Out {
        other.take_formula_after_obb2::<F>(self)
    }
    #[inline]
    fn take_formula_after_obb2<F: PairFormula<S>>(self, first: Obb2<S>) -> F::Out {
        F::obb2(first, self)
    }
}

impl<S: Scalar> Convex<S> for Circle<S> {
    type Core = PointCore<S>;
    const ROUND: bool = true;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> PointCore<S> {
        PointCore(self.center)
    }
    #[inline(always)]
    fn radius(&self) -> S {
        self.radius
    }
}

impl<S: Scalar> Convex<S> for Capsule2<S> {
    type Core = EdgeCore<S, 2, 0>;
    const ROUND: bool = true;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        EdgeCore::segment(self.from, self.to)
    }
    #[inline(always)]
    fn radius(&self) -> S {
        self.radius
    }
}

/// The corners of a convex polygon, one after another around it, in either order. Corners may be repeated, so that a
/// polygon of fewer corners fits into an array for more: see [`repeat_last`]. Corners of a polygon that is not convex, or
/// out of order, have a finite distance without a meaning; [`ConvexPolygon`] checks them.
impl<S: Scalar, const N: usize> Convex<S> for [Vec2<S>; N] {
    type Core = PolygonCore<S, N>;
    #[inline(always)]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        guard.and(self)
    }
    #[inline(always)]
    fn core(self) -> Self::Core {
        PolygonCore(self)
    }
}

impl<S: Scalar, const N: usize> Convex<S> for ConvexPolygon<S, N> {
    type Core = PolygonCore<S, N>;
    #[inline(always)]
    fn core(self) -> Self::Core {
        PolygonCore(self.padded())
    }
}

/// Returns the polygon of the first `used` corners: the last of them is repeated to the end of the array. Derivatives
/// of corners beyond are zero. `used` is a whole number from 1 to N.
///
/// ```
/// use geograd::{Vec2, distance::repeat_last};
/// let (a, b, c) = (Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0));
/// let unused = Vec2::new(7.0, 7.0);
/// assert_eq!(repeat_last([a, b, c, unused], 3.0), [a, b, c, c]);
/// ```
#[must_use]
#[inline]
pub fn repeat_last<S: Scalar, const N: usize>(mut corners: [Vec2<S>; N], used: S) -> [Vec2<S>; N] {
    for k in 1..N {
        let beyond = used.at_most(S::lit(k as f64));
        corners[k] = Vec2::select(beyond, corners[k - 1], corners[k]);
    }
    corners
}
