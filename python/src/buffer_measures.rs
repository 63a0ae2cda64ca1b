//! Areas and perimeters of offsets with exact arcs, item by item, on all cores.
use crate::buffered::{Source, at};
use crate::polygon_calls::{fill, in_format, in_runs, numbers};
use crate::polygons::{Format, Vertices, rows, vectors};
use crate::raised;
use geograd::ad::adjoint::round_offset::round_offset_vjp;
use geograd::offset::{
    OffsetMeasures, OffsetStyle, RoundOffsetTrace, round_offset_replay, round_offset_search,
    round_path_offset_search,
};
use geograd::polygon::Rings;
use geograd::{Error, Jet, Vec2};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// Derivatives along a direction of the vertices and of the distances: of areas, of perimeters, and of the cotangents that
/// `polygon_buffer_measures` gives for those of areas and perimeters.
#[pyfunction]
pub fn polygon_buffer_measures_along<'py>(
    py: Python<'py>,
    column: &Object<'py>,
    starts: Option<Vec<usize>>,
    distances: Vec<f64>,
    rule: &str,
    upstream: [Object<'py>; 2],
    direction: [Object<'py>; 2],
) -> PyResult<Object<'py>> {
    let style = style(rule)?;
    let source = Source::of(column, starts)?;
    let is_double = matches!(source.vertices(), Vertices::Double(_));
    in_format!(
        is_double,
        turned(py, &source, &distances, &style, upstream, direction)
    )
}

fn turned<'py, T: Format>(
    py: Python<'py>,
    source: &Source,
    distances: &[f64],
    style: &OffsetStyle,
    upstream: [Object<'py>; 2],
    [along, further]: [Object<'py>; 2],
) -> PyResult<Object<'py>> {
    let [areas, perimeters] = [numbers::<T>(&upstream[0])?, numbers::<T>(&upstream[1])?];
    let (along, further) = (vectors::<T>(&along)?, numbers::<T>(&further)?);
    let own = T::of(source.vertices());
    let (count, is_path) = (source.len(), matches!(source, Source::Paths(..)));
    let counts = [
        areas.len(),
        perimeters.len(),
        further.len(),
        distances.len(),
    ];
    if counts != [count; 4] || along.len() != own.len() {
        return Err(PyValueError::new_err(format!(
            "direction: {} vertices and {count} numbers are needed",
            own.len()
        )));
    }
    let jet = |value: T, derivative: T| Jet {
        value,
        derivative: [derivative],
    };
    let runs = in_runs(py, count, 256 * own.len(), |run| {
        let mut made = Run::<T>::new(run.len());
        for i in run {
            let (all, ends) = source.item(i);
            let rings = Rings::flat(&own[all.clone()], &ends);
            let trace = searched(rings, T::lit(distances[i]), style, is_path)
                .map_err(|error| (i, error))?;
            let moved = own[all.clone()].iter().zip(&along[all]);
            let moved: Vec<_> = moved
                .map(|(v, by)| Vec2::new(jet(v.x, by.x), jet(v.y, by.y)))
                .collect();
            let mut bars = vec![Vec2::zero(); moved.len()];
            let bar = OffsetMeasures {
                area: jet(areas[i], T::zero()),
                perimeter: jet(perimeters[i], T::zero()),
            };
            let d = jet(T::lit(distances[i]), further[i]);
            let rings = Rings::flat(&moved, &ends);
            let (found, by_distance) = round_offset_vjp(rings, d, &trace, bar, &mut bars);
            let turn = |jet: Jet<T, 1>| jet.derivative[0];
            made.areas.push(turn(found.area));
            made.perimeters.push(turn(found.perimeter));
            made.is_exact.push(trace.is_exact());
            made.bars
                .extend(bars.iter().map(|v| Vec2::new(turn(v.x), turn(v.y))));
            made.by_distance.push(turn(by_distance));
        }
        Ok(made)
    })?;
    Run::joined(runs, count)?.into_python(py, true)
}

/// Returns the style of exact arcs with a fill rule.
pub fn style(rule: &str) -> PyResult<OffsetStyle> {
    Ok(OffsetStyle {
        fill: fill(rule)?,
        ..OffsetStyle::default()
    })
}

/// Returns the record of an offset with exact arcs.
pub fn searched<T: Format>(
    rings: Rings<'_, T>,
    d: T,
    style: &OffsetStyle,
    is_path: bool,
) -> Result<RoundOffsetTrace, Error> {
    match is_path {
        true => round_path_offset_search(rings, d, style),
        false => round_offset_search(rings, d, style),
    }
}

/// Areas, perimeters and whether arcs are exact, of the offsets of a column of polygons, or of paths given as vertices with
/// the start of each; with cotangents of areas and perimeters also those of the vertices and of the distances.
#[pyfunction]
#[pyo3(signature = (column, starts, distances, rule, upstream=None))]
pub fn polygon_buffer_measures<'py>(
    py: Python<'py>,
    column: &Object<'py>,
    starts: Option<Vec<usize>>,
    distances: Vec<f64>,
    rule: &str,
    upstream: Option<[Object<'py>; 2]>,
) -> PyResult<Object<'py>> {
    let style = style(rule)?;
    let source = Source::of(column, starts)?;
    let is_double = matches!(source.vertices(), Vertices::Double(_));
    in_format!(
        is_double,
        measured(py, &source, &distances, &style, upstream)
    )
}

/// The results of a run of items.
struct Run<T> {
    areas: Vec<T>,
    perimeters: Vec<T>,
    is_exact: Vec<bool>,
    bars: Vec<Vec2<T>>,
    by_distance: Vec<T>,
}

impl<T: Format> Run<T> {
    /// Returns all runs one after the other.
    fn joined(runs: Vec<Result<Self, (usize, Error)>>, count: usize) -> PyResult<Self> {
        let mut all = Run::<T>::new(count);
        for run in runs {
            let run = run.map_err(|(i, error)| raised(at(i, error)))?;
            all.areas.extend(run.areas);
            all.perimeters.extend(run.perimeters);
            all.is_exact.extend(run.is_exact);
            all.bars.extend(run.bars);
            all.by_distance.extend(run.by_distance);
        }
        Ok(all)
    }
    fn into_python(self, py: Python<'_>, has_bars: bool) -> PyResult<Object<'_>> {
        let values = (
            PyArray1::from_vec(py, self.areas),
            PyArray1::from_vec(py, self.perimeters),
            PyArray1::from_vec(py, self.is_exact),
        );
        let bars = match has_bars {
            false => None,
            true => Some((
                rows(py, &self.bars)?,
                PyArray1::from_vec(py, self.by_distance),
            )),
        };
        Ok((values, bars).into_pyobject(py)?.into_any())
    }
    fn new(count: usize) -> Self {
        Run {
            areas: Vec::with_capacity(count),
            perimeters: Vec::with_capacity(count),
            is_exact: Vec::with_capacity(count),
            bars: Vec::new(),
            by_distance: Vec::new(),
        }
    }
}

fn measured<'py, T: Format>(
    py: Python<'py>,
    source: &Source,
    distances: &[f64],
    style: &OffsetStyle,
    upstream: Option<[Object<'py>; 2]>,
) -> PyResult<Object<'py>> {
    let count = source.len();
    let upstream = match upstream {
        None => None,
        Some([areas, perimeters]) => Some([numbers::<T>(&areas)?, numbers::<T>(&perimeters)?]),
    };
    let given = upstream.iter().flatten().map(Vec::len);
    if given.chain([distances.len()]).any(|own| own != count) {
        return Err(PyValueError::new_err(format!(
            "distance and upstream: {count} numbers are needed, one per row"
        )));
    }
    let is_path = matches!(source, Source::Paths(..));
    let own = T::of(source.vertices());
    let runs = in_runs(py, count, 64 * own.len(), |run| {
        let mut made = Run::<T>::new(run.len());
        for i in run {
            let (all, ends) = source.item(i);
            let count = all.len();
            let (rings, d) = (Rings::flat(&own[all], &ends), T::lit(distances[i]));
            let trace = searched(rings, d, style, is_path).map_err(|error| (i, error))?;
            let found = match &upstream {
                None => round_offset_replay(rings, d, &trace),
                Some([areas, perimeters]) => {
                    let start = made.bars.len();
                    made.bars.resize(start + count, Vec2::zero());
                    let bar = OffsetMeasures {
                        area: areas[i],
                        perimeter: perimeters[i],
                    };
                    let into = &mut made.bars[start..];
                    let (found, by_distance) = round_offset_vjp(rings, d, &trace, bar, into);
                    made.by_distance.push(by_distance);
                    found
                }
            };
            made.areas.push(found.area);
            made.perimeters.push(found.perimeter);
            made.is_exact.push(trace.is_exact());
        }
        Ok(made)
    })?;
    Run::joined(runs, count)?.into_python(py, upstream.is_some())
}
