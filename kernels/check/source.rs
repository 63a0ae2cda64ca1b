//! Operations, searches and folds as the harness takes them: one function, generic over the scalar, and its adjoint.
use crate::ad::check::trace::Number;
use crate::kernels::cpu::folds::{backwards, programs};
use crate::kernels::fold::{Fold, edges, fold};
use crate::kernels::op::{Derivative, Invariance, Jumps, Op, RingOp};
use crate::kernels::recording::{Mode, program_of};
use crate::kernels::search::Search;
use crate::{Fixed, Jet, Pack, Scalar, Vec2};

/// An operation as a subject of the harness.
pub trait Source: 'static {
    /// The name of the forward function, letter for letter.
    const NAME: &'static str;
    /// The argument, made of any scalar.
    type In<S: Scalar>: Pack<Scalar = S>;
    /// The result, made of the same scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// Motions of the argument and their effect on the result.
    const INVARIANCES: &'static [Invariance];
    /// Places at which the value may jump.
    const JUMPS: Jumps;
    /// `true` for a search, whose derivatives are those of its replay.
    const SEARCHES: bool = false;
    /// The generic source.
    fn eval<S: Scalar<Mask = bool>>(input: &Self::In<S>) -> Self::Out<S>;
    /// The gradient of `out_bar · output` with respect to the input.
    fn vjp<S: Scalar<Mask = bool>>(input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S>;
    /// The function on num-dual's numbers; only for operations with an adjoint by hand, as a witness of it.
    fn on_num_dual<S: Number>(_input: &Self::In<S::NumDual>) -> Option<Self::Out<S::NumDual>> {
        None
    }
    /// An input like another one, made of the numbers of a list.
    fn made<T: Scalar>(like: &Self::In<f64>, numbers: &[T]) -> Self::In<T>;
}

/// An operation of fixed size as a subject of the harness.
#[derive(Clone, Copy, Debug)]
pub struct Straight<O>(std::marker::PhantomData<O>);

impl<O: Op> Source for Straight<O> {
    const NAME: &'static str = O::NAME;
    type In<S: Scalar> = O::In<S>;
    type Out<S: Scalar> = O::Out<S>;
    const INVARIANCES: &'static [Invariance] = O::INVARIANCES;
    const JUMPS: Jumps = O::JUMPS;
    fn eval<S: Scalar<Mask = bool>>(&input: &Self::In<S>) -> Self::Out<S> {
        O::eval(input)
    }
    fn vjp<S: Scalar<Mask = bool>>(&input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S> {
        if let Some((_, input_bar)) = O::adjoint(input, out_bar) {
            return input_bar;
        }
        // In the format that the scalar has.
        let recorded = match S::EPSILON > 1e-10 {
            true => program_of::<O, f32>(Mode::Vjp),
            false => program_of::<O, f64>(Mode::Vjp),
        };
        let numbers = [input.scalars(), out_bar.scalars()].concat();
        match recorded {
            Ok(recorded) => {
                let all = recorded.run_on(&numbers);
                O::In::load(&all[Self::Out::<S>::LEN..])
            }
            // A function that cannot be recorded has no derivatives: the harness reports NaN.
            Err(_) => O::In::filled(S::lit(f64::NAN)),
        }
    }
    fn on_num_dual<S: Number>(&input: &Self::In<S::NumDual>) -> Option<Self::Out<S::NumDual>> {
        match const { matches!(O::DERIVATIVE, Derivative::ByHand) } {
            true => Some(O::eval(input)),
            false => None,
        }
    }
    fn made<T: Scalar>(_like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        O::In::load(numbers)
    }
}

/// An operation of a ring as a subject of the harness.
#[derive(Clone, Copy, Debug)]
pub struct Ringed<O>(std::marker::PhantomData<O>);

impl<O: RingOp> Source for Ringed<O> {
    const NAME: &'static str = O::NAME;
    type In<S: Scalar> = Vec<Vec2<S>>;
    type Out<S: Scalar> = O::Out<S>;
    const INVARIANCES: &'static [Invariance] = O::INVARIANCES;
    const JUMPS: Jumps = O::JUMPS;
    fn eval<S: Scalar<Mask = bool>>(ring: &Vec<Vec2<S>>) -> O::Out<S> {
        O::value(ring)
    }
    fn vjp<S: Scalar<Mask = bool>>(ring: &Vec<Vec2<S>>, out_bar: O::Out<S>) -> Vec<Vec2<S>> {
        let mut ring_bar = vec![Vec2::zero(); ring.len()];
        O::ring_vjp(ring, out_bar, &mut ring_bar);
        ring_bar
    }
    fn on_num_dual<S: Number>(ring: &Vec<Vec2<S::NumDual>>) -> Option<O::Out<S::NumDual>> {
        Some(O::value(ring))
    }
    fn made<T: Scalar>(_like: &Vec<Vec2<f64>>, numbers: &[T]) -> Vec<Vec2<T>> {
        points(numbers)
    }
}

/// The decisions, which derivatives have no part in: a search is compiled for plain numbers alone.
fn decided<D: Search, S: Scalar<Mask = bool>>(input: D::In<S>) -> D::Record {
    let mut numbers = Vec::new();
    for x in input.scalars() {
        numbers.push(x.primal());
    }
    D::decide(D::In::<S::Primal>::load(&numbers).load_codes(&input.codes()))
}

/// The derivative of a result along a direction, times a cotangent.
fn along<S: Scalar>(result: &[Jet<S, 1>], out_bar: &[S]) -> S {
    let terms = result.iter().zip(out_bar);
    let terms = terms.map(|(jet, &bar)| jet.derivative[0] * bar);
    terms.fold(S::zero(), |sum, term| sum + term)
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
        D::replay(input, decided::<D, S>(input))
    }
    fn vjp<S: Scalar<Mask = bool>>(&input: &Self::In<S>, out_bar: Self::Out<S>) -> Self::In<S> {
        let record = decided::<D, S>(input);
        let (numbers, codes, out_bar) = (input.scalars(), input.codes(), out_bar.scalars());
        let mut jets: Vec<Jet<S, 1>> = Vec::new();
        for &value in &numbers {
            let derivative = [S::zero()];
            jets.push(Jet { value, derivative });
        }
        let mut bars = numbers;
        for (at, bar) in bars.iter_mut().enumerate() {
            jets[at].derivative[0] = S::one();
            let moved = D::In::<Jet<S, 1>>::load(&jets).load_codes(&codes);
            jets[at].derivative[0] = S::zero();
            *bar = along(&D::replay(moved, record).scalars(), &out_bar);
        }
        D::In::<S>::load(&bars).load_codes(&codes)
    }
    fn made<T: Scalar>(like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        D::In::<T>::load(numbers).load_codes(&like.codes())
    }
}

/// A fold, as the harness sees it.
#[derive(Clone, Copy, Debug)]
pub struct Folded<F>(std::marker::PhantomData<F>);

impl<F: Fold> Source for Folded<F> {
    const NAME: &'static str = F::NAME;
    type In<S: Scalar> = (F::Context<S>, Vec<F::Element<S>>);
    type Out<S: Scalar> = F::Out<S>;
    const INVARIANCES: &'static [Invariance] = F::INVARIANCES;
    const JUMPS: Jumps = F::JUMPS;
    fn eval<S: Scalar<Mask = bool>>((context, path): &Self::In<S>) -> F::Out<S> {
        fold::<F, S>(*context, path)
    }
    fn vjp<S: Scalar<Mask = bool>>(
        (context, path): &Self::In<S>,
        out_bar: F::Out<S>,
    ) -> Self::In<S> {
        let (context_bar, path_bar) = pull_back::<F, S>(*context, path, out_bar);
        (context_bar, path_bar)
    }
    fn made<T: Scalar>(_like: &Self::In<f64>, numbers: &[T]) -> Self::In<T> {
        let (context, path) = numbers.split_at(F::Context::<T>::LEN);
        let path = path.chunks_exact(F::Element::<T>::LEN.max(1));
        (
            F::Context::load(context),
            path.map(F::Element::load).collect(),
        )
    }
}

/// The points that a list of coordinates makes up.
fn points<T: Scalar>(numbers: &[T]) -> Vec<Vec2<T>> {
    numbers.chunks_exact(2).map(Vec2::load).collect()
}

/// The adjoint of a fold for one path, on any scalar: cotangents of the context and of every vertex.
fn pull_back<F: Fold, S: Scalar>(
    context: F::Context<S>,
    path: &[F::Element<S>],
    out_bar: F::Out<S>,
) -> (F::Context<S>, Vec<F::Element<S>>) {
    // In the format that the scalar has.
    let found = match S::EPSILON > 1e-10 {
        true => programs::<F, f32>(),
        false => programs::<F, f64>(),
    };
    let Ok(programs) = found else {
        // A fold that cannot be recorded has no derivatives: the harness reports NaN.
        let none = S::lit(f64::NAN);
        return (
            Fixed::filled(none),
            vec![F::Element::filled(none); path.len()],
        );
    };
    let reference = F::reference(context, path);
    let ends = |k: usize| [path[k], path[(k + 1) % path.len()]];
    let count = edges::<F>(path.len());
    let states: Vec<F::State<S>> = (0..count)
        .map(|k| F::edge(context, reference, ends(k)[0], ends(k)[1]))
        .collect();
    let shared = [context.scalars(), reference.scalars()].concat();
    let (mut context_bar, state_bars) =
        backwards::<F, S>(&programs, &shared, &states, None, out_bar);
    let element = F::Element::<S>::LEN;
    let mut path_bar = vec![vec![S::zero(); element]; path.len()];
    for (k, state_bar) in state_bars.into_iter().enumerate() {
        let points = ends(k).map(|end| end.scalars()).concat();
        let input = [&shared[..], &points, &state_bar.scalars()].concat();
        let bars = &programs.edge_vjp.run_on(&input)[F::State::<S>::LEN..];
        for (bar, &x) in context_bar.iter_mut().zip(bars) {
            *bar += x;
        }
        let ends = bars[shared.len()..].chunks_exact(element.max(1));
        for (end, bars) in [k, (k + 1) % path.len()].into_iter().zip(ends) {
            for (bar, &x) in path_bar[end].iter_mut().zip(bars) {
                *bar += x;
            }
        }
    }
    let path_bar = path_bar.iter().map(|bar| F::Element::load(bar)).collect();
    (F::Context::load(&context_bar), path_bar)
}
