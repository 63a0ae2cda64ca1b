//! Columns of polygons with holes and parts.
use crate::arrays::offsets as offsets_of;
use crate::number::Number;
use crate::shapes::array;
use geograd::polygon::Rings;
use geograd::{Scalar, Vec2};
use numpy::{PyArray1, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// The vertices of a column in one of both formats.
pub enum Vertices {
    Single(Vec<Vec2<f32>>),
    Double(Vec<Vec2<f64>>),
}

impl Vertices {
    pub fn len(&self) -> usize {
        match self {
            Vertices::Single(all) => all.len(),
            Vertices::Double(all) => all.len(),
        }
    }
}

/// A format in which vertices are kept, or to which they are widened.
pub trait Format: Number {
    fn of(vertices: &Vertices) -> Cow<'_, [Vec2<Self>]>;
    fn kept(vertices: Vec<Vec2<Self>>) -> Vertices;
}
impl Format for f32 {
    fn of(vertices: &Vertices) -> Cow<'_, [Vec2<f32>]> {
        match vertices {
            Vertices::Single(all) => Cow::Borrowed(all),
            Vertices::Double(all) => {
                let narrow = |v: &Vec2<f64>| Vec2::new(v.x as f32, v.y as f32);
                Cow::Owned(all.iter().map(narrow).collect())
            }
        }
    }
    fn kept(vertices: Vec<Vec2<f32>>) -> Vertices {
        Vertices::Single(vertices)
    }
}
impl Format for f64 {
    fn of(vertices: &Vertices) -> Cow<'_, [Vec2<f64>]> {
        match vertices {
            Vertices::Double(all) => Cow::Borrowed(all),
            Vertices::Single(all) => {
                let wide = |v: &Vec2<f32>| Vec2::new(f64::from(v.x), f64::from(v.y));
                Cow::Owned(all.iter().map(wide).collect())
            }
        }
    }
    fn kept(vertices: Vec<Vec2<f64>>) -> Vertices {
        Vertices::Double(vertices)
    }
}

/// The rings, parts and polygons of a column: where each starts among vertices, rings and parts; the last offset of each
/// list is the number of these.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    pub rings: Vec<usize>,
    pub parts: Vec<usize>,
    pub polygons: Vec<usize>,
    /// The number of vertices up to the end of each ring, from the first one of its polygon.
    ends: Vec<usize>,
}

impl Layout {
    /// Creates the layout of no polygons.
    pub fn empty() -> Self {
        Layout {
            rings: vec![0],
            parts: vec![0],
            polygons: vec![0],
            ends: Vec::new(),
        }
    }
    fn new(lists: [Vec<usize>; 3], vertices: usize) -> PyResult<Self> {
        let counts = [
            vertices,
            lists[0].len().max(1) - 1,
            lists[1].len().max(1) - 1,
        ];
        let names = ["rings", "parts", "polygons"];
        for ((list, count), name) in lists.iter().zip(counts).zip(names) {
            let refused =
                |why: String| Err(PyValueError::new_err(format!("offsets of {name}: {why}")));
            if list.first() != Some(&0) {
                return refused("the first one is 0".to_owned());
            }
            if let Some(k) = list.windows(2).position(|pair| pair[0] > pair[1]) {
                return refused(format!("offset {} is less than the one before", k + 1));
            }
            if list.last() != Some(&count) {
                return refused(format!(
                    "the last one is {count}, the number of what they divide"
                ));
            }
        }
        let [rings, parts, polygons] = lists;
        let mut made = Layout {
            rings,
            parts,
            polygons,
            ends: Vec::new(),
        };
        for item in 0..made.len() {
            let (first, own) = (made.vertices(item).start, made.rings(item));
            made.ends.extend(
                made.rings[own.start + 1..=own.end]
                    .iter()
                    .map(|end| end - first),
            );
        }
        Ok(made)
    }
    /// Returns the number of polygons.
    pub fn len(&self) -> usize {
        self.polygons.len() - 1
    }
    pub fn parts(&self, item: usize) -> Range<usize> {
        self.polygons[item]..self.polygons[item + 1]
    }
    pub fn rings(&self, item: usize) -> Range<usize> {
        let own = self.parts(item);
        self.parts[own.start]..self.parts[own.end]
    }
    pub fn vertices(&self, item: usize) -> Range<usize> {
        let own = self.rings(item);
        self.rings[own.start]..self.rings[own.end]
    }
    /// Returns the rings of a polygon.
    pub fn item<'a, T>(&'a self, vertices: &'a [Vec2<T>], item: usize) -> Rings<'a, T> {
        Rings::flat(&vertices[self.vertices(item)], &self.ends[self.rings(item)])
    }
    /// Adds a ring of so many vertices to the last part.
    pub fn add_ring(&mut self, vertices: usize) {
        let last = self.rings.last().copied().unwrap_or(0);
        self.rings.push(last + vertices);
    }
    /// Ends a part, if it has rings.
    pub fn end_part(&mut self) {
        let rings = self.rings.len() - 1;
        if self.parts.last() != Some(&rings) {
            self.parts.push(rings);
        }
    }
    /// Ends a polygon.
    pub fn end_polygon(&mut self) {
        self.polygons.push(self.parts.len() - 1);
        let own = self.rings(self.len() - 1);
        let first = self.rings[own.start];
        self.ends.extend(
            self.rings[own.start + 1..=own.end]
                .iter()
                .map(|end| end - first),
        );
    }
    /// Adds a polygon of another layout.
    pub fn add(&mut self, other: &Layout, item: usize) {
        for part in other.parts(item) {
            for ring in other.parts[part]..other.parts[part + 1] {
                self.add_ring(other.rings[ring + 1] - other.rings[ring]);
            }
            self.end_part();
        }
        self.end_polygon();
    }
    /// Adds all polygons of another layout.
    pub fn add_all(&mut self, other: &Layout) {
        let extend = |own: &mut Vec<usize>, more: &[usize]| {
            let before = own.last().copied().unwrap_or(0);
            own.extend(more[1..].iter().map(|&end| before + end));
        };
        extend(&mut self.rings, &other.rings);
        extend(&mut self.parts, &other.parts);
        extend(&mut self.polygons, &other.polygons);
        self.ends.extend_from_slice(&other.ends);
    }
}

/// A column of polygons, each of parts with holes.
#[pyclass(frozen, subclass, name = "Polygons", module = "geograd._core")]
pub struct Polygons {
    pub layout: Arc<Layout>,
    pub vertices: Arc<Vertices>,
    /// The arrays of vertices and offsets, made when they are first asked for.
    arrays: PyOnceLock<(Py<PyAny>, Py<PyAny>)>,
}

impl Polygons {
    pub fn of(layout: Arc<Layout>, vertices: Vertices) -> Self {
        Polygons {
            layout,
            vertices: Arc::new(vertices),
            arrays: PyOnceLock::new(),
        }
    }
    pub fn is_double(&self) -> bool {
        matches!(&*self.vertices, Vertices::Double(_))
    }
    /// Returns an error unless every coordinate is finite and every ring has three distinct vertices.
    fn check(&self) -> PyResult<()> {
        fn each<T: Format>(own: &Polygons) -> PyResult<()> {
            let vertices = T::of(&own.vertices);
            for item in 0..own.layout.len() {
                let rings = own.layout.item(&vertices, item);
                let refused = |flaw| PyValueError::new_err(format!("polygon {item}: {flaw}"));
                rings.validate().map_err(refused)?;
            }
            Ok(())
        }
        match self.is_double() {
            true => each::<f64>(self),
            false => each::<f32>(self),
        }
    }
    fn arrays(&self, py: Python<'_>) -> PyResult<&(Py<PyAny>, Py<PyAny>)> {
        self.arrays.get_or_try_init(py, || {
            let vertices = match &*self.vertices {
                Vertices::Single(all) => rows(py, all)?,
                Vertices::Double(all) => rows(py, all)?,
            };
            let lists = [
                &self.layout.rings,
                &self.layout.parts,
                &self.layout.polygons,
            ];
            let mut offsets = Vec::new();
            for list in lists {
                let own = PyArray1::from_iter(py, list.iter().map(|&x| x as i64)).into_any();
                own.call_method1("setflags", (false,))?;
                offsets.push(own);
            }
            vertices.call_method1("setflags", (false,))?;
            Ok((
                vertices.unbind(),
                PyTuple::new(py, offsets)?.into_any().unbind(),
            ))
        })
    }
    /// Returns a new column of some polygons, in their order.
    fn chosen(&self, items: &[usize]) -> Polygons {
        fn each<T: Format>(own: &Polygons, items: &[usize]) -> Polygons {
            let (all, mut vertices, mut layout) =
                (T::of(&own.vertices), Vec::new(), Layout::empty());
            for &item in items {
                vertices.extend_from_slice(&all[own.layout.vertices(item)]);
                layout.add(&own.layout, item);
            }
            Polygons::of(Arc::new(layout), T::kept(vertices))
        }
        match self.is_double() {
            true => each::<f64>(self, items),
            false => each::<f32>(self, items),
        }
    }
}

/// Returns vectors as an array of rows.
pub fn rows<'py, T: Number>(py: Python<'py>, all: &[Vec2<T>]) -> PyResult<Bound<'py, PyAny>> {
    reshaped(py, all.iter().map(|v| [v.x, v.y]).collect())
}

fn reshaped<T: Number>(py: Python<'_>, all: Vec<[T; 2]>) -> PyResult<Bound<'_, PyAny>> {
    let count = all.len();
    PyArray1::from_vec(py, all.into_flattened())
        .as_any()
        .call_method1("reshape", ((count, 2),))
}

/// Returns the vectors of an array of rows in a format.
pub fn vectors<T: Number>(array: &Bound<'_, PyAny>) -> PyResult<Vec<Vec2<T>>> {
    let array = array.cast::<PyArrayDyn<T>>()?.readonly();
    let numbers = array
        .as_slice()
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let (pairs, _) = numbers.as_chunks::<2>();
    Ok(pairs.iter().map(|&[x, y]| Vec2::new(x, y)).collect())
}

#[pymethods]
impl Polygons {
    #[new]
    #[pyo3(signature = (vertices, offsets=None))]
    fn new(
        py: Python<'_>,
        vertices: &Bound<'_, PyAny>,
        offsets: Option<[Bound<'_, PyAny>; 3]>,
    ) -> PyResult<Self> {
        let Some(lists) = offsets else {
            // Another object of the same column.
            let of = vertices.cast::<Polygons>()?.get();
            return Ok(Polygons {
                layout: of.layout.clone(),
                vertices: of.vertices.clone(),
                arrays: PyOnceLock::new(),
            });
        };
        let vertices = array(vertices, "vertices", crate::column::NUMBERS)?;
        if vertices.ndim() != 2 || vertices.shape()[1] != 2 {
            return Err(PyValueError::new_err(format!(
                "vertices: an array of shape (V, 2) is needed, not {:?}",
                vertices.shape()
            )));
        }
        let whole = py
            .import("numpy")?
            .call_method1("ascontiguousarray", (&vertices,))?;
        let kept = match vertices.dtype().itemsize() {
            4 => Vertices::Single(vectors(&whole)?),
            _ => Vertices::Double(vectors(&whole)?),
        };
        let [rings, parts, polygons] = &lists;
        let lists = [
            offsets_of(py, rings, "offsets of rings")?,
            offsets_of(py, parts, "offsets of parts")?,
            offsets_of(py, polygons, "offsets of polygons")?,
        ];
        let made = Polygons::of(Arc::new(Layout::new(lists, kept.len())?), kept);
        made.check()?;
        Ok(made)
    }
    /// The vertices of all rings, an array of shape (V, 2) that cannot be written.
    #[getter]
    fn vertices(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(self.arrays(py)?.0.clone_ref(py))
    }
    /// Returns where each ring starts among the vertices, each part among the rings, each polygon among the parts.
    #[getter]
    fn offsets(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(self.arrays(py)?.1.clone_ref(py))
    }
    /// The vertices with the first one of every ring again at its end, and where each ring starts among these.
    fn _closed<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        fn each<'py, T: Number>(
            py: Python<'py>,
            all: &[Vec2<T>],
            rings: &[usize],
        ) -> PyResult<Bound<'py, PyAny>> {
            let mut made: Vec<[T; 2]> = Vec::with_capacity(all.len() + rings.len());
            for ends in rings.windows(2) {
                let own = &all[ends[0]..ends[1]];
                made.extend(own.iter().chain(own.first()).map(|v| [v.x, v.y]));
            }
            reshaped(py, made)
        }
        let rings = &self.layout.rings;
        let vertices = match &*self.vertices {
            Vertices::Single(all) => each(py, all, rings)?,
            Vertices::Double(all) => each(py, all, rings)?,
        };
        let starts = rings
            .iter()
            .enumerate()
            .map(|(k, &start)| (start + k) as i64);
        Ok((vertices, PyArray1::from_iter(py, starts).into_any()))
    }
    fn __len__(&self) -> usize {
        self.layout.len()
    }
    fn __repr__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let own = slf.get();
        Ok(format!(
            "<{} {} of {} parts, {} rings, {} vertices>",
            slf.get_type().name()?,
            own.layout.len(),
            own.layout.parts.len() - 1,
            own.layout.rings.len() - 1,
            own.vertices.len()
        ))
    }
    /// The polygons of some places.
    fn _chosen(slf: &Bound<'_, Self>, items: Vec<usize>) -> PyResult<Polygons> {
        let own = slf.get();
        match items.iter().find(|&&item| item >= own.layout.len()) {
            None => Ok(own.chosen(&items)),
            Some(item) => Err(PyIndexError::new_err(format!(
                "polygon {item} of {}",
                own.layout.len()
            ))),
        }
    }
    /// The same rings with other vertices.
    fn _with_vertices(&self, vertices: &Bound<'_, PyAny>) -> PyResult<Polygons> {
        let vertices = match vertices.cast::<PyArrayDyn<f32>>().is_ok() {
            true => Vertices::Single(vectors(vertices)?),
            false => Vertices::Double(vectors(vertices)?),
        };
        if vertices.len() != self.vertices.len() {
            return Err(PyValueError::new_err(format!(
                "vertices: {} are needed, not {}",
                self.vertices.len(),
                vertices.len()
            )));
        }
        let made = Polygons::of(self.layout.clone(), vertices);
        made.check()?;
        Ok(made)
    }
    /// Says whether each polygon has the rings of that of another column, vertex by vertex.
    fn _equal(&self, other: &Polygons) -> Vec<bool> {
        let (own, others) = (f64::of(&self.vertices), f64::of(&other.vertices));
        let equal = |item: usize| {
            let part_ends = |of: &Layout| -> Vec<usize> {
                let parts = of.parts(item);
                let first = of.parts[parts.start];
                of.parts[parts.start + 1..=parts.end]
                    .iter()
                    .map(|end| end - first)
                    .collect()
            };
            self.layout.ends[self.layout.rings(item)] == other.layout.ends[other.layout.rings(item)]
                && part_ends(&self.layout) == part_ends(&other.layout)
                && own[self.layout.vertices(item)] == others[other.layout.vertices(item)]
        };
        (0..self.layout.len().min(other.layout.len()))
            .map(equal)
            .collect()
    }
}

/// The polygons of several columns one after the other.
#[pyfunction]
pub fn joined_polygons(all: Vec<PyRef<'_, Polygons>>) -> Polygons {
    fn each<T: Format>(all: &[PyRef<'_, Polygons>]) -> Polygons {
        let (mut vertices, mut layout) = (Vec::new(), Layout::empty());
        for own in all {
            vertices.extend_from_slice(&T::of(&own.vertices));
            layout.add_all(&own.layout);
        }
        Polygons::of(Arc::new(layout), T::kept(vertices))
    }
    match all.is_empty() || all.iter().any(|own| own.is_double()) {
        true => each::<f64>(&all),
        false => each::<f32>(&all),
    }
}

/// Returns `true` for a ring that has three distinct vertices.
pub fn is_ring<T: Scalar<Mask = bool>>(vertices: &[Vec2<T>]) -> bool {
    Rings::from(vertices).validate().is_ok()
}
