//! The search for the faces of two meshes that are near each other, by both trees.
use super::face_search::FAR;
use super::mesh_tree::MeshTree;
use super::packet::{EightLanes, EightNumbers, NO_CHILD, PACKET, TreeNode};
use super::solid_search::{
    LocalBounds, Wanted, error, gaps_from_face, near_children, near_triangles, present,
};
use crate::arrays::sort_few;
use crate::{Pose3, Vec3};

/// The way from the frame of one tree to that of another one.
#[derive(Clone, Copy, Debug)]
struct TreeWay {
    axes: [[f32; 3]; 3],
    shift: Vec3<f64>,
    /// The length of a unit.
    ratio: f32,
    size: f32,
}

impl TreeWay {
    /// Returns the way from the frame of `from`, whose mesh is placed by a pose, to that of `to`.
    fn new(to: &MeshTree, from: &MeshTree, pose: &Pose3<f64>) -> Self {
        let (a, b) = (to.frame(), from.frame());
        let (axes, shift) = (pose.rotation.axes(), a.local(*pose * b.middle));
        let ratio = a.scale / b.scale;
        let most = shift.x.abs().max(shift.y.abs()).max(shift.z.abs());
        TreeWay {
            axes: axes.map(|axis| [axis.x as f32, axis.y as f32, axis.z as f32]),
            shift,
            ratio: ratio as f32,
            // Coordinates of either tree are at most one.
            size: (most + 2.0 * ratio) as f32,
        }
    }
    /// Returns a point of the first frame in the second one.
    #[inline(always)]
    fn place(&self, point: [f32; 3]) -> [f32; 3] {
        let ([x, y, z], [p, q, r]) = (self.axes, point.map(|x| x * self.ratio));
        let at = |k: usize| x[k] * p + y[k] * q + z[k] * r;
        let Vec3 { x, y, z } = self.shift;
        [at(0) + x as f32, at(1) + y as f32, at(2) + z as f32]
    }
    /// Returns an axis-aligned box of the first frame as bounds in the second one.
    #[inline(always)]
    fn bounds(&self, own: &NodeBox) -> LocalBounds {
        let [low, high] = [own.low, own.high];
        let half = [0, 1, 2].map(|k| 0.5 * (high[k] - low[k]) * self.ratio);
        let [x, y, z] = self.place([0, 1, 2].map(|k| 0.5 * (low[k] + high[k])));
        let center = Vec3::new(x, y, z);
        LocalBounds::new(center, self.axes, half, [0.0, self.size])
    }
}

/// The axis-aligned box of a child.
#[derive(Clone, Copy, Debug)]
struct NodeBox {
    low: [f32; 3],
    high: [f32; 3],
}

impl NodeBox {
    /// The box around all of a tree.
    const ALL: NodeBox = NodeBox {
        low: [-1.0; 3],
        high: [1.0; 3],
    };
    fn size(&self) -> f32 {
        let side = |k: usize| self.high[k] - self.low[k];
        side(0) + side(1) + side(2)
    }
}

/// A child of each tree, with the squared distance that they have at least, in the frame of the first one.
#[derive(Clone, Copy, Debug)]
struct NodePair {
    square: f32,
    nodes: [u32; 2],
    boxes: [NodeBox; 2],
}

/// Calls `visit` with every pair of faces that may be as near as some distance: at first `start`, then what the last
/// call returned. The second mesh is placed by a pose.
#[inline(always)]
pub(crate) fn visit_pairs<L: EightLanes>(
    trees: [&MeshTree; 2],
    pose: &Pose3<f64>,
    start: f64,
    visit: &mut dyn FnMut(u32, u32) -> Wanted,
) {
    let ways = [
        TreeWay::new(trees[0], trees[1], pose),
        TreeWay::new(trees[1], trees[0], &pose.inverse()),
    ];
    if ways.iter().any(|way| f64::from(way.size) > FAR) {
        return visit_all(trees, visit);
    }
    let scale = trees[0].frame().scale;
    // Roundings of both frames, in units of the first one.
    let [first, second] = ways.map(|way| way.bounds(&NodeBox::ALL));
    let margin = error(ways[0].size);
    let limit_of = |distance: f64| {
        let local = (distance * scale) as f32;
        let other = second.limit((distance * trees[1].frame().scale) as f32);
        let most = (local + margin) * (1.0 + 8.0 * f32::EPSILON);
        [first.limit(local), other, most]
    };
    let (mut wanted, mut limits) = (Wanted::up_to(start), limit_of(start));
    // Squares of the second frame in units of the first one.
    let back = ways[0].ratio * ways[0].ratio;
    let mut stack = vec![NodePair {
        square: 0.0,
        nodes: [0, 0],
        boxes: [NodeBox::ALL; 2],
    }];
    let (mut squares, mut found) = ([0.0; 8], Vec::with_capacity(64));
    while let Some(pair) = stack.pop() {
        let most = limits[0].max(limits[1] * back);
        if pair.square > most || wanted.is_below(trees[0].lowest(pair.nodes[0])) {
            continue;
        }
        let leaves = pair.nodes.map(|node| node & PACKET != 0);
        if leaves == [true, true] {
            let most = (wanted.most, [limits[0], limits[2]]);
            leaf_pairs::<L>(trees, &ways[0], &pair, most, &mut found);
            for &(gap, own, other) in &found {
                if gap > limits[2] {
                    break;
                }
                wanted = visit(own, other);
                if wanted.distance < 0.0 {
                    return;
                }
                limits = limit_of(wanted.distance);
            }
            continue;
        }
        // The larger one is opened.
        let side = match leaves {
            [true, _] => 1,
            [_, true] => 0,
            _ => usize::from(pair.boxes[1].size() * ways[0].ratio > pair.boxes[0].size()),
        };
        let node = &trees[side].nodes()[pair.nodes[side] as usize];
        let own = ways[side].bounds(&pair.boxes[1 - side]);
        let near = near_children::<L>(&own, node, limits[side], &mut squares);
        let unit = if side == 0 { 1.0 } else { back };
        push_nearest_last(&mut stack, &pair, side, node, near, squares, unit);
    }
}

/// Pushes the children of a node, each with the other node of a pair, the nearest one last.
#[inline(always)]
fn push_nearest_last(
    stack: &mut Vec<NodePair>,
    pair: &NodePair,
    side: usize,
    node: &TreeNode,
    mut near: u32,
    squares: EightNumbers,
    unit: f32,
) {
    let from = stack.len();
    while near != 0 {
        let lane = near.trailing_zeros() as usize & 7;
        near &= near - 1;
        if node.children[lane] == NO_CHILD {
            continue;
        }
        let mut next = *pair;
        // Bounds of a pair bound all pairs below.
        next.square = pair.square.max(squares[lane] * unit);
        next.nodes[side] = node.children[lane];
        next.boxes[side] = NodeBox {
            low: node.bounds[0].map(|all| all[lane]),
            high: node.bounds[1].map(|all| all[lane]),
        };
        stack.push(next);
    }
    sort_few(&mut stack[from..], |a, b| {
        b.square.total_cmp(&a.square).is_lt()
    });
}

/// Collects the faces of two packets whose boxes are near each other, the nearest ones first.
#[inline(always)]
fn leaf_pairs<L: EightLanes>(
    trees: [&MeshTree; 2],
    way: &TreeWay,
    pair: &NodePair,
    (highest, [limit, most]): (u32, [f32; 2]),
    found: &mut Vec<(f32, u32, u32)>,
) {
    found.clear();
    let [(own, faces), (other, others)] =
        [0, 1].map(|k| trees[k].packet((pair.nodes[k] ^ PACKET) as usize));
    let (here, mut there) = (present(faces, highest), present(others, u32::MAX));
    if here == 0 {
        return;
    }
    let mut gaps = [0.0; 8];
    while there != 0 {
        let k = there.trailing_zeros() as usize & 7;
        there &= there - 1;
        let corners = [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| other.corners[corner][axis][k]));
        let side = |most: bool| {
            [0, 1, 2].map(|axis| {
                let [a, b, c] = corners.map(|corner| corner[axis]);
                if most {
                    a.max(b).max(c)
                } else {
                    a.min(b).min(c)
                }
            })
        };
        let bounds = way.bounds(&NodeBox {
            low: side(false),
            high: side(true),
        });
        let near = near_triangles::<L>(&bounds, own, limit) & here;
        if near == 0 {
            continue;
        }
        let facing = [
            way.place(corners[0]),
            way.place(corners[1]),
            way.place(corners[2]),
        ];
        let mut near = gaps_from_face::<L>(facing, (own, near), most, &mut gaps);
        while near != 0 {
            let lane = near.trailing_zeros() as usize & 7;
            near &= near - 1;
            found.push((gaps[lane], faces[lane], others[k]));
        }
    }
    nearest_first(found);
}

/// Sorts faces by their distances. Apart from the search, which is compiled for every kind of vector.
#[inline(never)]
fn nearest_first(found: &mut [(f32, u32, u32)]) {
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
}

/// Calls `visit` with all pairs.
fn visit_all(trees: [&MeshTree; 2], visit: &mut dyn FnMut(u32, u32) -> Wanted) {
    let [own, other] = trees.map(|tree| tree.face_count() as u32);
    for face in 0..own {
        for facing in 0..other {
            if visit(face, facing).distance < 0.0 {
                return;
            }
        }
    }
}
