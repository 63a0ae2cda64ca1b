//! Results of functions of distance in space that are more than a number.
use crate::Vec3;

/// A point of each of two shapes of space.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointPair3<S> {
    /// The point of a.
    pub on_a: Vec3<S>,
    /// The point of b.
    pub on_b: Vec3<S>,
}

/// The penetration depth of two shapes of space, and the direction in which it is least.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact3<S> {
    /// The length of the shortest shift after which the shapes only touch; 0 where they are apart.
    pub depth: S,
    /// The direction, of length one, of that shift of b; where they are apart, the direction from a to b. Zero where
    /// two points coincide and no direction is preferred.
    pub direction: Vec3<S>,
}
