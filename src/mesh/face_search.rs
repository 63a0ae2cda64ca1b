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
pub(crate) const FAR: f64 = 1e15;
/// The number of candidates from which on those beyond the limit are removed.
const MANY: usize = 64;

/// Buffers of a search.
#[derive(Debug, Default)]
pub struct SearchRoom {
    /// Nodes and packets yet to visit.
    pub(crate) stack: SearchStack,
    /// Faces that may be nearest, with their squared distances.
    pub(crate) candidates: Vec<(f32, u32)>,
}

/// Nodes and packets yet to visit, each with the key of its bounds, in one number: numbers that are not negative sort
/// like their bits.
#[derive(Debug, Default)]
pub(crate) struct SearchStack {
    items: Vec<u64>,
    top: usize,
}

impl SearchStack {
    /// Leaves the root alone.
    #[inline(always)]
    pub(crate) fn start(&mut self) {
        self.top = 0;
        self.room()[0] = 0;
        self.top = 1;
    }
    /// Returns the last item: a key and a child.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<(f32, u32)> {
        self.top = self.top.checked_sub(1)?;
        let item = self.items[self.top];
        Some((f32::from_bits((item >> 32) as u32), item as u32))
    }
    /// Takes the item whose child has the lowest number by some order: a key and the child.
    #[inline(always)]
    pub(crate) fn pop_lowest(&mut self, order: impl Fn(u32) -> u32) -> Option<(f32, u32)> {
        let last = self.top.checked_sub(1)?;
        let (mut best, mut least) = (last, u32::MAX);
        for (at, &item) in self.items[..=last].iter().enumerate() {
            let own = order(item as u32);
            if own < least {
                (best, least) = (at, own);
            }
        }
        self.items.swap(best, last);
        self.pop()
    }
    /// Returns room for eight items.
    #[inline(always)]
    fn room(&mut self) -> &mut [u64; 8] {
        if self.items.len() < self.top + 8 {
            self.grow();
        }
        let room = self.items[self.top..].first_chunk_mut();
        room.expect("the stack has grown")
    }
    #[cold]
    #[inline(never)]
    fn grow(&mut self) {
        self.items.resize(2 * self.top + 64, 0);
    }
    /// Pushes some children of a node, the nearest one last.
    #[inline(always)]
    pub(crate) fn push_nearest_last(&mut self, node: &TreeNode, near: u32, keys: &[f32; 8]) {
        let room = self.room();
        let (mut near, mut count) = (near & 0xff, 0);
        while near != 0 {
            let lane = near.trailing_zeros() as usize & 7;
            near &= near - 1;
            let child = node.children[lane];
            if child == NO_CHILD {
                continue;
            }
            // Without the sign of zero.
            let item = u64::from((keys[lane] + 0.0).to_bits()) << 32 | u64::from(child);
            let mut at = count & 7;
            while at > 0 && room[at - 1] < item {
                room[at] = room[at - 1];
                at -= 1;
            }
            room[at] = item;
            count += 1;
        }
        self.top += count;
    }
}

/// Returns the error of distances from a place in the frame of a tree.
#[inline(always)]
pub(crate) fn margin([x, y, z]: [f32; 3]) -> f32 {
    let size = x.abs().max(y.abs()).max(z.abs());
    ROUNDINGS * 0.5 * f32::EPSILON * (1.0 + size)
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
pub(crate) fn bound_squares<L: EightLanes>(node: &TreeNode, point: Vec3<L>, part: usize) -> L {
    let (low, high) = (
        part_of::<L>(&node.bounds[0], part),
        part_of::<L>(&node.bounds[1], part),
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
/// `start` is the squared distance of a point of the mesh, or infinity.
#[inline(always)]
pub(crate) fn collect<L: EightLanes>(
    tree: &MeshTree,
    [x, y, z]: [f32; 3],
    start: f32,
    room: &mut SearchRoom,
) -> f32 {
    let mut limit = SearchLimit {
        least: f32::INFINITY,
        limit: f32::INFINITY,
        margin: margin([x, y, z]),
    };
    limit.lower(start);
    let point = Vec3::new(L::all(x), L::all(y), L::all(z));
    room.stack.start();
    room.candidates.clear();
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
                let found = squares[lane & 7];
                if found <= limit.limit {
                    limit.lower(found);
                    room.candidates.push((found, faces[lane & 7]));
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
        room.stack.push_nearest_last(node, near, &squares);
    }
    limit.limit
}

/// Returns the face and the feature that are nearest to a point, among equal ones that of lowest index; `None` for a
/// point that is not finite. `known` is a point of the mesh that may be near, such as that of a neighbouring query.
#[inline(always)]
pub(crate) fn nearest<L: EightLanes, S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    tree: &MeshTree,
    point: Vec3<f64>,
    known: Option<Vec3<f64>>,
    room: &mut SearchRoom,
) -> Option<FaceRecord> {
    if !point.is_finite() {
        return None;
    }
    let local = tree.frame().local(point);
    let size = local.x.abs().max(local.y.abs()).max(local.z.abs());
    let mut limit = f32::INFINITY;
    if size > FAR {
        room.candidates.clear();
        let faces = 0..mesh.faces().len() as u32;
        room.candidates.extend(faces.map(|face| (0.0, face)));
    } else {
        let mut start = f32::INFINITY;
        if let Some(known) = known {
            // The error of `known` itself, far from the origin; the margin of the limit has that of sizes.
            let reach = known.x.abs() + known.y.abs() + known.z.abs();
            let length = (known - point).length() + 16.0 * f64::EPSILON * reach;
            let local = length * tree.frame().scale;
            start = (local * local) as f32;
        }
        let place = [local.x as f32, local.y as f32, local.z as f32];
        limit = collect::<L>(tree, place, start, room);
    }
    let mut best: Option<(f64, FaceRecord)> = None;
    for &(rough, face) in &room.candidates {
        if rough > limit {
            continue;
        }
        let (square, feature) = nearest_feature(point, mesh.plain_triangle(face));
        let is_better = match best {
            Some((least, record)) => square < least || square == least && face < record.face,
            None => true,
        };
        if is_better {
            best = Some((square, FaceRecord { face, feature }));
        }
    }
    Some(best?.1)
}
