//! Scores of rotated boxes that look at the centres and the sizes.
use super::giou::outside_share;
use super::terms::{Terms, larger, part, unit};
use crate::clip::{Framed, frame, relate};
use crate::overlap::{Denominator, score_framed};
use crate::{Obb2, Scalar, Vec2};

/// Two rotated boxes and the square of the diameter of their joint hull.
pub(crate) struct HullDiameter<S> {
    /// The square of the diameter.
    pub squared: S,
    /// The vector between the centres in the frame of a.
    pub way: Vec2<S>,
    /// The sizes of both along their own axes.
    pub sizes: [Vec2<S>; 2],
}

/// Returns the power of two that brings the largest of half the centres' difference and half the sizes into `[½, 1)`.
#[inline(always)]
pub(crate) fn unit_of_pair<S: Scalar>(a: &Framed<S>, b: &Framed<S>) -> S {
    let way = half_way(a.center, b.center);
    unit([way.x, way.y, a.half.x, a.half.y, b.half.x, b.half.y])
}

/// Returns half the vector between the centres.
#[inline(always)]
fn half_way<S: Scalar>(a: Vec2<S>, b: Vec2<S>) -> Vec2<S> {
    Vec2::new(b.x.halved() - a.x.halved(), b.y.halved() - a.y.halved())
}

/// Measures the diameter of the joint hull of two rotated boxes: the largest distance of two of the eight corners. In
/// the frame of `a` its corner farthest from a corner `p` of `b` is at `|p_x| + w/2`, `|p_y| + h/2` from it; so four of
/// b's corners and the two diagonals suffice. In units of `1 / scale`.
#[inline(always)]
pub(crate) fn across<S: Scalar>(a: Framed<S>, b: Framed<S>, scale: S) -> HullDiameter<S> {
    let pair = relate::<S, true>(a, b, scale);
    let (px, py) = (pair.half_b.x * pair.cos, pair.half_b.x * pair.sin);
    let (qx, qy) = (pair.half_b.y * pair.sin, pair.half_b.y * pair.cos);
    let farthest = |x: S, y: S| {
        let at = (pair.u + x, pair.v + y);
        let x = at.0.magnitude() + pair.half_a.x;
        let y = at.1.magnitude() + pair.half_a.y;
        x * x + y * y
    };
    let between = farthest(px - qx, py + qy)
        .most(farthest(qx - px, -(py + qy)))
        .most(farthest(px + qx, py - qy).most(farthest(-(px + qx), qy - py)));
    let four = S::lit(4.0);
    let own = pair
        .half_a
        .length_squared()
        .most(pair.half_b.length_squared())
        * four;
    let size = |half: Vec2<S>| (half + half) * scale;
    HullDiameter {
        squared: between.most(own),
        way: Vec2::new(pair.u, pair.v),
        sizes: [size(a.half), size(b.half)],
    }
}

/// Returns the terms by the diameter of the joint hull.
#[inline(always)]
fn terms<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Terms<S> {
    let (a, b) = (frame(a), frame(b));
    let across = across(a, b, unit_of_pair(&a, &b));
    let diameter = across.squared.root();
    Terms {
        iou: score_framed::<S, true>(Denominator::Union, a, b),
        way: part(across.way.length_squared(), across.squared),
        sizes: across.sizes,
        against: Vec2::new(diameter, diameter),
    }
}

/// Two rotated boxes and the smallest box around both along the axes of the plane.
pub(crate) struct BoxesAround<S> {
    /// The size of the box around both.
    pub around: Vec2<S>,
    /// The vector between the centres.
    pub way: Vec2<S>,
    /// The sizes of both along their own axes.
    pub sizes: [Vec2<S>; 2],
}

/// Measures the smallest box around two rotated boxes along the axes of the plane, in units of `2 / scale`.
#[inline(always)]
pub(crate) fn bounds<S: Scalar>(a: Framed<S>, b: Framed<S>, scale: S) -> BoxesAround<S> {
    let way = half_way(a.center, b.center) * scale;
    // A box reaches half its size from its centre, and all lengths are halved.
    let reach = |x: &Framed<S>| {
        let (sin, cos) = (x.sin.magnitude(), x.cos.magnitude());
        let half = x.half * scale;
        let (w, h) = (half.x.halved(), half.y.halved());
        Vec2::new(w * cos + h * sin, w * sin + h * cos)
    };
    let (reach_a, reach_b) = (reach(&a), reach(&b));
    // From a's centre, to either side, to whichever box reaches farther.
    let around = |by: S, a: S, b: S| a.most(b + by) + a.most(b - by);
    BoxesAround {
        around: Vec2::new(
            around(way.x, reach_a.x, reach_b.x),
            around(way.y, reach_a.y, reach_b.y),
        ),
        way,
        sizes: [a.half * scale, b.half * scale],
    }
}

/// Returns the terms by the box around both along the axes of the plane.
#[inline(always)]
fn terms_of_bounds<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Terms<S> {
    let (a, b) = (frame(a), frame(b));
    let BoxesAround { around, way, sizes } = bounds(a, b, unit_of_pair(&a, &b));
    // A turned box may be longer than the box around both.
    let against = |x: S, a: S, b: S| larger(larger(x, a), b);
    Terms {
        iou: score_framed::<S, true>(Denominator::Union, a, b),
        way: part(way.length_squared(), around.length_squared()),
        sizes,
        against: Vec2::new(
            against(around.x, sizes[0].x, sizes[1].x),
            against(around.y, sizes[0].y, sizes[1].y),
        ),
    }
}

/// Returns the generalised IoU of two rotated boxes by the smallest box around both along the axes of the plane, in
/// `[−1, 1]`. It is not 1 for identical boxes that are turned, and not invariant under rotations. See the
/// [module](super).
///
/// ```
/// use geograd::{Obb2, iou::giou_aabb_obb2};
/// let (a, b) = (Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0), Obb2::new(1.0, 1.0, 1.0, 1.0, 0.0));
/// assert_eq!(giou_aabb_obb2(a, b), -0.5);
/// ```
#[must_use]
#[inline]
pub fn giou_aabb_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (a, b) = (frame(a), frame(b));
    let iou = score_framed::<S, true>(Denominator::Union, a, b);
    let BoxesAround { around, sizes, .. } = bounds(a, b, unit_of_pair(&a, &b));
    let own = |size: Vec2<S>| size.x * size.y;
    // U = (A + B) / (1 + I/U).
    let union = (own(sizes[0]) + own(sizes[1])).over(S::one() + iou);
    let around = around.x * around.y;
    let short = around.below(union);
    let around = S::select(short, around.with_primal(union.primal()), around);
    (iou - outside_share(around - union, around)).canonical()
}

/// Returns the distance IoU of two rotated boxes, in `[−1, 1]`: IoU less the square of the centres' distance over the
/// diameter of the joint hull. Two points have −1. It is invariant under rotations. See the [module](super).
///
/// ```
/// use geograd::{Obb2, iou::diou_obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
/// assert_eq!(diou_obb2(a, a), 1.0);
/// let apart: f64 = diou_obb2(a, Obb2::new(4.0, 0.0, 2.0, 2.0, 0.0));
/// assert!((apart + 16.0 / 40.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn diou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms(a, b).diou()
}

/// Returns the distance IoU of two rotated boxes by the diagonal of the smallest box around both along the axes of the
/// plane, in `[−1, 1]`. Two points have −1. See the [module](super).
///
/// ```
/// use geograd::{Obb2, iou::diou_aabb_obb2};
/// let (a, b) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(4.0, 0.0, 2.0, 2.0, 0.0));
/// assert!((diou_aabb_obb2(a, b) + 16.0_f64 / 40.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn diou_aabb_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms_of_bounds(a, b).diou()
}

/// Returns the complete IoU of two rotated boxes, in `[−3/2, 1]`: [`diou_obb2`] less the difference of the aspects by a
/// weight that grows with the overlap. It has all derivatives, the weight's too. Sizes are along the boxes' own axes.
/// Zheng et al., IEEE Transactions on Cybernetics 2021. See the [module](super).
///
/// ```
/// use geograd::{Obb2, iou::{ciou_obb2, diou_obb2}};
/// let (a, b) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 3.0, 3.0, 0.4));
/// assert_eq!(ciou_obb2(a, b), diou_obb2(a, b)); // both are squares
/// ```
#[must_use]
#[inline]
pub fn ciou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms(a, b).ciou(false)
}

/// Returns the complete IoU of two rotated boxes by the smallest box around both along the axes of the plane, in
/// `[−3/2, 1]`: [`diou_aabb_obb2`] less the weighted difference of the aspects. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, Obb2, iou::{ciou_aabb2, ciou_aabb_obb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 1.0), Aabb2::new(1.0, 0.0, 2.0, 2.0));
/// assert_eq!(ciou_aabb_obb2(Obb2::from(a), Obb2::from(b)), ciou_aabb2::<f64>(a, b));
/// ```
#[must_use]
#[inline]
pub fn ciou_aabb_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms_of_bounds(a, b).ciou(false)
}

/// Returns the complete IoU of two rotated boxes, in `[−3/2, 1]`, whose weight of the aspects counts as constant: no
/// derivative goes through it, as its authors train. The value is that of [`ciou_obb2`]; the derivatives are those of
/// no function.
#[must_use]
#[inline]
pub fn ciou_fixed_weight_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms(a, b).ciou(true)
}

/// Returns the efficient IoU of two rotated boxes, in `[−5/2, 1]`: [`diou_obb2`] less the squares of the differences of
/// widths and heights, along the boxes' own axes, over the diameter D of the joint hull. It is invariant under
/// rotations. After Zhang et al., Focal and efficient IoU loss for accurate bounding box regression, 2021.
///
/// The bound: `D²` is at least the square of the centres' distance and a quarter of those of both diagonals;
/// neither diagonal is longer than D. See the [module](super).
///
/// ```
/// use geograd::{Obb2, iou::eiou_obb2};
/// let (a, b) = (Obb2::new(0.0, 0.0, 4.0, 3.0, 0.3), Obb2::new(0.0, 0.0, 2.0, 3.0, 0.3));
/// assert!((eiou_obb2(a, b) - (0.5 - 4.0 / 25.0_f64)).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn eiou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms(a, b).eiou()
}

/// Returns the efficient IoU of two rotated boxes by the smallest box around both along the axes of the plane, in
/// `[−3, 1]`: [`diou_aabb_obb2`] less the squares of the differences of widths and heights, along the boxes' own axes,
/// over that box's sides; or over the larger size where a turned box is longer than those. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, Obb2, iou::{eiou_aabb2, eiou_aabb_obb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 1.0), Aabb2::new(1.0, 0.0, 2.0, 2.0));
/// assert_eq!(eiou_aabb_obb2(Obb2::from(a), Obb2::from(b)), eiou_aabb2::<f64>(a, b));
/// ```
#[must_use]
#[inline]
pub fn eiou_aabb_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    terms_of_bounds(a, b).eiou()
}
