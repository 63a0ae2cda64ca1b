//! Compiled kernels of operations, as data.
use crate::overlap::Denominator;

/// The compiled kernels, or only bounds, that batches have for an operation in addition to its program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compiled {
    /// A score of rotated boxes.
    Obb2(Denominator),
    /// A score of axis-aligned boxes.
    Aabb2(Denominator),
    /// Generalised IoU of rotated boxes.
    Giou,
    /// A score of upright boxes.
    Upright(Denominator),
    /// A score of upright boxes seen from above.
    BirdsEye(Denominator),
    /// The intersection area of two convex quadrilaterals.
    Quads,
    /// A score of axis-aligned boxes in space: it has no kernels, but boxes that are apart score zero.
    Aabb3,
    /// A score of boxes of any orientation in space.
    Obb3(Denominator),
}
