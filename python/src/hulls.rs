//! Measures of convex hulls of points of space, set by set, on all cores.
use crate::arrays::offsets;
use crate::polygon_calls::{in_format, in_runs, numbers};
use crate::polygons::Format;
use crate::raised;
use geograd::error::{Argument, Validate};
use geograd::hull3::{HullFaces, hull_search};
use geograd::{Error, Scalar, Vec3, ad};
use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// The numbers of a point.
const POINT: usize = 3;

/// A measure of hulls.
#[derive(Clone, Copy)]
enum Measure {
    Volume,
    Surface,
    Centroid,
}

impl Measure {
    fn named(name: &str) -> PyResult<Self> {
        Ok(match name {
            "hull_volume" => Measure::Volume,
            "hull_surface" => Measure::Surface,
            "hull_centroid" => Measure::Centroid,
            other => return Err(PyKeyError::new_err(other.to_owned())),
        })
    }
    /// Returns the numbers of the result.
    fn of<S: Scalar>(self, faces: &HullFaces, points: &[Vec3<S>]) -> Vec<S> {
        match self {
            Measure::Volume => vec![faces.volume(points)],
            Measure::Surface => vec![faces.surface(points)],
            Measure::Centroid => {
                let Vec3 { x, y, z } = faces.centroid(points);
                vec![x, y, z]
            }
        }
    }
    /// Returns the sum of the numbers of the result, each times a factor.
    fn weighted<T: Format, S: Scalar<Primal = T>>(
        self,
        faces: &HullFaces,
        points: &[Vec3<S>],
        factors: &[T],
    ) -> S {
        let values = self.of(faces, points).into_iter().zip(factors);
        values.fold(S::zero(), |sum, (value, &factor)| {
            sum + value * S::from_primal(factor)
        })
    }
    fn width(self) -> usize {
        match self {
            Measure::Centroid => POINT,
            _ => 1,
        }
    }
}

/// Reads sets of points, one after the other, and where each starts.
fn sets<T: Format>(
    py: Python<'_>,
    points: &Object<'_>,
    starts: &Object<'_>,
) -> PyResult<(Vec<Vec3<T>>, Vec<usize>)> {
    let (all, starts) = (numbers::<T>(points)?, offsets(py, starts, "offsets")?);
    let (rows, _) = all.as_chunks::<POINT>();
    let points: Vec<Vec3<T>> = rows.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect();
    if starts.first() != Some(&0) || starts.last() != Some(&points.len()) || !starts.is_sorted() {
        return Err(PyValueError::new_err(
            "offsets: they rise from 0 to the number of vertices",
        ));
    }
    for (item, point) in points.iter().enumerate() {
        point.validate().map_err(|flaw| {
            raised(Error::Invalid {
                argument: Argument::Named("vertices"),
                item,
                flaw,
            })
        })?;
    }
    Ok((points, starts))
}

/// A measure of the hull of every set: its values, or with cotangents of these those of all points.
#[pyfunction]
#[pyo3(signature = (name, points, starts, upstream=None))]
pub fn hull_measure<'py>(
    py: Python<'py>,
    name: &str,
    points: &Object<'py>,
    starts: &Object<'py>,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let is_double = points.cast::<PyArrayDyn<f64>>().is_ok();
    let measure = Measure::named(name)?;
    in_format!(is_double, measured(py, measure, points, starts, upstream))
}

fn measured<'py, T: Format>(
    py: Python<'py>,
    measure: Measure,
    points: &Object<'py>,
    starts: &Object<'py>,
    upstream: Option<&Object<'py>>,
) -> PyResult<Object<'py>> {
    let (points, starts) = sets::<T>(py, points, starts)?;
    let (count, width) = (starts.len() - 1, measure.width());
    let set = |item: usize| &points[starts[item]..starts[item + 1]];
    // A search takes about as long as so many numbers do elsewhere.
    let work = points.len().saturating_mul(64);
    let Some(upstream) = upstream else {
        let runs = in_runs(py, count, work, |run| {
            let values = run
                .map(set)
                .flat_map(|own| measure.of(&hull_search(own), own));
            values.collect::<Vec<T>>()
        })?;
        return Ok(PyArray1::from_vec(py, runs.concat()).into_any());
    };
    let upstream = numbers::<T>(upstream)?;
    let runs = in_runs(py, count, work, |run| {
        let mut bars = Vec::new();
        for item in run {
            let (own, bar) = (set(item), &upstream[item * width..][..width]);
            let corners = hull_search(own).corners().to_vec();
            // The hull of the corners alone: others have derivative zero.
            let few: Vec<Vec3<T>> = corners.iter().map(|&k| own[k]).collect();
            let faces = hull_search(&few);
            let sum = |points: Vec<Vec3<_>>| measure.weighted(&faces, &points, bar);
            let (_, by_corner) = ad::gradient(sum, few);
            let from = bars.len();
            bars.resize(from + POINT * own.len(), T::narrowed(0.0));
            for (corner, by) in corners.into_iter().zip(by_corner) {
                bars[from + POINT * corner..][..POINT].copy_from_slice(&[by.x, by.y, by.z]);
            }
        }
        bars
    })?;
    Ok(PyArray1::from_vec(py, runs.concat()).into_any())
}

/// The corners of every face of the hull of every set, counter-clockwise seen from outside, as places among all points;
/// then where each face starts among these, and each hull among the faces.
#[pyfunction]
pub fn hull_faces<'py>(
    py: Python<'py>,
    points: &Object<'py>,
    starts: &Object<'py>,
) -> PyResult<Object<'py>> {
    let is_double = points.cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(is_double, faces_of(py, points, starts))
}

fn faces_of<'py, T: Format>(
    py: Python<'py>,
    points: &Object<'py>,
    starts: &Object<'py>,
) -> PyResult<Object<'py>> {
    let (points, starts) = sets::<T>(py, points, starts)?;
    let work = points.len().saturating_mul(64);
    let runs = in_runs(py, starts.len() - 1, work, |run| {
        let found = run.map(|item| {
            let first = starts[item];
            let faces = hull_search(&points[first..starts[item + 1]]);
            let placed = |face: &[usize]| face.iter().map(|k| first + k).collect();
            faces.faces().map(placed).collect::<Vec<Vec<usize>>>()
        });
        found.collect::<Vec<_>>()
    })?;
    let (mut corners, mut ends, mut hulls) = (Vec::new(), vec![0], vec![0]);
    for faces in runs.concat() {
        for face in faces {
            corners.extend(face.into_iter().map(|k| k as i64));
            ends.push(corners.len() as i64);
        }
        hulls.push(ends.len() as i64 - 1);
    }
    let arrays = [corners, ends, hulls].map(|own| PyArray1::from_vec(py, own));
    Ok(arrays.into_pyobject(py)?.into_any())
}
