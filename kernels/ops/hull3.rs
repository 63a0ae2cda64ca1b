//! Distances of convex hulls of space as operations, with a search.
use crate::distance3::hulls::{
    ByCorners, HullRecord, corner_slopes, hulls_replay, hulls_search,
};
use crate::distance3::{Apart, Contact3, PointPair3};
use crate::kernels::verbs::{ClosestPoints, Distance, Penetration, SignedDistance};
use crate::{
    Capsule3, Hull3, Obb3, Plane3, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3, Vec3,
};

/// Selects by the first shape: another hull, a half-space, which needs no search, or one with corners.
macro_rules! by_first {
    (shape Hull3, $S:ty, $N:tt) => { Hull3<$S, $N> };
    (shape $A:ident, $S:ty, $N:tt) => { $A<$S> };
    (record Plane3) => { () };
    (record $A:ident) => { HullRecord };
    (search Plane3, $a:ident, $b:ident) => {{ let _ = ($a, $b); }};
    (search $A:ident, $a:ident, $b:ident) => { hulls_search(&$a, &$b) };
    (replay Plane3, $a:ident, $b:ident, $record:ident) => {{ let () = $record; $a.relation($b) }};
    (replay $A:ident, $a:ident, $b:ident, $record:ident) => { hulls_replay(&$a, &$b, &$record) };
    (reads Hull3, $record:ident, $place:ident, $N:tt) => {
        match $place.checked_sub(3 * $N) {
            Some(place) => $record.names([None, Some(place / 3)]),
            None => $record.names([Some($place / 3), None]),
        }
    };
    (reads Plane3, $record:ident, $place:ident, $N:tt) => { true };
    (reads $A:ident, $record:ident, $place:ident, $N:tt) => {
        match $place.checked_sub(<$A<f64> as crate::Fixed>::LEN) {
            Some(place) => $record.names([None, Some(place / 3)]),
            None => true,
        }
    };
    // Points and directions have their replay's.
    (adjoint $A:ident closest_points, $a:ident, $b:ident, $record:ident, $bar:ident) => {{
        let _ = ($a, $b, $record, $bar);
        None
    }};
    (adjoint $A:ident penetration, $a:ident, $b:ident, $record:ident, $bar:ident) => {{
        let _ = ($a, $b, $record, $bar);
        None
    }};
    (adjoint Plane3 $replay:ident, $a:ident, $b:ident, $record:ident, $bar:ident) => {{
        let _ = ($a, $b, $record, $bar);
        None
    }};
    (adjoint $A:ident $replay:ident, $a:ident, $b:ident, $record:ident, $bar:ident) => {{
        let found = corner_slopes(&$a, &$b, $record, |found| by_first!(factor $replay, found, $bar));
        let factor = by_first!(factor $replay, (&found.relation), $bar);
        let by_a = $a.by_corners(&found.by_a, found.relation.normal, factor);
        let by_b = $b.by_corners(&found.by_b, found.relation.normal, factor);
        Some((found.relation.$replay(), (by_a, by_b)))
    }};
    // The distance of shapes that touch or overlap is constant.
    (factor distance, $found:tt, $bar:ident) => {
        if $found.apart > S::zero() { $bar } else { S::zero() }
    };
    (factor signed_distance, $found:tt, $bar:ident) => {{
        let _ = &$found;
        $bar
    }};
    (line $what:ident $walk:tt $Verb:ident, $name:literal, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [Hull3_8 Hull3_8] (Hull3<f64, 8>, Hull3<f64, 8>)
        )
    };
    (line $what:ident $walk:tt $Verb:ident, $name:literal, $A:ident) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [$A Hull3_8] ($A<f64>, Hull3<f64, 8>)
        )
    };
}

/// Writes operations of a shape and a hull of up to `N` vertices, and joins them to their verbs.
///
/// A head says the verb, the result, the method of the shapes' relation that gives it, the class of invariance and the
/// jumps; a line the name of the row and the first shape. In the list a hull has up to eight vertices.
macro_rules! hull_rows {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident -> $out:ty, replay $replay:ident $class:tt $(range $range:ident)? jumps $jumps:ident
        { $($name:literal: $A:ident;)* }
    )*) => {
        $( hull_rows! {
            @rows [concat!($($title),+)] $Verb, $out, $replay, $class, ($(range $range)?), $jumps;
            $($name: $A;)*
        } )*
        crate::kernels::ops::tables::listed! {
            names [$([$(by_first!(line names [] $Verb, $name, $A)),*]),*]
            each |walk| { $($(by_first!(line each [walk] $Verb, $name, $A);)*)* }
        }
    };
    (
        @rows [$title:expr] $Verb:ident, $out:ty, $replay:ident, $class:tt, $range:tt, $jumps:ident;
        $($name:literal: $A:ident;)*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<const N: usize>;

        impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
            const DECLARED: crate::kernels::row::op::Declared = {
                type First = by_first!(shape $A, f64, 8);
                let declared = crate::kernels::row::op::Declared::new(
                    $name,
                    crate::kernels::ops::class::invariances!($class First, Hull3<f64, 8>),
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .arguments(
                    &const {
                        crate::kernels::ops::noun::named(
                            <First as crate::kernels::ops::noun::Named>::NOUN.name,
                            <Hull3<f64, 8> as crate::kernels::ops::noun::Named>::NOUN.name,
                        )
                    },
                )
                .doc(crate::kernels::ops::tables::text!($title, "", First, Hull3<f64, 8>));
                hull_rows!(@in declared $range)
            };
        }

        impl<const N: usize> crate::kernels::call::search::Search for Item<N> {
            type In<S: crate::Scalar> = (by_first!(shape $A, S, N), Hull3<S, N>);
            type Out<S: crate::Scalar> = $out;
            type Record = by_first!(record $A);
            fn decide<S: crate::Scalar<Mask = bool>>((a, b): Self::In<S>) -> Self::Record {
                by_first!(search $A, a, b)
            }
            fn replay<S: crate::Scalar>((a, b): Self::In<S>, record: Self::Record) -> $out {
                by_first!(replay $A, a, b, record).$replay()
            }
            fn adjoint<S: crate::Real>(
                (a, b): Self::In<S>,
                record: &Self::Record,
                out_bar: $out,
            ) -> Option<($out, Self::In<S>)> {
                by_first!(adjoint $A $replay, a, b, record, out_bar)
            }
            #[allow(unused_variables)]
            fn reads(record: &Self::Record, place: usize) -> bool {
                by_first!(reads $A, record, place, N)
            }
        }

        impl<S: crate::Scalar<Mask = bool>, const N: usize>
            crate::kernels::verbs::Binary<by_first!(shape $A, S, N), Hull3<S, N>> for $Verb
        {
            type Out = $out;
            type By = crate::kernels::call::search::Searched<Item<N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: by_first!(shape $A, S, N), b: Hull3<S, N>) -> $out {
                use crate::kernels::call::search::Search;
                let record = Item::<N>::decide((a, b));
                a.guarded_with(&b).result(Item::<N>::replay((a, b), record))
            }
        }
    }; )* };
    (@in $declared:ident ()) => { $declared };
    (@in $declared:ident (range $range:ident)) => {
        $declared.range(crate::kernels::row::op::Range::$range)
    };
}

// Ties are shared, but of the corners of two faces' overlap only some, in an order that depends on the first hull. So
// the exchange of hulls is not declared.
hull_rows! {
    /// The [distance](crate::distance3::distance()) of {}, 0 where they meet. Hulls have up to `N` vertices.
    Distance -> S, replay distance [rigid(1)] range NOT_NEGATIVE jumps Never {
        "distance_hulls": Hull3;
        "distance_point_hull": Vec3;
        "distance_segment_hull": Segment3;
        "distance_sphere_hull": Sphere;
        "distance_capsule_hull": Capsule3;
        "distance_triangle_hull": Triangle3;
        "distance_tetrahedron_hull": Tetrahedron;
        "distance_obb3_hull": Obb3;
        "distance_round_box_hull": RoundBox3;
    }
    /// The [signed distance](crate::distance3::signed_distance) of {}: less than 0 where they overlap, by the least
    /// move that parts them. Hulls have up to `N` vertices.
    SignedDistance -> S, replay signed_distance [rigid(1)] jumps Never {
        "signed_distance_hulls": Hull3;
        "signed_distance_point_hull": Vec3;
        "signed_distance_sphere_hull": Sphere;
        "signed_distance_capsule_hull": Capsule3;
        "signed_distance_triangle_hull": Triangle3;
        "signed_distance_tetrahedron_hull": Tetrahedron;
        "signed_distance_obb3_hull": Obb3;
        "signed_distance_round_box_hull": RoundBox3;
        "signed_distance_plane_hull": Plane3;
    }
    /// The [nearest points](crate::distance3::closest_points) of {}. Hulls have up to `N` vertices. Points jump to
    /// another nearest feature.
    ClosestPoints -> PointPair3<S>, replay closest_points [follows] jumps Anywhere {
        "closest_points_hulls": Hull3;
        "closest_points_point_hull": Vec3;
        "closest_points_sphere_hull": Sphere;
        "closest_points_capsule_hull": Capsule3;
        "closest_points_obb3_hull": Obb3;
    }
    /// The [depth of overlap and its direction](crate::distance3::penetration) of {}. Hulls have up to `N` vertices.
    /// The direction jumps to another deepest face.
    Penetration -> Contact3<S>, replay penetration [shifts] jumps Anywhere {
        "penetration_hulls": Hull3;
        "penetration_sphere_hull": Sphere;
        "penetration_capsule_hull": Capsule3;
        "penetration_obb3_hull": Obb3;
        "penetration_round_box_hull": RoundBox3;
        "penetration_plane_hull": Plane3;
    }
}
