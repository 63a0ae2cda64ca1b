//! Functions of Python, recorded.
use crate::call::Callable;
use crate::column::{Column, NUMBER, NUMBERS};
use crate::forms::Call;
use crate::grouped::SuppressArguments;
use crate::machine::Machine;
use crate::number::{Form, Number};
use crate::pairs::Pairs;
use crate::raised;
use crate::symbol::{Symbol, number};
use crate::table::table;
use crate::tracing::Traced;
use geograd::kernels::dynamic::Program as Of;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::gc::{PyTraverseError, PyVisit};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// The forms of a traced function.
#[pyclass(frozen, module = "geograd")]
pub struct Recorded {
    pub name: String,
    pub call: Callable,
}

/// Returns columns from their names, the names of their shapes (or none) and their sizes; size zero is a lone number.
pub fn columns(takes: Vec<(String, Option<String>, usize)>) -> PyResult<Vec<Column>> {
    let column = |(name, shape, size): (String, Option<String>, usize)| {
        let kind = match (&shape, size) {
            (Some(shape), _) => table()
                .kind(shape)
                .ok_or_else(|| PyValueError::new_err(format!("no shape is called {shape}")))?,
            (None, 0) => NUMBER,
            (None, _) => NUMBERS,
        };
        let axes = if size == 0 { Vec::new() } else { vec![size] };
        Ok(Column { name, kind, axes })
    };
    takes.into_iter().map(column).collect()
}

impl Recorded {
    fn called<'a, 'py>(
        &'a self,
        arguments: &'a [Bound<'py, PyAny>],
        out: Option<&'a Bound<'py, PyAny>>,
        backend: Option<&str>,
        py: Python<'py>,
    ) -> PyResult<Call<'a, 'py>> {
        Ok(Call {
            py,
            of: &self.call,
            name: &self.name,
            arguments,
            out,
            machine: Machine::named(backend)?,
        })
    }
}

#[pymethods]
impl Recorded {
    /// Takes a function of symbols, and the name, the shape (or none) and the size of each of its columns; a size
    /// of zero is a lone number.
    #[new]
    fn new(
        name: String,
        function: Py<PyAny>,
        takes: Vec<(String, Option<String>, usize)>,
    ) -> PyResult<Self> {
        let columns = columns(takes)?;
        let traced = Traced::new(function, &columns);
        Ok(Recorded {
            name,
            call: Callable::of_traced(traced, columns),
        })
    }
    /// A form, item by item.
    #[pyo3(signature = (form, arguments, out=None, backend=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        arguments: Vec<Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        backend: Option<&str>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = self.called(&arguments, out, backend, py)?;
        call.item_by_item(Form::named(form)?)
    }
    /// A form of two lists.
    #[pyo3(signature = (form, lists, more=None, out=None, backend=None, groups=None))]
    #[allow(clippy::too_many_arguments)] // They have names in Python.
    fn of_pairs<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        lists: Vec<Bound<'py, PyAny>>,
        more: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        backend: Option<&str>,
        groups: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = self.called(&lists, out, backend, py)?;
        call.of_pairs(Pairs::named(form)?, more, groups)
    }
    /// The places of the shapes that suppression keeps.
    #[allow(clippy::too_many_arguments)] // They have names in Python.
    fn suppress<'py>(
        &self,
        py: Python<'py>,
        shapes: Bound<'py, PyAny>,
        scores: Bound<'py, PyAny>,
        overlap: f64,
        classes: Option<Vec<u32>>,
        score: Option<f64>,
        most: Option<usize>,
        groups: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let asked = SuppressArguments::new(&scores, overlap, classes, score, most, groups)?;
        let lists = [shapes.clone(), shapes];
        self.called(&lists, None, None, py)?.suppress(&asked)
    }
    /// The shape of every result, or none, and how many numbers that has, zero for a lone number.
    fn gives(&self) -> PyResult<Vec<(Option<&'static str>, usize)>> {
        self.call.program::<f64>(Form::Value)?;
        let one = |column: &Column| {
            let shape = (column.kind != NUMBER && column.kind != NUMBERS)
                .then(|| table().name(column.kind));
            (
                shape,
                column.axes.iter().product::<usize>() * usize::from(!column.axes.is_empty()),
            )
        };
        Ok(self.call.gives().iter().map(one).collect())
    }
    /// True if its result is a tuple.
    fn is_tuple(&self) -> PyResult<bool> {
        self.call.program::<f64>(Form::Value)?;
        Ok(self.call.is_tuple())
    }
    /// A function may hold what holds its recording; the collector breaks such a cycle in the function's own objects.
    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        match self.call.traced() {
            Some(traced) => visit.call(traced.function()),
            None => Ok(()),
        }
    }
    /// The program of a form in a format.
    #[pyo3(signature = (form="value", double=true))]
    fn program(&self, form: &str, double: bool) -> PyResult<Program> {
        Program::of(&self.call, form, double)
    }
}

enum InEither {
    Single(Of<f32>),
    Double(Of<f64>),
}

/// The operations of a function, in the order in which they are carried out.
#[pyclass(frozen, module = "geograd")]
pub struct Program {
    of: InEither,
}

macro_rules! either {
    ($me:expr, |$x:ident| $body:expr) => {
        match &$me.of {
            InEither::Single($x) => $body,
            InEither::Double($x) => $body,
        }
    };
}

impl Program {
    /// Returns the program of a form of a callable.
    pub fn of(call: &Callable, form: &str, double: bool) -> PyResult<Program> {
        let form = Form::named(form)?;
        let of = match double {
            true => InEither::Double(call.program::<f64>(form)?.clone()),
            false => InEither::Single(call.program::<f32>(form)?.clone()),
        };
        Ok(Program { of })
    }
    /// Returns a program of `float32`.
    pub fn single(program: Of<f32>) -> Program {
        Program {
            of: InEither::Single(program),
        }
    }
    /// Returns a program of `float64`.
    pub fn double(program: Of<f64>) -> Program {
        Program {
            of: InEither::Double(program),
        }
    }
}

#[pymethods]
impl Program {
    /// The format of its numbers: float32 or float64.
    #[getter]
    fn dtype(&self) -> &'static str {
        match self.of {
            InEither::Single(_) => "float32",
            InEither::Double(_) => "float64",
        }
    }
    /// How many operations a value takes.
    #[getter]
    fn cost(&self) -> usize {
        either!(self, |program| program.cost().total())
    }
    /// The operations: name, operands by their places, and the number of a constant or the place of an input; then the
    /// places of the results.
    fn nodes(&self) -> (Vec<(&'static str, Vec<u32>, f64)>, Vec<u32>) {
        use geograd::kernels::dynamic::Elementary;
        let nodes = either!(self, |program| program.nodes());
        let number = |operation: Elementary| match operation {
            Elementary::Constant(x) => x,
            Elementary::Input(place) => f64::from(place),
            Elementary::Bool(truth) => f64::from(u8::from(truth)),
            _ => 0.0,
        };
        let step = |step: geograd::kernels::dynamic::Step| {
            (step.operation.name(), step.operands, number(step.operation))
        };
        (nodes.nodes.into_iter().map(step).collect(), nodes.outputs)
    }
    /// The results for the numbers of one input.
    fn eval(&self, input: Vec<f64>) -> PyResult<Vec<f64>> {
        match &self.of {
            InEither::Single(program) => {
                let input: Vec<f32> = input.into_iter().map(|x| x as f32).collect();
                Ok(program
                    .eval(&input)
                    .map_err(raised)?
                    .into_iter()
                    .map(f64::from)
                    .collect())
            }
            InEither::Double(program) => program.eval(&input).map_err(raised),
        }
    }
    /// The results for symbols, as part of the function that is being recorded: a list of symbols for every argument.
    fn on_symbols(
        &self,
        py: Python<'_>,
        arguments: Vec<Vec<Bound<'_, PyAny>>>,
    ) -> PyResult<Vec<Py<Symbol>>> {
        fn of<T: Number>(
            py: Python<'_>,
            program: &Of<T>,
            arguments: &[Vec<Bound<'_, PyAny>>],
        ) -> PyResult<Vec<Py<Symbol>>> {
            let one = |x: &Bound<'_, PyAny>| {
                number::<T>(x)?.ok_or_else(|| {
                    PyTypeError::new_err("a program of symbols takes symbols and numbers")
                })
            };
            let lists = arguments
                .iter()
                .map(|list| list.iter().map(one).collect::<PyResult<Vec<_>>>());
            let lists = lists.collect::<PyResult<Vec<_>>>()?;
            let slices: Vec<&[_]> = lists.iter().map(Vec::as_slice).collect();
            let results = program.on_symbols(&slices).map_err(raised)?;
            results
                .into_iter()
                .map(|x| Py::new(py, Symbol(T::any(x))))
                .collect()
        }
        either!(self, |program| of(py, program, &arguments))
    }
    /// The function in WGSL; of float32 only.
    #[pyo3(signature = (name="function_of"))]
    fn wgsl(&self, name: &str) -> PyResult<String> {
        match &self.of {
            InEither::Single(program) => program.wgsl(name).map_err(raised),
            InEither::Double(_) => Err(PyTypeError::new_err(
                "WGSL has no float64: take the program of float32",
            )),
        }
    }
    /// A function of C, `void NAME(const T *x, T *out)`, with the bits of the library; it needs no library.
    #[pyo3(signature = (name="function_of"))]
    fn c(&self, name: &str) -> PyResult<String> {
        either!(self, |program| program.c(name).map_err(raised))
    }
    /// The header of the function of C, which names the numbers.
    #[pyo3(signature = (name="function_of"))]
    fn c_header(&self, name: &str) -> PyResult<String> {
        either!(self, |program| program.c_header(name).map_err(raised))
    }
    /// A kernel of CUDA over rows, `NAME(count, inner, of_a, a_step, a_inner, ..., out0, ...)`, for NVRTC.
    #[pyo3(signature = (name="function_of"))]
    fn cuda(&self, name: &str) -> PyResult<String> {
        either!(self, |program| program.cuda(name).map_err(raised))
    }
    /// A module of JavaScript that exports the function, with the bits of the library.
    #[pyo3(signature = (name="function_of"))]
    pub fn javascript(&self, name: &str) -> PyResult<String> {
        either!(self, |program| program.javascript(name).map_err(raised))
    }
    fn __str__(&self) -> String {
        either!(self, |program| program.to_string())
    }
    fn __repr__(&self) -> String {
        format!(
            "<geograd.Program of {} operations in {}>",
            self.cost(),
            self.dtype()
        )
    }
}

/// Returns the lists of a tuple.
pub fn listed<'py>(tuple: &Bound<'py, PyTuple>) -> Vec<Bound<'py, PyAny>> {
    tuple.iter().collect()
}
