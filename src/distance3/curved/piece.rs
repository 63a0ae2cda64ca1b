//! Smooth pieces of the surface of a convex solid, as maps of a few parameters.
use crate::{Scalar, Vec3};

/// The kinds of pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PieceKind {
    /// A corner or an apex.
    Point,
    /// A straight edge, by the share of its length.
    Line,
    /// A flat face, by two coordinates from a point of it.
    Face,
    /// A circle, by a vector of length one.
    Rim,
    /// The side of a cylinder or a cone, by a vector of length one and a share of the axis.
    Side,
    /// An ellipsoid, by a vector of length one.
    Ball,
    /// A point that moves with the normal: the support of a round shape.
    Own,
    /// A straight line that moves with the normal, by the share of its length.
    Ruled,
}

impl PieceKind {
    /// Returns the number of coordinates along ways.
    pub fn ways(self) -> usize {
        match self {
            PieceKind::Point | PieceKind::Line | PieceKind::Own | PieceKind::Ruled => 0,
            PieceKind::Face | PieceKind::Rim | PieceKind::Side => 2,
            PieceKind::Ball => 3,
        }
    }
    /// Returns `true` if a share of an axis is a parameter.
    pub fn has_axis(self) -> bool {
        matches!(self, PieceKind::Line | PieceKind::Side | PieceKind::Ruled)
    }
    /// Returns `true` if the piece moves with the normal.
    pub fn turns(self) -> bool {
        matches!(self, PieceKind::Own | PieceKind::Ruled)
    }
    /// Returns the number of unknowns: coordinates, their multiplier and the share.
    pub fn unknowns(self) -> usize {
        self.ways() + usize::from(self.is_round()) + usize::from(self.has_axis())
    }
    /// Returns `true` if the coordinates along ways have the length one.
    pub fn is_round(self) -> bool {
        matches!(self, PieceKind::Rim | PieceKind::Side | PieceKind::Ball)
    }
}

/// A piece of a surface: the points `from + along s + Σ (size + taper s) way y`.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S> {
    /// Its kind.
    pub kind: PieceKind,
    /// The point at which all parameters are zero.
    pub from: Vec3<S>,
    /// The vector along the edge or the axis.
    pub along: Vec3<S>,
    /// Directions of length one; of a piece that moves with the normal the derivatives of its points by the normal's
    /// coordinates, over the size at their share of the axis.
    pub ways: [Vec3<S>; 3],
    /// Lengths along the ways at the start of the axis.
    pub sizes: [S; 3],
    /// The growth of these lengths along the axis.
    pub taper: S,
}

/// The parameters of a point of a piece.
#[derive(Clone, Copy, Debug)]
pub struct Place<S> {
    /// Coordinates along the ways.
    pub y: [S; 3],
    /// The share of the axis.
    pub s: S,
    /// The multiplier of the condition that the coordinates have length one.
    pub pull: S,
}

impl<S: Scalar> Place<S> {
    /// Creates the place at which all parameters are zero.
    pub fn zero() -> Self {
        let zero = S::zero();
        Place {
            y: [zero; 3],
            s: zero,
            pull: zero,
        }
    }
}

impl<S: Scalar> Piece<S> {
    /// Creates a corner.
    pub fn point(at: Vec3<S>) -> Self {
        let (zero, none) = (S::zero(), Vec3::zero());
        Piece {
            kind: PieceKind::Point,
            from: at,
            along: none,
            ways: [none; 3],
            sizes: [zero; 3],
            taper: zero,
        }
    }
    /// Creates an edge.
    pub fn line(from: Vec3<S>, along: Vec3<S>) -> Self {
        Piece {
            kind: PieceKind::Line,
            along,
            ..Self::point(from)
        }
    }
    /// Creates a piece with two ways.
    pub fn plane(kind: PieceKind, from: Vec3<S>, ways: [Vec3<S>; 2], sizes: [S; 2]) -> Self {
        Piece {
            kind,
            ways: [ways[0], ways[1], Vec3::zero()],
            sizes: [sizes[0], sizes[1], S::zero()],
            ..Self::point(from)
        }
    }
    /// Returns a length along a way at a share of the axis.
    pub fn size(&self, k: usize, s: S) -> S {
        self.sizes[k] + self.taper * s
    }
    /// Returns the point at a place.
    pub fn at(&self, place: &Place<S>) -> Vec3<S> {
        let mut at = self.from;
        if self.kind.has_axis() {
            at += self.along * place.s;
        }
        for k in 0..self.kind.ways() {
            at += self.ways[k] * (self.size(k, place.s) * place.y[k]);
        }
        at
    }
    /// Returns the derivative of the point by the share of the axis.
    pub fn by_share(&self, place: &Place<S>) -> Vec3<S> {
        let mut way = self.along;
        for k in 0..self.kind.ways() {
            way += self.ways[k] * (self.taper * place.y[k]);
        }
        way
    }
}

/// Returns a place with a share of the axis.
pub fn along(share: f64) -> Place<f64> {
    Place {
        s: share,
        ..Place::zero()
    }
}

/// Returns a place with two coordinates.
pub fn within(x: f64, y: f64) -> Place<f64> {
    Place {
        y: [x, y, 0.0],
        ..Place::zero()
    }
}

/// Returns lengths as shares of the largest; ones if all are zero.
pub fn shares(sizes: &[f64; 3]) -> [f64; 3] {
    let most = sizes.iter().copied().fold(0.0, f64::max);
    sizes.map(|size| if most > 0.0 { size / most } else { 1.0 })
}
