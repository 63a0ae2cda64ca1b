//! Faces of shapes of space that face another shape.
use super::core::Core3;
use super::relation::direction;
use crate::{Scalar, Vec3};

/// The most corners of a face. Of faces of hulls with more corners as many are left out evenly.
pub(super) const SIDES: usize = 16;
/// The corners by which a flat end of a cylinder or a cone, or a disc, counts: a regular octagon on the rim.
const RIM: usize = 8;
/// The sines of the eighths of a turn.
const EIGHTHS: [f64; RIM] = {
    use std::f64::consts::FRAC_1_SQRT_2 as HALF;
    [0.0, HALF, 1.0, HALF, 0.0, -HALF, -1.0, -HALF]
};

/// The face of a shape that faces another one, as a convex polygon.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Patch<S> {
    /// No more than the nearest point.
    Spot,
    /// The corners of a face, in order: one, two for a segment, three or more. The first `count` matter.
    Face {
        corners: [Vec3<S>; SIDES],
        count: usize,
    },
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
        Self::polygon(
            chosen[..count]
                .iter()
                .map(|&k| corners[k] + toward * radius),
        )
    }
    /// Returns a face by its corners, in order, of which the first sixteen count.
    pub(super) fn polygon(all: impl Iterator<Item = Vec3<S>>) -> Self {
        let (mut corners, mut count) = ([Vec3::zero(); SIDES], 0);
        for (place, corner) in corners.iter_mut().zip(all) {
            *place = corner;
            count += 1;
        }
        Patch::Face { corners, count }
    }
    /// Returns the face of a flat round end, by its centre, a direction along the axis, and the radius.
    pub(super) fn rim(center: Vec3<S>, axis: Vec3<S>, radius: S) -> Self {
        let [x, y] = across(axis);
        Self::polygon((0..RIM).map(|k| {
            let along = |k: usize| S::lit(EIGHTHS[k % RIM]);
            center + (x * along(k + 2) + y * along(k)) * radius
        }))
    }
    /// Returns the straight line on the side of a round shape, by its middle points and radii, that faces a direction.
    pub(super) fn side(ends: [(Vec3<S>, S); 2], axis: Vec3<S>, toward: Vec3<S>) -> Self {
        let aside = direction(axis.cross(toward).cross(axis));
        Self::polygon(
            ends.into_iter()
                .map(|(middle, radius)| middle + aside * radius),
        )
    }
}

/// Returns two directions across a normal, of length one; the derivatives are those of a turn with the normal.
pub(super) fn across<S: Scalar<Mask = bool>>(normal: Vec3<S>) -> [Vec3<S>; 2] {
    let [x, y, z] = [normal.x, normal.y, normal.z].map(|x| x.primal().magnitude());
    let (zero, one) = (S::zero(), S::one());
    let helper = match (x.at_most(y) & x.at_most(z), y.at_most(z)) {
        (true, _) => Vec3::new(one, zero, zero),
        (_, true) => Vec3::new(zero, one, zero),
        _ => Vec3::new(zero, zero, one),
    };
    let first = normal.cross(helper).normalize_or_zero();
    [first, normal.cross(first)]
}
