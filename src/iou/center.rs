//! Scores that look at the centres and the sizes of boxes.
use super::hull::hull_scale;
use crate::clip::{frame, relate};
use crate::overlap::{area_from_half, iou_aabb2, iou_obb2};
use crate::{Aabb2, Obb2, Scalar, Vec2};

/// What the scores of this file need of two boxes.
struct Pair<S> {
    iou: S,
    /// Half the way between the centres.
    between: Vec2<S>,
    /// Half the size of the smallest axis-aligned box around both.
    around: Vec2<S>,
    size_a: Vec2<S>,
    size_b: Vec2<S>,
}

/// `x / y`, zero with slope zero where `y` is zero.
#[inline(always)]
fn share<S: Scalar>(x: S, y: S) -> S {
    let none = y.at_most(S::zero());
    S::select(none, S::zero(), x.over(S::select(none, S::one(), y)))
}

#[inline(always)]
fn pair_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> Pair<S> {
    // A quarter of the size is half of what a centre's half way reaches.
    let reach = |x: Obb2<S>| {
        let (sin, cos) = x.heading.sin_cos();
        let (sin, cos) = (sin.magnitude(), cos.magnitude());
        let quarter = |s: S| s.halved().halved();
        let (w, h) = (quarter(x.size.x), quarter(x.size.y));
        Vec2::new(w * cos + h * sin, w * sin + h * cos)
    };
    let half = |x: S, y: S| y.halved() - x.halved();
    let between = Vec2::new(half(a.center.x, b.center.x), half(a.center.y, b.center.y));
    let (reach_a, reach_b) = (reach(a), reach(b));
    // From a's centre, to either side, to whichever box reaches farther.
    let around = |by: S, a: S, b: S| (a.most(b + by) + a.most(b - by)).saturated();
    Pair {
        iou: iou_obb2(a, b),
        between,
        around: Vec2::new(
            around(between.x, reach_a.x, reach_b.x),
            around(between.y, reach_a.y, reach_b.y),
        ),
        size_a: a.size,
        size_b: b.size,
    }
}

#[inline(always)]
fn pair_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Pair<S> {
    let half = |low: S, high: S| high.halved() - low.halved();
    let joint = a.join(b);
    let quarter = |x: S| x.halved().halved();
    // Differences first: far from the origin the bounds' sums have no digits left.
    let between = |a_low: S, a_high: S, b_low: S, b_high: S| {
        (quarter(b_low) - quarter(a_low)) + (quarter(b_high) - quarter(a_high))
    };
    let size = |x: Aabb2<S>| Vec2::new(half(x.min.x, x.max.x), half(x.min.y, x.max.y));
    Pair {
        iou: iou_aabb2(a, b),
        between: Vec2::new(
            between(a.min.x, a.max.x, b.min.x, b.max.x),
            between(a.min.y, a.max.y, b.min.y, b.max.y),
        ),
        around: size(joint),
        size_a: size(a),
        size_b: size(b),
    }
}

impl<S: Scalar> Pair<S> {
    /// `(d/D)²` with the diagonal of the box around both.
    #[inline(always)]
    fn way(&self) -> S {
        let diagonal = self.around.x.hypot(self.around.y);
        share(self.between.x, diagonal).squared() + share(self.between.y, diagonal).squared()
    }
    /// `4/π² (Δ atan w/h)²`, in `[0, 1]`.
    #[inline(always)]
    fn aspect(&self) -> S {
        let angle = |size: Vec2<S>| size.x.atan2(size.y);
        let difference = angle(self.size_a) - angle(self.size_b);
        (difference * S::lit(std::f64::consts::FRAC_2_PI)).squared()
    }
    #[inline(always)]
    fn ciou(&self, fixed: bool) -> S {
        let aspect = self.aspect();
        let weight = share(aspect, S::one() - self.iou + aspect);
        let weight = if fixed {
            S::from_primal(weight.primal())
        } else {
            weight
        };
        (self.iou - self.way() - weight * aspect).canonical()
    }
    /// The differences of the sizes are in the boxes' own axes, in units of `size_unit` of those of
    /// `around`.
    #[inline(always)]
    fn eiou(&self, size_unit: f64) -> S {
        let part = |a: S, b: S, all: S| {
            let difference = (a - b) * S::lit(size_unit);
            share(difference, all).squared()
        };
        let wide = part(self.size_a.x, self.size_b.x, self.around.x);
        let high = part(self.size_a.y, self.size_b.y, self.around.y);
        (self.iou - self.way() - (wide + high)).canonical()
    }
}

/// Distance IoU of two rotated boxes by the diameter of their joint hull, in `(−1, 1]`: IoU less the
/// square of the centres' distance over that diameter. See the [module](super).
///
/// The diameter is the largest distance of two of the eight corners. In the frame of `a` its corner
/// farthest from a corner `p` of `b` is at `|p_x| + w/2`, `|p_y| + h/2` from it; so four of b's corners and
/// the two diagonals tell.
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
    let iou = iou_obb2(a, b);
    let (a, b) = (frame(a), frame(b));
    let pair = relate::<S, true>(a, b, hull_scale(&a, &b));
    let (px, py) = (pair.half_b.x * pair.cos, pair.half_b.x * pair.sin);
    let (qx, qy) = (pair.half_b.y * pair.sin, pair.half_b.y * pair.cos);
    let farthest = |x: S, y: S| {
        let at = (pair.u + x, pair.v + y);
        let x = at.0.magnitude() + pair.half_a.x;
        let y = at.1.magnitude() + pair.half_a.y;
        x * x + y * y
    };
    let across = farthest(px - qx, py + qy)
        .most(farthest(qx - px, -(py + qy)))
        .most(farthest(px + qx, py - qy).most(farthest(-(px + qx), qy - py)));
    let four = S::lit(4.0);
    let own = pair
        .half_a
        .length_squared()
        .most(pair.half_b.length_squared())
        * four;
    let way = pair.u * pair.u + pair.v * pair.v;
    (iou - share(way, across.most(own))).canonical()
}

/// Distance IoU of two axis-aligned boxes by the diameter of their joint hull, in `(−1, 1]`. See the
/// [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::diou_aabb2};
/// let (a, b) = (Aabb2::new(-1.0, -1.0, 1.0, 1.0), Aabb2::new(3.0, -1.0, 5.0, 1.0));
/// assert!((diou_aabb2(a, b) + 16.0_f64 / 40.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn diou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let pair = pair_aabb2(a, b);
    let half = |low: S, high: S| high.halved() - low.halved();
    let reach =
        |a_low: S, a_high: S, b_low: S, b_high: S| half(a_low, b_high).most(half(b_low, a_high));
    let x = reach(a.min.x, a.max.x, b.min.x, b.max.x);
    let y = reach(a.min.y, a.max.y, b.min.y, b.max.y);
    let own = pair.size_a.length().most(pair.size_b.length());
    let diameter = x.hypot(y).most(own);
    let way = share(pair.between.x, diameter).squared() + share(pair.between.y, diameter).squared();
    (pair.iou - way).canonical()
}

/// Generalised IoU of two rotated boxes with the smallest box around both along the axes of the plane
/// in place of the hull, in `(−1, 1]`. It is not 1 for identical boxes that are turned. See the
/// [module](super).
#[must_use]
#[inline]
pub fn giou_box_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let pair = pair_obb2(a, b);
    let reach = pair.around.x.most(pair.around.y);
    let point = reach.at_most(S::zero());
    let scale = S::select(point, S::one(), reach).binade();
    let scale = S::from_primal(scale.primal());
    let own =
        |size: Vec2<S>| area_from_half(Vec2::new(size.x.halved() * scale, size.y.halved() * scale));
    // U = (A + B) / (1 + I/U).
    let union = (own(a.size) + own(b.size)).over(S::one() + pair.iou);
    let hull = area_from_half(pair.around * scale);
    let short = hull.below(union);
    let hull = S::select(short, hull.with_primal(union.primal()), hull);
    (pair.iou - share(hull - union, hull)).canonical()
}

/// The rotated and the axis-aligned form of one score: the macro lists names.
macro_rules! scores {
    ($($(#[$doc:meta])* $obb:ident, $aabb:ident: |$pair:ident, $unit:ident| $score:expr;)*) => { $(
        $(#[$doc])*
        ///
        /// Of rotated boxes; the box around both is along the axes of the plane, sizes are along the
        /// boxes' own. See the [module](super).
        #[must_use]
        #[inline]
        pub fn $obb<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
            // Sizes are whole, that of the box around both is halved.
            let ($pair, $unit) = (pair_obb2(a, b), 0.5);
            let _ = $unit;
            $score
        }
        $(#[$doc])*
        ///
        /// Of axis-aligned boxes. See the [module](super).
        #[must_use]
        #[inline]
        pub fn $aabb<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
            let ($pair, $unit) = (pair_aabb2(a, b), 1.0);
            let _ = $unit;
            $score
        }
    )* };
}

scores! {
    /// Distance IoU by the diagonal of the smallest axis-aligned box around both, in `(−1, 1]`: IoU less
    /// the square of the centres' distance over that diagonal. Zheng et al., AAAI 2020.
    diou_box_obb2, diou_box_aabb2: |pair, unit| (pair.iou - pair.way()).canonical();
    /// Complete IoU, in `(−2, 1]`: distance IoU by the box around both, less the difference of the
    /// aspects by a weight that grows with the overlap. All slopes, those of the weight too. Zheng et
    /// al., IEEE Transactions on Cybernetics 2021.
    ciou_obb2, ciou_aabb2: |pair, unit| pair.ciou(false);
    /// Complete IoU, in `(−2, 1]`, whose weight of the aspects counts as constant: no slope goes through
    /// it, as its authors train. The value is that of `ciou`; the slopes are those of no function.
    ciou_fixed_weight_obb2, ciou_fixed_weight_aabb2: |pair, unit| pair.ciou(true);
    /// Efficient IoU, in `(−3, 1]`: distance IoU by the box around both, less the squares of the
    /// differences of widths and heights over that box's. Zhang et al., Focal and efficient IoU loss
    /// for accurate bounding box regression, 2021.
    eiou_obb2, eiou_aabb2: |pair, unit| pair.eiou(unit);
}

/// A positive number without a unit: the power of [`alpha_iou_obb2`] as an argument of a batch.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Exponent<S> {
    /// The number.
    #[shape(positive, number)]
    pub alpha: S,
}

/// `iou^alpha`, zero with slope zero where the boxes share nothing.
#[inline(always)]
fn powered<S: Scalar>(iou: S, alpha: S) -> S {
    let none = iou.at_most(S::zero());
    let power = (S::select(none, S::one(), iou).ln() * alpha).exp();
    S::select(none, S::zero(), power).canonical()
}

/// A power of the IoU of two rotated boxes, in `[0, 1]`, for `alpha > 0`: He et al., Alpha-IoU, NeurIPS
/// 2021 (who use 3). See the [module](super).
#[must_use]
#[inline]
pub fn alpha_iou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>, alpha: S) -> S {
    powered(iou_obb2(a, b), alpha)
}

/// A power of the IoU of two axis-aligned boxes, in `[0, 1]`, for `alpha > 0`: He et al., Alpha-IoU,
/// NeurIPS 2021 (who use 3). See the [module](super).
#[must_use]
#[inline]
pub fn alpha_iou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, alpha: S) -> S {
    powered(iou_aabb2(a, b), alpha)
}
