//! Points inside a mesh, by the parity of crossings: exact on the given numbers.
use super::face_search::SearchRoom;
use super::mesh_column::Mesh;
use super::mesh_tree::MeshTree;
use super::packet::EightLanes;
use super::ray_search::{candidates, ray_along_x};
use crate::predicate::{Turn, turn};
use crate::{Scalar, Vec2, Vec3};
use robust::{Coord3D, orient3d};

/// The way of a ray along x through a face.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Crossing {
    /// It does not meet the face.
    None,
    /// It crosses the face.
    Through,
    /// It starts on the face.
    Touching,
}

/// Returns how the ray along x from a point crosses a face. Edges seen by the ray belong to the face above them, so that
/// it crosses one of two faces with a common edge.
fn crossing(point: Vec3<f64>, corners: [Vec3<f64>; 3]) -> Crossing {
    let seen = corners.map(|v| Vec2::new(v.y, v.z));
    let at = Vec2::new(point.y, point.z);
    let mut parity = false;
    for k in 0..3 {
        let (p, q) = (seen[k], seen[(k + 1) % 3]);
        if (p.y <= at.y) == (q.y <= at.y) {
            continue;
        }
        // Upward, so that both faces of an edge decide alike.
        let (low, high) = if p.y < q.y { (p, q) } else { (q, p) };
        // The horizontal line to larger x of the plane crosses the edge if the point is left of it.
        parity ^= turn(low, high, at) == Turn::Left;
    }
    if !parity {
        return Crossing::None;
    }
    // Seen along x, the face does not look like a segment: the parity is of an area.
    let [a, b, c, p] =
        [corners[0], corners[1], corners[2], point].map(|Vec3 { x, y, z }| Coord3D { x, y, z });
    let side = orient3d(a, b, c, p);
    let facing = turn(seen[0], seen[1], seen[2]);
    if side == 0.0 {
        return Crossing::Touching;
    }
    // Positive below the plane, as seen from where corners run counter-clockwise; a face that looks counter-clockwise
    // from larger x is crossed by rays from below.
    let is_ahead = match facing {
        Turn::Left => side > 0.0,
        Turn::Right => side < 0.0,
        Turn::Straight => return Crossing::None,
    };
    if is_ahead {
        Crossing::Through
    } else {
        Crossing::None
    }
}

/// Returns `true` for a point that a ray along x leaves through an odd number of faces, or that starts on one of them.
pub(crate) fn encloses<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    point: Vec3<f64>,
    room: &mut SearchRoom,
) -> bool {
    if !point.is_finite() {
        return false;
    }
    candidates::<L>(mesh.faces().len(), tree, ray_along_x(point), true, room);
    let mut parity = false;
    for &(_, face) in &room.candidates {
        match crossing(point, mesh.plain_triangle(face)) {
            Crossing::None => {}
            Crossing::Through => parity = !parity,
            Crossing::Touching => return true,
        }
    }
    parity
}
