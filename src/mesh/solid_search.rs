//! The search for the faces of a mesh that are near a solid.
//!
//! Bounds of solids are boxes of any orientation with a radius, in the frame of the tree and in single precision. Their
//! distance from the bounds of a node is at least the length of the gaps along the axes of the tree, and that of the
//! gaps along the axes of the solid: both are those of axis-aligned boxes around one in the axes of the other. Faces
//! whose boxes are near are compared by bounds of their own distance from the box. The margin of limits has the
//! roundings of all.
use super::face_search::{FAR, SearchRoom};
use super::lane_gap::{all_of, gap_of_box, gap_of_faces};
use super::mesh_solid::SolidBounds;
use super::mesh_tree::{MeshTree, TreeFrame};
use super::packet::{EightLanes, EightNumbers, PACKET, Packet, TreeNode, part_of};
use crate::Vec3;

/// Roundings of single precision in a distance of bounds, relative to the size of both. The sum of all terms is below
/// forty: of a conversion of each corner, a rotation of three products, and sums of three.
const ROUNDINGS: f32 = 96.0;
/// The bounds of a solid in the frame of a tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalBounds {
    center: [f32; 3],
    axes: [[f32; 3]; 3],
    /// The axes without signs.
    sizes: [[f32; 3]; 3],
    half: [f32; 3],
    /// Half the size of the axis-aligned box around the box.
    upright: [f32; 3],
    /// `true` if the axes are those of the frame.
    is_upright: bool,
    radius: f32,
    /// The error of distances.
    margin: f32,
}

/// Returns the error of distances in a frame, of a size.
pub(super) fn error(size: f32) -> f32 {
    ROUNDINGS * 0.5 * f32::EPSILON * (1.0 + size)
}

impl LocalBounds {
    /// Returns bounds with some radius, for distances of a size.
    pub(super) fn new(
        center: Vec3<f32>,
        axes: [[f32; 3]; 3],
        half: [f32; 3],
        [radius, size]: [f32; 2],
    ) -> Self {
        let reach = |k: usize| {
            let part = |i: usize| axes[i][k].abs() * half[i];
            part(0) + part(1) + part(2)
        };
        let is_upright = (0..3).all(|i| (0..3).all(|k| (axes[i][k] == 0.0) == (i != k)));
        LocalBounds {
            center: [center.x, center.y, center.z],
            axes,
            sizes: axes.map(|axis| axis.map(f32::abs)),
            half,
            upright: [0, 1, 2].map(reach),
            is_upright: is_upright || half == [0.0; 3],
            radius,
            margin: error(size),
        }
    }
    /// Returns the bounds of a solid; `None` for one whose squares single precision may not hold.
    fn of(bounds: &SolidBounds, frame: &TreeFrame) -> Option<Self> {
        let center = frame.local(bounds.center);
        let half = bounds.half.map(|half| half * frame.scale);
        let radius = bounds.radius * frame.scale;
        let reach = half[0] + half[1] + half[2] + radius;
        let size = center.x.abs().max(center.y.abs()).max(center.z.abs()) + reach;
        if size > FAR {
            return None;
        }
        Some(Self::new(
            Vec3::new(center.x as f32, center.y as f32, center.z as f32),
            bounds
                .axes
                .map(|axis| [axis.x as f32, axis.y as f32, axis.z as f32]),
            half.map(|half| half as f32),
            [radius as f32, size as f32],
        ))
    }
    /// Returns the squared distance of boxes up to which solids may be as near as `distance`, in the tree's frame.
    pub(super) fn limit(&self, distance: f32) -> f32 {
        let limit = distance + self.radius + self.margin;
        limit * limit * (1.0 + 16.0 * f32::EPSILON)
    }
    /// Returns the distance of triangles from the box up to which solids may be as near as `distance`.
    fn gap_limit(&self, distance: f32) -> f32 {
        (distance + self.radius + self.margin) * (1.0 + 8.0 * f32::EPSILON)
    }
    /// Returns the distances of triangles from the box, or less.
    #[inline(always)]
    fn gaps<L: EightLanes>(&self, [a, b, c]: [Vec3<L>; 3]) -> L {
        let center = all_of::<L>(self.center);
        let axes = [
            all_of::<L>(self.axes[0]),
            all_of::<L>(self.axes[1]),
            all_of::<L>(self.axes[2]),
        ];
        let (a, b, c) = (a - center, b - center, c - center);
        gap_of_box([along(axes, a), along(axes, b), along(axes, c)], self.half)
    }
    /// Returns the squared distances of the box from eight axis-aligned boxes, or less.
    #[inline(always)]
    pub(super) fn squares<L: EightLanes>(&self, low: Vec3<L>, high: Vec3<L>) -> L {
        let zero = L::all(0.0);
        let (center, reach) = (all_of::<L>(self.center), all_of::<L>(self.upright));
        let (below, above) = (low - (center + reach), (center - reach) - high);
        let x = below.x.most(above.x).most(zero);
        let y = below.y.most(above.y).most(zero);
        let z = below.z.most(above.z).most(zero);
        let square = x * x + y * y + z * z;
        if self.is_upright {
            return square;
        }
        let half = L::all(0.5);
        let (middle, size) = ((low + high) * half - center, (high - low) * half);
        let mut own = zero;
        for k in 0..3 {
            let reach = all_of::<L>(self.sizes[k]).dot(size) + L::all(self.half[k]);
            let gap = (all_of::<L>(self.axes[k]).dot(middle).magnitude() - reach).most(zero);
            own += gap * gap;
        }
        square.most(own)
    }
}

/// Returns the boxes of a part of eight triangles.
#[inline(always)]
pub(super) fn boxes_of<L: EightLanes>(packet: &Packet, part: usize) -> [Vec3<L>; 2] {
    let [a, b, c] = &packet.corners;
    let (a, b, c) = (
        part_of::<L>(a, part),
        part_of::<L>(b, part),
        part_of::<L>(c, part),
    );
    let low = Vec3::new(
        a.x.least(b.x).least(c.x),
        a.y.least(b.y).least(c.y),
        a.z.least(b.z).least(c.z),
    );
    let high = Vec3::new(
        a.x.most(b.x).most(c.x),
        a.y.most(b.y).most(c.y),
        a.z.most(b.z).most(c.z),
    );
    [low, high]
}

/// Returns one bit per triangle of a packet, by its faces, of those up to a number; a missing one repeats the last.
#[inline(always)]
pub(super) fn present(faces: &[u32; 8], most: u32) -> u32 {
    let mut bits = u32::from(faces[0] <= most);
    for lane in 1..8 {
        bits |= u32::from(faces[lane] != faces[lane - 1] && faces[lane] <= most) << lane;
    }
    bits
}

/// Returns a vector along three axes.
#[inline(always)]
fn along<L: EightLanes>(axes: [Vec3<L>; 3], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(axes[0].dot(v), axes[1].dot(v), axes[2].dot(v))
}

/// Writes the squared distances of a box from the children of a node, or less, and returns one bit for each up to a
/// limit.
#[inline(always)]
pub(super) fn near_children<L: EightLanes>(
    own: &LocalBounds,
    node: &TreeNode,
    limit: f32,
    squares: &mut EightNumbers,
) -> u32 {
    let mut near = 0;
    for part in 0..L::PARTS {
        let [low, high] = &node.bounds;
        let (low, high) = (part_of(low, part), part_of(high, part));
        let found = own.squares::<L>(low, high);
        near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
        found.put(squares, part);
    }
    near
}

/// Returns one bit for each triangle of a packet whose box may be as near as a limit to a box.
#[inline(always)]
pub(super) fn near_triangles<L: EightLanes>(own: &LocalBounds, packet: &Packet, limit: f32) -> u32 {
    let mut near = 0;
    for part in 0..L::PARTS {
        let [low, high] = boxes_of::<L>(packet, part);
        let found = own.squares::<L>(low, high);
        near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
    }
    near
}

/// Returns `true` if a part of eight bits has one.
#[inline(always)]
fn has_any<L: EightLanes>(bits: u32, part: usize) -> bool {
    let lanes = 8 / L::PARTS;
    bits >> (part * lanes) & ((1 << lanes) - 1) != 0
}

/// Keeps of some bits of a packet those of triangles that may be as near as a limit to a box, and writes their gaps.
#[inline(always)]
fn gaps_from_box<L: EightLanes>(
    own: &LocalBounds,
    (packet, bits): (&Packet, u32),
    limit: f32,
    gaps: &mut EightNumbers,
) -> u32 {
    let mut near = 0;
    for part in 0..L::PARTS {
        if has_any::<L>(bits, part) {
            let found = own.gaps(triangles_of::<L>(packet, part));
            near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
            found.put(gaps, part);
        }
    }
    near & bits
}

/// Keeps of some bits of a packet those of triangles that may be as near as a limit to another one, and writes their
/// gaps.
#[inline(always)]
pub(super) fn gaps_from_face<L: EightLanes>(
    facing: [[f32; 3]; 3],
    (packet, bits): (&Packet, u32),
    limit: f32,
    gaps: &mut EightNumbers,
) -> u32 {
    let facing = [
        all_of::<L>(facing[0]),
        all_of::<L>(facing[1]),
        all_of::<L>(facing[2]),
    ];
    let mut near = 0;
    for part in 0..L::PARTS {
        if has_any::<L>(bits, part) {
            let found = gap_of_faces(triangles_of::<L>(packet, part), facing);
            near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
            found.put(gaps, part);
        }
    }
    near & bits
}

/// Returns a part of eight triangles.
#[inline(always)]
pub(super) fn triangles_of<L: EightLanes>(packet: &Packet, part: usize) -> [Vec3<L>; 3] {
    let [a, b, c] = &packet.corners;
    [part_of(a, part), part_of(b, part), part_of(c, part)]
}

/// The rest of a search: how far, and up to which face.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted {
    /// The distance up to which faces are visited; a negative one ends the search.
    pub distance: f64,
    /// The highest face, of the first mesh, to be visited.
    pub most: u32,
}

impl Wanted {
    /// Returns all faces up to a distance.
    pub(crate) fn up_to(distance: f64) -> Self {
        Wanted {
            distance,
            most: u32::MAX,
        }
    }
    /// Returns `true` if a face at distance zero is known, so that lower ones are looked for in their order.
    #[inline(always)]
    fn is_of_lowest(&self) -> bool {
        self.most != u32::MAX
    }
    /// Returns `true` if a face, the lowest of some, is too high.
    #[inline(always)]
    pub(super) fn is_below(&self, lowest: u32) -> bool {
        self.most < lowest
    }
    /// The end of a search.
    pub(crate) const NOTHING: Wanted = Wanted {
        distance: -1.0,
        most: u32::MAX,
    };
}

/// Calls `visit` with every face that may be as near to a solid as some distance: at first `start`, then what the last
/// call returned.
#[inline(always)]
pub(crate) fn visit_faces<L: EightLanes>(
    tree: &MeshTree,
    bounds: &SolidBounds,
    start: f64,
    room: &mut SearchRoom,
    visit: &mut dyn FnMut(u32) -> Wanted,
) {
    let Some(own) = LocalBounds::of(bounds, tree.frame()) else {
        for face in 0..tree.face_count() as u32 {
            if visit(face).distance < 0.0 {
                return;
            }
        }
        return;
    };
    let scale = tree.frame().scale;
    let mut wanted = Wanted::up_to(start);
    let mut limit = own.limit((start * scale) as f32);
    let mut most = own.gap_limit((start * scale) as f32);
    room.stack.start();
    let (mut squares, mut gaps) = ([0.0; 8], [0.0; 8]);
    while let Some((square, child)) = match wanted.is_of_lowest() {
        true => room.stack.pop_lowest(|child| tree.lowest(child)),
        false => room.stack.pop(),
    } {
        if square > limit || wanted.is_below(tree.lowest(child)) {
            continue;
        }
        if child & PACKET == 0 {
            let node = &tree.nodes()[child as usize];
            let near = near_children::<L>(&own, node, limit, &mut squares);
            room.stack.push_nearest_last(node, near, &squares);
            continue;
        }
        let (packet, faces) = tree.packet((child ^ PACKET) as usize);
        let mut near = present(faces, wanted.most);
        if near != 0 {
            near &= near_triangles::<L>(&own, packet, limit);
        }
        near = gaps_from_box::<L>(&own, (packet, near), most, &mut gaps);
        while near != 0 {
            let lane = match wanted.is_of_lowest() {
                true => near.trailing_zeros() as usize & 7,
                false => nearest_lane(near, &gaps),
            };
            near &= !(1 << lane);
            if wanted.is_below(faces[lane]) {
                break;
            }
            if gaps[lane] > most {
                continue;
            }
            wanted = visit(faces[lane]);
            if wanted.distance < 0.0 {
                return;
            }
            limit = own.limit((wanted.distance * scale) as f32);
            most = own.gap_limit((wanted.distance * scale) as f32);
        }
    }
}

/// Returns the lane of the least number among some bits, of which one is set.
#[inline(always)]
fn nearest_lane(bits: u32, numbers: &EightNumbers) -> usize {
    let mut best = bits.trailing_zeros() as usize & 7;
    for lane in best + 1..8 {
        if bits >> lane & 1 == 1 && numbers[lane] < numbers[best] {
            best = lane;
        }
    }
    best
}
