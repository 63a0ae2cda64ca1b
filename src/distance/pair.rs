//! The formula that a function of distance takes for a pair of shapes.
//!
//! Two points and two axis-aligned boxes have formulas of their own ([`upright`]), two rotated boxes, too
//! ([`turned`]); all other pairs are compared by their cores. Function, method and batch come through here, so that
//! they agree to the bit.
use super::convex::{Convex, PairFormula};
use super::corners::{Core, farthest};
use super::outcome::{Contact, PointPair};
use super::quantity::{Closest, Farthest, Penetrating, Signed, Squared, Unsigned};
use super::relation::{LENGTH, NORMAL, POINTS, relate};
use super::{edge, turned, upright};
use crate::arrays::Each;
use crate::{Aabb2, Obb2, Scalar, Vec2};

impl<S: Scalar> PairFormula<S> for Signed {
    type Out = S;
    const POINTS_KEEP_NAN: bool = true;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
        relate::<S, A, B, { LENGTH }>(a, b).signed(a.radius() + b.radius())
    }
    #[inline(always)]
    fn points(a: Vec2<S>, b: Vec2<S>) -> S {
        (a - b).length()
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> S {
        upright::signed_distance_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> S {
        turned::signed_distance_obb2(a, b)
    }
}

impl<S: Scalar> PairFormula<S> for Unsigned {
    type Out = S;
    const POINTS_KEEP_NAN: bool = true;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
        let apart = Signed::cores(a, b);
        S::select(apart.above(S::zero()), apart, S::zero()).canonical()
    }
    #[inline(always)]
    fn points(a: Vec2<S>, b: Vec2<S>) -> S {
        (a - b).length()
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> S {
        upright::distance_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> S {
        turned::distance_obb2(a, b)
    }
}

impl<S: Scalar> PairFormula<S> for Squared {
    type Out = S;
    const POINTS_KEEP_NAN: bool = true;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
        let found = relate::<S, A, B, { LENGTH }>(a, b);
        let square = if A::ROUND || B::ROUND {
            let apart = found.apart - (a.radius() + b.radius()) * found.scale;
            S::select(apart.above(S::zero()), apart * apart, S::zero())
        } else {
            found.square()
        };
        found.unscaled_square(square)
    }
    #[inline(always)]
    fn points(a: Vec2<S>, b: Vec2<S>) -> S {
        (a - b).length_squared().saturated()
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> S {
        upright::squared_distance_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> S {
        turned::squared_distance_obb2(a, b)
    }
}

impl<S: Scalar> PairFormula<S> for Closest {
    type Out = PointPair<S>;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> PointPair<S> {
        let found = relate::<S, A, B, { POINTS }>(a, b);
        let [mut on_a, mut on_b] =
            [found.on_a, found.on_b].each_as(|v| found.origin + found.unscaled(v));
        let none = found.normal.length_squared().equals(S::zero());
        let way = Vec2::select(none, aside(a.core(), b.core()), found.normal);
        if A::ROUND {
            on_a += way * a.radius();
        }
        if B::ROUND {
            on_b -= way * b.radius();
        }
        PointPair {
            on_a: on_a.canonical(),
            on_b: on_b.canonical(),
        }
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> PointPair<S> {
        upright::closest_points_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> PointPair<S> {
        turned::closest_points_obb2(a, b)
    }
}

impl<S: Scalar> PairFormula<S> for Penetrating {
    type Out = Contact<S>;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Contact<S> {
        let found = relate::<S, A, B, { NORMAL }>(a, b);
        found.penetration(a.radius() + b.radius(), found.normal)
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> Contact<S> {
        upright::penetration_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> Contact<S> {
        turned::penetration_obb2(a, b)
    }
}

impl<S: Scalar> PairFormula<S> for Farthest {
    type Out = S;
    #[inline]
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
        let (core_a, core_b) = (a.core(), b.core());
        let origin = core_a.anchor();
        let scale = edge::scale_of::<S>(core_a.extent(origin).most(core_b.extent(origin)));
        let (core_a, core_b) = (core_a.placed(origin, scale), core_b.placed(origin, scale));
        // Only the greatest one needs a root, and it is far from zero unless all points coincide.
        let (from, to) = (core_a.corners(), core_b.corners());
        let (from, to) = (from.as_ref(), to.as_ref());
        let square = match (A::Core::SYMMETRIC, B::Core::SYMMETRIC) {
            (true, false) => core_a.far(to),
            (false, true) => core_b.far(from),
            // Neither of two boxes comes first, so that exchanging them changes no derivative.
            _ => farthest(from, to),
        };
        let square = square.mean();
        (square.root().over(scale) + (a.radius() + b.radius())).canonical()
    }
    #[inline]
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> S {
        upright::farthest_distance_aabb2(a, b)
    }
    #[inline]
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> S {
        turned::farthest_distance_obb2(a, b)
    }
}

/// Returns a direction of length one that separates cores which meet and have no normal, a constant: across a part of a
/// line if the other core is a point, else along the first axis.
#[cfg_attr(not(debug_assertions), inline(always))]
fn aside<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> Vec2<S> {
    let first = Vec2::new(S::one(), S::zero());
    // All other pairs have a face that separates them, unless all their corners coincide.
    if A::DIMENSION + B::DIMENSION != 1 {
        return first;
    }
    let way = match A::DIMENSION {
        1 => along(a),
        _ => along(b),
    };
    let way = way * edge::scale_of::<S>(edge::size_of(way));
    let none = way.length_squared().equals(S::zero());
    Vec2::select(none, first, edge::direction(way.perp())).constant()
}

/// Returns the vector along a part of a line.
#[cfg_attr(not(debug_assertions), inline(always))]
fn along<S: Scalar, A: Core<S>>(core: A) -> Vec2<S> {
    match (core.corners().as_ref(), core.away().as_ref()) {
        (_, [away, ..]) => *away,
        ([from, to, ..], _) => *to - *from,
        _ => Vec2::zero(),
    }
}

/// Returns the [`signed_distance`](super::signed_distance) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn signed_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Signed, B>(b)
}
/// Returns the [`depth`](super::depth) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn depth<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    (-signed_distance(a, b)).canonical()
}
/// Returns the [`distance`](super::distance()) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Unsigned, B>(b)
}
/// Returns the [`squared_distance`](super::squared_distance) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn squared_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Squared, B>(b)
}
/// Returns the [`closest_points`](super::closest_points) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn closest_points<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> PointPair<S> {
    a.take_formula::<Closest, B>(b)
}
/// Returns the [`penetration`](super::penetration) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn penetration<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Contact<S> {
    a.take_formula::<Penetrating, B>(b)
}
/// Returns the [`farthest_distance`](super::farthest_distance) of shapes whose numbers are known to be finite.
#[inline]
pub(crate) fn farthest_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Farthest, B>(b)
}
