//! Numbers of arrays of a call, and new arrays.
use crate::number::Number;
use numpy::ndarray::Dimension;
use numpy::{
    Element, PyArray, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The most numbers that are copied: to borrow an array takes as long as to copy so many.
const COPIED: usize = 1024;

/// The numbers of an array, one after another in memory.
pub enum LentNumbers<'py, T: Element, D: Dimension> {
    Copied(Vec<T>),
    Borrowed(PyReadonlyArray<'py, T, D>),
}

impl<'py, T: Element, D: Dimension> LentNumbers<'py, T, D> {
    /// Copies few numbers, borrows others. `name` is the argument in errors.
    pub fn of(array: &Bound<'py, PyArray<T, D>>, name: &str) -> PyResult<Self> {
        if array.len() <= COPIED {
            let copied = array.to_vec();
            return copied
                .map(LentNumbers::Copied)
                .map_err(|error| PyValueError::new_err(error.to_string()));
        }
        match array.try_readonly() {
            Ok(borrowed) => Ok(LentNumbers::Borrowed(borrowed)),
            Err(_) => Err(in_use(name)),
        }
    }
    pub fn numbers(&self) -> PyResult<&[T]> {
        match self {
            LentNumbers::Copied(numbers) => Ok(numbers),
            LentNumbers::Borrowed(borrowed) => borrowed
                .as_slice()
                .map_err(|error| PyValueError::new_err(error.to_string())),
        }
    }
}

/// Returns the error for an argument that another call writes.
pub fn in_use(name: &str) -> PyErr {
    PyValueError::new_err(format!("`{name}` is being written by another call"))
}

/// Returns an array of a list: a copy of a short one, which takes less time than an object that owns the list.
pub fn array_of<T: Element>(py: Python<'_>, list: Vec<T>) -> Bound<'_, PyArray1<T>> {
    match list.len() <= COPIED {
        true => PyArray1::from_slice(py, &list),
        false => PyArray1::from_vec(py, list),
    }
}

/// Returns a contiguous array in the format: the array itself, or a copy.
pub fn plain<T: Number>(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyArrayDyn<T>>> {
    let py = array.py();
    if let Ok(same) = array.cast::<PyArrayDyn<T>>()
        && same.is_c_contiguous()
    {
        return Ok(same.clone());
    }
    let options = PyDict::new(py);
    options.set_item("order", "C")?;
    options.set_item("copy", false)?;
    options.set_item("subok", false)?;
    let made = array.call_method("astype", (numpy::dtype::<T>(py),), Some(&options))?;
    Ok(made.cast_into::<PyArrayDyn<T>>()?)
}
