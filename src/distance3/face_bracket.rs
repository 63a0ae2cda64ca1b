//! Triangles that clearly meet a solid, or are clearly farther from it than a distance, by slabs between both.
//!
//! A search for the nearest of many triangles measures most of them in vain. Two convex bodies are at least as far apart
//! as the width of a slab between them, and the iteration by supports finds a wide one after a step or two, the first one
//! across the way on which the last triangle was found.
use super::gjk::{FACES, PointDifference, gap_until};
use crate::{Triangle3, Vec3};
use std::cell::Cell;

/// Roundings of a width and of the distance that it is compared with, relative to the largest coordinate.
const ROUNDINGS: f64 = 256.0 * f64::EPSILON;

/// The depth of a common point at which bodies clearly meet, relative to the largest coordinate.
const INSIDE: f64 = 1e-10;

/// The relative gap of both bounds of the squared distance at which they are near enough.
const NEAR: f64 = 1e-6;

/// Bounds of the distance of two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Bracket {
    /// They are farther from each other than the distance that matters.
    Beyond,
    /// They have points in common, and some more where either is moved by a rounding.
    Meets,
    /// They are at least so far from each other, which is above zero, and at most so far. Roundings of the distance are
    /// within.
    Between(f64, f64),
    /// They may meet.
    Unclear,
}

/// The corners of a solid, whose distances from triangles it brackets, and the way to the last one.
pub(crate) struct FaceBracket {
    corners: Vec<Vec3<f64>>,
    /// The largest coordinate.
    reach: f64,
    way: Cell<Vec3<f64>>,
}

fn reach(corners: &[Vec3<f64>]) -> f64 {
    let of = |v: &Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    corners.iter().fold(0.0, |most, v| of(v).max(most))
}

/// Returns the corner that is the farthest along a vector.
fn highest(corners: &[Vec3<f64>], way: Vec3<f64>) -> Vec3<f64> {
    let mut best = (f64::NEG_INFINITY, Vec3::zero());
    for &corner in corners {
        let height = way.dot(corner);
        if height > best.0 {
            best = (height, corner);
        }
    }
    best.1
}

impl FaceBracket {
    /// Creates the brackets of a solid with some corners, of which there is one at least.
    pub fn new(corners: &[Vec3<f64>]) -> Self {
        FaceBracket {
            corners: corners.to_vec(),
            reach: reach(corners),
            way: Cell::new(Vec3::new(1.0, 0.0, 0.0)),
        }
    }
    /// Returns what is clear about the distance of a triangle; one above a number does not matter.
    pub fn bracket(&self, face: Triangle3<f64>, most: f64) -> Bracket {
        let face = face.corners();
        let size = self.reach.max(reach(&face));
        let margin = ROUNDINGS * size;
        let bound = most + margin;
        if !size.is_finite() {
            return Bracket::Unclear;
        }
        let lowest = |way: Vec3<f64>| {
            let (a, b) = (highest(&self.corners, way), highest(&face, -way));
            PointDifference { way: b - a, a, b }
        };
        let first = self.way.get();
        let start = lowest(first);
        let least = first.dot(start.way) / first.length();
        if least > bound {
            return Bracket::Beyond;
        }
        let found = gap_until(lowest, start, least, |gap, off| {
            gap.least > bound || gap.least > margin && off <= NEAR
        });
        if found.least > margin {
            self.way.set(found.way);
            return match found.least > bound {
                true => Bracket::Beyond,
                false => Bracket::Between(found.least - margin, found.way.length() + margin),
            };
        }
        match found.around() {
            Some(corners) if is_inside(corners, INSIDE * size) => Bracket::Meets,
            _ => Bracket::Unclear,
        }
    }
}

/// Returns `true` if the origin is inside of a tetrahedron, by some length at least.
fn is_inside(corners: [Vec3<f64>; 4], length: f64) -> bool {
    FACES.into_iter().all(|face| {
        let [p, q, r, behind] = face.map(|k| corners[k]);
        let normal = (q - p).cross(r - p);
        let side = normal.dot(behind - p).signum();
        -side * normal.dot(p) > length * normal.length()
    })
}
