//! Planes between two cores.
use super::spot::Spot;
use crate::distance::share::Carry;
use crate::{Scalar, Vec3};

/// The certainty that the points of a plane are on both cores, from worse to better.
pub(super) mod grade {
    /// A face without area: its plane is a bound, and no face of the difference of two cores.
    pub const EMPTY: f64 = -1.0;
    /// The points are beyond an end, or on a feature that supports no plane: it is only a bound.
    pub const BOUND: f64 = 0.0;
    /// The grade of two nearly parallel edges that cross.
    pub const STEEP: f64 = 1.0;
    /// Two edges cross.
    pub const EDGES: f64 = 2.0;
    /// A corner's foot is on a face.
    pub const FACE: f64 = 3.0;
}

/// A plane between two cores, and points of them nearest to it; if two sides tie, those of the first.
#[derive(Clone, Copy, Debug)]
pub struct PartingPlane<P> {
    /// The gap between a and b; negative where they overlap.
    pub value: P,
    /// The certainty that its points are on both cores: one of the [`grades`](grade).
    pub grade: P,
    /// The plane's normal, of length one, from a to b.
    pub normal: Vec3<P>,
    /// The number of points that tie.
    pub points: P,
    /// The number of points of the other side that tie.
    pub behind: P,
    /// The sum of the points of a.
    pub on_a: Vec3<P>,
    /// The sum of the points of b.
    pub on_b: Vec3<P>,
    /// The mean of the spots of the points of a.
    pub at_a: Spot<P>,
    /// The mean of the spots of the points of b.
    pub at_b: Spot<P>,
    /// The mean of the spots of a on the other side, where that ties.
    pub behind_a: Spot<P>,
    /// The mean of the spots of the points of b.
    pub behind_b: Spot<P>,
    /// The normal of the side that separates more, or of the first one: it needs no grades.
    pub lead: Vec3<P>,
    /// Zero for a face without area, else one.
    pub area: P,
}

impl<P: Scalar> PartingPlane<P> {
    /// Creates a plane that separates nothing.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn none() -> Self {
        let zero = P::zero();
        PartingPlane {
            value: P::lowest(),
            grade: zero,
            normal: Vec3::zero(),
            points: zero,
            behind: zero,
            on_a: Vec3::zero(),
            on_b: Vec3::zero(),
            at_a: Spot::none(),
            at_b: Spot::none(),
            behind_a: Spot::none(),
            behind_b: Spot::none(),
            lead: Vec3::zero(),
            area: P::one(),
        }
    }
    /// Returns the side that separates more; of equal ones that of the higher grade, or else both.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn of_sides([one, other]: [Self; 2]) -> Self {
        let same = one.value.equals(other.value);
        let tie = same & one.grade.equals(other.grade);
        let keep = tie | other.value.below(one.value) | same & other.grade.below(one.grade);
        let none = tie & !tie;
        let pick = |a: Vec3<P>, b: Vec3<P>| Vec3::select(keep, a, b);
        let behind = |spot: Spot<P>| spot.join(Spot::none(), tie, none);
        PartingPlane {
            value: one.value.most(other.value),
            grade: P::select(keep, one.grade, other.grade),
            normal: pick(one.normal, other.normal),
            points: P::select(keep, one.points, other.points),
            behind: P::select(tie, other.points, P::zero()),
            on_a: pick(one.on_a, other.on_a),
            on_b: pick(one.on_b, other.on_b),
            at_a: one.at_a.join(other.at_a, keep, none),
            at_b: one.at_b.join(other.at_b, keep, none),
            behind_a: behind(other.at_a),
            behind_b: behind(other.at_b),
            lead: Vec3::select(other.value.above(one.value), other.normal, one.normal),
            area: one.area.most(other.area),
        }
    }
    /// Exchanges a and b.
    #[must_use]
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn flipped(self) -> Self {
        PartingPlane {
            normal: -self.normal,
            on_a: self.on_b,
            on_b: self.on_a,
            at_a: self.at_b,
            at_b: self.at_a,
            behind_a: self.behind_b,
            behind_b: self.behind_a,
            lead: -self.lead,
            ..self
        }
    }
    /// Removes the value where the mask is true: it becomes minus the largest number.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn unless(self, none: P::Mask) -> Self {
        PartingPlane {
            value: P::select(none, P::lowest(), self.value),
            ..self
        }
    }
}

/// The lowest edge of a core along a direction, or a neighbouring corner that is lower.
#[derive(Clone, Copy, Debug)]
pub struct Lowest<S: Scalar> {
    /// A point of the edge, or the corner.
    pub point: Vec3<S>,
    /// The spot of that.
    pub spot: Spot<S>,
    /// `true` if it is the edge.
    pub is_edge: S::Mask,
    /// The height of other corners below it by rounding; not positive.
    pub rest: S,
}

impl<S: Scalar> Lowest<S> {
    /// Returns an edge, of which a spot is known.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn edge(point: Vec3<S>, spot: Spot<S>) -> Self {
        let zero = S::zero();
        Lowest {
            point,
            spot,
            is_edge: zero.at_most(zero),
            rest: zero,
        }
    }
}
