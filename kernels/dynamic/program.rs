//! Programs whose shapes are known at run time, and the recording of functions of other languages.
use super::Mode;
use super::forms::Function;
use super::nodes::{Nodes, nodes};
use super::rows::{Layout, Rows, named};
use super::symbol::Symbol;
use crate::ad::program::opened::Opened;
use crate::ad::program::print::print;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Cost, Format, Sym, c, javascript, wgsl};
use crate::error::{Argument, Error, Unrecordable};
use crate::kernels::call::recording::{Body, Recording};
use crate::kernels::row::item::Leaf;
use crate::kernels::row::item::counts::expect;
use crate::scalar::Guard;
use crate::{Real, Scalar};
use std::fmt;
use std::sync::Arc;

/// A recorded function of lists of numbers: a traced function, an operation, or a derivative of one of these.
///
/// Clones share the plans that machines made of it.
#[derive(Clone)]
pub struct Program<T: Real> {
    inner: Arc<ProgramParts<T>>,
}

struct ProgramParts<T: Real> {
    /// The graph; that of an operation includes its gradient by hand, if it has one.
    recorded: Arc<Recorded>,
    names: Vec<Argument>,
    /// The recording that machines run; that of an operation has its own gradient and adjoint.
    recording: Arc<Recording<T>>,
    /// `true` for an operation.
    is_row: bool,
}

/// Returns the results for some numbers; NaN if one of the numbers is NaN.
fn guarded<S: Scalar>(input: &[S], mut results: Vec<S>) -> Vec<S> {
    let guard = Guard::of_numbers(input);
    for result in &mut results {
        *result = guard.result(*result);
    }
    results
}

impl<T: Real> fmt::Debug for Program<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Program")
            .field("takes", &self.takes())
            .field("gives", &self.gives())
            .field("cost", &self.cost())
            .finish()
    }
}

/// The text lists the operations in the order of execution.
impl<T: Real> fmt::Display for Program<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let result = |i| format!("result {i}");
        print(f, &self.inner.recorded, |i| self.input(i), result)
    }
}

impl<T: Real> Program<T> {
    pub(super) fn new(
        recorded: Recorded,
        takes: Vec<(Argument, Leaf<T>)>,
        gives: Vec<usize>,
    ) -> Self {
        let (names, takes) = takes.into_iter().unzip();
        let recorded = Arc::new(recorded);
        let body = Body::Graph(Arc::clone(&recorded));
        Program {
            inner: Arc::new(ProgramParts {
                recording: Arc::new(Recording::new(takes, gives, &[], body)),
                recorded,
                names,
                is_row: false,
            }),
        }
    }
    /// Returns the program of an operation.
    pub(super) fn of_row(
        recorded: Recorded,
        names: Vec<Argument>,
        recording: Arc<Recording<T>>,
    ) -> Self {
        Program {
            inner: Arc::new(ProgramParts {
                recorded: Arc::new(recorded),
                names,
                recording,
                is_row: true,
            }),
        }
    }

    /// Returns the program with names for its arguments, which errors then use.
    ///
    /// # Errors
    ///
    /// [`Error::Arguments`] for another number of names.
    pub fn named(self, names: &[&'static str]) -> Result<Self, Error> {
        let inner = &*self.inner;
        let takes = inner.recording.takes.len();
        if names.len() != takes {
            return Err(Error::Arguments {
                expected: takes,
                found: names.len(),
            });
        }
        Ok(Program {
            inner: Arc::new(ProgramParts {
                recorded: Arc::clone(&inner.recorded),
                names: named(names, takes),
                recording: Arc::clone(&inner.recording),
                is_row: inner.is_row,
            }),
        })
    }

    /// Returns the graph.
    #[cfg(feature = "check")]
    pub(crate) fn recorded(&self) -> &Recorded {
        &self.inner.recorded
    }
    /// Returns the name of a number of the input.
    fn input(&self, mut i: usize) -> String {
        let inner = &*self.inner;
        for (argument, leaf) in inner.names.iter().zip(&inner.recording.takes) {
            if i < leaf.fields {
                let field = (leaf.name)(i);
                return field.within(&argument.to_string()).to_string();
            }
            i -= leaf.fields;
        }
        String::new()
    }
    /// Returns the name and the layout of every argument.
    #[must_use]
    pub fn takes(&self) -> Vec<(Argument, Layout<T>)> {
        let layouts = self
            .inner
            .recording
            .takes
            .iter()
            .map(|&leaf| Layout { leaf });
        self.inner.names.iter().copied().zip(layouts).collect()
    }
    /// Returns the number of scalars of every shape in the result.
    #[must_use]
    pub fn gives(&self) -> &[usize] {
        &self.inner.recording.outputs
    }
    /// Returns the numbers of input scalars and of output scalars.
    #[must_use]
    pub fn sizes(&self) -> [usize; 2] {
        [
            self.inner.recorded.inputs,
            self.inner.recording.outputs.iter().sum(),
        ]
    }
    /// Returns the format of its numbers.
    #[must_use]
    pub fn format(&self) -> Format {
        T::FORMAT
    }
    /// Returns the number of operations in a value, by kind.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost::of(&self.inner.recorded.value.graph)
    }
    /// Returns the operations as data.
    #[must_use]
    pub fn nodes(&self) -> Nodes {
        nodes(&self.inner.recorded)
    }
    /// Returns the program as a function of columns, with every form of a batch.
    #[must_use]
    pub fn function(&self) -> Function<T> {
        Function {
            gpu: None,
            lower: None,
            recording: Arc::clone(&self.inner.recording),
            mode: Mode::Value,
            names: self.inner.names.clone(),
        }
    }
    /// Returns the results for the numbers of one input. It checks only their count.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another count.
    pub fn eval(&self, input: &[T]) -> Result<Vec<T>, Error> {
        expect(Argument::Shape, self.inner.recorded.inputs, input.len())?;
        Ok(guarded(input, self.inner.recorded.run(input)))
    }
    /// Returns the results for the numbers of one input on any scalar, with its derivatives if it has any.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another count.
    pub fn eval_on<S: Scalar>(&self, input: &[S]) -> Result<Vec<S>, Error> {
        expect(Argument::Shape, self.inner.recorded.inputs, input.len())?;
        Ok(guarded(input, self.inner.recorded.run_on(input)))
    }
    /// Computes item i of every column, as [`Function::aligned`].
    ///
    /// # Errors
    ///
    /// The errors of [`Function::aligned`].
    pub fn aligned(&self, rows: &[Rows<'_, T>]) -> Result<Vec<Vec<T>>, Error> {
        self.function().aligned(rows)
    }

    /// Returns a derivative of it, with `more` arguments after its own, and with other results.
    fn derived(
        &self,
        recorded: Recorded,
        more: Vec<(Argument, Leaf<T>)>,
        gives: Vec<usize>,
    ) -> Self {
        let own = self.inner.names.iter().copied();
        let own = own.zip(self.inner.recording.takes.iter().copied());
        Self::new(recorded, own.chain(more).collect(), gives)
    }
    fn inputs(&self) -> Vec<usize> {
        self.inner
            .recording
            .takes
            .iter()
            .map(|leaf| leaf.fields)
            .collect()
    }
    fn directions(&self) -> Vec<(Argument, Leaf<T>)> {
        let inputs = self.inputs().into_iter().enumerate();
        let direction = |(k, n)| (Argument::Direction(k), Layout::numbers(n).leaf);
        inputs.map(direction).collect()
    }
    fn one_number(&self) -> Result<(), Error> {
        match self.sizes()[1] {
            1 => Ok(()),
            found => Err(Error::NotOneNumber { found }),
        }
    }

    /// Returns the program of the result, one number, and its gradient. An operation uses the derivative that its row
    /// declares: by hand, reverse or forward.
    ///
    /// # Errors
    ///
    /// [`Error::NotOneNumber`] for other results.
    pub fn value_grad(&self) -> Result<Self, Error> {
        self.one_number()?;
        let recorded = (*self.inner.recording.program(Mode::ValueGrad)?).clone();
        let gives = [self.gives(), &self.inputs()].concat();
        Ok(self.derived(recorded, Vec::new(), gives))
    }
    /// Returns the adjoint: from an input and a cotangent of the result to the cotangent of the input. An operation
    /// uses the derivative that its row declares.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    pub fn vjp(&self) -> Result<Self, Error> {
        let recorded = match self.inner.is_row {
            true => self
                .inner
                .recording
                .program(Mode::Vjp)?
                .without_first(self.sizes()[1]),
            false => self.inner.recorded.vjp(),
        };
        let bars = self.inner.recording.outputs.iter();
        let bars = bars.map(|&n| (Argument::Upstream, Layout::numbers(n).leaf));
        Ok(self.derived(recorded, bars.collect(), self.inputs()))
    }
    /// Returns the program from an input and a direction to the result and its derivative along the direction.
    #[must_use]
    pub fn jvp(&self) -> Self {
        let gives = [self.gives(), self.gives()].concat();
        self.derived(self.inner.recorded.jvp(), self.directions(), gives)
    }
    /// Returns the program from an input and a direction to the derivative of the gradient along the direction.
    ///
    /// # Errors
    ///
    /// [`Error::NotOneNumber`] for other results than one number.
    pub fn hvp(&self) -> Result<Self, Error> {
        self.one_number()?;
        let recorded = self.inner.recorded.hvp();
        Ok(self.derived(recorded, self.directions(), self.inputs()))
    }
    /// Returns the program of the derivatives of every number of the result by every number of the input, in row-major
    /// order: one row per number of the result.
    ///
    /// # Errors
    ///
    /// The errors of recording it.
    pub fn jacobian(&self) -> Result<Self, Error> {
        let [inputs, outputs] = self.sizes();
        let recorded = match self.inner.is_row && outputs == 1 {
            true => self
                .inner
                .recording
                .program(Mode::ValueGrad)?
                .without_first(1),
            false => self.inner.recorded.jacobian(),
        };
        Ok(self.derived(recorded, Vec::new(), vec![inputs * outputs]))
    }
    /// Returns the program of the second derivatives by all numbers of the input, in row-major order.
    ///
    /// # Errors
    ///
    /// [`Error::NotOneNumber`] for other results than one number.
    pub fn hessian(&self) -> Result<Self, Error> {
        self.one_number()?;
        let [inputs, _] = self.sizes();
        let recorded = self.inner.recorded.hessian();
        Ok(self.derived(recorded, Vec::new(), vec![inputs * inputs]))
    }

    /// Records the program as part of a larger function that is being recorded, with a list of symbols for every
    /// argument. A gradient by hand is included.
    ///
    /// # Errors
    ///
    /// [`Error::Arguments`] and [`Error::Fields`] for a wrong number of arguments or fields, [`Error::Program`] for
    /// symbols of another recording or thread.
    pub fn on_symbols(&self, arguments: &[&[Symbol<T>]]) -> Result<Vec<Symbol<T>>, Error> {
        let inner = &*self.inner;
        let layouts: Vec<_> = inner.names.iter().copied().zip(self.inputs()).collect();
        let input = flat(&layouts, arguments)?;
        let values = guarded(&input, inner.recorded.run_on(&input));
        let made = match (inner.recorded.gradient_by_hand(), &values[..]) {
            (Some(gradient), &[value]) => {
                let derivatives = gradient.run_on(&input);
                vec![Sym::with_derivatives(
                    value,
                    input.into_iter().zip(derivatives),
                )]
            }
            _ => values,
        };
        Ok(made.into_iter().map(Symbol).collect())
    }
}

impl<T: Real> Program<T> {
    /// Returns the program as a module of JavaScript, as [`Program::javascript`](crate::Program::javascript).
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in JavaScript.
    pub fn javascript(&self, name: &str) -> Result<String, Error> {
        javascript::checked(name).map_err(Error::Program)?;
        let input = |i| self.input(i);
        Ok(javascript::module(name, &self.inner.recorded, input))
    }
    /// Returns the program as a function of C, as [`Program::c`](crate::Program::c).
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in C, C++ or CUDA.
    pub fn c(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        Ok(c::function(name, &self.inner.recorded, |i| self.input(i)))
    }
    /// Returns the header of [`c`](Program::c), which names the numbers.
    ///
    /// # Errors
    ///
    /// As `c`.
    pub fn c_header(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        Ok(c::header(name, &self.inner.recorded, |i| self.input(i)))
    }
    /// Returns the program as a kernel of CUDA over rows,
    /// `NAME(count, inner, of_a, a_step, a_inner, ..., out0, ...)`: a thread computes row `i inner + j` of every result
    /// from the rows of arguments at `i a_step + j a_inner`. Rows of a result follow each other.
    ///
    /// # Errors
    ///
    /// As [`c`](Program::c).
    pub fn cuda(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        let identifier = |argument: &Argument| {
            let is_letter = |c: char| c.is_ascii_alphanumeric();
            argument.to_string().replace(|c| !is_letter(c), "_")
        };
        let mut arguments: Vec<(String, usize)> = Vec::new();
        for (argument, width) in self.inner.names.iter().zip(self.inputs()) {
            let mut name = identifier(argument);
            // Derivatives of derivatives have factors of one name.
            while arguments.iter().any(|(own, _)| *own == name) {
                name.push('_');
            }
            arguments.push((name, width));
        }
        let input = |i| self.input(i);
        let inner = &self.inner;
        let gives = &inner.recording.outputs;
        Ok(c::kernel(name, &inner.recorded, &arguments, gives, input))
    }
}

impl Program<f32> {
    /// Returns the program as a function in WGSL, as [`Program::wgsl`](crate::Program::wgsl).
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in WGSL.
    pub fn wgsl(&self, name: &str) -> Result<String, Error> {
        wgsl::checked(name).map_err(Error::Program)?;
        Ok(wgsl::function(name, &self.inner.recorded))
    }
}

/// Returns the symbols of all arguments in one list, after a check of their numbers.
pub(super) fn flat<T: Real>(
    layouts: &[(Argument, usize)],
    arguments: &[&[Symbol<T>]],
) -> Result<Vec<Sym<T>>, Error> {
    if layouts.len() != arguments.len() {
        return Err(Error::Arguments {
            expected: layouts.len(),
            found: arguments.len(),
        });
    }
    let mut all = Vec::new();
    for (&(argument, expected), symbols) in layouts.iter().zip(arguments) {
        if symbols.len() != expected {
            return Err(Error::Fields {
                argument,
                expected,
                found: symbols.len(),
            });
        }
        for symbol in *symbols {
            symbol.belongs()?;
            all.push(symbol.0);
        }
    }
    Ok(all)
}

/// A function that is being recorded on this thread, from its arguments to its results.
///
/// Dropping it discards the recording. It cannot leave its thread.
///
/// ```
/// use geograd::kernels::dynamic::{Layout, Rows, Tracing, operation, symbol};
/// use geograd::Obb2;
/// // One minus the IoU, plus a tenth of the distance of two headings.
/// let tracing = Tracing::start(&[Layout::of::<Obb2<f64>>(); 2])?;
/// let [a, b] = &tracing.inputs()[..] else { unreachable!() };
/// let iou = operation("iou_obb2").expect("is listed").on_symbols(&[a, b])?[0];
/// let turn = symbol::magnitude(symbol::sub(a[4], b[4])?)?;
/// let turn = symbol::mul(symbol::literal(0.1)?, turn)?;
/// let loss = symbol::add(symbol::sub(symbol::literal(1.0)?, iou)?, turn)?;
/// let loss = tracing.finish(&[&[loss]])?.named(&["guess", "truth"])?;
///
/// let guesses = [0.0, 0.0, 2.0, 2.0, 0.5, 1.0, 0.0, 2.0, 2.0, 0.0];
/// let truth = [0.0, 0.0, 2.0, 2.0, 0.0];
/// let found = loss.value_grad()?.aligned(&[Rows::new(&guesses, 5), Rows::one(&truth)])?;
/// assert_eq!(found[0][1], 1.0 - 1.0 / 3.0);
/// assert!((found[1][5] - 4.0 / 9.0).abs() < 1e-15); // by the second guess's x
/// # Ok::<(), geograd::Error>(())
/// ```
pub struct Tracing<T: Real> {
    opened: Opened<T>,
    takes: Vec<Leaf<T>>,
}

impl<T: Real> fmt::Debug for Tracing<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Tracing").finish_non_exhaustive()
    }
}

impl<T: Real> Tracing<T> {
    /// Starts recording a function of arguments with these layouts.
    ///
    /// # Errors
    ///
    /// [`Error::Program`] if another recording is open on this thread ([`Unrecordable::Nested`]), or for shapes with
    /// whole numbers.
    pub fn start(takes: &[Layout<T>]) -> Result<Self, Error> {
        if takes.iter().any(|layout| layout.codes() > 0) {
            return Err(Error::Program(Unrecordable::Codes));
        }
        let inputs = takes.iter().map(Layout::fields).sum();
        Ok(Tracing {
            opened: Opened::start(inputs).map_err(Error::Program)?,
            takes: takes.iter().map(|layout| layout.leaf).collect(),
        })
    }
    /// Returns the symbols of every argument.
    #[must_use]
    pub fn inputs(&self) -> Vec<Vec<Symbol<T>>> {
        let mut all = self.opened.inputs().into_iter().map(Symbol);
        let takes = self.takes.iter();
        takes
            .map(|leaf| all.by_ref().take(leaf.fields).collect())
            .collect()
    }
    /// Ends the recording and returns the program with these results, each a list of numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Program`] for symbols of another recording, a result that depends on a literal that is not finite, or
    /// too many operations.
    pub fn finish(self, results: &[&[Symbol<T>]]) -> Result<Program<T>, Error> {
        let outputs: Vec<Sym<T>> = results.iter().flat_map(|x| x.iter().map(|x| x.0)).collect();
        let recorded = self.opened.finish(&outputs).map_err(Error::Program)?;
        let names = named(&[], self.takes.len());
        let takes = names.into_iter().zip(self.takes).collect();
        let gives = results.iter().map(|result| result.len()).collect();
        Ok(Program::new(recorded, takes, gives))
    }
}
