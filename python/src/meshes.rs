//! Meshes of triangles with their trees.
use crate::polygon_calls::numbers;
use crate::raised;
use crate::threads::on_threads;
use geograd::Error;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::mesh::Mesh as Columns;
use geograd::mesh::{ClosedMesh, FaceFeature, FaceRecord, MeshFault, MeshSurface, MeshTree};
use geograd::{Ray3, Vec3};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use std::sync::{Arc, OnceLock};

type Object<'py> = Bound<'py, PyAny>;

/// A mesh of triangles, with the tree that queries use.
#[pyclass(frozen, module = "geograd._core")]
pub struct MeshCore {
    vertices: Vec<Vec3<f64>>,
    faces: Arc<Vec<[u32; 3]>>,
    tree: MeshTree,
    closed: OnceLock<Arc<ClosedMesh>>,
}

fn refused(fault: MeshFault) -> PyErr {
    PyValueError::new_err(fault.to_string())
}

/// Returns the numbers of an array of rows.
fn vectors(array: &Object<'_>) -> PyResult<Vec<Vec3<f64>>> {
    let array = array.cast::<PyArrayDyn<f64>>()?.readonly();
    let (all, _) = array.as_slice()?.as_chunks::<3>();
    Ok(all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect())
}

fn whole(array: &Object<'_>) -> PyResult<Vec<i64>> {
    let array = array.cast::<PyArrayDyn<i64>>()?.readonly();
    Ok(array.as_slice()?.to_vec())
}

fn rows<'py, T: numpy::Element, const N: usize>(
    py: Python<'py>,
    all: Vec<[T; N]>,
) -> PyResult<Object<'py>> {
    let count = all.len();
    PyArray1::from_vec(py, all.into_flattened())
        .as_any()
        .call_method1("reshape", ((count, N),))
}

fn in_space<'py>(py: Python<'py>, all: &[Vec3<f64>]) -> PyResult<Object<'py>> {
    rows(py, all.iter().map(|v| [v.x, v.y, v.z]).collect())
}

/// Features as numbers: 0 the interior, 1 to 3 corners, from 4 on edges.
fn coded(feature: FaceFeature) -> i64 {
    match feature {
        FaceFeature::Interior => 0,
        FaceFeature::Vertex { corner } => 1 + i64::from(corner),
        FaceFeature::Edge { from, to } => 4 + 3 * i64::from(from) + i64::from(to),
    }
}

fn records(array: &Object<'_>) -> PyResult<Vec<FaceRecord>> {
    let all = whole(array)?;
    let (all, _) = all.as_chunks::<2>();
    let record = |&[face, code]: &[i64; 2]| FaceRecord {
        // Beyond all faces, which the library refuses.
        face: u32::try_from(face).unwrap_or(u32::MAX),
        feature: match code {
            0 => FaceFeature::Interior,
            1..=3 => FaceFeature::Vertex {
                corner: (code - 1) as u8,
            },
            code => {
                let code = u8::try_from(code - 4).unwrap_or(u8::MAX);
                FaceFeature::Edge {
                    from: code / 3,
                    to: code % 3,
                }
            }
        },
    };
    Ok(all.iter().map(record).collect())
}

fn rays(starts: &Object<'_>, directions: &Object<'_>) -> PyResult<Vec<Ray3<f64>>> {
    let both = vectors(starts)?.into_iter().zip(vectors(directions)?);
    Ok(both
        .map(|(point, direction)| Ray3 { point, direction })
        .collect())
}

fn hit_faces(array: &Object<'_>) -> PyResult<Vec<Option<u32>>> {
    let face = |face: i64| (face >= 0).then(|| u32::try_from(face).unwrap_or(u32::MAX));
    Ok(whole(array)?.into_iter().map(face).collect())
}

impl MeshCore {
    fn surface<R: Send>(
        &self,
        py: Python<'_>,
        count: usize,
        run: impl FnOnce(&MeshSurface<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        let found = on_threads(py, 64 * count, || -> Result<_, MeshFault> {
            let mesh = Columns::new(&self.vertices, &self.faces)?;
            let surface = self.tree.on(&mesh)?;
            Ok(run(&surface))
        })?;
        found.map_err(refused)?.map_err(raised)
    }
    fn closed(&self) -> PyResult<Arc<ClosedMesh>> {
        if let Some(closed) = self.closed.get() {
            return Ok(closed.clone());
        }
        let mesh = Columns::new(&self.vertices, &self.faces).map_err(refused)?;
        let closed = Arc::new(ClosedMesh::new(&mesh).map_err(refused)?);
        Ok(self.closed.get_or_init(|| closed).clone())
    }
    /// Runs with a distance by its name.
    fn with_kind<R>(
        &self,
        kind: &str,
        run: impl FnOnce(MeshDistance<'_>) -> PyResult<R>,
    ) -> PyResult<R> {
        match kind {
            "distance" => run(MeshDistance::Plain),
            "squared_distance" => run(MeshDistance::Squared),
            "signed_distance" => run(MeshDistance::Signed(&*self.closed()?)),
            other => Err(PyKeyError::new_err(other.to_owned())),
        }
    }
}

#[pymethods]
impl MeshCore {
    #[new]
    fn new(vertices: &Object<'_>, faces: &Object<'_>) -> PyResult<Self> {
        let vertices = vectors(vertices)?;
        let indices = whole(faces)?;
        if let Some(k) = indices.iter().position(|&i| u32::try_from(i).is_err()) {
            return Err(PyValueError::new_err(format!(
                "corner {} of face {} is vertex {}, which the mesh does not have",
                k % 3,
                k / 3,
                indices[k]
            )));
        }
        let (all, _) = indices.as_chunks::<3>();
        let faces: Vec<[u32; 3]> = all.iter().map(|face| face.map(|i| i as u32)).collect();
        let tree = MeshTree::new(&Columns::new(&vertices, &faces).map_err(refused)?);
        Ok(MeshCore {
            vertices,
            faces: Arc::new(faces),
            tree,
            closed: OnceLock::new(),
        })
    }
    /// The mesh with its vertices at other places: the tree follows them.
    fn moved(&self, vertices: &Object<'_>) -> PyResult<Self> {
        let vertices = vectors(vertices)?;
        let mut tree = self.tree.clone();
        let mesh = Columns::new(&vertices, &self.faces).map_err(refused)?;
        tree.refit(&mesh).map_err(refused)?;
        Ok(MeshCore {
            vertices,
            faces: self.faces.clone(),
            tree,
            closed: self.closed.clone(),
        })
    }
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        in_space(py, &self.vertices)
    }
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        let faces = self.faces.iter();
        rows(py, faces.map(|face| face.map(i64::from)).collect())
    }
    /// The nearest faces of points and their features, as numbers.
    fn search<'py>(&self, py: Python<'py>, points: &Object<'py>) -> PyResult<Object<'py>> {
        let points = vectors(points)?;
        let found = self.surface(py, points.len(), |surface| {
            Cpu::new().nearest_faces(surface, &points)
        })?;
        let pair = |record: FaceRecord| [i64::from(record.face), coded(record.feature)];
        rows(py, found.into_iter().map(pair).collect())
    }
    /// The closest points along records, or the cotangents of points and vertices from those of closest points.
    #[pyo3(signature = (points, found, upstream=None))]
    fn closest<'py>(
        &self,
        py: Python<'py>,
        points: &Object<'py>,
        found: &Object<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (points, found) = (vectors(points)?, records(found)?);
        let cpu = Cpu::new();
        let Some(upstream) = upstream else {
            let run = |surface: &MeshSurface<'_, f64>| cpu.closest_points(surface, &points, &found);
            return in_space(py, &self.surface(py, points.len(), run)?);
        };
        let upstream = vectors(upstream)?;
        let bars = self.surface(py, points.len(), |surface| {
            cpu.closest_points_vjp(surface, &points, &found, &upstream)
        })?;
        let both = (in_space(py, &bars.queries)?, in_space(py, &bars.vertices)?);
        Ok(both.into_pyobject(py)?.into_any())
    }
    /// The distances of points along records, or the cotangents of points and vertices from those of distances.
    #[pyo3(signature = (kind, points, found, upstream=None))]
    fn distances<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
        points: &Object<'py>,
        found: &Object<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (points, found) = (vectors(points)?, records(found)?);
        let cpu = Cpu::new();
        self.with_kind(kind, |kind| {
            let Some(upstream) = upstream else {
                let values = self.surface(py, points.len(), |surface| {
                    cpu.mesh_distances(kind, surface, &points, &found)
                })?;
                return Ok(PyArray1::from_vec(py, values).into_any());
            };
            let upstream = numbers(upstream)?;
            let bars = self.surface(py, points.len(), |surface| {
                cpu.mesh_distances_vjp(kind, surface, &points, &found, &upstream)
            })?;
            let both = (in_space(py, &bars.queries)?, in_space(py, &bars.vertices)?);
            Ok(both.into_pyobject(py)?.into_any())
        })
    }
    /// The first faces that rays meet; −1 for a miss.
    fn hit_faces<'py>(
        &self,
        py: Python<'py>,
        starts: &Object<'py>,
        directions: &Object<'py>,
    ) -> PyResult<Object<'py>> {
        let rays = rays(starts, directions)?;
        let found = self.surface(py, rays.len(), |surface| {
            Cpu::new().hit_faces(surface, &rays)
        })?;
        let face = |face: Option<u32>| face.map_or(-1, i64::from);
        Ok(PyArray1::from_vec(py, found.into_iter().map(face).collect()).into_any())
    }
    /// The parameters of hits, infinite for a miss, or the cotangents of starts, directions and vertices from those of
    /// parameters.
    #[pyo3(signature = (starts, directions, faces, upstream=None))]
    fn parameters<'py>(
        &self,
        py: Python<'py>,
        starts: &Object<'py>,
        directions: &Object<'py>,
        faces: &Object<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (rays, faces) = (rays(starts, directions)?, hit_faces(faces)?);
        let cpu = Cpu::new();
        let Some(upstream) = upstream else {
            let hits = self.surface(py, rays.len(), |surface| {
                cpu.first_hits(surface, &rays, &faces)
            })?;
            let values = hits.into_iter().map(|hit| match hit {
                Some(found) => found.hit.parameter,
                None => f64::INFINITY,
            });
            return Ok(PyArray1::from_vec(py, values.collect()).into_any());
        };
        let upstream = numbers(upstream)?;
        let bars = self.surface(py, rays.len(), |surface| {
            cpu.first_hits_vjp(surface, &rays, &faces, &upstream)
        })?;
        let of = |part: fn(&Ray3<f64>) -> Vec3<f64>| -> Vec<_> {
            bars.queries.iter().map(part).collect()
        };
        let starts = in_space(py, &of(|ray| ray.point))?;
        let directions = in_space(py, &of(|ray| ray.direction))?;
        let all = (starts, directions, in_space(py, &bars.vertices)?);
        Ok(all.into_pyobject(py)?.into_any())
    }
}
