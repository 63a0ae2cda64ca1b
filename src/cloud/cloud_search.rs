//! The search for points of a cloud: candidates in single precision, the decision in double.
//!
//! Distances err by some roundings of the sizes, as those of [meshes](crate::mesh) do: points whose distance exceeds the
//! limit by less than that error are candidates.
use crate::Vec3;
use crate::mesh::{EightLanes, MeshTree, PACKET, SearchRoom, bound_squares, margin, part_of};
use std::collections::BinaryHeap;

/// The points that a search keeps.
pub enum Reach {
    /// Points up to a squared distance, in the frame of the tree.
    Within(f32),
    /// So many nearest points: their squared distances so far, as bits, which sort like the numbers.
    Nearest(usize, BinaryHeap<u32>),
}

impl Reach {
    /// Returns the squared distance up to which points are candidates.
    fn limit(&self, margin: f32) -> f32 {
        match self {
            Reach::Within(limit) => *limit,
            Reach::Nearest(count, least) if least.len() < *count => f32::INFINITY,
            Reach::Nearest(_, least) => {
                let most = least.peek().map_or(0.0, |&bits| f32::from_bits(bits));
                widened(most.sqrt(), margin)
            }
        }
    }
    fn add(&mut self, square: f32) {
        if let Reach::Nearest(count, least) = self {
            least.push(square.to_bits());
            if least.len() > *count {
                least.pop();
            }
        }
    }
}

/// Returns the square of a distance and its error.
pub fn widened(distance: f32, margin: f32) -> f32 {
    let root = distance + margin;
    root * root * (1.0 + 8.0 * f32::EPSILON)
}

/// Fills the room with candidates near a place in the tree's frame.
pub fn collect<L: EightLanes>(
    tree: &MeshTree,
    [x, y, z]: [f32; 3],
    mut reach: Reach,
    room: &mut SearchRoom,
) {
    let margin = margin([x, y, z]);
    let mut limit = reach.limit(margin);
    let point = Vec3::new(L::all(x), L::all(y), L::all(z));
    room.stack.start();
    room.candidates.clear();
    let mut squares = [0.0; 8];
    while let Some((square, child)) = room.stack.pop() {
        if square > limit {
            continue;
        }
        let mut near = 0;
        if child & PACKET != 0 {
            let (packet, points) = tree.packet((child ^ PACKET) as usize);
            for part in 0..L::PARTS {
                let found = (part_of::<L>(&packet.corners[0], part) - point).length_squared();
                near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
                found.put(&mut squares, part);
            }
            while near != 0 {
                let lane = near.trailing_zeros() as usize & 7;
                near &= near - 1;
                if squares[lane] <= limit {
                    reach.add(squares[lane]);
                    limit = reach.limit(margin);
                    room.candidates.push((squares[lane], points[lane]));
                }
            }
            continue;
        }
        let node = &tree.nodes()[child as usize];
        for part in 0..L::PARTS {
            let found = bound_squares::<L>(node, point, part);
            near |= L::truths(found.at_most(L::all(limit))) << (part * (8 / L::PARTS));
            found.put(&mut squares, part);
        }
        room.stack.push_nearest_last(node, near, &squares);
    }
    room.candidates.retain(|found| found.0 <= limit);
}
