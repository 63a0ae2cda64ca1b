//! Recordings in progress: what symbols stand for.
//!
//! A thread has a stack of them, as a function that is recorded may itself record another. Nothing
//! here panics: what cannot be recorded spoils the recording, which then ends in an error.
use super::graph::{Format, Graph, Id, Node};
use crate::Unrecordable;
use std::cell::RefCell;
use std::sync::atomic::{AtomicU64, Ordering};

/// More operations than any function of fixed size has; a loop that depends on a hint ends here.
const MOST_OPERATIONS: usize = 1 << 22;

/// The name of a recording that no recording has: of symbols made outside any.
pub(super) const NOWHERE: u64 = 0;

/// The number of recordings that were opened. Names are unique in the process, as symbols may change threads.
static OPENED: AtomicU64 = AtomicU64::new(0);

thread_local! {
    static OPEN: RefCell<Vec<Recording>> = const { RefCell::new(Vec::new()) };
}

/// A function being recorded.
#[derive(Debug)]
pub(super) struct Recording {
    /// The number of the recording.
    name: u64,
    pub(super) graph: Graph,
    /// The number of operations requested.
    asked: usize,
    /// The number of hints requested that were not known.
    pub(super) hints: usize,
    /// Why it cannot be recorded.
    flaw: Option<Unrecordable>,
}

impl Recording {
    /// Opens a recording on this thread, runs `body` and gives back the recording. `plain`: all inputs
    /// are constants.
    pub(super) fn run(
        format: Format,
        plain: bool,
        body: &mut dyn FnMut(),
    ) -> Result<Recording, Unrecordable> {
        Self::open(format, plain);
        // Taken off the stack also when `body` panics.
        struct Closing;
        impl Drop for Closing {
            fn drop(&mut self) {
                OPEN.with_borrow_mut(Vec::pop);
            }
        }
        let closing = Closing;
        body();
        std::mem::forget(closing);
        // Every recording takes off itself only.
        let recording = OPEN
            .with_borrow_mut(Vec::pop)
            .ok_or(Unrecordable::ForeignSymbol)?;
        recording.sound().map(|()| recording)
    }

    /// Opens a recording on this thread and gives its name.
    pub(super) fn open(format: Format, plain: bool) -> u64 {
        let mut graph = Graph::new(format);
        graph.plain = plain;
        // The indices that symbols of a spoiled recording point to.
        graph.lit(0.0);
        let name = 1 + OPENED.fetch_add(1, Ordering::Relaxed) % Symbol::MOST_NAMES;
        let recording = Recording {
            name,
            graph,
            asked: 0,
            hints: 0,
            flaw: None,
        };
        OPEN.with_borrow_mut(|open| open.push(recording));
        name
    }

    /// Takes the recording of this name off this thread, if it is there.
    pub(super) fn close(name: u64) -> Option<Recording> {
        OPEN.with_borrow_mut(|open| {
            let at = open.iter().position(|recording| recording.name == name)?;
            Some(open.remove(at))
        })
    }

    /// Returns `true` while a recording is open on this thread.
    pub(super) fn is_open() -> bool {
        OPEN.with_borrow(|open| !open.is_empty())
    }

    /// Returns an error unless the recording that is open on this thread is of this format, and sound.
    pub(super) fn takes(format: Format) -> Result<(), Unrecordable> {
        OPEN.with_borrow(|open| match open.last() {
            Some(recording) if recording.graph.format == format => recording.sound(),
            _ => Err(Unrecordable::ForeignSymbol),
        })
    }

    /// Returns an error unless the recording that is open on this thread made the symbol, and is sound.
    pub(super) fn owns(symbol: Symbol) -> Result<(), Unrecordable> {
        OPEN.with_borrow(|open| match open.last() {
            Some(recording) if recording.name == symbol.recording() => recording.sound(),
            _ => Err(Unrecordable::ForeignSymbol),
        })
    }

    /// Returns an error if the recording was spoiled.
    pub(super) fn sound(&self) -> Result<(), Unrecordable> {
        self.flaw.map_or(Ok(()), Err)
    }

    /// Returns the node of a symbol of this recording; a symbol of another recording spoils this one.
    pub(super) fn place(&mut self, symbol: Symbol) -> Id {
        if symbol.recording() != self.name {
            self.spoil(Unrecordable::ForeignSymbol);
        }
        if self.flaw.is_some() {
            0
        } else {
            symbol.index()
        }
    }

    fn spoil(&mut self, flaw: Unrecordable) {
        self.flaw.get_or_insert(flaw);
    }

    /// Returns the symbol of an index.
    fn symbol(&mut self, place: Id) -> Symbol {
        if place >> Symbol::INDEX_BITS != 0 {
            self.spoil(Unrecordable::TooLong);
            return self.symbol(0);
        }
        Symbol(self.name << Symbol::INDEX_BITS | u64::from(place))
    }
}

/// An index of a node in a recording: the recording's name above the bits of the index.
///
/// One word, since recorded functions are long and do nothing but pass symbols on: with two they are half as long again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Symbol(u64);

impl Symbol {
    /// The result of operations outside any recording.
    const INERT: Symbol = Symbol(NOWHERE);
    /// The bits of an index: room for the nodes of four times [`MOST_OPERATIONS`].
    const INDEX_BITS: u32 = 24;
    /// The number of names of recordings, without [`NOWHERE`].
    const MOST_NAMES: u64 = (1 << (u64::BITS - Self::INDEX_BITS)) - 1;

    /// Returns the name of its recording.
    const fn recording(self) -> u64 {
        self.0 >> Self::INDEX_BITS
    }
    /// Returns the index of its node.
    const fn index(self) -> Id {
        // The lower bits alone fit.
        (self.0 & ((1 << Self::INDEX_BITS) - 1)) as Id
    }

    /// Returns the symbol of a number, rounded to the format of the recording that is open.
    // Not inlined, nor the others: a recorded function is long, and is called once. Without the type of the number, so
    // that the machine code of a function is the same for both formats, and compilers keep one.
    #[inline(never)]
    pub(super) fn constant(x: f64) -> Symbol {
        Self::of_format(|_| x)
    }
    /// Returns the symbol of a power of a multiple of the format's epsilon.
    #[inline(never)]
    pub(super) fn rounding(factor: f64, power: i32) -> Symbol {
        Self::of_format(|format| (factor * format.epsilon()).powi(power))
    }
    /// Returns the symbol of the largest finite number.
    #[inline(never)]
    pub(super) fn largest() -> Symbol {
        Self::of_format(Format::largest)
    }
    /// Returns the symbol of the finite number that is farthest below zero.
    #[inline(never)]
    pub(super) fn lowest() -> Symbol {
        Self::of_format(|format| -format.largest())
    }
    /// Returns the symbol of the largest finite number to a power.
    #[inline(never)]
    pub(super) fn largest_to(power: f64) -> Symbol {
        Self::of_format(|format| format.largest_to(power))
    }
    /// Returns the format of the recording that is open, double precision if there is none.
    #[inline(never)]
    pub(super) fn format() -> Format {
        OPEN.with_borrow(|open| open.last().map_or(Format::F64, |last| last.graph.format))
    }
    /// Returns the symbol of a number that the format has.
    fn of_format(number: impl FnOnce(Format) -> f64) -> Symbol {
        Self::made([], |[], format| {
            Node::Const(format.round(number(format)).to_bits())
        })
    }
    /// Returns the value without its derivatives.
    #[inline(never)]
    pub(super) fn primal(self) -> Symbol {
        Self::made([self], |[value], _| Node::Graft {
            value,
            derivative: None,
            share: None,
        })
    }
    /// Returns this derivative with another value.
    #[inline(never)]
    pub(super) fn with_primal(self, value: Symbol) -> Symbol {
        Self::made([self, value], |[derivative, value], _| Node::Graft {
            value,
            derivative: Some(derivative),
            share: None,
        })
    }
    /// Returns this value with a share of a derivative.
    #[inline(never)]
    pub(super) fn with_share(self, derivative: Symbol, share: Symbol) -> Symbol {
        let operands = [self, derivative, share];
        Self::made(operands, |[value, derivative, share], _| Node::Graft {
            value,
            derivative: Some(derivative),
            share: Some(share),
        })
    }
    /// Returns the symbol of a node without operands.
    #[inline(never)]
    pub(super) fn leaf(node: Node) -> Symbol {
        Self::made([], |[], _| node)
    }
    /// Returns the symbol of an operation on one symbol.
    #[inline(never)]
    pub(super) fn of_one(self, node: impl FnOnce(Id) -> Node) -> Symbol {
        Self::made([self], |[x], _| node(x))
    }
    /// Returns the symbol of an operation on two symbols.
    #[inline(never)]
    pub(super) fn of_two(self, other: Symbol, node: impl FnOnce(Id, Id) -> Node) -> Symbol {
        Self::made([self, other], |[a, b], _| node(a, b))
    }
    /// Returns the symbol of an operation on three symbols.
    #[inline(never)]
    pub(super) fn of_three(
        self,
        second: Symbol,
        third: Symbol,
        node: impl FnOnce(Id, Id, Id) -> Node,
    ) -> Symbol {
        Self::made([self, second, third], |[a, b, c], _| node(a, b, c))
    }

    /// Returns the symbol of an operation on symbols, in the recording that is open; `node` receives their indices and the
    /// recording's format.
    fn made<const N: usize>(
        operands: [Symbol; N],
        node: impl FnOnce([Id; N], Format) -> Node,
    ) -> Symbol {
        OPEN.with_borrow_mut(|open| {
            let Some(recording) = open.last_mut() else {
                return Symbol::INERT;
            };
            recording.asked += 1;
            if recording.asked > MOST_OPERATIONS {
                recording.spoil(Unrecordable::TooLong);
            }
            let places = operands.map(|symbol| recording.place(symbol));
            let place = match recording.flaw {
                None => {
                    let format = recording.graph.format;
                    recording.graph.make(node(places, format))
                }
                Some(_) => 0,
            };
            recording.symbol(place)
        })
    }

    /// Returns the result of a hint: the truth if it is known, else `unknown`. In a spoiled recording it is the
    /// negation, so that loops end.
    pub(super) fn hint(self, unknown: bool) -> bool {
        OPEN.with_borrow_mut(|open| {
            let Some(recording) = open.last_mut() else {
                return !unknown;
            };
            recording.asked += 1;
            if recording.asked > MOST_OPERATIONS {
                recording.spoil(Unrecordable::TooLong);
            }
            let place = recording.place(self);
            if recording.flaw.is_some() {
                return !unknown;
            }
            recording.graph.truth(place).unwrap_or_else(|| {
                recording.hints += 1;
                unknown
            })
        })
    }

    /// Returns `true` if it is not NaN for any input.
    pub(super) fn is_number(self) -> bool {
        OPEN.with_borrow(|open| match open.last() {
            Some(recording) if recording.name == self.recording() && recording.flaw.is_none() => {
                recording.graph.is_number(self.index())
            }
            _ => true,
        })
    }
}
