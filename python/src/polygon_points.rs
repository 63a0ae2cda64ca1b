//! Points and polygons: distances, and what contains what.
use crate::lent::array_of;
use crate::polygon_calls::{
    Bars, fill, in_format, in_runs, in_watched_runs, listed, numbers, place, together,
};
use crate::polygons::{Format, Polygons, rows, vectors};
use crate::raised;
use crate::shapes::{Content, Shape};
use crate::table::table;
use geograd::ad::adjoint::polygon as adjoint;
use geograd::error::{Argument, Validate};
use geograd::polygon::{Fill, Slabs};
use geograd::{Error, Vec2};
use numpy::{PyArray1, PyArray2, PyArrayDyn, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// The number of points from which the edges of one polygon are sorted.
const MANY: usize = 32;
/// The points between two looks at an interruption.
const LOOK: usize = 64;

/// Returns points as an array of rows in the format of a call with polygons; `None` for what is converted first.
pub fn plain_points<'py>(x: &Object<'py>, polygons: &Polygons) -> Option<Object<'py>> {
    let array = match x.cast::<Shape>() {
        Ok(shape) => match &shape.get().content {
            Content::Array(array) if table().name(shape.get().kind) == "Vec2" => {
                array.bind(x.py()).clone()
            }
            _ => return None,
        },
        Err(_) => x.cast_exact::<PyUntypedArray>().ok()?.clone(),
    };
    let is_single = !polygons.is_double() && array.cast::<PyArray2<f32>>().is_ok();
    let is_plain = is_single || array.cast::<PyArray2<f64>>().is_ok();
    (is_plain && array.is_c_contiguous() && array.shape()[1] == 2).then(|| array.into_any())
}

/// The signed distance of points and polygons, negative inside, or with `is_of_area` the distance from what the border
/// encloses; with cotangents of these those of points and vertices.
#[pyfunction]
#[pyo3(signature = (points, polygons, rule, is_of_area, upstream=None))]
pub fn polygon_distance<'py>(
    py: Python<'py>,
    points: &Object<'py>,
    polygons: &Polygons,
    rule: &str,
    is_of_area: bool,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let is_double = points.cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(
        is_double,
        distanced(py, points, polygons, fill(rule)?, is_of_area, upstream)
    )
}

fn distanced<'py, T: Format>(
    py: Python<'py>,
    points: &Object<'py>,
    own: &Polygons,
    fill: Fill,
    is_of_area: bool,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let (points, vertices) = (vectors::<T>(points)?, T::of(&own.vertices));
    let (of_points, of_polygons) = (points.len(), own.layout.len());
    let count = together(("points", of_points), ("polygons", of_polygons))?;
    let zero = T::narrowed(0.0);
    let pair = |i: usize| {
        (
            points[place(of_points, i)],
            own.layout.item(&vertices, place(of_polygons, i)),
        )
    };
    for (item, point) in points.iter().enumerate() {
        // As the rows of a verb refuse a point.
        point.validate().map_err(|flaw| {
            raised(Error::Invalid {
                argument: Argument::Named("point"),
                item,
                flaw,
            })
        })?;
    }
    let known = |distance: T| match is_of_area && distance < zero {
        true => zero,
        false => distance,
    };
    let mean = vertices.len() / of_polygons.max(1);
    let work = count.saturating_mul(mean + 1);
    let Some(upstream) = upstream else {
        let values = listed(py, count, work, |run, values| {
            let all = run.map(pair);
            values.extend(all.map(|(at, rings)| known(rings.signed_distance(at, fill))));
        })?;
        return Ok(array_of(py, values).into_any());
    };
    let upstream = numbers::<T>(upstream)?;
    let runs = in_runs(py, count, work, |run| {
        let mut bars = Bars::<T>::new(own, &run);
        let (mut values, mut by_points) = (Vec::with_capacity(run.len()), Vec::new());
        for i in run {
            let (at, rings) = pair(i);
            let mut by_point = Vec2::zero();
            let value = rings.signed_distance(at, fill);
            // Inside of an area the distance from it is flat.
            if !(is_of_area && value < zero) {
                let item = place(of_polygons, i);
                let into = bars.added(own, item);
                adjoint::signed_distance_vjp(at, rings, fill, upstream[i], &mut by_point, into);
            }
            by_points.push(by_point);
            values.push(known(value));
        }
        (values, by_points, bars)
    })?;
    let (mut values, mut by_points, mut bars) = (Vec::new(), Vec::new(), Vec::new());
    for (own, by, bar) in runs {
        values.extend(own);
        by_points.extend(by);
        bars.push(bar);
    }
    // One point that stands for all has the sum of their derivatives, as one polygon has.
    if of_points == 1 && count != 1 {
        by_points = vec![by_points.iter().fold(Vec2::zero(), |sum, &by| sum + by)];
    }
    let bars = (rows(py, &by_points)?, rows(py, &Bars::joined(own, bars))?);
    Ok((PyArray1::from_vec(py, values), bars)
        .into_pyobject(py)?
        .into_any())
}

/// True where a polygon contains a point; its border belongs to it.
#[pyfunction]
pub fn polygon_contains<'py>(
    py: Python<'py>,
    points: &Object<'py>,
    polygons: &Bound<'py, Polygons>,
    rule: &str,
) -> PyResult<Object<'py>> {
    let points = match plain_points(points, polygons.get()) {
        Some(points) => points,
        None => {
            let converted = py.import("geograd._polygons")?.getattr("_spots")?;
            converted.call1((points, polygons))?
        }
    };
    let is_double = points.cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(
        is_double,
        contained(py, &points, polygons.get(), fill(rule)?)
    )
}

fn contained<'py, T: Format>(
    py: Python<'py>,
    points: &Object<'py>,
    own: &Polygons,
    fill: Fill,
) -> PyResult<Object<'py>> {
    let (points, vertices) = (vectors::<T>(points)?, T::of(&own.vertices));
    let (of_points, of_polygons) = (points.len(), own.layout.len());
    let count = together(("points", of_points), ("polygons", of_polygons))?;
    let mean = vertices.len() / of_polygons.max(1);
    // Sorting the edges of one polygon takes as long as some points.
    let slabs =
        (of_polygons == 1 && count >= MANY).then(|| Slabs::of(own.layout.item(&vertices, 0)));
    let work = match slabs {
        Some(_) => count,
        None => count.saturating_mul(mean + 1),
    };
    let runs = in_watched_runs(py, count, work, |run, interruption| {
        // A point takes as long as there are edges at its height.
        let until = run.take_while(|i| !i.is_multiple_of(LOOK) || !interruption.is_due());
        let inside = until.map(|i| {
            let at = points[place(of_points, i)];
            let contains = || match &slabs {
                Some(slabs) => slabs.contains(at, fill),
                None => own
                    .layout
                    .item(&vertices, place(of_polygons, i))
                    .contains(at, fill),
            };
            at.is_finite() && contains()
        });
        inside.collect::<Vec<bool>>()
    })?;
    Ok(PyArray1::from_vec(py, runs.concat()).into_any())
}
