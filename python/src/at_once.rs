//! Values of columns that lie in memory as a call reads them: no lists of arguments, rows and results are made.
use crate::arrays::offsets;
use crate::catalogue::{Row, Verb};
use crate::lent::{LentNumbers, array_of};
use crate::number::Number;
use crate::polygon_calls::{polygon_measure, polygon_overlap};
use crate::polygon_points::{plain_points, polygon_distance};
use crate::polygons::Polygons;
use crate::raised;
use crate::separation::polygons_apart;
use crate::shapes::Paths;
use crate::threads::on_threads;
use numpy::{PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

type Object<'py> = Bound<'py, PyAny>;

/// Returns the value of a verb of paths alone, of polygons, or of polygons and points; `None` for any other call.
pub fn value<'py>(
    py: Python<'py>,
    verb: &'static Verb,
    arguments: &Bound<'py, PyTuple>,
) -> PyResult<Option<Object<'py>>> {
    let name = verb.name.as_str();
    let mut all = arguments.iter();
    match [all.next(), all.next(), all.next()] {
        [Some(x), None, None] => match (x.cast::<Paths>(), x.cast::<Polygons>()) {
            (Ok(paths), _) => of_paths(py, verb, paths.get()),
            (_, Ok(own)) if matches!(name, "area" | "length" | "perimeter") => {
                polygon_measure(py, name, own.get(), None).map(Some)
            }
            _ => Ok(None),
        },
        [Some(a), Some(b), None] => match (a.cast::<Polygons>(), b.cast::<Polygons>()) {
            (Ok(a), Ok(b)) => match name {
                "distance" => polygons_apart(py, a.get(), b.get()).map(Some),
                "intersection_area" | "iof" | "iou" => {
                    polygon_overlap(py, name, a.get(), b.get(), None).map(Some)
                }
                _ => Ok(None),
            },
            (Ok(own), _) => of_points(py, name, &b, own.get()),
            (_, Ok(own)) => of_points(py, name, &a, own.get()),
            _ => Ok(None),
        },
        _ => Ok(None),
    }
}

/// Returns the distances of points from polygons.
fn of_points<'py>(
    py: Python<'py>,
    name: &str,
    points: &Object<'py>,
    polygons: &Polygons,
) -> PyResult<Option<Object<'py>>> {
    let is_of_area = match name {
        "distance" => true,
        "signed_distance" => false,
        _ => return Ok(None),
    };
    match plain_points(points, polygons) {
        Some(points) => {
            polygon_distance(py, &points, polygons, "even_odd", is_of_area, None).map(Some)
        }
        None => Ok(None),
    }
}

/// Returns the value of a verb of paths alone, one number for each.
fn of_paths<'py>(
    py: Python<'py>,
    verb: &'static Verb,
    paths: &Paths,
) -> PyResult<Option<Object<'py>>> {
    let Some(kind) = paths.kind else {
        return Ok(None);
    };
    let is_alone = |row: &&Row| row.takes == [kind] && row.call.is_of_paths();
    let mut rows = verb.rows.iter().filter(is_alone);
    let (Some(row), None) = (rows.next(), rows.next()) else {
        return Ok(None);
    };
    let is_number = matches!(row.call.gives(), [one] if one.axes.is_empty());
    let vertices = paths.vertices.bind(py);
    if !is_number || !row.call.takes.is_empty() || !vertices.is_c_contiguous() {
        return Ok(None);
    }
    match (
        vertices.cast::<PyArray2<f64>>(),
        vertices.cast::<PyArray2<f32>>(),
    ) {
        (Ok(vertices), _) => summed(py, row, paths, vertices).map(Some),
        (_, Ok(vertices)) => summed(py, row, paths, vertices).map(Some),
        _ => Ok(None),
    }
}

fn summed<'py, T: Number>(
    py: Python<'py>,
    row: &'static Row,
    paths: &Paths,
    vertices: &Bound<'py, PyArray2<T>>,
) -> PyResult<Object<'py>> {
    let offsets = offsets(py, paths.offsets.bind(py).as_any(), "offsets")?;
    let function = row.call.on_paths::<T>()?;
    let count = vertices.len();
    let lent = LentNumbers::of(vertices, "vertices")?;
    let numbers = lent.numbers()?;
    let values = on_threads(py, count, || function.values(&[], numbers, &offsets))?;
    Ok(array_of(py, values.map_err(raised)?).into_any())
}
