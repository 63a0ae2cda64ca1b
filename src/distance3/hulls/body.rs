//! A hull of plain numbers with its faces and edges.
use super::hull_record::spanning;
use crate::Vec3;
use crate::hull3::{HullEdge, Surface};

/// A face of a hull.
pub(in crate::distance3) struct Face {
    /// Its corners, counter-clockwise seen from outside.
    pub ring: Vec<usize>,
    /// Three of them that span it, the first opposite to the longest side.
    pub plane: [usize; 3],
    /// Its normal, of length one, pointing outwards; zero if it has no digits.
    pub normal: Vec3<f64>,
}

/// A hull, and all that bounds it.
pub(in crate::distance3) struct Body<'a> {
    pub points: &'a [Vec3<f64>],
    pub corners: Vec<usize>,
    pub faces: Vec<Face>,
    pub edges: Vec<HullEdge>,
    /// The number of independent directions, 0 to 3.
    pub dimension: usize,
}

/// The height by which rounding may put a corner beyond the plane of a face or an edge of its hull.
pub(super) const BEYOND: f64 = 1e-13;

/// Returns a vector with length one, or zero.
pub(super) fn unit(v: Vec3<f64>) -> Vec3<f64> {
    let length = v.length();
    match length > 0.0 {
        true => v * (1.0 / length),
        false => Vec3::zero(),
    }
}

/// Returns the direction orthogonal to two vectors, to the digits of the format for the first one.
pub(super) fn across(u: Vec3<f64>, v: Vec3<f64>) -> Vec3<f64> {
    let product = u.cross(v);
    let square = u.length_squared();
    let rest = if square > 0.0 {
        u.dot(product) / square
    } else {
        0.0
    };
    unit(product - u * rest)
}

/// Returns `true` for a product of two vectors that counts as none where it is replayed: the heights of its features
/// over their neighbours are then below rounding.
pub(super) fn is_short(product: Vec3<f64>, rounding: f64) -> bool {
    product.length() <= 4.0 * rounding * rounding
}

impl<'a> Body<'a> {
    /// Returns the hull of points, with at least one, for formats with a rounding. A face so thin that its normal has
    /// no digits is none: its edges are as near, within rounding.
    pub fn of(points: &'a [Vec3<f64>], rounding: f64) -> Self {
        let surface = Surface::of(points);
        let highest = |way: Vec3<f64>, over: Vec3<f64>| {
            let heights = surface.corners.iter().map(|&k| way.dot(points[k] - over));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        let face = |ring: &[usize]| {
            let mut up = Vec3::zero();
            for pair in ring[1..].windows(2) {
                let from = points[ring[0]];
                up += (points[pair[0]] - from).cross(points[pair[1]] - from);
            }
            let plane = spanning(|k| points[k], ring, up);
            let [apex, from, to] = plane.map(|k| points[k]);
            let normal = across(from - apex, to - apex);
            let product = (from - apex).cross(to - apex);
            let narrow = product.length() <= BEYOND * (to - from).length();
            let thin = narrow || is_short(product, rounding);
            let none = thin || highest(normal, apex) > BEYOND;
            Face {
                ring: ring.to_vec(),
                plane,
                normal: if none { Vec3::zero() } else { normal },
            }
        };
        Body {
            points,
            faces: surface.facets().map(face).collect(),
            edges: surface.edges(),
            dimension: surface.dimension,
            corners: surface.corners,
        }
    }
    /// Returns the vector along an edge.
    pub fn along(&self, edge: &HullEdge) -> Vec3<f64> {
        let [from, to] = edge.ends.map(|k| self.points[k]);
        to - from
    }
    /// Returns the least height of its corners along a direction over a point, and that corner.
    pub fn lowest(&self, way: Vec3<f64>, over: Vec3<f64>) -> (f64, usize) {
        let mut best = (f64::INFINITY, self.corners[0]);
        for &k in &self.corners {
            let height = way.dot(self.points[k] - over);
            if height < best.0 {
                best = (height, k);
            }
        }
        best
    }
}
