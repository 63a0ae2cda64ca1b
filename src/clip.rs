//! The border of one box clipped to another, from which areas of intersection and their derivatives are computed.
//!
//! # The method
//!
//! Let `K` be an axis-aligned box about the origin, `P` any polygon, and `C` the map that clamps
//! each coordinate to `K`. `C` is continuous, fixes `K` and sends everything outside to its border,
//! and the straight path from a point to its clamp never meets the inside of `K`. So the border of
//! `P` and its image under `C` wind equally often about every point inside `K`, and
//!
//! ```text
//! area(P ∩ K) = ∮ x dy  over  C(border of P).
//! ```
//!
//! There is no vertex list, no sorting, no case analysis; the sum is continuous in every input, so
//! identical, touching, contained and collinear boxes need no handling. Each corner's y is clamped
//! once and both edges that meet there use the result, so that rounding cannot make them disagree
//! about whether the corner is inside.
//!
//! Its functions are internal; those of [`overlap`](crate::overlap) call them.
use crate::scalar::power_of_largest;
use crate::{Obb2, Scalar, Shape, Vec2, twofold};

/// Returns the area of a box from half its size. Doubled first, so that an area that can be represented is
/// rounded once.
#[inline(always)]
pub(crate) fn area_from_half<S: Scalar>(half: Vec2<S>) -> S {
    (half.x + half.x) * (half.y + half.y)
}

/// A box with sine and cosine of its heading: the data that a batch computes once per box.
#[derive(Clone, Copy, Debug, Shape)]
#[shape(except(Validate, approx, Sample, Arbitrary))]
pub(crate) struct Framed<S> {
    /// The centre.
    pub center: Vec2<S>,
    /// Half the size.
    pub half: Vec2<S>,
    /// Cosine of the heading.
    pub cos: S,
    /// Sine of the heading.
    pub sin: S,
    /// The high half of the cosine's significand (unused where products carry no low part).
    pub cos_high: S,
    /// The cosine without its high part, more precise than `cos − cos_high`.
    pub cos_low: S,
    /// The high half of the sine's significand.
    pub sin_high: S,
    /// The sine without its high part.
    pub sin_low: S,
}

/// Computes sine and cosine of a box's heading.
#[inline(always)]
pub(crate) fn frame<S: Scalar>(shape: Obb2<S>) -> Framed<S> {
    let half = Vec2::new(shape.size.x.halved(), shape.size.y.halved());
    if S::format().is_compensated() {
        let [(sin_high, sin_low), (cos_high, cos_low)] = shape.heading.sin_cos_parts();
        let (cos, sin) = (cos_high + cos_low, sin_high + sin_low);
        Framed {
            center: shape.center,
            half,
            cos,
            sin,
            cos_high,
            cos_low,
            sin_high,
            sin_low,
        }
    } else {
        let ((sin, cos), zero) = (shape.heading.sin_cos(), S::zero());
        Framed {
            center: shape.center,
            half,
            cos,
            sin,
            cos_high: zero,
            cos_low: zero,
            sin_high: zero,
            sin_low: zero,
        }
    }
}

/// Returns the power of two by which a pair of boxes, given by half their sizes, is multiplied so that no area over- or
/// underflows. It brings the larger side of the smaller box near one, unless that is zero or the other box would become
/// too large.
#[inline(always)]
pub(crate) fn size_scale<S: Scalar>(half_a: Vec2<S>, half_b: Vec2<S>) -> S {
    let (size_a, size_b) = (half_a.x.most(half_a.y), half_b.x.most(half_b.y));
    let (smaller, larger) = (size_a.least(size_b), size_a.most(size_b));
    let bounded = smaller.most(larger * S::lit(LARGEST_INVERSE));
    let size = S::select(smaller.at_most(S::zero()), larger, bounded);
    let zero = size.at_most(S::zero());
    S::select(zero, S::one(), S::select(zero, S::one(), size).binade())
}

/// The larger box of a pair may be 2⁵⁹ times as large as the smaller one; its area fits an `f32`, and a box [`FAR`]
/// away is apart from it in any orientation.
pub(crate) const LARGEST_INVERSE: f64 = 1.0 / (1_u64 << 59) as f64;

/// Beyond this many units (of which the smaller box has about one) between the centres in either
/// coordinate, only the fact that the boxes are apart matters.
pub(crate) const FAR: f64 = (1_u64 << 62) as f64;

/// Box `b` in the frame of box `a`, both in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative<S: Scalar> {
    /// Centre of b in a's frame.
    pub u: S,
    /// Centre of b in a's frame.
    pub v: S,
    /// Cosine of b's heading in a's frame, turned by quarters until it is the larger of the two:
    /// at least √½.
    pub cos: S,
    /// Sine of b's heading in a's frame, turned likewise: at most √½ in magnitude.
    pub sin: S,
    /// Half the size of a.
    pub half_a: Vec2<S>,
    /// Half the size of b, exchanged when it was turned by an odd number of quarters.
    pub half_b: Vec2<S>,
    /// `true` where the size of b was exchanged.
    pub swapped: S::Mask,
    /// `true` where the sides are parallel.
    pub parallel: S::Mask,
    /// `true` where the boxes are apart or merely touch, by the separating-axis test.
    pub apart: S::Mask,
}

/// Returns `b − a` in units of `1 / scale`, clamped to the distance that matters, and its rounding error (a constant;
/// zero where products carry no low part).
#[inline(always)]
fn difference<S: Scalar, const EXTREME: bool>(a: S, b: S, scale: S) -> (S, S) {
    let rounded = b - a;
    let mut lost = S::Primal::zero();
    if S::format().is_compensated() {
        lost = twofold::lost(b.primal(), a.primal(), rounded.primal());
    }
    let lost = S::from_primal(lost);
    if !EXTREME {
        return (rounded, lost);
    }
    let (x, far) = (rounded * scale, S::lit(FAR));
    let near = x.unsigned().at_most(far);
    let x = S::select(near, x, S::select(x.below(S::zero()), -far, far));
    // Near the largest number what rounding took may be beyond it.
    let told = near
        & rounded
            .unsigned()
            .at_most(S::lit(0.5 * S::format().largest()));
    (x, S::select(told, lost * scale, S::zero()))
}

/// Sees `b` from `a`.
///
/// The difference of the centres comes first, so the distance from the origin costs no digits. The products of a scalar
/// with 24 bits carry low parts. The result is then right to about 2⁻³⁵ of its inputs even where it cancels, which long
/// thin boxes need. `EXTREME` enables the scale.
#[inline(always)]
pub(crate) fn relate<S: Scalar, const EXTREME: bool>(
    a: Framed<S>,
    b: Framed<S>,
    scale: S,
) -> Relative<S> {
    let (dx, lost_x) = difference::<S, EXTREME>(a.center.x, b.center.x, scale);
    let (dy, lost_y) = difference::<S, EXTREME>(a.center.y, b.center.y, scale);
    let (u, v, cos, sin);
    if S::format().is_compensated() {
        let ((dx_high, dx_low), (dy_high, dy_low)) = (dx.parts(), dy.parts());
        let (dx_low, dy_low) = (dx_low + lost_x, dy_low + lost_y);
        u = (a.cos_high * dx_high + a.sin_high * dy_high)
            + ((a.cos_high * dx_low + a.sin_high * dy_low) + (a.cos_low * dx + a.sin_low * dy));
        v = (a.cos_high * dy_high - a.sin_high * dx_high)
            + ((a.cos_high * dy_low - a.sin_high * dx_low) + (a.cos_low * dy - a.sin_low * dx));
        cos = (a.cos_high * b.cos_high + a.sin_high * b.sin_high)
            + ((a.cos_low * b.cos_high + a.sin_low * b.sin_high)
                + (a.cos * b.cos_low + a.sin * b.sin_low));
        sin = (a.cos_high * b.sin_high - a.sin_high * b.cos_high)
            + ((a.cos_low * b.sin_high - a.sin_low * b.cos_high)
                + (a.cos * b.sin_low - a.sin * b.cos_low));
    } else {
        u = a.cos * dx + a.sin * dy;
        v = a.cos * dy - a.sin * dx;
        cos = a.cos * b.cos + a.sin * b.sin;
        sin = a.cos * b.sin - a.sin * b.cos;
    }

    // A quarter turn with exchanged sides, or a half turn, gives the same box.
    let swapped = cos.unsigned().below(sin.unsigned());
    let (cos, sin) = (S::select(swapped, sin, cos), S::select(swapped, -cos, sin));
    let turned = cos.below(S::zero());
    let (cos, sin) = (S::select(turned, -cos, cos), S::select(turned, -sin, sin));
    let half_a = a.half * scale;
    let half_b = b.half * scale;
    let half_b = Vec2::new(
        S::select(swapped, half_b.y, half_b.x),
        S::select(swapped, half_b.x, half_b.y),
    );
    let parallel = sin.unsigned().below(S::lit(S::format().parallel()));
    let cos = S::select(parallel, cos.with_primal(S::Primal::one()), cos);
    let sin = S::select(parallel, sin.with_primal(S::Primal::zero()), sin);

    let steep = sin.unsigned();
    let apart_in_a = u
        .unsigned()
        .at_least(half_a.x + (half_b.x * cos + half_b.y * steep))
        | v.unsigned()
            .at_least(half_a.y + (half_b.y * cos + half_b.x * steep));
    let apart_in_b = (u * cos + v * sin)
        .unsigned()
        .at_least(half_b.x + (half_a.x * cos + half_a.y * steep))
        | (v * cos - u * sin)
            .unsigned()
            .at_least(half_b.y + (half_a.y * cos + half_a.x * steep));
    let apart = apart_in_a | apart_in_b;
    Relative {
        u,
        v,
        cos,
        sin,
        half_a,
        half_b,
        swapped,
        parallel,
        apart,
    }
}

/// One end of an edge of b, after the strip of a's height was cut out: its x clamped to a, and by
/// how much it lies beyond.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End<S> {
    /// Clamped to a.
    pub x: S,
    /// The part of x that the clamp took away: positive beyond the right side, negative beyond the left.
    pub beyond: S,
}

impl<S: Scalar> End<S> {
    /// Clamps an x.
    #[inline(always)]
    fn at(x: S, low: S, high: S) -> Self {
        let clamped = x.clamp(low, high);
        End {
            x: clamped,
            beyond: x - clamped,
        }
    }
}

/// The border of b clamped to a. Corners are numbered counter-clockwise from (−, −) in b's own
/// frame; the bottom edge runs from corner 0 to 1, the right one from 1 to 2, the top one from 2
/// to 3, the left one from 3 to 0. All coordinates are relative to a point of a near b's centre,
/// so that a small box in a large one keeps its digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clip<S: Scalar> {
    /// Centre of b.
    pub u: S,
    /// Centre of b.
    pub v: S,
    /// Half of b's width times sine and cosine, half its height likewise: `[pc, ps, qc, qs]`.
    pub arms: [S; 4],
    /// Bounds of a.
    pub low: Vec2<S>,
    /// Bounds of a.
    pub high: Vec2<S>,
    /// The corners' y clamped to a.
    pub y: [S; 4],
    /// The part of y that the clamp took away.
    pub above: [S; 4],
    /// Both ends of the bottom edge, from left to right.
    pub bottom: [End<S>; 2],
    /// Both ends of the right edge, from bottom to top.
    pub right: [End<S>; 2],
    /// Both ends of the top edge, from right to left.
    pub top: [End<S>; 2],
    /// Both ends of the left edge, from top to bottom.
    pub left: [End<S>; 2],
    /// Derivative dy/dx of the bottom edge (for the heading's derivative shared at a tie).
    pub derivative_bottom: S,
    /// Derivative dy/dx of the top edge.
    pub derivative_top: S,
    /// Derivative dx/dy of bottom and top edge; minus the derivative dy/dx of right and left. Zero where
    /// the sides are parallel and nothing depends on it.
    pub steepness: S,
}

/// Returns the point of `[−half, half]` nearest to `x`, as a constant.
#[inline(always)]
fn nearest_inside<S: Scalar>(x: S, half: S) -> S {
    let half = half.primal();
    S::from_primal(x.primal().clamp(-half, half))
}

/// Returns the share of a side of b parallel to a's top and bottom that counts as inside: one, zero, or half if it lies
/// along one of them. It does not affect values.
#[inline(always)]
fn share_inside<S: Scalar>(y: S, low: S, high: S, parallel: S::Mask) -> S::Primal {
    let (y, low, high) = (y.primal(), low.primal(), high.primal());
    let (zero, half, one) = (S::Primal::zero(), S::Primal::lit(0.5), S::Primal::one());
    let outside = S::Primal::select(y.below(low) | y.above(high), zero, one);
    let shared = S::Primal::select(y.equals(low) | y.equals(high), half, outside);
    S::Primal::select(parallel, shared, one)
}

/// Clamps the border of b to a.
#[inline(always)]
pub(crate) fn clip<S: Scalar>(pair: Relative<S>) -> Clip<S> {
    let Relative {
        cos,
        sin,
        half_a,
        half_b,
        parallel,
        ..
    } = pair;
    let origin = Vec2::new(
        nearest_inside(pair.u, half_a.x),
        nearest_inside(pair.v, half_a.y),
    );
    let (u, v) = (pair.u - origin.x, pair.v - origin.y);
    let low = Vec2::new(-half_a.x - origin.x, -half_a.y - origin.y);
    let high = Vec2::new(half_a.x - origin.x, half_a.y - origin.y);

    let derivative = sin.over(cos);
    let steepness = cos.over(S::select(parallel, S::one(), sin));
    let steepness = S::select(parallel, S::zero(), steepness);

    let (pc, ps) = (half_b.x * cos, half_b.x * sin);
    let (qc, qs) = (half_b.y * cos, half_b.y * sin);
    let (mx, my) = (pc - qs, ps + qc);
    let (nx, ny) = (pc + qs, ps - qc);
    let corner_x = [u - mx, u + nx, u + mx, u - nx];
    let corner_y = [v - my, v + ny, v + my, v - ny];
    let y = [
        corner_y[0].clamp(low.y, high.y),
        corner_y[1].clamp(low.y, high.y),
        corner_y[2].clamp(low.y, high.y),
        corner_y[3].clamp(low.y, high.y),
    ];
    let above = [
        corner_y[0] - y[0],
        corner_y[1] - y[1],
        corner_y[2] - y[2],
        corner_y[3] - y[3],
    ];
    Clip {
        u,
        v,
        arms: [pc, ps, qc, qs],
        low,
        high,
        y,
        above,
        bottom: [
            End::at(corner_x[0] - above[0] * steepness, low.x, high.x),
            End::at(corner_x[1] - above[1] * steepness, low.x, high.x),
        ],
        right: [
            End::at(corner_x[1] + above[1] * derivative, low.x, high.x),
            End::at(corner_x[2] + above[2] * derivative, low.x, high.x),
        ],
        top: [
            End::at(corner_x[2] - above[2] * steepness, low.x, high.x),
            End::at(corner_x[3] - above[3] * steepness, low.x, high.x),
        ],
        left: [
            End::at(corner_x[3] + above[3] * derivative, low.x, high.x),
            End::at(corner_x[0] + above[0] * derivative, low.x, high.x),
        ],
        derivative_bottom: derivative.damp(share_inside(corner_y[0], low.y, high.y, parallel)),
        derivative_top: derivative.damp(share_inside(corner_y[2], low.y, high.y, parallel)),
        steepness,
    }
}

/// Returns the term of an edge by its clamping: `(X₁ − X₀)(e₀ + e₁)`.
#[inline(always)]
fn bend<S: Scalar>(edge: [End<S>; 2]) -> S {
    (edge[1].x - edge[0].x) * (edge[0].beyond + edge[1].beyond)
}

/// Returns the area inside the clamped border, `∮ x dy`; rounding can leave it a little outside `[0, …]`.
///
/// An edge from `(x₀, y₀)` to `(x₁, y₁)`, both y clamped, contributes the mean of its clamped x
/// times its height. With `X` the clamped x and `e = x − X` that is
/// `(y₁ − y₀)(X₀ + X₁)/2 + (X₁ − X₀)(e₀ + e₁)/2 · dy/dx`.
#[inline(always)]
pub(crate) fn clipped_area<S: Scalar>(clip: &Clip<S>) -> S {
    let y = clip.y;
    let straight = ((y[1] - y[0]) * (clip.bottom[0].x + clip.bottom[1].x)
        + (y[3] - y[2]) * (clip.top[0].x + clip.top[1].x))
        + ((y[2] - y[1]) * (clip.right[0].x + clip.right[1].x)
            + (y[0] - y[3]) * (clip.left[0].x + clip.left[1].x));
    let flat = bend(clip.bottom) * clip.derivative_bottom + bend(clip.top) * clip.derivative_top;
    let upright = (bend(clip.right) + bend(clip.left)) * clip.steepness;
    (straight + (flat - upright)).halved()
}

/// Returns the area of intersection of a related pair from its [`clipped_area`], in units of `1 / scale²`:
/// exactly zero for boxes that are apart, never more than either box has.
#[inline(always)]
pub(crate) fn related_area<S: Scalar>(pair: &Relative<S>, area: S) -> S {
    // As scores measure boxes, so that identical ones share all of it, however small.
    let (a, b) = (pair.half_a, pair.half_b);
    let area_a = area_from_half(Vec2::new(a.x.primal(), a.y.primal()));
    let area_b = area_from_half(Vec2::new(b.x.primal(), b.y.primal()));
    let limit = area_a.least(area_b);
    let beyond = area.above(S::from_primal(limit));
    let area = S::select(beyond, area.with_primal(limit), area);
    S::select(nothing_shared(pair, area), S::zero(), area)
}

/// Returns `true` where a pair counts as sharing nothing, so that value and derivatives are zero.
#[inline(always)]
pub(crate) fn nothing_shared<S: Scalar>(pair: &Relative<S>, area: S) -> S::Mask {
    pair.apart | area.below(S::zero())
}

/// Sizes outside these limits may make products over- or underflow.
pub(crate) const SMALL: f64 = 1e-9;
pub(crate) const LARGE: f64 = 1e9;
/// Coordinates of the centre beyond this limit may make products overflow, too.
pub(crate) const FAR_AWAY: f64 = 1e15;

/// Returns the limit for coordinates and headings that are not zero: below it products may underflow. It is `10⁻¹²` in
/// single precision.
pub(crate) fn fine<S: Scalar>() -> f64 {
    power_of_largest::<S>(-0.3125)
}

/// Sides of shapes whose measures of the second and third power of a length, and derivatives of those, stay far from
/// over- and underflow in single precision, unless one is tiny and the other huge.
pub(crate) const COMMON_SMALL: f64 = 1e-5;
pub(crate) const COMMON_LARGE: f64 = 1e6;
/// Coordinates of the centre of such shapes are not beyond this.
pub(crate) const COMMON_FAR: f64 = 1e9;

/// Returns `true` where a box is valid and plain products of its numbers stay far from over- and underflow, so that a
/// batch of such boxes needs no [`size_scale`]. The results have equal bits in both cases.
///
/// Without branches, since a batch tests every box first.
#[inline(always)]
pub(crate) fn is_ordinary<S: Scalar>(shape: Obb2<S>) -> S::Mask {
    let fine = S::lit(fine::<S>());
    let (small, large) = (S::lit(SMALL), S::lit(LARGE));
    let far = S::lit(FAR_AWAY);
    let (center, size) = (shape.center, shape.size);
    zero_or_within(size.x, small, large)
        & zero_or_within(size.y, small, large)
        & zero_or_within(center.x.unsigned(), fine, far)
        & zero_or_within(center.y.unsigned(), fine, far)
        & zero_or_within(shape.heading.unsigned(), fine, S::largest())
}

/// Returns `true` where a number is zero or from `low` to `high`.
#[inline(always)]
pub(crate) fn zero_or_within<S: Scalar>(x: S, low: S, high: S) -> S::Mask {
    x.equals(S::zero()) | (x.at_least(low) & x.at_most(high))
}
