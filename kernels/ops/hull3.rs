//! Distances of convex hulls of space as operations, with a search.
use crate::distance3::hulls::{HullRecord, hulls_guard, hulls_replay, hulls_search};
use crate::distance3::{Contact3, PointPair3};
use crate::kernels::verbs::{ClosestPoints, Distance, Penetration, SignedDistance};
use crate::{Capsule3, Hull3, Obb3, Sphere, Vec3};

/// Writes operations of a shape with corners and a hull of up to `N` vertices, and joins them to their verbs.
///
/// Each says its verb, the name, both shapes, the result, the method of their relation that gives it, the class of
/// invariance and the jumps; in the list it has a hull of up to eight vertices.
macro_rules! hull_rows {
    ($(
        $(#[$($doc:tt)*])*
        $Verb:ident = $name:literal: ($a:ident, $b:ident) as ($A:ty, Hull3) => $out:ty,
        listed [$($listed:ident)+] $input:ty;
        replay $replay:ident
        $class:tt
        $(range $range:ident)?
        jumps $jumps:ident
    )*) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<const N: usize>;

        impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
            const DECLARED: crate::kernels::row::op::Declared = {
                type S = f64;
                #[allow(dead_code)]
                const N: usize = 8;
                crate::kernels::row::op::Declared::new(
                    $name,
                    crate::kernels::ops::class::invariances!($class $A, Hull3<f64, 8>),
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .arguments(&[stringify!($a), stringify!($b)])
                .doc(crate::__doc!([] $([$($doc)*])*))
                $(.range(crate::kernels::row::op::Range::$range))?
            };
        }

        impl<const N: usize> crate::kernels::call::search::Search for Item<N> {
            type In<S: crate::Scalar> = ($A, Hull3<S, N>);
            type Out<S: crate::Scalar> = $out;
            type Record = HullRecord;
            fn decide<S: crate::Scalar<Mask = bool>>((a, b): ($A, Hull3<S, N>)) -> HullRecord {
                hulls_search(&a, &b)
            }
            fn replay<S: crate::Scalar>((a, b): ($A, Hull3<S, N>), record: HullRecord) -> $out {
                hulls_replay(&a, &b, &record).$replay()
            }
        }

        impl<S: crate::Scalar<Mask = bool>, const N: usize>
            crate::kernels::verbs::Binary<$A, Hull3<S, N>> for $Verb
        {
            type Out = $out;
            type By = crate::kernels::call::search::Searched<Item<N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $A, b: Hull3<S, N>) -> $out {
                use crate::kernels::call::search::Search;
                let record = Item::<N>::decide((a, b));
                hulls_guard(&a, &b).result(Item::<N>::replay((a, b), record))
            }
        }
    }; )*
    crate::kernels::ops::tables::listed! {
        names [$([
            crate::kernels::ops::tables::line!(names [] search $Verb, $name, [$($listed)+] $input)
        ]),*]
        each |walk| { $(
            crate::kernels::ops::tables::line!(each [walk] search $Verb, $name, [$($listed)+] $input);
        )* }
    } };
}

// Ties are shared, but of the corners of two faces' overlap only some, in an order that depends on the first hull. So
// the exchange of hulls is not declared.
hull_rows! {
    /// The [distance](crate::distance3::distance()) of two convex hulls of up to `N` vertices, 0 where they meet.
    Distance = "distance_hulls": (a, b) as (Hull3<S, N>, Hull3) => S,
    listed [Hull3_8 Hull3_8] (Hull3<f64, 8>, Hull3<f64, 8>);
    replay distance
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [distance](crate::distance3::distance()) of a point and a convex hull of up to `N` vertices, 0 inside.
    Distance = "distance_point_hull": (point, hull) as (Vec3<S>, Hull3) => S,
    listed [Vec3 Hull3_8] (Vec3<f64>, Hull3<f64, 8>);
    replay distance
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [distance](crate::distance3::distance()) of a box and a convex hull of up to `N` vertices, 0 where they
    /// meet.
    Distance = "distance_obb3_hull": (shape, hull) as (Obb3<S>, Hull3) => S,
    listed [Obb3 Hull3_8] (Obb3<f64>, Hull3<f64, 8>);
    replay distance
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [signed distance](crate::distance3::signed_distance) of two convex hulls of up to `N` vertices: less than 0
    /// where they overlap, by the least move that parts them.
    SignedDistance = "signed_distance_hulls": (a, b) as (Hull3<S, N>, Hull3) => S,
    listed [Hull3_8 Hull3_8] (Hull3<f64, 8>, Hull3<f64, 8>);
    replay signed_distance
    [rigid(1)]
    jumps Never

    /// The [signed distance](crate::distance3::signed_distance) of a point from the surface of a convex hull of up to
    /// `N` vertices, less than 0 inside.
    SignedDistance = "signed_distance_point_hull": (point, hull) as (Vec3<S>, Hull3) => S,
    listed [Vec3 Hull3_8] (Vec3<f64>, Hull3<f64, 8>);
    replay signed_distance
    [rigid(1)]
    jumps Never

    /// The [signed distance](crate::distance3::signed_distance) of a ball and a convex hull of up to `N` vertices.
    SignedDistance = "signed_distance_sphere_hull": (ball, hull) as (Sphere<S>, Hull3) => S,
    listed [Sphere Hull3_8] (Sphere<f64>, Hull3<f64, 8>);
    replay signed_distance
    [rigid(1)]
    jumps Never

    /// The [signed distance](crate::distance3::signed_distance) of a capsule and a convex hull of up to `N` vertices.
    SignedDistance = "signed_distance_capsule_hull": (capsule, hull) as (Capsule3<S>, Hull3) => S,
    listed [Capsule3 Hull3_8] (Capsule3<f64>, Hull3<f64, 8>);
    replay signed_distance
    [rigid(1)]
    jumps Never

    /// The [signed distance](crate::distance3::signed_distance) of a box and a convex hull of up to `N` vertices.
    SignedDistance = "signed_distance_obb3_hull": (shape, hull) as (Obb3<S>, Hull3) => S,
    listed [Obb3 Hull3_8] (Obb3<f64>, Hull3<f64, 8>);
    replay signed_distance
    [rigid(1)]
    jumps Never

    /// The [nearest points](crate::distance3::closest_points) of two convex hulls of up to `N` vertices. Points jump to
    /// another nearest feature.
    ClosestPoints = "closest_points_hulls": (a, b) as (Hull3<S, N>, Hull3) => PointPair3<S>,
    listed [Hull3_8 Hull3_8] (Hull3<f64, 8>, Hull3<f64, 8>);
    replay closest_points
    [follows]
    jumps Anywhere

    /// The [depth of overlap and its direction](crate::distance3::penetration) of two convex hulls of up to `N`
    /// vertices. The direction jumps to another deepest face.
    Penetration = "penetration_hulls": (a, b) as (Hull3<S, N>, Hull3) => Contact3<S>,
    listed [Hull3_8 Hull3_8] (Hull3<f64, 8>, Hull3<f64, 8>);
    replay penetration
    [shifts]
    jumps Anywhere

    /// The [depth of overlap and its direction](crate::distance3::penetration) of a box and a convex hull of up to `N`
    /// vertices. The direction jumps to another deepest face.
    Penetration = "penetration_obb3_hull": (shape, hull) as (Obb3<S>, Hull3) => Contact3<S>,
    listed [Obb3 Hull3_8] (Obb3<f64>, Hull3<f64, 8>);
    replay penetration
    [shifts]
    jumps Anywhere
}
