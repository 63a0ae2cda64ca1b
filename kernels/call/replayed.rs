//! The replays of a search as programs: one for every record that occurs, in either format.
use crate::Error;
use crate::ad::program::Neutral;
use crate::ad::program::record::record_with_codes;
use crate::ad::program::recorded::Recorded;
use crate::kernels::row::decision::HintedSearch;
use crate::kernels::row::derivation::{DerivativeStep, Mode, Order, Replays};
use crate::kernels::row::item::{Item, by_kind, by_shape, item_of, width};
#[cfg(feature = "check")]
use crate::kernels::row::once::known;
use crate::kernels::row::straight_line::by_reverse;
use crate::scalar::Format;
use crate::{Fixed, Pack, Real, Scalar};
use std::any::Any;
use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, PoisonError, RwLock};

/// The number of programs that a search keeps. One more drops all, which bounds the memory.
const MOST_KEPT: usize = 1 << 14;

/// A record of any search: programs of all searches are kept by one compiled table.
trait AnyRecord: Any + Send + Sync {
    fn equals(&self, other: &dyn Any) -> bool;
    fn hash_into(&self, state: &mut dyn Hasher);
}

impl<R: Copy + Eq + Hash + Send + Sync + 'static> AnyRecord for R {
    fn equals(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<R>() == Some(self)
    }
    fn hash_into(&self, mut state: &mut dyn Hasher) {
        self.hash(&mut state);
    }
}

/// An input's codes and its record.
struct ReplayKey(Vec<u32>, Box<dyn AnyRecord>);

impl PartialEq for ReplayKey {
    fn eq(&self, other: &Self) -> bool {
        let record: &dyn Any = &*other.1;
        self.0 == other.0 && self.1.equals(record)
    }
}
impl Eq for ReplayKey {}
impl Hash for ReplayKey {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.hash(state);
        self.1.hash_into(state);
    }
}

/// The programs of records.
type Cache = RwLock<HashMap<ReplayKey, Arc<Recorded>>>;

/// A run of numbers of an item or a result.
#[derive(Clone, Copy, Debug)]
enum NumberBlock {
    /// The numbers of the search's input, or of a gradient or direction, which has the input's codes.
    Input,
    /// A number of plain scalars.
    Plain(usize),
    /// The hints of the search, which no column has.
    Hints(usize),
    /// The direction of the hints, which is zero.
    Still(usize),
}

impl NumberBlock {
    /// Returns the number of scalars in a program, which has no codes, and in a column, given those of the input.
    const fn sizes(self, input: [usize; 2]) -> [usize; 2] {
        match self {
            NumberBlock::Input => input,
            NumberBlock::Plain(count) => [count, count],
            NumberBlock::Hints(count) | NumberBlock::Still(count) => [count, 0],
        }
    }
    /// Returns `true` for numbers of columns, by which there are derivatives.
    const fn varies(self) -> bool {
        matches!(self, NumberBlock::Input | NumberBlock::Plain(_))
    }
    /// Returns the block of directions of this one.
    const fn direction(self) -> Self {
        match self {
            NumberBlock::Hints(count) => NumberBlock::Still(count),
            other => other,
        }
    }
}

/// The code of a search that its replays call in a format, without the types of its shapes. All else is compiled once per
/// format.
pub(crate) struct SearchCode<T> {
    /// Decides an item. Returns the key of its replay, and the hints.
    decide: fn(&[T]) -> (ReplayKey, Vec<T>),
    record: RecordReplay,
    /// Returns the codes of an input from the numbers of its shapes.
    codes: fn(&[T]) -> Vec<u32>,
    by_kind: fn(&[T]) -> Vec<T>,
    by_shape: fn(&[T], &[u32], &mut [T]),
    /// The numbers of scalars of an input in a program and in a column.
    input: [usize; 2],
    hints: usize,
    result: usize,
}

impl<T: Real> SearchCode<T> {
    /// Returns that of a search.
    pub(crate) const fn of<D, R: Item<Scalar = T>>() -> Self
    where
        D: HintedSearch<In<T> = R>,
    {
        SearchCode {
            decide: decide::<D, R>,
            record: recorded_any::<D>,
            codes: codes::<R>,
            by_kind: |numbers| by_kind::<R>(numbers).into_owned(),
            by_shape: by_shape::<R>,
            input: input_sizes::<R>(),
            hints: D::Hints::<T>::LEN,
            result: D::Out::<T>::LEN,
        }
    }
}

/// The replays of a search, differentiated.
struct DerivedReplays<T: 'static> {
    code: &'static SearchCode<T>,
    blocks: DerivedBlocks,
    programs: Cache,
}

/// Returns the numbers of scalars of an input in a program and in a column.
const fn input_sizes<R: Item>() -> [usize; 2] {
    [R::LEN, width::<R>()]
}

/// The steps of a differentiated replay, and the blocks of its numbers.
struct DerivedBlocks {
    /// The derivatives one after another, each with the places of its results that are kept: those by hints are not.
    steps: Vec<(DerivativeStep, Vec<usize>)>,
    /// Blocks of an item.
    takes: Vec<NumberBlock>,
    /// Blocks of a result.
    gives: Vec<NumberBlock>,
}

impl DerivedBlocks {
    /// Returns those of a search with so many scalars of its input, its hints and its result.
    fn new(steps: Vec<DerivativeStep>, input: [usize; 2], hints: usize, result: usize) -> Self {
        let mut takes = vec![NumberBlock::Input];
        if hints > 0 {
            takes.push(NumberBlock::Hints(hints));
        }
        let mut gives = vec![NumberBlock::Plain(result)];
        let mut kept = Vec::new();
        for step in steps {
            let (own, results) = (takes.clone(), gives.clone());
            // All blocks of the differentiated program's result, which has derivatives by hints, too.
            let mut all = Vec::new();
            match step {
                DerivativeStep::Mode(Mode::Value) => all.extend(results),
                DerivativeStep::Mode(Mode::ValueGrad) => all.extend([results, own].concat()),
                DerivativeStep::Mode(Mode::Jacobian) => {
                    let count = numbers_of(&results, input);
                    all.extend(results);
                    (0..count).for_each(|_| all.extend(&own));
                }
                DerivativeStep::Mode(Mode::Vjp) => {
                    takes.extend(results);
                    all = own;
                }
                DerivativeStep::Along(Order::First) => {
                    takes.extend(own.into_iter().map(NumberBlock::direction));
                    all.extend([&results[..], &results].concat());
                }
                DerivativeStep::Along(Order::Second) => {
                    takes.extend(own.iter().map(|block| block.direction()));
                    all = own;
                }
            }
            let mut places = Vec::new();
            let mut first = 0;
            for block in &all {
                let count = block.sizes(input)[0];
                places.extend((first..first + count).filter(|_| block.varies()));
                first += count;
            }
            kept.push((step, places));
            gives = all.into_iter().filter(|block| block.varies()).collect();
        }
        DerivedBlocks {
            steps: kept,
            takes,
            gives,
        }
    }
}

/// Returns the replays of a search, differentiated by some steps.
pub(crate) fn of<T: Real>(
    code: &'static SearchCode<T>,
    steps: Vec<DerivativeStep>,
) -> Arc<dyn Replays<T>> {
    Arc::new(DerivedReplays {
        blocks: DerivedBlocks::new(steps, code.input, code.hints, code.result),
        code,
        programs: RwLock::default(),
    })
}

/// Returns the number of scalars of some blocks in a program, which has no codes, given the sizes of an input.
fn numbers_of(blocks: &[NumberBlock], input: [usize; 2]) -> usize {
    blocks.iter().map(|block| block.sizes(input)[0]).sum()
}

/// Records the replay of an input's codes and of a record, which must be one of the search.
type RecordReplay = fn(Format, &[u32], &dyn Any) -> Result<Recorded, Error>;

/// Returns the program of a key, made at first use. If two threads make it, the first is kept.
fn made(
    all: &Cache,
    key: ReplayKey,
    make: &dyn Fn(&ReplayKey) -> Result<Recorded, Error>,
) -> Result<Arc<Recorded>, Error> {
    let kept = all.read().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = kept.get(&key) {
        return Ok(Arc::clone(found));
    }
    drop(kept);
    let made = Arc::new(make(&key)?);
    let mut kept = all.write().unwrap_or_else(PoisonError::into_inner);
    if kept.len() >= MOST_KEPT {
        kept.clear();
    }
    Ok(Arc::clone(kept.entry(key).or_insert(made)))
}

/// Returns a replay as a program of the numbers of the input and the hints, which are constants of it.
fn recorded<D: HintedSearch>(
    format: Format,
    codes: &[u32],
    record: D::Record,
) -> Result<Recorded, Error> {
    type In<D> = <D as HintedSearch>::In<Neutral>;
    type Hints<D> = <D as HintedSearch>::Hints<Neutral>;
    type Out<D> = <D as HintedSearch>::Out<Neutral>;
    let replay = |(input, hints): (In<D>, Hints<D>)| {
        let mut constants = hints;
        constants.each(&mut |hint| *hint = hint.primal());
        D::replay_with_hints::<Neutral>(input, record, constants)
    };
    record_with_codes::<(In<D>, Hints<D>), Out<D>>(format, codes, replay)
}

/// Returns the replay of a record as [`recorded`].
fn recorded_any<D: HintedSearch>(
    format: Format,
    codes: &[u32],
    record: &dyn Any,
) -> Result<Recorded, Error> {
    match record.downcast_ref::<D::Record>() {
        Some(&record) => recorded::<D>(format, codes, record),
        None => unreachable!("a key has a record of its search"),
    }
}

/// The pull-backs that the harness keeps of a search, by format, codes and record. Neighbours of an input share most
/// records, inputs few.
#[cfg(feature = "check")]
type PullBacks<D> = HashMap<(Format, Vec<u32>, <D as HintedSearch>::Record), Arc<Recorded>>;

/// The number of pull-backs that the harness keeps of a search. One more drops all.
#[cfg(feature = "check")]
const MOST_PULLED: usize = 64;

/// Returns the pull-back of a replay as a program: from the numbers of the input, the hints and a cotangent of the
/// result to the cotangents of the input's numbers.
#[cfg(feature = "check")]
pub(crate) fn pull_back_of_replay<D: HintedSearch>(
    format: Format,
    codes: &[u32],
    record: D::Record,
) -> Result<Arc<Recorded>, Error> {
    let all = known::<D, RwLock<PullBacks<D>>>(|| Ok(RwLock::default()))?;
    let key = (format, codes.to_vec(), record);
    let kept = all.read().unwrap_or_else(PoisonError::into_inner);
    if let Some(found) = kept.get(&key) {
        return Ok(Arc::clone(found));
    }
    drop(kept);
    let of_input: Vec<usize> = (0..D::In::<Neutral>::LEN).collect();
    let made = Arc::new(
        recorded::<D>(format, codes, record)?
            .vjp()
            .chosen(&of_input),
    );
    let mut kept = all.write().unwrap_or_else(PoisonError::into_inner);
    if kept.len() >= MOST_PULLED {
        kept.clear();
    }
    kept.insert(key, Arc::clone(&made));
    Ok(made)
}

impl DerivedBlocks {
    /// Returns a replay differentiated by all steps.
    fn derived(&self, mut recorded: Recorded, has_hints: bool) -> Recorded {
        for (step, kept) in &self.steps {
            recorded = match *step {
                // Without the value, which [`by_reverse`] puts first: a replay computes the derivative alone.
                DerivativeStep::Mode(Mode::Vjp) => recorded.vjp(),
                DerivativeStep::Mode(mode) => by_reverse(&recorded, mode),
                DerivativeStep::Along(Order::First) => recorded.jvp(),
                DerivativeStep::Along(Order::Second) => recorded.hvp(),
            };
            if has_hints {
                recorded = recorded.chosen(kept);
            }
        }
        recorded
    }
    /// Appends an item's numbers without codes, and the hints. `scalars` puts the scalars of an input before its codes.
    fn take<T: Real>(
        &self,
        numbers: &[T],
        hints: &[T],
        sizes: [usize; 2],
        scalars: fn(&[T]) -> Vec<T>,
        taken: &mut Vec<T>,
    ) {
        let mut rest = numbers;
        for block in &self.takes {
            let (own, others) = rest.split_at(block.sizes(sizes)[1]);
            match block {
                NumberBlock::Input => taken.extend_from_slice(&scalars(own)[..sizes[0]]),
                NumberBlock::Plain(_) => taken.extend_from_slice(own),
                NumberBlock::Hints(_) => taken.extend_from_slice(hints),
                NumberBlock::Still(count) => taken.extend((0..*count).map(|_| T::zero())),
            }
            rest = others;
        }
    }
    /// Writes a row of results from those of a replay. `shaped` writes the scalars of a gradient with the input's codes.
    fn put<T: Real>(
        &self,
        (found, row): (&[T], &mut [T]),
        codes: &[u32],
        sizes: [usize; 2],
        shaped: fn(&[T], &[u32], &mut [T]),
    ) {
        let (mut found, mut row) = (found, row);
        for block in &self.gives {
            let [from, to] = block.sizes(sizes);
            let (own, others) = found.split_at(from);
            let (place, after) = row.split_at_mut(to);
            match block {
                // A gradient has the input's codes.
                NumberBlock::Input => shaped(own, codes, place),
                NumberBlock::Plain(_) => place.copy_from_slice(own),
                NumberBlock::Hints(_) | NumberBlock::Still(_) => {}
            }
            (found, row) = (others, after);
        }
    }
}

/// Returns the input of a search, with which an item's numbers begin.
fn input<R: Item>(numbers: &[R::Scalar]) -> R {
    item_of(numbers)
}

fn codes<R: Item>(numbers: &[R::Scalar]) -> Vec<u32> {
    if const { R::CODES == 0 } {
        return Vec::new();
    }
    input::<R>(numbers).codes()
}

fn decide<D, R: Item>(numbers: &[R::Scalar]) -> (ReplayKey, Vec<R::Scalar>)
where
    D: HintedSearch<In<<R as Pack>::Scalar> = R>,
{
    let input = input::<R>(numbers);
    let (record, hints) = D::decide_with_hints::<R::Scalar>(input);
    (ReplayKey(input.codes(), Box::new(record)), hints.scalars())
}

impl<T: Real> Replays<T> for DerivedReplays<T> {
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Recorded>, Error> {
        let code = self.code;
        let (key, hints) = (code.decide)(numbers);
        self.blocks
            .take(numbers, &hints, code.input, code.by_kind, taken);
        made(&self.programs, key, &|key| {
            let recorded = (code.record)(T::FORMAT, &key.0, &*key.1)?;
            Ok(self.blocks.derived(recorded, code.hints > 0))
        })
    }
    fn hints(&self) -> usize {
        self.code.hints
    }
    fn sizes(&self) -> [usize; 2] {
        [&self.blocks.takes, &self.blocks.gives].map(|blocks| numbers_of(blocks, self.code.input))
    }
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]) {
        let code = self.code;
        let codes = (code.codes)(numbers);
        self.blocks
            .put((found, row), &codes, code.input, code.by_shape);
    }
}
