//! Measures, overlaps and distances of polygons, item by item, on all cores.
use crate::lent::array_of;
use crate::polygons::{Format, Polygons, rows};
use crate::threads::{FEW, get_num_threads, on_threads};
use geograd::ad::adjoint::{overlap_rings, polygon as adjoint};
use geograd::kernels::dynamic::Interruption;
use geograd::overlap_polygon::holed;
use geograd::polygon::{self, Fill, Rings};
use geograd::{Aabb2, Vec2, ring};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

type Object<'py> = Bound<'py, PyAny>;

/// The most runs of items into which a call is divided. Their sums are added in order, so that results do not depend on
/// the number of threads.
const RUNS: usize = 256;

/// Returns the results of runs of items, in order. `work` is about how many numbers they read.
pub fn in_runs<R: Send>(
    py: Python<'_>,
    count: usize,
    work: usize,
    run: impl Fn(Range<usize>) -> R + Send + Sync,
) -> PyResult<Vec<R>> {
    in_watched_runs(py, count, work, |own, _| run(own))
}

/// As [`in_runs`], for items that take long: a run stops early once it may.
pub fn in_watched_runs<R: Send>(
    py: Python<'_>,
    count: usize,
    work: usize,
    run: impl Fn(Range<usize>, &Interruption) -> R + Send + Sync,
) -> PyResult<Vec<R>> {
    let size = count.div_ceil(RUNS).max(16);
    // Every run has its place, so that threads are compiled once for all kinds of results.
    let found: Vec<Mutex<Option<R>>> = (0..count.div_ceil(size))
        .map(|_| Mutex::new(None))
        .collect();
    each_run(py, found.len(), work.max(count), &|k, interruption| {
        let own = k * size..((k + 1) * size).min(count);
        *found[k].lock().unwrap_or_else(PoisonError::into_inner) = Some(run(own, interruption));
    })?;
    let found = found.into_iter();
    Ok(found
        .filter_map(|own| own.into_inner().unwrap_or_else(PoisonError::into_inner))
        .collect())
}

/// Calls a function with the place of every run on all threads, until an interruption.
fn each_run(
    py: Python<'_>,
    runs: usize,
    work: usize,
    run: &(dyn Fn(usize, &Interruption) + Sync),
) -> PyResult<()> {
    let alone = get_num_threads()? == 1 || work <= FEW;
    on_threads(py, work, || {
        let interruption = Interruption::current();
        let of = |k: usize| {
            if !interruption.is_due() {
                run(k, &interruption);
            }
        };
        match alone {
            true => (0..runs).for_each(of),
            false => (0..runs).into_par_iter().for_each(of),
        }
    })
}

/// Returns the numbers that runs of items append, in order. Few items are one run.
pub fn listed<R: Copy + Send>(
    py: Python<'_>,
    count: usize,
    work: usize,
    run: impl Fn(Range<usize>, &mut Vec<R>) + Send + Sync,
) -> PyResult<Vec<R>> {
    let of = |own: Range<usize>| {
        let mut found = Vec::with_capacity(own.len());
        run(own, &mut found);
        found
    };
    match work.max(count) <= FEW {
        true => on_threads(py, work.max(count), || of(0..count)),
        false => Ok(in_runs(py, count, work, of)?.concat()),
    }
}

/// Returns the number of items of two columns, of which one item may stand for all.
pub fn together(a: (&str, usize), b: (&str, usize)) -> PyResult<usize> {
    match (a.1, b.1) {
        (a, b) if a == b => Ok(a),
        (1, n) | (n, 1) => Ok(n),
        (n, m) => Err(PyValueError::new_err(format!(
            "`{}` has {m} rows where {n} are needed, or one, as many as `{}`",
            b.0, a.0
        ))),
    }
}

/// Reads a fill rule.
pub fn fill(name: &str) -> PyResult<Fill> {
    match name {
        "even_odd" => Ok(Fill::EvenOdd),
        "nonzero" => Ok(Fill::NonZero),
        other => Err(PyValueError::new_err(format!(
            "fill: \"even_odd\" or \"nonzero\" is needed, not {other:?}"
        ))),
    }
}

/// The item of a column that takes part in item `i` of a result.
pub fn place(count: usize, i: usize) -> usize {
    if count == 1 { 0 } else { i }
}

/// Derivatives by the vertices of a column: of a run of polygons, or of one that stands for all.
pub struct Bars<T> {
    all: Vec<Vec2<T>>,
    /// The vertex that comes first.
    first: usize,
    is_one: bool,
    scratch: Vec<Vec2<T>>,
}

impl<T: Format> Bars<T> {
    pub fn new(of: &Polygons, run: &Range<usize>) -> Self {
        let (is_one, layout) = (of.layout.len() == 1, &of.layout);
        let own = match (is_one, run.is_empty()) {
            (true, _) => layout.vertices(0),
            (_, true) => 0..0,
            _ => layout.vertices(run.start).start..layout.vertices(run.end - 1).end,
        };
        Bars {
            all: vec![Vec2::zero(); own.len()],
            first: own.start,
            is_one,
            scratch: vec![Vec2::zero(); if is_one { own.len() } else { 0 }],
        }
    }
    /// The place to which the derivatives of a polygon are written.
    pub fn written(&mut self, of: &Polygons, item: usize) -> &mut [Vec2<T>] {
        if self.is_one {
            return &mut self.scratch;
        }
        let own = of.layout.vertices(item);
        &mut self.all[own.start - self.first..own.end - self.first]
    }
    /// The place to which the derivatives of a polygon are added, those of one that stands for all, too.
    pub fn added(&mut self, of: &Polygons, item: usize) -> &mut [Vec2<T>] {
        let own = of.layout.vertices(item);
        &mut self.all[own.start - self.first..own.end - self.first]
    }
    /// Adds what was written to the sum of one that stands for all.
    pub fn add(&mut self) {
        for (sum, bar) in self.all.iter_mut().zip(&self.scratch) {
            *sum += *bar;
        }
    }
    /// The derivatives of all runs together.
    pub fn joined(of: &Polygons, runs: Vec<Bars<T>>) -> Vec<Vec2<T>> {
        let mut all: Vec<Vec2<T>> = Vec::new();
        if runs.is_empty() && of.layout.len() == 1 {
            all.resize(of.vertices.len(), Vec2::zero());
        }
        for run in runs {
            if run.is_one && !all.is_empty() {
                for (sum, bar) in all.iter_mut().zip(run.all) {
                    *sum += bar;
                }
            } else {
                all.extend(run.all);
            }
        }
        all
    }
}

pub fn numbers<T: Format>(x: &Object<'_>) -> PyResult<Vec<T>> {
    let array = x.cast::<PyArrayDyn<T>>()?.readonly();
    let failed = |error: numpy::AsSliceError| PyValueError::new_err(error.to_string());
    Ok(array.as_slice().map_err(failed)?.to_vec())
}

/// Runs a function in the format of polygons.
macro_rules! in_format {
    ($is_double:expr, $run:ident($($argument:expr),*)) => {
        match $is_double {
            true => $run::<f64>($($argument),*),
            false => $run::<f32>($($argument),*),
        }
    };
}
pub(crate) use in_format;

fn unknown(name: &str) -> PyErr {
    PyKeyError::new_err(name.to_owned())
}

/// A measure of polygons: its values, or with cotangents of these those of the vertices.
#[pyfunction]
#[pyo3(signature = (name, polygons, upstream=None))]
pub fn polygon_measure<'py>(
    py: Python<'py>,
    name: &str,
    polygons: &Polygons,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    in_format!(polygons.is_double(), measured(py, name, polygons, upstream))
}

fn measured<'py, T: Format>(
    py: Python<'py>,
    name: &str,
    own: &Polygons,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    #[derive(Clone, Copy)]
    enum Measure {
        Area,
        Perimeter,
        Centroid,
    }
    let measure = match name {
        "area" => Measure::Area,
        "perimeter" | "length" => Measure::Perimeter,
        "centroid" => Measure::Centroid,
        other => return Err(unknown(other)),
    };
    let vertices = T::of(&own.vertices);
    let (count, work) = (own.layout.len(), vertices.len());
    let Some(upstream) = upstream else {
        let values = listed(py, count, work, |run, values| {
            for rings in run.map(|item| own.layout.item(&vertices, item)) {
                match measure {
                    // One ring needs no decision about holes.
                    Measure::Area if rings.count() == 1 => {
                        values.push(ring::signed_area(rings.ring(0)).magnitude());
                    }
                    Measure::Area => values.push(polygon::area(rings)),
                    Measure::Perimeter => values.push(polygon::perimeter(rings)),
                    Measure::Centroid => {
                        let at = polygon::centroid(rings);
                        values.extend([at.x, at.y]);
                    }
                }
            }
        })?;
        let values = array_of(py, values);
        return match measure {
            Measure::Centroid => Ok(values.reshape([count, 2])?.into_any()),
            _ => Ok(values.into_any()),
        };
    };
    let upstream = numbers::<T>(upstream)?;
    let runs = in_runs(py, count, work, |run| {
        let mut bars = Bars::<T>::new(own, &run);
        for item in run {
            // One polygon is one item here, and stands for no other.
            let (rings, into) = (own.layout.item(&vertices, item), bars.added(own, item));
            match measure {
                Measure::Area => adjoint::area_vjp(rings, upstream[item], into),
                Measure::Perimeter => adjoint::perimeter_vjp(rings, upstream[item], into),
                Measure::Centroid => {
                    let bar = Vec2::new(upstream[2 * item], upstream[2 * item + 1]);
                    adjoint::centroid_vjp(rings, bar, into);
                }
            }
        }
        bars
    })?;
    rows(py, &Bars::joined(own, runs))
}

/// A function of the areas of two polygons.
#[derive(Clone, Copy)]
enum Overlap {
    Intersection,
    Union,
    Iou,
    Iof,
}

impl Overlap {
    fn named(name: &str) -> PyResult<Self> {
        Ok(match name {
            "intersection_area" => Overlap::Intersection,
            "union_area" => Overlap::Union,
            "iou" => Overlap::Iou,
            "iof" => Overlap::Iof,
            other => return Err(unknown(other)),
        })
    }
    fn value<T: Format>(self, a: Rings<'_, T>, b: Rings<'_, T>) -> T {
        match self {
            Overlap::Intersection => holed::intersection_area(a, b),
            Overlap::Union => holed::union_area(a, b),
            Overlap::Iou => holed::iou(a, b),
            Overlap::Iof => holed::iof(a, b),
        }
    }
    fn vjp<T: Format>(
        self,
        a: Rings<'_, T>,
        b: Rings<'_, T>,
        out_bar: T,
        a_bar: &mut [Vec2<T>],
        b_bar: &mut [Vec2<T>],
    ) -> T {
        match self {
            Overlap::Intersection => {
                overlap_rings::intersection_area_vjp(a, b, out_bar, a_bar, b_bar)
            }
            Overlap::Union => overlap_rings::union_area_vjp(a, b, out_bar, a_bar, b_bar),
            Overlap::Iou => overlap_rings::iou_vjp(a, b, out_bar, a_bar, b_bar),
            Overlap::Iof => overlap_rings::iof_vjp(a, b, out_bar, a_bar, b_bar),
        }
    }
}

/// A function of two polygons: its values, and with cotangents of these those of both columns of vertices.
#[pyfunction]
#[pyo3(signature = (name, a, b, upstream=None))]
pub fn polygon_overlap<'py>(
    py: Python<'py>,
    name: &str,
    a: &Polygons,
    b: &Polygons,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let is_double = a.is_double() || b.is_double();
    in_format!(
        is_double,
        overlapped(py, Overlap::named(name)?, a, b, upstream)
    )
}

fn overlapped<'py, T: Format>(
    py: Python<'py>,
    overlap: Overlap,
    a: &Polygons,
    b: &Polygons,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let (vertices_a, vertices_b) = (T::of(&a.vertices), T::of(&b.vertices));
    let (count_a, count_b) = (a.layout.len(), b.layout.len());
    let count = together(("a", count_a), ("b", count_b))?;
    let pair = |i: usize| {
        (
            a.layout.item(&vertices_a, place(count_a, i)),
            b.layout.item(&vertices_b, place(count_b, i)),
        )
    };
    let work = 8 * (vertices_a.len().max(count) + vertices_b.len().max(count));
    let Some(upstream) = upstream else {
        let values = listed(py, count, work, |run, values| {
            values.extend(run.map(pair).map(|(a, b)| overlap.value(a, b)));
        })?;
        return Ok(array_of(py, values).into_any());
    };
    let upstream = numbers::<T>(upstream)?;
    let runs = in_runs(py, count, work, |run| {
        let (mut a_bars, mut b_bars) = (Bars::<T>::new(a, &run), Bars::<T>::new(b, &run));
        let mut values = Vec::with_capacity(run.len());
        for i in run {
            let (of_a, of_b) = pair(i);
            let (into_a, into_b) = (
                a_bars.written(a, place(count_a, i)),
                b_bars.written(b, place(count_b, i)),
            );
            values.push(overlap.vjp(of_a, of_b, upstream[i], into_a, into_b));
            a_bars.add();
            b_bars.add();
        }
        (values, a_bars, b_bars)
    })?;
    let (mut values, mut a_bars, mut b_bars) = (Vec::new(), Vec::new(), Vec::new());
    for (own, a_bar, b_bar) in runs {
        values.extend(own);
        a_bars.push(a_bar);
        b_bars.push(b_bar);
    }
    let bars = (
        rows(py, &Bars::joined(a, a_bars))?,
        rows(py, &Bars::joined(b, b_bars))?,
    );
    Ok((PyArray1::from_vec(py, values), bars)
        .into_pyobject(py)?
        .into_any())
}

/// A function of all pairs of two columns: one number after the other, row by row.
#[pyfunction]
pub fn polygon_pairs<'py>(
    py: Python<'py>,
    name: &str,
    a: &Polygons,
    b: &Polygons,
) -> PyResult<Object<'py>> {
    let is_double = a.is_double() || b.is_double();
    in_format!(is_double, of_pairs(py, Overlap::named(name)?, a, b))
}

fn of_pairs<'py, T: Format>(
    py: Python<'py>,
    overlap: Overlap,
    a: &Polygons,
    b: &Polygons,
) -> PyResult<Object<'py>> {
    let (vertices_a, vertices_b) = (T::of(&a.vertices), T::of(&b.vertices));
    let columns = b.layout.len();
    let bounds: Vec<Option<Aabb2<T>>> = (0..columns)
        .map(|k| b.layout.item(&vertices_b, k).bounding())
        .collect();
    let work = a.layout.len().saturating_mul(columns).saturating_mul(8);
    let runs = in_runs(py, a.layout.len(), work, |run| {
        let mut values = Vec::with_capacity(run.len() * columns);
        for row in run {
            let of_a = a.layout.item(&vertices_a, row);
            let own = of_a.bounding();
            for (k, other) in bounds.iter().enumerate() {
                let are_apart = match (&own, other) {
                    (Some(p), Some(q)) => {
                        p.max.x < q.min.x
                            || q.max.x < p.min.x
                            || p.max.y < q.min.y
                            || q.max.y < p.min.y
                    }
                    _ => true,
                };
                // Polygons that are apart share nothing.
                values.push(match (overlap, are_apart) {
                    (Overlap::Union, _) | (_, false) => {
                        overlap.value(of_a, b.layout.item(&vertices_b, k))
                    }
                    _ => T::narrowed(0.0),
                });
            }
        }
        values
    })?;
    let shape = (a.layout.len(), columns);
    PyArray1::from_vec(py, runs.concat())
        .as_any()
        .call_method1("reshape", (shape,))
}
