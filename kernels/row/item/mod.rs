//! Items: the layouts of shapes as numbers, and the memory for results.
pub(crate) mod counts;
mod layout;
#[allow(unsafe_code)]
pub(crate) mod memory;
pub(crate) mod rows;

pub use layout::{Item, Leaf, Quick, Results, Single, Target, WithJacobian, leaf, target};
pub(crate) use layout::{
    STRETCH, TargetPiece, by_kind, by_shape, get, jacobians, leaves_of, put, targets_of, width,
    widths,
};
