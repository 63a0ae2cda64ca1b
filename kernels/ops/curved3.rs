//! Distances of curved shapes of space as operations, with a search that hands hints to the replay.
use crate::distance3::curved::{
    CurvedRecord, HINTS, curved_replay, curved_search, curved_slopes,
};
use crate::distance3::relation::Relation;
use crate::distance3::{Apart, Contact3, PointPair3};
use crate::kernels::ops::tables::sized;
use crate::kernels::verbs::{ClosestPoints, Distance, Penetration, SignedDistance};
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Disc, Ellipsoid, Obb3, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3, Vec3,
    YawBox3,
};

/// Says if a verb reads the points of a relation.
macro_rules! has_points {
    (distance) => { false };
    (signed_distance) => { false };
    ($replay:ident) => { true };
}

/// The result and the cotangents of both shapes by hand, for verbs without points.
macro_rules! by_hand {
    (distance, $a:ident, $b:ident, $record:ident, $hints:ident, $bar:ident) => {{
        // The distance of shapes that touch or overlap is constant.
        let factor = |found: &Relation<S>| if found.apart > S::zero() { $bar } else { S::zero() };
        let (found, by_a, by_b) = curved_slopes(&$a, &$b, *$record, $hints, factor)?;
        Some((found.distance(), (by_a, by_b)))
    }};
    (signed_distance, $a:ident, $b:ident, $record:ident, $hints:ident, $bar:ident) => {{
        let (found, by_a, by_b) = curved_slopes(&$a, &$b, *$record, $hints, |_| $bar)?;
        Some((found.signed_distance(), (by_a, by_b)))
    }};
    ($replay:ident, $a:ident, $b:ident, $record:ident, $hints:ident, $bar:ident) => {{
        let _ = ($a, $b, $record, $hints, $bar);
        None
    }};
}

/// Writes operations of two shapes of which at least one is curved, and joins them to their verbs.
///
/// A head says the verb, the result, the method of the shapes' relation that gives it, the class of invariance and the
/// jumps; a line the name of the row and the shapes. Constants in brackets are those of a row with a hull. The list has
/// the rows that say so, a few for every verb, since the harness judges some minutes at each of them; a hull of it has up
/// to eight vertices. Batches of typed columns have all.
macro_rules! curved_rows {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident -> $out:ty, replay $replay:ident $class:tt $(range $range:ident)? $(lower $lower:ident)? jumps $jumps:ident
        { $($name:literal: $A:ident, $B:ident $([$N:ident])? $($listed:ident)?;)* }
    )*) => {
        $( curved_rows! {
            @rows [concat!($($title),+)] $Verb, $out, $replay, $class, $jumps, ($(range $range)? $(lower $lower)?);
            $($name: $A, $B [$($N)?];)*
        } )*
        crate::kernels::ops::tables::listed! {
            names [$([$($(crate::kernels::ops::tables::pair_line!($listed names [] $Verb, $name, $A, $B),)?)*]),*]
            each |walk| {
                $($($(crate::kernels::ops::tables::pair_line!($listed each [walk] $Verb, $name, $A, $B);)?)*)*
            }
        }
    };
    (
        @rows [$title:expr] $Verb:ident, $out:ty, $replay:ident, $class:tt, $jumps:ident, $clauses:tt;
        $($name:literal: $A:ident, $B:ident $N:tt;)*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<const N: usize>;

        type First = sized!($A, f64, 8);
        type Second = sized!($B, f64, 8);

        impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
            const DECLARED: crate::kernels::row::op::Declared = crate::__declared!(
                crate::kernels::row::op::Declared::new(
                    $name,
                    crate::kernels::ops::class::invariances!($class First, Second),
                    crate::kernels::row::op::Jumps::$jumps,
                )
                .arguments(
                    &const {
                        crate::kernels::ops::noun::named(
                            <First as crate::kernels::ops::noun::Named>::NOUN.name,
                            <Second as crate::kernels::ops::noun::Named>::NOUN.name,
                        )
                    },
                )
                .doc(crate::kernels::ops::tables::text!($title, "", First, Second)),
                (First, Second), (a, b), $clauses
            );
        }

        impl<const N: usize> crate::kernels::call::search::HintedSearch for Item<N> {
            type In<S: crate::Scalar> = (sized!($A, S, N), sized!($B, S, N));
            type Out<S: crate::Scalar> = $out;
            type Record = CurvedRecord;
            type Hints<S: crate::Scalar> = [S; HINTS];
            fn decide_with_hints<S: crate::Scalar<Mask = bool>>(
                (a, b): Self::In<S>,
            ) -> (CurvedRecord, [S; HINTS]) {
                curved_search(&a, &b)
            }
            fn replay_with_hints<S: crate::Scalar>(
                (a, b): Self::In<S>,
                record: CurvedRecord,
                hints: [S; HINTS],
            ) -> $out {
                curved_replay(&a, &b, record, &hints, has_points!($replay)).$replay()
            }
            fn adjoint_with_hints<S: crate::Real>(
                (a, b): Self::In<S>,
                record: &CurvedRecord,
                hints: &[S; HINTS],
                out_bar: $out,
            ) -> Option<($out, Self::In<S>)> {
                by_hand!($replay, a, b, record, hints, out_bar)
            }
        }
        curved_rows!(@join $Verb, $out, $replay, $A, $B, $N);
    }; )* };
    (@join $Verb:ident, $out:ty, $replay:ident, $A:ident, $B:ident, []) => {
        curved_rows!(@binary $Verb, $out, $replay, [], $A<S>, $B<S>, 8);
    };
    (@join $Verb:ident, $out:ty, $replay:ident, $A:ident, $B:ident, [$N:ident]) => {
        curved_rows!(@binary $Verb, $out, $replay, [const N: usize], sized!($A, S, N), sized!($B, S, N), N);
    };
    (
        @binary $Verb:ident, $out:ty, $replay:ident, [$($constant:tt)*], $First:ty, $Second:ty, $N:tt
    ) => {
        impl<S: crate::Scalar<Mask = bool>, $($constant)*> crate::kernels::verbs::Binary<$First, $Second> for $Verb {
            type Out = $out;
            type By = crate::kernels::call::search::Searched<Item<$N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $First, b: $Second) -> $out {
                a.guarded_with(&b).result(a.relation(b).$replay())
            }
        }
    };
}

curved_rows! {
    /// The [distance](crate::distance3::distance()) of {}, 0 where they meet.
    Distance -> S, replay distance [rigid(1), symmetric] range NOT_NEGATIVE lower Distance jumps Never {
        "distance_segment_cylinder": Segment3, Cylinder;
        "distance_capsule_cylinder": Capsule3, Cylinder;
        "distance_triangle_cylinder": Triangle3, Cylinder;
        "distance_tetrahedron_cylinder": Tetrahedron, Cylinder;
        "distance_aabb3_cylinder": Aabb3, Cylinder;
        "distance_yaw_cylinder": YawBox3, Cylinder;
        "distance_obb3_cylinder": Obb3, Cylinder;
        "distance_round_box_cylinder": RoundBox3, Cylinder;
        "distance_segment_cone": Segment3, Cone;
        "distance_capsule_cone": Capsule3, Cone listed;
        "distance_triangle_cone": Triangle3, Cone;
        "distance_tetrahedron_cone": Tetrahedron, Cone;
        "distance_aabb3_cone": Aabb3, Cone;
        "distance_yaw_cone": YawBox3, Cone;
        "distance_obb3_cone": Obb3, Cone;
        "distance_round_box_cone": RoundBox3, Cone;
        "distance_point_ellipsoid": Vec3, Ellipsoid;
        "distance_sphere_ellipsoid": Sphere, Ellipsoid;
        "distance_segment_ellipsoid": Segment3, Ellipsoid;
        "distance_capsule_ellipsoid": Capsule3, Ellipsoid;
        "distance_triangle_ellipsoid": Triangle3, Ellipsoid;
        "distance_tetrahedron_ellipsoid": Tetrahedron, Ellipsoid;
        "distance_aabb3_ellipsoid": Aabb3, Ellipsoid;
        "distance_yaw_ellipsoid": YawBox3, Ellipsoid;
        "distance_obb3_ellipsoid": Obb3, Ellipsoid;
        "distance_round_box_ellipsoid": RoundBox3, Ellipsoid;
        "distance_point_disc": Vec3, Disc listed;
        "distance_sphere_disc": Sphere, Disc;
        "distance_segment_disc": Segment3, Disc;
        "distance_capsule_disc": Capsule3, Disc;
        "distance_triangle_disc": Triangle3, Disc;
        "distance_tetrahedron_disc": Tetrahedron, Disc;
        "distance_aabb3_disc": Aabb3, Disc;
        "distance_yaw_disc": YawBox3, Disc;
        "distance_obb3_disc": Obb3, Disc;
        "distance_round_box_disc": RoundBox3, Disc;
        "distance_cylinders": Cylinder, Cylinder;
        "distance_cylinder_cone": Cylinder, Cone;
        "distance_cones": Cone, Cone;
        "distance_cylinder_ellipsoid": Cylinder, Ellipsoid;
        "distance_cone_ellipsoid": Cone, Ellipsoid;
        "distance_ellipsoids": Ellipsoid, Ellipsoid listed;
        "distance_cylinder_disc": Cylinder, Disc;
        "distance_cone_disc": Cone, Disc;
        "distance_ellipsoid_disc": Ellipsoid, Disc;
        "distance_discs": Disc, Disc;
    }
    /// The [signed distance](crate::distance3::signed_distance) of {}: less than 0 where they overlap, by the least
    /// move that parts them.
    SignedDistance -> S, replay signed_distance [rigid(1), symmetric] lower Distance jumps Never {
        "signed_distance_segment_cylinder": Segment3, Cylinder;
        "signed_distance_capsule_cylinder": Capsule3, Cylinder;
        "signed_distance_triangle_cylinder": Triangle3, Cylinder;
        "signed_distance_tetrahedron_cylinder": Tetrahedron, Cylinder;
        "signed_distance_aabb3_cylinder": Aabb3, Cylinder;
        "signed_distance_yaw_cylinder": YawBox3, Cylinder;
        "signed_distance_obb3_cylinder": Obb3, Cylinder listed;
        "signed_distance_round_box_cylinder": RoundBox3, Cylinder;
        "signed_distance_segment_cone": Segment3, Cone;
        "signed_distance_capsule_cone": Capsule3, Cone;
        "signed_distance_triangle_cone": Triangle3, Cone;
        "signed_distance_tetrahedron_cone": Tetrahedron, Cone;
        "signed_distance_aabb3_cone": Aabb3, Cone;
        "signed_distance_yaw_cone": YawBox3, Cone;
        "signed_distance_obb3_cone": Obb3, Cone;
        "signed_distance_round_box_cone": RoundBox3, Cone;
        "signed_distance_point_ellipsoid": Vec3, Ellipsoid;
        "signed_distance_sphere_ellipsoid": Sphere, Ellipsoid;
        "signed_distance_segment_ellipsoid": Segment3, Ellipsoid;
        "signed_distance_capsule_ellipsoid": Capsule3, Ellipsoid;
        "signed_distance_triangle_ellipsoid": Triangle3, Ellipsoid;
        "signed_distance_tetrahedron_ellipsoid": Tetrahedron, Ellipsoid;
        "signed_distance_aabb3_ellipsoid": Aabb3, Ellipsoid;
        "signed_distance_yaw_ellipsoid": YawBox3, Ellipsoid;
        "signed_distance_obb3_ellipsoid": Obb3, Ellipsoid;
        "signed_distance_round_box_ellipsoid": RoundBox3, Ellipsoid;
        "signed_distance_sphere_disc": Sphere, Disc;
        "signed_distance_segment_disc": Segment3, Disc;
        "signed_distance_capsule_disc": Capsule3, Disc;
        "signed_distance_triangle_disc": Triangle3, Disc;
        "signed_distance_tetrahedron_disc": Tetrahedron, Disc listed;
        "signed_distance_aabb3_disc": Aabb3, Disc;
        "signed_distance_yaw_disc": YawBox3, Disc;
        "signed_distance_obb3_disc": Obb3, Disc;
        "signed_distance_round_box_disc": RoundBox3, Disc;
        "signed_distance_cylinders": Cylinder, Cylinder listed;
        "signed_distance_cylinder_cone": Cylinder, Cone;
        "signed_distance_cones": Cone, Cone;
        "signed_distance_cylinder_ellipsoid": Cylinder, Ellipsoid;
        "signed_distance_cone_ellipsoid": Cone, Ellipsoid;
        "signed_distance_ellipsoids": Ellipsoid, Ellipsoid listed;
        "signed_distance_cylinder_disc": Cylinder, Disc;
        "signed_distance_cone_disc": Cone, Disc;
        "signed_distance_ellipsoid_disc": Ellipsoid, Disc;
        "signed_distance_discs": Disc, Disc;
    }
    // Rounding chooses one of several directions that are equally deep, so no motion is declared.
    /// The [nearest points](crate::distance3::closest_points) of {}. Points jump to another nearest feature.
    ClosestPoints -> PointPair3<S>, replay closest_points [] jumps Anywhere {
        "closest_points_capsule_cylinder": Capsule3, Cylinder;
        "closest_points_obb3_cylinder": Obb3, Cylinder;
        "closest_points_obb3_cone": Obb3, Cone;
        "closest_points_point_ellipsoid": Vec3, Ellipsoid;
        "closest_points_sphere_ellipsoid": Sphere, Ellipsoid;
        "closest_points_capsule_ellipsoid": Capsule3, Ellipsoid;
        "closest_points_obb3_ellipsoid": Obb3, Ellipsoid listed;
        "closest_points_obb3_disc": Obb3, Disc;
        "closest_points_cylinders": Cylinder, Cylinder;
        "closest_points_cylinder_ellipsoid": Cylinder, Ellipsoid;
        "closest_points_ellipsoids": Ellipsoid, Ellipsoid listed;
    }
    /// The [depth of overlap and its direction](crate::distance3::penetration) of {}. The direction jumps to another
    /// deepest face.
    Penetration -> Contact3<S>, replay penetration [shifts] jumps Anywhere {
        "penetration_capsule_cylinder": Capsule3, Cylinder;
        "penetration_obb3_cylinder": Obb3, Cylinder listed;
        "penetration_obb3_cone": Obb3, Cone;
        "penetration_sphere_ellipsoid": Sphere, Ellipsoid;
        "penetration_capsule_ellipsoid": Capsule3, Ellipsoid;
        "penetration_obb3_ellipsoid": Obb3, Ellipsoid;
        "penetration_obb3_disc": Obb3, Disc;
        "penetration_cylinders": Cylinder, Cylinder;
        "penetration_cylinder_ellipsoid": Cylinder, Ellipsoid;
        "penetration_ellipsoids": Ellipsoid, Ellipsoid listed;
    }
    // Hulls have no box around them as a declared bound.
    /// The [distance](crate::distance3::distance()) of {}, 0 where they meet. Hulls have up to `N` vertices.
    Distance -> S, replay distance [rigid(1)] range NOT_NEGATIVE jumps Never {
        "distance_hull_cylinder": Hull3, Cylinder [N] listed;
        "distance_hull_cone": Hull3, Cone [N];
        "distance_hull_ellipsoid": Hull3, Ellipsoid [N];
        "distance_hull_disc": Hull3, Disc [N];
    }
    /// The [signed distance](crate::distance3::signed_distance) of {}: less than 0 where they overlap, by the least
    /// move that parts them. Hulls have up to `N` vertices.
    SignedDistance -> S, replay signed_distance [rigid(1)] jumps Never {
        "signed_distance_hull_cylinder": Hull3, Cylinder [N];
        "signed_distance_hull_cone": Hull3, Cone [N];
        "signed_distance_hull_ellipsoid": Hull3, Ellipsoid [N] listed;
        "signed_distance_hull_disc": Hull3, Disc [N];
    }
    /// The [nearest points](crate::distance3::closest_points) of {}. Hulls have up to `N` vertices. Points jump to
    /// another nearest feature.
    ClosestPoints -> PointPair3<S>, replay closest_points [] jumps Anywhere {
        "closest_points_hull_cylinder": Hull3, Cylinder [N];
        "closest_points_hull_ellipsoid": Hull3, Ellipsoid [N];
    }
    /// The [depth of overlap and its direction](crate::distance3::penetration) of {}. Hulls have up to `N` vertices.
    /// The direction jumps to another deepest face.
    Penetration -> Contact3<S>, replay penetration [shifts] jumps Anywhere {
        "penetration_hull_cylinder": Hull3, Cylinder [N];
        "penetration_hull_ellipsoid": Hull3, Ellipsoid [N];
    }
}
