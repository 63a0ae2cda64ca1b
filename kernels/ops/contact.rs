//! Contacts of shapes of space as operations, with a search that hands hints to the replay.
use crate::distance3::decided::Decided;
use crate::distance3::{Apart, ContactRecord, Contacts3, contacts};
use crate::kernels::ops::tables::sized;
use crate::kernels::verbs::Contacts;
use crate::{
    Capsule3, Cone, Cylinder, Disc, Ellipsoid, Obb3, Plane3, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3,
};

/// Writes operations of two shapes and a distance, and joins them to the verb.
///
/// A line says the name of the row and the shapes. Constants in brackets are those of a row with hulls. The list has the
/// rows that say so; a hull of it has up to eight vertices. Batches of typed columns have all.
macro_rules! contact_rows {
    ($(#[doc = $title:literal])+ $($name:literal: $A:ident, $B:ident $([$N:ident])? $($listed:ident)?;)*) => {
        contact_rows! { @rows [concat!($($title),+)] $($name: $A, $B [$($N)?];)* }
        crate::kernels::ops::tables::listed! {
            names [[$($(contact_rows!(@line $listed names [] $name, $A, $B),)?)*]]
            each |walk| {
                $($(contact_rows!(@line $listed each [walk] $name, $A, $B);)?)*
            }
        }
    };
    (@line listed $what:ident $walk:tt $name:literal, Hull3, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search Contacts, $name, [Hull3_8 Hull3_8 Number]
            (crate::Hull3<f64, 8>, crate::Hull3<f64, 8>, f64)
        )
    };
    (@line listed $what:ident $walk:tt $name:literal, $A:ident, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search Contacts, $name, [$A Hull3_8 Number] ($A<f64>, crate::Hull3<f64, 8>, f64)
        )
    };
    (@line listed $what:ident $walk:tt $name:literal, $A:ident, $B:ident) => {
        crate::kernels::ops::tables::line!($what $walk search Contacts, $name, [$A $B Number] ($A<f64>, $B<f64>, f64))
    };
    (@rows [$title:expr] $($name:literal: $A:ident, $B:ident $N:tt;)*) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<const N: usize>;

        type First = sized!($A, f64, 8);
        type Second = sized!($B, f64, 8);
        type Record = (<First as Decided<Second>>::Decisions, ContactRecord);

        impl<const N: usize> crate::kernels::row::op::Declares for Item<N> {
            const DECLARED: crate::kernels::row::op::Declared = crate::kernels::row::op::Declared::new(
                $name,
                &[],
                crate::kernels::row::op::Jumps::Anywhere,
            )
            .by_roundings(true)
                .arguments(&const {
                let [a, b] = crate::kernels::ops::noun::named(
                    <First as crate::kernels::ops::noun::Named>::NOUN.name,
                    <Second as crate::kernels::ops::noun::Named>::NOUN.name,
                );
                [a, b, "within"]
            })
            .doc(crate::kernels::ops::tables::text!($title, "", First, Second));
        }

        impl<const N: usize> crate::kernels::call::search::HintedSearch for Item<N> {
            type In<S: crate::Scalar> = (sized!($A, S, N), sized!($B, S, N), S);
            type Out<S: crate::Scalar> = Contacts3<S>;
            type Record = Record;
            type Hints<S: crate::Scalar> = <sized!($A, S, N) as Decided<sized!($B, S, N)>>::Hints;
            fn decide_with_hints<S: crate::Scalar<Mask = bool>>(
                (a, b, within): Self::In<S>,
            ) -> (Record, Self::Hints<S>) {
                let (decisions, hints) = a.decided(&b);
                let relation = a.replayed(&b, &decisions, &hints);
                let names = a.facing(&b, relation.normal);
                let faces = |names| a.named(&b, names, relation.normal);
                let found = ContactRecord::search(&relation, names, faces, within);
                ((decisions, found), hints)
            }
            fn replay_with_hints<S: crate::Scalar>(
                (a, b, _): Self::In<S>,
                (decisions, found): Record,
                hints: Self::Hints<S>,
            ) -> Contacts3<S> {
                let relation = a.replayed(&b, &decisions, &hints);
                found.replay(&relation, a.named(&b, found.faces, relation.normal))
            }
        }
        contact_rows!(@join $A, $B, $N);
    }; )* };
    (@join $A:ident, $B:ident, []) => { contact_rows!(@ternary [], $A<S>, $B<S>, 8); };
    (@join $A:ident, $B:ident, [$N:ident]) => {
        contact_rows!(@ternary [const N: usize], sized!($A, S, N), sized!($B, S, N), N);
    };
    (@ternary [$($constant:tt)*], $First:ty, $Second:ty, $N:tt) => {
        impl<S: crate::Scalar<Mask = bool>, $($constant)*> crate::kernels::verbs::Ternary<$First, $Second, S>
            for Contacts
        {
            type Out = Contacts3<S>;
            type By = crate::kernels::call::search::Searched<Item<$N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $First, b: $Second, within: S) -> Contacts3<S> {
                contacts(a, b, within)
            }
        }
    };
}

contact_rows! {
    /// The [contact](crate::distance3::contacts) of {}: up to eight points whose gap is at most `within`. Hulls have up to
    /// `N` vertices. Places from the count on are zero.
    "contacts_obb3s": Obb3, Obb3 listed;
    "contacts_segment_obb3": Segment3, Obb3;
    "contacts_capsule_obb3": Capsule3, Obb3 listed;
    "contacts_triangle_obb3": Triangle3, Obb3;
    "contacts_tetrahedron_obb3": Tetrahedron, Obb3;
    "contacts_sphere_obb3": Sphere, Obb3 listed;
    "contacts_round_boxes": RoundBox3, RoundBox3;
    "contacts_plane_obb3": Plane3, Obb3 listed;
    "contacts_plane_capsule": Plane3, Capsule3;
    "contacts_plane_cylinder": Plane3, Cylinder;
    "contacts_plane_hull": Plane3, Hull3 [N];
    "contacts_hulls": Hull3, Hull3 [N] listed;
    "contacts_obb3_hull": Obb3, Hull3 [N] listed;
    "contacts_capsule_hull": Capsule3, Hull3 [N];
    "contacts_obb3_cylinder": Obb3, Cylinder;
    "contacts_obb3_cone": Obb3, Cone;
    "contacts_obb3_disc": Obb3, Disc;
    "contacts_obb3_ellipsoid": Obb3, Ellipsoid;
    "contacts_cylinders": Cylinder, Cylinder;
}
