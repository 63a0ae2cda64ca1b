//! The bodies of a fold as programs, and its adjoint from the result to every edge.
use crate::ad::program::Sym;
use crate::ad::program::record::record;
use crate::ad::program::recorded::Recorded;
use crate::kernels::fold::Fold;
use crate::kernels::recording::{Kept, known};
use crate::{Error, Real};
use std::sync::Arc;

/// The recording of a fold in a format: its bodies as programs.
pub(crate) struct Programs {
    /// From context, reference and both ends to a state, and its pull-back.
    pub(crate) edge: Recorded,
    pub(crate) edge_vjp: Recorded,
    /// Joining two states, and its pull-back.
    #[cfg_attr(
        not(any(feature = "gpu", feature = "check")),
        expect(dead_code, reason = "only a GPU and the harness join by it")
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

pub(crate) fn programs<F: Fold, T: Real>() -> Result<Arc<Programs>, Error> {
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
