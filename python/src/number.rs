//! The two formats of numbers, and the values made in each.
use crate::raised;
use geograd::Real;
use geograd::kernels::dynamic::{Function, OnPaths, Program, Symbol};
use numpy::Element;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::{PyErr, PyResult};
use std::sync::OnceLock;

/// The forms of a callable that run item by item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Value,
    ValueGrad,
    Vjp,
    Jacobian,
    Jvp,
    Hvp,
    Hessian,
}

impl Form {
    pub const ALL: [(&'static str, Form); 7] = [
        ("value", Form::Value),
        ("value_grad", Form::ValueGrad),
        ("vjp", Form::Vjp),
        ("jacobian", Form::Jacobian),
        ("jvp", Form::Jvp),
        ("hvp", Form::Hvp),
        ("hessian", Form::Hessian),
    ];
    /// Returns the form of a name.
    pub fn named(name: &str) -> PyResult<Form> {
        let form = Form::ALL.iter().find(|form| form.0 == name);
        form.map(|form| form.1)
            .ok_or_else(|| PyValueError::new_err(format!("no form is called {name}")))
    }
    /// Returns this form of a program.
    pub fn of<T: Number>(self, value: &Program<T>) -> PyResult<Program<T>> {
        let made = match self {
            Form::Value => Ok(value.clone()),
            Form::ValueGrad => value.value_grad(),
            Form::Vjp => value.vjp(),
            Form::Jvp => Ok(value.jvp()),
            Form::Hvp => value.hvp(),
            Form::Jacobian => value.jacobian(),
            Form::Hessian => value.hessian(),
        };
        made.map_err(raised)
    }
}

/// A symbol of either format.
#[derive(Clone, Copy)]
pub enum Any {
    Single(Symbol<f32>),
    Double(Symbol<f64>),
}

/// Returns the error for a symbol that does not belong to the recording.
pub fn mixed() -> PyErr {
    PyTypeError::new_err(FOREIGN)
}

/// The message for a symbol of another recording.
const FOREIGN: &str = "this symbol belongs to a recording that is over, or to another one: a traced function may use its own \
                       arguments and numbers only, and must not keep symbols";

/// The two formats of arrays.
pub trait Number: Real + Element {
    const IS_DOUBLE: bool;
    fn made(made: &BothFormats) -> &InFormat<Self>;
    fn narrowed(x: f64) -> Self;
    fn any(symbol: Symbol<Self>) -> Any;
    fn symbol(any: Any) -> PyResult<Symbol<Self>>;
}
impl Number for f32 {
    const IS_DOUBLE: bool = false;
    fn made(made: &BothFormats) -> &InFormat<f32> {
        &made.single
    }
    fn narrowed(x: f64) -> f32 {
        x as f32
    }
    fn any(symbol: Symbol<f32>) -> Any {
        Any::Single(symbol)
    }
    fn symbol(any: Any) -> PyResult<Symbol<f32>> {
        match any {
            Any::Single(symbol) => Ok(symbol),
            Any::Double(_) => Err(mixed()),
        }
    }
}
impl Number for f64 {
    const IS_DOUBLE: bool = true;
    fn made(made: &BothFormats) -> &InFormat<f64> {
        &made.double
    }
    fn narrowed(x: f64) -> f64 {
        x
    }
    fn any(symbol: Symbol<f64>) -> Any {
        Any::Double(symbol)
    }
    fn symbol(any: Any) -> PyResult<Symbol<f64>> {
        match any {
            Any::Double(symbol) => Ok(symbol),
            Any::Single(_) => Err(mixed()),
        }
    }
}

/// The functions and programs made in one format. Reading takes no lock, which a forked child might find taken.
pub struct InFormat<T: Number> {
    pub functions: [OnceLock<Function<T>>; 7],
    pub programs: [OnceLock<Program<T>>; 7],
    pub on_paths: OnceLock<Option<OnPaths<T>>>,
}

impl<T: Number> Default for InFormat<T> {
    fn default() -> Self {
        InFormat {
            functions: [const { OnceLock::new() }; 7],
            programs: [const { OnceLock::new() }; 7],
            on_paths: OnceLock::new(),
        }
    }
}

/// The functions and programs in both formats.
#[derive(Default)]
pub struct BothFormats {
    single: InFormat<f32>,
    double: InFormat<f64>,
}
