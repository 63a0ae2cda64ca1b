//! The polygon in which a plane cuts a body.
use super::cutting_planes::Other;
use super::volume_replay::{planes_of, points_of};
use super::volume_search::Decisions;
use crate::{Scalar, Vec3};

/// Returns the area in which a plane cuts a body, from decisions; the mean of both sides where a face is in the plane.
pub(super) fn area<S: Scalar>(corners: &[Vec3<S>], plane: Other<'_, S>, found: &Decisions) -> S {
    let Other::HalfSpace(normal, _) = plane else {
        return S::zero();
    };
    let points = points_of(found, corners, &planes_of(found, plane));
    let mut twice = Vec3::zero();
    for ring in rings(found) {
        let from = points[ring[0]];
        for pair in ring[1..].windows(2) {
            twice += (points[pair[0]] - from).cross(points[pair[1]] - from);
        }
    }
    let share = if found.twice { 0.25 } else { 0.5 };
    let area = twice.dot(normal.normalize_or_zero()) * S::lit(share);
    // Beside a corner the area is of the size of its roundings, and they may have the other sign.
    S::select(area.below(S::zero()), S::zero(), area)
}

/// Returns the corners of the polygon in which a plane cuts a body, counter-clockwise seen from outside the half-space.
pub(super) fn polygon<S: Scalar>(
    corners: &[Vec3<S>],
    plane: Other<'_, S>,
    found: &Decisions,
) -> Vec<Vec3<S>> {
    let points = points_of(found, corners, &planes_of(found, plane));
    let ring = rings(found).next();
    ring.map_or(Vec::new(), |ring| ring.iter().map(|&k| points[k]).collect())
}

/// Returns the faces in the plane.
fn rings(found: &Decisions) -> impl Iterator<Item = &[usize]> {
    let in_plane = found.pieces.iter().filter(|piece| piece.on.is_none());
    in_plane.map(|piece| &piece.ring[..])
}
