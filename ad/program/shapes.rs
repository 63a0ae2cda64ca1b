//! Shapes as lists of numbers, and back.
use crate::Fixed;

/// The numbers of a shape, first field first.
pub(super) fn numbers<P: Fixed>(shape: P) -> Vec<P::Scalar> {
    shape.scalars()
}

/// The shape with these numbers, of which there are enough.
pub(super) fn load<P: Fixed>(numbers: &[P::Scalar]) -> P {
    P::from_slice(numbers)
}
