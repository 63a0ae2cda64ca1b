//! Inputs that nobody would think of, and whether the search for them finds what is wrong.
use geograd::error::{Field, Flaw};
use geograd::kernels::fuzz::{self, Fuzzed, Promise};
use geograd::kernels::{IouObb2, Op, PairOp};
use geograd::{Obb2, Scalar};

macro_rules! fuzzes {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }) => {
        [
            $(fuzz::pairs::<$pair_op, f64> as fn(u64, u64) -> Fuzzed, fuzz::pairs::<$pair_op, f32>,)*
            $(fuzz::rings::<$ring_op, f64>, fuzz::rings::<$ring_op, f32>,)*
        ]
    };
}

#[test]
fn every_operation_keeps_its_promises() {
    for run in geograd::for_each_op!(fuzzes) {
        let fuzzed = run(100_000, 2);
        assert!(fuzzed.inputs >= 100_000);
        assert_eq!(fuzzed.broken, None, "{fuzzed}");
    }
}

/// The overlap of rotated boxes with a mistake.
#[derive(Clone, Copy)]
struct Faulty<const FAULT: usize>;

/// A slope is no number where a box is long.
const NO_NUMBER: usize = 0;
/// What shares more than half shares more than all.
const OUT_OF_RANGE: usize = 1;
/// Identical boxes are nearly so.
const NOT_ITSELF: usize = 2;
/// The first box counts more.
const ONE_SIDED: usize = 3;
/// Valid boxes far away are refused.
const REFUSED: usize = 4;

type Frame<S> = <IouObb2 as PairOp>::FrameA<S>;

impl<const FAULT: usize> Op for Faulty<FAULT> {
    const NAME: &'static str = IouObb2::NAME;
    type In<S: Scalar> = <IouObb2 as Op>::In<S>;
    type Out<S: Scalar> = S;
    fn eval<S: Scalar>(x: &Self::In<S>) -> S {
        IouObb2::eval(x)
    }
    fn vjp<S: Scalar>(x: &Self::In<S>, out_bar: S) -> Self::In<S> {
        IouObb2::vjp(x, out_bar)
    }
    fn map<S: Scalar, T: Scalar>(x: &Self::In<S>, f: &mut impl FnMut(S) -> T) -> Self::In<T> {
        IouObb2::map(x, f)
    }
}

impl<const FAULT: usize> PairOp for Faulty<FAULT> {
    type A<S: Scalar> = Obb2<S>;
    type B<S: Scalar> = Obb2<S>;
    type FrameA<S: Scalar> = Frame<S>;
    type FrameB<S: Scalar> = Frame<S>;
    fn frame_a<S: Scalar>(a: Obb2<S>) -> Frame<S> {
        IouObb2::frame_a(a)
    }
    fn frame_b<S: Scalar>(b: Obb2<S>) -> Frame<S> {
        IouObb2::frame_b(b)
    }
    fn value<S: Scalar, const EXTREME: bool>(a: Frame<S>, b: Frame<S>) -> S {
        Self::grad::<S, EXTREME>(a, b).0
    }
    fn grad<S: Scalar, const EXTREME: bool>(a: Frame<S>, b: Frame<S>) -> (S, (Obb2<S>, Obb2<S>)) {
        let (value, (mut a_bar, b_bar)) = IouObb2::grad::<S, true>(a, b);
        let a_little = S::one() + S::lit(1e-3);
        let when = |mask, x: S| S::select(mask, x, value);
        let long = a.half.x.above(S::lit(1e4)) & value.above(S::zero());
        let value = match FAULT {
            NO_NUMBER => {
                let none = S::zero().over(S::zero());
                a_bar.heading = S::select(long, none, a_bar.heading);
                value
            }
            OUT_OF_RANGE => {
                let many = value.above(S::lit(0.5)) & value.below(S::one());
                when(many, value + S::lit(0.75))
            }
            NOT_ITSELF => when(value.equals(S::one()), value - S::lit(1e-3)),
            ONE_SIDED => when(a.half.x.above(b.half.x), value.over(a_little)),
            _ => value,
        };
        (value, (a_bar, b_bar))
    }
    fn is_ordinary_a<S: Scalar<Mask = bool>>(a: Obb2<S>) -> bool {
        IouObb2::is_ordinary_a(a)
    }
    fn is_ordinary_b<S: Scalar<Mask = bool>>(b: Obb2<S>) -> bool {
        IouObb2::is_ordinary_b(b)
    }
    fn check_a<S: Scalar<Mask = bool>>(a: &Obb2<S>) -> Result<bool, Flaw> {
        IouObb2::check_a(a)
    }
    fn check_b<S: Scalar<Mask = bool>>(b: &Obb2<S>) -> Result<bool, Flaw> {
        match FAULT {
            REFUSED if b.center.x.above(S::lit(3e4)) => Err(Flaw::NotFinite(Field::X)),
            _ => IouObb2::check_b(b),
        }
    }
}

/// What is found within a million inputs.
fn found<const FAULT: usize>() -> Option<Promise> {
    let fuzzed = fuzz::pairs::<Faulty<FAULT>, f32>(1_000_000, 3);
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
