//! Relations of two shapes of space as a search with a replay, on which operations build that have one.
use super::core::PointCore;
use super::cored::InflatedCore;
use super::curved::{CurvedRecord, HINTS, curved_replay, curved_search};
use super::facing::{Patch, PatchName};
use super::half_space::Bounded;
use super::hulls::{HullRecord, hulls_replay, hulls_search};
use super::relation::Relation;
use crate::shape::{Cone, Cylinder, Disc, Ellipsoid, Hull3, Plane3};
use crate::{
    Aabb3, Capsule3, Fixed, Obb3, Pack, RoundBox3, Scalar, Segment3, Tetrahedron, Triangle3, Vec3,
    YawBox3,
};
use std::hash::Hash;

/// Two shapes whose relation has decisions on plain numbers, hints of these, and a replay for any scalar.
pub trait Decided<B>: Copy + Pack<Scalar: Scalar> {
    /// The decisions.
    type Decisions: Copy + Eq + Hash + Send + Sync + std::fmt::Debug + 'static;
    /// The hints: numbers of the search without derivatives.
    type Hints: Fixed<Scalar = Self::Scalar>;
    /// Returns the decisions and the hints.
    fn decided(&self, other: &B) -> (Self::Decisions, Self::Hints)
    where
        Self::Scalar: Scalar<Mask = bool>;
    /// Returns the relation from these.
    fn replayed(
        &self,
        other: &B,
        decisions: &Self::Decisions,
        hints: &Self::Hints,
    ) -> Relation<Self::Scalar>;
    /// Returns the faces of both by their names, given the direction from the first to the second.
    fn named(
        &self,
        other: &B,
        names: [PatchName; 2],
        normal: Vec3<Self::Scalar>,
    ) -> [Patch<Self::Scalar>; 2];
    /// Returns `false` if a number, by its place in the first shape and then the second, has no part in the replay.
    #[must_use]
    fn is_read(_decisions: &Self::Decisions, _place: usize) -> bool {
        true
    }
}

/// Relations that are straight lines, without a decision.
macro_rules! straight {
    (@face ends $shape:ident, $name:ident, $normal:expr) => { $shape.patch($name, $normal) };
    (@face plane $shape:ident, $name:ident, $normal:expr) => { Patch::Plane };
    ($([$($generic:tt)*] $A:ty, $B:ty => $first:ident $second:ident;)*) => { $(
        impl<S: Scalar, $($generic)*> Decided<$B> for $A {
            type Decisions = ();
            type Hints = [S; 0];
            #[inline]
            fn decided(&self, _: &$B) -> ((), [S; 0]) {
                ((), [])
            }
            // Not inlined: it is long, and every unit of code that may inline it has a copy.
            fn replayed(&self, other: &$B, (): &(), []: &[S; 0]) -> Relation<S> {
                use super::apart::Apart as _;
                self.relation(*other)
            }
            fn named(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                let _ = (a, b, other);
                [straight!(@face $first self, a, normal), straight!(@face $second other, b, -normal)]
            }
        }
    )* };
}
straight! {
    [A: InflatedCore<Scalar = S>, B: InflatedCore<Scalar = S>] A, B => ends ends;
    [A: InflatedCore<Scalar = S, Core = PointCore<S>>] A, Cylinder<S> => ends ends;
    [A: InflatedCore<Scalar = S, Core = PointCore<S>>] A, Cone<S> => ends ends;
    [B: InflatedCore<Scalar = S, Core = PointCore<S>>] Cylinder<S>, B => ends ends;
    [B: InflatedCore<Scalar = S, Core = PointCore<S>>] Cone<S>, B => ends ends;
    [B: Bounded<Scalar = S>] Plane3<S>, B => plane ends;
    [A: Bounded<Scalar = S>] A, Plane3<S> => ends plane;
}

/// Returns `true` if features have the corner of a number, by its place in two shapes of which hulls have `3 N` numbers.
fn names(record: &HullRecord, place: usize, first: usize, hulls: [bool; 2]) -> bool {
    match (place.checked_sub(first), hulls) {
        (None, [true, _]) => record.names([Some(place / 3), None]),
        (Some(place), [_, true]) => record.names([None, Some(place / 3)]),
        _ => true,
    }
}

/// Relations of hulls.
macro_rules! hulls {
    ($([$($generic:tt)*] $A:ty, $B:ty, $first:expr, $hulls:expr;)*) => { $(
        impl<S: Scalar, $($generic)*> Decided<$B> for $A {
            type Decisions = HullRecord;
            type Hints = [S; 0];
            fn decided(&self, other: &$B) -> (HullRecord, [S; 0])
            where
                S: Scalar<Mask = bool>,
            {
                (hulls_search(self, other), [])
            }
            fn replayed(&self, other: &$B, record: &HullRecord, []: &[S; 0]) -> Relation<S> {
                hulls_replay(self, other, record)
            }
            fn named(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                [self.patch(a, normal), other.patch(b, -normal)]
            }
            fn is_read(record: &HullRecord, place: usize) -> bool {
                names(record, place, $first, $hulls)
            }
        }
    )* };
}
hulls! {
    [A: InflatedCore<Scalar = S> + Fixed, const N: usize] A, Hull3<S, N>, A::LEN, [false, true];
    [B: InflatedCore<Scalar = S>, const N: usize] Hull3<S, N>, B, 3 * N, [true, false];
    [const N: usize, const M: usize] Hull3<S, N>, Hull3<S, M>, 3 * N, [true; 2];
}

/// Relations of curved shapes.
macro_rules! curved {
    ($([$($generic:tt)*] $A:ty, $B:ty;)*) => { $(
        impl<S: Scalar, $($generic)*> Decided<$B> for $A {
            type Decisions = CurvedRecord;
            type Hints = [S; HINTS];
            fn decided(&self, other: &$B) -> (CurvedRecord, [S; HINTS])
            where
                S: Scalar<Mask = bool>,
            {
                curved_search(self, other)
            }
            fn replayed(&self, other: &$B, record: &CurvedRecord, hints: &[S; HINTS]) -> Relation<S> {
                curved_replay(self, other, *record, hints, true)
            }
            fn named(&self, other: &$B, [a, b]: [PatchName; 2], normal: Vec3<S>) -> [Patch<S>; 2] {
                [self.patch(a, normal), other.patch(b, -normal)]
            }
        }
    )* };
}
macro_rules! both {
    ($($A:ident: $($B:ident)*;)*) => { $($(
        curved! { [] $A<S>, $B<S>; [] $B<S>, $A<S>; }
    )*)* };
}
both! {
    Ellipsoid: Disc Cylinder Cone;
    Disc: Cylinder Cone;
    Cylinder: Cone Segment3 Capsule3 Triangle3 Tetrahedron Aabb3 YawBox3 Obb3 RoundBox3;
    Cone: Segment3 Capsule3 Triangle3 Tetrahedron Aabb3 YawBox3 Obb3 RoundBox3;
}
curved! {
    [] Ellipsoid<S>, Ellipsoid<S>;
    [] Disc<S>, Disc<S>;
    [] Cylinder<S>, Cylinder<S>;
    [] Cone<S>, Cone<S>;
    [A: InflatedCore<Scalar = S>] A, Ellipsoid<S>;
    [A: InflatedCore<Scalar = S>] A, Disc<S>;
    [B: InflatedCore<Scalar = S>] Ellipsoid<S>, B;
    [B: InflatedCore<Scalar = S>] Disc<S>, B;
    [const N: usize] Ellipsoid<S>, Hull3<S, N>;
    [const N: usize] Disc<S>, Hull3<S, N>;
    [const N: usize] Cylinder<S>, Hull3<S, N>;
    [const N: usize] Cone<S>, Hull3<S, N>;
    [const N: usize] Hull3<S, N>, Ellipsoid<S>;
    [const N: usize] Hull3<S, N>, Disc<S>;
    [const N: usize] Hull3<S, N>, Cylinder<S>;
    [const N: usize] Hull3<S, N>, Cone<S>;
}
