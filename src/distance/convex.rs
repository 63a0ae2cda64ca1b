//! Convex shapes as distances take them: a core of few corners, inflated by a radius.
use super::beam::{Beam, Inside};
use super::edge::{Edge, reach, size_of};
use super::share::{Ahead, Best, Deepest, Nearest};
use crate::scalar::Guard;
use crate::{Aabb2, Obb2, Scalar, Vec2};

/// A convex shape: every point at most [`radius`](Convex::radius) from its [`core`](Convex::core).
///
/// Points, lines, rays, segments, triangles, boxes, circles, capsules, convex polygons and arrays of corners are. The
/// functions of [`distance`](mod@crate::distance) and [`intersection`](crate::intersection) take any
/// two of them; those of distances are methods, too.
///
/// ```
/// use geograd::distance::Convex;
/// use geograd::{Circle, Obb2, Segment2, Vec2};
/// let car = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let tree = Circle::new(Vec2::new(0.0, 4.0), 1.0);
/// assert_eq!(car.distance(tree), 2.0);
/// assert_eq!(tree.signed_distance(tree.center), -1.0);
/// let curb = Segment2::new(Vec2::new(2.5, -9.0), Vec2::new(2.5, 9.0));
/// assert_eq!(car.closest_points(curb).on_b.x, 2.5);
/// ```
///
/// Batches of verbs take the pairs that have a row: the table of [`verbs`](crate::kernels::verbs). Any other pair runs by
/// [`function`](crate::kernels::verbs::function), with derivatives, too:
///
/// ```
/// use geograd::prelude::*;
/// let curbs = [Segment2::new(Vec2::new(2.5_f64, -9.0), Vec2::new(2.5, 9.0))];
/// let cars = [Triangle2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0))];
/// let gap = function(|curb: Segment2<_>, car: Triangle2<_>| curb.distance(car));
/// let (distance, (_, by_car)) = Cpu::new().aligned(gap.value_grad(), (&curbs, &cars))?;
/// assert_eq!((distance[0], by_car[0].b.x), (1.5, -1.0));
/// # Ok::<(), geograd::Error>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "the methods of distances do not take `{Self}`",
    label = "not a convex shape of the plane",
    note = "a row of `Distance` for shapes of your own is called by `Distance.of(a, b)` and by batches",
    note = "`impl Convex` gives a convex shape of the plane the distances from all others"
)]
pub trait Convex<S: Scalar>: Copy {
    /// The core: the shape before it is inflated. A shape of one's own has the core of a shape of the library, such as
    /// `<Triangle2<S> as Convex<S>>::Core`.
    type Core: Core<S>;
    /// `true` if the radius may be other than zero.
    const ROUND: bool = false;
    /// The core that is inflated.
    fn core(self) -> Self::Core;
    /// The radius of inflation; not negative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn radius(&self) -> S {
        S::zero()
    }
    /// A guard with the numbers of the shape: by default with those of its corners and its radius.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        let core = self.core();
        let (corners, away) = (core.corners(), core.away());
        let all = corners.as_ref().iter().chain(away.as_ref());
        all.fold(guard.and(&self.radius()), |guard, corner| guard.and(corner))
    }
    /// The distance, 0 where the shapes touch or overlap: [`distance`](super::distance()).
    #[must_use]
    #[inline]
    fn distance<B: Convex<S>>(self, other: B) -> S {
        super::distance(self, other)
    }
    /// The square of the distance: [`squared_distance`](super::squared_distance).
    #[must_use]
    #[inline]
    fn squared_distance<B: Convex<S>>(self, other: B) -> S {
        super::squared_distance(self, other)
    }
    /// The distance, or minus the depth of overlap: [`signed_distance`](super::signed_distance).
    #[must_use]
    #[inline]
    fn signed_distance<B: Convex<S>>(self, other: B) -> S {
        super::signed_distance(self, other)
    }
    /// A point of each, nearest to each other: [`closest_points`](super::closest_points).
    #[must_use]
    #[inline]
    fn closest_points<B: Convex<S>>(self, other: B) -> super::PointPair<S> {
        super::closest_points(self, other)
    }
    /// How deep the shapes overlap, and the way out: [`penetration`](super::penetration).
    #[must_use]
    #[inline]
    fn penetration<B: Convex<S>>(self, other: B) -> super::Contact<S> {
        super::penetration(self, other)
    }
    /// The longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    #[inline]
    fn farthest_distance<B: Convex<S>>(self, other: B) -> S {
        super::farthest_distance(self, other)
    }
    /// The points between which that is: [`farthest_points`](super::farthest_points).
    #[must_use]
    #[inline]
    fn farthest_points<B: Convex<S>>(self, other: B) -> super::FarthestPoints<S> {
        super::farthest_points(self, other)
    }
    /// The function of this shape and another one by the [formula](super::pair) for their kinds.
    #[doc(hidden)]
    #[inline]
    fn take_formula<F: PairFormula<S>, B: Convex<S>>(self, other: B) -> F::Out {
        F::cores(self, other)
    }
    /// The same where the first shape is known to be a point.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_point<F: PairFormula<S>>(self, first: Vec2<S>) -> F::Out {
        F::cores(first, self)
    }
    /// The same where the first shape is known to be an axis-aligned box.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_aabb2<F: PairFormula<S>>(self, first: Aabb2<S>) -> F::Out {
        F::cores(first, self)
    }
    /// The same where the first shape is known to be a rotated box.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_obb2<F: PairFormula<S>>(self, first: Obb2<S>) -> F::Out {
        F::cores(first, self)
    }
}

/// A function of two convex shapes, with a formula for each kind of pair.
pub trait PairFormula<S: Scalar> {
    /// Its result.
    type Out;
    /// `true` if the result for two points is NaN anyway where one of their numbers is.
    const POINTS_KEEP_NAN: bool = false;
    /// The result for any two shapes, by their cores.
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Self::Out;
    /// The result for two points.
    #[inline]
    fn points(a: Vec2<S>, b: Vec2<S>) -> Self::Out {
        Self::cores(a, b)
    }
    /// The result for two axis-aligned boxes.
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> Self::Out;
    /// The result for two rotated boxes.
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> Self::Out;
}

/// The core of a convex shape: the hull of some corners and of some directions in which it has no
/// end. The cores are those of the library's shapes: a shape of one's own has that of the shape it
/// is like.
///
/// Two halves make every distance: what the faces and edges of one core are to the corners of the
/// other, and the same the other way round.
#[doc(hidden)]
pub trait Core<S: Scalar>: Copy {
    /// The corners, in an array.
    type Corners: AsRef<[Vec2<S>]>;
    /// The directions without end, in an array.
    type Away: AsRef<[Vec2<S>]>;
    /// 0 for a point, 1 for a piece of a line, 2 for what has an area.
    const DIMENSION: usize;
    /// `true` if it ends in every direction.
    const BOUNDED: bool = true;
    /// `true` if it is a box, whose corners need not be compared to know the farthest one from a point.
    const SYMMETRIC: bool = false;
    /// A point of it, or near it, from which the others are seen.
    fn anchor(&self) -> Vec2<S>;
    /// How far its corners are from a point at most, coordinate by coordinate, as a constant.
    fn extent(&self, from: Vec2<S>) -> S::Primal;
    /// The core seen from a point, in other units.
    #[must_use]
    fn placed(self, from: Vec2<S>, scale: S) -> Self;
    /// The corners, around the core where there are more than two.
    fn corners(&self) -> Self::Corners;
    /// The directions without end.
    fn away(&self) -> Self::Away;
    /// The corner that is nearest to an edge of this core, and where.
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>>;
    /// The square of the longest way from a corner of this core to one of others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn far(&self, corners: &[Vec2<S>]) -> Best<S, S> {
        farthest(self.corners().as_ref(), corners)
    }
    /// The part of a line inside of the core; for a piece of a line, inside of the strip of `radius` to both
    /// sides of it.
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S>;
    /// The least of `normal · point` over the corners, and the corner.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec2<S>) -> Best<S, Ahead<S>> {
        Best::least(self.corners().as_ref().iter().map(|&on_b| {
            let ahead = normal.dot(on_b);
            Best::of(ahead, Ahead { ahead, on_b })
        }))
    }
    /// The face that parts this core best from another one.
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>>;
}

/// The square of the longest way from some corners to others.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn farthest<S: Scalar>(from: &[Vec2<S>], to: &[Vec2<S>]) -> Best<S, S> {
    Best::most_of(from.iter().flat_map(|&p| {
        to.iter().map(move |&q| {
            let square = (q - p).length_squared();
            Best::of(square, square)
        })
    }))
}

/// The nearest of some corners to an edge.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edge_near<S: Scalar>(edge: Edge<S>, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
    Best::least(corners.iter().map(|&corner| {
        let found = reach(edge, corner - edge.from);
        let on_self = edge.from + edge.along * found.t;
        Best::of(
            found.apart.length_squared(),
            Nearest {
                apart: found.apart,
                on_a: on_self,
                on_b: corner,
            },
        )
    }))
}

/// How far in front of a face another core begins. The normal points out and has length one, or zero
/// where the face has no length: such a face parts nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn face_deep<S: Scalar, B: Core<S>>(
    face: Edge<S>,
    normal: Vec2<S>,
    other: &B,
) -> Best<S, Deepest<S>> {
    let first = other.lowest(normal);
    let none = normal.x.equals(S::zero()) & normal.y.equals(S::zero());
    let away = other.away();
    let useless = away.as_ref().iter().fold(none, |useless, direction| {
        useless | normal.dot(*direction).below(S::zero())
    });
    let height = normal.dot(face.from);
    // The middle of the corners that tie may lie beyond the end of the face, though some point between
    // them does not; or it lies before another face of the same line.
    let lowest = first.mean();
    let foot = reach(face, lowest.on_b - face.from);
    let on_a = face.from + face.along * foot.t;
    // Above the face the point itself, which one found from the face would only be to the face's digits.
    let above = foot.free.equals(foot.t);
    let beside = on_a + normal * (lowest.ahead - height);
    let beyond = (foot.free - foot.t).magnitude() * S::from_primal(size_of(face.along));
    let (low, high) = (face.low.halved(), face.high.halved());
    let middle = face.from + face.along * (low + high);
    let half = (high - low) * normal.perp_dot(face.along).unsigned();
    let value = S::select(useless, S::lit(-S::LARGEST), first.value - height);
    Best {
        value,
        sum: Deepest {
            ahead: first.sum.ahead - height * first.count,
            level: value,
            normal,
            on_a,
            on_b: Vec2::select(above, lowest.on_b, beside),
            beyond,
            middle: Vec2::new(
                S::from_primal(middle.x.primal()),
                S::from_primal(middle.y.primal()),
            ),
            half: S::from_primal(half.primal()),
            lead: normal,
        },
        count: first.count,
    }
}
