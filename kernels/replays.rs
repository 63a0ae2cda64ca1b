//! Replays of operations with a search, for machines that cannot search.
//!
//! The processor makes the decisions. Given these, and the codes of the input, the result is a straight line. It
//! is recorded once for every record that occurs, and becomes a list of instructions, with which a GPU replays
//! all items of that record.
use crate::Error;
use crate::ad::program::Sym;
use crate::ad::program::graph::{Id, Node};
use crate::ad::program::record::record_with_codes;
use crate::kernels::cpu::program::Tape;
use crate::kernels::cpu::program::instructions::Op;
use crate::kernels::item::{Item, by_kind, by_shape, get, width};
use crate::kernels::real::Real;
use crate::kernels::recording::{Mode, derived};
use crate::kernels::search::Search;
use crate::{Fixed, Pack};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// Records that are kept; beyond that many all are recorded anew.
const MOST_KNOWN: usize = 1 << 14;

/// A replay as instructions of four words each: operation and slot of the result; two operands; two more. If
/// there are several results, the others stand in the place of operands.
#[derive(Debug)]
pub struct Replay {
    /// In order.
    pub(crate) code: Vec<[u32; 4]>,
    /// How many slots it needs.
    pub(crate) slots: usize,
}

/// Puts a constant into a slot: its bits are the second word.
pub(crate) const CONSTANT: u32 = 0x100;
/// Puts a number of the input into a slot: its place is the second word.
pub(crate) const TAKE: u32 = 0x101;
/// Gives the slot in the second word as the result in the third.
pub(crate) const GIVE: u32 = 0x102;

/// An operation with a search, as a GPU sees it.
pub trait Replays<T>: Send + Sync {
    /// Decides an item, given its numbers shape by shape and those of its cotangent: the replay, and the
    /// numbers that it takes, which are appended.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    fn decide(&self, numbers: &[T], taken: &mut Vec<T>) -> Result<Arc<Replay>, Error>;
    /// How many numbers a replay takes, and how many it gives.
    fn sizes(&self) -> [usize; 2];
    /// Makes a row of results of what a replay gave for an item.
    fn put(&self, numbers: &[T], found: &[T], row: &mut [T]);
}

/// The replays of an operation that are known.
type Replayed<D> = RwLock<HashMap<(Vec<u32>, <D as Search>::Record), Arc<Replay>>>;

struct Of<D: Search, T> {
    mode: Mode,
    known: Replayed<D>,
    format: std::marker::PhantomData<fn() -> T>,
}

/// The replays of a mode of a search.
pub fn of<D, R: Item>(mode: Mode) -> Arc<dyn Replays<R::Scalar>>
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

/// A graph as instructions.
fn instructions(
    graph: &crate::ad::program::graph::Graph,
    inputs: usize,
    outputs: &[Id],
) -> Result<Replay, Error> {
    // Zeros lose their signs on their way out.
    let plain = |&x: &Id| match graph.at(x) {
        Node::Canonical(x) => x,
        _ => x,
    };
    let outputs: Vec<Id> = outputs.iter().map(plain).collect();
    let tape = Tape::new(graph, inputs, &outputs, false).map_err(Error::Program)?;
    let to = |op: u32, slot: u16| op | u32::from(slot) << 16;
    let two = |low: u16, high: u16| u32::from(low) | u32::from(high) << 16;
    let mut code = Vec::new();
    for &(slot, number) in &tape.constants {
        code.push([to(CONSTANT, slot), (number as f32).to_bits(), 0, 0]);
    }
    for (k, slot) in tape.inputs.iter().enumerate() {
        if let Some(slot) = *slot {
            code.push([to(TAKE, slot), k as u32, 0, 0]);
        }
    }
    for own in &tape.code {
        let ([x, y, z, w], [first, rest @ ..]) = (own.from, own.to);
        code.push(match own.op {
            Op::Parts | Op::SinCos => {
                let head = to(own.op as u32, first);
                [head, two(x, rest[0]), two(rest[1], rest[2]), 0]
            }
            // Most instructions have no second result.
            op => [
                to(op as u32, first),
                two(x, y),
                two(z, w),
                u32::from(rest[0]),
            ],
        });
    }
    for (k, &slot) in tape.outputs.iter().enumerate() {
        code.push([GIVE, u32::from(slot), k as u32, 0]);
    }
    Ok(Replay {
        code,
        slots: tape.slots.max(1),
    })
}

/// The number of every instruction of the interpreter, by name.
pub(crate) fn numbers() -> Vec<(&'static str, u32)> {
    macro_rules! listed {
        ($($name:ident($($x:ident),*) = $value:expr;)*) => {
            vec![$((stringify!($name), Op::$name as u32),)*]
        };
    }
    let mut all = crate::kernels::cpu::program::instructions::instructions! { listed!() };
    all.extend([
        ("Parts", Op::Parts as u32),
        ("SinCos", Op::SinCos as u32),
        ("Turn", Op::Turn as u32),
        ("SumSub", Op::SumSub as u32),
        ("Constant", CONSTANT),
        ("Take", TAKE),
        ("Give", GIVE),
    ]);
    all
}
