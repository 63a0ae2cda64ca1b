//! Faces of shapes of space that face another shape.
use super::core::Core3;
use crate::{Scalar, Vec3};

/// The face of a shape that faces another one, as a convex polygon.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Patch<S> {
    /// No more than the nearest point.
    Spot,
    /// The corners of a face, in order: one, two for a segment, three or four. The first `count` matter.
    Face { corners: [Vec3<S>; 4], count: usize },
    /// The plane of a half-space.
    Plane,
}

impl<S: Scalar<Mask = bool>> Patch<S> {
    /// Returns the face of a core that faces a direction, moved along it. A segment that is nearer to the direction than
    /// to its plane has no more than its end.
    pub(super) fn of<C: Core3<S>>(core: &C, toward: Vec3<S>, radius: S) -> Self {
        let corners = core.corners();
        let corners = corners.as_ref();
        let (chosen, count) = core.facing(toward);
        if let &[start, end] = corners {
            let way = end - start;
            let rise = toward.dot(way).unsigned();
            if (rise + rise).above(way.length()) {
                return Patch::Spot;
            }
        }
        let mut face = [Vec3::zero(); 4];
        for (place, &k) in face.iter_mut().zip(&chosen[..count]) {
            *place = corners[k] + toward * radius;
        }
        Patch::Face {
            corners: face,
            count,
        }
    }
}
