//! Boolean operations and Minkowski sums of polygons, item by item, on all cores.
use crate::polygon_calls::{Bars, fill, in_format, in_runs, place, together};
use crate::polygons::{Format, Layout, Polygons, is_ring, rows, vectors};
use crate::raised;
use geograd::Error;
use geograd::Vec2;
use geograd::ad::adjoint::boolean::{overlay_vjp, valid_vjp};
use geograd::ad::adjoint::minkowski::{minkowski_vjp, valid_minkowski_vjp};
use geograd::boolean::{
    BooleanOperation, OverlayTrace, ValidTrace, overlay_replay, overlay_search, valid_replay,
    valid_search,
};
use geograd::minkowski::{
    MinkowskiTrace, ValidMinkowskiTrace, minkowski_replay, minkowski_search, no_fit_search,
    valid_minkowski_replay, valid_minkowski_search, valid_no_fit_search,
};
use geograd::polygon::{Fill, Polygon, Rings};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::ops::Range;
use std::sync::Arc;

type Object<'py> = Bound<'py, PyAny>;

/// The record of one item.
enum Trace {
    Plain(OverlayTrace),
    Valid(ValidTrace),
    Sum(MinkowskiTrace),
    ValidSum(ValidMinkowskiTrace),
}

/// A function of two polygons that gives one.
#[derive(Clone, Copy)]
enum Operation {
    Boolean(BooleanOperation),
    /// The Minkowski sum.
    Sum,
    /// The sum with the second one mirrored.
    NoFit,
}

/// A result and its record.
struct Item<T> {
    vertices: Vec<Vec2<T>>,
    layout: Layout,
    trace: Trace,
    /// The vertices of the record that the result has.
    kept: Vec<Range<usize>>,
}

impl<T: Format> Item<T> {
    fn new(trace: Trace) -> Self {
        Item {
            vertices: Vec::new(),
            layout: Layout::empty(),
            trace,
            kept: Vec::new(),
        }
    }
    /// Adds a part without its rings of fewer than three distinct vertices, which have no area. `start` is the number of
    /// vertices of the record before it.
    fn add_part<'r>(&mut self, rings: impl Iterator<Item = &'r [Vec2<T>]>, start: &mut usize) {
        let mut is_solid = true;
        for (k, ring) in rings.enumerate() {
            let is_kept = is_solid && is_ring(ring);
            // The first ring bounds the part: without it there are no holes.
            is_solid &= is_kept || k > 0;
            if is_kept {
                self.vertices.extend_from_slice(ring);
                self.layout.add_ring(ring.len());
                self.kept.push(*start..*start + ring.len());
            }
            *start += ring.len();
        }
        self.layout.end_part();
    }
    /// Adds the parts of a valid result.
    fn add_valid(&mut self, parts: &[Polygon<T>]) {
        let mut start = 0;
        for part in parts {
            self.add_part(part.rings().iter(), &mut start);
        }
    }
    /// Adds the parts of a result, each by the numbers of its rings.
    fn add_plain(&mut self, shape: &Polygon<T>, parts: impl Iterator<Item = Range<usize>>) {
        let mut start = 0;
        for part in parts {
            self.add_part(part.map(|ring| shape.ring(ring)), &mut start);
        }
    }
    fn of(
        a: Rings<'_, T>,
        b: Rings<'_, T>,
        operation: Operation,
        fill: Fill,
        is_valid: bool,
    ) -> Result<Self, Error> {
        let mut made = Item::new(Trace::Plain(OverlayTrace::default()));
        made.trace = match (operation, is_valid) {
            (Operation::Boolean(operation), true) => {
                let trace = valid_search(a, b, operation, fill)?;
                made.add_valid(&valid_replay(a, b, &trace));
                Trace::Valid(trace)
            }
            (Operation::Boolean(operation), false) => {
                let trace = overlay_search(a, b, operation, fill)?;
                made.add_plain(&overlay_replay(a, b, &trace), trace.parts());
                Trace::Plain(trace)
            }
            (Operation::Sum | Operation::NoFit, true) => {
                let search = match operation {
                    Operation::Sum => valid_minkowski_search::<T>,
                    _ => valid_no_fit_search::<T>,
                };
                let trace = search(a, b, fill)?;
                made.add_valid(&valid_minkowski_replay(a, b, &trace));
                Trace::ValidSum(trace)
            }
            (Operation::Sum | Operation::NoFit, false) => {
                let search = match operation {
                    Operation::Sum => minkowski_search::<T>,
                    _ => no_fit_search::<T>,
                };
                let trace = search(a, b, fill)?;
                made.add_plain(&minkowski_replay(a, b, &trace), trace.parts());
                Trace::Sum(trace)
            }
        };
        made.layout.end_polygon();
        Ok(made)
    }
}

/// The decisions of a boolean operation of two columns: the origin of every vertex of the results.
#[pyclass(frozen, module = "geograd._core")]
pub struct Overlay {
    a: Py<Polygons>,
    b: Py<Polygons>,
    items: Vec<(Trace, Vec<Range<usize>>)>,
    /// The number of vertices up to the start of each result, and of all.
    firsts: Vec<usize>,
    is_double: bool,
}

fn operation(name: &str) -> PyResult<Operation> {
    Ok(match name {
        "union" => Operation::Boolean(BooleanOperation::Union),
        "intersection" => Operation::Boolean(BooleanOperation::Intersection),
        "difference" => Operation::Boolean(BooleanOperation::Difference),
        "symmetric_difference" => Operation::Boolean(BooleanOperation::SymmetricDifference),
        "minkowski_sum" => Operation::Sum,
        "no_fit_polygon" => Operation::NoFit,
        other => {
            return Err(PyValueError::new_err(format!(
                "no operation is called {other:?}"
            )));
        }
    })
}

/// A boolean operation of two columns: the results and the record of its decisions.
#[pyfunction]
pub fn polygon_overlay(
    py: Python<'_>,
    name: &str,
    a: Bound<'_, Polygons>,
    b: Bound<'_, Polygons>,
    rule: &str,
    is_valid: bool,
) -> PyResult<(Polygons, Overlay)> {
    let rules = (operation(name)?, fill(rule)?, is_valid);
    let is_double = a.get().is_double() || b.get().is_double();
    in_format!(is_double, overlaid(py, rules, a, b))
}

fn overlaid<T: Format>(
    py: Python<'_>,
    (operation, fill, is_valid): (Operation, Fill, bool),
    a: Bound<'_, Polygons>,
    b: Bound<'_, Polygons>,
) -> PyResult<(Polygons, Overlay)> {
    let (own_a, own_b) = (a.get(), b.get());
    let (vertices_a, vertices_b) = (T::of(&own_a.vertices), T::of(&own_b.vertices));
    let (count_a, count_b) = (own_a.layout.len(), own_b.layout.len());
    let count = together(("a", count_a), ("b", count_b))?;
    let work = 64 * (vertices_a.len().max(count) + vertices_b.len().max(count));
    let runs = in_runs(py, count, work, |run| {
        let made = run.map(|i| {
            let of_a = own_a.layout.item(&vertices_a, place(count_a, i));
            let of_b = own_b.layout.item(&vertices_b, place(count_b, i));
            Item::<T>::of(of_a, of_b, operation, fill, is_valid)
        });
        made.collect::<Result<Vec<_>, Error>>()
    })?;
    let (mut vertices, mut layout) = (Vec::new(), Layout::empty());
    let (mut items, mut firsts) = (Vec::with_capacity(count), vec![0]);
    for run in runs {
        for item in run.map_err(raised)? {
            vertices.extend(item.vertices);
            layout.add(&item.layout, 0);
            items.push((item.trace, item.kept));
            firsts.push(vertices.len());
        }
    }
    let made = Polygons::of(Arc::new(layout), T::kept(vertices));
    let record = Overlay {
        a: a.unbind(),
        b: b.unbind(),
        items,
        firsts,
        is_double: T::IS_DOUBLE,
    };
    Ok((made, record))
}

#[pymethods]
impl Overlay {
    /// The cotangents of the vertices of both columns from those of the vertices of the results.
    fn vjp<'py>(&self, py: Python<'py>, upstream: &Object<'py>) -> PyResult<Object<'py>> {
        in_format!(self.is_double, pulled(py, self, upstream))
    }
}

fn pulled<'py, T: Format>(
    py: Python<'py>,
    record: &Overlay,
    upstream: &Object<'py>,
) -> PyResult<Object<'py>> {
    let upstream = vectors::<T>(upstream)?;
    let wanted = record.firsts.last().copied().unwrap_or(0);
    if upstream.len() != wanted {
        return Err(PyValueError::new_err(format!(
            "upstream: cotangents of {wanted} vertices are needed, not of {}",
            upstream.len()
        )));
    }
    let (a, b) = (record.a.get(), record.b.get());
    let (vertices_a, vertices_b) = (T::of(&a.vertices), T::of(&b.vertices));
    let (count_a, count_b) = (a.layout.len(), b.layout.len());
    let work = 8 * (vertices_a.len() + vertices_b.len());
    let runs = in_runs(py, record.items.len(), work, |run| {
        let (mut a_bars, mut b_bars) = (Bars::<T>::new(a, &run), Bars::<T>::new(b, &run));
        let mut bars = Vec::new();
        for i in run {
            let (trace, kept) = &record.items[i];
            let vertices = match trace {
                Trace::Plain(trace) => trace.vertex_count(),
                Trace::Valid(trace) => trace.vertex_count(),
                Trace::Sum(trace) => trace.vertex_count(),
                Trace::ValidSum(trace) => trace.vertex_count(),
            };
            bars.clear();
            bars.resize(vertices, Vec2::zero());
            let mut own = &upstream[record.firsts[i]..record.firsts[i + 1]];
            for range in kept {
                let (these, others) = own.split_at(range.len());
                bars[range.clone()].copy_from_slice(these);
                own = others;
            }
            let (item_a, item_b) = (place(count_a, i), place(count_b, i));
            let of_a = a.layout.item(&vertices_a, item_a);
            let of_b = b.layout.item(&vertices_b, item_b);
            let (into_a, into_b) = (a_bars.written(a, item_a), b_bars.written(b, item_b));
            match trace {
                Trace::Plain(trace) => overlay_vjp(of_a, of_b, trace, &bars, into_a, into_b),
                Trace::Valid(trace) => valid_vjp(of_a, of_b, trace, &bars, into_a, into_b),
                Trace::Sum(trace) => minkowski_vjp(of_a, of_b, trace, &bars, into_a, into_b),
                Trace::ValidSum(trace) => {
                    valid_minkowski_vjp(of_a, of_b, trace, &bars, into_a, into_b);
                }
            }
            a_bars.add();
            b_bars.add();
        }
        (a_bars, b_bars)
    })?;
    let (a_bars, b_bars): (Vec<_>, Vec<_>) = runs.into_iter().unzip();
    let both = (
        rows(py, &Bars::joined(a, a_bars))?,
        rows(py, &Bars::joined(b, b_bars))?,
    );
    Ok(both.into_pyobject(py)?.into_any())
}

/// The union of all polygons of a column, by the non-zero rule over rings that all enclose what is theirs.
#[pyfunction]
pub fn polygon_union_all(
    py: Python<'_>,
    polygons: &Polygons,
    is_valid: bool,
) -> PyResult<Polygons> {
    in_format!(polygons.is_double(), united(py, polygons, is_valid))
}

fn united<T: Format>(py: Python<'_>, own: &Polygons, is_valid: bool) -> PyResult<Polygons> {
    let vertices = T::of(&own.vertices);
    let item = py.detach(|| {
        let mut all = geograd::Polygon::new();
        for item in 0..own.layout.len() {
            let rings = own.layout.item(&vertices, item);
            let sides = geograd::polygon::Sides::decided(rings);
            for (k, ring) in rings.iter().enumerate() {
                match sides.is_turned(k) {
                    true => all.push(ring.iter().rev().copied()),
                    false => all.push(ring.iter().copied()),
                }
            }
        }
        let nothing = Rings::flat(&[], &[]);
        Item::<T>::of(
            all.rings(),
            nothing,
            Operation::Boolean(BooleanOperation::Union),
            Fill::NonZero,
            is_valid,
        )
    });
    let item = item.map_err(raised)?;
    Ok(Polygons::of(Arc::new(item.layout), T::kept(item.vertices)))
}
