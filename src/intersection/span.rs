//! Lines, rays and segments through convex shapes.
use super::lines::flag;
use crate::distance::convex::{Convex, Core, unit};
use crate::distance::edge::{scale_of, size_of};
use crate::distance::share::{Best, Carry};
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

/// A parameter and the normal at it. If several tie, the parameter shares the derivative and the first normal is
/// taken.
#[derive(Clone, Copy, Debug)]
struct Border<S> {
    t: S,
    normal: Vec2<S>,
}

impl<S: Scalar> Carry<S> for Border<S> {
    #[inline(always)]
    fn join(self, other: Self, keep: S::Mask, tie: S::Mask) -> Self {
        Border {
            t: self.t.join(other.t, keep, tie),
            normal: Vec2::select(keep | tie, self.normal, other.normal),
        }
    }
    #[inline(always)]
    fn times(self, factor: S) -> Self {
        Border {
            t: self.t * factor,
            normal: self.normal,
        }
    }
}

/// A line with a direction of length one, seen from the shape's anchor in units of its extent.
#[derive(Clone, Copy, Debug)]
pub struct Beam<S> {
    from: Vec2<S>,
    along: Vec2<S>,
}

/// The range of a beam inside a convex piece: where it enters and where it leaves. It is empty if the beam enters
/// at the largest number and leaves at the smallest.
#[derive(Clone, Copy, Debug)]
pub struct Inside<S> {
    enter: Best<S, Border<S>>,
    exit: Best<S, Border<S>>,
}

impl<S: Scalar> Inside<S> {
    #[inline(always)]
    fn new(enter: Border<S>, exit: Border<S>) -> Self {
        Inside {
            enter: Best::of(enter.t, enter),
            exit: Best::of(exit.t, exit),
        }
    }
    /// From one end of the line to the other.
    #[inline(always)]
    pub fn everywhere() -> Self {
        let end = |t: f64| Border {
            t: S::lit(t),
            normal: Vec2::zero(),
        };
        Inside::new(end(-S::LARGEST), end(S::LARGEST))
    }
    /// Nowhere where the mask says so, or where it would leave before it enters.
    #[inline(always)]
    fn unless(mut self, empty: S::Mask) -> Self {
        let empty = empty | self.exit.value.below(self.enter.value);
        let large = S::lit(S::LARGEST);
        self.enter.value = S::select(empty, large, self.enter.value);
        self.exit.value = S::select(empty, -large, self.exit.value);
        self
    }
    #[inline(always)]
    fn is_empty(&self) -> S::Mask {
        self.exit.value.below(self.enter.value)
    }
    /// Cut by the half-plane behind a face; a face without a normal cuts nothing.
    #[inline(always)]
    pub fn behind(self, beam: Beam<S>, point: Vec2<S>, normal: Vec2<S>) -> Self {
        let ahead = normal.dot(beam.from - point);
        let rate = normal.dot(beam.along);
        let parallel = rate.magnitude().at_most(S::lit(S::EPSILON.powi(2)));
        let safe = S::select(parallel, S::one(), rate);
        let t = (-ahead).over(safe);
        let large = S::lit(S::LARGEST);
        let enters = !parallel & rate.below(S::zero());
        let leaves = !parallel & S::zero().below(rate);
        let border = Border { t, normal };
        let mut enter = Best::of(t, border);
        enter.value = S::select(enters, t, -large);
        let mut exit = Best::of(t, border);
        exit.value = S::select(leaves, t, large);
        Inside {
            enter: self.enter.most(enter),
            exit: self.exit.less(exit),
        }
        .unless(self.is_empty() | (parallel & ahead.above(S::zero())))
    }
    /// Both pieces of a convex whole.
    #[inline(always)]
    pub fn joined(self, other: Self) -> Self {
        Inside {
            enter: self.enter.less(other.enter),
            exit: self.exit.most(other.exit),
        }
    }
    /// In a disc.
    #[inline(always)]
    pub fn disc(beam: Beam<S>, center: Vec2<S>, radius: S) -> Self {
        let arm = beam.from - center;
        let aside = beam.along.perp_dot(arm);
        let square = (radius - aside) * (radius + aside);
        let (middle, half) = (-arm.dot(beam.along), square.root());
        let point = radius.at_most(S::zero());
        let safe = S::select(point, S::one(), radius);
        let border = |t: S| {
            let out = arm + beam.along * t;
            let normal = Vec2::new(out.x.over(safe), out.y.over(safe));
            Border {
                t,
                normal: Vec2::select(point, Vec2::zero(), normal),
            }
        };
        Inside::new(border(middle - half), border(middle + half)).unless(square.below(S::zero()))
    }
    /// In the rectangle over an edge, that far to both sides. The edge may lack its start or its end.
    #[inline(always)]
    pub fn strip(
        beam: Beam<S>,
        from: Vec2<S>,
        along: Vec2<S>,
        radius: S,
        starts: bool,
        ends: bool,
    ) -> Self {
        let ahead = unit(along);
        let normal = ahead.perp();
        let none = ahead.x.equals(S::zero()) & ahead.y.equals(S::zero());
        let mut inside = Inside::everywhere()
            .behind(beam, from + normal * radius, normal)
            .behind(beam, from - normal * radius, -normal);
        if starts {
            inside = inside.behind(beam, from, -ahead);
        }
        if ends {
            inside = inside.behind(beam, from + along, ahead);
        }
        inside.unless(none)
    }
    /// In a convex polygon, counter-clockwise, or in what is left of it where it is flat.
    #[inline(always)]
    pub fn polygon(beam: Beam<S>, corners: &[Vec2<S>]) -> Self {
        let n = corners.len();
        let mut inside = Inside::everywhere();
        for i in 0..n {
            let along = corners[(i + 1) % n] - corners[i];
            let normal = -unit(along.perp());
            inside = inside.behind(beam, corners[i], normal);
        }
        // The faces of a flat polygon do not say where it ends; its bounds do. The bounds of other polygons would
        // share the derivative of faces along an axis.
        let (mut twice, mut reach) = (S::zero(), S::zero());
        for i in 1..n {
            let way = corners[i] - corners[0];
            reach += way.length_squared();
            twice += way.perp_dot(corners[(i + 1) % n] - corners[0]);
        }
        let flat = twice.at_most(reach * S::lit(4.0 * S::EPSILON));
        let bounds = |pick: fn(Vec2<S>, Vec2<S>) -> Vec2<S>| {
            corners[1..].iter().fold(corners[0], |x, &y| pick(x, y))
        };
        let (min, max) = (bounds(Vec2::least), bounds(Vec2::most));
        let one = S::select(flat, S::one(), S::zero());
        let (right, up) = (Vec2::new(one, S::zero()), Vec2::new(S::zero(), one));
        let bounded = inside
            .behind(beam, max, right)
            .behind(beam, max, up)
            .behind(beam, min, -right)
            .behind(beam, min, -up);
        // If both are equal, the faces count: the line crosses these.
        let crossed = |faces: Best<S, Border<S>>, bounds: Best<S, Border<S>>| {
            let same = faces.value.equals(bounds.value);
            let never = S::one().below(S::zero());
            Best {
                value: bounds.value,
                sum: faces.sum.join(bounds.sum, same, never),
                count: S::select(same, faces.count, bounds.count),
            }
        };
        // A point has no face at all: it is where its projection is.
        let point = reach.equals(S::zero());
        let middle = corners.iter().fold(Vec2::zero(), |sum, &c| sum + c) * S::lit(1.0 / n as f64);
        let middle = beam.along.dot(middle - beam.from);
        let projected = |mut best: Best<S, Border<S>>| {
            best.sum.t = S::select(point, middle * best.count, best.sum.t);
            best
        };
        Inside {
            enter: projected(crossed(inside.enter, bounded.enter)),
            exit: projected(crossed(inside.exit, bounded.exit)),
        }
    }
    /// In a hull of corners, inflated by a radius.
    #[inline(always)]
    pub fn round(self, beam: Beam<S>, corners: &[Vec2<S>], radius: S) -> Self {
        let n = corners.len();
        let mut inside = self;
        for i in 0..n {
            let along = corners[(i + 1) % n] - corners[i];
            if n > 2 {
                let strip = Inside::strip(beam, corners[i], along, radius, true, true);
                inside = inside.joined(strip);
            }
            inside = inside.joined(Inside::disc(beam, corners[i], radius));
        }
        inside
    }
}

/// A line in a shape: the parameters, normals and whether it is.
struct Found<S: Scalar> {
    enter: Border<S>,
    exit: Border<S>,
    found: S::Mask,
}

#[inline]
fn find<S: Scalar, A: Convex<S>>(line: Line2<S>, shape: A) -> Found<S> {
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
    let core = core.placed(anchor, scale);
    let radius = shape.radius() * scale;
    let mut inside = core.inside(beam, radius);
    if A::ROUND {
        inside = inside.round(beam, core.corners().as_ref(), radius);
    }
    let found = !inside.is_empty();
    let border = |best: Best<S, Border<S>>| {
        let endless = best.value.magnitude().at_least(S::lit(S::LARGEST));
        let mean = best.mean();
        let t = mean.t.over(scale).over(length).saturated();
        Border {
            t: S::select(endless, best.value, t),
            normal: mean.normal,
        }
    };
    Found {
        enter: border(inside.enter),
        exit: border(inside.exit),
        found,
    }
}

/// The parameters at which a line enters and leaves a convex shape. The border belongs to it.
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
    Chord {
        enter: pick(inside.enter.t),
        exit: pick(inside.exit.t),
        found: flag::<S>(inside.found),
    }
}

/// The first point of a ray on the border of a convex shape: where it enters or, from inside, where it
/// leaves.
///
/// A start on the border is a hit from outside with parameter 0 if the ray enters there. The parameter
/// has finite derivatives everywhere; they grow without bound as the ray comes to graze a round border.
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
    let large = S::lit(S::LARGEST);
    let zero = S::zero();
    let ahead = |t: S| zero.at_most(t) & t.below(large);
    let enters = inside.found & ahead(inside.enter.t);
    let leaves = inside.found & inside.enter.t.below(zero) & ahead(inside.exit.t);
    let pick = |enter: S, exit: S, miss: S| S::select(enters, enter, S::select(leaves, exit, miss));
    let along = pick(inside.enter.t, inside.exit.t, zero);
    Hit {
        parameter: pick(inside.enter.t, inside.exit.t, large).canonical(),
        point: ray.point_at(along),
        normal: Vec2::new(
            pick(inside.enter.normal.x, inside.exit.normal.x, zero),
            pick(inside.enter.normal.y, inside.exit.normal.y, zero),
        )
        .canonical(),
        kind: pick(S::one(), S::lit(2.0), zero),
    }
}

/// The length of the part of a segment that lies in a convex shape, from 0 to the segment's own length;
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
    (S::select(some, part, S::zero()) * segment.length()).canonical()
}
