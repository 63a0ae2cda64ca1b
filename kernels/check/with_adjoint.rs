//! Operations, searches and folds in the harness's form: one function, generic over the scalar, and its adjoint.
use crate::ad::check::trace::{Trace, Traced, trace};
use crate::kernels::call::folding::{FoldPrograms, Sizes, backwards, programs};
use crate::kernels::call::replayed::pull_back_of_replay;
use crate::kernels::call::search::HintedSearch;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::fold::{Fold, by_hand, fold};
use crate::kernels::row::op::program_of;
use crate::kernels::row::op::{Declared, Derivative, Op};
use crate::{Fixed, Pack, Real, Scalar};
use std::sync::Arc;

/// The format in which a search decides.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecidesIn {
    /// That of its numbers.
    Own,
    /// Single precision, whatever its numbers: the source in double precision of a search whose decisions depend on
    /// roundings.
    Single,
}

/// A function, generic over the scalar, with its adjoint: the harness's form of an operation, a search or a fold.
#[doc(hidden)]
pub trait WithAdjoint: 'static {
    /// The declared properties of the forward function.
    const DECLARED: Declared;
    /// The argument, generic over the scalar.
    type In<S: Scalar>: Pack<Scalar = S>;
    /// The result, generic over the scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// `true` for a search, whose derivatives are its replay's.
    const SEARCHES: bool = false;
    /// Returns the result by the generic source.
    fn eval<S: Scalar<Mask = bool>>(input: &Self::In<S>) -> Self::Out<S>;
    /// Returns the numbers of the gradient of `out_bar · output` with respect to the input.
    fn pulled<S: Scalar<Mask = bool>>(input: &Self::In<S>, out_bar: Self::Out<S>) -> Vec<S>;
    /// Returns the result by decisions in a format, which only a search has.
    fn eval_as<S: Scalar<Mask = bool>>(_: DecidesIn, input: &Self::In<S>) -> Self::Out<S> {
        Self::eval(input)
    }
    /// Returns the numbers of the gradient by decisions in a format, which only a search has.
    fn pulled_as<S: Scalar<Mask = bool>>(
        _: DecidesIn,
        input: &Self::In<S>,
        out_bar: Self::Out<S>,
    ) -> Vec<S> {
        Self::pulled(input, out_bar)
    }
    /// Returns the result, and the comparisons that may change it.
    fn traced_as<S: Real>(
        decides: DecidesIn,
        input: &Self::In<Traced<S>>,
    ) -> (Self::Out<Traced<S>>, Trace) {
        trace(|| Self::eval_as(decides, input))
    }
    /// Returns the gradient of `out_bar · output` in the shape of the input.
    fn vjp<S: Scalar<Mask = bool>>(input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S> {
        input.refill(&Self::pulled(input, out_bar))
    }
    /// Returns the result on num-dual's numbers, as a witness of an adjoint by hand; `None` for other operations.
    fn on_num_dual<S: Real>(_input: &Self::In<S::NumDual>) -> Option<Self::Out<S::NumDual>> {
        None
    }
    /// Returns an input with the structure of `like` from a list of numbers.
    fn made<T: Scalar>(like: &Self::In<f64>, numbers: &[T]) -> Self::In<T>;
}

/// An operation of fixed size as a subject of the harness.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Straight<O>(std::marker::PhantomData<O>);

impl<O: Op> WithAdjoint for Straight<O> {
    const DECLARED: Declared = O::DECLARED;
    type In<S: Scalar> = O::In<S>;
    type Out<S: Scalar> = O::Out<S>;
    fn eval<S: Scalar<Mask = bool>>(&input: &Self::In<S>) -> Self::Out<S> {
        O::eval(input)
    }
    fn pulled<S: Scalar<Mask = bool>>(&input: &Self::In<S>, out_bar: Self::Out<S>) -> Vec<S> {
        if let Some((_, input_bar)) = O::adjoint(input, out_bar) {
            return input_bar.scalars();
        }
        // The scalar's epsilon tells the format.
        let recorded = match S::format().epsilon() > 1e-10 {
            true => program_of::<O, f32>(Mode::Vjp),
            false => program_of::<O, f64>(Mode::Vjp),
        };
        let numbers = [input.scalars(), out_bar.scalars()].concat();
        match recorded {
            Ok(recorded) => recorded.run_on(&numbers).split_off(Self::Out::<S>::LEN),
            // A function that cannot be recorded has no derivatives: the harness reports NaN.
            Err(_) => vec![S::lit(f64::NAN); Self::In::<S>::LEN],
        }
    }
    fn on_num_dual<S: Real>(&input: &Self::In<S::NumDual>) -> Option<Self::Out<S::NumDual>> {
        match const { matches!(O::DECLARED.derivative, Derivative::ByHand) } {
            true => Some(O::eval(input)),
            false => None,
        }
    }
    fn made<T: Scalar>(_like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        O::In::load(numbers)
    }
}

/// Returns the decisions and the hints, as constants of the input's scalar. Derivatives do not enter them, so a search
/// is compiled for plain numbers alone.
fn decided<D: HintedSearch, S: Scalar<Mask = bool>>(
    decides: DecidesIn,
    input: D::In<S>,
) -> (D::Record, D::Hints<S>) {
    let mut hints = Vec::new();
    let in_single = match decides {
        DecidesIn::Single => singles(input.scalars()),
        DecidesIn::Own => None,
    };
    let record = match in_single {
        Some(singles) => {
            let (record, found) = decided_from::<D, f32>(&input.codes(), &singles);
            for hint in found {
                hints.push(S::lit(hint.widen()));
            }
            record
        }
        None => {
            let mut numbers = Vec::new();
            for x in input.scalars() {
                numbers.push(x.primal());
            }
            let (record, found) = decided_from::<D, S::Primal>(&input.codes(), &numbers);
            for hint in found {
                hints.push(S::from_primal(hint));
            }
            record
        }
    };
    (record, D::Hints::load(&hints))
}

/// Returns numbers in single precision; `None` of scalars that have no plain value.
fn singles<S: Scalar>(numbers: Vec<S>) -> Option<Vec<f32>> {
    let mut all = Vec::new();
    for x in numbers {
        all.push(f32::nearest(x.widened()?));
    }
    Some(all)
}

/// Returns the decisions and the hints, given the numbers of an input and its codes.
fn decided_from<D: HintedSearch, P: Scalar<Mask = bool>>(
    codes: &[u32],
    numbers: &[P],
) -> (D::Record, Vec<P>) {
    let (record, hints) = D::decide_with_hints(D::In::<P>::load(numbers).load_codes(codes));
    (record, hints.scalars())
}

/// A search in the harness's form.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Replayed<D>(std::marker::PhantomData<D>);

impl<D: HintedSearch> WithAdjoint for Replayed<D> {
    const DECLARED: Declared = D::DECLARED;
    type In<S: Scalar> = D::In<S>;
    type Out<S: Scalar> = D::Out<S>;
    const SEARCHES: bool = true;
    fn eval<S: Scalar<Mask = bool>>(input: &Self::In<S>) -> Self::Out<S> {
        Self::eval_as(DecidesIn::Own, input)
    }
    fn pulled<S: Scalar<Mask = bool>>(input: &Self::In<S>, out_bar: Self::Out<S>) -> Vec<S> {
        Self::pulled_as(DecidesIn::Own, input, out_bar)
    }
    fn eval_as<S: Scalar<Mask = bool>>(decides: DecidesIn, &input: &Self::In<S>) -> Self::Out<S> {
        let (record, hints) = decided::<D, S>(decides, input);
        D::replay_with_hints(input, record, hints)
    }
    fn pulled_as<S: Scalar<Mask = bool>>(
        decides: DecidesIn,
        &input: &Self::In<S>,
        out_bar: Self::Out<S>,
    ) -> Vec<S> {
        let (record, hints) = decided::<D, S>(decides, input);
        match pull_back_of_replay::<D>(S::format(), &input.codes(), record) {
            Ok(recorded) => {
                let mut numbers = input.scalars();
                numbers.extend(hints.scalars());
                numbers.extend(out_bar.scalars());
                recorded.run_on(&numbers)
            }
            // A replay that cannot be recorded has no derivatives: the harness reports NaN.
            Err(_) => vec![S::lit(f64::NAN); D::In::<S>::LEN],
        }
    }
    /// Returns the result; its trace is the record and the comparisons of the replay. Comparisons of the search may change
    /// at every step where its record does not, and tie where its result is smooth; so may those of a replay by roundings.
    fn traced_as<S: Real>(
        decides: DecidesIn,
        &input: &Self::In<Traced<S>>,
    ) -> (Self::Out<Traced<S>>, Trace) {
        let ((record, hints), _) = trace(|| decided::<D, Traced<S>>(decides, input));
        let (out, replay) = trace(|| D::replay_with_hints(input, record, hints));
        let replay = match D::DECLARED.by_roundings {
            true => Trace::EMPTY,
            false => replay,
        };
        (out, replay.with_record(&record))
    }
    fn made<T: Scalar>(like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        D::In::<T>::load(numbers).load_codes(&like.codes())
    }
}

/// A fold in the harness's form.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub struct Folded<F>(std::marker::PhantomData<F>);

impl<F: Fold> WithAdjoint for Folded<F> {
    const DECLARED: Declared = F::DECLARED;
    type In<S: Scalar> = (F::Context<S>, Vec<F::Element<S>>);
    type Out<S: Scalar> = F::Out<S>;
    fn eval<S: Scalar<Mask = bool>>((context, path): &Self::In<S>) -> F::Out<S> {
        fold::<F, S>(*context, path)
    }
    fn pulled<S: Scalar<Mask = bool>>((context, path): &Self::In<S>, out_bar: F::Out<S>) -> Vec<S> {
        if let Some(bars) = by_hand::<F, S>(path, out_bar) {
            return bars;
        }
        let reference = F::reference(*context, path);
        let shared = [context.scalars(), reference.scalars()].concat();
        let (sizes, empty) = (Sizes::of::<F>(), F::empty::<S>().scalars());
        match programs_of::<F, S>() {
            Some(programs) => pull_back(
                &sizes,
                &programs,
                &shared,
                empty,
                &path.scalars(),
                &out_bar.scalars(),
            ),
            // A fold that cannot be recorded has no derivatives: the harness reports NaN.
            None => vec![S::lit(f64::NAN); sizes.own + path.len() * sizes.element],
        }
    }
    fn on_num_dual<S: Real>(
        (context, path): &Self::In<S::NumDual>,
    ) -> Option<Self::Out<S::NumDual>> {
        F::MEASURE.map(|_| fold::<F, S::NumDual>(*context, path))
    }
    fn made<T: Scalar>(_like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        context_and_path::<F, T>(numbers)
    }
}

/// Returns the context and the path from a list of numbers.
pub(super) fn context_and_path<F: Fold, S: Scalar>(
    numbers: &[S],
) -> (F::Context<S>, Vec<F::Element<S>>) {
    let (context, rest) = numbers.split_at(F::Context::<S>::LEN);
    // A loop, since every adapter of an iterator would be compiled for every fold.
    let mut path = Vec::new();
    for element in rest.chunks_exact(F::Element::<S>::LEN.max(1)) {
        path.push(F::Element::load(element));
    }
    (F::Context::load(context), path)
}

/// Returns the programs of a fold, in the format of a scalar.
fn programs_of<F: Fold, S: Scalar>() -> Option<Arc<FoldPrograms>> {
    match S::format().epsilon() > 1e-10 {
        true => programs::<F, f32>().ok(),
        false => programs::<F, f64>().ok(),
    }
}

/// Returns the adjoint of a fold for one path, on any scalar: cotangents of the context and of every number of the
/// path. `shared` has the context and the reference vertex.
fn pull_back<S: Scalar>(
    sizes: &Sizes,
    programs: &FoldPrograms,
    shared: &[S],
    empty: Vec<S>,
    path: &[S],
    out_bar: &[S],
) -> Vec<S> {
    let Sizes {
        own, wide, element, ..
    } = *sizes;
    let vertices = path.len() / element.max(1);
    let numbers = |k: usize| k % vertices * element..(k % vertices + 1) * element;
    let count = sizes.edges(vertices);
    let ends = |k: usize| [shared, &path[numbers(k)], &path[numbers(k + 1)]].concat();
    let (mut states, mut before) = (Vec::new(), empty);
    for k in 0..count {
        let state = programs.edge.run_on(&ends(k));
        let last = &before[before.len() - sizes.state..];
        let joined = programs.join.run_on(&[last, &state].concat());
        before.extend(joined);
        states.extend(state);
    }
    let (mut bar, state_bars) =
        backwards(sizes, programs, shared, [&states, &before], None, out_bar);
    bar.truncate(own);
    let mut path_bar = vec![S::zero(); path.len()];
    for (k, state_bar) in sizes.states(&state_bars).enumerate() {
        let bars = &programs.edge_vjp.run_on(&[&ends(k), state_bar].concat())[sizes.state..];
        let ends = bars[wide..].chunks_exact(element.max(1));
        add(&mut bar, &bars[..own]);
        for (end, bars) in [k, k + 1].into_iter().zip(ends) {
            add(&mut path_bar[numbers(end)], bars);
        }
    }
    bar.extend(path_bar);
    bar
}
fn add<S: Scalar>(sums: &mut [S], terms: &[S]) {
    for (sum, &x) in sums.iter_mut().zip(terms) {
        *sum += x;
    }
}
