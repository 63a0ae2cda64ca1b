//! Shapes as lists of numbers.
use crate::Fixed;

/// Returns the numbers of a shape, first field first.
pub(super) fn numbers<P: Fixed>(shape: P) -> Vec<P::Scalar> {
    shape.scalars()
}
