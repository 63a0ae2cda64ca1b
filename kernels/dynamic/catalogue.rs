//! Every operation of the library, by name.
use super::Mode;
use super::described::{Shape, shapes, summary, verb_of};
use super::forms::Function;
use super::paths::{OnPaths, UntypedFold, fold_double, fold_single};
use super::program::Program;
use super::rows::{Layout, Rows, named};
use super::symbol::Symbol;
use crate::ad::declared::Kind;
use crate::ad::program::record::{TRIALS, listed};
use crate::ad::sample::{Sample, Sampler};
use crate::error::{Argument, Error, Unrecordable};
use crate::kernels::call::modes::recording_of;
use crate::kernels::call::recording::{Body, Recording};
use crate::kernels::call::search::{self, HintedSearch};
use crate::kernels::gpu::line_sources;
use crate::kernels::ops;
use crate::kernels::ops::walk::{Walk, Written};
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::{Item, Leaf, leaves_of};
use crate::kernels::row::op::{Declared, Declares, Derivative, Op};
use crate::scalar::real::in_format;
use crate::{Fixed, Real};
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// The kind of formula that an operation has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sort {
    /// A straight line: a program, with derivatives of any order.
    Straight,
    /// A search: values, gradients and adjoints in batches.
    Search,
    /// A fold over a path of any length.
    Fold,
}

/// An operation of the library, without its types. Its declared [properties](Declared) are fields: its `name`, its
/// `doc`.
#[derive(Clone, Copy, Debug)]
pub struct Operation {
    /// The properties that it declares.
    pub(crate) declared: &'static Declared,
    /// Its verb and its shapes, as in the tables of rows.
    pub(crate) row: Written,
    /// The kind of its formula.
    pub sort: Sort,
    /// The kinds of the scalars of its arguments, and of its result.
    pub(crate) kinds: [fn() -> Vec<Kind>; 2],
    /// The distributions from which its arguments are drawn.
    samplers: fn() -> Vec<Sampler>,
    single: InFormat<f32>,
    double: InFormat<f64>,
}

impl Deref for Operation {
    type Target = Declared;
    fn deref(&self) -> &Declared {
        self.declared
    }
}

/// An operation in one format.
#[derive(Debug)]
#[doc(hidden)]
pub struct InFormat<T: Real> {
    takes: fn() -> Vec<Leaf<T>>,
    gives: fn() -> Vec<Leaf<T>>,
    body: Runner<T>,
}

/// The function that runs it.
#[derive(Debug)]
enum Runner<T: Real> {
    /// On columns.
    Columns(fn() -> Arc<Recording<T>>),
    /// On paths.
    Paths(UntypedFold<T>),
}

impl<T: Real> Clone for InFormat<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T: Real> Copy for InFormat<T> {}
impl<T: Real> Clone for Runner<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T: Real> Copy for Runner<T> {}

/// An argument of an operation.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in errors.
    pub name: Argument,
    /// Its shape.
    pub shape: Shape,
}

impl Operation {
    /// Returns the name of its [verb](crate::kernels::verbs) in lower case: `iou` of `iou_obb2`; `convert` of a
    /// conversion.
    #[must_use]
    pub fn verb(&self) -> String {
        verb_of(self.row.verb)
    }
    /// Returns the first paragraph of its documentation as plain text, without links.
    #[must_use]
    pub fn summary(&self) -> String {
        summary(self.declared.doc)
    }
    /// Returns its arguments, without the path of a fold.
    #[must_use]
    pub fn arguments(&self) -> Vec<Parameter> {
        let shapes = shapes(&(self.double.takes)(), &(self.kinds[0])());
        let names = named(self.declared.arguments, shapes.len());
        let all = names.into_iter().zip(shapes);
        all.map(|(name, shape)| Parameter { name, shape }).collect()
    }
    /// Returns how the derivatives of a straight line are made; `None` for a search or a fold.
    #[must_use]
    pub fn derivatives(&self) -> Option<Derivative> {
        (self.sort == Sort::Straight).then_some(self.declared.derivative)
    }
    /// Returns the shapes of its result: one, or the entries of a tuple.
    #[must_use]
    pub fn result(&self) -> Vec<Shape> {
        shapes(&(self.double.gives)(), &(self.kinds[1])())
    }
    /// Returns the distributions of its arguments, without the path of a fold.
    #[must_use]
    pub fn samplers(&self) -> Vec<Sampler> {
        (self.samplers)()
    }
    /// Returns `true` if the operation is defined at a valid input, given as the numbers of one argument after another.
    /// Folds are defined at every valid input.
    #[must_use]
    pub fn is_inside(&self, input: &[f64]) -> bool {
        self.declared.domain.is_none_or(|inside| inside(input))
    }
    /// Returns the operation in a format.
    fn of<T: Real>(&self) -> &InFormat<T> {
        in_format([&self.single, &self.double])
    }
    /// Returns the layouts of its arguments in a format, to trace functions of its shapes.
    #[must_use]
    pub fn layouts<T: Real>(&self) -> Vec<Layout<T>> {
        let leaves = (self.of::<T>().takes)().into_iter();
        leaves.map(|leaf| Layout { leaf }).collect()
    }

    /// Returns a mode of the operation on columns: its value, gradient or adjoint. `None` for folds, which run [on
    /// paths](Operation::on_paths), and for the gradient of a result of several numbers.
    #[must_use]
    pub fn function<T: Real>(&self, mode: Mode) -> Option<Function<T>> {
        let Runner::Columns(recording) = self.of::<T>().body else {
            return None;
        };
        let recording = recording();
        let is_one = recording.outputs.iter().sum::<usize>() == 1;
        (is_one || mode != Mode::ValueGrad).then(|| Function {
            gpu: None,
            lower: None,
            mode,
            names: named(self.declared.arguments, recording.takes.len()),
            recording,
        })
    }
    /// Returns the value on columns.
    #[must_use]
    pub fn value<T: Real>(&self) -> Option<Function<T>> {
        self.function(Mode::Value)
    }
    /// Returns the value, one number, with its gradient, on columns; `None` for other results and for folds.
    #[must_use]
    pub fn value_grad<T: Real>(&self) -> Option<Function<T>> {
        self.function(Mode::ValueGrad)
    }
    /// Returns the adjoint on columns; the last columns are cotangents.
    #[must_use]
    pub fn vjp<T: Real>(&self) -> Option<Function<T>> {
        self.function(Mode::Vjp)
    }
    /// Returns the operation on paths; `None` unless it is a fold.
    #[must_use]
    pub fn on_paths<T: Real>(&self) -> Option<OnPaths<T>> {
        let own = self.of::<T>();
        let Runner::Paths(code) = own.body else {
            return None;
        };
        let gives = (own.gives)().iter().map(|leaf| leaf.fields).sum();
        Some(OnPaths::new(
            code,
            self.declared.arguments,
            (own.takes)(),
            gives,
        ))
    }

    /// Returns a straight line as a program, for its derivatives and its nodes.
    ///
    /// # Errors
    ///
    /// [`Error::Program`]: searches are no programs ([`Unrecordable::Search`]), and folds only for paths of a given
    /// length ([`Unrecordable::Path`]; see [`program_of_path`](Operation::program_of_path)).
    pub fn program<T: Real>(&self) -> Result<Program<T>, Error> {
        let Some(recording) = self.straight::<T>() else {
            return Err(self.not_a_program());
        };
        let value = recording.program(Mode::Value)?;
        let is_number = recording.outputs == [1];
        let recorded = match self.derivatives() {
            Some(Derivative::ByHand) if is_number => {
                value.with_gradient_after_result(&*recording.program(Mode::ValueGrad)?)
            }
            _ => (*value).clone(),
        };
        let names = named(self.declared.arguments, recording.takes.len());
        Ok(Program::of_row(recorded, names, recording))
    }

    /// Returns the program of one input, a row per argument: a straight line as [`program`](Operation::program), and the
    /// replay of a search by the record that the input has. The program takes the scalars of the shapes, without whole
    /// numbers such as counts. For an input of the same record and the same whole numbers it has the bits of the search,
    /// and its derivatives are programs again; for another one its decisions are wrong.
    ///
    /// ```
    /// use geograd::kernels::dynamic::operation;
    /// let diameter = operation("diameter_of_polygon").expect("is listed");
    /// // Four of six corners, and their count.
    /// let polygon = [0.0, 0.0, 3.0, 0.0, 3.0, 4.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 4.0];
    /// let diagonal = diameter.replay::<f64>(&[&polygon])?;
    /// assert_eq!(diagonal.eval(&polygon[..12])?, [5.0]);
    /// assert!(diagonal.value_grad()?.c("diagonal")?.contains("void diagonal("));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Program`] for folds ([`Unrecordable::Path`]), the errors of recording it, and those of
    /// [`Function::aligned`] for an input.
    pub fn replay<T: Real>(&self, input: &[&[T]]) -> Result<Program<T>, Error> {
        match self.decided(input)? {
            Some((program, _)) => Ok(program),
            None => self.program(),
        }
    }

    /// Returns the [hints](crate::kernels::HintedSearch) of a search for one input, which its [`replay`](Self::replay)
    /// takes as an argument named `hints`; none for other operations, and for searches without hints. They are constants:
    /// programs of derivatives list zeros for the derivatives by them.
    ///
    /// # Errors
    ///
    /// The errors of [`replay`](Self::replay).
    pub fn hints<T: Real>(&self, input: &[&[T]]) -> Result<Vec<T>, Error> {
        Ok(self.decided(input)?.map_or_else(Vec::new, |found| found.1))
    }

    /// Returns the replay of a search for one input, and the hints; `None` for straight lines.
    fn decided<T: Real>(&self, input: &[&[T]]) -> Result<Option<(Program<T>, Vec<T>)>, Error> {
        let Some(function) = self.value::<T>() else {
            return Err(self.not_a_program());
        };
        let rows: Vec<_> = input.iter().map(|row| Rows::new(row, row.len())).collect();
        // Its errors are those of an input.
        function.aligned(&rows)?;
        let recording = function.recording;
        let Body::Search(search) = &recording.body else {
            return Ok(None);
        };
        let replays = search.replays(Mode::Value);
        let mut taken = Vec::new();
        let decided = replays.decide(&input.concat(), &mut taken)?;
        let leaves = recording.takes.iter().map(|leaf| leaf.without_codes());
        let mut takes: Vec<_> = function.names.into_iter().zip(leaves).collect();
        if replays.hints() > 0 {
            takes.push((Argument::named("hints"), Leaf::numbers(replays.hints())));
        }
        let hints = taken.split_off(taken.len() - replays.hints());
        let program = Program::new((*decided).clone(), takes, recording.outputs.clone());
        Ok(Some((program, hints)))
    }

    /// Returns a fold as a program, for paths of `vertices` vertices; their numbers follow the other arguments.
    ///
    /// # Errors
    ///
    /// The errors of recording it, and [`Unrecordable::Path`] for an operation that takes no path.
    pub fn program_of_path<T: Real>(&self, vertices: usize) -> Result<Program<T>, Error> {
        let own = self.of::<T>();
        let Runner::Paths(code) = own.body else {
            return Err(Error::Program(Unrecordable::Path));
        };
        let leaves = (own.takes)();
        let mut takes: Vec<_> = named(self.declared.arguments, leaves.len())
            .into_iter()
            .zip(leaves)
            .collect();
        takes.push((
            Argument::Vertices,
            Layout::numbers(code.vertex * vertices).leaf,
        ));
        let inputs = takes.iter().map(|take| take.1.fields).sum();
        let recorded = listed(T::FORMAT, inputs, TRIALS, &code.symbols)?;
        let gives = (own.gives)().iter().map(|leaf| leaf.fields).collect();
        Ok(Program::new(recorded, takes, gives))
    }

    /// Records the operation as part of the function that is being recorded on this thread. It takes a list of numbers
    /// per argument; the last one of a fold is the path.
    ///
    /// # Errors
    ///
    /// [`Error::Arguments`] and [`Error::Fields`] for a wrong number of arguments or fields; [`Error::Program`] for
    /// searches, and for symbols of another recording or thread.
    pub fn on_symbols<T: Real>(&self, arguments: &[&[Symbol<T>]]) -> Result<Vec<Symbol<T>>, Error> {
        let program = match self.of::<T>().body {
            Runner::Paths(code) => {
                let numbers = arguments.last().map_or(0, |path| path.len());
                self.program_of_path::<T>(numbers / code.vertex)?
            }
            _ => self.program::<T>()?,
        };
        program.on_symbols(arguments)
    }

    /// Returns the recording of a straight line.
    pub(crate) fn straight<T: Real>(&self) -> Option<Arc<Recording<T>>> {
        match (self.sort, self.of::<T>().body) {
            (Sort::Straight, Runner::Columns(recording)) => Some(recording()),
            _ => None,
        }
    }
    /// Returns the shaders of a straight line, each with its name.
    ///
    /// # Errors
    ///
    /// [`Unrecordable::Path`] for another operation, and the errors of recording it.
    #[doc(hidden)]
    pub fn shaders(&self) -> Result<Vec<(String, String)>, Error> {
        match self.straight::<f32>() {
            Some(recording) => line_sources(self.name, recording),
            None => Err(Error::Program(Unrecordable::Path)),
        }
    }
    /// Returns the operation with its row in the tables.
    pub(crate) const fn written(self, row: Written) -> Self {
        Operation { row, ..self }
    }
    /// Returns the error for an operation that is no program.
    const fn not_a_program(&self) -> Error {
        Error::Program(match self.sort {
            Sort::Search => Unrecordable::Search,
            _ => Unrecordable::Path,
        })
    }
}

fn kinds_of<P: Fixed<Scalar = f64> + Sample>() -> Vec<Kind> {
    P::filled(1.0).kinds()
}

/// Returns the description of an operation, by its type, argument, result and sort, and the operation in both formats.
const fn described<F: Declares, In, Out>(
    sort: Sort,
    single: InFormat<f32>,
    double: InFormat<f64>,
) -> Operation
where
    In: Fixed<Scalar = f64> + Sample,
    Out: Fixed<Scalar = f64> + Sample,
{
    Operation {
        declared: const { &F::DECLARED },
        row: Written {
            name: "",
            verb: "",
            shapes: &[],
        },
        sort,
        kinds: [kinds_of::<In>, kinds_of::<Out>],
        samplers: In::samplers,
        single,
        double,
    }
}

/// Returns the description of a straight line.
#[doc(hidden)]
#[must_use]
pub const fn straight<O: Op>() -> Operation
where
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
    O::In<f64>: Item<Scalar = f64> + Sample,
    O::Out<f64>: Item<Scalar = f64> + Sample,
{
    const fn of<T: Real, O: Op>() -> InFormat<T>
    where
        O::In<T>: Item<Scalar = T>,
        O::Out<T>: Item<Scalar = T>,
    {
        InFormat {
            takes: leaves_of::<O::In<T>>,
            gives: leaves_of::<O::Out<T>>,
            body: Runner::Columns(recording_of::<O, O::In<T>>),
        }
    }
    described::<O, O::In<f64>, O::Out<f64>>(Sort::Straight, of::<f32, O>(), of::<f64, O>())
}

/// Returns the description of a search.
#[doc(hidden)]
#[must_use]
pub const fn search<D: HintedSearch>() -> Operation
where
    D::In<f32>: Item<Scalar = f32>,
    D::Out<f32>: Item<Scalar = f32>,
    D::In<f64>: Item<Scalar = f64> + Sample,
    D::Out<f64>: Item<Scalar = f64> + Sample,
{
    const fn of<T: Real, D: HintedSearch>() -> InFormat<T>
    where
        D::In<T>: Item<Scalar = T>,
        D::Out<T>: Item<Scalar = T>,
    {
        InFormat {
            takes: leaves_of::<D::In<T>>,
            gives: leaves_of::<D::Out<T>>,
            body: Runner::Columns(search::recording::<D, D::In<T>>),
        }
    }
    described::<D, D::In<f64>, D::Out<f64>>(Sort::Search, of::<f32, D>(), of::<f64, D>())
}

/// Returns the description of a fold.
#[doc(hidden)]
#[must_use]
pub const fn fold<F: Fold>() -> Operation
where
    F::Context<f32>: Item<Scalar = f32>,
    F::Out<f32>: Item<Scalar = f32>,
    F::Context<f64>: Item<Scalar = f64> + Sample,
    F::Out<f64>: Item<Scalar = f64> + Sample,
{
    described::<F, F::Context<f64>, F::Out<f64>>(
        Sort::Fold,
        InFormat {
            takes: leaves_of::<F::Context<f32>>,
            gives: leaves_of::<F::Out<f32>>,
            body: Runner::Paths(fold_single::<F>()),
        },
        InFormat {
            takes: leaves_of::<F::Context<f64>>,
            gives: leaves_of::<F::Out<f64>>,
            body: Runner::Paths(fold_double::<F>()),
        },
    )
}

/// A list of operations, filled by the walk over all rows.
struct OperationList(Vec<Operation>);

impl OperationList {
    /// Adds an operation with its row. Not inlined: each of hundreds of rows calls it once.
    #[inline(never)]
    fn add(&mut self, operation: &'static Operation, row: Written) {
        self.0.push(operation.written(row));
    }
}

impl Walk for OperationList {
    fn straight<O: Op>(&mut self, row: Written)
    where
        O::In<f32>: Item<Scalar = f32>,
        O::Out<f32>: Item<Scalar = f32>,
        O::In<f64>: Item<Scalar = f64> + Sample,
        O::Out<f64>: Item<Scalar = f64> + Sample,
    {
        self.add(const { &straight::<O>() }, row);
    }
    fn search<D: HintedSearch>(&mut self, row: Written)
    where
        D::In<f32>: Item<Scalar = f32>,
        D::Out<f32>: Item<Scalar = f32>,
        D::In<f64>: Item<Scalar = f64> + Sample,
        D::Out<f64>: Item<Scalar = f64> + Sample,
    {
        self.add(const { &search::<D>() }, row);
    }
    fn fold<F: Fold>(&mut self, row: Written)
    where
        F::Context<f32>: Item<Scalar = f32>,
        F::Out<f32>: Item<Scalar = f32>,
        F::Context<f64>: Item<Scalar = f64> + Sample,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
        F::Out<f64>: Item<Scalar = f64> + Sample,
    {
        self.add(const { &fold::<F>() }, row);
    }
}

/// Returns every row of the library. A crate that calls this compiles all rows in both formats; other crates compile
/// none.
// Inlined, so that the calling crate compiles the rows, not this one.
#[inline]
#[must_use]
pub fn operations() -> &'static [Operation] {
    static ALL: OnceLock<Vec<Operation>> = OnceLock::new();
    ALL.get_or_init(|| {
        let mut all = OperationList(Vec::new());
        ops::each(&mut all);
        all.0
    })
}

/// Returns the operation with this name.
///
/// ```
/// use geograd::kernels::dynamic::operation;
/// let iou = operation("iou_obb2").expect("is listed");
/// assert_eq!((iou.verb().as_str(), iou.arguments()[1].shape.name.as_str()), ("iou", "Obb2"));
/// ```
#[inline]
#[must_use]
pub fn operation(name: &str) -> Option<&'static Operation> {
    operations().iter().find(|operation| operation.name == name)
}
