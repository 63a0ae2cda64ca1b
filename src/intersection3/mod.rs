//! Rays, lines and segments against shapes of space: first hits, chords, lengths inside.
//!
//! | function | gives |
//! | --- | --- |
//! | [`first_hit`] | where a ray first meets the surface of a convex solid |
//! | [`first_hit_triangle`] | where a ray meets a triangle |
//! | [`first_hit_of_segment`] | where a segment meets a triangle |
//! | [`span`] | the parameters at which a line enters and leaves a convex solid |
//! | [`length_inside`] | how much of a segment lies in a convex solid |
//! | [`crossing_of_two_planes`] | the line of two planes |
//! | [`crossing_of_three_planes`] | the point of three planes |
//!
//! Solids are half-spaces ([`Plane3`](crate::Plane3)), [`Sphere`](crate::Sphere), the boxes,
//! [`RoundBox3`](crate::RoundBox3), [`Capsule3`](crate::Capsule3), [`Cylinder`](crate::Cylinder),
//! [`Cone`](crate::Cone) and [`Tetrahedron`](crate::Tetrahedron).
//!
//! Batches of [`FirstHit`](crate::kernels::verbs::FirstHit) and [`LengthInside`](crate::kernels::verbs::LengthInside)
//! take the pairs that have a row (the table of [`verbs`](crate::kernels::verbs)); others run by
//! [`function`](crate::kernels::verbs::function).
//!
//! A whole number in the result is 0 without a hit, so that results are shapes like any other. A miss is finite, with
//! derivative zero. Values and derivatives are finite where every length and coordinate is zero or of a magnitude from
//! 2⁻²⁰ to 2²⁰ in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Derivatives: with n the normal at the hit and d the direction, the parameter falls by n · v / (n · d) as the surface
//! moves by −v or the ray by v. Kinks: silhouettes, where the ray grazes a solid and the hit jumps; directions that are
//! parallel to a face; hits of an edge, where the faces share the derivative of the parameter and the first one gives
//! the normal. Directions whose sine is below ε² count as parallel to a face of a solid.
use crate::distance::edge::scale_of;
use crate::distance::share::Best;
use crate::intersection::Chord;
use crate::scalar::Guard;
use crate::shape::{Line3, Ray3, Segment3};
use crate::{Scalar, Vec3};

mod cone;
pub mod inside;
pub mod pierced;
pub mod planes;
mod tetrahedron;
mod triangle;

use crate::distance3::near::size_of;
use inside::{Beam, Border};
pub use pierced::Pierced;
pub use planes::{CommonLine3, CommonPoint3, crossing_of_three_planes, crossing_of_two_planes};
pub use triangle::{first_hit_of_segment, first_hit_triangle};

/// The first point of a ray on the surface of a shape of space.
#[derive(Clone, Copy, Debug, PartialEq, crate::Shape)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit3<S> {
    /// The parameter of the ray; the largest finite number for a miss.
    #[shape(number)]
    pub parameter: S,
    /// The point; the ray's start for a miss.
    pub point: Vec3<S>,
    /// The shape's normal there, of length one, out of the shape, of a triangle towards the side that the ray comes
    /// from; zero for a miss, at the apex of a cone, for a radius of zero, and for a tetrahedron seen as a segment or a
    /// point.
    #[shape(direction)]
    pub normal: Vec3<S>,
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
fn find<S: Scalar, A: Pierced<Scalar = S>>(line: Line3<S>, shape: A) -> LineSpan<S> {
    let arm = line.point - shape.anchor();
    let scale = scale_of::<S>(shape.extent().most(size_of(arm)));
    let size = scale_of::<S>(size_of(line.direction));
    let beam = Beam {
        from: arm * scale,
        along: line.direction * size,
    };
    let inside = shape.inside(beam, scale);
    let border = |best: Best<S, Border<S>>| {
        let endless = best.value.magnitude().at_least(S::largest());
        let mean = best.mean();
        let t = (mean.t * size).over(scale).saturated();
        Border {
            t: S::select(endless, best.value, t),
            normal: mean.normal.normalize_or_zero(),
        }
    };
    LineSpan {
        enter: border(inside.enter),
        exit: border(inside.exit),
        found: !inside.is_empty() & size_of(line.direction).above(S::Primal::zero()),
    }
}

/// Returns the parameters at which a line of space enters and leaves a convex solid. The surface belongs to it.
///
/// ```
/// use geograd::{Line3, Sphere, Vec3, intersection3::span};
/// let line = Line3::new(Vec3::new(-3.0, 1.0, 0.0), Vec3::new(2.0, 0.0, 0.0));
/// let found = span(line, Sphere::new(Vec3::new(1.0, 1.0, 0.0), 2.0));
/// assert_eq!((found.enter, found.exit), (1.0, 3.0));
/// ```
#[must_use]
#[inline]
pub fn span<S: Scalar, A: Pierced<Scalar = S>>(line: Line3<S>, shape: A) -> Chord<S> {
    let inside = find(line, shape);
    let pick = |t: S| S::select(inside.found, t, S::zero()).canonical();
    Guard::of(&line).and(&shape).result(Chord {
        enter: pick(inside.enter.t),
        exit: pick(inside.exit.t),
        found: pick(S::one()),
    })
}

/// Returns the first point of a ray on the surface of a convex solid: where it enters or, from inside, where it leaves.
///
/// A start on the surface is a hit from outside with parameter 0 if the ray enters there. A ray without a direction
/// hits nothing. The parameter has finite derivatives everywhere; they grow without bound as the ray comes to graze a round
/// surface.
///
/// Solids without a volume are hit, too. A line meets the border of a tetrahedron if it passes within its rounding,
/// some ε of the distance to the farthest corner. Thin and flat ones are therefore hit, edge-on, too. The chord of a
/// flat one is one point, at which all faces share the derivative. A ray through the apex of a cone within rounding
/// hits the apex; the slope there is the middle of those to its sides.
///
/// ```
/// use geograd::{Cylinder, Ray3, Vec3, intersection3::first_hit};
/// let can = Cylinder::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0), 1.0);
/// let beam = Ray3::new(Vec3::new(-4.0, 0.0, 1.0), Vec3::new(2.0, 0.0, 0.0));
/// let hit = first_hit(beam, can);
/// assert_eq!((hit.kind, hit.parameter, hit.normal), (1.0, 1.5, Vec3::new(-1.0, 0.0, 0.0)));
/// assert_eq!(first_hit(Ray3::new(Vec3::new(-4.0, 0.0, 3.0), beam.direction), can).kind, 0.0);
/// ```
#[must_use]
#[inline]
pub fn first_hit<S: Scalar, A: Pierced<Scalar = S>>(ray: Ray3<S>, shape: A) -> Hit3<S> {
    let inside = find(ray.line(), shape);
    let (large, zero) = (S::largest(), S::zero());
    let ahead = |t: S| zero.at_most(t) & t.below(large);
    let enters = inside.found & ahead(inside.enter.t);
    let leaves = inside.found & inside.enter.t.below(zero) & ahead(inside.exit.t);
    let pick = |enter: S, exit: S, miss: S| S::select(enters, enter, S::select(leaves, exit, miss));
    let along = pick(inside.enter.t, inside.exit.t, zero);
    let normal = Vec3::select(leaves, inside.exit.normal, Vec3::zero());
    Guard::of(&ray).and(&shape).result(Hit3 {
        parameter: pick(inside.enter.t, inside.exit.t, large).canonical(),
        point: ray.point_at(along).canonical(),
        normal: Vec3::select(enters, inside.enter.normal, normal).canonical(),
        kind: pick(S::one(), S::lit(2.0), zero),
    })
}

/// Returns the length of the part of a segment of space that lies in a convex solid, from 0 to the segment's own
/// length; the surface belongs to the solid.
///
/// Derivative zero where the segment misses or only touches the solid. Kinks: an end on the surface, where the
/// derivative is shared; a segment along a face, where the length jumps.
///
/// ```
/// use geograd::{Aabb3, Segment3, Vec3, intersection3::length_inside};
/// let way = Segment3::new(Vec3::new(-3.0, 1.0, 1.0), Vec3::new(0.5, 1.0, 1.0));
/// let room = Aabb3::new(Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 2.0, 2.0));
/// assert_eq!(length_inside(way, room), 1.5);
/// ```
#[must_use]
#[inline]
pub fn length_inside<S: Scalar, A: Pierced<Scalar = S>>(segment: Segment3<S>, shape: A) -> S {
    let inside = find(Line3::through(segment.start, segment.end), shape);
    let part = inside.exit.t.least(S::one()) - inside.enter.t.most(S::zero());
    let some = inside.found & part.above(S::zero());
    let length = S::select(some, part, S::zero()) * segment.length();
    Guard::of(&segment).and(&shape).result(length.canonical())
}
