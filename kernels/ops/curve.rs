//! Distances of points from curves of the plane as operations, with a search that hands the parameter to the replay.
use crate::curve::{Arc2, Cubic2, CurvePiece, CurveSpot, Quadratic2, nearest_spot, spot_replayed};
use crate::distance::PointPair;
use crate::kernels::verbs::{ClosestPoints, Distance};
use crate::scalar::Guard;
use crate::{Scalar, Vec2};

/// Returns the distance of a point from the nearest one of a curve.
fn distance<S: Scalar>(point: Vec2<S>, on_curve: Vec2<S>) -> S {
    on_curve.distance(point)
}

/// Returns a point and the nearest one of a curve.
fn closest_points<S: Scalar>(point: Vec2<S>, on_curve: Vec2<S>) -> PointPair<S> {
    PointPair {
        on_a: point.canonical(),
        on_b: on_curve.canonical(),
    }
}

/// Writes operations of a point and a curve, and joins them to their verbs.
///
/// A head says the verb, the result, the function of the point and the nearest one that gives it, the class of
/// invariance and the jumps; a line the name of the row and the curve.
macro_rules! curve_rows {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident -> $out:ty, by $of:ident $class:tt $(range $range:ident)? jumps $jumps:ident
        { $($name:literal: $Curve:ident;)* }
    )*) => {
        $( curve_rows! {
            @rows [concat!($($title),+)] $Verb, $out, $of, $class, $jumps, ($(range $range)?);
            $($name: $Curve;)*
        } )*
        crate::kernels::ops::tables::listed! {
            names [$([$(crate::kernels::ops::tables::line!(
                names [] search $Verb, $name, [Vec2 $Curve] (Vec2<f64>, $Curve<f64>)
            )),*]),*]
            each |walk| { $($(crate::kernels::ops::tables::line!(
                each [walk] search $Verb, $name, [Vec2 $Curve] (Vec2<f64>, $Curve<f64>)
            );)*)* }
        }
    };
    (
        @rows [$title:expr] $Verb:ident, $out:ty, $of:ident, $class:tt, $jumps:ident, $clauses:tt;
        $($name:literal: $Curve:ident;)*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item;

        impl crate::kernels::row::op::Declares for Item {
            const DECLARED: crate::kernels::row::op::Declared = crate::__declared!(
                crate::kernels::row::op::Declared::new(
                    $name,
                    crate::kernels::ops::class::invariances!($class Vec2<f64>, $Curve<f64>),
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .arguments(&["point", "curve"])
                .doc(crate::kernels::ops::tables::text!($title, "", Vec2<f64>, $Curve<f64>)),
                (Vec2<f64>, $Curve<f64>), (point, curve), $clauses
            );
        }

        impl crate::kernels::call::search::HintedSearch for Item {
            type In<S: Scalar> = (Vec2<S>, $Curve<S>);
            type Out<S: Scalar> = $out;
            type Record = CurveSpot;
            type Hints<S: Scalar> = [S; 1];
            fn decide_with_hints<S: Scalar<Mask = bool>>(
                (point, curve): Self::In<S>,
            ) -> (CurveSpot, [S; 1]) {
                let (spot, parameter) = nearest_spot(CurvePiece::from(curve), point);
                (spot, [parameter])
            }
            fn replay_with_hints<S: Scalar>(
                (point, curve): Self::In<S>,
                spot: CurveSpot,
                [parameter]: [S; 1],
            ) -> $out {
                $of(point, spot_replayed(curve, point, (spot, parameter)))
            }
        }

        impl<S: Scalar<Mask = bool>> crate::kernels::verbs::Binary<Vec2<S>, $Curve<S>> for $Verb {
            type Out = $out;
            type By = crate::kernels::call::search::Searched<Item>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(point: Vec2<S>, curve: $Curve<S>) -> $out {
                let found = nearest_spot(CurvePiece::from(curve), point);
                let on_curve = spot_replayed(curve, point, found);
                Guard::of(&point).and(&curve).result($of(point, on_curve))
            }
        }
    }; )* };
}

curve_rows! {
    /// The [distance](crate::curve::CurvePiece::distance) of {}, 0 on the curve.
    Distance -> S, by distance [rigid(1)] range NOT_NEGATIVE jumps Never {
        "distance_point_quadratic": Quadratic2;
        "distance_point_cubic": Cubic2;
        "distance_point_arc": Arc2;
    }
    /// The [nearest points](crate::curve::CurvePiece::closest) of {}. Points jump to another place that is as near.
    ClosestPoints -> PointPair<S>, by closest_points [follows] jumps Anywhere {
        "closest_points_point_quadratic": Quadratic2;
        "closest_points_point_cubic": Cubic2;
        "closest_points_point_arc": Arc2;
    }
}
