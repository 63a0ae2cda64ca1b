//! Clouds of points of space with their trees.
use crate::mesh_arrays::{in_space, vectors, whole};
use crate::polygon_calls::numbers;
use crate::raised;
use crate::threads::on_threads;
use geograd::Error;
use geograd::cloud::{Cloud, CloudFault, OwnedCloud};
use geograd::kernels::Cpu;
use geograd::kernels::cpu::cloud_batches::PointDistance;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// Points of space, with the tree that queries use.
#[pyclass(frozen, module = "geograd._core")]
pub struct CloudCore {
    owned: OwnedCloud<f64>,
}

fn refused(fault: CloudFault) -> PyErr {
    PyValueError::new_err(fault.to_string())
}

fn kind(squared: bool) -> PointDistance {
    match squared {
        true => PointDistance::Squared,
        false => PointDistance::Plain,
    }
}

fn indices(array: &Object<'_>) -> PyResult<Vec<u32>> {
    // Beyond all points, which the library refuses.
    let index = |k: i64| u32::try_from(k).unwrap_or(u32::MAX);
    Ok(whole(array)?.into_iter().map(index).collect())
}

/// Returns lists one after another, and where each starts.
fn ragged(py: Python<'_>, lists: Vec<Vec<u32>>) -> PyResult<Object<'_>> {
    let mut offsets = vec![0_i64];
    let mut all = Vec::new();
    for list in lists {
        all.extend(list.into_iter().map(i64::from));
        offsets.push(all.len() as i64);
    }
    let both = (PyArray1::from_vec(py, all), PyArray1::from_vec(py, offsets));
    Ok(both.into_pyobject(py)?.into_any())
}

impl CloudCore {
    fn cloud<R: Send>(
        &self,
        py: Python<'_>,
        count: usize,
        run: impl FnOnce(&Cloud<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        on_threads(py, 64 * count, || run(&self.owned.cloud()))?.map_err(raised)
    }
    fn both<R: Send>(
        &self,
        py: Python<'_>,
        other: &CloudCore,
        run: impl FnOnce(&Cloud<'_, f64>, &Cloud<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        let (own, second) = (self.owned.cloud(), other.owned.cloud());
        let count = 64 * (own.points().len() + second.points().len());
        on_threads(py, count, || run(&own, &second))?.map_err(raised)
    }
}

#[pymethods]
impl CloudCore {
    #[new]
    fn new(points: &Object<'_>) -> PyResult<Self> {
        let owned = OwnedCloud::new(vectors(points)?).map_err(refused)?;
        Ok(CloudCore { owned })
    }
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        in_space(py, self.owned.cloud().points())
    }
    /// The nearest points of queries.
    fn search<'py>(&self, py: Python<'py>, queries: &Object<'py>) -> PyResult<Object<'py>> {
        let queries = vectors(queries)?;
        let run = |cloud: &Cloud<'_, f64>| Cpu::new().nearest_points(cloud, &queries);
        let found = self.cloud(py, queries.len(), run)?;
        let found = found.into_iter().map(i64::from).collect();
        Ok(PyArray1::from_vec(py, found).into_any())
    }
    /// The distances of queries from points, or the cotangents of both from those of distances.
    #[pyo3(signature = (squared, queries, found, upstream=None))]
    fn distances<'py>(
        &self,
        py: Python<'py>,
        squared: bool,
        queries: &Object<'py>,
        found: &Object<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (queries, found, kind) = (vectors(queries)?, indices(found)?, kind(squared));
        let cpu = Cpu::new();
        let Some(upstream) = upstream else {
            let values = self.cloud(py, queries.len(), |cloud| {
                cpu.point_distances(kind, cloud, &queries, &found)
            })?;
            return Ok(PyArray1::from_vec(py, values).into_any());
        };
        let upstream = numbers(upstream)?;
        let bars = self.cloud(py, queries.len(), |cloud| {
            cpu.point_distances_vjp(kind, cloud, &queries, &found, &upstream)
        })?;
        let both = (in_space(py, &bars.queries)?, in_space(py, &bars.points)?);
        Ok(both.into_pyobject(py)?.into_any())
    }
    /// The indices of some nearest points of each query, one row each.
    fn some<'py>(
        &self,
        py: Python<'py>,
        queries: &Object<'py>,
        count: usize,
    ) -> PyResult<Object<'py>> {
        let queries = vectors(queries)?;
        let run = |cloud: &Cloud<'_, f64>| Cpu::new().nearest_some_points(cloud, &queries, count);
        ragged(py, self.cloud(py, queries.len() * count, run)?)
    }
    /// The indices of the points within a radius of each query, one query after another, and where each starts.
    fn within<'py>(
        &self,
        py: Python<'py>,
        queries: &Object<'py>,
        radius: f64,
    ) -> PyResult<Object<'py>> {
        let queries = vectors(queries)?;
        let run = |cloud: &Cloud<'_, f64>| Cpu::new().points_within(cloud, &queries, radius);
        ragged(py, self.cloud(py, queries.len(), run)?)
    }
    /// The Chamfer distance, or the cotangents of the points of both clouds from its own.
    #[pyo3(signature = (other, squared, upstream=None))]
    fn chamfer<'py>(
        &self,
        py: Python<'py>,
        other: &CloudCore,
        squared: bool,
        upstream: Option<f64>,
    ) -> PyResult<Object<'py>> {
        let (cpu, kind) = (Cpu::new(), kind(squared));
        let Some(upstream) = upstream else {
            let value = self.both(py, other, |a, b| cpu.chamfer(kind, a, b))?;
            return Ok(value.into_pyobject(py)?.into_any());
        };
        let [own, second] = self.both(py, other, |a, b| cpu.chamfer_vjp(kind, [a, b], upstream))?;
        let both = (in_space(py, &own)?, in_space(py, &second)?);
        Ok(both.into_pyobject(py)?.into_any())
    }
    /// The Hausdorff distance, and the pair that decides it: a point of each cloud.
    fn hausdorff(&self, py: Python<'_>, other: &CloudCore) -> PyResult<(f64, u32, u32)> {
        let found = self.both(py, other, |a, b| Cpu::new().hausdorff(a, b))?;
        let (own, second) = match found.from_second {
            true => (found.nearest, found.point),
            false => (found.point, found.nearest),
        };
        Ok((found.distance, own, second))
    }
    /// The F-score at a threshold.
    fn f_score(&self, py: Python<'_>, other: &CloudCore, threshold: f64) -> PyResult<f64> {
        self.both(py, other, |a, b| Cpu::new().f_score(a, b, threshold))
    }
}
