//! Recordings: functions as machines run them, without the types of shapes.
//!
//! A [`Recording`] has the layouts of what a function takes and gives, its body, and all that machines have made of it. A
//! [`Call`] is a recording with the derivative that is wanted. Whatever a batch runs (a verb, an operation, a search, a plain
//! function, a program, a derivative of one) yields a call and nothing else.
use crate::ad::program::Sym;
use crate::ad::program::record::{TRIALS, listed};
use crate::ad::program::recorded::Recorded;
use crate::error::{Argument, Error};
use crate::kernels::cpu::plan::{Compiled, Plan};
use crate::kernels::cpu::quads::convex;
pub use crate::kernels::derivation::Mode;
use crate::kernels::derivation::Replays;
pub(crate) use crate::kernels::derivation::{Order, Step};
use crate::kernels::formats::drivers_in;
use crate::kernels::item::Leaf;
use crate::kernels::limits::Derivative;
use crate::{Real, Scalar, Unrecordable};
use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::fmt;
use std::hash::Hash;
use std::marker::PhantomData;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

/// A straight line without its types: functions of lists of symbols, so that code that records and differentiates is
/// compiled once.
pub(crate) struct Line<T: 'static> {
    /// The type of its operation.
    pub(crate) id: fn() -> TypeId,
    /// The source of its derivatives.
    pub(crate) derivatives: Derivative,
    /// Numbers of its input.
    pub(crate) inputs: usize,
    /// Numbers of its result.
    pub(crate) outputs: usize,
    /// Codes of both.
    pub(crate) codes: usize,
    /// The function.
    pub(crate) eval: fn(&[Sym<T>]) -> Vec<Sym<T>>,
    /// The result and then the derivatives, by hand, from the input and the cotangent.
    pub(crate) adjoint: fn(&[Sym<T>], &[Sym<T>]) -> Vec<Sym<T>>,
}

/// A search, or a derivative of one, as machines take it.
pub(crate) struct Searched<T> {
    /// The plan by which the CPU decides and computes the search itself, item by item.
    pub(crate) plan: fn(Mode) -> Plan<T>,
    /// Its replays, differentiated by some steps.
    pub(crate) replays: fn(Vec<Step>) -> Arc<dyn Replays<T>>,
    /// The steps from the search to the function.
    pub(crate) steps: Vec<Step>,
}

impl<T> Searched<T> {
    /// The same with one more derivative.
    pub(crate) fn then(&self, step: Step) -> Self {
        let steps = [&self.steps[..], &[step]].concat();
        let (plan, replays) = (self.plan, self.replays);
        Searched {
            plan,
            replays,
            steps,
        }
    }
    /// The replays of a mode of the function.
    pub(crate) fn replays(&self, mode: Mode) -> Arc<dyn Replays<T>> {
        (self.replays)(self.then(Step::Mode(mode)).steps)
    }
    /// Numbers of every shape that a mode gives. A Jacobian has a gradient per scalar of the result; `outputs` counts
    /// codes, too.
    pub(crate) fn gives(&self, mode: Mode, takes: &[usize], outputs: &[usize]) -> Vec<usize> {
        match mode {
            Mode::Jacobian => {
                let [numbers, all] = self.replays(mode).sizes();
                // `all` is `rows` results and `numbers` derivatives of each.
                let rows = all / (1 + numbers);
                [outputs, &[rows * takes.iter().sum::<usize>()]].concat()
            }
            _ => mode.gives(takes, outputs),
        }
    }
}

/// The body of a function.
pub(crate) enum Body<T: 'static> {
    /// A straight line, which is recorded when it is first needed.
    Line(&'static Line<T>),
    /// A recorded graph.
    Graph(Arc<Recorded>),
    /// A search: decisions, then a straight line for every record.
    Search(Searched<T>),
}

/// The key of something kept with a recording: a program, a plan, or a derivative as a function of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    /// The program of a mode.
    Program(Mode),
    /// The plan of the CPU; `true` for all pairs, with shapes prepared once.
    Cpu(Mode, bool),
    /// The kernels of a GPU, likewise.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "used with the feature gpu")
    )]
    Gpu(Mode, bool),
    /// The replays of a search.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "used with the feature gpu")
    )]
    Replays(Mode),
    /// A derivative as a function.
    Derived(Mode),
    /// A derivative along directions as a function.
    Along(Order),
}

type Made = Arc<dyn Any + Send + Sync>;

/// Things of any type that are made once each, by their keys.
pub(crate) struct Once<K>(RwLock<HashMap<K, Made>>);

impl<K> Default for Once<K> {
    fn default() -> Self {
        Once(RwLock::default())
    }
}

impl<K: Eq + Hash> Once<K> {
    /// The thing of a key, made on first use. A key stands for one type.
    pub(crate) fn made<X: Send + Sync + 'static>(
        &self,
        key: K,
        make: &dyn Fn() -> Result<X, Error>,
    ) -> Result<Arc<X>, Error> {
        let known = self.0.read().unwrap_or_else(PoisonError::into_inner);
        let found = known.get(&key).cloned();
        drop(known);
        let found = match found {
            Some(found) => found,
            None => {
                let made: Made = Arc::new(make()?);
                let mut known = self.0.write().unwrap_or_else(PoisonError::into_inner);
                // If two threads made one, both use the first.
                Arc::clone(known.entry(key).or_insert(made))
            }
        };
        Ok(found
            .downcast()
            .unwrap_or_else(|_| unreachable!("a key stands for one type")))
    }
}

/// Things kept with a recording: programs of modes, plans of machines, derivatives.
pub(crate) type Kept = Once<Key>;

/// A function as machines run it: its layouts, its body, and what was made of it.
pub struct Recording<T: Real> {
    /// The shapes that it takes.
    pub(crate) takes: Vec<Leaf<T>>,
    /// Numbers of every shape of its result.
    pub(crate) outputs: Vec<usize>,
    /// The names of its arguments, one for each, or none.
    pub(crate) arguments: &'static [&'static str],
    /// The kernels that the library has compiled for it.
    pub(crate) compiled: Option<Compiled>,
    pub(crate) body: Body<T>,
    made: Kept,
}

/// The parts of a recording of a straight line.
pub(crate) struct Parts<T: Real> {
    pub(crate) compiled: fn() -> Option<Compiled>,
    pub(crate) takes: fn() -> Vec<Leaf<T>>,
    pub(crate) outputs: fn() -> Vec<usize>,
    pub(crate) arguments: &'static [&'static str],
    pub(crate) line: &'static Line<T>,
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

/// Recordings and programs of all functions, by the type of the function and that of what is kept.
static KNOWN: LazyLock<Once<(TypeId, TypeId)>> = LazyLock::new(Once::default);

/// The recording of a function, which is made once per type and format.
pub(crate) fn known<F: 'static, X: Send + Sync + 'static>(
    make: impl Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    known_by(TypeId::of::<F>(), &make)
}

/// The same by the type of the function.
fn known_by<X: Send + Sync + 'static>(
    function: TypeId,
    make: &dyn Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    KNOWN.made((function, TypeId::of::<X>()), make)
}

impl<T: Real> Recording<T> {
    /// A function of such shapes.
    pub(crate) fn new(
        takes: Vec<Leaf<T>>,
        outputs: Vec<usize>,
        arguments: &'static [&'static str],
        body: Body<T>,
    ) -> Self {
        Recording {
            takes,
            outputs,
            arguments,
            compiled: None,
            body,
            made: Kept::default(),
        }
    }

    /// The recording of an operation, the same one at every call.
    pub(crate) fn of_line(operation: TypeId, parts: &Parts<T>) -> Arc<Self> {
        let made = known_by(operation, &|| {
            let compiled = (parts.compiled)();
            let mut takes = (parts.takes)();
            if compiled == Some(Compiled::Quads) {
                takes = takes.into_iter().map(convex).collect();
            }
            Ok(Recording {
                compiled,
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

    /// Something that is made of the function once.
    pub(crate) fn made<X: Send + Sync + 'static>(
        &self,
        key: Key,
        make: &dyn Fn() -> Result<X, Error>,
    ) -> Result<Arc<X>, Error> {
        self.made.made(key, make)
    }

    /// The program of a mode: the result, or the result and derivatives, from the input and then the cotangent.
    pub(crate) fn program(&self, mode: Mode) -> Result<Arc<Recorded>, Error> {
        match &self.body {
            Body::Line(line) => line.program(mode),
            Body::Graph(recorded) if mode == Mode::Value => Ok(Arc::clone(recorded)),
            Body::Graph(recorded) => {
                self.made(Key::Program(mode), &|| Ok(by_reverse(recorded, mode)))
            }
            Body::Search(_) => Err(Error::Program(Unrecordable::Search)),
        }
    }

    /// A derivative as a function of its own, whose derivatives are of the next order.
    fn derivative(&self, mode: Mode) -> Result<Arc<Recording<T>>, Error> {
        self.made(Key::Derived(mode), &|| {
            let fields: Vec<usize> = self.takes.iter().map(|leaf| leaf.fields).collect();
            let (body, gives) = match &self.body {
                Body::Search(search) => (
                    Body::Search(search.then(Step::Mode(mode))),
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

/// The program of a mode, by reverse accumulation; that of `Vjp` gives the result first.
pub(crate) fn by_reverse(value: &Recorded, mode: Mode) -> Recorded {
    match mode {
        Mode::Value => value.clone(),
        Mode::ValueGrad => value.value_grad(),
        Mode::Jacobian => value.value_jacobian(),
        Mode::Vjp => value.value_vjp(),
    }
}

/// The programs of a straight line in a format.
struct Programs<T>(Kept, PhantomData<fn() -> T>);

impl<T: Real> Line<T> {
    /// The program of a mode, by the source that the row says.
    pub(crate) fn program(&self, mode: Mode) -> Result<Arc<Recorded>, Error> {
        if self.codes > 0 {
            return Err(Error::Program(Unrecordable::Codes));
        }
        let new = || Ok(Programs::<T>(Kept::default(), PhantomData));
        let kept = known_by((self.id)(), &new)?;
        kept.0.made(Key::Program(mode), &|| self.recorded(mode))
    }
    fn recorded(&self, mode: Mode) -> Result<Recorded, Error> {
        let value = || self.program(Mode::Value);
        Ok(match (self.derivatives, mode) {
            (_, Mode::Value) => listed(self.inputs, TRIALS, &self.eval)?,
            (Derivative::ByHand, Mode::Jacobian) => {
                self.program(Mode::Vjp)?.value_jacobian_of_vjp(self.outputs)
            }
            (Derivative::ByHand, Mode::Vjp) => {
                listed(self.inputs + self.outputs, TRIALS, &|numbers| {
                    let (input, out_bar) = numbers.split_at(self.inputs);
                    (self.adjoint)(input, out_bar)
                })?
            }
            (Derivative::ByHand, _) => listed(self.inputs, TRIALS, &|input| {
                (self.adjoint)(input, &vec![Sym::lit(1.0); self.outputs])
            })?,
            (Derivative::Reverse, _) => by_reverse(&*value()?, mode),
            (Derivative::Forward, Mode::Jacobian) => value()?.value_jacobian_forwards(),
            (Derivative::Forward, Mode::Vjp) => value()?.value_vjp_forwards(),
            (Derivative::Forward, _) => value()?.value_jacobian_forwards(),
        })
    }
}

/// A function and the derivative that is wanted of it: all that a machine is given beside columns.
#[derive(Debug)]
pub struct Call<T: Real> {
    pub(crate) recording: Arc<Recording<T>>,
    pub(crate) mode: Mode,
}

impl<T: Real> Clone for Call<T> {
    fn clone(&self) -> Self {
        Call {
            recording: Arc::clone(&self.recording),
            mode: self.mode,
        }
    }
}

impl<T: Real> Call<T> {
    /// The value of a function.
    pub(crate) const fn of(recording: Arc<Recording<T>>) -> Self {
        Call {
            recording,
            mode: Mode::Value,
        }
    }
    /// The derivative of what is called: of a value another mode of the same function, of a derivative one of the
    /// next order.
    ///
    /// # Errors
    ///
    /// Errors of recording the inner derivative.
    pub(crate) fn derived(self, mode: Mode) -> Result<Self, Error> {
        let recording = self.function()?;
        Ok(Call { recording, mode })
    }
    /// The function that is called: a recording, or a derivative of one as a recording of its own.
    pub(crate) fn function(self) -> Result<Arc<Recording<T>>, Error> {
        match self.mode {
            Mode::Value => Ok(self.recording),
            inner => self.recording.derivative(inner),
        }
    }
    /// The name of a column: an argument, or a cotangent after them.
    pub(crate) fn argument(&self, k: usize) -> Argument {
        let (takes, names) = (self.recording.takes.len(), self.recording.arguments);
        match names.get(k) {
            _ if k >= takes => Argument::Upstream,
            Some(name) if names.len() == takes => Argument::named(name),
            _ => Argument::input(k),
        }
    }
    /// The plan by which the CPU computes it: aligned, or for all pairs with shapes prepared once.
    ///
    /// # Errors
    ///
    /// Errors of recording it.
    pub(crate) fn plan(&self, framed: bool) -> Result<Arc<Plan<T>>, Error> {
        (drivers_in::<T>().plan)(self, framed)
    }
}
