//! The bodies of a fold as programs, and its adjoint from the result to every edge.
use crate::ad::program::record::record;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Sym};
use crate::kernels::fold::Fold;
use crate::kernels::recording::{Kept, known};
use crate::{Error, Fixed, Pack, Scalar};
use std::sync::Arc;

/// The recording of a fold in a format: its bodies as programs.
pub(crate) struct Programs {
    /// From context, reference and both ends to a state, and its pull-back.
    pub(crate) edge: Recorded,
    pub(crate) edge_vjp: Recorded,
    /// Joining two states, and its pull-back.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a GPU joins by it")
    )]
    pub(crate) join: Recorded,
    pub(crate) join_vjp: Recorded,
    /// The end, and its pull-back.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a GPU ends by it")
    )]
    pub(crate) finish: Recorded,
    pub(crate) finish_vjp: Recorded,
    /// The plans of machines.
    pub(crate) made: Kept,
}

pub(crate) fn programs<F: Fold, T: Plain>() -> Result<Arc<Programs>, Error> {
    type Context<F, T> = <F as Fold>::Context<Sym<T>>;
    type Reference<F, T> = <F as Fold>::Reference<Sym<T>>;
    type State<F, T> = <F as Fold>::State<Sym<T>>;
    type Element<F, T> = <F as Fold>::Element<Sym<T>>;
    type Edge<F, T> = (Context<F, T>, Reference<F, T>, Element<F, T>, Element<F, T>);
    known::<(F, T), _>(|| {
        let edge = record::<T, Edge<F, T>, State<F, T>>(|(context, reference, from, to)| {
            F::edge(context, reference, from, to)
        })?;
        let join = record::<T, (State<F, T>, State<F, T>), State<F, T>>(|(a, b)| F::join(a, b))?;
        let finish = record::<T, (Context<F, T>, Reference<F, T>, State<F, T>), F::Out<Sym<T>>>(
            |(context, reference, state)| F::finish(context, reference, state),
        )?;
        Ok(Programs {
            edge_vjp: edge.value_vjp(),
            join_vjp: join.vjp(),
            finish_vjp: finish.vjp(),
            edge,
            join,
            finish,
            made: Kept::default(),
        })
    })
}

/// The cotangents of the context and of the states of all edges, from that of a result.
pub(crate) fn backwards<F: Fold, S: Scalar>(
    programs: &Programs,
    shared: &[S],
    states: &[F::State<S>],
    winding: Option<S>,
    out_bar: F::Out<S>,
) -> (Vec<S>, Vec<F::State<S>>) {
    // The joined states before every edge, and after the last one.
    let mut before = vec![F::empty::<S>()];
    for &state in states {
        before.push(F::join(before[before.len() - 1], state));
    }
    let last = with_winding::<F, S>(before[states.len()], winding);
    let input = [shared, &last.scalars(), &out_bar.scalars()].concat();
    let bars = programs.finish_vjp.run_on(&input);
    let mut bar = F::State::<S>::load(&bars[shared.len()..]);
    let mut state_bars = vec![bar; states.len()];
    for k in (0..states.len()).rev() {
        let input = [before[k].scalars(), states[k].scalars(), bar.scalars()].concat();
        let bars = programs.join_vjp.run_on(&input);
        bar = F::State::<S>::load(&bars);
        state_bars[k] = F::State::<S>::load(&bars[F::State::<S>::LEN..]);
    }
    (bars[..F::Context::<S>::LEN].to_vec(), state_bars)
}

/// A state with the winding number of all edges, where that is known.
pub(super) fn with_winding<F: Fold, S: Scalar>(
    state: F::State<S>,
    winding: Option<S>,
) -> F::State<S> {
    let (Some(place), Some(winding)) = (F::WINDING, winding) else {
        return state;
    };
    let mut numbers = state.scalars();
    numbers[place] = winding;
    F::State::load(&numbers)
}
