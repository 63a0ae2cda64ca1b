//! The relation of two shapes of space to each other, from which all distances follow.
use super::outcome::{Contact3, PointPair3};
use crate::{Scalar, Vec3};

/// The relation of two shapes to each other.
#[derive(Clone, Copy, Debug)]
pub struct Relation<S> {
    /// The signed distance.
    pub apart: S,
    /// The square of the distance.
    pub square: S,
    /// From a to b, of length one: the direction in which the shapes are apart or must part; zero where points
    /// coincide.
    pub normal: Vec3<S>,
    /// The point of a.
    pub on_a: Vec3<S>,
    /// The point of b.
    pub on_b: Vec3<S>,
}

impl<S: Scalar> Relation<S> {
    /// Returns the signed distance as a result.
    #[inline]
    pub(crate) fn signed_distance(self) -> S {
        self.apart.saturated().canonical()
    }
    /// Returns the distance as a result.
    #[inline]
    pub(crate) fn distance(self) -> S {
        let apart = self.apart;
        S::select(apart.above(S::zero()), apart, S::zero())
            .saturated()
            .canonical()
    }
    /// Returns the square of the distance as a result.
    #[inline]
    pub(super) fn squared_distance(self) -> S {
        self.square.saturated().canonical()
    }
    /// Returns the nearest points as a result.
    #[inline]
    pub(crate) fn closest_points(self) -> PointPair3<S> {
        PointPair3 {
            on_a: self.on_a.canonical(),
            on_b: self.on_b.canonical(),
        }
    }
    /// Returns the depth of overlap and the direction out as a result.
    #[inline]
    pub(crate) fn penetration(self) -> Contact3<S> {
        let depth = -self.apart;
        Contact3 {
            depth: S::select(depth.above(S::zero()), depth, S::zero())
                .saturated()
                .canonical(),
            direction: self.normal.canonical(),
        }
    }
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        Relation {
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            ..self
        }
    }
    /// Returns the relation of these shapes inflated by radii. If they meet and no direction is preferred, the points
    /// are in a given direction.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn inflated(self, radius_a: S, radius_b: S, aside: Vec3<S>) -> Self {
        let apart = self.apart - (radius_a + radius_b);
        let none = self.normal.length_squared().equals(S::zero());
        let way = Vec3::select(none, aside, self.normal);
        Relation {
            apart,
            square: square_of_gap(apart),
            normal: self.normal,
            on_a: self.on_a + way * radius_a,
            on_b: self.on_b - way * radius_b,
        }
    }
}

/// Returns the square of a signed distance, zero where that is negative.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn square_of_gap<S: Scalar>(apart: S) -> S {
    S::select(apart.above(S::zero()), apart * apart, S::zero())
}

/// Returns the vector with length one; zero for the zero vector. For a tiny vector it is a constant, since its
/// derivatives are beyond the format.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn direction<S: Scalar>(way: Vec3<S>) -> Vec3<S> {
    let length = way.length();
    let none = length.at_most(S::zero());
    let over = S::select(none, S::one(), length);
    let unit = Vec3::new(way.x.over(over), way.y.over(over), way.z.over(over));
    Vec3::select(length.at_most(S::speck()), unit.constant(), unit)
}
