//! Two solids, and what a search finds of them.
use super::super::gjk::PointDifference;
use super::piece::Piece;
use super::support::Supported;
use super::touch::Touch;
use crate::Vec3;

/// The decisions about two solids.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// The numbers of the pieces.
    pub pieces: [usize; 2],
    /// The touch, with its normal.
    pub touch: Touch<f64>,
    /// The gap of the supports along the normal.
    pub value: f64,
    /// The length by which the points are not that far apart along the normal.
    pub error: f64,
    /// `true` if all equations are independent.
    pub regular: bool,
    /// `true` if both places are on their pieces, which are stationary there.
    pub settled: bool,
}

/// Two solids, and their size.
#[derive(Clone, Copy)]
pub struct Solids<'a> {
    pub a: &'a dyn Supported,
    pub b: &'a dyn Supported,
    pub size: f64,
    /// 1, or −1 for the points that are the farthest from each other, with outer normals away from the other solid.
    pub side: f64,
}

impl Solids<'_> {
    /// Returns the gap of the supports along a normal.
    pub fn value(&self, normal: Vec3<f64>) -> f64 {
        let out = normal * self.side;
        normal.dot(self.b.support(-out) - self.a.support(out))
    }
    /// Returns two pieces, seen along a normal from a to b.
    pub fn pieces(&self, [i, j]: [usize; 2], normal: Vec3<f64>) -> [Piece<f64>; 2] {
        let out = normal * self.side;
        let mut both = [self.a.piece(i, out), self.b.piece(j, -out)];
        if self.side < 0.0 {
            for piece in both.iter_mut().filter(|piece| piece.kind.turns()) {
                // Derivatives by the normal instead of the outer one.
                piece.ways = piece.ways.map(|way| -way);
            }
        }
        both
    }
    /// Returns the point of b, moved, less a that is the lowest along a vector.
    pub fn lowest(&self, way: Vec3<f64>, by: Vec3<f64>) -> PointDifference {
        let (a, b) = (self.a.support(way), self.b.support(-way) + by);
        PointDifference { way: b - a, a, b }
    }
}

impl Found {
    /// Returns the same with the numbers of pieces, and the places on them, that a replay evaluates.
    pub fn replayed(&self, [a, b]: [&dyn Supported; 2]) -> Self {
        let (i, at_a) = a.replayed(self.pieces[0], &self.touch.a);
        let (j, at_b) = b.replayed(self.pieces[1], &self.touch.b);
        Found {
            pieces: [i, j],
            touch: Touch {
                normal: self.touch.normal,
                a: at_a,
                b: at_b,
            },
            ..*self
        }
    }
}

/// Returns the pieces of a touch, seen along its normal.
pub fn pieces([a, b]: [&dyn Supported; 2], found: &Found, side: f64) -> [Piece<f64>; 2] {
    let solids = Solids {
        a,
        b,
        size: 1.0,
        side,
    };
    solids.pieces(found.pieces, found.touch.normal)
}
