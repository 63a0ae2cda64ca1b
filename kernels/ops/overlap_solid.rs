//! The overlap of bodies with flat faces as operations, with a search.
use crate::kernels::ops::tables::sized;
use crate::kernels::verbs::{IntersectionArea, IntersectionVolume, Iof, Iou};
use crate::overlap::Denominator;
use crate::overlap_solid::{VolumeRecord, slice_replay, volume_replay, volume_search};
use crate::{Aabb3, Obb3, Plane3, Tetrahedron, YawBox3};

/// Selects the measure of a row.
macro_rules! measured {
    (area, $a:ident, $b:ident, $record:ident) => { slice_replay(&$a, $b, &$record) };
    ($over:ident, $a:ident, $b:ident, $record:ident) => {
        volume_replay(Denominator::$over, &$a, &$b, &$record)
    };
}

/// Writes operations of two bodies, and joins them to their verbs.
///
/// A head says the verb, the measure, the class of invariance, the range and the jumps; a line the name of the row and
/// the shapes. In the list a hull has up to eight vertices. Constants in brackets are those of a row with hulls.
macro_rules! solid_rows {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ident by $over:ident $class:tt range $range:ident jumps $jumps:ident
        { $($name:literal: $A:ident, $B:ident $([$N:ident])?;)* }
    )*) => {
        $( solid_rows! {
            @rows [concat!($($title),+)] $Verb, $over, $class, $range, $jumps; $($name: $A, $B [$($N)?];)*
        } )*
        crate::kernels::ops::tables::listed! {
            names [$([$(crate::kernels::ops::tables::pair_line!(names [] $Verb, $name, $A, $B)),*]),*]
            each |walk| { $($(crate::kernels::ops::tables::pair_line!(each [walk] $Verb, $name, $A, $B);)*)* }
        }
    };
    (
        @rows [$title:expr] $Verb:ident, $over:ident, $class:tt, $range:ident, $jumps:ident;
        $($name:literal: $A:ident, $B:ident $N:tt;)*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<const N: usize>;

        type First = sized!($A, f64, 8);
        type Second = sized!($B, f64, 8);

        impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
            const DECLARED: crate::kernels::row::op::Declared = crate::kernels::row::op::Declared::new(
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
            .doc(crate::kernels::ops::tables::text!($title, "", First, Second))
            .range(crate::kernels::row::op::Range::$range);
        }

        impl<const N: usize> crate::kernels::call::search::Search for Item<N> {
            type In<S: crate::Scalar> = (sized!($A, S, N), sized!($B, S, N));
            type Out<S: crate::Scalar> = S;
            type Record = VolumeRecord<N>;
            fn decide<S: crate::Scalar<Mask = bool>>((a, b): Self::In<S>) -> VolumeRecord<N> {
                volume_search(&a, &b)
            }
            fn replay<S: crate::Scalar>((a, b): Self::In<S>, record: VolumeRecord<N>) -> S {
                measured!($over, a, b, record)
            }
        }
        solid_rows!(@join $Verb, $A, $B, $N);
    }; )* };
    (@join $Verb:ident, $A:ident, $B:ident, []) => {
        solid_rows!(@binary $Verb, [], sized!($A, S, 8), sized!($B, S, 8), 8);
    };
    (@join $Verb:ident, $A:ident, $B:ident, [$N:ident]) => {
        solid_rows!(@binary $Verb, [const N: usize], sized!($A, S, N), sized!($B, S, N), N);
    };
    (@binary $Verb:ident, [$($constant:tt)*], $First:ty, $Second:ty, $N:tt) => {
        impl<S: crate::Scalar<Mask = bool>, $($constant)*>
            crate::kernels::verbs::Binary<$First, $Second> for $Verb
        {
            type Out = S;
            type By = crate::kernels::call::search::Searched<Item<$N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $First, b: $Second) -> S {
                use crate::kernels::call::search::Search;
                crate::scalar::guarded((a, b), |both| {
                    let record = Item::<$N>::decide(both);
                    Item::<$N>::replay(both, record)
                })
            }
        }
    };
}

solid_rows! {
    /// The [volume](crate::overlap_solid) that {} share. Hulls have up to `N` vertices.
    IntersectionVolume by None [rigid(3)] range NOT_NEGATIVE jumps Never {
        "intersection_volume_hulls": Hull3, Hull3 [N];
        "intersection_volume_tetrahedra": Tetrahedron, Tetrahedron;
        "intersection_volume_tetrahedron_hull": Tetrahedron, Hull3 [N];
        "intersection_volume_tetrahedron_obb3": Tetrahedron, Obb3;
        "intersection_volume_obb3_hull": Obb3, Hull3 [N];
        "intersection_volume_yaw_hull": YawBox3, Hull3 [N];
        "intersection_volume_aabb3_hull": Aabb3, Hull3 [N];
        "intersection_volume_hull_plane": Hull3, Plane3 [N];
        "intersection_volume_tetrahedron_plane": Tetrahedron, Plane3;
        "intersection_volume_obb3_plane": Obb3, Plane3;
    }
    /// The [intersection over union](crate::overlap_solid) of {}, 0 to 1. Hulls have up to `N` vertices.
    Iou by Union [similar] range RATIO jumps FromZero {
        "iou_hulls": Hull3, Hull3 [N];
        "iou_tetrahedra": Tetrahedron, Tetrahedron;
        "iou_tetrahedron_obb3": Tetrahedron, Obb3;
        "iou_obb3_hull": Obb3, Hull3 [N];
    }
    /// The [part of the first](crate::overlap_solid) of {} that lies in the second, 0 to 1. Hulls have up to `N`
    /// vertices.
    Iof by First [similar] range RATIO jumps FromZero {
        "iof_hulls": Hull3, Hull3 [N];
        "iof_tetrahedra": Tetrahedron, Tetrahedron;
        "iof_obb3_hull": Obb3, Hull3 [N];
        "iof_hull_obb3": Hull3, Obb3 [N];
        "iof_hull_plane": Hull3, Plane3 [N];
        "iof_obb3_plane": Obb3, Plane3;
    }
    /// The [area](crate::overlap_solid) in which {}'s border cuts the first. Hulls have up to `N` vertices.
    IntersectionArea by area [rigid(2)] range NOT_NEGATIVE jumps Anywhere {
        "intersection_area_hull_plane": Hull3, Plane3 [N];
        "intersection_area_tetrahedron_plane": Tetrahedron, Plane3;
        "intersection_area_obb3_plane": Obb3, Plane3;
    }
}
