//! The overlap scores as operations.
use crate::ad::adjoint::overlap::{score_aabb2_vjp, score_framed_vjp};
use crate::clip::frame;
use crate::kernels::cpu::plan::Compiled;
use crate::kernels::op::{Answer, Extremes, Finite, Jumps, Motion, Op, Promise, Range, Slopes};
use crate::overlap::{Denominator, score_aabb2, score_framed};
use crate::{Aabb2, Obb2, Scalar};

/// Of an area of two boxes. Axis-aligned ones cannot turn: all but the last.
const AREA: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Stays),
    Promise::new(Motion::TranslationY, Answer::Stays),
    Promise::new(Motion::Scaling, Answer::Power(2)),
    Promise::new(Motion::Exchange, Answer::Stays),
    Promise::new(Motion::Rotation, Answer::Stays),
];
/// Of a ratio in which both boxes count alike.
const IOU: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Stays),
    Promise::new(Motion::TranslationY, Answer::Stays),
    Promise::new(Motion::Scaling, Answer::Stays),
    Promise::new(Motion::Exchange, Answer::Stays),
    Promise::new(Motion::Rotation, Answer::Stays),
];
/// Of a ratio to the first box.
const IOF: &[Promise] = &[
    Promise::new(Motion::TranslationX, Answer::Stays),
    Promise::new(Motion::TranslationY, Answer::Stays),
    Promise::new(Motion::Scaling, Answer::Stays),
    Promise::new(Motion::Rotation, Answer::Stays),
];

/// Scores of rotated boxes: the macro lists them.
macro_rules! obb2 {
    ($($name:ident = $function:ident over $over:ident, $promises:expr, $jumps:ident,
        $range:ident, $extremes:ident, $doc:literal;)*) => { $(
        #[doc = concat!("[`", stringify!($function), "`](crate::overlap::", stringify!($function), ").")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl Op for $name {
            const NAME: &'static str = stringify!($function);
            const ARGUMENTS: &'static [&'static str] = &["a", "b"];
            const DOC: &'static str = $doc;
            type In<S: Scalar> = (Obb2<S>, Obb2<S>);
            type Out<S: Scalar> = S;
            const PROMISES: &'static [Promise] = $promises;
            const JUMPS: Jumps = Jumps::$jumps;
            const SLOPES: Slopes = Slopes::ByHand;
            const FINITE: Finite = Finite::Always;
            const RANGE: Range = Range::$range;
            const EXTREMES: Extremes = Extremes::$extremes;
            #[inline]
            fn eval<S: Scalar>((a, b): Self::In<S>) -> S {
                score_framed::<S, true>(Denominator::$over, frame(a), frame(b))
            }
            #[inline]
            fn adjoint<S: Scalar>((a, b): Self::In<S>, out_bar: S) -> Option<(S, Self::In<S>)> {
                let over = Denominator::$over;
                Some(score_framed_vjp::<S, true>(over, frame(a), frame(b), out_bar))
            }
            fn compiled() -> Option<Compiled> {
                Some(Compiled::Obb2(Denominator::$over))
            }
        }
    )* };
}
obb2! {
    IntersectionAreaObb2 = intersection_area_obb2 over None, AREA, Never, NOT_NEGATIVE, Shared,
        "Area that two rotated boxes share.";
    IouObb2 = iou_obb2 over Union, IOU, FromZero, RATIO, Union,
        "Intersection over union of two rotated boxes, 0 to 1.";
    IofObb2 = iof_obb2 over First, IOF, FromZero, RATIO, Ratio,
        "The part of the first of two rotated boxes that lies in the second, 0 to 1.";
}

/// Scores of axis-aligned boxes: the macro lists them.
macro_rules! aabb2 {
    ($($name:ident = $function:ident over $over:ident, $promises:expr, $jumps:ident,
        $range:ident, $extremes:ident, $doc:literal;)*) => { $(
        #[doc = concat!("[`", stringify!($function), "`](crate::overlap::", stringify!($function), ").")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl Op for $name {
            const NAME: &'static str = stringify!($function);
            const ARGUMENTS: &'static [&'static str] = &["a", "b"];
            const DOC: &'static str = $doc;
            type In<S: Scalar> = (Aabb2<S>, Aabb2<S>);
            type Out<S: Scalar> = S;
            const PROMISES: &'static [Promise] = $promises;
            const JUMPS: Jumps = Jumps::$jumps;
            const SLOPES: Slopes = Slopes::ByHand;
            const FINITE: Finite = Finite::Always;
            const RANGE: Range = Range::$range;
            const EXTREMES: Extremes = Extremes::$extremes;
            #[inline]
            fn eval<S: Scalar>((a, b): Self::In<S>) -> S {
                score_aabb2(Denominator::$over, a, b)
            }
            #[inline]
            fn adjoint<S: Scalar>((a, b): Self::In<S>, out_bar: S) -> Option<(S, Self::In<S>)> {
                Some(score_aabb2_vjp(Denominator::$over, a, b, out_bar))
            }
            fn compiled() -> Option<Compiled> {
                Some(Compiled::Aabb2(Denominator::$over))
            }
        }
    )* };
}
aabb2! {
    IntersectionAreaAabb2 = intersection_area_aabb2 over None, AREA.split_at(4).0, Never, NOT_NEGATIVE, Shared,
        "Area that two axis-aligned boxes share.";
    IouAabb2 = iou_aabb2 over Union, IOU.split_at(4).0, FromZero, RATIO, Union,
        "Intersection over union of two axis-aligned boxes, 0 to 1.";
    IofAabb2 = iof_aabb2 over First, IOF.split_at(3).0, FromZero, RATIO, Ratio,
        "The part of the first of two axis-aligned boxes that lies in the second, 0 to 1.";
}
