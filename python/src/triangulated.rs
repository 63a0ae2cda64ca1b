//! Delaunay triangulations of points.
use crate::cell_calls::{in_plane, vectors};
use crate::polygon_calls::numbers;
use crate::raised;
use geograd::Vec2;
use geograd::delaunay::Delaunay;
use numpy::PyArray1;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;
type Indices<'py> = Bound<'py, PyArray1<i64>>;

/// Points and their triangulation.
#[pyclass(frozen, module = "geograd._core")]
pub struct DelaunayCore {
    points: Vec<Vec2<f64>>,
    found: Delaunay,
}

fn of_indices<'py>(py: Python<'py>, all: impl Iterator<Item = u32>) -> Indices<'py> {
    PyArray1::from_iter(py, all.map(i64::from))
}

#[pymethods]
impl DelaunayCore {
    #[new]
    fn new(py: Python<'_>, points: &Object<'_>) -> PyResult<Self> {
        let points = vectors(points)?;
        let found = py.detach(|| Delaunay::search(&points)).map_err(raised)?;
        Ok(DelaunayCore { points, found })
    }
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        in_plane(py, self.points.iter().copied())
    }
    fn triangles<'py>(&self, py: Python<'py>) -> Indices<'py> {
        of_indices(py, self.found.triangles().iter().flatten().copied())
    }
    /// Returns the neighbours opposite each corner, −1 at the hull.
    fn neighbours<'py>(&self, py: Python<'py>) -> Indices<'py> {
        let all = self.found.neighbours().iter().flatten();
        PyArray1::from_iter(py, all.map(|side| side.map_or(-1, i64::from)))
    }
    fn hull<'py>(&self, py: Python<'py>) -> Indices<'py> {
        of_indices(py, self.found.hull().iter().copied())
    }
    fn firsts<'py>(&self, py: Python<'py>) -> Indices<'py> {
        of_indices(py, self.found.firsts().iter().copied())
    }
    fn edges<'py>(&self, py: Python<'py>) -> Indices<'py> {
        of_indices(py, self.found.edges().into_iter().flatten())
    }
    fn areas<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.found.areas(&self.points))
    }
    /// Returns the triangle around each place, −1 outside of all.
    fn locate<'py>(&self, py: Python<'py>, places: &Object<'py>) -> PyResult<Indices<'py>> {
        let places = vectors(places)?;
        let found = py.detach(|| self.found.locate(&self.points, &places));
        let all = found.into_iter().map(|own| own.map_or(-1, i64::from));
        Ok(PyArray1::from_iter(py, all))
    }
    /// Returns the triangle around each place, −1 outside of all, and the weights of its corners, three each.
    fn barycentric<'py>(
        &self,
        py: Python<'py>,
        places: &Object<'py>,
    ) -> PyResult<(Indices<'py>, Bound<'py, PyArray1<f64>>)> {
        let places = vectors(places)?;
        let found = py.detach(|| self.found.barycentric(&self.points, &places));
        let numbers = found
            .iter()
            .map(|own| own.map_or(-1, |own| i64::from(own.triangle)));
        let weights = found
            .iter()
            .flat_map(|own| own.map_or([0.0; 3], |own| own.weights));
        Ok((
            PyArray1::from_iter(py, numbers),
            PyArray1::from_iter(py, weights),
        ))
    }
    /// Returns cotangents of the points and of the places from those of the weights.
    fn barycentric_vjp<'py>(
        &self,
        py: Python<'py>,
        places: &Object<'py>,
        upstream: &Object<'py>,
    ) -> PyResult<[Object<'py>; 2]> {
        let (places, upstream) = (vectors(places)?, numbers::<f64>(upstream)?);
        let [by_points, by_places] = py.detach(|| {
            let found = self.found.barycentric(&self.points, &places);
            let bars = upstream.as_chunks().0;
            self.found
                .barycentric_vjp(&self.points, &places, &found, bars)
        });
        Ok([
            in_plane(py, by_points.into_iter())?,
            in_plane(py, by_places.into_iter())?,
        ])
    }
    /// Returns centres and radii.
    fn circles<'py>(&self, py: Python<'py>) -> PyResult<(Object<'py>, Bound<'py, PyArray1<f64>>)> {
        let all = self.found.circumcircles(&self.points);
        let centers = in_plane(py, all.iter().map(|own| own.center))?;
        Ok((
            centers,
            PyArray1::from_iter(py, all.iter().map(|own| own.radius)),
        ))
    }
    fn areas_vjp<'py>(&self, py: Python<'py>, upstream: &Object<'py>) -> PyResult<Object<'py>> {
        let upstream = numbers::<f64>(upstream)?;
        let mut bars = vec![Vec2::zero(); self.points.len()];
        for (corners, bar) in self.found.triangles().iter().zip(upstream) {
            let [a, b, c] = corners.map(|k| self.points[k as usize]);
            // Half of the opposite side, turned inward.
            for (&corner, side) in corners.iter().zip([c - b, a - c, b - a]) {
                bars[corner as usize] += side.perp() * (0.5 * bar);
            }
        }
        in_plane(py, bars.into_iter())
    }
}
