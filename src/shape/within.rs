//! Membership of points in shapes, by signs in numbers of twice the digits: straight lines.
use crate::arrays::Each;
use crate::scalar::largest;
use crate::twofold::{ExactVector, Twofold, cross, dot, rounded, turn, volume, way};
use crate::{Mask, Scalar};

/// Returns the power of two that brings the largest of some sizes to about one; one for zeros.
#[inline(always)]
pub(super) fn unit<P: Scalar<Primal = P>, const N: usize>(sizes: [P; N]) -> P {
    crate::distance::edge::scale_of::<P>(largest(sizes))
}

/// Returns the size of the difference of two points: its largest coordinate, rounded.
#[inline(always)]
pub(super) fn size<P: Scalar<Primal = P>, const N: usize>(from: [P; N], to: [P; N]) -> P {
    let mut ways = [P::zero(); N];
    for k in 0..N {
        ways[k] = to[k] - from[k];
    }
    largest(ways)
}

/// Returns `true` where a comparison with zero holds for all numbers.
#[inline(always)]
fn all<P: Scalar, const N: usize>(numbers: [P; N], holds: fn(P, P) -> P::Mask) -> P::Mask {
    let mut all = holds(numbers[0], P::zero());
    for number in &numbers[1..] {
        all = all & holds(*number, P::zero());
    }
    all
}

/// Returns `true` where no number is negative, or none is positive.
#[inline(always)]
pub(super) fn one_sided<P: Scalar, const N: usize>(numbers: [P; N]) -> P::Mask {
    all(numbers, P::at_least) | all(numbers, P::at_most)
}

/// Returns `true` where a point is in the tetrahedron of four corners, which may be flat.
#[inline]
pub(super) fn in_tetrahedron<P: Scalar<Primal = P>>(
    corners: [[P; 3]; 4],
    point: [P; 3],
) -> P::Mask {
    let [a, b, c, d] = corners;
    let unit = unit([
        size(point, a),
        size(point, b),
        size(point, c),
        size(point, d),
    ]);
    let arms = corners.each_as(|corner| way(point, corner, unit));
    let faces = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
    let volumes = faces.each_as(|[i, j, k]| volume(arms[i], arms[j], arms[k]));
    let [b, c, d] = [b, c, d].each_as(|corner| way(a, corner, unit));
    let is_flat = volume(b, c, d).equals(P::zero());
    let inside = one_sided(volumes) & !is_flat;
    if !is_flat.any() {
        return inside;
    }
    let mut in_faces = P::zero().below(P::zero());
    for (k, [i, j, l]) in faces.into_iter().enumerate() {
        let in_plane = volumes[k].equals(P::zero());
        let in_face = in_face([arms[i], arms[j], arms[l]]);
        in_faces = in_faces | in_plane & in_face;
    }
    inside | is_flat & in_faces
}

/// Returns `true` where the origin, known to be in the plane of three points, is in their triangle, which may be flat.
#[inline(always)]
fn in_face<P: Scalar>(arms: [ExactVector<P, 3>; 3]) -> P::Mask {
    let turns = [(0, 1), (1, 2), (2, 0)].each_as(|(i, j)| cross(arms[i], arms[j]));
    let in_sight = |k: usize| {
        // A flat triangle has no orientation: its bounds decide.
        one_sided(turns.each_as(|turn| turn[k])) & !(one_sign(arms.each_as(|arm| arm[k].high)))
    };
    in_sight(0) & in_sight(1) & in_sight(2)
}

/// Returns `true` where all numbers are positive, or all are negative.
#[inline(always)]
fn one_sign<P: Scalar, const N: usize>(numbers: [P; N]) -> P::Mask {
    all(numbers, P::above) | all(numbers, P::below)
}

/// Returns `true` where a point of the plane is in the triangle of three corners, which may be flat.
#[inline]
pub(super) fn in_triangle<P: Scalar<Primal = P>>(corners: [[P; 2]; 3], point: [P; 2]) -> P::Mask {
    let [a, b, c] = corners;
    let unit = unit([size(point, a), size(point, b), size(point, c)]);
    let arms = corners.each_as(|corner| way(point, corner, unit));
    let turns = [(0, 1), (1, 2), (2, 0)].each_as(|(i, j)| turn(arms[i], arms[j]));
    let bounds = [0, 1].each_as(|k| !one_sign(arms.each_as(|arm| arm[k].high)));
    one_sided(turns) & bounds[0] & bounds[1]
}

/// A point relative to the axis of a solid: exact vectors along the axis and to the point, in one unit.
pub(super) struct AxisPoint<P, const N: usize> {
    /// The vector from start to end.
    pub axis: ExactVector<P, N>,
    /// The vector from the start to the point.
    pub arm: ExactVector<P, N>,
    /// The inner product of the axis with the vector from the start to the point.
    pub height: P,
    /// The inner product of the axis with the vector from the end to the point.
    pub beyond: P,
    /// The power of two that scales all vectors.
    pub unit: P,
}

impl<P: Scalar<Primal = P>, const N: usize> AxisPoint<P, N> {
    /// Returns a point relative to the axis of a solid with a radius.
    #[inline(always)]
    pub fn new(start: [P; N], end: [P; N], point: [P; N], radius: P) -> Self {
        let unit = unit([size(start, end), size(start, point), radius]);
        let axis = way(start, end, unit);
        let arm = way(start, point, unit);
        AxisPoint {
            axis,
            arm,
            height: dot(axis, arm),
            beyond: dot(axis, way(end, point, unit)),
            unit,
        }
    }
    /// Returns `true` where the point is neither before the start nor beyond the end, and the axis has a length.
    #[inline(always)]
    pub fn is_between(&self) -> P::Mask {
        let zero = P::zero();
        zero.at_most(self.height)
            & self.beyond.at_most(zero)
            & square(rounded(self.axis)).above(zero)
    }
}

/// Returns the sum of the squares.
#[inline(always)]
pub(super) fn square<P: Scalar, const N: usize>(x: [P; N]) -> P {
    let mut sum = x[0] * x[0];
    for x in &x[1..] {
        sum += *x * *x;
    }
    sum
}

/// Returns `true` where a point is at most a radius from another.
#[inline]
pub(super) fn in_ball<P: Scalar<Primal = P>, const N: usize>(
    center: [P; N],
    point: [P; N],
    radius: P,
) -> P::Mask {
    let unit = unit([size(center, point), radius]);
    let arm = way(center, point, unit);
    let mut sum = Twofold::product(radius * unit, -(radius * unit));
    let mut terms = sum.high.magnitude();
    for arm in arm {
        let next = arm.times(arm);
        terms += next.high;
        sum = sum.plus(next);
    }
    sum.settled(terms).at_most(P::zero())
}

/// Returns `true` where `normal · point ≤ offset`.
#[inline]
pub(super) fn is_behind<P: Scalar<Primal = P>>(
    normal: [P; 3],
    point: [P; 3],
    offset: P,
) -> P::Mask {
    let mut sum = Twofold::of(-offset);
    let mut terms = offset.magnitude();
    for k in 0..3 {
        let next = Twofold::product(normal[k], point[k]);
        terms += next.high.magnitude();
        sum = sum.plus(next);
    }
    sum.settled(terms).at_most(P::zero())
}
