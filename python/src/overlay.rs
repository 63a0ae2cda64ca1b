//! Boolean operations and Minkowski sums of polygons, item by item, on all cores.
use crate::polygon_calls::{Bars, fill, in_format, in_runs, place, together};
use crate::polygons::{Format, Polygons, rows, vectors};
use crate::raised;
use crate::results::{Records, Results};
use geograd::Error;
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
use geograd::polygon::{Fill, Rings};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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

impl Trace {
    fn vertex_count(&self) -> usize {
        match self {
            Trace::Plain(trace) => trace.vertex_count(),
            Trace::Valid(trace) => trace.vertex_count(),
            Trace::Sum(trace) => trace.vertex_count(),
            Trace::ValidSum(trace) => trace.vertex_count(),
        }
    }
}

/// Adds the result of two items.
fn add<T: Format>(
    all: &mut Results<T, Trace>,
    [a, b]: [Rings<'_, T>; 2],
    (operation, fill, is_valid): (Operation, Fill, bool),
) -> Result<(), Error> {
    let trace = match (operation, is_valid) {
        (Operation::Boolean(operation), true) => {
            let trace = valid_search(a, b, operation, fill)?;
            all.add_valid(&valid_replay(a, b, &trace));
            Trace::Valid(trace)
        }
        (Operation::Boolean(operation), false) => {
            let trace = overlay_search(a, b, operation, fill)?;
            all.add_plain(&overlay_replay(a, b, &trace), trace.parts());
            Trace::Plain(trace)
        }
        (Operation::Sum | Operation::NoFit, true) => {
            let search = match operation {
                Operation::Sum => valid_minkowski_search::<T>,
                _ => valid_no_fit_search::<T>,
            };
            let trace = search(a, b, fill)?;
            all.add_valid(&valid_minkowski_replay(a, b, &trace));
            Trace::ValidSum(trace)
        }
        (Operation::Sum | Operation::NoFit, false) => {
            let search = match operation {
                Operation::Sum => minkowski_search::<T>,
                _ => no_fit_search::<T>,
            };
            let trace = search(a, b, fill)?;
            all.add_plain(&minkowski_replay(a, b, &trace), trace.parts());
            Trace::Sum(trace)
        }
    };
    all.end(trace);
    Ok(())
}

/// The decisions of a boolean operation of two columns: the origin of every vertex of the results.
#[pyclass(frozen, module = "geograd._core")]
pub struct Overlay {
    a: Py<Polygons>,
    b: Py<Polygons>,
    records: Records<Trace>,
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

/// A boolean operation of two columns: the results and, if it is kept, the record of its decisions.
#[pyfunction]
pub fn polygon_overlay(
    py: Python<'_>,
    name: &str,
    a: Bound<'_, Polygons>,
    b: Bound<'_, Polygons>,
    rule: &str,
    is_valid: bool,
    is_kept: bool,
) -> PyResult<(Polygons, Option<Overlay>)> {
    let rules = (operation(name)?, fill(rule)?, is_valid);
    let is_double = a.get().is_double() || b.get().is_double();
    in_format!(is_double, overlaid(py, rules, is_kept, a, b))
}

fn overlaid<T: Format>(
    py: Python<'_>,
    rules: (Operation, Fill, bool),
    is_kept: bool,
    a: Bound<'_, Polygons>,
    b: Bound<'_, Polygons>,
) -> PyResult<(Polygons, Option<Overlay>)> {
    let (own_a, own_b) = (a.get(), b.get());
    let (vertices_a, vertices_b) = (T::of(&own_a.vertices), T::of(&own_b.vertices));
    let (count_a, count_b) = (own_a.layout.len(), own_b.layout.len());
    let count = together(("a", count_a), ("b", count_b))?;
    let work = 64 * (vertices_a.len().max(count) + vertices_b.len().max(count));
    let runs = in_runs(py, count, work, |run| {
        let mut all = Results::new(is_kept);
        for i in run {
            let of_a = own_a.layout.item(&vertices_a, place(count_a, i));
            let of_b = own_b.layout.item(&vertices_b, place(count_b, i));
            add::<T>(&mut all, [of_a, of_b], rules)?;
        }
        Ok(all)
    })?;
    let mut all = Results::new(is_kept);
    for run in runs {
        all.add(run.map_err(raised)?);
    }
    let (made, records) = all.column();
    let record = records.map(|records| Overlay {
        a: a.unbind(),
        b: b.unbind(),
        records,
        is_double: T::IS_DOUBLE,
    });
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
    let wanted = record.records.vertex_count();
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
    let runs = in_runs(py, record.records.len(), work, |run| {
        let (mut a_bars, mut b_bars) = (Bars::<T>::new(a, &run), Bars::<T>::new(b, &run));
        let mut bars = Vec::new();
        for i in run {
            let records = &record.records;
            let trace = records.bars(i, &upstream, Trace::vertex_count, &mut bars);
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
    let made = py.detach(|| {
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
        let rules = (
            Operation::Boolean(BooleanOperation::Union),
            Fill::NonZero,
            is_valid,
        );
        let mut made = Results::new(false);
        add::<T>(&mut made, [all.rings(), nothing], rules).map(|()| made.column().0)
    });
    made.map_err(raised)
}
