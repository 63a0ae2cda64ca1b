//! Items and columns: how shapes go into a batch and results come out of it.
//!
//! A *column* holds one argument of every item: a slice of shapes, or [`One`] that stands for all.
//! Several columns are a tuple: `(&points, One(circle))`. Results come out column by column, too: a
//! batch whose result is a number and a shape gives `(Vec<f64>, Vec<Shape>)`.
#[forbid(unsafe_code)]
mod column;
#[forbid(unsafe_code)]
pub(crate) mod counts;
#[forbid(unsafe_code)]
mod layout;
#[allow(unsafe_code)]
pub(crate) mod memory;
#[forbid(unsafe_code)]
pub(crate) mod rows;

pub use column::{Column, Columns, One};
pub use layout::{Item, Leaf, Quick, Results, Single, Target, WithJacobian, leaf, target};
pub(crate) use layout::{
    Piece, STRETCH, by_kind, by_shape, get, jacobians, leaves_of, targets_of, width, widths,
};
