//! Hausdorff's and Fréchet's distance of two columns of figures of the plane, item by item, with what decides each.
use crate::polygon_calls::{in_format, in_watched_runs, place};
use crate::polygons::Format;
use crate::separation::{EdgeColumn, EdgeLists, columns};
use geograd::similarity::{Outline, frechet_search, hausdorff_search};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// The vertex and the edge that decide a distance: `true` for a vertex of `b`, its place, and the places of both ends of
/// the edge of the other column, which are one for a vertex.
type Decided = (bool, [i64; 3]);

/// For each item Hausdorff's distance, with `is_leash` Fréchet's, NaN without vertices; whether the vertex that decides it
/// is of `b`; and the places of this vertex and of both ends of the edge nearest to it, all of both columns.
#[pyfunction]
pub fn far_pairs<'py>(
    py: Python<'py>,
    a: EdgeColumn<'py>,
    b: EdgeColumn<'py>,
    count: usize,
    is_leash: bool,
) -> PyResult<Object<'py>> {
    let is_double = a.vertices().cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(is_double, found(py, &a, &b, count, is_leash))
}

fn found<'py, T: Format>(
    py: Python<'py>,
    a: &EdgeColumn<'py>,
    b: &EdgeColumn<'py>,
    count: usize,
    is_leash: bool,
) -> PyResult<Object<'py>> {
    let both = columns::<T>(py, a, b, count)?;
    let at = |k: usize, item: usize| both[k].places(place(both[k].len(), item));
    // A search takes about as long as so many numbers do elsewhere.
    let work = both
        .iter()
        .map(|own| 16 * own.vertices.len().max(count))
        .sum();
    let runs = in_watched_runs(py, count, work, |run, interruption| {
        // An item takes as long as there are vertices.
        let until = run.take_while(|_| !interruption.is_due());
        until
            .map(|item| {
                let starts = [0, 1].map(|k| at(k, item).start);
                let own = [0, 1].map(|k| &both[k].vertices[at(k, item)]);
                match is_leash {
                    true => leash(own, starts),
                    false => farthest(&both, [0, 1].map(|k| at(k, item)), own, starts),
                }
            })
            .collect::<Vec<_>>()
    })?;
    let all: Vec<(T, Decided)> = runs.concat();
    let places = |k: usize| PyArray1::from_iter(py, all.iter().map(|(_, own)| own.1[k]));
    let arrays = (
        PyArray1::from_iter(py, all.iter().map(|own| own.0)),
        PyArray1::from_iter(py, all.iter().map(|(_, own)| own.0)),
        places(0),
        places(1),
        places(2),
    );
    Ok(arrays.into_pyobject(py)?.into_any())
}

fn nothing<T: Format>() -> (T, Decided) {
    (T::narrowed(f64::NAN), (false, [0; 3]))
}

fn leash<T: Format>(own: [&[geograd::Vec2<T>]; 2], starts: [usize; 2]) -> (T, Decided) {
    frechet_search(own[0], own[1]).map_or_else(nothing, |(found, [i, j])| {
        let [i, j] = [(starts[0] + i) as i64, (starts[1] + j) as i64];
        (found, (false, [i, j, j]))
    })
}

fn farthest<T: Format>(
    both: &[EdgeLists<T>; 2],
    at: [std::ops::Range<usize>; 2],
    own: [&[geograd::Vec2<T>]; 2],
    starts: [usize; 2],
) -> (T, Decided) {
    let following = [0, 1].map(|k| {
        let all = both[k].following[at[k].clone()].iter();
        all.map(|&next| next - starts[k]).collect::<Vec<_>>()
    });
    let outlines = [0, 1].map(|k| Outline::linked(own[k], &following[k]));
    let [Some(a), Some(b)] = &outlines else {
        return nothing();
    };
    hausdorff_search(a, b).map_or_else(nothing, |(found, record)| {
        let side = usize::from(record.of_second);
        let vertex = (starts[side] + record.vertex) as i64;
        let [from, to] = record.edge.map(|end| (starts[1 - side] + end) as i64);
        (found, (record.of_second, [vertex, from, to]))
    })
}
