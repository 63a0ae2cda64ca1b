//! Boxes of space whose overlap is known: scores made of it and of something cheap.
//!
//! The overlap of two boxes of any orientation has compiled derivatives of its own. The rest of a score
//! is recorded by itself, with the overlap as one more argument, so that nothing large is recorded twice.
use geograd::iou3::{Enclosing, Solid, Terms};
use geograd::{Obb3, Scalar, Vec3};

/// One of two boxes, with the overlap of both.
#[derive(Clone, Copy, Debug)]
pub struct Known<B, S> {
    pub shape: B,
    pub iou: S,
}

impl<S: Scalar, B: Solid<S>> From<Known<B, S>> for Obb3<S> {
    #[inline]
    fn from(known: Known<B, S>) -> Self {
        known.shape.into()
    }
}

impl<S: Scalar, B: Solid<S>> Solid<S> for Known<B, S> {
    #[inline]
    fn overlap(self, _other: Self) -> S {
        self.iou
    }
    #[inline]
    fn own_size(self) -> Vec3<S> {
        self.shape.own_size()
    }
    #[inline]
    fn terms(self, other: Self, iou: S, kind: Enclosing) -> Terms<S> {
        self.shape.terms(other.shape, iou, kind)
    }
}

/// Both boxes of a pair with their overlap.
#[inline]
pub fn known<B, S: Copy>(a: B, b: B, iou: S) -> [Known<B, S>; 2] {
    [Known { shape: a, iou }, Known { shape: b, iou }]
}
