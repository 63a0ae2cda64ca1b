//! Inputs of rows from the harness, for tests.
use crate::catalogue::verbs;
use geograd::check::Sampling;
use geograd::kernels::check::Inputs;
use geograd::kernels::dynamic::Operation;
use pyo3::exceptions::PyKeyError;
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
