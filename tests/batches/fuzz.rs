//! Inputs that nobody would think of, and whether the search for them finds what is wrong.
use geograd::kernels::IouObb2;
use geograd::kernels::fuzz::{self, Promise};
use geograd::kernels::op::{Jumps, Op, Slopes};
use geograd::{Obb2, Scalar};

#[test]
fn every_operation_keeps_its_promises() {
    for (name, double, run) in geograd_tests::fuzzers::fuzzers() {
        let fuzzed = run(100_000, 2);
        assert!(fuzzed.inputs >= 100_000, "{name}, f64: {double}");
        assert_eq!(fuzzed.broken, None, "{fuzzed}");
    }
}

/// The overlap of rotated boxes with a mistake.
#[derive(Clone, Copy, Debug, Default)]
struct Faulty<const FAULT: usize>;

/// A slope is no number where a box is long.
const NO_NUMBER: usize = 0;
/// What shares more than half shares more than all.
const OUT_OF_RANGE: usize = 1;
/// Identical boxes are nearly so.
const NOT_ITSELF: usize = 2;
/// The first box counts more.
const ONE_SIDED: usize = 3;
/// There are no slopes to record.
const REFUSED: usize = 4;

impl<const FAULT: usize> Op for Faulty<FAULT> {
    const NAME: &'static str = IouObb2::NAME;
    type In<S: Scalar> = (Obb2<S>, Obb2<S>);
    type Out<S: Scalar> = S;
    const PROMISES: &'static [geograd::kernels::op::Promise] = IouObb2::PROMISES;
    const JUMPS: Jumps = IouObb2::JUMPS;
    const SLOPES: Slopes = Slopes::ByHand;
    fn eval<S: Scalar>((a, b): Self::In<S>) -> S {
        faulty::<S, FAULT>(a, b, IouObb2::eval((a, b)))
    }
    fn adjoint<S: Scalar>((a, b): Self::In<S>, out_bar: S) -> Option<(S, Self::In<S>)> {
        if FAULT == REFUSED {
            return None;
        }
        let (value, (mut a_bar, b_bar)) = IouObb2::adjoint((a, b), out_bar)?;
        if FAULT == NO_NUMBER {
            let long = a.size.x.above(S::lit(2e4)) & value.above(S::zero());
            let nothing = a.size.x * S::zero();
            a_bar.heading = S::select(long, nothing.over(nothing), a_bar.heading);
        }
        Some((faulty::<S, FAULT>(a, b, value), (a_bar, b_bar)))
    }
}

/// The value with a mistake.
fn faulty<S: Scalar, const FAULT: usize>(a: Obb2<S>, b: Obb2<S>, value: S) -> S {
    let when = |mask, x: S| S::select(mask, x, value);
    match FAULT {
        OUT_OF_RANGE => {
            let many = value.above(S::lit(0.5)) & value.below(S::one());
            when(many, value + S::lit(0.75))
        }
        NOT_ITSELF => when(value.equals(S::one()), value - S::lit(1e-3)),
        ONE_SIDED => when(a.size.x.above(b.size.x), value.over(S::lit(1.001))),
        _ => value,
    }
}

/// What is found within a million inputs.
fn found<const FAULT: usize>() -> Option<Promise> {
    let fuzzed = fuzz::pairs::<Faulty<FAULT>, _, f32>(1_000_000, 3);
    let broken = fuzzed.broken?;
    assert_eq!(broken.input.len(), 10, "both boxes are named");
    Some(broken.promise)
}

#[test]
fn what_is_wrong_is_found_and_named() {
    assert_eq!(found::<NO_NUMBER>(), Some(Promise::Finite));
    assert_eq!(found::<OUT_OF_RANGE>(), Some(Promise::Range));
    assert_eq!(found::<NOT_ITSELF>(), Some(Promise::Identical));
    assert_eq!(found::<ONE_SIDED>(), Some(Promise::Symmetric));
    assert_eq!(found::<REFUSED>(), Some(Promise::Accepted));
}
