//! Shapes over arrays or symbols, and paths.
use crate::column::{CLOUD3, Kind, NUMBERS, POLYLINE, POLYLINE3, RING};
use crate::indexed::IndexedItems;
use crate::symbol::Symbol;
use crate::table::table;
use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::pyclass::CompareOp;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyList, PyTuple, PyType};
use std::sync::Arc;

/// The numbers of a shape.
pub enum Content {
    /// An array whose last axis has the fields.
    Array(Py<PyUntypedArray>),
    /// Arrays of one axis, of one length and format: one per field.
    Columns(Vec<Py<PyUntypedArray>>),
    /// Items of a shared column, by indices.
    Indexed(Arc<IndexedItems>),
    /// Symbols and numbers: one per field.
    Items(Vec<Py<PyAny>>),
}

/// Arrays of one axis, of one length and format, as which the fields of shapes are lent.
#[pyclass(frozen, module = "geograd")]
pub struct Columns(Vec<Py<PyUntypedArray>>);

#[pymethods]
impl Columns {
    #[new]
    fn new(columns: Vec<Bound<'_, PyUntypedArray>>) -> PyResult<Self> {
        let is_like = |own: &Bound<'_, PyUntypedArray>| {
            let first = &columns[0];
            let same = own.shape() == first.shape() && own.dtype().is_equiv_to(&first.dtype());
            same && own.ndim() == 1 && own.is_c_contiguous() && is_format(own)
        };
        match columns.iter().all(is_like) {
            true => Ok(Columns(columns.into_iter().map(Bound::unbind).collect())),
            false => Err(PyValueError::new_err(
                "columns: arrays of one axis, of one length and format, are needed",
            )),
        }
    }
}

/// Items of a shared column, as which indices are lent to a class.
#[pyclass(frozen, module = "geograd")]
struct SharedItems(Arc<IndexedItems>);

/// Copies arrays of fields to one array of rows.
pub fn stacked(py: Python<'_>, columns: &[Py<PyUntypedArray>]) -> PyResult<Py<PyUntypedArray>> {
    let axis = PyDict::new(py);
    axis.set_item("axis", -1)?;
    let columns = PyList::new(py, columns.iter().map(|own| own.bind(py)))?;
    let numpy = py.import("numpy")?;
    let made = numpy.call_method("stack", (columns,), Some(&axis))?;
    Ok(made.cast_into::<PyUntypedArray>()?.unbind())
}

/// Shapes of one kind: an array whose last axis has their numbers, or symbols.
#[pyclass(frozen, subclass, name = "Shape", module = "geograd")]
pub struct Shape {
    pub kind: Kind,
    pub content: Content,
}

/// Classes of shapes in Python, by kind.
static CLASSES: PyOnceLock<Vec<Option<Py<PyType>>>> = PyOnceLock::new();
/// The function that converts anything else to arrays of numbers: sequences, Arrow columns, geometries.
static CONVERT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();

/// Sets the classes of shapes, by the place of their kind, and the function that converts other things to arrays.
#[pyfunction]
pub fn set_classes(
    py: Python<'_>,
    classes: Vec<Option<Py<PyType>>>,
    convert: Py<PyAny>,
) -> PyResult<()> {
    let again = |_| PyRuntimeError::new_err("classes are set already");
    CLASSES.set(py, classes).map_err(again)?;
    CONVERT
        .set(py, convert)
        .map_err(|_| PyRuntimeError::new_err("classes are set already"))
}

/// Converts an object to an array of numbers, of NumPy's own class.
pub fn converted<'py>(
    x: &Bound<'py, PyAny>,
    name: &str,
    kind: Kind,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    let py = x.py();
    let convert = CONVERT
        .get(py)
        .ok_or_else(|| PyRuntimeError::new_err("import geograd first"))?;
    let made = convert.bind(py).call1((x, name, table().name(kind)))?;
    Ok(made.cast_into::<PyUntypedArray>()?)
}

/// Returns `true` if an array is of `float32` or `float64` in the byte order of this machine.
fn is_format(array: &Bound<'_, PyUntypedArray>) -> bool {
    let format = array.dtype();
    format.kind() == b'f'
        && matches!(format.itemsize(), 4 | 8)
        && format.is_native_byteorder() != Some(false)
}

/// Returns the array itself, or converts the object.
pub fn array<'py>(
    x: &Bound<'py, PyAny>,
    name: &str,
    kind: Kind,
) -> PyResult<Bound<'py, PyUntypedArray>> {
    match x.cast_exact::<PyUntypedArray>() {
        Ok(array) if is_format(array) => Ok(array.clone()),
        _ => converted(x, name, kind),
    }
}

/// Returns the class of a kind.
fn class(py: Python<'_>, kind: Kind) -> Option<&Py<PyType>> {
    CLASSES.get(py)?.get(usize::from(kind))?.as_ref()
}

/// Wraps an array in the class of a kind, if there is one.
pub fn dressed<'py>(array: Bound<'py, PyAny>, kind: Kind) -> PyResult<Bound<'py, PyAny>> {
    match class(array.py(), kind) {
        Some(class) => class.bind(array.py()).call1((array,)),
        None => Ok(array),
    }
}

/// Wraps symbols in the class of a kind, if there is one; else returns an array of objects, as numbers have one.
pub fn dressed_items<'py>(
    py: Python<'py>,
    items: Vec<Py<PyAny>>,
    kind: Kind,
    axes: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    match class(py, kind) {
        Some(class) => class.bind(py).call1(PyTuple::new(py, items)?),
        None => {
            let items = PyList::new(py, items)?;
            let array = py.import("numpy")?.call_method1("array", (items, "O"))?;
            array.call_method1("reshape", (PyTuple::new(py, axes)?,))
        }
    }
}

fn fields(kind: Kind) -> &'static [String] {
    &table().shapes[usize::from(kind)].fields
}

#[pymethods]
impl Shape {
    #[new]
    #[classmethod]
    #[pyo3(signature = (*numbers, **named))]
    fn new(
        class: &Bound<'_, PyType>,
        numbers: &Bound<'_, PyTuple>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let py = class.py();
        let kind: Kind = class.getattr("_kind")?.extract()?;
        let (name, fields) = (table().name(kind), fields(kind));
        let wrong = || {
            PyTypeError::new_err(format!(
                "{name} is made of one array of shape (..., {}), or of its numbers: {name}({})",
                fields.len(),
                fields.join(", ")
            ))
        };
        let one = numbers
            .iter()
            .next()
            .filter(|_| numbers.len() == 1 && named.is_none());
        let is_row = |one: &Bound<'_, PyAny>| {
            fields.len() != 1
                || one
                    .cast::<PyUntypedArray>()
                    .is_ok_and(|array| array.shape().last() == Some(&1))
        };
        if let Some(lent) = one.as_ref().and_then(|one| one.cast::<Columns>().ok()) {
            let columns = lent.get().0.iter().map(|own| own.clone_ref(py));
            let content = Content::Columns(columns.collect());
            return match lent.get().0.len() == fields.len() {
                true => Ok(Shape { kind, content }),
                false => Err(wrong()),
            };
        }
        if let Some(lent) = one.as_ref().and_then(|one| one.cast::<SharedItems>().ok()) {
            let content = Content::Indexed(Arc::clone(&lent.get().0));
            return Ok(Shape { kind, content });
        }
        if let Some(one) = one.filter(is_row) {
            if let Ok(shape) = one.cast::<Shape>() {
                return match shape.get() {
                    shape if shape.kind == kind => Ok(Shape {
                        kind,
                        content: shape.content.shared(py),
                    }),
                    shape => Err(PyTypeError::new_err(format!(
                        "{name} of {}: that is another shape",
                        table().name(shape.kind)
                    ))),
                };
            }
            // An array of numbers has no symbols, and reading its rows as objects costs more than a call.
            let is_array = one.cast::<PyUntypedArray>().is_ok_and(is_format);
            if !is_array
                && let Ok(list) = one.extract::<Vec<Bound<'_, PyAny>>>()
                && list.iter().any(|x| x.cast::<Symbol>().is_ok())
            {
                return match list.len() == fields.len() {
                    true => Ok(Shape {
                        kind,
                        content: Content::Items(list.into_iter().map(Bound::unbind).collect()),
                    }),
                    false => Err(wrong()),
                };
            }
            let array = array(&one, name, kind)?;
            return match array.shape().last() == Some(&fields.len()) {
                true => Ok(Shape {
                    kind,
                    content: Content::Array(array.unbind()),
                }),
                false => Err(PyValueError::new_err(format!(
                    "rows of {name} have {} numbers ({}), so an array of shape (..., {}) is needed, not {:?}",
                    fields.len(),
                    fields.join(", "),
                    fields.len(),
                    array.shape()
                ))),
            };
        }
        let mut all: Vec<Bound<'_, PyAny>> = numbers.iter().collect();
        if let Some(named) = named {
            for field in &fields[all.len().min(fields.len())..] {
                let spelled = field.replace(['.', '[', ']'], "_");
                let found = named.get_item(field)?.or(named.get_item(spelled)?);
                all.extend(found);
            }
            if all.len() != numbers.len() + named.len() {
                return Err(wrong());
            }
        }
        if all.len() != fields.len() {
            return Err(wrong());
        }
        let symbolic = |x: &Bound<'_, PyAny>| x.cast::<Symbol>().is_ok();
        if all.iter().any(symbolic) {
            return Ok(Shape {
                kind,
                content: Content::Items(all.into_iter().map(Bound::unbind).collect()),
            });
        }
        let mut columns = Vec::with_capacity(all.len());
        for (x, field) in all.iter().zip(fields) {
            columns.push(array(x, field, NUMBERS)?);
        }
        let numpy = py.import("numpy")?;
        let columns = numpy.call_method1("broadcast_arrays", PyTuple::new(py, columns)?)?;
        let columns: Vec<Py<PyUntypedArray>> = columns.extract()?;
        Ok(Shape {
            kind,
            content: Content::Array(stacked(py, &columns)?),
        })
    }

    /// Shapes made of rows of a shared array: of one by its index, or of several points. Numbers are read where they lie.
    #[classmethod]
    fn indexed(
        class: &Bound<'_, PyType>,
        shared: &Bound<'_, PyAny>,
        indices: &Bound<'_, PyAny>,
    ) -> PyResult<Py<PyAny>> {
        let kind: Kind = class.getattr("_kind")?.extract()?;
        let shared = match shared.cast::<Shape>() {
            Ok(shape) => shape.get().array(class.py())?.into_bound(class.py()),
            Err(_) => array(shared, "shared", kind)?,
        };
        let items = IndexedItems::new(shared, indices, kind)?;
        let lent = SharedItems(Arc::new(items));
        Ok(class.call1((Bound::new(class.py(), lent)?,))?.unbind())
    }
    /// The derivatives by the rows of the shared array from those by these shapes: sums in the order of shapes.
    fn gathered<'py>(&self, derivatives: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let Content::Indexed(items) = &self.content else {
            return Err(PyTypeError::new_err(format!(
                "{0} of no indices: {0}.indexed(...) makes one",
                table().name(self.kind)
            )));
        };
        let derivatives = array(derivatives, "derivatives", NUMBERS)?;
        match derivatives.dtype().itemsize() {
            4 => items.gathered::<f32>(derivatives.as_any()),
            _ => items.gathered::<f64>(derivatives.as_any()),
        }
    }

    /// The numbers: an array whose last axis has the fields.
    #[getter]
    pub fn array(&self, py: Python<'_>) -> PyResult<Py<PyUntypedArray>> {
        match &self.content {
            Content::Array(array) => Ok(array.clone_ref(py)),
            Content::Columns(columns) => stacked(py, columns),
            Content::Indexed(items) => items.array(py),
            Content::Items(_) => Err(PyTypeError::new_err(format!(
                "a {} of symbols is no array: the function is recorded once for all inputs",
                table().name(self.kind)
            ))),
        }
    }
    /// Its numbers one by one: arrays over the leading axes, or symbols.
    #[getter]
    fn numbers(&self, py: Python<'_>) -> PyResult<Vec<Py<PyAny>>> {
        (0..fields(self.kind).len())
            .map(|i| self.number(py, i))
            .collect()
    }
    /// The number in a place of its fields.
    #[pyo3(name = "_number")]
    pub fn number(&self, py: Python<'_>, place: usize) -> PyResult<Py<PyAny>> {
        match &self.content {
            Content::Array(_) | Content::Indexed(_) => {
                let key = (py.Ellipsis(), place);
                Ok(self.array(py)?.bind(py).as_any().get_item(key)?.unbind())
            }
            Content::Columns(columns) => columns
                .get(place)
                .map(|own| own.clone_ref(py).into_any())
                .ok_or_else(|| PyTypeError::new_err("no such field")),
            Content::Items(items) => items
                .get(place)
                .map(|item| item.clone_ref(py))
                .ok_or_else(|| PyTypeError::new_err("no such field")),
        }
    }
    #[getter]
    fn _is_symbolic(&self) -> bool {
        matches!(self.content, Content::Items(_))
    }
    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__(
        &self,
        py: Python<'_>,
        dtype: Option<&Bound<'_, PyAny>>,
        copy: Option<bool>,
    ) -> PyResult<Py<PyAny>> {
        let array = self.array(py)?.into_bound(py).into_any();
        let options = PyDict::new(py);
        options.set_item("copy", copy.unwrap_or(false))?;
        let dtype = match dtype {
            Some(dtype) => dtype.clone(),
            None => array.getattr("dtype")?,
        };
        let made = array.call_method("astype", (dtype,), Some(&options))?;
        // Columns and indices become rows by a copy only, and so does another format.
        let is_copy = !made.is(&array) || !matches!(self.content, Content::Array(_));
        match copy == Some(false) && is_copy {
            true => Err(PyValueError::new_err(
                "copy=False: the array would be a copy, of another format or order",
            )),
            false => Ok(made.unbind()),
        }
    }
    /// Row by row, whether all numbers are equal, as arrays compare: a truth for each row; shapes of another kind differ.
    fn __richcmp__<'py>(
        slf: &Bound<'py, Self>,
        other: &Bound<'py, PyAny>,
        op: CompareOp,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let (join, compare) = match op {
            CompareOp::Eq => ("all", "__eq__"),
            CompareOp::Ne => ("any", "__ne__"),
            _ => return Ok(py.NotImplemented().into_bound(py)),
        };
        let own = slf.get();
        let theirs = match other.cast::<Shape>() {
            Ok(theirs) if theirs.get().kind == own.kind => theirs.get(),
            _ => return Ok(py.NotImplemented().into_bound(py)),
        };
        if own._is_symbolic() || theirs._is_symbolic() {
            return Err(PyTypeError::new_err(
                "shapes of symbols are compared number by number: a.x == b.x",
            ));
        }
        let (a, b) = (own.array(py)?, theirs.array(py)?);
        let axis = PyDict::new(py);
        axis.set_item("axis", -1)?;
        let by_number = a.bind(py).as_any().call_method1(compare, (b,))?;
        by_number.call_method(join, (), Some(&axis))
    }
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        if let Content::Columns(columns) = &self.content {
            return Ok(columns.first().map_or(0, |own| own.bind(py).len()));
        }
        if let Content::Indexed(items) = &self.content {
            return Ok(items.count());
        }
        let array = self.array(py)?;
        let array = array.bind(py);
        match array.ndim() {
            1 => Err(PyTypeError::new_err(format!(
                "one {} has no length",
                table().name(self.kind)
            ))),
            _ => Ok(array.shape()[0]),
        }
    }
    fn __getitem__<'py>(&self, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let py = key.py();
        let array = self.array(py)?.into_bound(py);
        let wanted = array.shape().last().copied();
        // The axis of fields is kept whole.
        let whole = pyo3::types::PySlice::full(py);
        let mut keys: Vec<Bound<'py, PyAny>> = match key.cast::<PyTuple>() {
            Ok(keys) => keys.iter().collect(),
            Err(_) => vec![key.clone()],
        };
        if !keys.iter().any(|key| key.is(py.Ellipsis().bind(py))) {
            keys.push(py.Ellipsis().into_bound(py));
        }
        keys.push(whole.into_any());
        let found = array.as_any().get_item(PyTuple::new(py, keys)?)?;
        match found.cast::<PyUntypedArray>() {
            Ok(rows) if rows.shape().last().copied() == wanted => dressed(found, self.kind),
            _ => Err(PyTypeError::new_err(
                "an index is of rows; fields have names",
            )),
        }
    }
    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let name = table().name(self.kind);
        Ok(match &self.content {
            Content::Array(_) | Content::Columns(_) | Content::Indexed(_) => {
                format!("{name}({})", self.array(py)?.bind(py).as_any().str()?)
            }
            Content::Items(_) => format!("<{name} of symbols: {}>", fields(self.kind).join(", ")),
        })
    }
    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, (Py<PyUntypedArray>,))> {
        Ok((
            slf.get_type().into_any().unbind(),
            (slf.get().array(slf.py())?,),
        ))
    }
}

impl Content {
    fn shared(&self, py: Python<'_>) -> Content {
        match self {
            Content::Array(array) => Content::Array(array.clone_ref(py)),
            Content::Columns(columns) => {
                Content::Columns(columns.iter().map(|x| x.clone_ref(py)).collect())
            }
            Content::Indexed(items) => Content::Indexed(Arc::clone(items)),
            Content::Items(items) => {
                Content::Items(items.iter().map(|x| x.clone_ref(py)).collect())
            }
        }
    }
}

/// Paths: vertices one after another, and where each path starts; the last offset is the number of vertices.
#[pyclass(frozen, subclass, name = "Paths", module = "geograd")]
pub struct Paths {
    pub vertices: Py<PyUntypedArray>,
    pub offsets: Py<PyUntypedArray>,
    /// Rings, polylines or clouds, if known.
    pub kind: Option<Kind>,
    /// The number of scalars of a vertex.
    pub width: usize,
}

#[pymethods]
impl Paths {
    #[new]
    #[classmethod]
    fn new(
        class: &Bound<'_, PyType>,
        vertices: &Bound<'_, PyAny>,
        offsets: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let py = class.py();
        let path = match class.getattr_opt("_path")? {
            Some(path) => Some(path.extract::<String>()?),
            None => None,
        };
        let vertices = array(vertices, "vertices", NUMBERS)?;
        let widths: &[usize] = match path.as_deref() {
            Some("ring") => &[2],
            Some("cloud") => &[3],
            _ => &[2, 3],
        };
        if vertices.ndim() != 2 || !widths.contains(&vertices.shape()[1]) {
            let wanted: Vec<String> = widths.iter().map(|n| format!("(V, {n})")).collect();
            return Err(PyValueError::new_err(format!(
                "vertices: an array of shape {} is needed, not {:?}",
                wanted.join(" or "),
                vertices.shape()
            )));
        }
        let width = vertices.shape()[1];
        let kind = match (path.as_deref(), width) {
            (Some("ring"), _) => Some(RING),
            (Some("cloud"), _) => Some(CLOUD3),
            (Some(_), 3) => Some(POLYLINE3),
            (Some(_), _) => Some(POLYLINE),
            (None, _) => None,
        };
        let numpy = py.import("numpy")?;
        let offsets = numpy
            .call_method1("asarray", (offsets,))?
            .cast_into::<PyUntypedArray>()?;
        let is_whole = matches!(offsets.dtype().kind(), b'i' | b'u');
        if !is_whole && !offsets.is_empty() {
            return Err(PyTypeError::new_err("offsets: whole numbers are needed"));
        }
        if offsets.ndim() != 1 {
            return Err(PyValueError::new_err(format!(
                "offsets: an array of shape (N + 1,) is needed, not {:?}",
                offsets.shape()
            )));
        }
        Ok(Paths {
            vertices: vertices.unbind(),
            offsets: offsets.unbind(),
            kind,
            width,
        })
    }
    /// The vertices, an array of shape (V, 2), in space (V, 3).
    #[getter]
    fn vertices(&self, py: Python<'_>) -> Py<PyUntypedArray> {
        self.vertices.clone_ref(py)
    }
    /// The index of each path's first vertex, and the number of vertices.
    #[getter]
    fn offsets(&self, py: Python<'_>) -> Py<PyUntypedArray> {
        self.offsets.clone_ref(py)
    }
    fn __len__(&self, py: Python<'_>) -> usize {
        self.offsets.bind(py).len().saturating_sub(1)
    }
    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let paths = slf.get();
        let (count, vertices) = (
            paths.__len__(slf.py()),
            paths.vertices.bind(slf.py()).shape()[0],
        );
        Ok(format!(
            "<{} {count} of {vertices} vertices>",
            slf.get_type().name()?
        ))
    }
}
