//! Faces of shapes of space that face another shape.
use super::core::Core3;
use super::relation::direction;
use super::spot::plain;
use crate::arrays::Each;
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

/// The face of a shape that faces another one, as a search names it.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PatchName {
    /// No more than the nearest point.
    Spot,
    /// A face by its corners, in order. The first `count` matter.
    Corners { corners: [u8; SIDES], count: u8 },
    /// A flat round end, by its number, and that of the axis across which its corners begin.
    Rim { end: u8, helper: u8 },
    /// The straight line on a round side.
    Side,
    /// The plane of a half-space.
    Plane,
}

impl PatchName {
    /// Returns a face by its corners, in order, of which the first sixteen count.
    pub(super) fn corners(all: impl IntoIterator<Item = usize>) -> Self {
        let (mut corners, mut count) = ([0; SIDES], 0);
        for (place, corner) in corners.iter_mut().zip(all) {
            *place = corner as u8;
            count += 1;
        }
        PatchName::Corners { corners, count }
    }
    /// Returns a flat round end, by its number and a direction along the axis.
    pub(super) fn rim<S: Scalar<Mask = bool>>(end: u8, axis: Vec3<S>) -> Self {
        let helper = helper(axis);
        PatchName::Rim { end, helper }
    }
    /// Returns the name as numbers of eight bits, for traces.
    pub(super) fn numbers(self) -> [u32; SIDES + 1] {
        let mut numbers = [0; SIDES + 1];
        let kind = match self {
            PatchName::Spot => 0,
            PatchName::Corners { corners, count } => {
                for (place, corner) in numbers[1..].iter_mut().zip(corners) {
                    *place = corner.into();
                }
                1 + u32::from(count)
            }
            PatchName::Rim { end, helper } => 64 + u32::from(end) + 2 * u32::from(helper),
            PatchName::Side => 128,
            PatchName::Plane => 129,
        };
        numbers[0] = kind;
        numbers
    }
}

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

/// Returns the face of a core that faces a direction. A segment that is nearer to the direction than to its plane has no
/// more than its end.
pub(super) fn face_of_core<S: Scalar<Mask = bool>, C: Core3<S>>(
    core: &C,
    toward: Vec3<S>,
) -> PatchName {
    if let &[start, end] = core.corners().as_ref() {
        let way = end - start;
        let rise = toward.dot(way).unsigned();
        if (rise + rise).above(way.length()) {
            return PatchName::Spot;
        }
    }
    let (chosen, count) = core.facing(toward);
    PatchName::corners(chosen[..count].iter().copied())
}

impl<S: Scalar> Patch<S> {
    /// Returns a face by the names of corners, each at a place.
    pub(super) fn named(name: PatchName, at: impl Fn(usize) -> Vec3<S>) -> Self {
        match name {
            PatchName::Plane => Patch::Plane,
            PatchName::Corners { corners, count } => {
                let named = &corners[..usize::from(count)];
                Self::polygon(named.iter().map(|&k| at(usize::from(k))))
            }
            _ => Patch::Spot,
        }
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
    /// Returns the face of a flat round end, by its centre, a direction along the axis, the number of the axis across
    /// which its corners begin, and the radius.
    pub(super) fn rim(center: Vec3<S>, axis: Vec3<S>, helper: u8, radius: S) -> Self {
        let [x, y] = across(axis, helper);
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
    /// Returns the face without derivatives.
    pub(super) fn plain(&self) -> Patch<S::Primal> {
        match self {
            Patch::Spot => Patch::Spot,
            Patch::Plane => Patch::Plane,
            Patch::Face { corners, count } => Patch::Face {
                corners: corners.each_as(plain),
                count: *count,
            },
        }
    }
}

/// Returns the number of the coordinate axis that is the farthest from a normal, nearly.
pub(super) fn helper<S: Scalar<Mask = bool>>(normal: Vec3<S>) -> u8 {
    let [x, y, z] = [normal.x, normal.y, normal.z].map(|x| x.primal().magnitude());
    match (x.at_most(y) & x.at_most(z), y.at_most(z)) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    }
}

/// Returns two directions across a normal, of length one, the first across one of the coordinate axes; the derivatives
/// are those of a turn with the normal.
pub(super) fn across<S: Scalar>(normal: Vec3<S>, helper: u8) -> [Vec3<S>; 2] {
    let one = |k: u8| if k == helper { S::one() } else { S::zero() };
    let first = normal
        .cross(Vec3::new(one(0), one(1), one(2)))
        .normalize_or_zero();
    [first, normal.cross(first)]
}
