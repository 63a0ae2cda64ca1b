//! The cores of convex shapes, and the faces and edges of one against the corners of another.
use super::beam::{Beam, Inside};
use super::edge::{Edge, reach, size_of};
use super::share::{Ahead, Best, Deepest, Nearest};
use crate::{Scalar, Vec2};

/// The core of a convex shape: the hull of some corners and of some directions in which it has no end. The cores are
/// those of the library's shapes: a user's shape has that of the library's shape it is like.
///
/// Two halves give every distance: the faces and edges of one core against the corners of the other, and the reverse.
#[doc(hidden)]
pub trait Core<S: Scalar>: Copy {
    /// The corners, in an array.
    type Corners: AsRef<[Vec2<S>]>;
    /// The directions without end, in an array.
    type Away: AsRef<[Vec2<S>]>;
    /// 0 for a point, 1 for a piece of a line, 2 for what has an area.
    const DIMENSION: usize;
    /// `true` if it ends in every direction.
    const BOUNDED: bool = true;
    /// `true` if it is a box, whose corners need not be compared to know the farthest one from a point.
    const SYMMETRIC: bool = false;
    /// Returns a point of it, or near it, to which the others are relative.
    fn anchor(&self) -> Vec2<S>;
    /// Returns the largest absolute coordinate of its corners relative to a point, as a constant.
    fn extent(&self, from: Vec2<S>) -> S::Primal;
    /// Returns the core relative to a point, in other units.
    #[must_use]
    fn placed(self, from: Vec2<S>, scale: S) -> Self;
    /// Returns the corners, around the core where there are more than two.
    fn corners(&self) -> Self::Corners;
    /// Returns the directions without end.
    fn away(&self) -> Self::Away;
    /// Returns the corner that is nearest to an edge of this core, and where.
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>>;
    /// Returns the largest squared distance of a corner of this core from one of others.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn far(&self, corners: &[Vec2<S>]) -> Best<S, S> {
        farthest(self.corners().as_ref(), corners)
    }
    /// Returns the part of a line inside of the core; for a piece of a line, inside of the strip of `radius` to both
    /// sides of it.
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S>;
    /// Returns the least of `normal · point` over the corners, and the corner.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec2<S>) -> Best<S, Ahead<S>> {
        Best::least(self.corners().as_ref().iter().map(|&on_b| {
            let ahead = normal.dot(on_b);
            Best::of(ahead, Ahead { ahead, on_b })
        }))
    }
    /// Returns the face that parts this core best from another one.
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>>;
}

/// Returns the largest squared distance of some corners from others.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn farthest<S: Scalar>(from: &[Vec2<S>], to: &[Vec2<S>]) -> Best<S, S> {
    Best::most_of(from.iter().flat_map(|&p| {
        to.iter().map(move |&q| {
            let square = (q - p).length_squared();
            Best::of(square, square)
        })
    }))
}

/// Returns the nearest of some corners to an edge.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn edge_near<S: Scalar>(edge: Edge<S>, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
    Best::least(corners.iter().map(|&corner| {
        let found = reach(edge, corner - edge.from);
        let on_self = edge.from + edge.along * found.t;
        Best::of(
            found.apart.length_squared(),
            Nearest {
                apart: found.apart,
                on_a: on_self,
                on_b: corner,
            },
        )
    }))
}

/// Returns the distance in front of a face at which another core begins. The normal points outwards and has length one,
/// or zero if the face has no length: such a face separates nothing.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn face_deep<S: Scalar, B: Core<S>>(
    face: Edge<S>,
    normal: Vec2<S>,
    other: &B,
) -> Best<S, Deepest<S>> {
    let first = other.lowest(normal);
    let none = normal.x.equals(S::zero()) & normal.y.equals(S::zero());
    let away = other.away();
    let useless = away.as_ref().iter().fold(none, |useless, direction| {
        useless | normal.dot(*direction).below(S::zero())
    });
    let height = normal.dot(face.from);
    // The middle of the corners that tie may lie beyond the end of the face, though some point between
    // them does not; or it lies before another face of the same line.
    let lowest = first.mean();
    let foot = reach(face, lowest.on_b - face.from);
    let on_a = face.from + face.along * foot.t;
    // Above the face the point itself is taken, since one computed from the face has only the face's digits.
    let above = foot.free.equals(foot.t);
    let beside = on_a + normal * (lowest.ahead - height);
    let beyond = (foot.free - foot.t).magnitude() * S::from_primal(size_of(face.along));
    let (low, high) = (face.low.halved(), face.high.halved());
    let middle = face.from + face.along * (low + high);
    let half = (high - low) * normal.perp_dot(face.along).unsigned();
    let value = S::select(useless, S::lowest(), first.value - height);
    Best {
        value,
        sum: Deepest {
            ahead: first.sum.ahead - height * first.count,
            level: value,
            normal,
            on_a,
            on_b: Vec2::select(above, lowest.on_b, beside),
            beyond,
            middle: Vec2::new(
                S::from_primal(middle.x.primal()),
                S::from_primal(middle.y.primal()),
            ),
            half: S::from_primal(half.primal()),
            lead: normal,
        },
        count: first.count,
    }
}
