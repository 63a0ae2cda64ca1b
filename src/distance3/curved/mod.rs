//! Distances of curved shapes of space: ellipsoids, cylinders, cones, discs, and own shapes by their support functions
//! ([`BySupport`]), from each other, from convex hulls, and from every shape that is the hull of a few corners with a
//! radius.
//!
//! Plain numbers decide which smooth pieces touch along the normal from one shape to the other: the side, a rim or an
//! end of a cylinder, the side, the rim, the base or the apex of a cone, the surface of an ellipsoid, a corner, an edge
//! or a face of the others. A search by supports gives the normal to some digits, Newton's step the normal and the
//! places to all of them, where the shapes are apart and where they overlap. The replay takes this step with
//! derivatives: first and second derivatives are those of the distance, by pose and by shape, and the normal and the
//! points have them, too.
//!
//! ```
//! use geograd::distance3::{penetration, signed_distance};
//! use geograd::{Cylinder, Ellipsoid, Rotation3, Vec3};
//! let can = Cylinder::new(Vec3::new(0.0_f64, 0.0, 0.0), Vec3::new(0.0, 0.0, 2.0), 1.0);
//! let egg = |x: f64| Ellipsoid::new(Vec3::new(x, 0.0, 1.0), Vec3::new(2.0, 1.0, 1.0), Rotation3::identity());
//! assert!((signed_distance(can, egg(4.0)) - 1.0).abs() < 1e-14);
//! let out = penetration(can, egg(2.5));
//! assert!((out.depth - 0.5).abs() < 1e-14 && (out.direction.x - 1.0).abs() < 1e-14);
//! ```
//!
//! Flat pieces that lie on each other have the derivative of the middle of their overlap. Of several directions that are
//! equally deep one counts. On the borders of pieces, such as a rim, the derivative belongs to one of them.
//!
//! The search decides in `f64`, also for `f32`. Numbers over other formats have no relation: it is zero.
mod bend;
mod by_normal;
mod by_support;
mod curved_replay;
mod curved_search;
mod expand;
mod grip;
mod hints;
mod hull_solid;
mod in_units;
mod level;
mod likely;
mod piece;
mod quick_search;
mod slopes_by_hand;
mod smooth_solid;
mod solid_pair;
mod support;
mod touch;
mod touching;

use super::apart::Apart;
use super::cored::InflatedCore;
use super::facing::{Patch, PatchName};
use super::half_space::Bounded;
use super::relation::{Relation, square_of_gap};
use crate::distance::edge::scale_of;
use crate::scalar::{Guard, noted};
use crate::shape::{
    Aabb3, Capsule3, Cone, Cylinder, Disc, Ellipsoid, Obb3, RoundBox3, Segment3, Tetrahedron,
    Triangle3, YawBox3,
};
use crate::{Pack, Scalar, Vec3};
pub use by_support::{BySupport, SupportFunction};
use curved_replay::{Pieces, replay};
use grip::Grip;
use hints::Hints;
pub(crate) use hints::{CurvedRecord, HINTS};
use piece::{Piece, Place};
pub(crate) use slopes_by_hand::curved_slopes;
use smooth_solid::{Solid, begins_by_x};
use support::Supported;
use touch::System;

/// A convex shape of space whose surface consists of smooth pieces, inflated by a radius.
pub(crate) trait Curved: Copy + Pack<Scalar: Scalar> {
    /// The shape in the units of a search.
    #[doc(hidden)]
    type Placed: Placed<Self::Scalar>;
    /// Returns a point of it, to which a pair is relative.
    fn anchor_point(&self) -> Vec3<Self::Scalar>;
    /// Returns its axis of rotation, if the shape has one.
    #[inline]
    fn axis(&self) -> Option<Vec3<Self::Scalar>> {
        None
    }
    /// Returns the largest magnitude of a coordinate relative to a point, or of a length.
    fn reach(&self, from: Vec3<Self::Scalar>) -> <Self::Scalar as Scalar>::Primal {
        self.in_units(from, Self::Scalar::one(), Self::Scalar::zero())
            .reach()
    }
    /// Returns the shape relative to a point, in other units. Directions across its axis begin by x where a number is
    /// one, by y where it is zero.
    fn in_units(
        &self,
        from: Vec3<Self::Scalar>,
        scale: Self::Scalar,
        by_x: Self::Scalar,
    ) -> Self::Placed;
    /// Returns the radius of the inflation, if it may be other than zero.
    #[inline]
    fn rounding(&self) -> Option<Self::Scalar> {
        None
    }
}

/// A shape in the units of a search.
pub(crate) trait Placed<S: Scalar>: Pieces<S> {
    /// The shape of plain numbers.
    type Plain: Supported;
    /// Returns the largest magnitude of a coordinate or length.
    fn reach(&self) -> S::Primal;
    /// Returns the place on a piece in the shape's own terms, given its number and the outer normal; `None` for a shape
    /// that has none.
    fn grip(&self, _k: usize, _place: &Place<S>, _normal: Vec3<S>) -> Option<Grip<S>> {
        None
    }
    /// Returns the shape of plain numbers; `None` where one is not finite.
    fn plain(&self) -> Option<Self::Plain>;
}

impl<S: Scalar> Pieces<S> for Solid<S> {
    fn piece_at(&self, k: usize, normal: Vec3<S>) -> Piece<S> {
        self.seen(k, normal, false)
    }
}

impl<S: Scalar> Placed<S> for Solid<S> {
    type Plain = Solid<f64>;
    fn reach(&self) -> S::Primal {
        Solid::reach(self)
    }
    fn grip(&self, k: usize, place: &Place<S>, normal: Vec3<S>) -> Option<Grip<S>> {
        Some(self.held(k, place, normal))
    }
    fn plain(&self) -> Option<Solid<f64>> {
        self.widened()
    }
}

/// Two shapes in the units of a search, and these units.
struct InSearch<S, A, B> {
    /// The point to which they are relative.
    from: Vec3<S>,
    scale: S,
    /// For each one if the directions across its axis begin with that across x, zero if across y.
    by_x: [S; 2],
    a: A,
    b: B,
}

impl<S: Scalar, A: Placed<S>, B: Placed<S>> InSearch<S, A, B> {
    /// Returns two shapes in units by the size of both.
    #[inline]
    fn new(
        a: &impl Curved<Scalar = S, Placed = A>,
        b: &impl Curved<Scalar = S, Placed = B>,
    ) -> Self {
        let from = a.anchor_point().constant();
        let begin = |axis: Option<Vec3<S>>| axis.map_or(S::zero(), begins_by_x);
        let by_x = [begin(a.axis()), begin(b.axis())];
        let reach = a.reach(from).most(b.reach(from));
        Self::by(a, b, scale_of::<S>(reach), by_x)
    }
    /// Returns two shapes in given units.
    #[inline]
    fn by(
        a: &impl Curved<Scalar = S, Placed = A>,
        b: &impl Curved<Scalar = S, Placed = B>,
        scale: S,
        by_x: [S; 2],
    ) -> Self {
        let from = a.anchor_point().constant();
        InSearch {
            from,
            scale,
            by_x,
            a: a.in_units(from, scale, by_x[0]),
            b: b.in_units(from, scale, by_x[1]),
        }
    }
    /// Returns the decisions about them and the hints of a search for their nearest points, or the farthest.
    #[inline]
    fn search(&self, farthest: bool) -> (CurvedRecord, [S; HINTS])
    where
        S: Scalar<Mask = bool>,
    {
        let (record, hints) = match self.a.plain().zip(self.b.plain()) {
            Some((of_a, of_b)) => decided(&of_a, &of_b, farthest, self.scale, self.by_x),
            None => hints::none(),
        };
        noted::<S::Primal>(1, [record.settled.into()]);
        noted::<S::Primal>(32, record.pieces.into_iter().flatten());
        (record, hints)
    }
    /// Returns the relation of the points that a search found; zero for shapes that are not finite.
    #[inline]
    fn related(
        &self,
        record: CurvedRecord,
        hints: &Hints<'_, S>,
        side: f64,
        has_points: bool,
    ) -> Relation<S> {
        let found = replay(&self.a, &self.b, record, hints, side, has_points);
        let back = S::one().over(self.scale);
        let apart = found.apart * back;
        Relation {
            apart,
            square: square_of_gap(apart),
            normal: found.normal,
            on_a: self.from + found.on_a * back,
            on_b: self.from + found.on_b * back,
        }
    }
}

/// Returns the decisions about two solids and the hints.
// All pairs of shapes share it.
#[inline(never)]
fn decided<S: Scalar>(
    a: &dyn Supported,
    b: &dyn Supported,
    farthest: bool,
    scale: S,
    by_x: [S; 2],
) -> (CurvedRecord, [S; HINTS]) {
    if !farthest && let Some((found, constants)) = curved_search::quick(a, b) {
        return hints::of(&found, &constants, scale, by_x);
    }
    let (found, side) = match farthest {
        true => (curved_search::search_farthest(a, b), -1.0),
        false => (curved_search::search(a, b), 1.0),
    };
    match found {
        Some(found) => {
            let found = found.replayed([a, b]);
            let [of_a, of_b] = solid_pair::pieces([a, b], &found, side);
            let system = System::new([&of_a, &of_b], &found.touch);
            hints::of(&found, &system.constants(), scale, by_x)
        }
        None => hints::none(),
    }
}

/// Returns the decisions about two shapes, and the hints of the search.
#[must_use]
pub(crate) fn curved_search<S, A, B>(a: &A, b: &B) -> (CurvedRecord, [S; HINTS])
where
    S: Scalar<Mask = bool>,
    A: Curved<Scalar = S>,
    B: Curved<Scalar = S>,
{
    InSearch::new(a, b).search(false)
}

/// Returns the relation of two shapes from the decisions and hints of [`curved_search`]. Normal and points are zero unless
/// they are asked for.
#[must_use]
pub(crate) fn curved_replay<S, A, B>(
    a: &A,
    b: &B,
    record: CurvedRecord,
    hints: &[S; HINTS],
    has_points: bool,
) -> Relation<S>
where
    S: Scalar,
    A: Curved<Scalar = S>,
    B: Curved<Scalar = S>,
{
    let hints = &Hints::load(hints);
    let both = InSearch::by(a, b, hints.scale, hints.by_x);
    inflated(a, b, both.related(record, hints, 1.0, has_points))
}

/// Returns the relation of two shapes from that of the solids which they inflate.
fn inflated<S, A, B>(a: &A, b: &B, found: Relation<S>) -> Relation<S>
where
    S: Scalar,
    A: Curved<Scalar = S>,
    B: Curved<Scalar = S>,
{
    match (a.rounding(), b.rounding()) {
        (None, None) => found,
        (p, q) => {
            let [p, q] = [p, q].map(|radius| radius.unwrap_or(S::zero()));
            found.inflated(p, q, found.normal)
        }
    }
}

/// Returns the relation of two shapes, without normal and points unless they are asked for.
fn relate<S, A, B>(a: A, b: B, has_points: bool) -> Relation<S>
where
    S: Scalar<Mask = bool>,
    A: Curved<Scalar = S>,
    B: Curved<Scalar = S>,
{
    let both = InSearch::new(&a, &b);
    let (record, hints) = both.search(false);
    let found = both.related(record, &Hints::load(&hints), 1.0, has_points);
    inflated(&a, &b, found)
}

/// Returns the longest distance of points of two shapes.
fn farthest<S, A, B>(a: A, b: B) -> S
where
    S: Scalar<Mask = bool>,
    A: Curved<Scalar = S>,
    B: Curved<Scalar = S>,
{
    let both = InSearch::new(&a, &b);
    let (record, hints) = both.search(true);
    let longest = both
        .related(record, &Hints::load(&hints), -1.0, false)
        .apart;
    let none = longest.at_most(S::zero());
    let radii = [a.rounding(), b.rounding()].map(|radius| radius.unwrap_or(S::zero()));
    let longest = if none { S::zero() } else { longest };
    (longest + (radii[0] + radii[1])).canonical()
}

macro_rules! apart {
    ($([$($generic:tt)*] $A:ty, $B:ty $(where $($bound:tt)*)?;)*) => { $(
        impl<S: Scalar<Mask = bool>, $($generic)*> Apart<$B> for $A $(where $($bound)*)? {
            type Scalar = S;
            #[inline]
            fn guarded_with(&self, other: &$B) -> Guard<S> {
                Guard::of(self).and(other)
            }
            #[inline]
            fn relation(self, other: $B) -> Relation<S> {
                relate(self, other, true)
            }
            #[inline]
            fn relation_without_points(self, other: $B) -> Relation<S> {
                relate(self, other, false)
            }
            #[inline]
            fn facing(&self, other: &$B, normal: Vec3<S>) -> [PatchName; 2] {
                [self.face(normal), other.face(-normal)]
            }
            fn patches(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                [self.patch(a, normal), other.patch(b, -normal)]
            }
            #[inline]
            fn farthest(self, other: $B) -> S {
                farthest(self, other)
            }
        }
    )* };
}
macro_rules! both {
    ($($A:ident: $($B:ident)*;)*) => { $($(
        apart! { [] $A<S>, $B<S>; [] $B<S>, $A<S>; }
    )*)* };
}
both! {
    Ellipsoid: Disc Cylinder Cone;
    Disc: Cylinder Cone;
    Cylinder: Cone Segment3 Capsule3 Triangle3 Tetrahedron Aabb3 YawBox3 Obb3 RoundBox3;
    Cone: Segment3 Capsule3 Triangle3 Tetrahedron Aabb3 YawBox3 Obb3 RoundBox3;
}
apart! {
    [] Ellipsoid<S>, Ellipsoid<S>;
    [] Disc<S>, Disc<S>;
    [] Cylinder<S>, Cylinder<S>;
    [] Cone<S>, Cone<S>;
    [A: InflatedCore<Scalar = S>] A, Ellipsoid<S>;
    [A: InflatedCore<Scalar = S>] A, Disc<S>;
    [B: InflatedCore<Scalar = S>] Ellipsoid<S>, B;
    [B: InflatedCore<Scalar = S>] Disc<S>, B;
}
