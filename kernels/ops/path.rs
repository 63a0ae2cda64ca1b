//! Folds over paths as operations.
use crate::distance::ring::{EdgeFold, Fill};
use crate::kernels::row::fold::Fold;
use crate::intersection::edge_inside;
use crate::kernels::row::op::{Declared, Declares, Jumps, Range};
use crate::kernels::ops::class::invariances;
use crate::kernels::ops::walk::Written;
use crate::kernels::ops::tables::listed;
use crate::kernels::verbs::{
    self, Depth, Distance, Length, LengthInside, SignedDistance, Winding,
};
use crate::measure::moments::{AreaMoments, Sums, finish, of_edge};
use crate::reference::{Reference, bounds_of};
use crate::{Aabb2, Scalar, Segment2, Vec2};

/// The [second moments](crate::measure::moments::second_moments) of a ring's area about its centroid.
/// They jump where the area is zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SecondMomentsOfRing;

impl Declares for SecondMomentsOfRing {
    const DECLARED: Declared = Declared::new("second_moments_of_ring", invariances!([rigid(4), along_axes] Vec2<f64>), Jumps::Anywhere)
        .doc("The [second moments](crate::measure::moments::second_moments) of a ring's area about its centroid.");
}

impl Fold for SecondMomentsOfRing {
    const CLOSED: bool = true;
    type Element<S: Scalar> = Vec2<S>;
    type Context<S: Scalar> = [S; 0];
    type Reference<S: Scalar> = Reference<S>;
    type State<S: Scalar> = Sums<S>;
    type Out<S: Scalar> = AreaMoments<S>;
    fn reference<S: Scalar>(_: [S; 0], ring: &[Vec2<S>]) -> Reference<S> {
        let nothing = Aabb2 {
            min: Vec2::zero(),
            max: Vec2::zero(),
        };
        Reference::of_moments(bounds_of(ring).unwrap_or(nothing))
    }
    fn empty<S: Scalar>() -> Sums<S> {
        [S::zero(); 6]
    }
    fn edge<S: Scalar>(_: [S; 0], seen: Reference<S>, from: Vec2<S>, to: Vec2<S>) -> Sums<S> {
        of_edge(seen.place(from), seen.place(to))
    }
    fn join<S: Scalar>(one: Sums<S>, other: Sums<S>) -> Sums<S> {
        std::array::from_fn(|k| one[k] + other[k])
    }
    fn finish<S: Scalar>(_: [S; 0], seen: Reference<S>, sums: Sums<S>) -> AreaMoments<S> {
        finish(sums, &seen)
    }
}

/// The length of a polyline: the sum of the distances of neighbouring vertices. Derivative zero at edges of
/// length zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LengthOfPolyline;

impl Declares for LengthOfPolyline {
    const DECLARED: Declared = Declared::new("length_of_polyline", invariances!([rigid(1)] Vec2<f64>), Jumps::Never)
        .doc("The length of a polyline: the sum of the distances of neighbouring vertices.");
}

impl Fold for LengthOfPolyline {
    const CLOSED: bool = false;
    type Element<S: Scalar> = Vec2<S>;
    type Context<S: Scalar> = [S; 0];
    type Reference<S: Scalar> = [S; 0];
    type State<S: Scalar> = S;
    type Out<S: Scalar> = S;
    const IS_LENGTH: bool = true;
    fn in_plane<S: Scalar>(path: &[Vec2<S>]) -> &[Vec2<S>] {
        path
    }
    fn reference<S: Scalar>(_: [S; 0], _path: &[Vec2<S>]) -> [S; 0] {
        []
    }
    fn empty<S: Scalar>() -> S {
        S::zero()
    }
    fn edge<S: Scalar>(_: [S; 0], _: [S; 0], from: Vec2<S>, to: Vec2<S>) -> S {
        (to - from).length()
    }
    fn join<S: Scalar>(one: S, other: S) -> S {
        one + other
    }
    fn finish<S: Scalar>(_: [S; 0], _: [S; 0], length: S) -> S {
        length.saturated().canonical()
    }
}

/// Defines folds whose state belongs to a point and some edges of a path. The macro lists operations, `true` for a
/// closed path, their invariances, jumps, and the result from the last state.
macro_rules! of_point_and_path {
    ($(
        $(#[$($doc:tt)*])*
        $Name:ident = $name:literal, closed $closed:literal, $class:tt, jumps $jumps:ident $(, only $is_winding:literal)?:
        |$state:ident| $answer:expr;
    )*) => { $(
        $(#[$($doc)*])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $Name;

        impl Declares for $Name {
            const DECLARED: Declared = Declared::new($name, invariances!($class Vec2<f64>), Jumps::$jumps)
                .arguments(&["point"])
                .doc(crate::__doc!([] $([$($doc)*])*));
        }

        impl Fold for $Name {
            const CLOSED: bool = $closed;
            const WINDING: Option<usize> = Some(EdgeFold::<f64>::WINDING);
            $(const IS_WINDING: bool = $is_winding;)?
            type Element<S: Scalar> = Vec2<S>;
            type Context<S: Scalar> = Vec2<S>;
            type Reference<S: Scalar> = [S; 0];
            type State<S: Scalar> = EdgeFold<S>;
            type Out<S: Scalar> = S;
            fn in_plane<S: Scalar>(path: &[Vec2<S>]) -> &[Vec2<S>] {
                path
            }
            fn reference<S: Scalar>(_point: Vec2<S>, _path: &[Vec2<S>]) -> [S; 0] {
                []
            }
            fn empty<S: Scalar>() -> EdgeFold<S> {
                EdgeFold::empty()
            }
            fn edge<S: Scalar>(
                point: Vec2<S>,
                _: [S; 0],
                from: Vec2<S>,
                to: Vec2<S>,
            ) -> EdgeFold<S> {
                EdgeFold::of_edge(point, from, to)
            }
            fn join<S: Scalar>(one: EdgeFold<S>, other: EdgeFold<S>) -> EdgeFold<S> {
                one.join(other)
            }
            fn finish<S: Scalar>(_: Vec2<S>, _: [S; 0], $state: EdgeFold<S>) -> S {
                $answer
            }
        }
    )* };
}
// Without edges a distance is the largest finite number, which scaling does not change, so scaling is not declared.
of_point_and_path! {
    /// The [distance](crate::distance::ring::distance_to_polyline) of a point and a polyline; the largest
    /// finite number where that has fewer than two vertices.
    DistancePointPolyline = "distance_point_polyline", closed false, [isometric], jumps Never:
        |state| state.distance();
    /// The [distance](crate::distance::ring::distance_to_ring) of a point, also one inside, and the edges of a ring;
    /// that to the area is the signed distance where positive, else 0. Without edges the largest finite number.
    DistancePointRing = "distance_point_ring", closed true, [isometric], jumps Never:
        |state| state.distance();
    /// The [signed distance](crate::distance::ring::signed_distance_to_ring) of a point and a ring:
    /// negative inside. Without edges it is the largest finite number.
    SignedDistancePointRing = "signed_distance_point_ring", closed true, [isometric], jumps Never:
        |state| state.signed_distance(Fill::NonZero);
    /// How far a point is inside a ring by the even-odd rule, negative outside. Without edges it is minus
    /// the largest finite number.
    DepthPointRing = "depth_point_ring", closed true, [isometric], jumps Never:
        |state| (-state.signed_distance(Fill::EvenOdd)).canonical();
    /// The [winding number](crate::distance::ring::winding_of_ring) of a ring around a point: a whole
    /// number, which jumps at the border and has no derivatives.
    WindingOfRing = "winding_of_ring", closed true, [similar], jumps Anywhere, only true:
        |state| state.winding.canonical();
}

/// The [length](crate::intersection::length_inside_ring) of the part of a segment that lies in a ring of either
/// orientation; parts around which the ring winds twice count twice. It jumps where the segment is along an edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LengthInsideRing;

impl Declares for LengthInsideRing {
    const DECLARED: Declared = Declared::new("length_inside_ring", invariances!([rigid(1)] Segment2<f64>, Vec2<f64>), Jumps::Anywhere)
        .arguments(&["segment"])
        .range(Range::NOT_NEGATIVE)
        .doc("The [length](crate::intersection::length_inside_ring) of the part of a segment that lies in a ring of \
              either orientation; parts around which the ring winds twice count twice. It jumps where the segment is along an edge.");
}

impl Fold for LengthInsideRing {
    const CLOSED: bool = true;
    type Element<S: Scalar> = Vec2<S>;
    type Context<S: Scalar> = Segment2<S>;
    type Reference<S: Scalar> = [S; 0];
    type State<S: Scalar> = S;
    type Out<S: Scalar> = S;
    fn reference<S: Scalar>(_: Segment2<S>, _ring: &[Vec2<S>]) -> [S; 0] {
        []
    }
    fn empty<S: Scalar>() -> S {
        S::zero()
    }
    fn edge<S: Scalar>(segment: Segment2<S>, _: [S; 0], from: Vec2<S>, to: Vec2<S>) -> S {
        edge_inside(segment, from, to)
    }
    fn join<S: Scalar>(one: S, other: S) -> S {
        one + other
    }
    fn finish<S: Scalar>(segment: Segment2<S>, _: [S; 0], share: S) -> S {
        (share.unsigned() * segment.length()).saturated().canonical()
    }
}

/// Joins verbs to the folds over their paths.
macro_rules! folds {
    ($($Verb:ty, $Path:ident $method:ident by $By:ident;)*) => { $(
        impl crate::kernels::verbs::OverPath<crate::kernels::row::fold::$Path> for $Verb {
            type By = $By;
            const BY: $By = $By;
        }
        impl $Verb {
            /// Returns the operation over the edges of a path, for [`Cpu::fold`](crate::kernels::Cpu::fold).
            #[must_use]
            pub const fn $method(self) -> $By {
                $By
            }
        }
    )*
    listed! {
        names [$([Written {
            name: <$By as crate::kernels::row::op::Declares>::DECLARED.name,
            verb: stringify!($Verb),
            shapes: &[crate::kernels::row::fold::$Path::NAME],
        }]),*]
        each |walk| { $(walk.fold::<$By>(Written {
            name: <$By as crate::kernels::row::op::Declares>::DECLARED.name,
            verb: stringify!($Verb),
            shapes: &[crate::kernels::row::fold::$Path::NAME],
        });)* }
    } };
}

pub(crate) use folds;
folds! {
    Distance, Ring over_ring by DistancePointRing;
    Distance, Polyline over_polyline by DistancePointPolyline;
    SignedDistance, Ring over_ring by SignedDistancePointRing;
    Depth, Ring over_ring by DepthPointRing;
    Winding, Ring over_ring by WindingOfRing;
    Length, Polyline over_polyline by LengthOfPolyline;
    LengthInside, Ring over_ring by LengthInsideRing;
    verbs::SecondMoments, Ring over_ring by SecondMomentsOfRing;
}
