//! The search for faces that a ray meets: candidates in single precision, the decision by exact signs.
//!
//! Seen along the ray, corners are points of a plane, each off by some roundings of the mesh's size. A face is a
//! candidate if the ray may be inside of it by these errors. [`first_hit_triangle`] decides among them, whose signs are
//! exact, so that no ray passes between two faces.
use super::face_search::SearchRoom;
use super::mesh_column::Mesh;
use super::mesh_tree::MeshTree;
use super::packet::{EightLanes, EightNumbers, PACKET, Packet, TreeNode};
use crate::intersection3::first_hit_triangle;
use crate::{Ray3, Scalar, Triangle3, Vec3};

/// The error of a corner seen along the ray, in units of the mesh: the sum of all roundings is below sixteen, of numbers
/// below four.
const ERROR: f32 = 32.0 * f32::EPSILON;
/// Starts beyond this size, in units of the mesh, lose the digits of the point at which the ray comes near.
const FAR: f64 = 1e6;
/// Components of the direction below this part of the largest one move the ray by less than the error.
const STEEP: f64 = 1e-20;

/// A ray in the frame of a tree, from a point near the mesh, by its dominant axis.
#[derive(Clone, Copy)]
pub(crate) struct TreeRay {
    start: [f32; 3],
    /// Reciprocals of the direction, whose largest component is ±1.
    inverse: [f32; 3],
    /// The steps from the start to the origin along each axis, less its error where the ray enters bounds, with it where
    /// the ray leaves them.
    first: [f32; 3],
    last: [f32; 3],
    /// One where the ray goes down an axis, so that it meets the upper bounds first; else zero.
    down: [usize; 3],
    /// The dominant axis and the others.
    axes: [usize; 3],
    /// The drifts along the others by a step along the dominant axis, and the sign of that step.
    drift: [f32; 2],
    ahead: f32,
}

impl TreeRay {
    /// Returns a ray in a tree's frame: the ray's parameter times a factor is the step from some start.
    fn new(tree: &MeshTree, ray: Ray3<f64>) -> Option<Self> {
        let start = tree.frame().local(ray.point);
        let way = [ray.direction.x, ray.direction.y, ray.direction.z];
        let mut start = [start.x, start.y, start.z];
        let mut main = usize::from(way[1].abs() > way[0].abs());
        if way[2].abs() > way[main].abs() {
            main = 2;
        }
        let way = way.map(|x| x / way[main].abs());
        let inverse = way.map(|x| 1.0 / (x.abs().max(STEEP).copysign(x)));
        // Forward to the box in which all corners are, with room.
        let enter = (0..3).fold(0.0, |most: f64, k| {
            let to = (-way[k].signum() * 1.01 - start[k]) * inverse[k];
            if to > most { to } else { most }
        });
        for k in 0..3 {
            start[k] += way[k] * enter;
        }
        let axes = [main, (main + 1) % 3, (main + 2) % 3];
        let ahead = way[main].signum();
        let drift = [way[axes[1]], way[axes[2]]].map(|x| (x * ahead) as f32);
        let inverse = inverse.map(|x| x as f32);
        let near = start.iter().all(|x| x.abs() < 1.1);
        let start = start.map(|x| x as f32);
        let step = |k: usize, by: f32| -(start[k] + by * inverse[k].signum()) * inverse[k];
        near.then_some(TreeRay {
            start,
            inverse,
            first: [0, 1, 2].map(|k| step(k, ERROR)),
            last: [0, 1, 2].map(|k| step(k, -ERROR)),
            down: inverse.map(|x| usize::from(x < 0.0)),
            axes,
            drift,
            ahead: ahead as f32,
        })
    }
}

/// Returns the steps at which the ray enters the bounds of a node's children, and the truths that it meets them.
#[inline(always)]
fn entries<L: EightLanes>(node: &TreeNode, ray: &TreeRay, part: usize) -> (L, L::Mask) {
    let (mut near, mut far) = (L::all(0.0), L::all(f32::INFINITY));
    // Products and sums err by some roundings of a place times the reciprocal: a small part of the error of starts.
    for k in 0..3 {
        let [first, last] = [ray.down[k], 1 - ray.down[k]];
        let planes = [&node.low[k], &node.high[k]];
        let inverse = L::all(ray.inverse[k]);
        near = near.most(L::part(planes[first & 1], part) * inverse + L::all(ray.first[k]));
        far = far.least(L::part(planes[last & 1], part) * inverse + L::all(ray.last[k]));
    }
    let widened = far * L::all(1.0 + 8.0 * f32::EPSILON);
    (near, near.at_most(widened))
}

/// What a packet's triangles are to a ray, in parts of eight lanes.
struct PacketSight {
    /// Bits of triangles that the ray may meet, and of those that it meets in any case.
    maybe: u32,
    sure: u32,
    /// The least and the largest step at which it can meet them.
    first: EightNumbers,
    last: EightNumbers,
}

/// Returns corners seen along the ray: beside it, and the steps to them.
#[inline(always)]
fn seen<L: EightLanes>(corner: &[EightNumbers; 3], ray: &TreeRay, part: usize) -> Vec3<L> {
    let [main, second, third] = ray.axes;
    let along = L::part(&corner[main], part) - L::all(ray.start[main]);
    let x = L::part(&corner[second], part) - L::all(ray.start[second]);
    let y = L::part(&corner[third], part) - L::all(ray.start[third]);
    Vec3::new(
        x - along * L::all(ray.drift[0]),
        y - along * L::all(ray.drift[1]),
        along * L::all(ray.ahead),
    )
}

/// Returns the side of an edge on which the ray passes, times its length, and the error of that: of a coordinate, times
/// the sizes of the others.
#[inline(always)]
fn side<L: EightLanes>(p: Vec3<L>, q: Vec3<L>, error: L) -> (L, L) {
    let sizes = p.x.magnitude() + p.y.magnitude() + q.x.magnitude() + q.y.magnitude();
    (p.x * q.y - p.y * q.x, (sizes + error + error) * error)
}

#[inline(always)]
fn sight<L: EightLanes>(packet: &Packet, ray: &TreeRay) -> PacketSight {
    let mut all = PacketSight {
        maybe: 0,
        sure: 0,
        first: [0.0; 8],
        last: [0.0; 8],
    };
    let (zero, error) = (L::all(0.0), L::all(ERROR));
    for part in 0..L::PARTS {
        let [a, b, c] = &packet.corners;
        let (a, b, c) = (seen(a, ray, part), seen(b, ray, part), seen(c, ray, part));
        let ((u, du), (v, dv), (w, dw)) = (side(b, c, error), side(c, a, error), side(a, b, error));
        let maybe = (u.at_least(-du) & v.at_least(-dv) & w.at_least(-dw))
            | (u.at_most(du) & v.at_most(dv) & w.at_most(dw));
        let sure = (u.above(du) & v.above(dv) & w.above(dw))
            | (u.below(-du) & v.below(-dv) & w.below(-dw));
        let first = a.z.least(b.z).least(c.z) - error;
        let last = a.z.most(b.z).most(c.z) + error;
        let shift = part * (8 / L::PARTS);
        all.maybe |= L::truths(maybe & last.at_least(zero)) << shift;
        all.sure |= L::truths(sure & first.at_least(error + error)) << shift;
        first.put(&mut all.first, part);
        last.put(&mut all.last, part);
    }
    all
}

/// Collects the faces that a ray may meet: all of them, or those that may be first. Returns the step up to which they
/// can be first.
#[inline(always)]
fn collect<L: EightLanes>(tree: &MeshTree, ray: &TreeRay, all: bool, room: &mut SearchRoom) -> f32 {
    let mut limit = f32::INFINITY;
    room.stack.start();
    room.candidates.clear();
    let mut steps = [0.0; 8];
    while let Some((step, child)) = room.stack.pop() {
        if step > limit {
            continue;
        }
        if child & PACKET != 0 {
            let (packet, faces) = tree.packet((child ^ PACKET) as usize);
            let mut found = sight::<L>(packet, ray);
            while found.sure != 0 && !all {
                let lane = found.sure.trailing_zeros() as usize;
                found.sure &= found.sure - 1;
                limit = if found.last[lane & 7] < limit {
                    found.last[lane & 7]
                } else {
                    limit
                };
            }
            while found.maybe != 0 {
                let lane = found.maybe.trailing_zeros() as usize;
                found.maybe &= found.maybe - 1;
                if found.first[lane & 7] <= limit {
                    room.candidates
                        .push((found.first[lane & 7], faces[lane & 7]));
                }
            }
            continue;
        }
        let node = &tree.nodes()[child as usize];
        let mut near = 0;
        for part in 0..L::PARTS {
            let (entry, meets) = entries::<L>(node, ray, part);
            let reached = meets & entry.at_most(L::all(limit));
            near |= L::truths(reached) << (part * (8 / L::PARTS));
            entry.put(&mut steps, part);
        }
        room.stack.push_nearest_last(node, near, &steps);
    }
    limit
}

/// Fills the room with the faces that a ray may meet, and returns the step up to which they can be first.
#[inline(always)]
pub(crate) fn candidates<L: EightLanes>(
    faces: usize,
    tree: &MeshTree,
    ray: Ray3<f64>,
    all: bool,
    room: &mut SearchRoom,
) -> f32 {
    room.candidates.clear();
    let way = ray.direction;
    let is_valid = ray.point.is_finite() && way.is_finite() && way.length_squared() > 0.0;
    if !is_valid && way.length() <= 0.0 {
        return 0.0;
    }
    let start = tree.frame().local(ray.point);
    if !is_valid || start.x.abs().max(start.y.abs()).max(start.z.abs()) > FAR {
        room.candidates
            .extend((0..faces as u32).map(|face| (0.0, face)));
        return f32::INFINITY;
    }
    // No closure: it would not be compiled for the vectors of its caller.
    match TreeRay::new(tree, ray) {
        Some(ray) => collect::<L>(tree, &ray, all, room),
        None => 0.0,
    }
}

/// Returns the parameter at which a ray meets a face, by exact signs.
#[inline]
pub(crate) fn meeting<S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    ray: Ray3<f64>,
    face: u32,
) -> Option<f64> {
    let [a, b, c] = mesh.plain_triangle(face);
    let hit = first_hit_triangle(ray, Triangle3::new(a, b, c));
    (hit.kind > 0.0).then_some(hit.parameter)
}

/// Returns the face that a ray meets first, among equal ones that of lowest index.
#[inline(always)]
pub(crate) fn first<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    ray: Ray3<f64>,
    room: &mut SearchRoom,
) -> Option<u32> {
    let limit = candidates::<L>(mesh.faces().len(), tree, ray, false, room);
    let mut best: Option<(f64, u32)> = None;
    for &(step, face) in &room.candidates {
        if step > limit {
            continue;
        }
        let Some(parameter) = meeting(mesh, ray, face) else {
            continue;
        };
        let is_better = match best {
            Some((least, other)) => parameter < least || parameter == least && face < other,
            None => true,
        };
        if is_better {
            best = Some((parameter, face));
        }
    }
    Some(best?.1)
}

/// Returns a ray as plain numbers, exactly.
#[inline]
pub(crate) fn plain_ray<S: Scalar<Mask = bool>>(ray: Ray3<S>) -> Ray3<f64> {
    use super::mesh_column::plain;
    Ray3 {
        point: plain(ray.point),
        direction: plain(ray.direction),
    }
}

/// Returns a ray along an axis.
pub(crate) fn ray_along_x(point: Vec3<f64>) -> Ray3<f64> {
    Ray3::new(point, Vec3::new(1.0, 0.0, 0.0))
}
