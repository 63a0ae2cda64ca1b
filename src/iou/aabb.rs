//! Scores of axis-aligned boxes.
use super::giou::outside_share;
use super::hull::{hull_of_bounds, joint_unit, joint_units};
use super::terms::{Terms, part};
use crate::overlap::iou_aabb2;
use crate::scalar::guarded;
use crate::{Aabb2, Scalar, Vec2};

/// The parts of the extent of two intervals: the lengths that only the first covers, only the second, both, and
/// neither. Not negative, in one unit.
struct ExtentParts<S> {
    a: S,
    b: S,
    both: S,
    neither: S,
}

impl<S: Scalar> ExtentParts<S> {
    #[inline(always)]
    fn of(a: [S; 2], b: [S; 2], half: impl Fn(S, S) -> S) -> Self {
        let zero = S::zero();
        // Before the other one begins, and after it has ended.
        let (low, high) = (half(a[0], b[0]), half(b[1], a[1]));
        let shared = half(a[0].most(b[0]), a[1].least(b[1]));
        // Touching counts as apart, with its derivatives, as in the area of intersection.
        let apart = shared.at_most(zero);
        let own = |size: S, x: S, y: S| S::select(apart, size, x.most(zero) + y.most(zero));
        ExtentParts {
            a: own(half(a[0], a[1]), low, high),
            b: own(half(b[0], b[1]), -low, -high),
            both: S::select(apart, zero, shared),
            neither: S::select(apart, -shared, zero),
        }
    }
    #[inline(always)]
    fn whole(&self) -> S {
        (self.a + self.b) + (self.both + self.neither)
    }
}

#[inline(always)]
fn generalised<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, hull: bool) -> S {
    // Shares of an area do not change when either axis gets a unit of its own.
    let scale = joint_units(a, b);
    let half = |scale: S| move |low: S, high: S| (high.halved() - low.halved()) * scale;
    let x = ExtentParts::of([a.min.x, a.max.x], [b.min.x, b.max.x], half(scale.x));
    let y = ExtentParts::of([a.min.y, a.max.y], [b.min.y, b.max.y], half(scale.y));
    // The area that neither box covers is the sum of its parts. The area of the box around both less that of the union
    // would lose its digits if one box nearly covers the other.
    let mut rest = (x.a * (y.b + y.neither) + x.b * (y.a + y.neither))
        + (x.both * y.neither + x.neither * y.whole());
    if hull {
        rest -= hull_of_bounds(a, b, scale).1.halved();
        // Rounding must not make it negative.
        let short = rest.below(S::zero());
        rest = S::select(short, rest.with_primal(S::Primal::zero()), rest);
    }
    // Each of them is shared or one's own; both boxes' areas less the area counted twice.
    let (wide_a, wide_b) = (x.a + x.both, x.b + x.both);
    let union = wide_a * (y.a + y.both) + (wide_b * y.b + x.b * y.both);
    (iou_aabb2(a, b) - outside_share(rest, union + rest)).canonical()
}

/// Returns the terms by the box around both, or by the diameter of their hull.
#[inline(always)]
fn terms<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, hull: bool) -> Terms<S> {
    let scale = joint_unit(a, b);
    let half = |low: S, high: S| (high.halved() - low.halved()) * scale;
    let size = |x: Aabb2<S>| Vec2::new(half(x.min.x, x.max.x), half(x.min.y, x.max.y));
    let sizes = [size(a), size(b)];
    // Differences first: far from the origin the bounds' sums have no digits left.
    let between = Vec2::new(
        (half(a.min.x, b.min.x) + half(a.max.x, b.max.x)).halved(),
        (half(a.min.y, b.min.y) + half(a.max.y, b.max.y)).halved(),
    );
    let (across, against) = if hull {
        let reach = |a_low: S, a_high: S, b_low: S, b_high: S| {
            half(a_low, b_high).most(half(b_low, a_high))
        };
        let reach = Vec2::new(
            reach(a.min.x, a.max.x, b.min.x, b.max.x),
            reach(a.min.y, a.max.y, b.min.y, b.max.y),
        );
        let own = sizes[0].length_squared().most(sizes[1].length_squared());
        let across = reach.length_squared().most(own);
        let diameter = across.root();
        (across, Vec2::new(diameter, diameter))
    } else {
        let around = size(a.join(b));
        (around.length_squared(), around)
    };
    Terms {
        iou: iou_aabb2(a, b),
        way: part(between.length_squared(), across),
        sizes,
        against,
    }
}

/// Returns the generalised IoU of two axis-aligned boxes, in `[−1, 1]`: IoU less the share of the smallest axis-aligned
/// box around both that neither covers. Rezatofighi et al., CVPR 2019. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::giou_aabb2};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 1.0, 1.0), Aabb2::new(1.0, 1.0, 2.0, 2.0));
/// assert_eq!(giou_aabb2(a, b), -0.5);
/// ```
#[must_use]
#[inline]
pub fn giou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    generalised(a, b, false)
}

/// Returns the generalised IoU of two axis-aligned boxes by their exact convex hull, in `[−1, 1]`: IoU less the share
/// of the hull that neither covers. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::giou_hull_aabb2};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 1.0, 1.0), Aabb2::new(1.0, 1.0, 2.0, 2.0));
/// assert!((giou_hull_aabb2(a, b) + 1.0_f64 / 3.0).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn giou_hull_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    generalised(a, b, true)
}

/// Returns the distance IoU of two axis-aligned boxes, in `[−1, 1]`: IoU less the square of the centres' distance over
/// the diagonal of the smallest axis-aligned box around both. Two points have −1. Zheng et al., AAAI 2020. See the
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
    terms(a, b, false).diou()
}

/// Returns the distance IoU of two axis-aligned boxes by the diameter of their joint hull, in `[−1, 1]`. Two points
/// have −1. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::{diou_aabb2, diou_hull_aabb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 10.0, 2.0), Aabb2::new(4.0, 0.0, 6.0, 4.0));
/// // No two corners are as far apart as those of the box around both.
/// assert!(diou_hull_aabb2(a, b) < diou_aabb2(a, b));
/// ```
#[must_use]
#[inline]
pub fn diou_hull_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, true).diou()
}

/// Returns the complete IoU of two axis-aligned boxes, in `[−3/2, 1]`: [`diou_aabb2`] less the difference of the
/// aspects by a weight that grows with the overlap. It has all derivatives, the weight's too. Zheng et al., IEEE
/// Transactions on Cybernetics 2021. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::{ciou_aabb2, diou_aabb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 1.0, 1.0), Aabb2::new(0.0, 0.0, 1.0, 3.0));
/// let v = 4.0 / std::f64::consts::PI.powi(2) * (1.0_f64.atan() - 3.0_f64.atan()).powi(2);
/// let expected = diou_aabb2(a, b) - v * v / (1.0 - 1.0 / 3.0 + v);
/// assert!((ciou_aabb2(a, b) - expected).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn ciou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, false).ciou(false)
}

/// Returns the complete IoU of two axis-aligned boxes by the diameter of their joint hull, in `[−3/2, 1]`:
/// [`diou_hull_aabb2`] less the weighted difference of the aspects. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::{ciou_hull_aabb2, diou_hull_aabb2}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 1.0, 1.0), Aabb2::new(2.0, 0.0, 4.0, 2.0));
/// assert_eq!(ciou_hull_aabb2(a, b), diou_hull_aabb2(a, b)); // both are squares
/// ```
#[must_use]
#[inline]
pub fn ciou_hull_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, true).ciou(false)
}

/// Returns the complete IoU of two axis-aligned boxes, in `[−3/2, 1]`, whose weight of the aspects counts as constant:
/// no derivative goes through it, as its authors train. The value is that of [`ciou_aabb2`]; the derivatives are those
/// of no function.
#[must_use]
#[inline]
pub fn ciou_fixed_weight_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, false).ciou(true)
}

/// Returns the efficient IoU of two axis-aligned boxes, in `[−9/4, 1]`: [`diou_aabb2`] less the squares of the
/// differences of widths and heights over the sides of the box around both. Zhang et al., Focal and efficient IoU loss
/// for accurate bounding box regression, 2021. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::eiou_aabb2};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 4.0), Aabb2::new(0.0, 0.0, 2.0, 4.0));
/// assert_eq!(eiou_aabb2(a, b), 0.5 - 1.0 / 32.0 - 0.25);
/// ```
#[must_use]
#[inline]
pub fn eiou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, false).eiou()
}

/// Returns the efficient IoU of two axis-aligned boxes by the diameter D of their joint hull, in `[−5/2, 1]`:
/// [`diou_hull_aabb2`] less the squares of the differences of widths and heights over D. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, iou::eiou_hull_aabb2};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 3.0), Aabb2::new(0.0, 0.0, 2.0, 3.0));
/// assert!((eiou_hull_aabb2(a, b) - (0.5 - 1.0 / 25.0 - 4.0_f64 / 25.0)).abs() < 1e-15);
/// ```
#[must_use]
#[inline]
pub fn eiou_hull_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    terms(a, b, true).eiou()
}

impl<S: Scalar> Aabb2<S> {
    /// Returns [`giou_aabb2`].
    #[must_use]
    #[inline]
    pub fn giou(self, other: Self) -> S {
        guarded((self, other), |(a, b)| giou_aabb2(a, b))
    }
}
