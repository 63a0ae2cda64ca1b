//! Borders of offsets as steps of lines and arcs, item by item, on all cores.
use crate::buffer_measures::{searched, style};
use crate::buffered::{Source, at};
use crate::curve_calls::letters;
use crate::polygon_calls::in_runs;
use crate::polygons::Format;
use crate::raised;
use geograd::Pack;
use geograd::offset::round_offset_curves;
use geograd::polygon::Rings;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// The borders of the offsets of a column of polygons, or of paths given as vertices with the start of each: letters and
/// numbers of a path of curves, or `None` where nothing is left. In double precision, whatever the column has.
#[pyfunction]
pub fn polygon_buffer_curves<'py>(
    py: Python<'py>,
    column: &Object<'py>,
    starts: Option<Vec<usize>>,
    distances: Vec<f64>,
    rule: &str,
) -> PyResult<Vec<Option<(String, Bound<'py, PyArray1<f64>>)>>> {
    let style = style(rule)?;
    let source = Source::of(column, starts)?;
    let count = source.len();
    if distances.len() != count {
        return Err(PyValueError::new_err(format!(
            "distance: {count} numbers are needed, one per row"
        )));
    }
    let is_path = matches!(source, Source::Paths(..));
    let own = f64::of(source.vertices());
    let runs = in_runs(py, count, 64 * own.len(), |run| {
        let paths = run.map(|i| {
            let (all, ends) = source.item(i);
            let rings = Rings::flat(&own[all], &ends);
            let trace =
                searched(rings, distances[i], &style, is_path).map_err(|error| (i, error))?;
            Ok(round_offset_curves(rings, distances[i], &trace))
        });
        paths.collect::<Result<Vec<_>, _>>()
    })?;
    let mut all = Vec::with_capacity(count);
    for run in runs {
        let run = run.map_err(|(i, error)| raised(at(i, error)))?;
        all.extend(run.into_iter().map(|path| {
            let path = path?;
            Some((letters(&path), PyArray1::from_vec(py, path.scalars())))
        }));
    }
    Ok(all)
}
