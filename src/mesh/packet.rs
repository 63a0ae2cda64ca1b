//! Nodes with eight children and packets of eight triangles, in single precision, and the vectors that read them.
use crate::{Lanes, Scalar, Vec3};

/// Eight numbers side by side.
pub type EightNumbers = [f32; 8];

/// The child of a node that is none.
pub const NO_CHILD: u32 = u32::MAX;
/// The bit of a child that is a packet.
pub const PACKET: u32 = 1 << 31;

/// A node of a tree: bounds of up to eight children. Missing ones have empty bounds.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct TreeNode {
    /// The lower bounds along each axis, and the upper ones.
    pub bounds: [[EightNumbers; 3]; 2],
    /// The children: nodes, packets with the bit [`PACKET`], or [`NO_CHILD`].
    pub children: [u32; 8],
}

/// Up to eight triangles by their corners: `corners[corner][axis]`. Missing ones are NaN, which is near to nothing.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Packet {
    /// The coordinates of the corners.
    pub corners: [[EightNumbers; 3]; 3],
}

/// A vector of single precision that reads a part of eight numbers.
pub trait EightLanes: Scalar<Primal = Self> {
    /// The number of parts that make eight numbers.
    const PARTS: usize;
    /// Returns a part of eight numbers.
    fn part(of: &EightNumbers, part: usize) -> Self;
    /// Writes a part of eight numbers.
    fn put(self, to: &mut EightNumbers, part: usize);
    /// Returns a vector with one number everywhere.
    fn all(x: f32) -> Self;
    /// Returns one bit per number, the first one's lowest.
    fn truths(mask: Self::Mask) -> u32;
}

/// Four at once: the compiler makes vectors of them on every processor, and of eight only on some.
impl EightLanes for Lanes<f32, 4> {
    const PARTS: usize = 2;
    #[inline(always)]
    fn part(of: &EightNumbers, part: usize) -> Self {
        Lanes(of.as_chunks().0[part % 2])
    }
    #[inline(always)]
    fn put(self, to: &mut EightNumbers, part: usize) {
        to.as_chunks_mut().0[part % 2] = self.0;
    }
    #[inline(always)]
    fn all(x: f32) -> Self {
        Lanes([x; 4])
    }
    #[inline(always)]
    fn truths(mask: Self::Mask) -> u32 {
        let mut bits = 0;
        for (i, word) in mask.0.iter().enumerate() {
            bits |= (word & 1) << i;
        }
        bits
    }
}

/// Returns a part of eight vectors of space.
#[inline(always)]
pub fn part_of<L: EightLanes>(of: &[EightNumbers; 3], part: usize) -> Vec3<L> {
    Vec3::new(
        L::part(&of[0], part),
        L::part(&of[1], part),
        L::part(&of[2], part),
    )
}
