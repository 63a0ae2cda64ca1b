//! Folds over polylines and clouds of space as operations.
use crate::distance3::polyline::NearestEdge3;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::op::{Declared, Declares, Jumps};
use crate::kernels::ops::class::invariances;
use crate::kernels::ops::path::folds;
use crate::kernels::ops::walk::Written;
use crate::kernels::ops::tables::listed;
use crate::kernels::verbs::{
    Centroid, Distance, Length, SecondMoments,
};
use crate::measure::cloud::{CloudSums, place_of};
use crate::{Scalar, Symmetric3, Vec3};

/// Defines folds over points in space.
macro_rules! in_space {
    ($(
        $(#[$($doc:tt)*])*
        $Name:ident = $name:literal: $Context:ty $(, $argument:literal)? => $Out:ty;
        closed $closed:literal, $class:tt, jumps $jumps:ident,
        seen from $Reference:ty, by |$path:pat_param| $reference:expr,
        state $State:ty, $empty:expr,
        edge |$context:pat_param, $seen:pat_param, $from:ident, $to:pat_param| $edge:expr,
        join |$one:ident, $other:ident| $join:expr,
        finish |$place:pat_param, $state:ident| $finish:expr;
    )*) => { $(
        $(#[$($doc)*])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $Name;

        impl Declares for $Name {
            const DECLARED: Declared = Declared::new($name, invariances!($class Vec3<f64>), Jumps::$jumps)
                .arguments(&[$($argument)?])
                .doc(crate::__doc!([] $([$($doc)*])*));
        }

        impl Fold for $Name {
            const CLOSED: bool = $closed;
            type Element<S: Scalar> = Vec3<S>;
            type Context<S: Scalar> = $Context;
            type Reference<S: Scalar> = $Reference;
            type State<S: Scalar> = $State;
            type Out<S: Scalar> = $Out;
            fn reference<S: Scalar>(_: $Context, $path: &[Vec3<S>]) -> $Reference {
                $reference
            }
            fn empty<S: Scalar>() -> $State {
                $empty
            }
            fn edge<S: Scalar>(
                $context: $Context,
                $seen: $Reference,
                $from: Vec3<S>,
                $to: Vec3<S>,
            ) -> $State {
                $edge
            }
            fn join<S: Scalar>($one: $State, $other: $State) -> $State {
                $join
            }
            fn finish<S: Scalar>(_: $Context, $place: $Reference, $state: $State) -> $Out {
                $finish
            }
        }
    )* };
}
in_space! {
    /// The length of a polyline of space: the sum of the distances of neighbouring vertices. Edges of length zero
    /// have derivative zero.
    LengthOfPolyline3 = "length_of_polyline3": [S; 0] => S;
        closed false, [rigid(1)], jumps Never,
        seen from [S; 0], by |_| [],
        state S, S::zero(),
        edge |_, _, from, to| (to - from).length(),
        join |one, other| one + other,
        finish |_, length| length.saturated().canonical();
    // Without edges a distance is the largest finite number, which scaling does not change, so scaling is not declared.
    /// The [distance](crate::distance3::polyline::distance_to_polyline) of a point and a polyline of space; the
    /// largest finite number where that has fewer than two vertices.
    DistancePointPolyline3 = "distance_point_polyline3": Vec3<S>, "point" => S;
        closed false, [isometric], jumps Never,
        seen from [S; 0], by |_| [],
        state NearestEdge3<S>, NearestEdge3::empty(),
        edge |point, _, from, to| NearestEdge3::of_edge(point, from, to),
        join |one, other| one.join(other),
        finish |_, nearest| nearest.result();
    // The edges of a cloud stand for their first points, one each.
    /// The [mean](crate::measure::cloud::centroid) of points of space; zero without points.
    CentroidOfCloud3 = "centroid_of_cloud3": [S; 0] => Vec3<S>;
        closed true, [follows], jumps Anywhere,
        seen from Vec3<S>, by |points| place_of(points),
        state [S; 4], [S::zero(); 4],
        edge |_, place, from, _| {
            let arm = from - place;
            [S::one(), arm.x, arm.y, arm.z]
        },
        join |one, other| std::array::from_fn(|k| one[k] + other[k]),
        finish |place, sums| {
            let [count, x, y, z] = sums;
            CloudSums { count, first: Vec3::new(x, y, z), ..CloudSums::empty() }.centroid(place)
        };
    /// The [covariance](crate::measure::cloud::covariance) of points of space, divided by their number; zero without
    /// points.
    CovarianceOfCloud3 = "covariance_of_cloud3": [S; 0] => Symmetric3<S>;
        closed true, [rigid(2), along_axes], jumps Never,
        seen from Vec3<S>, by |points| place_of(points),
        state CloudSums<S>, CloudSums::empty(),
        edge |_, place, from, _| CloudSums::of(from - place),
        join |one, other| one.join(other),
        finish |_, sums| sums.covariance();
}
folds! {
    Length, Polyline3 over_polyline3 by LengthOfPolyline3;
    Distance, Polyline3 over_polyline3 by DistancePointPolyline3;
    Centroid, Cloud3 over_cloud3 by CentroidOfCloud3;
    SecondMoments, Cloud3 over_cloud3 by CovarianceOfCloud3;
}
