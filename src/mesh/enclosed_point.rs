//! Points inside a mesh, by the crossings of a ray: exact on the given numbers.
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
    /// It leaves through the face: the normal has a positive x.
    Outward,
    /// It enters through the face.
    Inward,
    /// It starts on the face.
    Touching,
}

/// Returns the corners and the point without one of their coordinates.
fn without(axis: usize, corners: [Vec3<f64>; 3], point: Vec3<f64>) -> [Vec2<f64>; 4] {
    let [a, b, c] = corners;
    [a, b, c, point].map(|v| match axis {
        0 => Vec2::new(v.y, v.z),
        1 => Vec2::new(v.z, v.x),
        _ => Vec2::new(v.x, v.y),
    })
}

/// Returns `true` for a point of a face's plane that is on the face; `false` for a face without area.
fn is_over(point: Vec3<f64>, corners: [Vec3<f64>; 3]) -> bool {
    for axis in 0..3 {
        let [a, b, c, at] = without(axis, corners, point);
        let facing = turn(a, b, c);
        if facing != Turn::Straight {
            let away = facing.mirrored();
            return [(a, b), (b, c), (c, a)]
                .iter()
                .all(|&(p, q)| turn(p, q, at) != away);
        }
    }
    false
}

/// Returns how the ray along x from a point crosses a face. Edges seen by the ray belong to the face above them, so that
/// it crosses one of two faces with a common edge: the ray stands for one moved up by less than any number, first along
/// y, then along z.
fn crossing(point: Vec3<f64>, corners: [Vec3<f64>; 3]) -> Crossing {
    let [a, b, c, p] =
        [corners[0], corners[1], corners[2], point].map(|Vec3 { x, y, z }| Coord3D { x, y, z });
    let side = orient3d(a, b, c, p);
    if side == 0.0 && is_over(point, corners) {
        return Crossing::Touching;
    }
    let [a, b, c, at] = without(0, corners, point);
    let mut parity = false;
    for (p, q) in [(a, b), (b, c), (c, a)] {
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
    // Positive below the plane, as seen from where corners run counter-clockwise; a face that looks counter-clockwise
    // from larger x is crossed by rays from below. Seen along x, the face is no segment: the parity is of an area.
    match turn(a, b, c) {
        Turn::Left if side > 0.0 => Crossing::Outward,
        Turn::Right if side < 0.0 => Crossing::Inward,
        _ => Crossing::None,
    }
}

/// Returns how often a ray along x leaves through a face and how often it enters; `None` if it starts on one.
pub(crate) fn crossings<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    point: Vec3<f64>,
    room: &mut SearchRoom,
) -> Option<[u32; 2]> {
    candidates::<L>(mesh.faces().len(), tree, ray_along_x(point), true, room);
    let mut counts = [0, 0];
    for &(_, face) in &room.candidates {
        match crossing(point, mesh.plain_triangle(face)) {
            Crossing::None => {}
            Crossing::Outward => counts[0] += 1,
            Crossing::Inward => counts[1] += 1,
            Crossing::Touching => return None,
        }
    }
    Some(counts)
}

/// Returns `true` for a point that a ray along x leaves through an odd number of faces, or that is on one of them.
pub(crate) fn encloses<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    point: Vec3<f64>,
    room: &mut SearchRoom,
) -> bool {
    if !point.is_finite() {
        return false;
    }
    let counts = crossings::<L, S>(mesh, tree, point, room);
    counts.is_none_or(|[leaves, enters]| (leaves + enters) % 2 == 1)
}
