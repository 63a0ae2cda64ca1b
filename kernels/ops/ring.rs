//! The measures of a ring as operations.
use crate::kernels::cpu::rings::Measure;
use crate::kernels::op::{Answer, Finite, Jumps, Motion, Promise, Range, RingOp};
use crate::kernels::verbs::{Centroid, Perimeter, SignedArea};
use crate::{Scalar, Vec2, ad, ring};

const SIGNED_AREA: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Stays),
    Promise::new(Motion::TranslationY, Answer::Stays),
    Promise::new(Motion::Scaling, Answer::Power(2)),
    Promise::new(Motion::Rotation, Answer::Stays),
];
const PERIMETER: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Stays),
    Promise::new(Motion::TranslationY, Answer::Stays),
    Promise::new(Motion::Scaling, Answer::Power(1)),
    Promise::new(Motion::Rotation, Answer::Stays),
];
const CENTROID: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Follows),
    Promise::new(Motion::TranslationY, Answer::Follows),
    Promise::new(Motion::Scaling, Answer::Follows),
    Promise::new(Motion::Rotation, Answer::Follows),
];

/// Measures of a ring with compiled kernels: the macro lists them.
macro_rules! measures {
    ($($name:ident = $function:ident, $vjp:ident: $out:ty, $promises:expr, $jumps:ident, $range:ident;)*) => { $(
        impl RingOp for $name {
            const NAME: &'static str = stringify!($function);
            const DOC: &'static str =
                concat!("[`", stringify!($function), "`](crate::ring::", stringify!($function), ").");
            type Out<S: Scalar> = $out;
            const PROMISES: &'static [Promise] = $promises;
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
    )* };
}
measures! {
    SignedArea = signed_area, signed_area_vjp: S, SIGNED_AREA, Never, ANY;
    Perimeter = perimeter, perimeter_vjp: S, PERIMETER, Never, NOT_NEGATIVE;
    // Its value jumps where the area is zero.
    Centroid = centroid, centroid_vjp: Vec2<S>, CENTROID, Anywhere, ANY;
}
