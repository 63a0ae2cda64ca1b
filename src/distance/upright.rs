//! Distances and nearest points of two axis-aligned boxes, axis by axis: the functions of
//! [`distance`](mod@crate::distance) use them.
use super::edge::{direction, scale_of, size_of};
use super::outcome::{Contact, PointPair};
use crate::arrays::Each;
use crate::{Aabb2, Scalar, Vec2};

/// Returns the signed distance of two axis-aligned boxes, in the unit of length: the distance of their nearest points,
/// or minus the length of the shortest translation after which they only touch.
///
/// It is their [`signed_distance`](super::signed_distance), by the two gaps between their bounds alone: it has no kink
/// except those of the distance itself, however flat the boxes are. Kinks: where bounds tie, or the gaps of boxes that
/// overlap, which share the derivative half and half; boxes that touch with a corner.
///
/// ```
/// use geograd::{Aabb2, distance::upright::signed_distance_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// assert_eq!(signed_distance_aabb2(a, Aabb2::new(7.0, 8.0, 9.0, 9.0)), 5.0);
/// assert_eq!(signed_distance_aabb2(a, Aabb2::new(3.0, 1.0, 9.0, 9.0)), -1.0);
/// ```
#[must_use]
#[inline]
pub fn signed_distance_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let gap = gaps(a, b);
    let way = open(gap);
    let apart = way.x.above(S::zero()) | way.y.above(S::zero());
    S::select(apart, way.length(), gap.x.most(gap.y))
        .saturated()
        .canonical()
}

/// Returns the [distance](super::distance()) of two axis-aligned boxes by their bounds, in the unit of length.
///
/// ```
/// use geograd::{Aabb2, distance::upright::distance_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// assert_eq!(distance_aabb2(a, Aabb2::new(7.0, 8.0, 9.0, 9.0)), 5.0);
/// ```
#[must_use]
#[inline]
pub fn distance_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    open(gaps(a, b)).length().saturated().canonical()
}

/// Returns the square of [`distance_aabb2`], smooth where that vanishes.
///
/// ```
/// use geograd::{Aabb2, distance::upright::squared_distance_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// assert_eq!(squared_distance_aabb2(a, Aabb2::new(7.0, 8.0, 9.0, 9.0)), 25.0);
/// ```
#[must_use]
#[inline]
pub fn squared_distance_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    open(gaps(a, b)).length_squared().saturated().canonical()
}

/// Returns the [longest distance](super::farthest_distance) of points of two axis-aligned boxes by their bounds, in the
/// unit of length. Kinks: boxes with one centre along x or along y.
///
/// ```
/// use geograd::{Aabb2, distance::upright::farthest_distance_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 1.0, 1.0);
/// assert_eq!(farthest_distance_aabb2(a, Aabb2::new(2.0, 2.0, 3.0, 4.0)), 5.0);
/// ```
#[must_use]
#[inline]
pub fn farthest_distance_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let (right, left) = (b.max - a.min, a.max - b.min);
    right.most(left).length().saturated().canonical()
}

/// Returns the gaps between two boxes along x and along y; negative where they overlap.
#[inline(always)]
fn gaps<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Vec2<S> {
    let (right, left) = (b.min - a.max, a.min - b.max);
    right.most(left)
}

/// Returns the gap along each axis; zero where the boxes overlap along it.
#[inline(always)]
fn open<S: Scalar>(gap: Vec2<S>) -> Vec2<S> {
    let open = |gap: S| S::select(gap.above(S::zero()), gap, S::zero());
    Vec2::new(open(gap.x), open(gap.y))
}

/// Returns the bounds of two intervals that face each other, and the gap between them; negative if they overlap.
#[inline(always)]
fn facing<S: Scalar>(a: [S; 2], b: [S; 2]) -> ([S; 2], S) {
    let (right, left) = (b[0] - a[1], a[0] - b[1]);
    let to_right = right.at_least(left);
    let pick = |yes: S, no: S| S::select(to_right, yes, no);
    ([pick(a[1], a[0]), pick(b[0], b[1])], pick(right, left))
}

/// Returns the points in which two axis-aligned boxes are nearest to each other, or which the shortest shift brings
/// together where they overlap.
///
/// They are their [`closest_points`](super::closest_points): along sides that face each other the middle of their
/// common range. All coordinates are bounds, or means of two, so that no size costs them digits. Kinks and jumps: where
/// bounds tie, and where the depths of boxes that overlap do.
///
/// ```
/// use geograd::{Aabb2, Vec2, distance::upright::closest_points_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// let found = closest_points_aabb2(a, Aabb2::new(7.0, 3.0, 9.0, 9.0));
/// assert_eq!((found.on_a, found.on_b), (Vec2::new(4.0, 3.5), Vec2::new(7.0, 3.5)));
/// ```
#[must_use]
#[inline]
pub fn closest_points_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> PointPair<S> {
    let zero = S::zero();
    let axes = |of: fn(Vec2<S>) -> S| ([of(a.min), of(a.max)], [of(b.min), of(b.max)]);
    let axes = [axes(|v| v.x), axes(|v| v.y)];
    let [(x, gap_x), (y, gap_y)] = axes.each_as(|(a, b)| facing(a, b));
    let (apart_x, apart_y) = (gap_x.above(zero), gap_y.above(zero));
    let apart = apart_x | apart_y;
    // The axis of the smaller depth separates boxes that overlap.
    let first = gap_x.at_least(gap_y);
    let parted = [apart_x | !apart & first, apart_y | !apart & !first];
    let [x, y] =
        [(x, axes[0], parted[0]), (y, axes[1], parted[1])].each_as(|(facing, (a, b), parted)| {
            let middle = a[0].most(b[0]).halved() + a[1].least(b[1]).halved();
            facing.each_as(|bound| S::select(parted, bound, middle).canonical())
        });
    PointPair {
        on_a: Vec2::new(x[0], y[0]),
        on_b: Vec2::new(x[1], y[1]),
    }
}

/// Returns the depth by which two axis-aligned boxes overlap, and the direction in which b leaves a by the shortest
/// translation.
///
/// It is their [`penetration`](super::penetration), by their bounds alone. If the depths along x and along y tie, the
/// depth shares its derivative and the direction is along x. Kinks: where bounds tie.
///
/// ```
/// use geograd::{Aabb2, Vec2, distance::upright::penetration_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 4.0, 4.0);
/// let found = penetration_aabb2(a, Aabb2::new(1.0, -5.0, 2.0, 0.5));
/// assert_eq!((found.depth, found.direction), (0.5, Vec2::new(0.0, -1.0)));
/// ```
#[must_use]
#[inline]
pub fn penetration_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Contact<S> {
    let (zero, one) = (S::zero(), S::one());
    let (right, left) = (b.min - a.max, a.min - b.max);
    let gap = right.most(left);
    let sign = |right: S, left: S| S::select(right.at_least(left), one, -one);
    let side = Vec2::new(sign(right.x, left.x), sign(right.y, left.y));
    let way = open(gap);
    let apart = way.x.above(zero) | way.y.above(zero);
    let deep = -gap.x.most(gap.y).saturated();
    // In units of the vector's size, so that no square over- or underflows.
    let way = Vec2::new(way.x.saturated() * side.x, way.y.saturated() * side.y);
    let across = direction(way * scale_of::<S>(size_of(way)));
    let along_x = gap.x.at_least(gap.y);
    let out = Vec2::select(along_x, Vec2::new(side.x, zero), Vec2::new(zero, side.y));
    Contact {
        depth: S::select(apart | !deep.above(zero), zero, deep).canonical(),
        direction: Vec2::select(apart, across, out).canonical(),
    }
}
