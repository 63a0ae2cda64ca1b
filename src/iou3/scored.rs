//! Boxes in space that have scores.
use super::enclosing::Enclosing;
use super::terms::Terms;
use super::{around, enclosing};
use crate::overlap3::{iou_aabb3, iou_obb3, iou_yaw};
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Scalar, Vec3};

/// A kind of box in space that the family of losses is for.
pub trait Solid<S: Scalar>: Copy + Into<Obb3<S>> {
    /// Returns the intersection over union.
    #[must_use]
    fn overlap(self, other: Self) -> S;
    /// Returns the size along the box's own axes.
    #[must_use]
    fn own_size(self) -> Vec3<S>;
    /// Returns the terms that scores subtract from the IoU, by the chosen shape around both boxes.
    #[must_use]
    fn terms(self, other: Self, iou: S, kind: Enclosing) -> Terms<S>;
}

impl<S: Scalar> Solid<S> for Aabb3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_aabb3(self, other)
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size()
    }
    #[inline]
    fn terms(self, other: Self, iou: S, kind: Enclosing) -> Terms<S> {
        enclosing::of_aligned(self, other, iou, kind)
    }
}

impl<S: Scalar> Solid<S> for YawBox3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_yaw(self, other)
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size
    }
    #[inline]
    fn terms(self, other: Self, iou: S, kind: Enclosing) -> Terms<S> {
        enclosing::of_upright(self, other, iou, kind)
    }
}

impl<S: Scalar> Solid<S> for Obb3<S> {
    #[inline]
    fn overlap(self, other: Self) -> S {
        iou_obb3(self, other)
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.size
    }
    #[inline]
    fn terms(self, other: Self, iou: S, kind: Enclosing) -> Terms<S> {
        around::of_any(self, other, iou, kind)
    }
}
