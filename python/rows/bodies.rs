//! Contacts of bodies and bodies in motion: searches of the library that its list of rows does not have.
use geograd::kernels::__private::Searches;
use geograd::kernels::dynamic::{Operation, search};
use geograd::kernels::{Clearance, Contacts, RowOf, TimeOfImpact};
use geograd::motion::Motion3;
use geograd::{Capsule3, Hull3, Obb3, Plane3, Sphere, Vec3};

/// A hull as the list has them.
type Hull3x8<S> = Hull3<S, 8>;

macro_rules! contacts {
    ($($A:ident, $B:ident;)*) => {
        &[$(search::<<RowOf<Contacts, ($A<f64>, $B<f64>, f64)> as Searches>::Search>()),*]
    };
}
macro_rules! moving {
    ($Verb:ident) => {
        moving! { $Verb:
            Obb3, Obb3;
            Capsule3, Capsule3;
            Capsule3, Obb3;
            Sphere, Obb3;
            Vec3, Obb3;
            Hull3x8, Hull3x8;
        }
    };
    ($Verb:ident: $($A:ident, $B:ident;)*) => {
        &[$(search::<
            <RowOf<$Verb, ($A<f64>, Motion3<f64>, $B<f64>, Motion3<f64>)> as Searches>::Search,
        >()),*]
    };
}

/// The rows of each verb.
pub(crate) const ROWS: &[(&str, &[Operation])] = &[
    (
        "contacts",
        contacts! {
            Obb3, Obb3;
            Capsule3, Obb3;
            Sphere, Obb3;
            Plane3, Obb3;
            Obb3, Hull3x8;
            Hull3x8, Hull3x8;
        },
    ),
    ("time_of_impact", moving!(TimeOfImpact)),
    ("clearance", moving!(Clearance)),
];
