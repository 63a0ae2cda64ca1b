//! Offsets of polygons and polylines, item by item, on all cores.
use crate::polygon_calls::{fill, in_format, in_runs};
use crate::polygons::{Format, Layout, Polygons, Vertices, is_ring, rows, vectors};
use crate::raised;
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
use std::sync::Arc;

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

/// A result and its record.
struct Item<T> {
    vertices: Vec<Vec2<T>>,
    layout: Layout,
    trace: Trace,
    /// The vertices of the record that the result has.
    kept: Vec<Range<usize>>,
}

/// Adds a part without its rings of fewer than three distinct vertices, which have no area. `start` is the number of
/// vertices of the record before it.
fn add_part<'r, T: Format>(
    (vertices, layout, kept): (&mut Vec<Vec2<T>>, &mut Layout, &mut Vec<Range<usize>>),
    rings: impl Iterator<Item = &'r [Vec2<T>]>,
    start: &mut usize,
) {
    let mut is_solid = true;
    for (k, ring) in rings.enumerate() {
        let is_kept = is_solid && is_ring(ring);
        // The first ring bounds the part: without it there are no holes.
        is_solid &= is_kept || k > 0;
        if is_kept {
            vertices.extend_from_slice(ring);
            layout.add_ring(ring.len());
            kept.push(*start..*start + ring.len());
        }
        *start += ring.len();
    }
    layout.end_part();
}

impl<T: Format> Item<T> {
    fn of(
        rings: Rings<'_, T>,
        d: T,
        style: &OffsetStyle,
        (is_path, is_valid): (bool, bool),
    ) -> Result<Self, Error> {
        let (mut vertices, mut layout, mut kept) = (Vec::new(), Layout::empty(), Vec::new());
        let mut start = 0;
        let trace = if is_valid {
            let search = if is_path {
                valid_path_offset_search::<T>
            } else {
                valid_offset_search::<T>
            };
            let trace = search(rings, d, style)?;
            for part in &valid_offset_replay(rings, d, &trace) {
                let made = (&mut vertices, &mut layout, &mut kept);
                add_part(made, part.rings().iter(), &mut start);
            }
            Trace::Valid(trace)
        } else {
            let search = if is_path {
                path_offset_search::<T>
            } else {
                offset_search::<T>
            };
            let trace = search(rings, d, style)?;
            let shape = offset_replay(rings, d, &trace);
            for part in trace.parts() {
                let made = (&mut vertices, &mut layout, &mut kept);
                add_part(made, part.map(|ring| shape.ring(ring)), &mut start);
            }
            Trace::Plain(trace)
        };
        layout.end_polygon();
        Ok(Item {
            vertices,
            layout,
            trace,
            kept,
        })
    }
}

/// The decisions of offsets of a column: the origin of every vertex of the results.
#[pyclass(frozen, module = "geograd._core")]
pub struct Buffer {
    source: Source,
    distances: Vec<f64>,
    items: Vec<(Trace, Vec<Range<usize>>)>,
    /// The number of vertices up to the start of each result, and of all.
    firsts: Vec<usize>,
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

/// Offsets of a column of polygons, or of paths given as vertices with the start of each: the results and the record of
/// decisions.
#[pyfunction]
pub fn polygon_buffer<'py>(
    py: Python<'py>,
    column: &Object<'py>,
    starts: Option<Vec<usize>>,
    distances: Vec<f64>,
    look: (String, f64, String, u32, Option<f64>),
    rule: &str,
    is_valid: bool,
) -> PyResult<(Polygons, Buffer)> {
    let (join, limit, end, chords, tolerance) = look;
    let style = style((&join, limit, &end), (chords, tolerance), rule)?;
    let source = Source::of(column, starts)?;
    let is_double = matches!(source.vertices(), Vertices::Double(_));
    in_format!(is_double, made(py, source, distances, style, is_valid))
}

fn made<T: Format>(
    py: Python<'_>,
    source: Source,
    distances: Vec<f64>,
    style: OffsetStyle,
    is_valid: bool,
) -> PyResult<(Polygons, Buffer)> {
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
        let made = run.map(|i| {
            let (all, ends) = source.item(i);
            let rings = Rings::flat(&own[all], &ends);
            let item = Item::<T>::of(rings, T::lit(distances[i]), &style, (is_path, is_valid));
            item.map_err(|error| (i, error))
        });
        made.collect::<Result<Vec<_>, _>>()
    })?;
    let (mut vertices, mut layout) = (Vec::new(), Layout::empty());
    let (mut items, mut firsts) = (Vec::with_capacity(count), vec![0]);
    for run in runs {
        for item in run.map_err(|(i, error)| raised(at(i, error)))? {
            vertices.extend(item.vertices);
            layout.add(&item.layout, 0);
            items.push((item.trace, item.kept));
            firsts.push(vertices.len());
        }
    }
    drop(own);
    let made = Polygons::of(Arc::new(layout), T::kept(vertices));
    let record = Buffer {
        source,
        distances,
        items,
        firsts,
        is_double: T::IS_DOUBLE,
    };
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
    let wanted = record.firsts.last().copied().unwrap_or(0);
    if upstream.len() != wanted {
        return Err(PyValueError::new_err(format!(
            "upstream: cotangents of {wanted} vertices are needed, not of {}",
            upstream.len()
        )));
    }
    let own = T::of(record.source.vertices());
    let runs = in_runs(py, record.items.len(), 64 * own.len(), |run| {
        let (mut bars, mut by_distance) = (Vec::new(), Vec::new());
        for i in run {
            let (trace, kept) = &record.items[i];
            let count = match trace {
                Trace::Plain(trace) => trace.vertex_count(),
                Trace::Valid(trace) => trace.vertex_count(),
            };
            let mut out_bars = vec![Vec2::zero(); count];
            let mut given = &upstream[record.firsts[i]..record.firsts[i + 1]];
            for range in kept {
                let (these, others) = given.split_at(range.len());
                out_bars[range.clone()].copy_from_slice(these);
                given = others;
            }
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
