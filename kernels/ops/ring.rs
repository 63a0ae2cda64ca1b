//! The measures of a ring as operations.
use crate::kernels::cpu::rings::Measure;
use crate::kernels::op::{Finite, Jumps, Invariance, Range, RingOp};
use crate::kernels::ops::class::invariances;
use crate::kernels::ops::walk::Written;
use crate::kernels::ops::tables::listed;
use crate::kernels::verbs::{Centroid, Perimeter, SignedArea};
use crate::{Scalar, Vec2, ad, ring};

/// Measures of a ring with compiled kernels: the macro lists them.
macro_rules! measures {
    ($($(#[doc = $doc:literal])* $name:ident = $function:ident, $vjp:ident: $out:ty, $class:tt, $jumps:ident, $range:ident;)*) => { $(
        impl RingOp for $name {
            const NAME: &'static str = stringify!($function);
            const DOC: &'static str = concat!($($doc),*);
            type Out<S: Scalar> = $out;
            const INVARIANCES: &'static [Invariance] = invariances!($class Vec2<f64>);
            const JUMPS: Jumps = Jumps::$jumps;
            const FINITE: Finite = Finite::Always;
            const RANGE: Range = Range::$range;
            #[inline(always)]
            fn value<S: Scalar>(ring: &[Vec2<S>]) -> $out {
                ring::$function(ring)
            }
            #[inline(always)]
            fn ring_vjp<S: Scalar>(ring: &[Vec2<S>], out_bar: $out, ring_bar: &mut [Vec2<S>]) {
                ad::adjoint::ring::$vjp(ring, out_bar, ring_bar);
            }
            fn compiled() -> Option<Measure> {
                Some(Measure::$name)
            }
        }
    )*
    listed! {
        names [$([Written { name: stringify!($function), verb: stringify!($name), shapes: &["ring"] }]),*]
        each |walk| { $(walk.ring::<$name>(Written {
            name: stringify!($function), verb: stringify!($name), shapes: &["ring"],
        });)* }
    } };
}
measures! {
    /// The signed area of a ring: positive where it turns counter-clockwise.
    SignedArea = signed_area, signed_area_vjp: S, [rigid(2)], Never, ANY;
    /// The perimeter of a ring.
    Perimeter = perimeter, perimeter_vjp: S, [rigid(1)], Never, NOT_NEGATIVE;
    /// The centroid of the area of a ring; its value jumps where the area is zero.
    Centroid = centroid, centroid_vjp: Vec2<S>, [follows], Anywhere, ANY;
}
