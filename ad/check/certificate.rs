//! Proofs of distances in space: two points at the distance, and a plane that separates the bodies by it.
//!
//! Points of the bodies bound their distance from above, a plane between them bounds it from below. A body has only its
//! extent along a direction, so that no formula under test is used. `compare/proof` compares a value with the bounds.
pub use super::convex_body::Body;
use super::separating::{best, curved};
use crate::Vec3;

/// The measure that a proof is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proved {
    /// The distance; 0 where the bodies touch or overlap.
    Distance,
    /// Its square.
    SquaredDistance,
    /// The distance, or minus the depth of overlap.
    SignedDistance,
}

/// The proof of a distance: the bodies, and the points given as nearest.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The function.
    pub measure: Proved,
    /// The bodies.
    pub bodies: [Body; 2],
    /// A point of each, if a companion of the function returns them.
    pub points: Option<[Vec3<f64>; 2]>,
}

/// The bounds that a proof gives for a distance, in the unit of length.
pub(crate) struct ProvedBounds {
    /// The gap of the plane that separates the bodies best: at most the signed distance. For bodies with flat faces,
    /// edges and corners it equals the signed distance, for others where they are apart.
    pub parted: f64,
    /// `true` if it equals the signed distance where the bodies overlap, too.
    pub is_depth: bool,
    /// The distance of the points, and the larger distance of a point from its body.
    pub points: Option<[f64; 2]>,
    /// The largest coordinate.
    pub size: f64,
}

impl Proof {
    /// Returns `true` if lines or rays are among the bodies.
    pub(crate) fn is_endless(&self) -> bool {
        self.bodies.iter().any(|body| !body.endless.is_empty())
    }
    /// Returns the bounds that it proves; `None` if no plane separates the bodies by a finite number, as for lines that
    /// cross.
    pub(crate) fn bounds(&self) -> Option<ProvedBounds> {
        let size = self.bodies[0].size().max(self.bodies[1].size());
        if !size.is_finite() {
            return None;
        }
        // So that no product over- or underflows.
        let unit_size = match size {
            0.0 => 1.0,
            size => size.log2().ceil().exp2(),
        };
        let [a, b] = [0, 1].map(|k| self.bodies[k].scaled(1.0 / unit_size));
        let parted = best(&a, &b) * unit_size;
        let points = self.points.map(|points| {
            let [p, q] = points.map(|p| p * (1.0 / unit_size));
            let off = a.outside(p).max(b.outside(q));
            [(q - p).length() * unit_size, off * unit_size]
        });
        parted.is_finite().then_some(ProvedBounds {
            parted,
            is_depth: !curved(&a, &b),
            points,
            size,
        })
    }
}
