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

/// The next recording's name. Names are unique in the process, as symbols may change threads.
static NEXT: AtomicU64 = AtomicU64::new(NOWHERE + 1);

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
        let name = NEXT.fetch_add(1, Ordering::Relaxed);
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
            Some(recording) if recording.name == symbol.recording => recording.sound(),
            _ => Err(Unrecordable::ForeignSymbol),
        })
    }

    /// Returns an error if the recording was spoiled.
    pub(super) fn sound(&self) -> Result<(), Unrecordable> {
        self.flaw.map_or(Ok(()), Err)
    }

    /// Returns the node of a symbol of this recording; a symbol of another recording spoils this one.
    pub(super) fn place(&mut self, symbol: Symbol) -> Id {
        if symbol.recording != self.name {
            self.spoil(Unrecordable::ForeignSymbol);
        }
        if self.flaw.is_some() { 0 } else { symbol.place }
    }

    fn spoil(&mut self, flaw: Unrecordable) {
        self.flaw.get_or_insert(flaw);
    }

    /// Returns the symbol of an index.
    fn symbol(&self, place: Id) -> Symbol {
        Symbol {
            recording: self.name,
            place,
        }
    }
}

/// An index of a node in a recording.
#[derive(Clone, Copy, Debug)]
pub(super) struct Symbol {
    recording: u64,
    place: Id,
}

impl Symbol {
    /// The result of operations outside any recording.
    const INERT: Symbol = Symbol {
        recording: NOWHERE,
        place: 0,
    };

    /// Returns the symbol of an operation on symbols, in the recording that is open; `node` receives their indices.
    pub(super) fn made<const N: usize>(
        format: Format,
        operands: [Symbol; N],
        node: impl FnOnce([Id; N]) -> Node,
    ) -> Symbol {
        OPEN.with_borrow_mut(|open| {
            let Some(recording) = open.last_mut() else {
                return Symbol::INERT;
            };
            if recording.graph.format != format {
                recording.spoil(Unrecordable::ForeignSymbol);
            }
            recording.asked += 1;
            if recording.asked > MOST_OPERATIONS {
                recording.spoil(Unrecordable::TooLong);
            }
            let places = operands.map(|symbol| recording.place(symbol));
            let place = match recording.flaw {
                None => recording.graph.make(node(places)),
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
            Some(recording) if recording.name == self.recording && recording.flaw.is_none() => {
                recording.graph.is_number(self.place)
            }
            _ => true,
        })
    }
}
