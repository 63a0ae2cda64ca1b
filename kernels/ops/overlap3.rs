//! The overlap of boxes of space as operations.
//!
//! Motions are those of the plane: boxes that turn about all axes promise nothing about turns.
use crate::ad::adjoint::bounds3::{intersection_volume_aabb3_vjp, iof_aabb3_vjp, iou_aabb3_vjp};
use crate::ad::adjoint::overlap::iou_obb2_vjp;
use crate::ad::adjoint::upright::{intersection_volume_yaw_vjp, iof_yaw_vjp, iou_yaw_vjp};
use crate::kernels::cpu::plan::Compiled;
use crate::operation;
use crate::overlap::Denominator;
use crate::overlap3::{
    Overlaps, intersection_volume_aabb3, intersection_volume_obb3, intersection_volume_obb3_vjp,
    intersection_volume_yaw, iof_aabb3, iof_obb3, iof_obb3_vjp, iof_yaw, iou_aabb3,
    iou_aabb3_obb3_vjp, iou_birds_eye, iou_obb3, iou_obb3_vjp, iou_yaw, iou_yaw_obb3_vjp,
};
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Obb2, Scalar, Vec2, Vec3};

/// [`iou_birds_eye`] and its slopes: those of the boxes seen from above.
fn birds_eye_vjp<S: Scalar>(
    a: YawBox3<S>,
    b: YawBox3<S>,
    out_bar: S,
) -> (S, (YawBox3<S>, YawBox3<S>)) {
    let flat = |x: Vec2<S>| Vec3::new(x.x, x.y, S::zero());
    let upright = |x: Obb2<S>| YawBox3::new(flat(x.center), flat(x.size), x.heading);
    let (a_bar, b_bar) = iou_obb2_vjp(a.birds_eye(), b.birds_eye(), out_bar);
    (iou_birds_eye(a, b), (upright(a_bar), upright(b_bar)))
}

operation! {
    /// [`intersection_volume_aabb3`].
    pub IntersectionVolumeAabb3 = "intersection_volume_aabb3":
        (a: Aabb3<S>, b: Aabb3<S>) -> S { intersection_volume_aabb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(3), Exchange Stays]
    finite Always range NOT_NEGATIVE extremes Shared
    jumps Never
    slopes ByHand |(a, b), out_bar| { intersection_volume_aabb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Aabb3 }

    /// [`iou_aabb3`].
    pub IouAabb3 = "iou_aabb3": (a: Aabb3<S>, b: Aabb3<S>) -> S { iou_aabb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    finite Always range RATIO extremes Union
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iou_aabb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Aabb3 }

    /// [`iof_aabb3`].
    pub IofAabb3 = "iof_aabb3": (a: Aabb3<S>, b: Aabb3<S>) -> S { iof_aabb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    finite Always range RATIO extremes Ratio
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iof_aabb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Aabb3 }

    /// [`intersection_volume_yaw`].
    pub IntersectionVolumeYaw = "intersection_volume_yaw":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { intersection_volume_yaw(a, b) }
    promises [
        TranslationX Stays, TranslationY Stays, Scaling Power(3), Exchange Stays, Rotation Stays,
    ]
    finite Always range NOT_NEGATIVE extremes Shared
    jumps Never
    slopes ByHand |(a, b), out_bar| { intersection_volume_yaw_vjp(a, b, out_bar) }
    => compiled { Compiled::Upright(Denominator::None) }

    /// [`iou_yaw`].
    pub IouYaw = "iou_yaw": (a: YawBox3<S>, b: YawBox3<S>) -> S { iou_yaw(a, b) }
    promises [
        TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays,
    ]
    finite Always range RATIO extremes Union
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iou_yaw_vjp(a, b, out_bar) }
    => compiled { Compiled::Upright(Denominator::Union) }

    /// [`iof_yaw`].
    pub IofYaw = "iof_yaw": (a: YawBox3<S>, b: YawBox3<S>) -> S { iof_yaw(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Rotation Stays]
    finite Always range RATIO extremes Ratio
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iof_yaw_vjp(a, b, out_bar) }
    => compiled { Compiled::Upright(Denominator::First) }

    /// [`iou_birds_eye`].
    pub IouBirdsEye = "iou_birds_eye":
        (a: YawBox3<S>, b: YawBox3<S>) -> S { iou_birds_eye(a, b) }
    promises [
        TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays, Rotation Stays,
    ]
    finite Always range RATIO extremes Union
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { birds_eye_vjp(a, b, out_bar) }
    => compiled { Compiled::BirdsEye(Denominator::Union) }

    /// [`intersection_volume_obb3`].
    pub IntersectionVolumeObb3 = "intersection_volume_obb3":
        (a: Obb3<S>, b: Obb3<S>) -> S { intersection_volume_obb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(3), Exchange Stays]
    finite Always range NOT_NEGATIVE extremes Shared
    jumps Never
    slopes ByHand |(a, b), out_bar| { intersection_volume_obb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Obb3(Denominator::None) }

    /// [`iou_obb3`].
    pub IouObb3 = "iou_obb3": (a: Obb3<S>, b: Obb3<S>) -> S { iou_obb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays, Exchange Stays]
    finite Always range RATIO extremes Union
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iou_obb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Obb3(Denominator::Union) }

    /// [`iof_obb3`].
    pub IofObb3 = "iof_obb3": (a: Obb3<S>, b: Obb3<S>) -> S { iof_obb3(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    finite Always range RATIO extremes Ratio
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iof_obb3_vjp(a, b, out_bar) }
    => compiled { Compiled::Obb3(Denominator::First) }

    /// [`Overlaps::iou_with`] of an axis-aligned box and an upright one.
    pub IouAabb3Yaw = "iou_aabb3_yaw":
        (a: Aabb3<S>, b: YawBox3<S>) -> S { a.iou_with(b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    range RATIO extremes Shared
    jumps FromZero
    slopes Forward

    /// [`Overlaps::iou_with`] of an axis-aligned box and one of any orientation.
    pub IouAabb3Obb3 = "iou_aabb3_obb3":
        (a: Aabb3<S>, b: Obb3<S>) -> S { a.iou_with(b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    finite Always range RATIO extremes Shared
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iou_aabb3_obb3_vjp(a, b, out_bar) }

    /// [`Overlaps::iou_with`] of an upright box and one of any orientation.
    pub IouYawObb3 = "iou_yaw_obb3":
        (a: YawBox3<S>, b: Obb3<S>) -> S { a.iou_with(b) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Stays]
    finite Always range RATIO extremes Shared
    jumps FromZero
    slopes ByHand |(a, b), out_bar| { iou_yaw_obb3_vjp(a, b, out_bar) }
}
