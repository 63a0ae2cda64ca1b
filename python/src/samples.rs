//! Inputs of rows from the harness, for tests, and whether numbers are shapes.
use crate::catalogue::verbs;
use crate::table::table;
use geograd::check::Sampling;
use geograd::kernels::check::Inputs;
use geograd::kernels::dynamic::Operation;
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

fn row(verb: &str, place: usize) -> PyResult<&'static Operation> {
    let verb = verbs().iter().find(|one| one.name == verb);
    let row = verb
        .and_then(|verb| verb.rows.get(place))
        .and_then(|row| row.call.operation());
    row.ok_or_else(|| PyKeyError::new_err(place))
}

/// Random inputs of a row, from a seed: its arguments' numbers one after another.
#[pyfunction]
pub fn samples(verb: &str, place: usize, count: usize, seed: u64) -> PyResult<Vec<Vec<f64>>> {
    let row = row(verb, place)?;
    let (inputs, sampling) = (Inputs::new(row.samplers()), Sampling::new(count, seed));
    let drawn = (0..count).map(|i| inputs.draw(&mut sampling.draw(i)));
    Ok(drawn.filter(|x| row.is_inside(x)).collect())
}

/// The hard inputs of a row.
#[pyfunction]
pub fn hard_samples(verb: &str, place: usize) -> PyResult<Vec<Vec<f64>>> {
    let row = row(verb, place)?;
    let hard = Inputs::new(row.samplers()).hard();
    Ok(hard.into_iter().filter(|x| row.is_inside(x)).collect())
}

/// True for every row of numbers that is a shape of a kind: its numbers are finite, and within its limits.
#[pyfunction]
pub fn valid<'py>(
    py: Python<'py>,
    kind: &str,
    rows: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<bool>>> {
    let layout = table()
        .kind(kind)
        .and_then(|kind| table().layout::<f64>(kind));
    let layout = layout.ok_or_else(|| PyKeyError::new_err(kind.to_owned()))?;
    let numbers = rows
        .as_slice()
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let width = rows.shape()[1].max(1);
    let valid = numbers
        .chunks_exact(width)
        .map(|row| layout.check(row).is_ok());
    Ok(PyArray1::from_iter(py, valid))
}
