//! The kernels of searches in meshes, one query after another in a given order.
//!
//! A closest point of the query before is a hint. It changes no record: see [`mesh`](crate::mesh).
use crate::kernels::cpu::arch::Eights;
use crate::mesh::{self, FaceRecord, MeshSurface, MeshTree, SearchRoom, SolidBounds, Wanted};
use crate::mesh::{closest_replay, first, nearest, plain, plain_ray};
use crate::{Pose3, Ray3, Real, Triangle3, Vec3};

/// The number of queries that are read at once: their places in memory are far from each other.
const AHEAD: usize = 16;

/// Appends the nearest faces of some points. They must be finite.
#[inline(always)]
pub(super) fn nearest_faces<T: Real, V: Eights>(
    surface: &MeshSurface<'_, T>,
    points: &[Vec3<T>],
    order: &[u32],
    found: &mut Vec<FaceRecord>,
) {
    let (mesh, tree) = (surface.mesh(), surface.tree());
    let mut room = SearchRoom::default();
    let mut known = None;
    for order in order.chunks(AHEAD) {
        let mut ahead = [Vec3::zero(); AHEAD];
        for (point, &i) in ahead.iter_mut().zip(order) {
            *point = plain(points[i as usize]);
        }
        for &point in ahead.iter().take(order.len()) {
            let record = nearest::<V::Eight, T>(mesh, tree, point, known, &mut room);
            let record = record.unwrap_or(FaceRecord::NONE);
            let [a, b, c] = mesh.plain_triangle(record.face);
            known = Some(closest_replay(point, Triangle3 { a, b, c }, record.feature));
            found.push(record);
        }
    }
}

/// Appends the first faces that some rays meet.
#[inline(always)]
pub(super) fn first_faces<T: Real, V: Eights>(
    surface: &MeshSurface<'_, T>,
    rays: &[Ray3<T>],
    order: &[u32],
    found: &mut Vec<Option<u32>>,
) {
    let (mesh, tree) = (surface.mesh(), surface.tree());
    let mut room = SearchRoom::default();
    let none = Ray3::new(Vec3::zero(), Vec3::zero());
    for order in order.chunks(AHEAD) {
        let mut ahead = [none; AHEAD];
        for (ray, &i) in ahead.iter_mut().zip(order) {
            *ray = plain_ray(rays[i as usize]);
        }
        for &ray in ahead.iter().take(order.len()) {
            found.push(first::<V::Eight, T>(mesh, tree, ray, &mut room));
        }
    }
}

/// Visits the faces that may be near a solid. Kernels of a table are of a format, which this one does not read.
#[inline(always)]
#[expect(
    clippy::extra_unused_type_parameters,
    reason = "a table has a kernel for every format"
)]
pub(super) fn visit_faces<T: Real, V: Eights>(
    tree: &MeshTree,
    bounds: &SolidBounds,
    start: f64,
    room: &mut SearchRoom,
    visit: &mut dyn FnMut(u32) -> Wanted,
) {
    mesh::visit_faces::<V::Eight>(tree, bounds, start, room, visit);
}

/// Visits the faces of two meshes that may be near each other, in a kernel of any format.
#[inline(always)]
#[expect(
    clippy::extra_unused_type_parameters,
    reason = "a table has a kernel for every format"
)]
pub(super) fn visit_pairs<T: Real, V: Eights>(
    trees: [&MeshTree; 2],
    pose: &Pose3<f64>,
    start: f64,
    visit: &mut dyn FnMut(u32, u32) -> Wanted,
) {
    mesh::visit_pairs::<V::Eight>(trees, pose, start, visit);
}
