//! Items: the layouts of shapes as numbers, and the memory for results.
pub(crate) mod counts;
pub(crate) mod layout;
#[allow(unsafe_code)]
pub(crate) mod memory;
pub(crate) mod rows;

pub use layout::{Item, Leaf, Quick, Results, Single, Target, WithJacobian};
pub(crate) use layout::{
    STRETCH, TargetPiece, by_kind, by_shape, item_of, jacobians, leaf, leaves_of, target,
    targets_of, width, widths,
};
