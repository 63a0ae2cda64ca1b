//! Results of functions of distance that are more than a number.
use crate::Vec2;

/// A point of each of two shapes.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointPair<S> {
    /// The point of a.
    pub on_a: Vec2<S>,
    /// The point of b.
    pub on_b: Vec2<S>,
}

/// A point of each of two shapes, as far apart as any.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FarthestPoints<S> {
    /// The point of a.
    pub on_a: Vec2<S>,
    /// The point of b.
    pub on_b: Vec2<S>,
}

/// The penetration depth of two shapes, and the direction in which it is least.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact<S> {
    /// The length of the shortest shift after which the shapes only touch; 0 where they are apart.
    pub depth: S,
    /// The direction, of length one, of that shift of b; where they are apart, the direction from a
    /// to b. Zero where two points coincide and no direction is preferred.
    pub direction: Vec2<S>,
}
