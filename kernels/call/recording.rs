//! Recordings: functions as machines run them, without the types of shapes.
//!
//! A [`Recording`] has the layouts of a function's arguments and results, its body, and the plans that machines made of
//! it. A [`Call`] is a recording with the derivative to compute. Every function of a batch (a verb, an operation, a
//! search, a plain function, a program, a derivative of one) becomes a call.
use crate::ad::program::recorded::Recorded;
use crate::error::{Argument, Error};
use crate::kernels::call::replayed::{self, SearchCode};
use crate::kernels::call::searched::Decide;
use crate::kernels::row::compiled::Compiled;
use crate::kernels::row::derivation::DerivativeStep;
pub use crate::kernels::row::derivation::Mode;
use crate::kernels::row::derivation::Replays;
use crate::kernels::row::item::Leaf;
use crate::kernels::row::limits::LowerBound;
use crate::kernels::row::once::{Key, RecordingCache, known_by};
use crate::kernels::row::straight_line::{Line, by_reverse};
use crate::{Real, Unrecordable};
use std::any::TypeId;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// An untyped search, or a derivative of one.
pub(crate) struct UntypedSearch<T: 'static> {
    /// Decides one item.
    pub(crate) decide: Decide<T>,
    /// The code of its replays.
    pub(crate) code: &'static SearchCode<T>,
    /// The steps from the search to the function.
    pub(crate) steps: Vec<DerivativeStep>,
}

impl<T: Real> UntypedSearch<T> {
    /// Returns this search differentiated once more.
    pub(crate) fn then(&self, step: DerivativeStep) -> Self {
        let steps = [&self.steps[..], &[step]].concat();
        let (decide, code) = (self.decide, self.code);
        UntypedSearch {
            decide,
            code,
            steps,
        }
    }
    /// Returns the replays of a mode of the function.
    pub(crate) fn replays(&self, mode: Mode) -> Arc<dyn Replays<T>> {
        replayed::of(self.code, self.then(DerivativeStep::Mode(mode)).steps)
    }
    /// Returns the number of scalars of every shape in the result of a mode. A Jacobian has a gradient per scalar of
    /// the result; `outputs` counts codes, too.
    pub(crate) fn gives(&self, mode: Mode, takes: &[usize], outputs: &[usize]) -> Vec<usize> {
        match mode {
            Mode::Jacobian => {
                let [_, rows] = self.replays(Mode::Value).sizes();
                [outputs, &[rows * takes.iter().sum::<usize>()]].concat()
            }
            _ => mode.gives(takes, outputs),
        }
    }
}

/// The body of a function.
pub(crate) enum Body<T: 'static> {
    /// A straight line, recorded when it is first needed.
    Line(&'static Line),
    /// A recorded graph.
    Graph(Arc<Recorded>),
    /// A search: decisions, then a straight line for every record.
    Search(UntypedSearch<T>),
}

/// An untyped function: its layouts, its body, and the plans that machines made of it.
pub struct Recording<T: Real> {
    /// The layouts of its arguments.
    pub(crate) takes: Vec<Leaf<T>>,
    /// The number of scalars of every shape of its result.
    pub(crate) outputs: Vec<usize>,
    /// The names of its arguments, one for each, or none.
    pub(crate) arguments: &'static [&'static str],
    /// The kernels that the library has compiled for it.
    pub(crate) compiled: Option<Compiled>,
    /// The lower bound of its result, from boxes around its arguments.
    pub(crate) lower: LowerBound,
    pub(crate) body: Body<T>,
    /// The number of this recording, unique in the process.
    pub(crate) number: u64,
    made: RecordingCache,
}

/// The parts of a recording of a straight line.
pub(crate) struct LineParts<T: Real> {
    pub(crate) compiled: fn() -> Option<Compiled>,
    pub(crate) takes: fn() -> Vec<Leaf<T>>,
    pub(crate) outputs: fn() -> Vec<usize>,
    pub(crate) arguments: &'static [&'static str],
    pub(crate) lower: LowerBound,
    pub(crate) line: &'static Line,
}

impl<T: Real> fmt::Debug for Recording<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Recording")
            .field("takes", &self.takes)
            .field("outputs", &self.outputs)
            .field("arguments", &self.arguments)
            .finish_non_exhaustive()
    }
}

impl<T: Real> Recording<T> {
    /// Creates a recording from its parts, without plans.
    pub(crate) fn new(
        takes: Vec<Leaf<T>>,
        outputs: Vec<usize>,
        arguments: &'static [&'static str],
        body: Body<T>,
    ) -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(1);
        Recording {
            number: NEXT.fetch_add(1, Ordering::Relaxed),
            takes,
            outputs,
            arguments,
            compiled: None,
            lower: LowerBound::Unknown,
            body,
            made: RecordingCache::default(),
        }
    }

    /// Returns the recording of an operation, which is made once.
    pub(crate) fn of_line(operation: TypeId, parts: &LineParts<T>) -> Arc<Self> {
        let made = known_by(operation, &|| {
            let compiled = (parts.compiled)();
            let mut takes = (parts.takes)();
            if compiled == Some(Compiled::Quads) {
                takes = takes.into_iter().map(Leaf::convex).collect();
            }
            Ok(Recording {
                compiled,
                lower: parts.lower,
                ..Recording::new(
                    takes,
                    (parts.outputs)(),
                    parts.arguments,
                    Body::Line(parts.line),
                )
            })
        });
        made.unwrap_or_else(|_: Error| unreachable!("nothing is recorded yet"))
    }

    /// Returns the value of a key, made once per recording.
    pub(crate) fn made<X: Send + Sync + 'static>(
        &self,
        key: Key,
        make: &dyn Fn() -> Result<X, Error>,
    ) -> Result<Arc<X>, Error> {
        self.made.made(key, make)
    }

    /// Returns the program of a mode: the result, or the result and derivatives, from the input and then the cotangent.
    pub(crate) fn program(&self, mode: Mode) -> Result<Arc<Recorded>, Error> {
        match &self.body {
            Body::Line(line) => line.program::<T>(mode),
            Body::Graph(recorded) if mode == Mode::Value => Ok(Arc::clone(recorded)),
            Body::Graph(recorded) => {
                self.made(Key::Program(mode), &|| Ok(by_reverse(recorded, mode)))
            }
            Body::Search(_) => Err(Error::Program(Unrecordable::Search)),
        }
    }

    /// Returns a derivative as a function of its own, whose derivatives are of the next order.
    fn derivative(&self, mode: Mode) -> Result<Arc<Recording<T>>, Error> {
        self.made(Key::Derived(mode), &|| {
            let fields: Vec<usize> = self.takes.iter().map(|leaf| leaf.fields).collect();
            let (body, gives) = match &self.body {
                Body::Search(search) => (
                    Body::Search(search.then(DerivativeStep::Mode(mode))),
                    search.gives(mode, &fields, &self.outputs),
                ),
                _ => {
                    let program = self.program(mode)?;
                    let own = program.without_first(mode.skipped(&self.outputs));
                    (
                        Body::Graph(Arc::new(own)),
                        mode.gives(&fields, &self.outputs),
                    )
                }
            };
            let mut takes = self.takes.clone();
            if mode == Mode::Vjp {
                takes.extend(self.outputs.iter().map(|&n| Leaf::numbers(n)));
            }
            Ok(Recording::new(takes, gives, &[], body))
        })
    }
}

/// A function and the derivative to compute: with columns this is the complete input of a machine.
#[derive(Debug)]
pub struct Call<T: Real> {
    pub(crate) recording: Arc<Recording<T>>,
    pub(crate) mode: Mode,
    /// The lower bound of its result, from boxes around its arguments.
    pub(crate) lower: LowerBound,
}

impl<T: Real> Clone for Call<T> {
    fn clone(&self) -> Self {
        Call {
            recording: Arc::clone(&self.recording),
            ..*self
        }
    }
}

impl<T: Real> Call<T> {
    /// Creates a call of a function's value.
    pub(crate) fn of(recording: Arc<Recording<T>>) -> Self {
        Call {
            lower: recording.lower,
            recording,
            mode: Mode::Value,
        }
    }
    /// Returns the call of the next derivative: of a value another mode of the function, of a derivative one of the
    /// next order.
    ///
    /// # Errors
    ///
    /// The errors of recording the inner derivative.
    pub(crate) fn derived(self, mode: Mode) -> Result<Self, Error> {
        let lower = match mode {
            Mode::Value => self.lower,
            _ => LowerBound::Unknown,
        };
        let recording = self.function()?;
        Ok(Call {
            recording,
            mode,
            lower,
        })
    }
    /// Returns the called function as a recording of its own, also if it is a derivative.
    pub(crate) fn function(self) -> Result<Arc<Recording<T>>, Error> {
        match self.mode {
            Mode::Value => Ok(self.recording),
            inner => self.recording.derivative(inner),
        }
    }
    /// Returns the call of minus the function, whose result is one number.
    ///
    /// # Errors
    ///
    /// The errors of recording the function.
    pub(crate) fn negated(&self) -> Result<Self, Error> {
        let own = self.clone().function()?;
        let made = own.made(Key::Negated, &|| {
            let body = Body::Graph(Arc::new(own.program(Mode::Value)?.negated()));
            let (takes, outputs) = (own.takes.clone(), own.outputs.clone());
            Ok(Recording::new(takes, outputs, own.arguments, body))
        })?;
        Ok(Call::of(made))
    }
    /// Returns the name of column `k`: arguments come first, then cotangents.
    pub(crate) fn argument(&self, k: usize) -> Argument {
        let (takes, names) = (self.recording.takes.len(), self.recording.arguments);
        match names.get(k) {
            _ if k >= takes => Argument::Upstream,
            Some(name) if names.len() == takes => Argument::named(name),
            _ => Argument::input(k),
        }
    }
}
