//! Untyped folds: functions of numbers and programs, so that other code is compiled once for all folds.
use crate::ad::program::Neutral;
use crate::ad::program::record::record_in;
use crate::ad::program::recorded::Recorded;
use crate::error::Field;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::{Item, Leaf, leaves_of};
use crate::kernels::row::once::{RecordingCache, known};
use crate::ring::Measure;
use crate::scalar::Format;
use crate::{Error, Fixed, Pack, Real, Scalar};
use std::sync::Arc;

/// The numbers of scalars of a fold's parts.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// The number of scalars of a context.
    pub(crate) own: usize,
    /// The number of scalars of a context with its reference vertex.
    pub(crate) wide: usize,
    /// The number of scalars of an element of a path.
    pub(crate) element: usize,
    pub(crate) state: usize,
    pub(crate) out: usize,
    /// `true` if an edge leads from the last vertex back to the first.
    pub(crate) closed: bool,
    /// The index in the state of the winding number.
    pub(crate) winding: Option<usize>,
    /// `true` if nothing but the winding number is needed.
    pub(crate) is_winding: bool,
    /// `true` for the length of a polyline.
    pub(crate) is_length: bool,
}

impl Sizes {
    pub(crate) const fn of<F: Fold>() -> Self {
        Sizes {
            own: F::Context::<f64>::LEN,
            wide: F::Context::<f64>::LEN + F::Reference::<f64>::LEN,
            element: F::Element::<f64>::LEN,
            state: F::State::<f64>::LEN,
            out: F::Out::<f64>::LEN,
            closed: F::CLOSED,
            winding: F::WINDING,
            is_winding: F::IS_WINDING,
            is_length: F::IS_LENGTH,
        }
    }
    /// Splits a list of numbers into states; an empty list if states have no numbers.
    pub(crate) fn states<'a, S>(&self, numbers: &'a [S]) -> std::slice::ChunksExact<'a, S> {
        numbers.chunks_exact(self.state.max(1))
    }
    /// Sets the winding number in a state, if it is known.
    pub(crate) fn wind<S: Copy>(&self, state: &mut [S], winding: Option<S>) {
        if let (Some(place), Some(winding)) = (self.winding, winding) {
            state[place] = winding;
        }
    }
    /// Returns the number of edges of a path with `vertices` vertices.
    pub(crate) fn edges(&self, vertices: usize) -> usize {
        match self.closed {
            true => vertices,
            false => vertices.saturating_sub(1),
        }
    }
}

/// An untyped fold in a format.
pub struct Folding<T: 'static> {
    pub(crate) sizes: Sizes,
    /// The kernels by hand of a measure of rings.
    pub(crate) measure: Option<Measure>,
    pub(crate) arguments: &'static [&'static str],
    pub(crate) leaves: fn() -> Vec<Leaf<T>>,
    /// The names of an element's numbers.
    pub(crate) field: fn(usize) -> Field,
    pub(crate) programs: fn() -> Result<Arc<FoldPrograms>, Error>,
    /// Writes the join of a list of states.
    pub(crate) joined: fn(&[T], &mut [T]),
    /// Returns the joined states before every one of a list, and after the last.
    pub(crate) before: fn(&[T]) -> Vec<T>,
    /// Writes the result of a context with its reference, and a state.
    pub(crate) finish: fn(&[T], &[T], &mut [T]),
}

impl<T: Real> Folding<T> {
    pub(crate) const fn of<F: Fold, R: Item<Scalar = T>>() -> Self {
        Folding {
            sizes: Sizes::of::<F>(),
            measure: F::MEASURE,
            arguments: F::DECLARED.arguments,
            leaves: leaves_of::<R>,
            field: F::Element::<T>::name,
            programs: programs::<F, T>,
            joined: joined::<F, T>,
            before: before::<F, T>,
            finish: finish::<F, T>,
        }
    }
}

fn joined<F: Fold, T: Scalar>(states: &[T], to: &mut [T]) {
    let mut state = F::empty::<T>();
    for next in Sizes::of::<F>().states(states) {
        state = F::join(state, F::State::load(next));
    }
    state.store(to);
}

fn before<F: Fold, T: Scalar>(states: &[T]) -> Vec<T> {
    let mut state = F::empty::<T>();
    let mut all = state.scalars();
    for next in Sizes::of::<F>().states(states) {
        state = F::join(state, F::State::load(next));
        all.extend(state.scalars());
    }
    all
}

fn finish<F: Fold, T: Scalar>(shared: &[T], state: &[T], out: &mut [T]) {
    let (context, reference) = (F::Context::load(shared), &shared[F::Context::<T>::LEN..]);
    F::finish(
        context,
        F::Reference::load(reference),
        F::State::load(state),
    )
    .store(out);
}

/// Returns the cotangents of context and reference, and of the states of all edges one after another, from the
/// cotangent of a result. `before` has the joined states before every edge, and after the last one.
pub(crate) fn backwards<S: Scalar>(
    sizes: &Sizes,
    programs: &FoldPrograms,
    shared: &[S],
    [states, before]: [&[S]; 2],
    winding: Option<S>,
    out_bar: &[S],
) -> (Vec<S>, Vec<S>) {
    let (inner, last) = before.split_at(before.len() - sizes.state);
    let mut last = last.to_vec();
    sizes.wind(&mut last, winding);
    let bars = programs
        .finish_vjp
        .run_on(&[shared, &last, out_bar].concat());
    let (shared_bar, bar) = bars.split_at(shared.len());
    let mut bar = bar.to_vec();
    let mut state_bars = vec![S::zero(); states.len()];
    let edges = sizes.states(inner).zip(sizes.states(states));
    let places = state_bars.chunks_exact_mut(sizes.state.max(1));
    for ((before, state), place) in edges.zip(places).rev() {
        let bars = programs.join_vjp.run_on(&[before, state, &bar].concat());
        bar.copy_from_slice(&bars[..sizes.state]);
        place.copy_from_slice(&bars[sizes.state..]);
    }
    (shared_bar.to_vec(), state_bars)
}

/// The recording of a fold in a format: its parts as programs.
pub(crate) struct FoldPrograms {
    /// From context, reference and both ends to the state of an edge; and its pull-back.
    pub(crate) edge: Recorded,
    pub(crate) edge_vjp: Recorded,
    /// The join of two states; and its pull-back.
    #[cfg_attr(
        not(any(feature = "gpu", feature = "check")),
        expect(dead_code, reason = "only a GPU and the harness join by it")
    )]
    pub(crate) join: Recorded,
    pub(crate) join_vjp: Recorded,
    /// From context, reference and state to the result; and its pull-back.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a GPU ends by it")
    )]
    pub(crate) finish: Recorded,
    pub(crate) finish_vjp: Recorded,
    /// The plans of machines.
    pub(crate) made: RecordingCache,
}

pub(crate) fn programs<F: Fold, T: Real>() -> Result<Arc<FoldPrograms>, Error> {
    known::<(F, T), _>(|| recorded::<F>(T::FORMAT))
}

/// Records the parts of a fold, for both formats.
fn recorded<F: Fold>(format: Format) -> Result<FoldPrograms, Error> {
    type Context<F> = <F as Fold>::Context<Neutral>;
    type Reference<F> = <F as Fold>::Reference<Neutral>;
    type State<F> = <F as Fold>::State<Neutral>;
    type Element<F> = <F as Fold>::Element<Neutral>;
    type Edge<F> = (Context<F>, Reference<F>, Element<F>, Element<F>);
    type End<F> = (Context<F>, Reference<F>, State<F>);
    let edge = |(context, reference, from, to): Edge<F>| F::edge(context, reference, from, to);
    let edge = record_in(format, edge)?;
    let join = record_in(format, |(a, b): (State<F>, State<F>)| F::join(a, b))?;
    let finish = |(context, reference, state): End<F>| F::finish(context, reference, state);
    let finish = record_in(format, finish)?;
    Ok(FoldPrograms {
        edge_vjp: edge.value_vjp(),
        join_vjp: join.vjp(),
        finish_vjp: finish.vjp(),
        edge,
        join,
        finish,
        made: RecordingCache::default(),
    })
}
