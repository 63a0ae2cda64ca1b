//! Operations with a search: decided on plain values, then replayed.
//!
//! A search yields a *record* of decisions: indices and small enums, never numbers. The result is computed
//! from the input and the record by a straight line, which duals and batches replay. Between decisions
//! the result is smooth; where a decision changes, its derivatives are those of the one that was taken.
use crate::error::Error;
use crate::kernels::cpu::plan::{Face, Known, Want, known, name, of_items};
use crate::kernels::item::{Item, by_kind, by_shape, get, leaves_of, width};
use crate::kernels::op::{
    Ask, Extremes, Finite, Invariance, Jacobian, Jumps, Limits, Range, Source,
};
use crate::{Fixed, Jet, Pack, Scalar};
use std::fmt::Debug;
use std::hash::Hash;
use std::sync::Arc;

/// An operation with a search.
///
/// Batches run those of the library. One of another crate is checked by the harness
/// ([`check_search_with`](crate::kernels::check::check_search_with)), but no batch takes it: that `Runs` is implemented
/// for it by its input, which is not of that crate either, is what Rust's rule of orphans forbids.
pub trait Search: Copy + Debug + Default + Send + Sync + 'static {
    /// The name of the function, letter for letter.
    const NAME: &'static str;
    /// What it takes, made of any scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// What it gives, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// What was decided. Items of the same record are replayed alike: a GPU is given every replay once.
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// Its invariances under motions; `&[]` declares none.
    const INVARIANCES: &'static [Invariance];
    /// Where its value may jump.
    const JUMPS: Jumps;
    /// Of which inputs values and derivatives are finite.
    const FINITE: Finite = Finite::Within(Limits::ORDINARY);
    /// Within which every number of its result lies.
    const RANGE: Range = Range::ANY;
    /// What identical shapes and shapes apart score.
    const EXTREMES: Extremes = Extremes::Undeclared;
    /// The names of its arguments, one for each; empty without names of their own.
    const ARGUMENTS: &'static [&'static str] = &[];
    /// Documentation in Markdown: the doc comment of its row, empty without one.
    const DOC: &'static str = "";
    /// The search.
    fn decide<S: Scalar<Mask = bool>>(input: Self::In<S>) -> Self::Record;
    /// The result, given what was decided.
    fn replay<S: Scalar>(input: Self::In<S>, record: Self::Record) -> Self::Out<S>;
    /// The operation whose result is the result with its gradient, for one number as result.
    fn value_grad(self) -> crate::kernels::op::ValueGrad<Self> {
        crate::kernels::op::ValueGrad(self)
    }
    /// The operation whose result is the result with its Jacobian; see [`Op::jacobian`](crate::kernels::Op::jacobian).
    fn jacobian(self) -> Jacobian<Self> {
        Jacobian(self)
    }
    /// Its adjoint: from an input and a cotangent of the result to the cotangent of the input.
    fn vjp(self) -> crate::kernels::op::Vjp<Self> {
        crate::kernels::op::Vjp(self)
    }
}

/// Numbers of the input whose derivatives are taken at a time.
const AT_A_TIME: usize = 4;

/// The numbers of a result with derivatives with respect to some numbers of the input, from one on.
fn replayed<D: Search<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    codes: &[u32],
    first: usize,
    record: D::Record,
) -> Vec<Jet<R::Scalar, AT_A_TIME>> {
    let jets = numbers[..R::LEN].iter().enumerate();
    let jets: Vec<Jet<R::Scalar, AT_A_TIME>> = jets
        .map(|(i, &x)| Jet::variable(x, i.wrapping_sub(first)))
        .collect();
    let moved = D::In::<Jet<R::Scalar, AT_A_TIME>>::load(&jets).load_codes(codes);
    D::replay::<Jet<R::Scalar, AT_A_TIME>>(moved, record).scalars()
}

/// The result of one item, and the gradient of each of its numbers.
fn item_and_jacobian<D: Search<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    out: &mut [R::Scalar],
) {
    let numbers = by_kind::<R>(numbers);
    let input = get::<R>(&numbers);
    let record = D::decide::<R::Scalar>(input);
    let codes: Vec<u32> = input.codes();
    let mut rows = vec![R::Scalar::default(); D::Out::<R::Scalar>::LEN * R::LEN];
    for first in (0..R::LEN).step_by(AT_A_TIME) {
        let replayed = replayed::<D, R>(&numbers, &codes, first, record);
        for (row, jet) in rows.chunks_exact_mut(R::LEN).zip(replayed) {
            for (entry, derivative) in row[first..].iter_mut().zip(jet.derivative) {
                *entry = derivative;
            }
        }
    }
    D::replay::<R::Scalar>(input, record).store(out);
    let gradients = out[D::Out::<R::Scalar>::LEN..].chunks_exact_mut(width::<R>());
    for (row, gradient) in rows.chunks_exact(R::LEN).zip(gradients) {
        // A gradient has the input's codes.
        by_shape::<R>(row, &codes, gradient);
    }
}

/// The result of one item, and derivatives times a cotangent (ones, if there is none).
fn item<D: Search<In<<R as Pack>::Scalar> = R>, R: Item>(
    numbers: &[R::Scalar],
    out_bar: Option<&[R::Scalar]>,
    out: &mut [R::Scalar],
    derivatives: bool,
) {
    let numbers = by_kind::<R>(numbers);
    let input = get::<R>(&numbers);
    let record = D::decide::<R::Scalar>(input);
    let result = D::Out::<R::Scalar>::LEN;
    D::replay::<R::Scalar>(input, record).store(out);
    if !derivatives {
        return;
    }
    let codes: Vec<u32> = input.codes();
    let mut bars = vec![R::Scalar::default(); R::LEN];
    for first in (0..R::LEN).step_by(AT_A_TIME) {
        let replayed = replayed::<D, R>(&numbers, &codes, first, record);
        for (k, jet) in replayed.into_iter().enumerate() {
            let by = out_bar.map_or(R::Scalar::one(), |out_bar| out_bar[k]);
            for (bar, derivative) in bars[first..].iter_mut().zip(jet.derivative) {
                *bar = if k == 0 {
                    derivative * by
                } else {
                    *bar + derivative * by
                };
            }
        }
    }
    // A gradient has the input's codes.
    by_shape::<R>(&bars, &codes, &mut out[result..]);
}

/// How batches compute what is wanted of an operation.
#[doc(hidden)]
pub fn face<D, R: Item>(ask: Ask) -> Result<Arc<Face<R::Scalar>>, Error>
where
    D: Search<In<<R as Pack>::Scalar> = R>,
    D::Out<R::Scalar>: Item,
{
    let want = ask.want;
    known::<D, R::Scalar, _>(Known::Face(want, false), || {
        let outputs = leaves_of::<D::Out<R::Scalar>>();
        let outputs = outputs.iter().map(|leaf| leaf.fields).collect();
        let mut face = of_items(
            want,
            leaves_of::<R>(),
            outputs,
            match want {
                Want::Value => |x, bar, out| item::<D, R>(x, bar, out, false),
                Want::Jacobian => |x, _, out| item_and_jacobian::<D, R>(x, out),
                Want::ValueGrad | Want::Vjp => |x, bar, out| item::<D, R>(x, bar, out, true),
            },
        );
        name(&mut face.arguments, D::ARGUMENTS);
        Ok(face)
    })
}

/// What a GPU replays of an operation with a search; nothing without the feature `gpu`.
#[cfg(feature = "gpu")]
#[doc(hidden)]
#[macro_export]
macro_rules! __replays {
    ([$scalar:ident] $op:ty, $input:ty) => {
        fn replays(
            &self,
            ask: $crate::kernels::op::Ask,
        ) -> ::core::option::Option<
            ::core::result::Result<
                ::std::sync::Arc<dyn $crate::kernels::replays::Replays<$scalar>>,
                $crate::Error,
            >,
        > {
            ::core::option::Option::Some($crate::kernels::replays::of::<$op, $input>(ask))
        }
    };
}
#[cfg(not(feature = "gpu"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __replays {
    ($($nothing:tt)*) => {};
}

/// Batches run an operation with a search. The macro is given constants, the operation, its input and its output,
/// made of `S`.
#[doc(hidden)]
#[macro_export]
macro_rules! __runs_search {
    ([$($constant:tt)*] $op:ty: $input:ty => $out:ty) => {
        impl<S: $crate::kernels::real::Real, $($constant)*> $crate::kernels::Runs<$input> for $op
        where
            $out: $crate::kernels::Item<Scalar = S>,
        {
            type Out = $out;
            fn face(
                &self,
                ask: $crate::kernels::op::Ask,
            ) -> ::core::result::Result<::std::sync::Arc<$crate::kernels::cpu::Face<S>>, $crate::Error> {
                $crate::kernels::search::face::<Self, $input>(ask)
            }
            $crate::__replays!([S] Self, $input);
        }
    };
}

/// An operation with a search, as the harness sees it.
#[derive(Clone, Copy, Debug)]
pub struct Replayed<D>(std::marker::PhantomData<D>);

impl<D: Search> Source for Replayed<D> {
    const NAME: &'static str = D::NAME;
    type In<S: Scalar> = D::In<S>;
    type Out<S: Scalar> = D::Out<S>;
    const INVARIANCES: &'static [Invariance] = D::INVARIANCES;
    const JUMPS: Jumps = D::JUMPS;
    const SEARCHES: bool = true;
    fn eval<S: Scalar<Mask = bool>>(&input: &Self::In<S>) -> Self::Out<S> {
        D::replay(input, D::decide(input))
    }
    fn vjp<S: Scalar<Mask = bool>>(&input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S> {
        let record = D::decide(input);
        let (numbers, codes, out_bar) = (input.scalars(), input.codes(), out_bar.scalars());
        let derivative = |at: usize| {
            let jets = numbers.iter().enumerate();
            let jets: Vec<Jet<S, 1>> = jets
                .map(|(i, &x)| Jet {
                    value: x,
                    derivative: [if i == at { S::one() } else { S::zero() }],
                })
                .collect();
            let moved = D::In::<Jet<S, 1>>::load(&jets).load_codes(&codes);
            let found = D::replay(moved, record).scalars();
            let terms = found
                .iter()
                .zip(&out_bar)
                .map(|(jet, &bar)| jet.derivative[0] * bar);
            terms.fold(S::zero(), |sum, term| sum + term)
        };
        let bars: Vec<S> = (0..numbers.len()).map(derivative).collect();
        D::In::<S>::load(&bars).load_codes(&codes)
    }
    fn map<S: Scalar, T: Scalar>(input: &Self::In<S>, f: &mut impl FnMut(S) -> T) -> Self::In<T> {
        let numbers: Vec<T> = input.scalars().into_iter().map(f).collect();
        D::In::<T>::load(&numbers).load_codes(&input.codes())
    }
}
