//! Powers of IoU.
use crate::overlap::{iou_aabb2, iou_obb2};
use crate::{Aabb2, Obb2, Scalar};

/// A positive number without a unit: the power of [`alpha_iou_obb2`] as an argument of a batch.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Exponent<S> {
    /// The number.
    #[shape(positive, number)]
    pub alpha: S,
}

/// Returns `iou^alpha`, zero with derivative zero where the boxes share nothing.
#[inline(always)]
fn powered<S: Scalar>(iou: S, alpha: S) -> S {
    let none = iou.at_most(S::zero());
    let power = (S::select(none, S::one(), iou).ln() * alpha).exp();
    S::select(none, S::zero(), power).canonical()
}

/// Returns a power of the IoU of two rotated boxes, in `[0, 1]`, for `alpha > 0`: He et al., Alpha-IoU, NeurIPS
/// 2021 (who use 3). See the [module](super).
#[must_use]
#[inline]
pub fn alpha_iou_obb2<S: Scalar>(a: Obb2<S>, b: Obb2<S>, alpha: S) -> S {
    powered(iou_obb2(a, b), alpha)
}

/// Returns a power of the IoU of two axis-aligned boxes, in `[0, 1]`, for `alpha > 0`: He et al., Alpha-IoU,
/// NeurIPS 2021 (who use 3). See the [module](super).
#[must_use]
#[inline]
pub fn alpha_iou_aabb2<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>, alpha: S) -> S {
    powered(iou_aabb2(a, b), alpha)
}
