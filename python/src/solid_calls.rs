//! Distances of solids and of other meshes from meshes.
use crate::mesh_arrays::{in_space, rows, whole};
use crate::meshes::{MeshCore, refused};
use crate::polygon_calls::numbers;
use crate::raised;
use crate::threads::on_threads;
use geograd::distance3::PointPair3;
use geograd::kernels::mesh_solids::SolidItem;
use geograd::kernels::{Cpu, Single};
use geograd::mesh::{FacePair, MeshFault, MeshSurface};
use geograd::{
    Aabb3, Capsule3, Error, Hull3, Obb3, Pose3, RoundBox3, Segment3, Sphere, Tetrahedron, Triangle3,
};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// Reads shapes from rows of numbers, codes last.
fn read<B: Single<Scalar = f64>>(rows: &[f64]) -> Vec<B> {
    let shape = |row: &[f64]| {
        let codes: Vec<u32> = row[B::LEN..].iter().map(|&x| x as u32).collect();
        B::load(row).load_codes(&codes)
    };
    rows.chunks_exact(B::LEN + B::CODES).map(shape).collect()
}

/// Writes shapes as rows of numbers, zeros for codes.
fn written<B: Single<Scalar = f64>>(py: Python<'_>, all: Vec<B>) -> PyResult<Object<'_>> {
    let width = B::LEN + B::CODES;
    let mut flat = vec![0.0; width * all.len()];
    let count = all.len();
    for (row, shape) in flat.chunks_exact_mut(width).zip(all) {
        shape.store(row);
    }
    PyArray1::from_vec(py, flat)
        .as_any()
        .call_method1("reshape", ((count, width),))
}

/// Runs with solids of a kind by its name.
macro_rules! with_solids {
    ($kind:expr, $rows:expr, |$solids:ident| $run:expr) => {{
        let all = numbers($rows)?;
        macro_rules! of {
            ($Shape:ty) => {{
                let $solids: Vec<$Shape> = read(&all);
                $run
            }};
        }
        match $kind {
            "Sphere" => of!(Sphere<f64>),
            "Segment3" => of!(Segment3<f64>),
            "Capsule3" => of!(Capsule3<f64>),
            "Triangle3" => of!(Triangle3<f64>),
            "Tetrahedron" => of!(Tetrahedron<f64>),
            "Aabb3" => of!(Aabb3<f64>),
            "Obb3" => of!(Obb3<f64>),
            "RoundBox3" => of!(RoundBox3<f64>),
            "Hull3_8" => of!(Hull3<f64, 8>),
            other => Err(PyKeyError::new_err(other.to_owned())),
        }
    }};
}

/// Returns indices; those below zero are beyond all faces, which the library refuses.
fn indices(array: &Object<'_>) -> PyResult<Vec<u32>> {
    let index = |k: i64| u32::try_from(k).unwrap_or(u32::MAX);
    Ok(whole(array)?.into_iter().map(index).collect())
}

fn pairs(array: &Object<'_>) -> PyResult<Vec<FacePair>> {
    let all = indices(array)?;
    let pair = |&[first, second]: &[u32; 2]| FacePair { first, second };
    Ok(all.as_chunks().0.iter().map(pair).collect())
}

fn points(py: Python<'_>, all: &[PointPair3<f64>]) -> PyResult<Py<PyAny>> {
    let (a, b): (Vec<_>, Vec<_>) = all.iter().map(|own| (own.on_a, own.on_b)).unzip();
    let both = (in_space(py, &a)?, in_space(py, &b)?);
    Ok(both.into_pyobject(py)?.into_any().unbind())
}

/// Returns the places of lists, each as often as the list is long, and the lists one after another.
fn listed<R: Copy, const N: usize>(
    py: Python<'_>,
    lists: Vec<Vec<R>>,
    row: impl Fn(R) -> [i64; N],
) -> PyResult<Py<PyAny>> {
    let (mut of, mut all) = (Vec::new(), Vec::new());
    for (item, own) in (0_i64..).zip(lists) {
        of.resize(of.len() + own.len(), item);
        all.extend(own.into_iter().map(&row));
    }
    let both = (PyArray1::from_vec(py, of), rows(py, all)?);
    Ok(both.into_pyobject(py)?.into_any().unbind())
}

/// Runs on two meshes.
fn on_both<R: Send>(
    py: Python<'_>,
    [first, second]: [&MeshCore; 2],
    count: usize,
    run: impl FnOnce([&MeshSurface<'_, f64>; 2]) -> Result<R, Error> + Send,
) -> PyResult<R> {
    let found = on_threads(py, 4096 * count, || -> Result<_, MeshFault> {
        let (own, other) = (first.columns(), second.columns());
        let (own, other) = (first.tree.on(&own)?, second.tree.on(&other)?);
        Ok(run([&own, &other]))
    })?;
    found.map_err(refused)?.map_err(raised)
}

/// The nearest face of each solid.
#[pyfunction]
pub fn mesh_solid_search(
    py: Python<'_>,
    mesh: &MeshCore,
    kind: &str,
    solids: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    with_solids!(kind, solids, |all| {
        let found = mesh.surface(py, 16 * all.len(), |surface| {
            Cpu::new().nearest_faces_to(surface, &all)
        })?;
        let faces = found.into_iter().map(i64::from).collect();
        Ok(PyArray1::<i64>::from_vec(py, faces).into_any().unbind())
    })
}

/// The distances of solids along records, or the cotangents of solids and vertices from those of distances.
#[pyfunction]
#[pyo3(signature = (mesh, kind, solids, faces, upstream=None))]
pub fn mesh_solid_distances(
    py: Python<'_>,
    mesh: &MeshCore,
    kind: &str,
    solids: &Object<'_>,
    faces: &Object<'_>,
    upstream: Option<&Object<'_>>,
) -> PyResult<Py<PyAny>> {
    fn run<B: SolidItem<f64>>(
        py: Python<'_>,
        mesh: &MeshCore,
        (solids, faces): (&[B], &[u32]),
        upstream: Option<Vec<f64>>,
    ) -> PyResult<Py<PyAny>> {
        let cpu = Cpu::new();
        let Some(upstream) = upstream else {
            let values = mesh.surface(py, solids.len(), |surface| {
                cpu.solid_distances(surface, solids, faces)
            })?;
            return Ok(PyArray1::from_vec(py, values).into_any().unbind());
        };
        let bars = mesh.surface(py, solids.len(), |surface| {
            cpu.solid_distances_vjp(surface, solids, faces, &upstream)
        })?;
        let both = (written(py, bars.queries)?, in_space(py, &bars.vertices)?);
        Ok(both.into_pyobject(py)?.into_any().unbind())
    }
    let faces = indices(faces)?;
    let upstream = upstream.map(numbers).transpose()?;
    with_solids!(kind, solids, |all| run(py, mesh, (&all, &faces), upstream))
}

/// The nearest points of the mesh and of each solid, along records.
#[pyfunction]
pub fn mesh_solid_points(
    py: Python<'_>,
    mesh: &MeshCore,
    kind: &str,
    solids: &Object<'_>,
    faces: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    let faces = indices(faces)?;
    with_solids!(kind, solids, |all| {
        let found = mesh.surface(py, all.len(), |surface| {
            Cpu::new().solid_closest_points(surface, &all, &faces)
        })?;
        points(py, &found)
    })
}

/// Returns `true` for each solid that a face meets.
#[pyfunction]
pub fn mesh_solid_touches(
    py: Python<'_>,
    mesh: &MeshCore,
    kind: &str,
    solids: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    with_solids!(kind, solids, |all| {
        let found = mesh.surface(py, 16 * all.len(), |surface| {
            Cpu::new().touching(surface, &all)
        })?;
        Ok(PyArray1::from_vec(py, found).into_any().unbind())
    })
}

/// The faces whose distance from each solid is at most a number: the solids and the faces, solid by solid.
#[pyfunction]
pub fn mesh_solid_faces(
    py: Python<'_>,
    mesh: &MeshCore,
    kind: &str,
    solids: &Object<'_>,
    most: f64,
) -> PyResult<Py<PyAny>> {
    with_solids!(kind, solids, |all| {
        let found = mesh.surface(py, 16 * all.len(), |surface| {
            Cpu::new().faces_within(surface, &all, most)
        })?;
        listed(py, found, |face| [i64::from(face)])
    })
}

/// The nearest faces of two meshes for each pose of the second one.
#[pyfunction]
pub fn mesh_pair_search(
    py: Python<'_>,
    first: &MeshCore,
    second: &MeshCore,
    poses: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    let poses: Vec<Pose3<f64>> = read(&numbers(poses)?);
    let found = on_both(py, [first, second], poses.len(), |[own, other]| {
        Cpu::new().nearest_pairs(own, other, &poses)
    })?;
    let pair = |own: FacePair| [i64::from(own.first), i64::from(own.second)];
    Ok(rows(py, found.into_iter().map(pair).collect())?.unbind())
}

/// The distances of two meshes along records, or the cotangents of poses and of the vertices of both.
#[pyfunction]
#[pyo3(signature = (first, second, poses, found, upstream=None))]
pub fn mesh_pair_distances(
    py: Python<'_>,
    first: &MeshCore,
    second: &MeshCore,
    poses: &Object<'_>,
    found: &Object<'_>,
    upstream: Option<&Object<'_>>,
) -> PyResult<Py<PyAny>> {
    let (poses, found): (Vec<Pose3<f64>>, _) = (read(&numbers(poses)?), pairs(found)?);
    let cpu = Cpu::new();
    let Some(upstream) = upstream else {
        let values = on_both(py, [first, second], poses.len(), |both| {
            cpu.pair_distances(both, &poses, &found)
        })?;
        return Ok(PyArray1::from_vec(py, values).into_any().unbind());
    };
    let upstream = numbers(upstream)?;
    let bars = on_both(py, [first, second], poses.len(), |both| {
        cpu.pair_distances_vjp(both, &poses, &found, &upstream)
    })?;
    let [own, other] = &bars.vertices;
    let all = (
        written(py, bars.poses)?,
        in_space(py, own)?,
        in_space(py, other)?,
    );
    Ok(all.into_pyobject(py)?.into_any().unbind())
}

/// The nearest points of two meshes along records, both in the frame of the first one.
#[pyfunction]
pub fn mesh_pair_points(
    py: Python<'_>,
    first: &MeshCore,
    second: &MeshCore,
    poses: &Object<'_>,
    found: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    let (poses, found): (Vec<Pose3<f64>>, _) = (read(&numbers(poses)?), pairs(found)?);
    let found = on_both(py, [first, second], poses.len(), |both| {
        Cpu::new().pair_closest_points(both, &poses, &found)
    })?;
    points(py, &found)
}

/// Returns `true` for each pose at which faces of two meshes meet.
#[pyfunction]
pub fn mesh_pair_meets(
    py: Python<'_>,
    first: &MeshCore,
    second: &MeshCore,
    poses: &Object<'_>,
) -> PyResult<Py<PyAny>> {
    let poses: Vec<Pose3<f64>> = read(&numbers(poses)?);
    let found = on_both(py, [first, second], poses.len(), |[own, other]| {
        Cpu::new().meeting(own, other, &poses)
    })?;
    Ok(PyArray1::from_vec(py, found).into_any().unbind())
}

/// The pairs of faces whose distance is at most a number: the poses and the pairs, pose by pose.
#[pyfunction]
pub fn mesh_pair_faces(
    py: Python<'_>,
    first: &MeshCore,
    second: &MeshCore,
    poses: &Object<'_>,
    most: f64,
) -> PyResult<Py<PyAny>> {
    let poses: Vec<Pose3<f64>> = read(&numbers(poses)?);
    let found = on_both(py, [first, second], poses.len(), |both| {
        Cpu::new().pairs_within(both, &poses, most)
    })?;
    listed(py, found, |own| {
        [i64::from(own.first), i64::from(own.second)]
    })
}
