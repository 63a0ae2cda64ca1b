//! Adjoints of the overlap scores of axis-aligned boxes in space.
//!
//! With `h` half the size of the shared part, the volume shared is `8 h_x h_y h_z`. A bound that decides alone takes
//! the whole derivative of its side, tied bounds half each; the contribution of a box's own volume goes to its own
//! bounds.
//!
//! Derivatives are finite for finite boxes: those too steep for the format are its largest number.
use crate::ad::adjoint::overlap::{part_taken, score_derivatives, tamed};
use crate::overlap::Denominator;
use crate::overlap3::{SharedBounds, score, share3};
use crate::shape::Aabb3;
use crate::{Scalar, Vec3};

/// Derivatives by both boxes.
pub type Bars<S> = (Aabb3<S>, Aabb3<S>);

/// Returns the areas of a box's faces across each axis, in quarters, from half its size.
#[inline(always)]
fn faces<S: Scalar>(half: Vec3<S>) -> Vec3<S> {
    Vec3::new(half.y * half.z, half.z * half.x, half.x * half.y)
}

/// Returns the product field by field.
#[inline(always)]
fn times<S: Scalar>(x: Vec3<S>, y: Vec3<S>) -> Vec3<S> {
    Vec3::new(x.x * y.x, x.y * y.y, x.z * y.z)
}

/// Returns the first shape's part of the derivatives of shared bounds, of which the smaller ones decide.
#[inline(always)]
fn parts<S: Scalar>(mine: Vec3<S>, other: Vec3<S>) -> Vec3<S> {
    Vec3::new(
        part_taken(mine.x, other.x),
        part_taken(mine.y, other.y),
        part_taken(mine.z, other.z),
    )
}

/// Returns `1 - x`, number by number.
#[inline(always)]
fn rest<S: Scalar>(x: Vec3<S>) -> Vec3<S> {
    Vec3::new(S::one() - x.x, S::one() - x.y, S::one() - x.z)
}

/// Converts derivatives to the caller's unit, by one factor after another.
#[inline(always)]
fn outer<S: Scalar>(x: Vec3<S>, by: [S; 3]) -> Vec3<S> {
    let x = (x * by[0]).saturated();
    ((x * by[1]).saturated() * by[2]).saturated().canonical()
}

/// Returns the value of a score and `out_bar` times its derivatives.
fn score_vjp<S: Scalar>(over: Denominator, a: Aabb3<S>, b: Aabb3<S>, out_bar: S) -> (S, Bars<S>) {
    let (zero, one) = (S::zero(), S::one());
    let (out_bar, steep) = tamed(out_bar);
    let SharedBounds {
        half: [half, half_a, half_b],
        volumes,
        apart,
        same,
        scale,
    } = share3(a, b);
    // It may be infinite for boxes apart, and no derivative of zero makes that zero.
    let none = |x: S| S::select(apart, zero, x);
    let half = Vec3::new(none(half.x), none(half.y), none(half.z));
    let value = score(over, volumes[0], volumes[1], volumes[2], scale);
    let derivatives = score_derivatives(over, value, volumes, out_bar);
    // The score over the union has derivative zero at identical boxes, by symmetry.
    let flat = match over {
        Denominator::Union => apart | same,
        Denominator::None | Denominator::First => apart,
    };
    let shared_bar = S::select(flat, zero, derivatives.inter);
    let falling = S::select(flat, zero, derivatives.falling);
    // A volume is eight times the product of the halves; a bound moves a half by half as much.
    let four = S::lit(4.0);
    let (max, min) = (parts(a.max, b.max), parts(b.min, a.min));
    let shared = (faces(half) * (four * shared_bar)).saturated();
    let own_a = (faces(half_a) * (four * derivatives.own[0])).saturated() * falling;
    let own_b = (faces(half_b) * (four * derivatives.own[1])).saturated() * falling;
    // Factors into the caller's unit, for the derivative of a volume (it leaves two lengths) or of a ratio.
    let units = match over {
        Denominator::None => {
            let unit = one.over(scale);
            [unit, unit, steep]
        }
        Denominator::Union | Denominator::First => [scale, steep, one],
    };
    let value = value.canonical();
    (
        value,
        (
            Aabb3 {
                min: outer(-(times(shared, min) + own_a), units),
                max: outer(times(shared, max) + own_a, units),
            },
            Aabb3 {
                min: outer(-(times(shared, rest(min)) + own_b), units),
                max: outer(times(shared, rest(max)) + own_b, units),
            },
        ),
    )
}

/// Returns the volume shared by two axis-aligned boxes, and `out_bar` times its derivatives by both.
///
/// ```
/// use geograd::{Aabb3, Vec3, ad::adjoint::bounds3::intersection_volume_aabb3_vjp};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0));
/// let b = Aabb3::new(Vec3::new(1.0, 0.5, -1.0), Vec3::new(3.0, 3.0, 3.0));
/// let (volume, (a_bar, b_bar)) = intersection_volume_aabb3_vjp(a, b, 1.0);
/// assert_eq!(volume, 1.0 * 1.5 * 2.0);
/// // The right side of a and the left side of b bound what they share.
/// assert_eq!((a_bar.max.x, b_bar.min.x), (3.0, -3.0));
/// assert_eq!((a_bar.min.x, b_bar.max.x), (0.0, 0.0));
/// ```
#[must_use]
#[inline]
pub fn intersection_volume_aabb3_vjp<S: Scalar>(
    a: Aabb3<S>,
    b: Aabb3<S>,
    out_bar: S,
) -> (S, Bars<S>) {
    score_vjp(Denominator::None, a, b, out_bar)
}

/// Returns the intersection over union of two axis-aligned boxes in space, and `out_bar` times its derivatives by both.
#[must_use]
#[inline]
pub fn iou_aabb3_vjp<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>, out_bar: S) -> (S, Bars<S>) {
    score_vjp(Denominator::Union, a, b, out_bar)
}

/// Returns the share of the first axis-aligned box in space that lies in the second, and `out_bar` times its
/// derivatives by both.
#[must_use]
#[inline]
pub fn iof_aabb3_vjp<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>, out_bar: S) -> (S, Bars<S>) {
    score_vjp(Denominator::First, a, b, out_bar)
}
