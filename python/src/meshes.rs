//! Meshes of triangles with their trees.
use crate::mesh_arrays::{
    coded, hit_faces, in_space, rays, records, rows, triples, vectors, whole,
};
use crate::polygon_calls::numbers;
use crate::raised;
use crate::threads::on_threads;
use geograd::Error;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::mesh::Mesh as Columns;
use geograd::mesh::{
    ClosedMesh, FaceRecord, MeshBorder, MeshEnergy, MeshFault, MeshSurface, MeshTree, OwnedMesh,
    WoundSurface,
};
use geograd::{Ray3, Vec3};
use numpy::PyArray1;
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::sync::{Arc, OnceLock};

type Object<'py> = Bound<'py, PyAny>;

/// A mesh of triangles, with the tree that queries use.
#[pyclass(frozen, module = "geograd._core")]
pub struct MeshCore {
    columns: OwnedMesh<f64>,
    pub(crate) tree: MeshTree,
    closed: OnceLock<Arc<ClosedMesh>>,
    border: OnceLock<Arc<MeshBorder>>,
}

/// The error of a call that was not run.
fn unused() -> PyErr {
    PyRuntimeError::new_err("the call was not run")
}

pub(crate) fn refused(fault: MeshFault) -> PyErr {
    PyValueError::new_err(fault.to_string())
}

impl MeshCore {
    pub(crate) fn surface<R: Send>(
        &self,
        py: Python<'_>,
        count: usize,
        run: impl FnOnce(&MeshSurface<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        on_threads(py, 64 * count, || {
            let (mut run, mut result) = (Some(run), None);
            let done = self.with_surface(&mut |own| result = run.take().map(|run| run(own)));
            done.map(|()| result)
        })?
        .map_err(refused)?
        .ok_or_else(unused)?
        .map_err(raised)
    }
    /// Calls a function with the mesh and its tree. Without a type of its own, so that its check is compiled once.
    fn with_surface(&self, run: &mut dyn FnMut(&MeshSurface<'_, f64>)) -> Result<(), MeshFault> {
        run(&self.tree.on(&self.columns())?);
        Ok(())
    }
    fn closed(&self) -> PyResult<Arc<ClosedMesh>> {
        if let Some(closed) = self.closed.get() {
            return Ok(closed.clone());
        }
        let closed = Arc::new(ClosedMesh::new(&self.columns()).map_err(refused)?);
        Ok(self.closed.get_or_init(|| closed).clone())
    }
    fn border(&self) -> PyResult<Arc<MeshBorder>> {
        if let Some(border) = self.border.get() {
            return Ok(border.clone());
        }
        let border = Arc::new(MeshBorder::new(&self.columns()));
        Ok(self.border.get_or_init(|| border).clone())
    }
    fn wound<R: Send>(
        &self,
        py: Python<'_>,
        count: usize,
        run: impl FnOnce(&WoundSurface<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        let border = self.border()?;
        let work = count * (64 + border.edges().len());
        on_threads(py, work, || {
            let (mut run, mut result) = (Some(run), Ok(None));
            let done = self.with_surface(&mut |own| {
                result = border.of(own).map(|own| run.take().map(|run| run(&own)));
            });
            done.and(result)
        })?
        .map_err(refused)?
        .ok_or_else(unused)?
        .map_err(raised)
    }
    /// Runs on the mesh alone, with an energy by its name.
    fn with_energy<R: Send>(
        &self,
        py: Python<'_>,
        (kind, elements, constants): (&str, &[i64], &[f64]),
        run: impl FnOnce(MeshEnergy<'_>, &Columns<'_, f64>) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        // Beyond all vertices, which the library refuses.
        let index = |&vertex: &i64| u32::try_from(vertex).unwrap_or(u32::MAX);
        let all: Vec<u32> = elements.iter().map(index).collect();
        let energy = match kind {
            "area" => MeshEnergy::Area,
            "volume" => MeshEnergy::Volume,
            "dirichlet" => MeshEnergy::Dirichlet { values: constants },
            "springs" => MeshEnergy::Springs {
                edges: all.as_chunks().0,
                lengths: constants,
            },
            "bending" => MeshEnergy::Bending {
                hinges: all.as_chunks().0,
                angles: constants,
            },
            other => return Err(PyKeyError::new_err(other.to_owned())),
        };
        self.on_columns(py, |mesh| run(energy, mesh))?
            .map_err(raised)
    }
    /// Runs on rays by their starts and directions.
    fn on_rays<R: Send>(
        &self,
        py: Python<'_>,
        [starts, directions]: [&Object<'_>; 2],
        run: impl FnOnce(&MeshSurface<'_, f64>, &[Ray3<f64>]) -> Result<R, Error> + Send,
    ) -> PyResult<R> {
        let rays = rays(starts, directions)?;
        self.surface(py, rays.len(), |surface| run(surface, &rays))
    }
    fn on_columns<R: Send>(
        &self,
        py: Python<'_>,
        run: impl FnOnce(&Columns<'_, f64>) -> R + Send,
    ) -> PyResult<R> {
        let mesh = self.columns();
        on_threads(py, 64 * mesh.faces().len(), || run(&mesh))
    }
    pub(crate) fn columns(&self) -> Columns<'_, f64> {
        self.columns.mesh()
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
            "wound_distance" => run(MeshDistance::Wound(&*self.border()?)),
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
        let columns = OwnedMesh::new(vertices, faces).map_err(refused)?;
        Ok(MeshCore {
            tree: MeshTree::new(&columns.mesh()),
            columns,
            closed: OnceLock::new(),
            border: OnceLock::new(),
        })
    }
    /// The mesh with its vertices at other places: the tree follows them.
    fn moved(&self, vertices: &Object<'_>) -> PyResult<Self> {
        let columns = self.columns.moved(vectors(vertices)?).map_err(refused)?;
        let mut tree = self.tree.clone();
        tree.refit(&columns.mesh()).map_err(refused)?;
        Ok(MeshCore {
            columns,
            tree,
            closed: self.closed.clone(),
            border: self.border.clone(),
        })
    }
    #[getter]
    fn vertices<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        in_space(py, self.columns().vertices())
    }
    #[getter]
    fn faces<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        let columns = self.columns();
        let faces = columns.faces().iter();
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
    /// The winding numbers around points, or the cotangents of points and vertices from theirs.
    #[pyo3(signature = (points, upstream=None))]
    fn winding<'py>(
        &self,
        py: Python<'py>,
        points: &Object<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let (points, cpu) = (vectors(points)?, Cpu::new());
        let Some(upstream) = upstream else {
            let run = |wound: &WoundSurface<'_, f64>| cpu.winding_numbers(wound, &points);
            let values = self.wound(py, points.len(), run)?;
            return Ok(PyArray1::from_vec(py, values).into_any());
        };
        let upstream = numbers(upstream)?;
        let bars = self.wound(py, points.len(), |wound| {
            cpu.winding_numbers_vjp(wound, &points, &upstream)
        })?;
        let both = (in_space(py, &bars.queries)?, in_space(py, &bars.vertices)?);
        Ok(both.into_pyobject(py)?.into_any())
    }
    /// The edges, of shape (E, 2), or the hinges, of shape (H, 4).
    fn elements<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Object<'py>> {
        if kind == "edges" {
            let edges = self.on_columns(py, |mesh| mesh.edges())?.into_iter();
            return rows(py, edges.map(|edge| edge.map(i64::from)).collect());
        }
        let hinges = self.on_columns(py, |mesh| mesh.hinges())?.into_iter();
        rows(py, hinges.map(|hinge| hinge.map(i64::from)).collect())
    }
    /// An energy (order 0), its derivatives by the vertices (1), or its second ones as rows, columns and values (2).
    fn energy<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
        elements: &Object<'py>,
        constants: &Object<'py>,
        order: usize,
    ) -> PyResult<Object<'py>> {
        let (elements, constants) = (whole(elements)?, numbers::<f64>(constants)?);
        let given = (kind, elements.as_slice(), constants.as_slice());
        let cpu = Cpu::new();
        match order {
            0 => {
                let value = self.with_energy(py, given, |own, mesh| cpu.mesh_energy(own, mesh))?;
                Ok(value.into_pyobject(py)?.into_any())
            }
            1 => {
                let run = |own: MeshEnergy<'_>, mesh: &Columns<'_, f64>| {
                    cpu.mesh_energy_slopes(own, mesh)
                };
                in_space(py, &self.with_energy(py, given, run)?)
            }
            _ => {
                let run = |own: MeshEnergy<'_>, mesh: &Columns<'_, f64>| {
                    cpu.mesh_energy_hessian(own, mesh)
                };
                triples(py, self.with_energy(py, given, run)?)
            }
        }
    }
    /// The second derivatives of the Dirichlet energy by values, as rows, columns and values.
    fn laplacian<'py>(&self, py: Python<'py>) -> PyResult<Object<'py>> {
        triples(
            py,
            self.on_columns(py, |mesh| Cpu::new().mesh_laplacian(mesh))?,
        )
    }
    /// The centroid, or the cotangents of vertices from its own.
    #[pyo3(signature = (upstream=None))]
    fn centroid<'py>(
        &self,
        py: Python<'py>,
        upstream: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let cpu = Cpu::new();
        let Some(upstream) = upstream else {
            let Vec3 { x, y, z } = self.on_columns(py, |mesh| cpu.mesh_centroid(mesh))?;
            return Ok(PyArray1::from_vec(py, vec![x, y, z]).into_any());
        };
        let bar = vectors(upstream)?.into_iter().next();
        let bar = bar.ok_or_else(|| PyValueError::new_err("upstream: three numbers are needed"))?;
        let bars = self.on_columns(py, |mesh| cpu.mesh_centroid_vjp(mesh, bar))?;
        in_space(py, &bars.map_err(raised)?)
    }
    /// The first faces that rays meet; −1 for a miss.
    fn hit_faces<'py>(
        &self,
        py: Python<'py>,
        starts: &Object<'py>,
        directions: &Object<'py>,
    ) -> PyResult<Object<'py>> {
        let found = self.on_rays(py, [starts, directions], |surface, rays| {
            Cpu::new().hit_faces(surface, rays)
        })?;
        let face = |face: Option<u32>| face.map_or(-1, i64::from);
        Ok(PyArray1::from_vec(py, found.into_iter().map(face).collect()).into_any())
    }
    /// The parameters at which rays meet first, infinite for a miss, and the faces, −1 for a miss.
    fn first_hits<'py>(
        &self,
        py: Python<'py>,
        starts: &Object<'py>,
        directions: &Object<'py>,
    ) -> PyResult<Object<'py>> {
        let hits = self.on_rays(py, [starts, directions], |surface, rays| {
            Cpu::new().hit_parameters(surface, rays)
        })?;
        let coded = |hit| match hit {
            Some((face, parameter)) => (parameter, i64::from(face)),
            None => (f64::INFINITY, -1),
        };
        let (parameters, faces) = hits.into_iter().map(coded).unzip();
        let both = (
            PyArray1::from_vec(py, parameters),
            PyArray1::from_vec(py, faces),
        );
        Ok(both.into_pyobject(py)?.into_any())
    }
    /// All hits of rays: the ray and the face of each, ray by ray in the order of parameters.
    fn all_hit_faces<'py>(
        &self,
        py: Python<'py>,
        starts: &Object<'py>,
        directions: &Object<'py>,
    ) -> PyResult<Object<'py>> {
        let found = self.on_rays(py, [starts, directions], |surface, rays| {
            Cpu::new().all_hit_faces(surface, rays)
        })?;
        let (mut of, mut faces) = (Vec::new(), Vec::new());
        for (ray, own) in (0_i64..).zip(found) {
            of.resize(of.len() + own.len(), ray);
            faces.extend(own.into_iter().map(i64::from));
        }
        let both = (PyArray1::from_vec(py, of), PyArray1::from_vec(py, faces));
        Ok(both.into_pyobject(py)?.into_any())
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
