//! The measures of a ring as operations.
use crate::kernels::cpu::rings::Measure;
use crate::kernels::op::{Answer, Jumps, Motion, Promise, RingOp};
use crate::{Scalar, Vec2, ad, ring};

const fn promise(motion: Motion, answer: Answer) -> Promise {
    Promise { motion, answer }
}

const SIGNED_AREA: &[Promise] = &[
    promise(Motion::TranslationX, Answer::Stays),
    promise(Motion::TranslationY, Answer::Stays),
    promise(Motion::Scaling, Answer::Power(2)),
    promise(Motion::Rotation, Answer::Stays),
];
const PERIMETER: &[Promise] = &[
    promise(Motion::TranslationX, Answer::Stays),
    promise(Motion::TranslationY, Answer::Stays),
    promise(Motion::Scaling, Answer::Power(1)),
    promise(Motion::Rotation, Answer::Stays),
];
const CENTROID: &[Promise] = &[
    promise(Motion::TranslationX, Answer::Follows),
    promise(Motion::TranslationY, Answer::Follows),
    promise(Motion::Scaling, Answer::Follows),
    promise(Motion::Rotation, Answer::Follows),
];

/// Measures of a ring with compiled kernels: the macro lists them.
macro_rules! measures {
    ($($name:ident = $function:ident, $vjp:ident: $out:ty, $promises:expr, $jumps:ident;)*) => { $(
        #[doc = concat!("[`", stringify!($function), "`](crate::ring::", stringify!($function), ").")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl RingOp for $name {
            const NAME: &'static str = stringify!($function);
            type Out<S: Scalar> = $out;
            const PROMISES: &'static [Promise] = $promises;
            const JUMPS: Jumps = Jumps::$jumps;
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
    SignedArea = signed_area, signed_area_vjp: S, SIGNED_AREA, Never;
    Perimeter = perimeter, perimeter_vjp: S, PERIMETER, Never;
    // Its value jumps where the area is zero.
    Centroid = centroid, centroid_vjp: Vec2<S>, CENTROID, Anywhere;
}
