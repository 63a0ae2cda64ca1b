//! Lines, rays and segments through convex shapes.
use super::lines::flag;
use super::met::met;
use crate::distance::beam::{Beam, Border};
use crate::distance::edge::{scale_of, size_of};
use crate::distance::share::Best;
use crate::distance::{Convex, Core};
use crate::scalar::Guard;
use crate::{Line2, Ray2, Scalar, Segment2, Vec2};

/// The chord of a line in a convex shape: the parameters of the line between which it is in the shape.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Chord<S> {
    /// The least of them; 0 where the line misses the shape, minus the largest finite number where the
    /// shape has no end.
    #[shape(number)]
    pub enter: S,
    /// The greatest of them; 0 where the line misses the shape, the largest finite number where the
    /// shape has no end.
    #[shape(number)]
    pub exit: S,
    /// 1 where the line meets the shape, 0 where it misses it. A constant.
    #[shape(number)]
    pub found: S,
}

/// The first point of a ray on the border of a shape.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit<S> {
    /// The parameter of the ray; the largest finite number for a miss.
    #[shape(number)]
    pub parameter: S,
    /// The point; the ray's start for a miss.
    pub point: Vec2<S>,
    /// The shape's normal there, of length one, out of the shape; zero for a miss and for a circle
    /// of radius zero.
    pub normal: Vec2<S>,
    /// 0 for a miss, 1 for a hit from outside, 2 from inside, where the ray leaves. A constant.
    #[shape(number)]
    pub kind: S,
}

/// The part of a line in a shape: both borders, and `true` if there is one.
struct LineSpan<S: Scalar> {
    enter: Border<S>,
    exit: Border<S>,
    found: S::Mask,
}

#[inline]
fn find<S: Scalar, A: Convex<S>>(line: Line2<S>, shape: A) -> LineSpan<S> {
    let core = shape.core();
    let anchor = core.anchor();
    let arm = line.point - anchor;
    let extent = core
        .extent(anchor)
        .most(size_of(arm))
        .most(shape.radius().primal());
    let scale = scale_of::<S>(extent);
    let length = line.direction.length();
    let length = S::select(length.at_most(S::zero()), S::one(), length);
    let beam = Beam {
        from: arm * scale,
        along: Vec2::new(line.direction.x.over(length), line.direction.y.over(length)),
    };
    let corners = core.corners();
    let core = core.placed(anchor, scale);
    let placed = core.corners();
    let radius = shape.radius() * scale;
    let mut inside = core.inside(beam, radius);
    if A::ROUND {
        inside = inside.round(beam, placed.as_ref(), radius);
    } else if A::Core::BOUNDED && A::Core::DIMENSION > 0 && !A::Core::SYMMETRIC {
        let all = (corners.as_ref(), placed.as_ref());
        inside = met(inside, (line, beam), all, (scale, length));
    }
    let found = !inside.is_empty() & size_of(line.direction).above(S::Primal::zero());
    let border = |best: Best<S, Border<S>>| {
        let endless = best.value.magnitude().at_least(S::largest());
        let mean = best.mean();
        let t = mean.t.over(scale).over(length).saturated();
        Border {
            t: S::select(endless, best.value, t),
            normal: mean.normal,
        }
    };
    LineSpan {
        enter: border(inside.enter),
        exit: border(inside.exit),
        found,
    }
}

/// Returns the parameters at which a line enters and leaves a convex shape. The border belongs to it.
///
/// Triangles, arrays of corners and segments are met where their corners are not all on one side of the line, by the
/// given numbers to some ε²: also where they are flat, or met in a corner alone. Other shapes are as their faces round: a
/// box that a line meets in a corner alone may be missed. A line without a direction meets nothing.
///
/// ```
/// use geograd::{Aabb2, Line2, Vec2, intersection::span};
/// let line = Line2::new(Vec2::new(-3.0, 1.0), Vec2::new(2.0, 0.0));
/// let found = span(line, Aabb2::new(-1.0, 0.0, 1.0, 2.0));
/// assert_eq!((found.enter, found.exit), (1.0, 2.0));
/// ```
#[must_use]
#[inline]
pub fn span<S: Scalar, A: Convex<S>>(line: Line2<S>, shape: A) -> Chord<S> {
    let inside = find(line, shape);
    let pick = |t: S| S::select(inside.found, t, S::zero()).canonical();
    shape.guarded(Guard::of(&line)).result(Chord {
        enter: pick(inside.enter.t),
        exit: pick(inside.exit.t),
        found: flag::<S>(inside.found),
    })
}

/// Returns the first point of a ray on the border of a convex shape: where it enters or, from inside, where it
/// leaves.
///
/// A start on the border is a hit from outside with parameter 0 if the ray enters there. A ray without a direction hits
/// nothing. The parameter has finite derivatives everywhere; they grow without bound as the ray comes to graze a round
/// border.
///
/// ```
/// use geograd::{Circle, Ray2, Vec2, intersection::first_hit};
/// let beam = Ray2::new(Vec2::new(-4.0, 0.0), Vec2::new(2.0, 0.0));
/// let hit = first_hit(beam, Circle::new(Vec2::new(0.0, 0.0), 1.0));
/// assert_eq!((hit.kind, hit.parameter, hit.normal), (1.0, 1.5, Vec2::new(-1.0, 0.0)));
/// assert_eq!(first_hit(beam, Circle::new(Vec2::new(0.0, 3.0), 1.0)).kind, 0.0);
/// ```
#[must_use]
#[inline]
pub fn first_hit<S: Scalar, A: Convex<S>>(ray: Ray2<S>, shape: A) -> Hit<S> {
    let inside = find(ray.line(), shape);
    let large = S::largest();
    let zero = S::zero();
    let ahead = |t: S| zero.at_most(t) & t.below(large);
    let enters = inside.found & ahead(inside.enter.t);
    let leaves = inside.found & inside.enter.t.below(zero) & ahead(inside.exit.t);
    let pick = |enter: S, exit: S, miss: S| S::select(enters, enter, S::select(leaves, exit, miss));
    let along = pick(inside.enter.t, inside.exit.t, zero);
    shape.guarded(Guard::of(&ray)).result(Hit {
        parameter: pick(inside.enter.t, inside.exit.t, large).canonical(),
        point: ray.point_at(along).canonical(),
        normal: Vec2::new(
            pick(inside.enter.normal.x, inside.exit.normal.x, zero),
            pick(inside.enter.normal.y, inside.exit.normal.y, zero),
        )
        .canonical(),
        kind: pick(S::one(), S::lit(2.0), zero),
    })
}

/// Returns the length of the part of a segment that lies in a convex shape, from 0 to the segment's own length;
/// the border belongs to the shape.
///
/// Derivative zero where the segment misses or only touches the shape. Kinks: an end on the border, where
/// the derivative is shared; a segment along a face, where the length jumps.
///
/// ```
/// use geograd::{Aabb2, Segment2, Vec2, intersection::length_inside};
/// let way = Segment2::new(Vec2::new(-3.0, 1.0), Vec2::new(0.5, 1.0));
/// assert_eq!(length_inside(way, Aabb2::new(-1.0, 0.0, 1.0, 2.0)), 1.5);
/// ```
#[must_use]
#[inline]
pub fn length_inside<S: Scalar, A: Convex<S>>(segment: Segment2<S>, shape: A) -> S {
    let inside = find(segment.line(), shape);
    let part = inside.exit.t.least(S::one()) - inside.enter.t.most(S::zero());
    let some = inside.found & part.above(S::zero());
    let length = S::select(some, part, S::zero()) * segment.length();
    shape
        .guarded(Guard::of(&segment))
        .result(length.canonical())
}
