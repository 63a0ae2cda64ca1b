//! Checks of gradients by the harness.
use crate::column::Column;
use crate::number::Number;
use crate::raised;
use crate::table::table;
use crate::traced::Recorded;
use geograd::check::{Conventions, Jumps, Report as Found, Sampling};
use geograd::kernels::check::Inputs;
use geograd::kernels::dynamic::Sampler;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::cell::{Cell, RefCell};

/// The findings of the harness about a function in a format.
#[pyclass(frozen, module = "geograd")]
pub struct Report {
    found: Found,
}

#[pymethods]
impl Report {
    /// True if nothing was refused.
    #[getter]
    fn passed(&self) -> bool {
        self.found.passed()
    }
    /// The format: float32 or float64.
    #[getter]
    fn dtype(&self) -> &'static str {
        match self.found.precision {
            geograd::ad::check::witness::Precision::F32 => "float32",
            _ => "float64",
        }
    }
    /// How many inputs were judged.
    #[getter]
    fn samples(&self) -> u64 {
        self.found.samples
    }
    /// How many of them were refused.
    #[getter]
    fn refused(&self) -> u64 {
        self.found.refused
    }
    /// How many were smooth places, kinks, and undefined.
    #[getter]
    fn places(&self) -> [u64; 3] {
        self.found.places
    }
    /// The first refusals: why, the number of the input at fault by its name, and the input, made as simple as it can be.
    #[getter]
    fn failures(&self) -> Vec<(String, String, Vec<f64>)> {
        let failure = |failure: &geograd::check::Failure| {
            let name = self
                .found
                .names
                .get(failure.fault.input)
                .cloned()
                .unwrap_or_default();
            (
                failure.fault.reason.to_string(),
                name,
                failure.input.clone(),
            )
        };
        self.found.failures.iter().map(failure).collect()
    }
    fn __bool__(&self) -> bool {
        self.found.passed()
    }
    fn __str__(&self) -> String {
        // The input as Python writes it.
        let lines = self.found.to_string();
        let lines =
            lines.lines().map(
                |line| match line.trim_start().strip_prefix("let input = ") {
                    Some(code) => format!(
                        "    input = {}",
                        code.replace("vec![", "[").trim_end_matches(';')
                    ),
                    None => line.to_owned(),
                },
            );
        lines.collect::<Vec<_>>().join("\n")
    }
}

/// Returns the distribution of inputs for columns.
fn inputs(columns: &[Column]) -> Inputs {
    let mut parts = Vec::new();
    for column in columns {
        match table().sampler(column.kind) {
            Some(sampler) => parts.push(sampler),
            None => parts.extend(std::iter::repeat_n(Sampler::number(), column.fields())),
        }
    }
    Inputs::new(parts)
}

/// Returns the names of the numbers of columns.
fn names(columns: &[Column]) -> Vec<String> {
    let mut all = Vec::new();
    for column in columns {
        let fields = table()
            .shapes
            .get(usize::from(column.kind))
            .filter(|shape| !shape.fields.is_empty());
        match (fields, &column.axes[..]) {
            (Some(shape), _) => all.extend(
                shape
                    .fields
                    .iter()
                    .map(|field| format!("{}.{field}", column.name)),
            ),
            (None, []) => all.push(column.name.clone()),
            (None, _) => all.extend((0..column.fields()).map(|i| format!("{}[{i}]", column.name))),
        }
    }
    all
}

/// The arguments of a check besides its function.
#[derive(FromPyObject)]
pub struct CheckArguments<'py> {
    #[pyo3(item)]
    samples: usize,
    #[pyo3(item)]
    seed: u64,
    #[pyo3(item)]
    hard: bool,
    #[pyo3(item)]
    inside: Option<Bound<'py, PyAny>>,
    #[pyo3(item)]
    resolution: [f64; 2],
    #[pyo3(item)]
    points: Vec<Vec<f64>>,
    /// The places at which the value may jump: nowhere, where it is zero, anywhere.
    #[pyo3(item)]
    jumps: String,
}

impl CheckArguments<'_> {
    fn jumps(&self) -> PyResult<Jumps> {
        match self.jumps.as_str() {
            "never" => Ok(Jumps::Never),
            "from zero" => Ok(Jumps::FromZero),
            "anywhere" => Ok(Jumps::Anywhere),
            other => Err(PyValueError::new_err(format!(
                "jumps: \"never\", \"from zero\" or \"anywhere\" is needed, not {other:?}"
            ))),
        }
    }
}

/// The first exception of a function of Python, after which no function is called.
#[derive(Default)]
struct FirstException(RefCell<Option<PyErr>>);

impl FirstException {
    fn or<X>(&self, otherwise: X, call: impl FnOnce() -> PyResult<X>) -> X {
        if self.0.borrow().is_some() {
            return otherwise;
        }
        call().unwrap_or_else(|error| {
            *self.0.borrow_mut() = Some(error);
            otherwise
        })
    }
    fn is_some(&self) -> bool {
        self.0.borrow().is_some()
    }
    fn done<X>(self, found: X) -> PyResult<X> {
        match self.0.into_inner() {
            Some(error) => Err(error),
            None => Ok(found),
        }
    }
}

/// Runs a check with these arguments.
fn with<'py, X>(
    py: Python<'py>,
    asked: &CheckArguments<'py>,
    run: impl FnOnce(&Sampling<'_>) -> PyResult<X>,
) -> PyResult<X> {
    let thrown = FirstException::default();
    let inside = |x: &[f64]| {
        thrown.or(false, || match &asked.inside {
            Some(inside) => inside.call1((PyArray1::from_slice(py, x),))?.is_truthy(),
            None => Ok(true),
        })
    };
    // A traced function runs without Python, which runs handlers of signals and other threads only when it is asked.
    let ends = || {
        py.detach(|| ());
        thrown.or((), || py.check_signals());
        thrown.is_some()
    };
    let sampling = Sampling {
        ends: Some(&ends),
        hard: usize::from(asked.hard),
        points: &asked.points,
        resolution: Some(asked.resolution),
        inside: asked
            .inside
            .is_some()
            .then_some(&inside as &dyn Fn(&[f64]) -> bool),
        ..Sampling::new(asked.samples, asked.seed)
    };
    let found = run(&sampling);
    thrown.done(())?;
    found
}

/// Checks the derivatives of a traced function in both formats.
#[pyfunction]
pub fn check_recorded<'py>(
    py: Python<'py>,
    of: &Recorded,
    asked: CheckArguments<'py>,
) -> PyResult<Vec<Report>> {
    use crate::number::Form;
    let double = of.call.program::<f64>(Form::Value)?.clone();
    let single = of.call.program::<f32>(Form::Value)?.clone();
    let (inputs, jumps) = (inputs(&of.call.takes), asked.jumps()?);
    with(py, &asked, |sampling| {
        let double_report = double
            .check(&of.name, &inputs, sampling, jumps, None)
            .map_err(raised)?;
        let single_report = single
            .check(&of.name, &inputs, sampling, jumps, Some(&double))
            .map_err(raised)?;
        Ok(vec![
            Report {
                found: double_report,
            },
            Report {
                found: single_report,
            },
        ])
    })
}

/// Checks a gradient, a function of an array of numbers, against the function that it is of.
#[pyfunction]
#[pyo3(signature = (name, value, gradient, takes, asked, double=true))]
pub fn check_callables<'py>(
    py: Python<'py>,
    name: &str,
    value: &Bound<'py, PyAny>,
    gradient: &Bound<'py, PyAny>,
    takes: Vec<(String, Option<String>, usize)>,
    asked: CheckArguments<'py>,
    double: bool,
) -> PyResult<Report> {
    let columns = crate::traced::columns(takes)?;
    let (inputs, jumps) = (inputs(&columns), asked.jumps()?);
    let found = with(py, &asked, |sampling| match double {
        true => judged::<f64>([value, gradient], name, &inputs, sampling, jumps),
        false => judged::<f32>([value, gradient], name, &inputs, sampling, jumps),
    })?;
    Ok(Report {
        found: Found {
            names: names(&columns),
            ..found
        },
    })
}

fn judged<T: Number>(
    [value, gradient]: [&Bound<'_, PyAny>; 2],
    name: &str,
    inputs: &Inputs,
    sampling: &Sampling<'_>,
    jumps: Jumps,
) -> PyResult<Found> {
    let py = value.py();
    let (thrown, outputs) = (FirstException::default(), Cell::new(1));
    let nowhere = |n: usize| vec![T::narrowed(f64::NAN); n];
    let value = |x: Vec<T>| {
        thrown.or(nowhere(outputs.get()), || {
            let y = listed::<T>(&value.call1((PyArray1::from_vec(py, x),))?)?;
            outputs.set(y.len());
            Ok(y)
        })
    };
    // With one number in the result the gradient; with several the products with a cotangent.
    let adjoint = |x: Vec<T>, bar: &[T]| {
        let n = x.len();
        thrown.or(nowhere(n), || {
            let arguments = (PyArray1::from_vec(py, x), PyArray1::from_slice(py, bar));
            let derivatives = listed::<T>(&gradient.call1(arguments)?)?;
            match derivatives.len() == n {
                true => Ok(derivatives),
                false => Err(PyValueError::new_err(format!(
                    "the gradient has {} numbers where {n} are needed",
                    derivatives.len()
                ))),
            }
        })
    };
    let conventions = Conventions {
        jumps,
        ..Inputs::CONVENTIONS
    };
    let check = inputs.check::<T>(name, sampling).conventions(conventions);
    let found = check.value(value).adjoint(adjoint).run();
    thrown.done(found)
}

/// Returns a list of numbers in a format.
fn listed<T: Number>(x: &Bound<'_, PyAny>) -> PyResult<Vec<T>> {
    let py = x.py();
    let array = py
        .import("numpy")?
        .call_method1("asarray", (x, numpy::dtype::<T>(py)))?;
    let flat = array.call_method1("reshape", (-1,))?;
    let flat = flat
        .cast_into::<PyArray1<T>>()
        .map_err(|_| PyTypeError::new_err("numbers are needed"))?;
    flat.to_vec()
        .map_err(|error| PyValueError::new_err(error.to_string()))
}
