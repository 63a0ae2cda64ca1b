//! Offsets of polygons and polylines, item by item, on all cores.
use crate::polygon_calls::{fill, in_format, in_runs};
use crate::polygons::{Format, Polygons, Vertices, rows, vectors};
use crate::raised;
use crate::results::{Records, Results};
use geograd::ad::adjoint::offset::{offset_vjp, valid_offset_vjp};
use geograd::offset::{
    Chords, End, Join, OffsetStyle, OffsetTrace, ValidOffsetTrace, offset_replay, offset_search,
    path_offset_search, valid_offset_replay, valid_offset_search, valid_path_offset_search,
};
use geograd::polygon::Rings;
use geograd::{Error, Vec2};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::ops::Range;

type Object<'py> = Bound<'py, PyAny>;

/// The column that is offset.
pub enum Source {
    Polygons(Py<Polygons>),
    /// Vertices of paths, and where each path starts.
    Paths(Vertices, Vec<usize>),
}

impl Source {
    /// Reads a column of polygons, or vertices of paths with the start of each.
    pub fn of(column: &Object<'_>, starts: Option<Vec<usize>>) -> PyResult<Self> {
        let Some(starts) = starts else {
            return Ok(Source::Polygons(
                column.cast::<Polygons>()?.clone().unbind(),
            ));
        };
        let vertices = match vectors::<f32>(column) {
            Ok(all) => Vertices::Single(all),
            Err(_) => Vertices::Double(vectors::<f64>(column)?),
        };
        Ok(Source::Paths(vertices, starts))
    }
    pub fn vertices(&self) -> &Vertices {
        match self {
            Source::Polygons(own) => &own.get().vertices,
            Source::Paths(vertices, _) => vertices,
        }
    }
    pub fn len(&self) -> usize {
        match self {
            Source::Polygons(own) => own.get().layout.len(),
            Source::Paths(_, offsets) => offsets.len() - 1,
        }
    }
    /// Returns the vertices of an item, and the number of these up to the end of each ring.
    pub fn item(&self, item: usize) -> (Range<usize>, Vec<usize>) {
        match self {
            Source::Polygons(own) => {
                let layout = &own.get().layout;
                let all = layout.vertices(item);
                let first = all.start;
                let ends = layout.rings(item).map(|k| layout.rings[k + 1] - first);
                (all, ends.collect())
            }
            Source::Paths(_, offsets) => {
                let all = offsets[item]..offsets[item + 1];
                let count = all.len();
                (all, vec![count])
            }
        }
    }
}

/// The record of one item.
enum Trace {
    Plain(OffsetTrace),
    Valid(ValidOffsetTrace),
}

impl Trace {
    fn vertex_count(&self) -> usize {
        match self {
            Trace::Plain(trace) => trace.vertex_count(),
            Trace::Valid(trace) => trace.vertex_count(),
        }
    }
}

/// Adds the offset of an item.
fn add<T: Format>(
    all: &mut Results<T, Trace>,
    rings: Rings<'_, T>,
    d: T,
    style: &OffsetStyle,
    (is_path, is_valid): (bool, bool),
) -> Result<(), Error> {
    let trace = if is_valid {
        let search = if is_path {
            valid_path_offset_search::<T>
        } else {
            valid_offset_search::<T>
        };
        let trace = search(rings, d, style)?;
        all.add_valid(&valid_offset_replay(rings, d, &trace));
        Trace::Valid(trace)
    } else {
        let search = if is_path {
            path_offset_search::<T>
        } else {
            offset_search::<T>
        };
        let trace = search(rings, d, style)?;
        all.add_plain(&offset_replay(rings, d, &trace), trace.parts());
        Trace::Plain(trace)
    };
    all.end(trace);
    Ok(())
}

/// The decisions of offsets of a column: the origin of every vertex of the results.
#[pyclass(frozen, module = "geograd._core")]
pub struct Buffer {
    source: Source,
    distances: Vec<f64>,
    records: Records<Trace>,
    is_double: bool,
}

/// Reads the look of an offset.
fn style(
    (join, limit, end): (&str, f64, &str),
    (chords, tolerance): (u32, Option<f64>),
    rule: &str,
) -> PyResult<OffsetStyle> {
    let refused = |text: String| Err(PyValueError::new_err(text));
    let join = match join {
        "round" => Join::Round,
        "mitre" => Join::Mitre(limit),
        "bevel" => Join::Bevel,
        other => {
            return refused(format!(
                "join: \"round\", \"mitre\" or \"bevel\" is needed, not {other:?}"
            ));
        }
    };
    let end = match end {
        "round" => End::Round,
        "flat" => End::Flat,
        "square" => End::Square,
        other => {
            return refused(format!(
                "end: \"round\", \"flat\" or \"square\" is needed, not {other:?}"
            ));
        }
    };
    let chords = tolerance.map_or(Chords::PerQuarter(chords), Chords::Within);
    Ok(OffsetStyle {
        join,
        end,
        chords,
        fill: fill(rule)?,
        is_trusted: false,
    })
}

/// Offsets of a column of polygons, or of paths given as vertices with the start of each: the results and, if it is kept,
/// the record of decisions.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "a call from Python has no other form"
)]
pub fn polygon_buffer<'py>(
    py: Python<'py>,
    column: &Object<'py>,
    starts: Option<Vec<usize>>,
    distances: Vec<f64>,
    look: (String, f64, String, u32, Option<f64>),
    rule: &str,
    is_valid: bool,
    is_kept: bool,
) -> PyResult<(Polygons, Option<Buffer>)> {
    let (join, limit, end, chords, tolerance) = look;
    let style = style((&join, limit, &end), (chords, tolerance), rule)?;
    let source = Source::of(column, starts)?;
    let is_double = matches!(source.vertices(), Vertices::Double(_));
    in_format!(
        is_double,
        made(py, source, distances, style, (is_valid, is_kept))
    )
}

fn made<T: Format>(
    py: Python<'_>,
    source: Source,
    distances: Vec<f64>,
    style: OffsetStyle,
    (is_valid, is_kept): (bool, bool),
) -> PyResult<(Polygons, Option<Buffer>)> {
    let count = source.len();
    if distances.len() != count {
        return Err(PyValueError::new_err(format!(
            "distance: {count} numbers are needed, one per row, or one for all, not {}",
            distances.len()
        )));
    }
    let is_path = matches!(source, Source::Paths(..));
    let own = T::of(source.vertices());
    let work = 256 * own.len();
    let runs = in_runs(py, count, work, |run| {
        let mut all = Results::new(is_kept);
        for i in run {
            let (vertices, ends) = source.item(i);
            let rings = Rings::flat(&own[vertices], &ends);
            let kind = (is_path, is_valid);
            add::<T>(&mut all, rings, T::lit(distances[i]), &style, kind).map_err(|e| at(i, e))?;
        }
        Ok(all)
    })?;
    let mut all = Results::new(is_kept);
    for run in runs {
        all.add(run.map_err(raised)?);
    }
    drop(own);
    let (made, records) = all.column();
    let record = records.map(|records| Buffer {
        source,
        distances,
        records,
        is_double: T::IS_DOUBLE,
    });
    Ok((made, record))
}

/// Returns an error with the item of the column.
pub fn at(i: usize, error: Error) -> Error {
    match error {
        Error::Invalid { argument, flaw, .. } => Error::Invalid {
            argument,
            item: i,
            flaw,
        },
        other => other,
    }
}

#[pymethods]
impl Buffer {
    /// The cotangents of the vertices of the column and of the distances, from those of the vertices of the results.
    fn vjp<'py>(&self, py: Python<'py>, upstream: &Object<'py>) -> PyResult<Object<'py>> {
        in_format!(self.is_double, pulled(py, self, upstream))
    }
}

fn pulled<'py, T: Format>(
    py: Python<'py>,
    record: &Buffer,
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
    let own = T::of(record.source.vertices());
    let runs = in_runs(py, record.records.len(), 64 * own.len(), |run| {
        let (mut bars, mut by_distance) = (Vec::new(), Vec::new());
        let mut out_bars = Vec::new();
        for i in run {
            let records = &record.records;
            let trace = records.bars(i, &upstream, Trace::vertex_count, &mut out_bars);
            let (all, ends) = record.source.item(i);
            let (rings, start) = (Rings::flat(&own[all.clone()], &ends), bars.len());
            bars.resize(start + all.len(), Vec2::zero());
            let (d, into) = (T::lit(record.distances[i]), &mut bars[start..]);
            by_distance.push(match trace {
                Trace::Plain(trace) => offset_vjp(rings, d, trace, &out_bars, into),
                Trace::Valid(trace) => valid_offset_vjp(rings, d, trace, &out_bars, into),
            });
        }
        (bars, by_distance)
    })?;
    let (bars, by_distance): (Vec<_>, Vec<_>) = runs.into_iter().unzip();
    let both = (
        rows(py, &bars.concat())?,
        PyArray1::from_vec(py, by_distance.concat()),
    );
    Ok(both.into_pyobject(py)?.into_any())
}
