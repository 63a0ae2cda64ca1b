//! The measures of a ring as folds.
use crate::kernels::row::fold::Fold;
use crate::kernels::row::op::{Declared, Declares, Finite, Jumps, Range};
use crate::kernels::ops::class::invariances;
use crate::kernels::ops::path::folds;
use crate::kernels::ops::tables::listed;
use crate::kernels::ops::walk::Written;
use crate::kernels::verbs::{Area, Centroid, Perimeter, SignedArea};
use crate::reference::Reference;
use crate::ring::Measure;
use crate::{Fixed, Scalar, Vec2};

/// Defines measures of a ring: sums over edges seen from the first vertex. Each has kernels by hand.
macro_rules! measures {
    ($(
        $(#[$($doc:tt)*])*
        $Name:ident = $name:literal, $measure:ident: $Out:ty, $class:tt, jumps $jumps:ident, range $range:ident;
        state $State:ty,
        edge |$from:ident, $to:ident| $edge:expr,
        finish |$seen:ident, $sums:pat_param| $finish:expr;
    )*) => { $(
        $(#[$($doc)*])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $Name;

        impl Declares for $Name {
            const DECLARED: Declared = Declared::new($name, invariances!($class Vec2<f64>), Jumps::$jumps)
                .doc(crate::__doc!([] $([$($doc)*])*))
                .finite(Finite::Always)
                .range(Range::$range);
        }

        impl Fold for $Name {
            const CLOSED: bool = true;
            const MEASURE: Option<Measure> = Some(Measure::$measure);
            type Element<S: Scalar> = Vec2<S>;
            type Context<S: Scalar> = [S; 0];
            type Reference<S: Scalar> = Reference<S>;
            type State<S: Scalar> = $State;
            type Out<S: Scalar> = $Out;
            fn in_plane<S: Scalar>(path: &[Vec2<S>]) -> &[Vec2<S>] {
                path
            }
            fn in_plane_mut<S: Scalar>(path: &mut [Vec2<S>]) -> &mut [Vec2<S>] {
                path
            }
            fn reference<S: Scalar>(_: [S; 0], ring: &[Vec2<S>]) -> Reference<S> {
                let seen = Reference::of_ring(ring);
                match ring.first() {
                    Some(&first) => seen.shifted(seen.place(first)),
                    None => seen,
                }
            }
            fn empty<S: Scalar>() -> $State {
                <$State as Fixed>::filled(S::zero())
            }
            fn edge<S: Scalar>(_: [S; 0], seen: Reference<S>, from: Vec2<S>, to: Vec2<S>) -> $State {
                let ($from, $to) = (seen.place(from), seen.place(to));
                $edge
            }
            fn join<S: Scalar>(one: $State, other: $State) -> $State {
                std::array::from_fn(|k| one[k] + other[k])
            }
            fn finish<S: Scalar>(_: [S; 0], $seen: Reference<S>, $sums: $State) -> $Out {
                $finish
            }
        }
    )* };
}
measures! {
    /// The signed area of a ring: positive where it turns counter-clockwise.
    SignedAreaOfRing = "signed_area", SignedArea: S, [rigid(2)], jumps Never, range ANY;
        state [S; 1],
        edge |from, to| [from.perp_dot(to)],
        finish |seen, [twice]| seen.outer(seen.outer(twice.halved())).saturated().canonical();
    /// The area of a ring, whichever way it turns: the magnitude of its signed area, as often as it winds around each
    /// region. Derivative zero at area zero.
    AreaOfRing = "area_of_ring", Area: S, [rigid(2)], jumps Never, range NOT_NEGATIVE;
        state [S; 1],
        edge |from, to| [from.perp_dot(to)],
        finish |seen, [twice]| {
            seen.outer(seen.outer(twice.halved())).magnitude().saturated().canonical()
        };
    /// The perimeter of a ring.
    PerimeterOfRing = "perimeter", Perimeter: S, [rigid(1)], jumps Never, range NOT_NEGATIVE;
        state [S; 1],
        edge |from, to| [(to - from).length()],
        finish |seen, [sum]| seen.outer(sum).saturated().canonical();
    /// The centroid of the area of a ring; its value jumps where the area is zero.
    CentroidOfRing = "centroid", Centroid: Vec2<S>, [follows], jumps Anywhere, range ANY;
        state [S; 6],
        edge |from, to| {
            let cross = from.perp_dot(to);
            let moment = (from + to) * cross;
            [cross, moment.x, moment.y, from.x, from.y, S::one()]
        },
        finish |seen, [twice, moment_x, moment_y, sum_x, sum_y, count]| {
            // Without area the centroid is the mean of the vertices; without vertices it is the origin.
            let (flat, none) = (twice.equals(S::zero()), count.equals(S::zero()));
            let thrice = S::lit(3.0) * S::select(flat, S::one(), twice);
            let count = S::select(none, S::one(), count);
            let mean = |sum: S, moment: S| S::select(flat, sum.over(count), moment.over(thrice));
            seen.outer_place(Vec2::new(mean(sum_x, moment_x), mean(sum_y, moment_y))).canonical()
        };
}
folds! {
    SignedArea, Ring over_ring by SignedAreaOfRing;
    Area, Ring over_ring by AreaOfRing;
    Perimeter, Ring over_ring by PerimeterOfRing;
    Centroid, Ring over_ring by CentroidOfRing;
}
