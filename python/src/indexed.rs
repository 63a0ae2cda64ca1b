//! Shapes that are made of items of a shared column, by indices.
use crate::column::Kind;
use crate::lent::plain;
use crate::number::Number;
use crate::raised;
use crate::table::table;
use geograd::kernels::dynamic::Rows;
use numpy::{PyArray1, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// The ends of the names of a point's coordinates.
const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// Items of a shared column, some of them a row.
pub struct IndexedItems {
    /// The items: an array of two axes.
    pub shared: Py<PyUntypedArray>,
    /// The indices of all rows, one row after another.
    pub indices: Vec<u32>,
    /// The number of items that make a row.
    pub corners: usize,
}

/// Returns `true` if the numbers of a shape are those of points with so many coordinates.
fn is_of_points(fields: &[String], size: usize) -> bool {
    let last = |name: &String| name.rsplit('.').next().map(str::to_owned);
    let mut all = fields.iter().enumerate();
    (2..=3).contains(&size)
        && all.all(|(k, name)| last(name).as_deref() == Some(COORDINATES[k % size]))
}

impl IndexedItems {
    /// Reads the column and the indices: one for each row, or several along the last axis.
    pub fn new(
        shared: Bound<'_, PyUntypedArray>,
        indices: &Bound<'_, PyAny>,
        kind: Kind,
    ) -> PyResult<Self> {
        let py = shared.py();
        let (name, fields) = (
            table().name(kind),
            &table().shapes[usize::from(kind)].fields,
        );
        let given = py.import("numpy")?.call_method1("asarray", (indices,))?;
        let given = given.cast_into::<PyUntypedArray>()?;
        let (corners, size) = match (given.shape(), shared.shape()) {
            (&[_], &[_, size]) => (1, size),
            (&[_, corners], &[_, size]) => (corners, size),
            (indices, shared) => {
                return Err(PyValueError::new_err(format!(
                    "{name}.indexed takes rows of shape (M, K) and indices of shape (N,) or (N, C), not {shared:?} and \
                     {indices:?}"
                )));
            }
        };
        if corners * size != fields.len() || corners != 1 && !is_of_points(fields, size) {
            return Err(PyValueError::new_err(format!(
                "{name} has {} numbers ({}): {corners} of rows of {size} do not make it",
                fields.len(),
                fields.join(", ")
            )));
        }
        let kind = given.dtype().getattr("kind")?.extract::<String>()?;
        if !matches!(&*kind, "i" | "u") && given.len() > 0 {
            return Err(PyTypeError::new_err(format!(
                "indices: whole numbers are needed, not an array of {}",
                given.dtype()
            )));
        }
        let count = shared.shape()[0];
        let whole = given
            .call_method1("astype", (numpy::dtype::<i64>(py),))?
            .call_method0("ravel")?;
        let whole = whole.cast_into::<PyArray1<i64>>()?.readonly();
        let mut indices = Vec::with_capacity(whole.len());
        for (k, &index) in whole.as_slice()?.iter().enumerate() {
            let known = u32::try_from(index)
                .ok()
                .filter(|&own| (own as usize) < count);
            indices.push(known.ok_or_else(|| {
                PyValueError::new_err(format!(
                    "`indices` item {}: index {index} in place {} is not one of the {count} rows",
                    k / corners,
                    k % corners
                ))
            })?);
        }
        Ok(IndexedItems {
            shared: shared.unbind(),
            indices,
            corners,
        })
    }
    /// Returns the number of rows.
    pub fn count(&self) -> usize {
        self.indices.len() / self.corners
    }
    /// Returns the number of numbers of a row.
    pub fn fields(&self, py: Python<'_>) -> usize {
        let shared = self.shared.bind(py);
        self.corners * shared.shape().get(1).copied().unwrap_or(0)
    }
    /// Returns the numbers of all rows, copied.
    pub fn array(&self, py: Python<'_>) -> PyResult<Py<PyUntypedArray>> {
        let indices = PyArray1::from_slice(py, &self.indices);
        let shared = self.shared.bind(py);
        let taken = shared.call_method1("take", (indices, 0))?;
        let rows = taken.call_method1("reshape", ((self.count(), self.fields(py)),))?;
        Ok(rows.cast_into::<PyUntypedArray>()?.unbind())
    }
    /// Returns the derivatives by the shared items from those by all rows.
    pub fn gathered<'py, T: Number>(
        &self,
        derivatives: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = derivatives.py();
        let shared = plain::<T>(self.shared.bind(py).as_any().clone())?;
        let derivatives = plain::<T>(derivatives.clone())?;
        let (count, size) = (shared.shape()[0], shared.shape()[1]);
        if *derivatives.shape() != [self.count(), self.corners * size] {
            return Err(PyValueError::new_err(format!(
                "derivatives: an array of shape {:?} is needed, not {:?}",
                [self.count(), self.corners * size],
                derivatives.shape()
            )));
        }
        let (shared, derivatives) = (shared.readonly(), derivatives.readonly());
        let rows = Rows::indexed(shared.as_slice()?, size, &self.indices, self.corners);
        let numbers = derivatives.as_slice()?;
        let sums = py.detach(|| rows.gathered(numbers)).map_err(raised)?;
        PyArray1::from_vec(py, sums)
            .as_any()
            .call_method1("reshape", ((count, size),))
    }
}
