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
    ///
    /// Loops in place of closures, which would not be compiled for the vectors of the caller.
    #[inline(always)]
    fn new(start: Vec3<f64>, direction: Vec3<f64>) -> Option<Self> {
        let mut way = [direction.x, direction.y, direction.z];
        let start = [start.x, start.y, start.z];
        let mut main = usize::from(way[1].abs() > way[0].abs());
        if way[2].abs() > way[main].abs() {
            main = 2;
        }
        let length = way[main].abs();
        let mut inverse = [0.0; 3];
        // Forward to the box in which all corners are, with room.
        let mut enter = 0.0;
        for k in 0..3 {
            way[k] /= length;
            inverse[k] = 1.0 / (way[k].abs().max(STEEP).copysign(way[k]));
            let to = (-1.01_f64.copysign(way[k]) - start[k]) * inverse[k];
            enter = if to > enter { to } else { enter };
        }
        let [second, third] = [[1, 2], [2, 0], [0, 1]][main];
        let ahead = 1.0_f64.copysign(way[main]);
        let mut ray = TreeRay {
            start: [0.0; 3],
            inverse: [0.0; 3],
            first: [0.0; 3],
            last: [0.0; 3],
            down: [0; 3],
            axes: [main, second, third],
            drift: [(way[second] * ahead) as f32, (way[third] * ahead) as f32],
            ahead: ahead as f32,
        };
        let mut is_near = true;
        for k in 0..3 {
            let entry = start[k] + way[k] * enter;
            is_near &= entry.abs() < 1.1;
            let (start, inverse) = (entry as f32, inverse[k] as f32);
            let error = ERROR.copysign(inverse);
            ray.start[k] = start;
            ray.inverse[k] = inverse;
            ray.first[k] = -(start + error) * inverse;
            ray.last[k] = -(start - error) * inverse;
            ray.down[k] = usize::from(inverse < 0.0);
        }
        is_near.then_some(ray)
    }
}

/// Returns the steps at which the ray enters the bounds of a node's children, and the truths that it meets them.
#[inline(always)]
fn entries<L: EightLanes>(node: &TreeNode, ray: &TreeRay, part: usize) -> (L, L::Mask) {
    let (mut near, mut far) = (L::all(0.0), L::all(f32::INFINITY));
    // Products and sums err by some roundings of a place times the reciprocal: a small part of the error of starts.
    for k in 0..3 {
        let (first, last) = (ray.down[k] & 1, ray.down[k] & 1 ^ 1);
        let inverse = L::all(ray.inverse[k]);
        near = near.most(L::part(&node.bounds[first][k], part) * inverse + L::all(ray.first[k]));
        far = far.least(L::part(&node.bounds[last][k], part) * inverse + L::all(ray.last[k]));
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
        let left = u.above(du) & v.above(dv) & w.above(dw);
        let right = u.below(-du) & v.below(-dv) & w.below(-dw);
        let first = a.z.least(b.z).least(c.z) - error;
        let last = a.z.most(b.z).most(c.z) + error;
        // The step to the plane times the sum of the sides, and its error: of sides times steps, and of steps times sides.
        let step = u * a.z + v * b.z + w * c.z;
        let sides = u.magnitude() + v.magnitude() + w.magnitude();
        let steps = last.most(-first);
        let slack = (du + dv + dw) * steps + sides * (error + error);
        let (up, down) = (step.above(slack), step.below(-slack));
        let behind = (left & down) | (right & up);
        let shift = part * (8 / L::PARTS);
        all.maybe |= L::truths(maybe & last.at_least(zero) & !behind) << shift;
        all.sure |= L::truths((left & up) | (right & down)) << shift;
        first.put(&mut all.first, part);
        last.put(&mut all.last, part);
    }
    all
}

/// Collects the faces that a ray may meet: all of them, or those that may be first. Returns the step up to which they
/// can be first, and the face whose last step that is.
#[inline(always)]
fn collect<L: EightLanes>(
    tree: &MeshTree,
    ray: &TreeRay,
    all: bool,
    room: &mut SearchRoom,
) -> (f32, Option<u32>) {
    let (mut limit, mut met) = (f32::INFINITY, None);
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
                if found.last[lane & 7] < limit {
                    (limit, met) = (found.last[lane & 7], Some(faces[lane & 7]));
                }
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
    (limit, met)
}

/// Fills the room with the faces that a ray may meet. Returns the step up to which they can be first, and the face that
/// is met by then.
#[inline(always)]
pub(crate) fn candidates<L: EightLanes>(
    faces: usize,
    tree: &MeshTree,
    ray: Ray3<f64>,
    all: bool,
    room: &mut SearchRoom,
) -> (f32, Option<u32>) {
    room.candidates.clear();
    let way = ray.direction;
    let is_valid = ray.point.is_finite() && way.is_finite() && way.length_squared() > 0.0;
    if !is_valid && way.length() <= 0.0 {
        return (0.0, None);
    }
    let start = tree.frame().local(ray.point);
    if !is_valid || start.x.abs().max(start.y.abs()).max(start.z.abs()) > FAR {
        room.candidates
            .extend((0..faces as u32).map(|face| (0.0, face)));
        return (f32::INFINITY, None);
    }
    // No closure: it would not be compiled for the vectors of its caller.
    match TreeRay::new(start, way) {
        Some(ray) => collect::<L>(tree, &ray, all, room),
        None => (0.0, None),
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
    let (limit, met) = candidates::<L>(mesh.faces().len(), tree, ray, false, room);
    // A face that is met in any case is first where no other one can be.
    let is_other = |&(step, face): &(f32, u32)| step <= limit && Some(face) != met;
    if met.is_some() && !room.candidates.iter().any(is_other) {
        return met;
    }
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
