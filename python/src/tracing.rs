//! Functions of Python, called once with symbols.
use crate::column::{Column, Kind, NUMBER, NUMBERS};
use crate::number::Number;
use crate::raised;
use crate::symbol::{Symbol, number};
use crate::table::table;
use geograd::kernels::dynamic::{Layout, Program as Of, Tracing};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::collections::HashSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// A function of Python that computes results from symbols.
pub struct Traced {
    /// The function. It takes a list of symbols for every column. It returns whether the result is a tuple. For every
    /// part of the result it returns a shape's name, its numbers, and whether they have an axis of their own.
    function: Py<PyAny>,
    names: Vec<&'static str>,
    is_tuple: AtomicBool,
}

/// The result of a traced function: a tuple or not, and its parts.
type Result<'py> = (bool, Vec<(Option<String>, Vec<Bound<'py, PyAny>>, bool)>);

impl Traced {
    pub fn new(function: Py<PyAny>, takes: &[Column]) -> Self {
        let names = takes.iter().map(|column| kept(&column.name)).collect();
        Traced {
            function,
            names,
            is_tuple: AtomicBool::new(false),
        }
    }
    /// Returns the function for the collector of cycles, since it may refer to the owner of its recording.
    pub fn function(&self) -> &Py<PyAny> {
        &self.function
    }
    pub fn is_tuple(&self) -> bool {
        self.is_tuple.load(Ordering::Relaxed)
    }
    /// Calls the function once, with symbols.
    pub fn record<T: Number>(&self, takes: &[Column]) -> PyResult<(Of<T>, Vec<Column>)> {
        Python::attach(|py| {
            let layout = |column: &Column| match table().layout::<T>(column.kind) {
                Some(layout) => layout,
                None => Layout::numbers(column.fields()),
            };
            let layouts: Vec<Layout<T>> = takes.iter().map(layout).collect();
            let tracing = Tracing::start(&layouts).map_err(raised)?;
            let mut arguments = Vec::new();
            for symbols in tracing.inputs() {
                let symbols = symbols.into_iter().map(|x| Py::new(py, Symbol(T::any(x))));
                arguments.push(PyList::new(py, symbols.collect::<PyResult<Vec<_>>>()?)?);
            }
            let made = self
                .function
                .bind(py)
                .call1((PyList::new(py, arguments)?,))?;
            let (is_tuple, parts): Result<'_> = made.extract()?;
            let (mut results, mut gives) = (Vec::new(), Vec::new());
            for (shape, items, has_axis) in parts {
                let mut numbers = Vec::with_capacity(items.len());
                for item in &items {
                    let Some(symbol) = number::<T>(item)? else {
                        return Err(PyTypeError::new_err(format!(
                            "a traced function gives symbols and numbers, shapes, tuples and lists of them, not {}",
                            item.get_type().name()?
                        )));
                    };
                    numbers.push(symbol);
                }
                let kind: Kind = match shape {
                    Some(name) => table().kind(&name).unwrap_or(NUMBERS),
                    None if has_axis => NUMBERS,
                    None => NUMBER,
                };
                let axes = if has_axis {
                    vec![numbers.len()]
                } else {
                    Vec::new()
                };
                gives.push(Column {
                    name: "result".to_owned(),
                    kind,
                    axes,
                });
                results.push(numbers);
            }
            let results: Vec<&[_]> = results.iter().map(Vec::as_slice).collect();
            let program = tracing.finish(&results).map_err(raised)?;
            let program = program.named(&self.names).map_err(raised)?;
            self.is_tuple.store(is_tuple, Ordering::Relaxed);
            Ok((program, gives))
        })
    }
}

/// Returns a name that lives as long as the process, stored once per text.
fn kept(name: &str) -> &'static str {
    static NAMES: Mutex<Option<HashSet<&'static str>>> = Mutex::new(None);
    let mut names = NAMES
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let names = names.get_or_insert_default();
    match names.get(name) {
        Some(name) => name,
        None => {
            let name: &'static str = Box::leak(name.to_owned().into_boxed_str());
            names.insert(name);
            name
        }
    }
}
