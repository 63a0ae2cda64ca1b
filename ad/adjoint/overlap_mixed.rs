//! Adjoints of the overlap of boxes of two kinds in space.
use super::overlap3::iou_obb3_vjp;
use crate::shape::{Aabb3, Obb3, Rotation3, YawBox3};
use crate::{Pack, Scalar};

/// Returns the gradient by an upright box from that by the same box as one of any orientation: the turn about the
/// z axis is the third of its body tangents.
#[inline]
fn upright<S: Scalar>(shape: YawBox3<S>, g: Obb3<S>) -> YawBox3<S> {
    // An eighth of the gradient, so that a sum of the largest numbers is finite.
    let q = g.rotation;
    let eighth = S::lit(0.125);
    let q = Rotation3::new(q.w * eighth, q.x * eighth, q.y * eighth, q.z * eighth);
    let turn = shape.rotation().tangent_gradient(q);
    YawBox3::new(g.center, g.size, (turn.z * S::lit(8.0)).saturated())
}

/// Returns the gradient by bounds from that by the same box as one of any orientation.
#[inline]
fn bounds<S: Scalar>(g: Obb3<S>) -> Aabb3<S> {
    let half = g.center * S::lit(0.5);
    Aabb3::new((half - g.size).saturated(), (half + g.size).saturated())
}

/// Returns the intersection over union of an upright box and one of any orientation, and `out_bar` times its derivatives by
/// both.
#[must_use]
#[inline]
pub fn iou_yaw_obb3_vjp<S: Scalar>(
    a: YawBox3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (YawBox3<S>, Obb3<S>)) {
    let (value, (a_bar, b_bar)) = iou_obb3_vjp(a.into(), b, out_bar);
    (value, (upright(a, a_bar), b_bar))
}

/// Returns the intersection over union of an axis-aligned box and one of any orientation, and `out_bar` times its derivatives
/// by both.
#[must_use]
#[inline]
pub fn iou_aabb3_obb3_vjp<S: Scalar>(
    a: Aabb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Aabb3<S>, Obb3<S>)) {
    let (value, (a_bar, b_bar)) = iou_obb3_vjp(a.into(), b, out_bar);
    (value, (bounds(a_bar), b_bar))
}

/// A box of space as one of any orientation, and its gradient from that one's.
pub(crate) trait AnyBox<S: Scalar>: Copy + Into<Obb3<S>> + Pack<Scalar = S> {
    /// Returns the gradient by this box from that by the same box as one of any orientation.
    fn own_gradient(self, g: Obb3<S>) -> Self;
}
impl<S: Scalar> AnyBox<S> for Obb3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        g
    }
}
impl<S: Scalar> AnyBox<S> for YawBox3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        upright(self, g)
    }
}
impl<S: Scalar> AnyBox<S> for Aabb3<S> {
    #[inline]
    fn own_gradient(self, g: Obb3<S>) -> Self {
        bounds(g)
    }
}

/// Returns the result and gradients for boxes of two kinds, from those for boxes of any orientation.
#[inline]
pub(crate) fn mixed_vjp<S: Scalar, A: AnyBox<S>, B: AnyBox<S>>(
    a: A,
    b: B,
    vjp: impl FnOnce(Obb3<S>, Obb3<S>) -> (S, (Obb3<S>, Obb3<S>)),
) -> (S, (A, B)) {
    let (value, (a_bar, b_bar)) = vjp(a.into(), b.into());
    let (mut a_bar, mut b_bar) = (a.own_gradient(a_bar), b.own_gradient(b_bar));
    // Zeros have no sign, as in all results.
    a_bar.each(&mut |x| *x = x.canonical());
    b_bar.each(&mut |x| *x = x.canonical());
    (value, (a_bar, b_bar))
}
