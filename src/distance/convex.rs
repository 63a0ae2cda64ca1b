//! Convex shapes as distances take them, a core of few corners, inflated by a radius; and the functions of any two.
use super::corners::Core;
use super::edge::{direction, scale_of};
use super::outcome::{Contact, FarthestPoints, PointPair};
use super::quantity::{Closest, Farthest, Penetrating, Signed, Squared, Unsigned};
use crate::scalar::Guard;
use crate::{Aabb2, Fixed, Obb2, Scalar, Vec2};
use std::marker::PhantomData;

/// A convex shape: every point at most [`radius`](Convex::radius) from its [`core`](Convex::core).
///
/// Points, lines, rays, segments, triangles, boxes, circles, capsules, convex polygons and arrays of corners are convex
/// shapes. The functions of [`distance`](mod@crate::distance) and [`intersection`](crate::intersection) take any two of
/// them; the functions of distances are methods, too.
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
    /// Returns the core that is inflated.
    fn core(self) -> Self::Core;
    /// Returns the radius of inflation; not negative.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn radius(&self) -> S {
        S::zero()
    }
    /// Returns a guard with the numbers of the shape: by default with those of its corners and its radius.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn guarded(&self, guard: Guard<S>) -> Guard<S> {
        let core = self.core();
        let (corners, away) = (core.corners(), core.away());
        let all = corners.as_ref().iter().chain(away.as_ref());
        all.fold(guard.and(&self.radius()), |guard, corner| guard.and(corner))
    }
    /// Returns the distance, 0 where the shapes touch or overlap: [`distance`](super::distance()).
    #[must_use]
    #[inline]
    fn distance<B: Convex<S>>(self, other: B) -> S {
        distance(self, other)
    }
    /// Returns the square of the distance: [`squared_distance`](super::squared_distance).
    #[must_use]
    #[inline]
    fn squared_distance<B: Convex<S>>(self, other: B) -> S {
        squared_distance(self, other)
    }
    /// Returns the distance, or minus the depth of overlap: [`signed_distance`](super::signed_distance).
    #[must_use]
    #[inline]
    fn signed_distance<B: Convex<S>>(self, other: B) -> S {
        signed_distance(self, other)
    }
    /// Returns a point of each, nearest to each other: [`closest_points`](super::closest_points).
    #[must_use]
    #[inline]
    fn closest_points<B: Convex<S>>(self, other: B) -> PointPair<S> {
        closest_points(self, other)
    }
    /// Returns the depth of the overlap and the shortest direction that separates the shapes:
    /// [`penetration`](super::penetration).
    #[must_use]
    #[inline]
    fn penetration<B: Convex<S>>(self, other: B) -> Contact<S> {
        penetration(self, other)
    }
    /// Returns the longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    #[inline]
    fn farthest_distance<B: Convex<S>>(self, other: B) -> S {
        farthest_distance(self, other)
    }
    /// Returns the points between which that is: [`farthest_points`](super::farthest_points).
    #[must_use]
    #[inline]
    fn farthest_points<B: Convex<S>>(self, other: B) -> FarthestPoints<S> {
        farthest_points(self, other)
    }
    /// Returns the function of this shape and another one by the [formula](super::pair) for their kinds.
    #[doc(hidden)]
    #[inline]
    fn take_formula<F: PairFormula<S>, B: Convex<S>>(self, other: B) -> F::Out {
        F::cores(self, other)
    }
    /// Takes a formula like `take_formula`, if the first shape is known to be a point.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_point<F: PairFormula<S>>(self, first: Vec2<S>) -> F::Out {
        F::cores(first, self)
    }
    /// Takes a formula like `take_formula`, if the first shape is known to be an axis-aligned box.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_aabb2<F: PairFormula<S>>(self, first: Aabb2<S>) -> F::Out {
        F::cores(first, self)
    }
    /// Takes a formula like `take_formula`, if the first shape is known to be a rotated box.
    #[doc(hidden)]
    #[inline]
    fn take_formula_after_obb2<F: PairFormula<S>>(self, first: Obb2<S>) -> F::Out {
        F::cores(first, self)
    }
}

/// A function of two convex shapes, with a formula for each kind of pair.
#[doc(hidden)]
pub trait PairFormula<S: Scalar> {
    /// Its result.
    type Out;
    /// `true` if the result for two points is NaN anyway where one of their numbers is.
    const POINTS_KEEP_NAN: bool = false;
    /// Returns the result for any two shapes, by their cores.
    fn cores<A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Self::Out;
    /// Returns the result for two points.
    #[inline]
    fn points(a: Vec2<S>, b: Vec2<S>) -> Self::Out {
        Self::cores(a, b)
    }
    /// Returns the result for two axis-aligned boxes.
    fn aabb2(a: Aabb2<S>, b: Aabb2<S>) -> Self::Out;
    /// Returns the result for two rotated boxes.
    fn obb2(a: Obb2<S>, b: Obb2<S>) -> Self::Out;
}

/// A formula whose result is NaN where a number of its arguments is.
struct Guarded<F>(PhantomData<F>);

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

/// Returns the signed distance of two convex shapes, in the unit of length: the distance of their nearest points, or
/// minus the length of the shortest translation after which they only touch.
///
/// Minus the largest finite number for two lines that cross. Derivatives and kinks: see the
/// [module](super); on the border of a shape with an area it is smooth.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::signed_distance};
/// let square = Aabb2::new(-1.0, -1.0, 1.0, 1.0);
/// assert_eq!(signed_distance(Vec2::new(0.5, 0.0), square), -0.5);
/// assert_eq!(signed_distance(square, Circle::new(Vec2::new(4.0, 5.0), 2.0)), 3.0);
/// // On the extension of an edge is outside.
/// assert_eq!(signed_distance(Vec2::new(3.0, 1.0), square), 2.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<Signed>, B>(b)
}

/// Returns the signed distance with DGAL's sign, in the unit of length: positive where shapes overlap, negative apart.
///
/// It measures shapes that are to stay inside, such as a robot in its lane. The clearance to an obstacle is
/// [`distance`].
///
/// ```
/// use geograd::{Aabb2, Vec2, distance::depth};
/// assert_eq!(depth(Aabb2::new(-1.0, -1.0, 1.0, 1.0), Vec2::new(0.5, 0.0)), 0.5);
/// ```
#[must_use]
#[inline]
pub fn depth<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    (-signed_distance(a, b)).canonical()
}

/// Returns the distance of two convex shapes, in the unit of length; 0 with derivative zero where they touch or
/// overlap.
///
/// Derivatives and kinks: see the [module](super).
///
/// ```
/// use geograd::{Obb2, Segment2, Vec2, distance::distance};
/// let car = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let curb = Segment2::new(Vec2::new(5.0, 5.0), Vec2::new(9.0, 5.0));
/// assert_eq!(distance(car, curb), 5.0);
/// assert_eq!(distance(curb, curb.from), 0.0);
/// ```
#[must_use]
#[inline]
pub fn distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<Unsigned>, B>(b)
}

/// Returns the squared distance of two convex shapes; 0 where they touch or overlap. Once differentiable
/// wherever the nearest points are. Saturates at the largest finite number.
///
/// ```
/// use geograd::{Segment2, Vec2, distance::squared_distance};
/// let curb = Segment2::new(Vec2::new(0.0, 1.0), Vec2::new(9.0, 1.0));
/// assert_eq!(squared_distance(curb, Vec2::new(-3.0, 5.0)), 25.0);
/// ```
#[must_use]
#[inline]
pub fn squared_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<Squared>, B>(b)
}

/// Returns the points in which two convex shapes are nearest to each other.
///
/// For shapes that overlap they are the points that [`penetration`] brings together: `on_b` is that point of b which is
/// deepest in a (or the reverse), `on_a` the point of a's border to which it must go. Circles with one centre, and
/// other round shapes whose cores meet in a point, leave each other in several directions; the points are those of one.
/// Ties and derivatives: see the [module](super). The points of two lines that cross are nearest to each other's given
/// points and have no meaning.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::closest_points};
/// let found = closest_points(Aabb2::new(0.0, 0.0, 2.0, 2.0), Circle::new(Vec2::new(5.0, 1.0), 1.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(2.0, 1.0), Vec2::new(4.0, 1.0)));
/// ```
#[must_use]
#[inline]
pub fn closest_points<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> PointPair<S> {
    a.take_formula::<Guarded<Closest>, B>(b)
}

/// Returns the depth by which two convex shapes overlap, and the direction in which b leaves a by the shortest
/// translation.
///
/// The depth has derivatives by the envelope theorem, like a distance; it is 0 with derivative zero where the
/// shapes are apart or touch, and the largest finite number for two lines that cross.
///
/// ```
/// use geograd::{Aabb2, Obb2, Vec2, distance::penetration};
/// let found = penetration(Aabb2::new(0.0, 0.0, 4.0, 4.0), Obb2::new(4.5, 2.0, 2.0, 2.0, 0.0));
/// assert_eq!((found.depth, found.direction), (0.5, Vec2::new(1.0, 0.0)));
/// ```
#[must_use]
#[inline]
pub fn penetration<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> Contact<S> {
    a.take_formula::<Guarded<Penetrating>, B>(b)
}

/// Returns the longest distance of a point of one shape from a point of the other, in the unit of length. For
/// bounded shapes; of a ray or a line only the given point counts.
///
/// Pairs of corners that are equally far share the derivative; two equal points have derivative zero.
///
/// ```
/// use geograd::{Aabb2, distance::farthest_distance};
/// // A small box in a large one: from a corner to the opposite corner of the other.
/// let found = farthest_distance(Aabb2::new(0.0, 0.0, 10.0, 10.0), Aabb2::new(4.0, 4.0, 6.0, 6.0));
/// assert_eq!(found, 72.0_f64.sqrt());
/// ```
#[must_use]
#[inline]
pub fn farthest_distance<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> S {
    a.take_formula::<Guarded<Farthest>, B>(b)
}

/// Returns the points between which [`farthest_distance`] is: corners of both, or the points of round shapes beyond
/// their centres and ends. For bounded shapes; only the given point of a ray or a line counts.
///
/// The first of several pairs that are equally far counts, along a's corners and then b's, so that both are
/// corners: points jump where pairs tie. Round shapes with one centre have two ends of one diameter.
///
/// ```
/// use geograd::{Aabb2, Circle, Vec2, distance::farthest_points};
/// let square = Aabb2::new(0.0, 0.0, 10.0, 10.0);
/// let found = farthest_points(square, Vec2::new(6.0, 4.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(0.0, 10.0), Vec2::new(6.0, 4.0)));
/// let found = farthest_points(Vec2::new(0.0, 0.0), Circle::new(Vec2::new(3.0, 4.0), 5.0));
/// assert_eq!(found.on_b, Vec2::new(6.0, 8.0));
/// ```
#[must_use]
#[inline]
pub fn farthest_points<S: Scalar, A: Convex<S>, B: Convex<S>>(a: A, b: B) -> FarthestPoints<S> {
    let (core_a, core_b) = (a.core(), b.core());
    let origin = core_a.anchor();
    let scale = scale_of::<S>(core_a.extent(origin).most(core_b.extent(origin)));
    let (seen_a, seen_b) = (core_a.placed(origin, scale), core_b.placed(origin, scale));
    let (from, to) = (core_a.corners(), core_b.corners());
    let (seen_a, seen_b) = (seen_a.corners(), seen_b.corners());
    let corners = seen_a.as_ref().iter().zip(from.as_ref());
    let candidates = corners.flat_map(|(&p, &on_a)| {
        let others = seen_b.as_ref().iter().zip(to.as_ref());
        others.map(move |(&q, &on_b)| (q - p, on_a, on_b))
    });
    let farther = |best: (Vec2<S>, Vec2<S>, Vec2<S>), other: (Vec2<S>, Vec2<S>, Vec2<S>)| {
        let keep = other.0.length_squared().at_most(best.0.length_squared());
        let pick = |x, y| Vec2::select(keep, x, y);
        (
            pick(best.0, other.0),
            pick(best.1, other.1),
            pick(best.2, other.2),
        )
    };
    let best = candidates.reduce(farther);
    let (way, mut on_a, mut on_b) = best.expect("a core has at least one corner");
    if A::ROUND || B::ROUND {
        let none = way.x.equals(S::zero()) & way.y.equals(S::zero());
        let along = Vec2::new(S::one(), S::zero());
        let direction = direction(Vec2::select(none, along, way));
        on_a -= direction * a.radius();
        on_b += direction * b.radius();
    }
    b.guarded(a.guarded(Guard::new())).result(FarthestPoints {
        on_a: on_a.canonical(),
        on_b: on_b.canonical(),
    })
}
