//! Bodies in motion as operations, with a search that hands a time to the replay.
use crate::distance3::decided::Decided;
use crate::kernels::ops::tables::sized;
use crate::kernels::verbs::{Clearance, TimeOfImpact};
use crate::motion::{
    ClearanceHints, ClearanceRecord, Impact3, ImpactRecord, Motion3, Moves, MovingPair, clearance_decided,
    clearance_replayed, impact_decided, impact_replayed,
};
use crate::{Capsule3, Cylinder, Ellipsoid, Obb3, RoundBox3, Sphere, Tetrahedron, Vec3};

/// Selects by the verb: the record of a row, its hints, how it searches and replays, and the method of two bodies.
macro_rules! of_verb {
    (record TimeOfImpact, $decisions:ty) => { ImpactRecord<$decisions> };
    (record Clearance, $decisions:ty) => { ClearanceRecord<$decisions> };
    (hints TimeOfImpact, $S:ident, $hints:ty) => { ($S, $S, $hints) };
    (hints Clearance, $S:ident, $hints:ty) => { ClearanceHints<$S, $hints> };
    (search TimeOfImpact, $pair:ident) => { impact_decided(&$pair) };
    (search Clearance, $pair:ident) => { clearance_decided(&$pair) };
    (replay TimeOfImpact, $pair:ident, $record:ident, $hints:ident) => { impact_replayed(&$pair, &$record, $hints) };
    (replay Clearance, $pair:ident, $record:ident, $hints:ident) => {
        clearance_replayed(&$pair, &$record, $hints).distance
    };
    (method TimeOfImpact, $a:ident, $m:ident, $b:ident, $n:ident) => { $a.time_of_impact($m, $b, $n) };
    (method Clearance, $a:ident, $m:ident, $b:ident, $n:ident) => { $a.clearance($m, $b, $n).distance };
}

/// Writes operations of two bodies and their motions, and joins them to their verbs.
///
/// A head says the verb, the result and the range; a line the name of the row and the shapes. Constants in brackets are
/// those of a row with hulls. The list has the rows that say so; a hull of it has up to eight vertices. Batches of typed
/// columns have all.
macro_rules! motion_rows {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident -> $out:ty, jumps $jumps:ident
        { $($name:literal: $A:ident, $B:ident $([$N:ident])? $($listed:ident)?;)* }
    )*) => {
        $( motion_rows! { @rows [concat!($($title),+)] $Verb, $out, $jumps; $($name: $A, $B [$($N)?];)* } )*
        crate::kernels::ops::tables::listed! {
            names [$([$($(motion_rows!(@line $listed names [] $Verb, $name, $A, $B),)?)*]),*]
            each |walk| {
                $($($(motion_rows!(@line $listed each [walk] $Verb, $name, $A, $B);)?)*)*
            }
        }
    };
    (@line listed $what:ident $walk:tt $Verb:ident, $name:literal, Hull3, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [Hull3_8 Motion3 Hull3_8 Motion3]
            (crate::Hull3<f64, 8>, Motion3<f64>, crate::Hull3<f64, 8>, Motion3<f64>)
        )
    };
    (@line listed $what:ident $walk:tt $Verb:ident, $name:literal, $A:ident, $B:ident) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [$A Motion3 $B Motion3] ($A<f64>, Motion3<f64>, $B<f64>, Motion3<f64>)
        )
    };
    (@rows [$title:expr] $Verb:ident, $out:ty, $jumps:ident; $($name:literal: $A:ident, $B:ident $N:tt;)*) => { $(
        const _: () = {
            // As visible as the verb.
            #[derive(Clone, Copy, Debug, Default)]
            pub struct Item<const N: usize>;

            type First = sized!($A, f64, 8);
            type Second = sized!($B, f64, 8);

            impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
                const DECLARED: crate::kernels::row::op::Declared = crate::kernels::row::op::Declared::new(
                    $name,
                    &[],
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .by_roundings(true)
                .costly(true)
                    .arguments(&["a", "motion_of_a", "b", "motion_of_b"])
                .doc(crate::kernels::ops::tables::text!($title, "", First, Second));
            }

            impl<const N: usize> crate::kernels::call::search::HintedSearch for Item<N> {
                type In<S: crate::Scalar> = (sized!($A, S, N), Motion3<S>, sized!($B, S, N), Motion3<S>);
                type Out<S: crate::Scalar> = $out;
                type Record = of_verb!(record $Verb, <First as Decided<Second>>::Decisions);
                type Hints<S: crate::Scalar> =
                    of_verb!(hints $Verb, S, <sized!($A, S, N) as Decided<sized!($B, S, N)>>::Hints);
                fn decide_with_hints<S: crate::Scalar<Mask = bool>>(
                    (a, motion_of_a, b, motion_of_b): Self::In<S>,
                ) -> (Self::Record, Self::Hints<S>) {
                    let pair = MovingPair::new((a, motion_of_a), (b, motion_of_b));
                    of_verb!(search $Verb, pair)
                }
                fn replay_with_hints<S: crate::Scalar>(
                    (a, motion_of_a, b, motion_of_b): Self::In<S>,
                    record: Self::Record,
                    hints: Self::Hints<S>,
                ) -> $out {
                    let pair = MovingPair::new((a, motion_of_a), (b, motion_of_b));
                    of_verb!(replay $Verb, pair, record, hints)
                }
            }
            motion_rows!(@join $Verb, $out, $A, $B, $N);
        };
    )* };
    (@join $Verb:ident, $out:ty, $A:ident, $B:ident, []) => {
        motion_rows!(@quaternary $Verb, $out, [], $A<S>, $B<S>, 8);
    };
    (@join $Verb:ident, $out:ty, $A:ident, $B:ident, [$N:ident]) => {
        motion_rows!(@quaternary $Verb, $out, [const N: usize], sized!($A, S, N), sized!($B, S, N), N);
    };
    (@quaternary $Verb:ident, $out:ty, [$($constant:tt)*], $First:ty, $Second:ty, $N:tt) => {
        impl<S: crate::Scalar<Mask = bool>, $($constant)*>
            crate::kernels::verbs::Quaternary<$First, Motion3<S>, $Second, Motion3<S>> for $Verb
        {
            type Out = $out;
            type By = crate::kernels::call::search::Searched<Item<$N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $First, motion_of_a: Motion3<S>, b: $Second, motion_of_b: Motion3<S>) -> $out {
                of_verb!(method $Verb, a, motion_of_a, b, motion_of_b)
            }
        }
    };
}

motion_rows! {
    /// The first [touch](crate::motion::time_of_impact) of {} in motion. Hulls have up to `N` vertices. The time of a miss
    /// is the largest finite number.
    TimeOfImpact -> Impact3<S>, jumps Anywhere {
        "time_of_impact_obb3s": Obb3, Obb3 listed;
        "time_of_impact_capsules": Capsule3, Capsule3 listed;
        "time_of_impact_sphere_obb3": Sphere, Obb3 listed;
        "time_of_impact_capsule_obb3": Capsule3, Obb3 listed;
        "time_of_impact_round_boxes": RoundBox3, RoundBox3;
        "time_of_impact_point_obb3": Vec3, Obb3 listed;
        "time_of_impact_point_tetrahedron": Vec3, Tetrahedron;
        "time_of_impact_hulls": Hull3, Hull3 [N] listed;
        "time_of_impact_sphere_hull": Sphere, Hull3 [N];
        "time_of_impact_obb3_hull": Obb3, Hull3 [N];
        "time_of_impact_obb3_cylinder": Obb3, Cylinder;
        "time_of_impact_cylinders": Cylinder, Cylinder;
        "time_of_impact_obb3_ellipsoid": Obb3, Ellipsoid;
        "time_of_impact_ellipsoids": Ellipsoid, Ellipsoid;
    }
    /// The least [signed distance](crate::motion::clearance()) of {} along their motions. Hulls have up to `N` vertices.
    /// Its time is of [`Clearance3`](crate::motion::Clearance3).
    Clearance -> S, jumps Never {
        "clearance_obb3s": Obb3, Obb3 listed;
        "clearance_capsules": Capsule3, Capsule3 listed;
        "clearance_sphere_obb3": Sphere, Obb3 listed;
        "clearance_capsule_obb3": Capsule3, Obb3 listed;
        "clearance_round_boxes": RoundBox3, RoundBox3;
        "clearance_point_obb3": Vec3, Obb3 listed;
        "clearance_hulls": Hull3, Hull3 [N] listed;
        "clearance_sphere_hull": Sphere, Hull3 [N];
        "clearance_obb3_hull": Obb3, Hull3 [N];
        "clearance_obb3_cylinder": Obb3, Cylinder;
        "clearance_cylinders": Cylinder, Cylinder;
        "clearance_obb3_ellipsoid": Obb3, Ellipsoid;
        "clearance_ellipsoids": Ellipsoid, Ellipsoid;
    }
}
