//! Replays of a search in a format, recorded once for every record that occurs.
use crate::Error;
use crate::ad::program::Sym;
use crate::ad::program::record::record_with_codes;
use crate::kernels::decision::Search;
use crate::kernels::item::{Item, by_kind, by_shape, get, width};
use crate::kernels::real::Real;
use crate::kernels::recording::{Mode, derived};
use crate::kernels::replays::{Replay, Replays, instructions};
use crate::{Fixed, Pack};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Records that are kept; beyond that many all are recorded anew.
const MOST_KNOWN: usize = 1 << 14;

/// The replays of an operation that are known.
type Replayed<D> = RwLock<HashMap<(Vec<u32>, <D as Search>::Record), Arc<Replay>>>;

struct Of<D: Search, T> {
    mode: Mode,
    known: Replayed<D>,
    format: std::marker::PhantomData<fn() -> T>,
}

/// The replays of a mode of a search, for machines that cannot search.
pub(crate) fn of<D, R: Item>(mode: Mode) -> Arc<dyn Replays<R::Scalar>>
where
    D: Search<In<<R as Pack>::Scalar> = R>,
{
    Arc::new(Of::<D, R::Scalar> {
        mode,
        known: RwLock::default(),
        format: std::marker::PhantomData,
    })
}

impl<D: Search, T: Real> Of<D, T> {
    /// Records a replay.
    fn make(&self, codes: &[u32], record: D::Record) -> Result<Replay, Error> {
        type In<D, T> = <D as Search>::In<Sym<T>>;
        type Out<D, T> = <D as Search>::Out<Sym<T>>;
        let replay = |x: In<D, T>| D::replay::<Sym<T>>(x, record);
        let recorded = record_with_codes::<T, In<D, T>, Out<D, T>>(codes, replay)?;
        let recorded = match self.mode {
            Mode::Vjp => recorded.vjp(),
            mode => derived(&recorded, mode),
        };
        instructions(
            &recorded.value.graph,
            recorded.inputs,
            &recorded.value.outputs,
        )
    }
}

impl<D: Search, T: Real> Replays<T> for Of<D, T>
where
    D::In<T>: Item<Scalar = T>,
{
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Replay>, Error> {
        let (own, out_bar) = numbers.split_at(D::In::<T>::LEN + D::In::<T>::CODES);
        let own = by_kind::<D::In<T>>(own);
        taken.extend_from_slice(&own[..D::In::<T>::LEN]);
        taken.extend_from_slice(out_bar);
        let input = get::<D::In<T>>(&own);
        let key = (input.codes(), D::decide::<T>(input));
        let known = self.known.read().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = known.get(&key) {
            return Ok(Arc::clone(found));
        }
        drop(known);
        let made = Arc::new(self.make(&key.0, key.1)?);
        let mut known = self.known.write().unwrap_or_else(PoisonError::into_inner);
        if known.len() >= MOST_KNOWN {
            known.clear();
        }
        Ok(Arc::clone(known.entry(key).or_insert(made)))
    }
    fn sizes(&self) -> [usize; 2] {
        let (numbers, result) = (D::In::<T>::LEN, D::Out::<T>::LEN);
        match self.mode {
            Mode::Value => [numbers, result],
            Mode::ValueGrad => [numbers, result + numbers],
            Mode::Jacobian => [numbers, result + result * numbers],
            Mode::Vjp => [numbers + result, numbers],
        }
    }
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]) {
        let result = match self.mode {
            Mode::Value => return row.copy_from_slice(found),
            Mode::ValueGrad | Mode::Jacobian => D::Out::<T>::LEN,
            Mode::Vjp => 0,
        };
        row[..result].copy_from_slice(&found[..result]);
        // A gradient has the input's codes.
        let codes = get::<D::In<T>>(&by_kind::<D::In<T>>(
            &numbers[..D::In::<T>::LEN + D::In::<T>::CODES],
        ))
        .codes();
        let width = width::<D::In<T>>();
        let gradients = row[result..].chunks_exact_mut(width);
        for (own, gradient) in found[result..].chunks(D::In::<T>::LEN).zip(gradients) {
            by_shape::<D::In<T>>(own, &codes, gradient);
        }
    }
}
