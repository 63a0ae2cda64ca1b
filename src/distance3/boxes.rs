//! Boxes of space against points, and axis-aligned boxes against each other.
use super::relation::{Relation, direction};
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::scalar::{largest, most_of};
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Rotation2, Scalar, Vec2, Vec3};

/// Returns the height of a point over the nearer face along each axis of a box; negative between both faces.
#[inline]
pub(super) fn beyond_aabb3<S: Scalar>(shape: Aabb3<S>, point: Vec3<S>) -> Vec3<S> {
    let (low, high) = (shape.min - point, point - shape.max);
    Vec3::new(low.x.most(high.x), low.y.most(high.y), low.z.most(high.z))
}

/// Returns the height of a point over the nearer face along each of the box's own axes; negative between both faces.
#[inline]
pub(super) fn beyond_yaw<S: Scalar>(shape: YawBox3<S>, point: Vec3<S>) -> Vec3<S> {
    let at = point - shape.center;
    let flat = Rotation2::from_angle(shape.heading).inverse() * Vec2::new(at.x, at.y);
    from_center(Vec3::new(flat.x, flat.y, at.z), shape.size)
}

/// Returns the height of a point over the nearer face along each of the box's own axes; negative between both faces.
#[inline]
pub(super) fn beyond_obb3<S: Scalar>(shape: Obb3<S>, point: Vec3<S>) -> Vec3<S> {
    let at = shape.rotation.inverse() * (point - shape.center);
    from_center(at, shape.size)
}

/// Returns the heights over the nearer faces of a point given in the box's own frame.
#[inline(always)]
fn from_center<S: Scalar>(at: Vec3<S>, size: Vec3<S>) -> Vec3<S> {
    let across = |x: S, size: S| x.magnitude() - size.halved();
    Vec3::new(
        across(at.x, size.x),
        across(at.y, size.y),
        across(at.z, size.z),
    )
}

/// Returns the signed distance by how far a point is beyond faces.
#[inline(always)]
pub(super) fn signed<S: Scalar>(beyond: Vec3<S>) -> S {
    let nearest = most_of([beyond.x, beyond.y, beyond.z]);
    let outside = open(beyond).length();
    S::select(nearest.above(S::zero()), outside, nearest)
}

/// Returns the gap along each axis, zero where the boxes overlap along it; a gap of zero has half of its derivative.
#[inline(always)]
pub(super) fn open<S: Scalar>(gap: Vec3<S>) -> Vec3<S> {
    let zero = S::zero();
    Vec3::new(gap.x.most(zero), gap.y.most(zero), gap.z.most(zero))
}

/// Returns the relation of two axis-aligned boxes, by their bounds alone. Ties of bounds share the derivative. If boxes
/// overlap equally deep along several axes, the points and the direction are those of the first.
#[inline(always)]
pub(super) fn upright<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> Relation<S> {
    let (zero, one) = (S::zero(), S::one());
    let axes = |of: fn(Vec3<S>) -> S| ([of(a.min), of(a.max)], [of(b.min), of(b.max)]);
    let axes = [axes(|v| v.x), axes(|v| v.y), axes(|v| v.z)];
    let gaps = axes.each_as(|(a, b)| (b[0] - a[1]).most(a[0] - b[1]));
    let clear = gaps.each_as(|gap| S::select(gap.above(zero), gap, zero));
    let apart = gaps.each_as(|gap| gap.above(zero));
    let any = apart[0] | apart[1] | apart[2];
    // The axis of the least depth separates boxes that overlap.
    let first = gaps[0].at_least(gaps[1]) & gaps[0].at_least(gaps[2]);
    let second = !first & gaps[1].at_least(gaps[2]);
    let shallow = [first, second, !first & !second];
    let found: [[S; 4]; 3] = std::array::from_fn(|k| {
        let (a, b) = axes[k];
        let to_right = (b[0] - a[1]).at_least(a[0] - b[1]);
        let pick = |yes: S, no: S| S::select(to_right, yes, no);
        let middle = a[0].most(b[0]).halved() + a[1].least(b[1]).halved();
        let parted = apart[k] | !any & shallow[k];
        let side = pick(one, -one);
        let out = S::select(shallow[k], side, zero);
        [
            S::select(parted, pick(a[1], a[0]), middle),
            S::select(parted, pick(b[0], b[1]), middle),
            clear[k].saturated() * side,
            out,
        ]
    });
    let vector = |n: usize| Vec3::new(found[0][n], found[1][n], found[2][n]);
    let way = vector(2);
    // In units of the vector's size, so that no square over- or underflows.
    let across = direction(way * scale_of::<S>(largest([way.x, way.y, way.z])));
    let out = vector(3);
    let way = Vec3::new(clear[0], clear[1], clear[2]);
    Relation {
        apart: S::select(any, way.length(), most_of(gaps)),
        square: way.length_squared(),
        normal: Vec3::select(any, across, out),
        on_a: vector(0),
        on_b: vector(1),
    }
}

/// Returns the longest distance of points of two axis-aligned boxes. Kinks: boxes with one centre along an axis.
#[inline(always)]
pub(super) fn farthest_upright<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> S {
    (b.max - a.min).most(a.max - b.min).length()
}
