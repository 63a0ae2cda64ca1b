//! Cells of sites in a polygon.
use crate::polygon_calls::numbers;
use crate::raised;
use geograd::ad::adjoint::cells::{DiagramBars, centroids_vjp, moments_vjp};
use geograd::cells::{CellMoments, CellTrace, Cells, PowerDiagram};
use geograd::{Polygon, Rings, Vec2};
use numpy::PyArray1;
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// Sites, weights, a domain, and what bounds each cell.
#[pyclass(frozen, module = "geograd._core")]
pub struct CellsCore {
    sites: Vec<Vec2<f64>>,
    weights: Vec<f64>,
    domain: Polygon<f64>,
    trace: CellTrace,
}

/// Reads an array of points.
pub fn vectors(array: &Object<'_>) -> PyResult<Vec<Vec2<f64>>> {
    let all = numbers::<f64>(array)?;
    let (all, _) = all.as_chunks::<2>();
    Ok(all.iter().map(|&[x, y]| Vec2::new(x, y)).collect())
}
/// Returns an array of shape (N, 2).
pub fn in_plane<'py>(
    py: Python<'py>,
    all: impl Iterator<Item = Vec2<f64>>,
) -> PyResult<Object<'py>> {
    let flat: Vec<f64> = all.flat_map(|v| [v.x, v.y]).collect();
    let count = flat.len() / 2;
    PyArray1::from_vec(py, flat)
        .as_any()
        .call_method1("reshape", ((count, 2),))
}
type Bars<'py> = (Object<'py>, Bound<'py, PyArray1<f64>>, Object<'py>);
fn bars<'py>(py: Python<'py>, found: DiagramBars<f64>) -> PyResult<Bars<'py>> {
    Ok((
        in_plane(py, found.sites.into_iter())?,
        PyArray1::from_vec(py, found.weights),
        in_plane(py, found.domain.into_iter())?,
    ))
}

/// Rows, columns and values of a sparse matrix, the numbers of a block after each other.
type Sparse<'py> = (
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<f64>>,
);
fn sparse<'py, T: Copy, N: IntoIterator<Item = f64>>(
    py: Python<'py>,
    all: &[(usize, usize, T)],
    numbers: impl Fn(T) -> N,
) -> Sparse<'py> {
    (
        PyArray1::from_iter(py, all.iter().map(|own| own.0 as i64)),
        PyArray1::from_iter(py, all.iter().map(|own| own.1 as i64)),
        PyArray1::from_iter(py, all.iter().flat_map(|own| numbers(own.2))),
    )
}

impl CellsCore {
    fn with<R: Send>(
        &self,
        py: Python<'_>,
        f: impl FnOnce(&Cells<'_, '_, f64>) -> R + Send,
    ) -> PyResult<R> {
        py.detach(|| {
            let diagram = PowerDiagram::new(&self.sites, &self.weights, &self.domain)?;
            Ok(f(&diagram.cells(&self.trace)))
        })
        .map_err(raised)
    }
    fn known(&self, site: usize) -> PyResult<usize> {
        if site < self.sites.len() {
            return Ok(site);
        }
        let text = format!("site {site} of {}", self.sites.len());
        Err(PyIndexError::new_err(text))
    }
}

#[pymethods]
impl CellsCore {
    #[new]
    fn new(
        py: Python<'_>,
        sites: &Object<'_>,
        weights: &Object<'_>,
        vertices: &Object<'_>,
        ends: Vec<usize>,
    ) -> PyResult<Self> {
        let (sites, weights) = (vectors(sites)?, numbers(weights)?);
        let vertices = vectors(vertices)?;
        let domain = Rings::flat(&vertices, &ends).to_polygon();
        let trace = py
            .detach(|| PowerDiagram::new(&sites, &weights, &domain).map(|diagram| diagram.search()))
            .map_err(raised)?;
        Ok(CellsCore {
            sites,
            weights,
            domain,
            trace,
        })
    }
    /// Returns areas, first and second moments about the sites.
    fn moments<'py>(&self, py: Python<'py>) -> PyResult<Bars<'py>> {
        let all = self.with(py, |cells| cells.moments())?;
        let first = in_plane(py, all.iter().map(|own| own.first))?;
        let second: Vec<f64> = all.iter().map(|own| own.second).collect();
        let area: Vec<f64> = all.iter().map(|own| own.area).collect();
        Ok((
            first,
            PyArray1::from_vec(py, area),
            PyArray1::from_vec(py, second).into_any(),
        ))
    }
    fn centroids<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        let all = self.with(py, |cells| cells.centroids())?;
        in_plane(py, all.into_iter())
    }
    fn energy(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |cells| cells.energy())
    }
    /// Returns cotangents of sites, weights and vertices of the domain from those of moments.
    fn moments_vjp<'py>(
        &self,
        py: Python<'py>,
        area: &Object<'_>,
        first: &Object<'_>,
        second: &Object<'_>,
    ) -> PyResult<Bars<'py>> {
        let all = numbers(area)?
            .into_iter()
            .zip(vectors(first)?)
            .zip(numbers(second)?);
        let all: Vec<_> = all
            .map(|((area, first), second)| CellMoments {
                area,
                first,
                second,
            })
            .collect();
        let found = self.with(py, |cells| moments_vjp(cells, &all))?;
        bars(py, found)
    }
    /// Returns cotangents of sites, weights and vertices of the domain from those of centroids.
    fn centroids_vjp<'py>(&self, py: Python<'py>, centroids: &Object<'_>) -> PyResult<Bars<'py>> {
        let all = vectors(centroids)?;
        let found = self.with(py, |cells| centroids_vjp(cells, &all))?;
        bars(py, found)
    }
    /// Returns rows, columns and values of the derivatives of areas by weights.
    fn area_slopes<'py>(&self, py: Python<'py>) -> PyResult<Sparse<'py>> {
        let all = self.with(py, |cells| cells.area_slopes())?;
        Ok(sparse(py, &all, |slope| [slope]))
    }
    /// Returns rows, columns and blocks, of nine numbers each, of the Hessian of the energy by x, y and weight of sites.
    fn energy_hessian<'py>(&self, py: Python<'py>) -> PyResult<Sparse<'py>> {
        let all = self.with(py, |cells| cells.energy_hessian())?;
        Ok(sparse(py, &all, |block| block.into_iter().flatten()))
    }
    /// Returns whether each site has no cell.
    fn hidden<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let all = (0..self.sites.len()).map(|i| self.trace.is_hidden(i));
        PyArray1::from_iter(py, all)
    }
    fn neighbours<'py>(&self, py: Python<'py>, site: usize) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let all = self.trace.neighbours(self.known(site)?);
        Ok(PyArray1::from_iter(py, all.into_iter().map(|i| i as i64)))
    }
    /// Returns the vertices of a cell, and how many there are up to the end of each ring.
    fn rings<'py>(&self, py: Python<'py>, site: usize) -> PyResult<(Object<'py>, Vec<usize>)> {
        let site = self.known(site)?;
        let polygon = self.with(py, |cells| cells.polygon(site))?;
        let vertices = in_plane(py, polygon.vertices().iter().copied())?;
        Ok((vertices, polygon.ends().to_vec()))
    }
}
