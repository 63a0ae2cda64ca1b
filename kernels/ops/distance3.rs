//! Distances of points from boxes of space as operations.
//!
//! Motions are those of the plane: boxes that turn about all axes promise nothing about turns.
use crate::Vec3;
use crate::distance3::{distance, signed_distance};
use crate::operation;
use crate::shape::{Aabb3, Obb3, YawBox3};

operation! {
    /// [`signed_distance`] of a point and an axis-aligned box.
    pub SignedDistancePointAabb3 = "signed_distance_point_aabb3":
        (point: Vec3<S>, shape: Aabb3<S>) -> S { signed_distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse

    /// [`signed_distance`] of a point and an upright box.
    pub SignedDistancePointYaw = "signed_distance_point_yaw":
        (point: Vec3<S>, shape: YawBox3<S>) -> S { signed_distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Rotation Stays]
    jumps Never
    slopes Reverse

    /// [`signed_distance`] of a point and a box of any orientation.
    pub SignedDistancePointObb3 = "signed_distance_point_obb3":
        (point: Vec3<S>, shape: Obb3<S>) -> S { signed_distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse

    /// [`distance`] of a point and an axis-aligned box.
    pub DistancePointAabb3 = "distance_point_aabb3":
        (point: Vec3<S>, shape: Aabb3<S>) -> S { distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse

    /// [`distance`] of a point and an upright box.
    pub DistancePointYaw = "distance_point_yaw":
        (point: Vec3<S>, shape: YawBox3<S>) -> S { distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1), Rotation Stays]
    jumps Never
    slopes Reverse

    /// [`distance`] of a point and a box of any orientation.
    pub DistancePointObb3 = "distance_point_obb3":
        (point: Vec3<S>, shape: Obb3<S>) -> S { distance(point, shape) }
    promises [TranslationX Stays, TranslationY Stays, Scaling Power(1)]
    jumps Never
    slopes Reverse
}
