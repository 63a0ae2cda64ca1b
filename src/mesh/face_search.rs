//! The search for the face that is nearest to a point: candidates in single precision, the decision in double.
//!
//! In the frame of the tree the distance of a point from a face errs by some roundings of the point's own size: of the
//! query, of the corners, and of the arithmetic. Faces whose distance exceeds the least one by less than that error are
//! candidates, and [`nearest_feature`] decides among them.
use super::face_measure::{FaceRecord, nearest_feature};
use super::mesh_column::Mesh;
use super::mesh_tree::MeshTree;
use super::packet::{EightLanes, NO_CHILD, PACKET, Packet, TreeNode, part_of};
use crate::{Scalar, Vec3};

/// Roundings of single precision in a distance, relative to the size of the query and the mesh. The sum of all terms is
/// below twelve.
const ROUNDINGS: f32 = 24.0;
/// Queries beyond this size, in units of the mesh, have squares that single precision may not hold.
const FAR: f64 = 1e15;
/// The number of candidates from which on those beyond the limit are removed.
const MANY: usize = 64;

/// Buffers of a search.
#[derive(Debug, Default)]
pub struct SearchRoom {
    /// Nodes and packets yet to visit, with the squared distances of their bounds.
    pub(super) stack: Vec<(f32, u32)>,
    /// Faces that may be nearest, with their squared distances.
    pub(super) candidates: Vec<(f32, u32)>,
}

/// The least squared distance so far, and the limit up to which faces are candidates.
struct SearchLimit {
    least: f32,
    limit: f32,
    margin: f32,
}

impl SearchLimit {
    /// Returns `true` if the limit fell.
    #[inline(always)]
    fn lower(&mut self, least: f32) -> bool {
        let falls = least < self.least;
        if falls {
            self.least = least;
            let root = Scalar::root(least) + self.margin;
            self.limit = root * root * (1.0 + 8.0 * f32::EPSILON);
        }
        falls
    }
}

/// Returns the squared distances of a point from the bounds of a node's children.
#[inline(always)]
fn bound_squares<L: EightLanes>(node: &TreeNode, point: Vec3<L>, part: usize) -> L {
    let (low, high) = (
        part_of::<L>(&node.low, part),
        part_of::<L>(&node.high, part),
    );
    let zero = L::all(0.0);
    let (below, above) = (low - point, point - high);
    let x = below.x.most(above.x).most(zero);
    let y = below.y.most(above.y).most(zero);
    let z = below.z.most(above.z).most(zero);
    x * x + y * y + z * z
}

/// Returns the squared distances of the origin from edges, each a corner and the vector to the next one.
#[inline(always)]
fn edge_square<L: EightLanes>([start, edge]: [Vec3<L>; 2], [zero, one]: [L; 2]) -> L {
    // Not zero for an edge without length.
    let square = edge.length_squared().most(L::all(f32::MIN_POSITIVE));
    let t = (-start.dot(edge) / square).most(zero).least(one);
    (start + edge * t).length_squared()
}

/// Returns the squared distances of a point from eight triangles: from the interior where the point projects into it,
/// else from the nearest edge. Missing triangles are at NaN.
#[inline(always)]
fn triangle_squares<L: EightLanes>(packet: &Packet, point: Vec3<L>, part: usize) -> L {
    let [a, b, c] = &packet.corners;
    let a = part_of::<L>(a, part) - point;
    let b = part_of::<L>(b, part) - point;
    let c = part_of::<L>(c, part) - point;
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let (zero, one) = (L::all(0.0), L::all(1.0));
    let edges = [[a, ab], [b, bc], [c, ca]];
    let mut border = edge_square(edges[0], [zero, one]);
    for edge in &edges[1..] {
        border = border.least(edge_square(*edge, [zero, one]));
    }
    let n = ca.cross(ab);
    let mut inside = edges[0][1].cross(a).dot(n).below(zero);
    for [corner, edge] in &edges[1..] {
        inside = inside & edge.cross(*corner).dot(n).below(zero);
    }
    let height = n.dot(a);
    let flat = height * height / n.length_squared().most(L::all(f32::MIN_POSITIVE));
    // The smaller one, so that a triangle without area counts by its edges.
    L::select(inside, flat.least(border), border)
}

/// Collects the candidates for the nearest face to a point of the tree's frame, of squared distances up to a limit; the
/// limit is returned.
///
/// `start` is a squared distance that some face has, or infinity.
#[inline(always)]
pub(crate) fn collect<L: EightLanes>(
    tree: &MeshTree,
    [x, y, z]: [f32; 3],
    start: f32,
    room: &mut SearchRoom,
) -> f32 {
    let size = x.abs().max(y.abs()).max(z.abs());
    let mut limit = SearchLimit {
        least: f32::INFINITY,
        limit: f32::INFINITY,
        margin: ROUNDINGS * 0.5 * f32::EPSILON * (1.0 + size),
    };
    limit.lower(start);
    let point = Vec3::new(L::all(x), L::all(y), L::all(z));
    room.stack.clear();
    room.candidates.clear();
    room.stack.push((0.0, 0));
    let mut squares = [0.0; 8];
    while let Some((square, child)) = room.stack.pop() {
        if square > limit.limit {
            continue;
        }
        if child & PACKET != 0 {
            let (packet, faces) = tree.packet((child ^ PACKET) as usize);
            let mut near = 0;
            for part in 0..L::PARTS {
                let found = triangle_squares::<L>(packet, point, part);
                near |= L::truths(found.at_most(L::all(limit.limit))) << (part * (8 / L::PARTS));
                found.put(&mut squares, part);
            }
            while near != 0 {
                let lane = near.trailing_zeros() as usize;
                near &= near - 1;
                let found = squares[lane];
                if found <= limit.limit {
                    limit.lower(found);
                    room.candidates.push((found, faces[lane]));
                }
            }
            if room.candidates.len() > MANY {
                let most = limit.limit;
                room.candidates.retain(|found| found.0 <= most);
            }
            continue;
        }
        let node = &tree.nodes()[child as usize];
        let mut near = 0;
        for part in 0..L::PARTS {
            let found = bound_squares::<L>(node, point, part);
            near |= L::truths(found.at_most(L::all(limit.limit))) << (part * (8 / L::PARTS));
            found.put(&mut squares, part);
        }
        push_nearest_last(node, near, &squares, &mut room.stack);
    }
    limit.limit
}

/// Pushes some children of a node, the nearest one last.
#[inline(always)]
pub(super) fn push_nearest_last(
    node: &TreeNode,
    mut near: u32,
    keys: &[f32; 8],
    stack: &mut Vec<(f32, u32)>,
) {
    let start = stack.len();
    while near != 0 {
        let lane = near.trailing_zeros() as usize;
        near &= near - 1;
        if node.children[lane] == NO_CHILD {
            continue;
        }
        let item = (keys[lane], node.children[lane]);
        let mut at = stack.len();
        stack.push(item);
        while at > start && stack[at - 1].0 < item.0 {
            stack[at] = stack[at - 1];
            at -= 1;
        }
        stack[at] = item;
    }
}

/// Returns the nearest of some faces, and its squared distance: at equal distances the one of lowest index.
pub(crate) fn decide<S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    point: Vec3<f64>,
    faces: impl Iterator<Item = u32>,
) -> Option<(f64, FaceRecord)> {
    let mut best: Option<(f64, FaceRecord)> = None;
    for face in faces {
        let (square, feature) = nearest_feature(point, mesh.plain_triangle(face));
        let is_better = best
            .is_none_or(|(least, record)| square < least || square == least && face < record.face);
        if is_better {
            best = Some((square, FaceRecord { face, feature }));
        }
    }
    best
}

/// Returns the face and the feature that are nearest to a point, among equal ones that of lowest index; `None` for a
/// point that is not finite. `known` is a face that may be near, such as that of a neighbouring query.
#[inline(always)]
pub(crate) fn nearest<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    point: Vec3<f64>,
    known: Option<u32>,
    room: &mut SearchRoom,
) -> Option<FaceRecord> {
    if !point.is_finite() {
        return None;
    }
    let local = tree.frame().local(point);
    let size = local.x.abs().max(local.y.abs()).max(local.z.abs());
    if size > FAR {
        let faces = 0..mesh.faces().len() as u32;
        return decide(mesh, point, faces).map(|found| found.1);
    }
    let start = known.map_or(f32::INFINITY, |face| {
        let (square, _) = nearest_feature(point, mesh.plain_triangle(face));
        let scale = tree.frame().scale;
        (square * scale * scale) as f32
    });
    let place = [local.x as f32, local.y as f32, local.z as f32];
    let limit = collect::<L>(tree, place, start, room);
    let near = room.candidates.iter().filter(|found| found.0 <= limit);
    decide(mesh, point, near.map(|found| found.1)).map(|found| found.1)
}
