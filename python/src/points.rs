//! Sets of points: hulls, extents, smallest shapes around them, and alignments.
use crate::polygon_calls::in_runs;
use crate::polygons::{Format, Layout, Polygons, rows, vectors};
use crate::raised;
use geograd::ad::forward::First;
use geograd::hull::hull_search;
use geograd::measure::circle::{Support, circle_replay, circle_search};
use geograd::measure::extent::{
    Farthest, Narrowest, diameter_replay, diameter_search, width_replay, width_search,
};
use geograd::measure::rectangle::{Resting, rectangle_replay, rectangle_search};
use geograd::procrustes::{procrustes as aligned, procrustes_rigid};
use geograd::{Circle, Error, Jet, Obb2, Pack, Pose3, Scalar, Vec2, Vec3};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

type Object<'py> = Bound<'py, PyAny>;

/// A measure of a set of points, and the record of the points that decide it.
#[derive(Clone, Copy)]
enum Around {
    Rectangle,
    Circle,
    Diameter,
    Width,
}

impl Around {
    fn named(name: &str) -> PyResult<Self> {
        Ok(match name {
            "minimum_rectangle" => Around::Rectangle,
            "minimum_circle" => Around::Circle,
            "diameter" => Around::Diameter,
            "width" => Around::Width,
            other => return Err(PyKeyError::new_err(other.to_owned())),
        })
    }
    fn fields(self) -> usize {
        match self {
            Around::Rectangle => 5,
            Around::Circle => 3,
            Around::Diameter | Around::Width => 1,
        }
    }
    /// Adds the numbers of the result; NaN where there is none.
    fn value<T: Format>(self, points: &[Vec2<T>], into: &mut Vec<T>) {
        let found = match self {
            Around::Rectangle => rectangle_search(points).map(|(found, _)| found.scalars()),
            Around::Circle => circle_search(points).map(|(found, _)| found.scalars()),
            Around::Diameter => diameter_search(points).map(|(found, _)| vec![found]),
            Around::Width => width_search(points).map(|(found, _)| vec![found]),
        };
        let nothing = || vec![T::narrowed(f64::NAN); self.fields()];
        into.extend(found.unwrap_or_else(nothing));
    }
    /// Adds the cotangents of the points that decide the result.
    fn pull<T: Format>(self, points: &[Vec2<T>], upstream: &[T], bars: &mut [Vec2<T>]) {
        match self {
            Around::Rectangle => {
                if let Some((_, on)) = rectangle_search(points) {
                    let places = [on.start, on.end, on.right, on.top, on.left];
                    let same = Resting {
                        start: 0,
                        end: 1,
                        right: 2,
                        top: 3,
                        left: 4,
                    };
                    pulled(points, places, upstream, bars, |p| -> Obb2<First<T>> {
                        rectangle_replay(p, same)
                    });
                }
            }
            Around::Circle => match circle_search(points) {
                None => {}
                Some((_, Support::One(k))) => {
                    pulled(points, [k], upstream, bars, |p| -> Circle<First<T>> {
                        circle_replay(p, Support::One(0))
                    });
                }
                Some((_, Support::Two(places))) => {
                    pulled(points, places, upstream, bars, |p| -> Circle<First<T>> {
                        circle_replay(p, Support::Two([0, 1]))
                    });
                }
                Some((_, Support::Three(places))) => {
                    pulled(points, places, upstream, bars, |p| -> Circle<First<T>> {
                        circle_replay(p, Support::Three([0, 1, 2]))
                    });
                }
            },
            Around::Diameter => {
                if let Some((_, on)) = diameter_search(points) {
                    let same = Farthest { from: 0, to: 1 };
                    pulled(
                        points,
                        [on.from, on.to],
                        upstream,
                        bars,
                        |p| -> [First<T>; 1] { [diameter_replay(p, same)] },
                    );
                }
            }
            Around::Width => {
                if let Some((_, on)) = width_search(points) {
                    let same = Narrowest {
                        start: 0,
                        end: 1,
                        across: 2,
                    };
                    let places = [on.start, on.end, on.across];
                    pulled(points, places, upstream, bars, |p| -> [First<T>; 1] {
                        [width_replay(p, same)]
                    });
                }
            }
        }
    }
}

/// Adds the cotangents of some points for those of a shape made of them.
fn pulled<T: Format, P: Pack<Scalar = First<T>>, const N: usize>(
    points: &[Vec2<T>],
    places: [usize; N],
    upstream: &[T],
    bars: &mut [Vec2<T>],
    made: impl Fn(&[Vec2<First<T>>]) -> P,
) {
    let (_, by) = geograd::gradient(
        |own: [Vec2<First<T>>; N]| dot(made(&own), upstream),
        places.map(|place| points[place]),
    );
    for (place, bar) in places.into_iter().zip(by) {
        bars[place] += bar;
    }
}

/// Returns the sum of the numbers of a shape times constants.
fn dot<T: Format, P: Pack<Scalar = First<T>>>(mut shape: P, by: &[T]) -> First<T> {
    let (mut sum, mut all) = (First::<T>::zero(), by.iter());
    shape.each(&mut |x| {
        if let Some(&by) = all.next() {
            sum += *x * Jet::variable(by, usize::MAX);
        }
    });
    sum
}

/// Fails unless offsets divide so many points.
fn check(offsets: &[usize], points: usize) -> PyResult<()> {
    let is_sorted = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
    match offsets.first() == Some(&0) && is_sorted && offsets.last() == Some(&points) {
        true => Ok(()),
        false => Err(PyValueError::new_err(format!(
            "offsets: they rise from 0 to {points}, the number of points"
        ))),
    }
}

/// Runs a function in the format of an array.
macro_rules! in_format_of {
    ($array:expr, $run:ident($($argument:expr),*)) => {
        match $array.cast::<PyArrayDyn<f64>>().is_ok() {
            true => $run::<f64>($($argument),*),
            false => $run::<f32>($($argument),*),
        }
    };
}

/// A shape around each set of points, or with cotangents of its numbers those of the points.
#[pyfunction]
#[pyo3(signature = (name, points, offsets, upstream=None))]
pub fn around_points<'py>(
    py: Python<'py>,
    name: &str,
    points: &Object<'py>,
    offsets: Vec<usize>,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    in_format_of!(
        points,
        around(py, Around::named(name)?, points, &offsets, upstream)
    )
}

fn around<'py, T: Format>(
    py: Python<'py>,
    around: Around,
    points: &Object<'py>,
    offsets: &[usize],
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let points = vectors::<T>(points)?;
    check(offsets, points.len())?;
    let (count, work) = (offsets.len() - 1, 8 * points.len());
    let set = |item: usize| &points[offsets[item]..offsets[item + 1]];
    let Some(upstream) = upstream else {
        let runs = in_runs(py, count, work, |run| {
            let mut values = Vec::with_capacity(run.len() * around.fields());
            run.for_each(|item| around.value(set(item), &mut values));
            values
        })?;
        let values = PyArray1::from_vec(py, runs.concat());
        return match around.fields() {
            1 => Ok(values.into_any()),
            fields => values.as_any().call_method1("reshape", ((count, fields),)),
        };
    };
    let upstream = upstream.cast::<PyArrayDyn<T>>()?.readonly();
    let failed = |error: numpy::AsSliceError| PyValueError::new_err(error.to_string());
    let upstream = upstream.as_slice().map_err(failed)?;
    let runs = in_runs(py, count, work, |run| {
        let mut bars = Vec::new();
        for item in run {
            let start = bars.len();
            bars.resize(start + set(item).len(), Vec2::zero());
            let own = &upstream[item * around.fields()..(item + 1) * around.fields()];
            around.pull(set(item), own, &mut bars[start..]);
        }
        bars
    })?;
    rows(py, &runs.concat())
}

/// The convex hull of each set of points, and the places of its vertices among the points. Points on a line have a hull
/// without parts.
#[pyfunction]
pub fn hulls_of_points<'py>(
    py: Python<'py>,
    points: &Object<'py>,
    offsets: Vec<usize>,
) -> PyResult<(Polygons, Bound<'py, PyArray1<i64>>)> {
    in_format_of!(points, hulls(py, points, &offsets))
}

fn hulls<'py, T: Format>(
    py: Python<'py>,
    points: &Object<'py>,
    offsets: &[usize],
) -> PyResult<(Polygons, Bound<'py, PyArray1<i64>>)> {
    let points = vectors::<T>(points)?;
    check(offsets, points.len())?;
    let runs = in_runs(py, offsets.len() - 1, 8 * points.len(), |run| {
        let hull = run.map(|item| {
            let mut hull = hull_search(&points[offsets[item]..offsets[item + 1]]);
            if hull.len() < 3 {
                hull.clear();
            }
            (offsets[item], hull)
        });
        hull.collect::<Vec<_>>()
    })?;
    let (mut layout, mut places) = (Layout::empty(), Vec::new());
    for (start, hull) in runs.into_iter().flatten() {
        if !hull.is_empty() {
            layout.add_ring(hull.len());
            layout.end_part();
        }
        layout.end_polygon();
        places.extend(hull.into_iter().map(|k| start + k));
    }
    let vertices = places.iter().map(|&k| points[k]).collect();
    let places = PyArray1::from_iter(py, places.into_iter().map(|k| k as i64));
    Ok((Polygons::of(Arc::new(layout), T::kept(vertices)), places))
}

fn spatial(numbers: &[f64]) -> Vec<Vec3<f64>> {
    let (all, _) = numbers.as_chunks::<3>();
    all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect()
}

/// The motion and the scale that bring points closest to targets, and with cotangents of the eight numbers those of
/// points, targets and weights.
#[pyfunction]
#[pyo3(signature = (points, targets, weights, is_rigid, upstream=None))]
pub fn align_points(
    py: Python<'_>,
    points: Vec<f64>,
    targets: Vec<f64>,
    weights: Vec<f64>,
    is_rigid: bool,
    upstream: Option<Vec<f64>>,
) -> PyResult<Vec<Vec<f64>>> {
    type Given<S> = ((Vec<Vec3<S>>, Vec<Vec3<S>>), Vec<S>);
    fn found<S: Scalar>(
        ((points, targets), weights): &Given<S>,
        is_rigid: bool,
    ) -> Result<(Pose3<S>, S), Error> {
        match is_rigid {
            true => Ok((procrustes_rigid(points, targets, weights)?, S::one())),
            false => {
                let found = aligned(points, targets, weights)?;
                Ok((found.pose, found.scale))
            }
        }
    }
    let given: Given<f64> = ((spatial(&points), spatial(&targets)), weights);
    py.detach(|| {
        let value = found(&given, is_rigid)?;
        let mut results = vec![value.scalars()];
        if let Some(upstream) = upstream {
            let of = |own: Given<First<f64>>| match found(&own, is_rigid) {
                Ok(made) => dot(made, &upstream),
                Err(_) => First::<f64>::zero(),
            };
            let (_, ((by_points, by_targets), by_weights)) = geograd::gradient(of, given);
            results.extend([by_points.scalars(), by_targets.scalars(), by_weights]);
        }
        Ok(results)
    })
    .map_err(raised)
}
