//! Replays of a search in a format, recorded once for every record that occurs.
use crate::Error;
use crate::ad::program::Sym;
use crate::ad::program::record::record_with_codes;
use crate::ad::program::recorded::Recorded;
use crate::kernels::decision::Search;
use crate::kernels::derivation::{Mode, Order, Replays, Step};
use crate::kernels::item::{Item, by_kind, by_shape, get, width};
use crate::kernels::recording::by_reverse;
#[cfg(feature = "gpu")]
use crate::kernels::replays::{Replay, instructions};
use crate::{Fixed, Pack, Real};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Records that are kept; beyond that many all are recorded anew.
const MOST_KNOWN: usize = 1 << 14;

/// What is known by codes and record.
type Known<D, X> = RwLock<HashMap<(Vec<u32>, <D as Search>::Record), Arc<X>>>;

/// Numbers that lie together in an item or a result.
#[derive(Clone, Copy, Debug)]
enum Block {
    /// Those of the search's input, or of a gradient or direction, which has the input's codes.
    Input,
    /// So many numbers.
    Plain(usize),
}

struct Of<D: Search, T> {
    steps: Vec<Step>,
    /// What the function takes, and what it gives.
    takes: Vec<Block>,
    gives: Vec<Block>,
    known: Known<D, Recorded>,
    #[cfg(feature = "gpu")]
    codes: Known<D, Replay>,
    format: std::marker::PhantomData<fn() -> T>,
}

/// The replays of a search, differentiated by some steps.
pub(crate) fn of<D, R: Item>(steps: Vec<Step>) -> Arc<dyn Replays<R::Scalar>>
where
    D: Search<In<<R as Pack>::Scalar> = R>,
{
    let (mut takes, mut gives) = (
        vec![Block::Input],
        vec![Block::Plain(D::Out::<R::Scalar>::LEN)],
    );
    for step in &steps {
        let (own, results) = (takes.clone(), gives.clone());
        match step {
            Step::Mode(Mode::Value) => {}
            Step::Mode(Mode::ValueGrad) => gives.extend(own),
            Step::Mode(Mode::Jacobian) => {
                for _ in 0..numbers_of::<R>(&results) {
                    gives.extend(own.iter().copied());
                }
            }
            Step::Mode(Mode::Vjp) => {
                takes.extend(results);
                gives = own;
            }
            Step::Along(Order::First) => {
                takes.extend(own);
                gives.extend(results);
            }
            Step::Along(Order::Second) => {
                takes.extend(own.iter().copied());
                gives = own;
            }
        }
    }
    Arc::new(Of::<D, R::Scalar> {
        steps,
        takes,
        gives,
        known: RwLock::default(),
        #[cfg(feature = "gpu")]
        codes: RwLock::default(),
        format: std::marker::PhantomData,
    })
}

/// The numbers of some blocks in a program, which has no codes.
fn numbers_of<R: Item>(blocks: &[Block]) -> usize {
    let one = |block: &Block| match *block {
        Block::Input => R::LEN,
        Block::Plain(count) => count,
    };
    blocks.iter().map(one).sum()
}

/// Something that is made once by its key.
fn made<D: Search, X>(
    all: &Known<D, X>,
    key: (Vec<u32>, D::Record),
    make: impl FnOnce(&[u32], D::Record) -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    let known = all.read().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = known.get(&key) {
        return Ok(Arc::clone(found));
    }
    drop(known);
    let made = Arc::new(make(&key.0, key.1)?);
    let mut known = all.write().unwrap_or_else(PoisonError::into_inner);
    if known.len() >= MOST_KNOWN {
        known.clear();
    }
    Ok(Arc::clone(known.entry(key).or_insert(made)))
}

impl<D: Search, T: Real> Of<D, T>
where
    D::In<T>: Item<Scalar = T>,
{
    /// Records a replay and differentiates it.
    fn record(&self, codes: &[u32], record: D::Record) -> Result<Recorded, Error> {
        type In<D, T> = <D as Search>::In<Sym<T>>;
        type Out<D, T> = <D as Search>::Out<Sym<T>>;
        let replay = |x: In<D, T>| D::replay::<Sym<T>>(x, record);
        let mut recorded = record_with_codes::<T, In<D, T>, Out<D, T>>(codes, replay)?;
        for step in &self.steps {
            recorded = match *step {
                Step::Mode(Mode::Vjp) => recorded.vjp(),
                Step::Mode(mode) => by_reverse(&recorded, mode),
                Step::Along(Order::First) => recorded.jvp(),
                Step::Along(Order::Second) => recorded.hvp(),
            };
        }
        Ok(recorded)
    }
    /// Codes and record of an item, whose numbers without codes are appended.
    fn key(&self, numbers: &[T], taken: &mut Vec<T>) -> (Vec<u32>, D::Record) {
        let mut rest = numbers;
        for block in &self.takes {
            match *block {
                Block::Input => {
                    let (own, others) = rest.split_at(width::<D::In<T>>());
                    taken.extend_from_slice(&by_kind::<D::In<T>>(own)[..D::In::<T>::LEN]);
                    rest = others;
                }
                Block::Plain(count) => {
                    let (own, others) = rest.split_at(count);
                    taken.extend_from_slice(own);
                    rest = others;
                }
            }
        }
        let input = input::<D, T>(numbers);
        (input.codes(), D::decide::<T>(input))
    }
}

/// The input of a search that an item begins with.
fn input<D: Search, T: Real>(numbers: &[T]) -> D::In<T>
where
    D::In<T>: Item<Scalar = T>,
{
    get::<D::In<T>>(&by_kind::<D::In<T>>(&numbers[..width::<D::In<T>>()]))
}

impl<D: Search, T: Real> Replays<T> for Of<D, T>
where
    D::In<T>: Item<Scalar = T>,
{
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Recorded>, Error> {
        let key = self.key(numbers, taken);
        made::<D, _>(&self.known, key, |codes, record| self.record(codes, record))
    }
    #[cfg(feature = "gpu")]
    fn instructions(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Replay>, Error> {
        let key = self.key(numbers, taken);
        made::<D, _>(&self.codes, key, |codes, record| {
            let recorded = self.record(codes, record)?;
            let value = &recorded.value;
            instructions(&value.graph, recorded.inputs, &value.outputs)
        })
    }
    fn sizes(&self) -> [usize; 2] {
        [&self.takes, &self.gives].map(|blocks| numbers_of::<D::In<T>>(blocks))
    }
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]) {
        let codes = input::<D, T>(numbers).codes();
        let (mut found, mut row) = (found, row);
        for block in &self.gives {
            let [from, to] = match *block {
                Block::Input => [D::In::<T>::LEN, width::<D::In<T>>()],
                Block::Plain(count) => [count, count],
            };
            let (own, others) = found.split_at(from);
            let (place, after) = row.split_at_mut(to);
            match block {
                // A gradient has the input's codes.
                Block::Input => by_shape::<D::In<T>>(own, &codes, place),
                Block::Plain(_) => place.copy_from_slice(own),
            }
            (found, row) = (others, after);
        }
    }
}
