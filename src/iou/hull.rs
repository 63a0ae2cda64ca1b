//! The area of the convex hull of two boxes, in a straight line.
//!
//! In the frame of box a, with b turned by less than a quarter, the normals of all eight sides alternate: one of a, one
//! of b. Between two neighbouring normals both boxes have one corner farthest out. At every normal one of the boxes
//! reaches farther; let `w` be 1 where that is a, 0 where it is b, and ½ at an exact tie. Then the hull has a's side at
//! a normal of a where `w` is 1, b's side at one of b where it is 0, and between two normals with different `w` it goes
//! over from one box's corner to the other's. So with the corners `A`, `B` of each of the eight gaps, and each side
//! from `P` to `Q`,
//!
//! ```text
//! 2 area = Σ sides of a: w (P × Q) + Σ sides of b: (1 − w) (P × Q) + Σ gaps: (w − w′) (A × B)
//! ```
//!
//! with `w` before and `w′` behind the gap. These are eight comparisons; nothing is sorted or searched. At a tie both
//! choices give one area, so the sum is continuous; its derivative there is the mean.
//!
//! Boxes are symmetric, which leaves little of the sum. Let `x`, `y` be half the size of a, `p` and `q` the arms of
//! b (from its centre to its right and its upper side), `(u, v)` its centre, and `a₀ … a₃`, `b₀ … b₃` the weights at
//! the right, upper, left, lower normal of a and of b. With `A₀ = a₀ + a₂`, `A₁ = a₁ + a₃`, `B₀`, `B₁` likewise,
//!
//! ```text
//! area = x y (A₀ + A₁) + |p| |q| (4 − B₀ − B₁)
//!      + x (q_y (B₀ − A₁) − p_y (A₁ − B₁)) + y (p_x (B₁ − A₀) − q_x (A₀ − B₀)) + u Y − v X
//! X = p_x (b₁ − b₃) − q_x (b₂ − b₀) + x (a₁ − a₃)
//! Y = p_y (b₁ − b₃) + q_y (b₂ − b₀) + y (a₂ − a₀)
//! ```
//!
//! where q_x stands for its magnitude (q points to the left by as much as p points up). All terms with the centre are
//! one product, so that sizes are not lost in the distance of boxes very far apart. With constant weights this is a
//! polynomial, whose derivatives are plain.
use super::terms::unit;
use crate::clip::{Framed, Relative, frame, relate, size_scale};
use crate::{Aabb2, Obb2, Scalar, Vec2};

/// The hull of two related boxes, in the frame of a and the units of the related pair; mirrored where b
/// is turned clockwise. Weights are 0, ½, 1, their sums and differences.
///
/// With half the size `(x, y)` of a, the arms `p` and `q` of b from its centre to its right and its upper side, and the
/// weights `a₀ … a₃`, `b₀ … b₃` at the right, upper, left, lower normal of a and of b, which are 1 where a reaches
/// farther along that normal, 0 where b does and ½ at a tie: `A₀ = a₀ + a₂`, `A₁ = a₁ + a₃`, `B₀`, `B₁` likewise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HullOfBoxes<S: Scalar> {
    /// `true` where everything was mirrored: y, and b's turn, have the other sign.
    pub mirrored: S::Mask,
    /// Cosine and sine of b's turn, both not negative.
    pub turn: Vec2<S>,
    /// The centre of b.
    pub center: Vec2<S>,
    /// Half the size of a.
    pub half_a: Vec2<S>,
    /// Half the size of b.
    pub half_b: Vec2<S>,
    /// The magnitudes of `p_x`, `p_y`, `q_x`, `q_y`.
    pub arms: [S; 4],
    /// The numbers of sides of a and of b that the hull has: `A₀ + A₁`, `4 − B₀ − B₁`.
    pub sides: [S; 2],
    /// `A₀ − B₀`, `B₀ − A₁`, `A₁ − B₁`, `B₁ − A₀`.
    pub gaps: [S; 4],
    /// `a₀ − a₂`, `a₁ − a₃`: where a reaches farther to one side than to the other.
    pub lean_a: Vec2<S>,
    /// `b₀ − b₂`, `b₁ − b₃`.
    pub lean_b: Vec2<S>,
}

/// Returns the power of two by which a pair of boxes is multiplied before their hull is measured: that of
/// [`size_scale`], unless one is so large, or they are so far apart, that the hull of boxes of that size, or
/// its derivatives, might overflow.
#[inline(always)]
pub(crate) fn hull_scale<S: Scalar>(a: &Framed<S>, b: &Framed<S>) -> S {
    let half = |a: S, b: S| b.primal().halved() - a.primal().halved();
    let way =
        (half(a.center.x, b.center.x).unsigned()).most(half(a.center.y, b.center.y).unsigned());
    let none = way.at_most(S::Primal::zero());
    let by_way = S::Primal::select(none, S::Primal::one(), way).binade();
    // 2²⁰ units between the centres; but sizes stay above 2⁻⁸⁰.
    let by_way = S::from_primal((by_way * S::Primal::lit(1_048_576.0)).saturated());
    let by_size = size_scale(a.half, b.half);
    // The larger box has at most 2⁵² units.
    let larger = (a.half.x.most(a.half.y)).most(b.half.x.most(b.half.y));
    let none = larger.at_most(S::zero());
    let room = S::lit((1_u64 << 50) as f64);
    let by_larger = S::select(none, S::one(), larger).binade();
    let by_larger = S::select(none, by_size, (by_larger * room).saturated());
    let by_size = S::select(by_larger.below(by_size), by_larger, by_size);
    let scale = S::select(by_way.below(by_size), by_way, by_size);
    let least = by_size * S::lit(1.0 / (1_u64 << 40) as f64) * S::lit(1.0 / (1_u64 << 40) as f64);
    let scale = S::select(scale.below(least), least, scale);
    S::from_primal(scale.primal())
}

/// Returns 1 where the first is larger, 0 where the second is, ½ for a tie; a constant.
#[inline(always)]
fn larger<S: Scalar>(x: S, y: S) -> S {
    let (one, zero) = (S::one(), S::zero());
    let won = S::select(x.above(y), one, zero);
    S::select(x.equals(y), S::lit(0.5), won)
}

/// Returns the hull of a related pair.
#[inline(always)]
pub(crate) fn hull_of_related<S: Scalar>(pair: &Relative<S>) -> HullOfBoxes<S> {
    let mirrored = pair.sin.below(S::zero());
    let (u, v) = (pair.u, S::select(mirrored, -pair.v, pair.v));
    // The products are written as in `relate`, so that compilers compute them once.
    let (cos, sin) = (pair.cos, pair.sin.unsigned());
    let (a, b) = (pair.half_a, pair.half_b);
    let arms @ [px, py, qx, qy] = [b.x * cos, b.x * sin, b.y * sin, b.y * cos];
    // The extents of b from its centre along a's axes, and of a along b's; b's centre in b's frame.
    let reach_b = Vec2::new(px + qx, qy + py);
    let reach_a = Vec2::new(a.x * cos + a.y * sin, a.y * cos + a.x * sin);
    let along = u * cos + pair.v * pair.sin;
    let across = pair.v * cos - u * pair.sin;
    let across = S::select(mirrored, -across, across);
    let by_a = [
        larger(a.x, u + reach_b.x),
        larger(a.y, v + reach_b.y),
        larger(a.x, reach_b.x - u),
        larger(a.y, reach_b.y - v),
    ];
    let by_b = [
        larger(reach_a.x, along + b.x),
        larger(reach_a.y, across + b.y),
        larger(reach_a.x, b.x - along),
        larger(reach_a.y, b.y - across),
    ];
    let [a0, a1] = [by_a[0] + by_a[2], by_a[1] + by_a[3]];
    let [b0, b1] = [by_b[0] + by_b[2], by_b[1] + by_b[3]];
    HullOfBoxes {
        mirrored,
        turn: Vec2::new(cos, sin),
        center: Vec2::new(u, v),
        half_a: a,
        half_b: b,
        arms,
        sides: [a0 + a1, S::lit(4.0) - (b0 + b1)],
        gaps: [a0 - b0, b0 - a1, a1 - b1, b1 - a0],
        lean_a: Vec2::new(by_a[0] - by_a[2], by_a[1] - by_a[3]),
        lean_b: Vec2::new(by_b[0] - by_b[2], by_b[1] - by_b[3]),
    }
}

impl<S: Scalar> HullOfBoxes<S> {
    /// Returns the vector whose cross product with the centre of b is part of the hull's area.
    #[must_use]
    #[inline(always)]
    pub fn across(&self) -> Vec2<S> {
        let [px, py, qx, qy] = self.arms;
        let (a, lean, own) = (self.half_a, self.lean_b, self.lean_a);
        Vec2::new(
            (px * lean.y + qx * lean.x) + a.x * own.y,
            (py * lean.y - qy * lean.x) - a.y * own.x,
        )
    }
    /// Returns the gain of a's right and upper side by b's arms, per length: the factors of x and y.
    #[must_use]
    #[inline(always)]
    pub fn beside(&self) -> Vec2<S> {
        let ([px, py, qx, qy], gaps) = (self.arms, self.gaps);
        Vec2::new(qy * gaps[1] - py * gaps[2], px * gaps[3] - qx * gaps[0])
    }
    /// Returns the hull's area, in units of the related pair.
    #[must_use]
    #[inline(always)]
    pub fn area(&self) -> S {
        let (a, b, beside) = (self.half_a, self.half_b, self.beside());
        let own = (a.x * a.y) * self.sides[0] + (b.x * b.y) * self.sides[1];
        let joint = a.x * beside.x + a.y * beside.y;
        (own + joint) + self.center.perp_dot(self.across())
    }
}

/// Returns the area of the convex hull of two rotated boxes, in squared units of length. Saturates at the largest
/// finite number. Kinks: a corner passes through the border of the hull.
///
/// ```
/// use geograd::{Obb2, iou::hull_area_obb2};
/// let a = Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0);
/// assert_eq!(hull_area_obb2(a, Obb2::new(4.0, 0.0, 2.0, 2.0, 0.0)), 12.0);
/// assert_eq!(hull_area_obb2(a, a), 4.0);
/// ```
#[must_use]
#[inline]
pub fn hull_area_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>) -> S {
    let (a, b) = (frame(a), frame(b));
    let scale = hull_scale(&a, &b);
    let pair = relate::<S, true>(a, b, scale);
    let area = hull_of_related(&pair).area();
    // Rounding leaves a little area of either sign to flat boxes along one line.
    let none = area.below(S::zero());
    let area = S::select(none, area.with_primal(S::Primal::zero()), area);
    area.over(scale).over(scale).saturated().canonical()
}

/// Returns half the size of the smallest box around two axis-aligned ones, and the share of its area that the
/// four corners outside the hull have, as areas in quarter units.
#[inline(always)]
pub(super) fn hull_of_bounds<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, scale: Vec2<S>) -> (Vec2<S>, S) {
    let zero = S::zero();
    let gap = |x: S, y: S, scale: S| (y.halved() - x.halved()) * scale;
    let gaps = |p: Vec2<S>, q: Vec2<S>| Vec2::new(gap(p.x, q.x, scale.x), gap(p.y, q.y, scale.y));
    let (low, high) = (gaps(a.min, b.min), gaps(a.max, b.max));
    // A corner whose two bounds belong to different boxes leaves a triangle out.
    let cut = |x: S, y: S| (x * y).most(zero);
    let cuts =
        (cut(-low.x, low.y) + cut(high.x, low.y)) + (cut(-high.x, high.y) + cut(low.x, high.y));
    let joint = a.join(b);
    (gaps(joint.min, joint.max), cuts)
}

/// Returns the area of the convex hull of two axis-aligned boxes, in squared units of length: of the box around
/// both without the triangles at its corners. Saturates at the largest finite number.
///
/// ```
/// use geograd::{Aabb2, iou::hull_area_aabb2};
/// let a = Aabb2::new(0.0, 0.0, 1.0, 1.0);
/// assert_eq!(hull_area_aabb2(a, Aabb2::new(1.0, 1.0, 2.0, 2.0)), 3.0);
/// ```
#[must_use]
#[inline]
pub fn hull_area_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let scale = joint_unit(a, b);
    let (half, cuts) = hull_of_bounds(a, b, Vec2::new(scale, scale));
    let quarter = half.x * half.y;
    let area = (quarter + quarter) + (quarter + quarter) - (cuts + cuts);
    area.over(scale).over(scale).saturated().canonical()
}

/// Returns half the size of the box around two others.
#[inline(always)]
fn joint_half<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Vec2<S> {
    let joint = a.join(b);
    Vec2::new(
        joint.max.x.halved() - joint.min.x.halved(),
        joint.max.y.halved() - joint.min.y.halved(),
    )
}

/// Returns the power of two that brings the longer half side of the box around two others into `[½, 1)`.
#[inline(always)]
pub(super) fn joint_unit<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> S {
    let half = joint_half(a, b);
    unit([half.x, half.y])
}

/// Returns the powers of two that bring either half side into `[½, 1)`.
#[inline(always)]
pub(super) fn joint_units<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Vec2<S> {
    let half = joint_half(a, b);
    Vec2::new(unit([half.x]), unit([half.y]))
}
