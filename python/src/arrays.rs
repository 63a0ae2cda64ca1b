//! Arrays as rows of numbers, and arrays for results.
use crate::column::{Column, NUMBERS};
use crate::indexed::IndexedItems;
use crate::lent::{LentNumbers, in_use, plain};
use crate::number::Number;
use crate::shapes::{Content, Shape, array, stacked};
use crate::table::table;
use geograd::kernels::dynamic::Rows;
use numpy::{
    PyArray1, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyMemoryError, PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use std::sync::Arc;

/// An argument in the form of the caller.
pub enum CallArgument<'py> {
    Array(Bound<'py, PyUntypedArray>),
    /// Arrays of one axis, of one length and format: one per field.
    Columns(Vec<Py<PyUntypedArray>>),
    /// Items of a shared array, by indices.
    Indexed(Arc<IndexedItems>),
    Number(f64),
}

impl<'py> CallArgument<'py> {
    /// Reads an argument for a column: an array, or a shape of its kind.
    pub fn new(x: &Bound<'py, PyAny>, column: &Column) -> PyResult<Self> {
        if let Ok(shape) = x.cast::<Shape>() {
            let shape = shape.get();
            if column.kind != NUMBERS && shape.kind != column.kind {
                return Err(PyTypeError::new_err(format!(
                    "`{}` is {}, not {}",
                    column.name,
                    table().name(column.kind),
                    table().name(shape.kind)
                )));
            }
            return match &shape.content {
                Content::Array(array) => Ok(CallArgument::Array(array.bind(x.py()).clone())),
                Content::Columns(columns) if column.kind == shape.kind => {
                    Ok(CallArgument::Columns(
                        columns.iter().map(|own| own.clone_ref(x.py())).collect(),
                    ))
                }
                Content::Columns(columns) => Ok(CallArgument::Array(
                    stacked(x.py(), columns)?.into_bound(x.py()),
                )),
                Content::Indexed(items) if column.kind == shape.kind => {
                    Ok(CallArgument::Indexed(Arc::clone(items)))
                }
                Content::Indexed(items) => {
                    Ok(CallArgument::Array(items.array(x.py())?.into_bound(x.py())))
                }
                Content::Items(_) => Err(symbolic(&column.name)),
            };
        }
        if column.axes.is_empty()
            && let Ok(number) = x.cast_exact::<pyo3::types::PyFloat>()
        {
            return Ok(CallArgument::Number(number.extract()?));
        }
        let array = array(x, &column.name, column.kind)?;
        // A lone number stands for a shape with one number.
        if table().is_one_number(column.kind)
            && column.axes == [1]
            && array.shape().last() != Some(&1)
        {
            let key = (x.py().Ellipsis(), x.py().None());
            return Ok(CallArgument::Array(
                array.as_any().get_item(key)?.cast_into()?,
            ));
        }
        Ok(CallArgument::Array(array))
    }
    /// Returns `true` for an array of `f32`; `None` for an argument without a format.
    fn format(&self, py: Python<'_>) -> Option<bool> {
        match self {
            CallArgument::Columns(columns) => {
                let first = columns.first()?.bind(py);
                Some(first.dtype().itemsize() == 8)
            }
            CallArgument::Indexed(items) => Some(items.shared.bind(py).dtype().itemsize() == 8),
            CallArgument::Array(array) if array.ndim() > 0 => Some(array.dtype().itemsize() == 8),
            _ => None,
        }
    }
}

/// Returns the error for symbols in a place that cannot take them.
pub fn symbolic(name: &str) -> PyErr {
    PyTypeError::new_err(format!(
        "`{name}` has symbols, which only the plain call of a verb or a function takes"
    ))
}

/// Returns `true` if a call is in `f64`: unless all arrays are `f32`.
pub fn is_double(py: Python<'_>, given: &[CallArgument<'_>]) -> bool {
    let mut formats = given.iter().filter_map(|own| own.format(py)).peekable();
    formats.peek().is_none() || formats.any(|is_double| is_double)
}

/// A borrowed argument: its numbers in row-major order, or an array for every field.
pub struct ArgumentNumbers<'py, T: Number> {
    parts: Vec<PyReadonlyArrayDyn<'py, T>>,
    is_apart: bool,
    /// Indices into the one part.
    items: Option<Arc<IndexedItems>>,
    lead: Vec<usize>,
    fields: usize,
}

impl<'py, T: Number> ArgumentNumbers<'py, T> {
    /// Borrows the numbers of an argument. Copies arrays of another format, or not contiguous.
    pub fn new(py: Python<'py>, given: CallArgument<'py>, column: &Column) -> PyResult<Self> {
        let array = match given {
            CallArgument::Array(array) => array.into_any(),
            CallArgument::Columns(columns) if columns.len() == column.fields() => {
                let count = columns.first().map_or(0, |own| own.bind(py).len());
                // One row may stand for all, as in [`Rows`].
                if count != 1 {
                    return ArgumentNumbers::apart(py, columns, column, count);
                }
                stacked(py, &columns)?.into_bound(py).into_any()
            }
            CallArgument::Columns(columns) => stacked(py, &columns)?.into_bound(py).into_any(),
            CallArgument::Indexed(items) if items.count() != 1 => {
                let shared = plain::<T>(items.shared.bind(py).as_any().clone())?;
                let shared = shared.try_readonly().map_err(|_| in_use(&column.name))?;
                return Ok(ArgumentNumbers {
                    parts: vec![shared],
                    is_apart: false,
                    lead: vec![items.count()],
                    fields: column.fields(),
                    items: Some(items),
                });
            }
            CallArgument::Indexed(items) => items.array(py)?.into_bound(py).into_any(),
            CallArgument::Number(x) => PyArrayDyn::<T>::from_owned_array(
                py,
                numpy::ndarray::arr0(T::narrowed(x)).into_dyn(),
            )
            .into_any(),
        };
        let array = plain::<T>(array)?;
        let lead = lead(array.shape(), column)?.to_vec();
        ArgumentNumbers::whole(array, lead, column)
    }
    fn whole(
        array: Bound<'py, PyArrayDyn<T>>,
        lead: Vec<usize>,
        column: &Column,
    ) -> PyResult<Self> {
        let numbers = array.try_readonly().map_err(|_| in_use(&column.name))?;
        Ok(ArgumentNumbers {
            parts: vec![numbers],
            is_apart: false,
            items: None,
            lead,
            fields: column.fields(),
        })
    }
    fn apart(
        py: Python<'py>,
        columns: Vec<Py<PyUntypedArray>>,
        column: &Column,
        count: usize,
    ) -> PyResult<Self> {
        let mut parts = Vec::with_capacity(columns.len());
        for own in columns {
            let own = plain::<T>(own.into_bound(py).into_any())?;
            parts.push(own.try_readonly().map_err(|_| in_use(&column.name))?);
        }
        Ok(ArgumentNumbers {
            parts,
            is_apart: true,
            items: None,
            lead: vec![count],
            fields: column.fields(),
        })
    }
    /// Returns the axes before the axes of fields.
    pub fn lead(&self) -> &[usize] {
        &self.lead
    }
    /// Returns the numbers of an argument that is no shape.
    pub fn numbers(&self) -> PyResult<&[T]> {
        match (&self.parts[..], self.is_apart || self.items.is_some()) {
            ([whole], false) => slice(whole),
            _ => Err(PyTypeError::new_err(
                "an array of numbers is needed, not the columns of a shape",
            )),
        }
    }
    /// Returns the slices from which [`rows`](ArgumentNumbers::rows) makes rows: all numbers, or those of every field.
    pub fn slices(&self) -> PyResult<Vec<&[T]>> {
        self.parts.iter().map(slice).collect()
    }
    /// Returns the rows; one row stands for all if it may.
    pub fn rows<'s>(&'s self, slices: &'s [&'s [T]], may_be_one: bool) -> Rows<'s, T> {
        if let (Some(items), [shared]) = (&self.items, slices) {
            let (corners, fields) = (items.corners, self.fields);
            return Rows::indexed(shared, fields / corners, &items.indices, corners);
        }
        match slices {
            [numbers] if !self.is_apart && may_be_one && self.count() == 1 => Rows::one(numbers),
            [numbers] if !self.is_apart => Rows::new(numbers, self.fields),
            _ => Rows::apart(slices),
        }
    }
    pub fn count(&self) -> usize {
        self.lead.iter().product()
    }
    /// Repeats rows for the leading axes of a result.
    pub fn repeated(self, py: Python<'py>, lead: &[usize], column: &Column) -> PyResult<Self> {
        let shape = with_fields(lead, column);
        let numpy = py.import("numpy")?;
        let own: Vec<_> = self.parts.iter().map(|own| own.as_any().clone()).collect();
        let array = match (&own[..], &self.items) {
            (_, Some(items)) => items.array(py)?.into_bound(py).into_any(),
            ([whole], None) if !self.is_apart => whole.clone(),
            _ => {
                let axis = PyDict::new(py);
                axis.set_item("axis", -1)?;
                numpy.call_method("stack", (own,), Some(&axis))?
            }
        };
        let array = numpy.call_method1("broadcast_to", (array, PyTuple::new(py, &shape)?))?;
        ArgumentNumbers::whole(plain::<T>(array)?, lead.to_vec(), column)
    }
}

/// Returns the numbers of a contiguous array.
fn slice<'s, T: Number>(own: &'s PyReadonlyArrayDyn<'_, T>) -> PyResult<&'s [T]> {
    let failed = |error: numpy::AsSliceError| PyValueError::new_err(error.to_string());
    own.as_slice().map_err(failed)
}

/// Returns the shape of an array of a column.
pub fn with_fields(lead: &[usize], column: &Column) -> Vec<usize> {
    let mut shape = lead.to_vec();
    shape.extend(&column.axes);
    shape
}

/// Returns the axes of an array before the axes of its fields.
fn lead<'a>(shape: &'a [usize], column: &Column) -> PyResult<&'a [usize]> {
    if column.axes.is_empty() {
        return Ok(shape);
    }
    match shape.split_last() {
        Some((&fields, lead)) if fields == column.fields() => Ok(lead),
        _ => {
            let of = match table().shapes.get(usize::from(column.kind)) {
                Some(kind) if column.kind != 0 => {
                    format!("rows of {} ({})", kind.name, kind.fields.join(", "))
                }
                _ => format!("rows of {} numbers", column.fields()),
            };
            Err(PyValueError::new_err(format!(
                "`{}`: an array of shape (..., {}) is needed, {of}, not {shape:?}",
                column.name,
                column.fields()
            )))
        }
    }
}

/// Returns the leading axes of a result, by NumPy's rules, and their number of rows.
pub fn broadcast<T: Number>(
    lent: &[ArgumentNumbers<'_, T>],
    columns: &[Column],
) -> PyResult<(Vec<usize>, usize)> {
    let axes = lent.iter().map(|x| x.lead.len()).max().unwrap_or(0);
    let mut lead = vec![1_usize; axes];
    for (one, column) in lent.iter().zip(columns) {
        let from = axes - one.lead.len();
        for (axis, &size) in lead[from..].iter_mut().zip(&one.lead) {
            match (*axis, size) {
                (a, b) if a == b => {}
                (1, size) => *axis = size,
                (_, 1) => {}
                (a, b) => {
                    return Err(PyValueError::new_err(format!(
                        "`{}` has {b} rows where {a} are needed: shapes {} do not go together",
                        column.name,
                        shapes_of(lent)
                    )));
                }
            }
        }
    }
    let count = lead
        .iter()
        .try_fold(1_usize, |n, &size| n.checked_mul(size));
    match count {
        Some(count) => Ok((lead, count)),
        None => Err(PyMemoryError::new_err("more rows than memory can hold")),
    }
}

fn shapes_of<T: Number>(lent: &[ArgumentNumbers<'_, T>]) -> String {
    let one = |x: &ArgumentNumbers<'_, T>| match x.is_apart || x.items.is_some() {
        true => format!("{:?}", [x.count(), x.fields]),
        false => format!("{:?}", x.parts[0].shape()),
    };
    lent.iter().map(one).collect::<Vec<_>>().join(" and ")
}

/// Repeats arguments so that each has as many rows as the result, or one.
pub fn aligned<'py, T: Number>(
    py: Python<'py>,
    lent: Vec<ArgumentNumbers<'py, T>>,
    columns: &[Column],
    lead: &[usize],
    count: usize,
) -> PyResult<Vec<ArgumentNumbers<'py, T>>> {
    let fitted = lent
        .into_iter()
        .zip(columns)
        .map(|(one, column)| match one.count() {
            1 => Ok(one),
            n if n == count
                && n > 0
                && one
                    .lead
                    .iter()
                    .filter(|&&x| x != 1)
                    .eq(lead.iter().filter(|&&x| x != 1)) =>
            {
                Ok(one)
            }
            0 if count == 0 => Ok(one),
            _ => one.repeated(py, lead, column),
        });
    fitted.collect()
}

/// The most numbers of a new array that is made of zeros.
const FEW_ZEROS: usize = 4096;

/// An array for results: a new one that is written completely, or the caller's.
pub struct Target<'py, T: Number> {
    array: Bound<'py, PyArrayDyn<T>>,
    object: Bound<'py, PyAny>,
    is_callers: bool,
}

impl<'py, T: Number> Target<'py, T> {
    pub fn new(py: Python<'py>, shape: &[usize]) -> PyResult<Self> {
        let size = shape
            .iter()
            .try_fold(1_usize, |n, &size| n.checked_mul(size));
        if size
            .and_then(|size| size.checked_mul(size_of::<T>()))
            .is_none_or(|bytes| isize::try_from(bytes).is_err())
        {
            return Err(PyMemoryError::new_err("more results than memory can hold"));
        }
        let array = match size {
            // Zeros of few take less time than a call of Python; of many they are a pass over memory.
            Some(..=FEW_ZEROS) => PyArrayDyn::zeros(py, shape, false),
            _ => py
                .import(intern!(py, "numpy"))?
                .call_method1(
                    intern!(py, "empty"),
                    (PyTuple::new(py, shape)?, numpy::dtype::<T>(py)),
                )?
                .cast_into::<PyArrayDyn<T>>()?,
        };
        Ok(Target {
            object: array.as_any().clone(),
            array,
            is_callers: false,
        })
    }
    /// Returns the caller's array as a target, also if it is inside a shape.
    pub fn given(out: &Bound<'py, PyAny>, shape: &[usize], name: &str) -> PyResult<Self> {
        let mut object = out.clone();
        if let Ok(dressed) = out.cast::<Shape>()
            && let Content::Array(array) = &dressed.get().content
        {
            object = array.bind(out.py()).clone().into_any();
        }
        let format = if T::IS_DOUBLE { "float64" } else { "float32" };
        let array = object.cast::<PyArrayDyn<T>>().map_err(|_| {
            PyTypeError::new_err(format!(
                "out ({name}): an array of {format} is needed, like the arguments"
            ))
        })?;
        let refused = |why: String| Err(PyValueError::new_err(format!("out ({name}): {why}")));
        if array.shape() != shape {
            return refused(format!(
                "an array of shape {shape:?} is needed, not {:?}",
                array.shape()
            ));
        }
        if !array.is_c_contiguous() {
            return refused(
                "its numbers are not one after another; an array in C order is needed".to_owned(),
            );
        }
        if !array.getattr("flags")?.getattr("writeable")?.is_truthy()? {
            return refused("it is read-only".to_owned());
        }
        Ok(Target {
            array: array.clone(),
            object: out.clone(),
            is_callers: true,
        })
    }
    pub fn lock(&self, name: &str) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
        self.array.try_readwrite().map_err(|_| {
            PyValueError::new_err(format!(
                "out ({name}): it shares memory with an argument or another result, or is used by another call"
            ))
        })
    }
    /// Returns the result as an object: the caller's own, or the new array after `dress`.
    pub fn done(
        self,
        dress: impl FnOnce(Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        match self.is_callers {
            true => Ok(self.object),
            false => dress(self.object),
        }
    }
}

/// Returns the numbers of a locked array.
pub fn written<'a, T: Number>(guard: &'a mut PyReadwriteArrayDyn<'_, T>) -> PyResult<&'a mut [T]> {
    guard
        .as_slice_mut()
        .map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Returns offsets of groups or of paths: whole numbers that are not negative.
pub fn offsets(py: Python<'_>, x: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<usize>> {
    // Columns keep their offsets so: a look at anything else takes as long as a hundred lengths.
    let whole = match x.cast::<PyArray1<i64>>() {
        Ok(whole) if whole.is_c_contiguous() => whole.clone(),
        _ => whole_numbers(py, x, name)?,
    };
    let whole = LentNumbers::of(&whole, name)?;
    if let Some(item) = whole.numbers()?.iter().position(|&x| x < 0) {
        return Err(PyValueError::new_err(format!(
            "{name}: offset {item} is negative"
        )));
    }
    // None is negative, and no address has more bits than a pointer.
    Ok(match whole {
        LentNumbers::Copied(numbers) => numbers.into_iter().map(|x| x as usize).collect(),
        LentNumbers::Borrowed(_) => whole.numbers()?.iter().map(|&x| x as usize).collect(),
    })
}

/// Returns whole numbers as an array without gaps.
fn whole_numbers<'py>(
    py: Python<'py>,
    x: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<Bound<'py, PyArray1<i64>>> {
    let array = py.import("numpy")?.call_method1("asarray", (x,))?;
    let dtype = array.getattr("dtype")?;
    let kind: String = dtype.getattr("kind")?.extract()?;
    let axes: usize = array.getattr("ndim")?.extract()?;
    let size: usize = array.getattr("size")?.extract()?;
    if axes != 1 || !(kind == "i" || kind == "u" || size == 0) {
        return Err(PyTypeError::new_err(format!(
            "{name}: a list of whole numbers is needed, not an array of {dtype} with {axes} axes"
        )));
    }
    match array.cast::<PyArray1<i64>>() {
        Ok(whole) if whole.is_c_contiguous() => Ok(whole.clone()),
        _ => Ok(array
            .call_method1("astype", (numpy::dtype::<i64>(py),))?
            .cast_into::<PyArray1<i64>>()?),
    }
}
