//! Overlap of axis-aligned boxes in space.
use super::relate::size_scale3;
use super::{score, volume_from_half};
use crate::overlap::Denominator;
use crate::shape::Aabb3;
use crate::{Scalar, Vec3};

/// The shared part of two axis-aligned boxes, all sizes halved and in units of `1 / scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedBounds<S: Scalar> {
    /// Half the size of the shared part, of a and of b.
    pub half: [Vec3<S>; 3],
    /// The volume shared, that of a and that of b.
    pub volumes: [S; 3],
    /// `true` where the boxes are apart or merely touch.
    pub apart: S::Mask,
    /// `true` where both boxes are equal.
    pub same: S::Mask,
    /// The power of two by which sizes were multiplied.
    pub scale: S,
}

/// Measures what two axis-aligned boxes share.
#[inline(always)]
pub(crate) fn share3<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> SharedBounds<S> {
    // Halving first keeps the difference of two huge bounds finite.
    let half_of = |shape: Aabb3<S>| {
        let half = S::lit(0.5);
        shape.max * half - shape.min * half
    };
    let (half_a, half_b, half) = (half_of(a), half_of(b), half_of(a.meet(b)));
    let scale = size_scale3(half_a, half_b);
    let apart = (a.max.x.at_most(b.min.x) | b.max.x.at_most(a.min.x))
        | (a.max.y.at_most(b.min.y) | b.max.y.at_most(a.min.y))
        | (a.max.z.at_most(b.min.z) | b.max.z.at_most(a.min.z));
    let half = [half * scale, half_a * scale, half_b * scale];
    let volume = |half: Vec3<S>| volume_from_half([half.x, half.y, half.z]);
    let shared = S::select(apart, S::zero(), volume(half[0]));
    let same = (a.min.x.equals(b.min.x) & a.min.y.equals(b.min.y) & a.min.z.equals(b.min.z))
        & (a.max.x.equals(b.max.x) & a.max.y.equals(b.max.y) & a.max.z.equals(b.max.z));
    SharedBounds {
        half,
        volumes: [shared, volume(half[1]), volume(half[2])],
        apart,
        same,
        scale,
    }
}

fn score_aabb3<S: Scalar>(over: Denominator, a: Aabb3<S>, b: Aabb3<S>) -> S {
    let SharedBounds {
        volumes,
        same,
        scale,
        ..
    } = share3(a, b);
    let value = score(over, volumes[0], volumes[1], volumes[2], scale);
    let constant = S::from_primal(value.primal());
    match over {
        Denominator::Union => S::select(same, constant, value).canonical(),
        _ => value.canonical(),
    }
}

/// Returns the volume shared by two axis-aligned boxes, from 0 to the volume of the smaller one, in cubed units of
/// length. Saturates at the largest finite number.
///
/// Kinks and conventions: see the [module](super).
///
/// ```
/// use geograd::{Aabb3, Vec3, overlap3::intersection_volume_aabb3};
/// let a = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 2.0, 2.0));
/// let b = Aabb3::new(Vec3::new(1.0, 1.0, -1.0), Vec3::new(3.0, 3.0, 1.0));
/// assert_eq!(intersection_volume_aabb3(a, b), 1.0);
/// ```
#[must_use]
#[inline]
pub fn intersection_volume_aabb3<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> S {
    score_aabb3(Denominator::None, a, b)
}

/// Returns the intersection over union of two axis-aligned boxes, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
#[must_use]
#[inline]
pub fn iou_aabb3<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> S {
    score_aabb3(Denominator::Union, a, b)
}

/// Returns the share of the first axis-aligned box that lies in the second, in `[0, 1]`.
///
/// Kinks and conventions: see the [module](super).
#[must_use]
#[inline]
pub fn iof_aabb3<S: Scalar>(a: Aabb3<S>, b: Aabb3<S>) -> S {
    score_aabb3(Denominator::First, a, b)
}
