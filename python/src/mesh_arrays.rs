//! Arrays of meshes: rows of vectors, records of searches, sparse matrices.
use geograd::mesh::{FaceFeature, FaceRecord};
use geograd::{Ray3, Vec3};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;

type Object<'py> = Bound<'py, PyAny>;

/// Returns the numbers of an array of rows.
pub fn vectors(array: &Object<'_>) -> PyResult<Vec<Vec3<f64>>> {
    let array = array.cast::<PyArrayDyn<f64>>()?.readonly();
    Ok(in_rows(&array)?.collect())
}

/// Returns the rows of an array as vectors.
fn in_rows<'a>(
    array: &'a PyReadonlyArrayDyn<'_, f64>,
) -> PyResult<impl Iterator<Item = Vec3<f64>> + 'a> {
    let (all, _) = array.as_slice()?.as_chunks::<3>();
    Ok(all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)))
}

/// Returns the whole numbers of an array.
pub fn whole(array: &Object<'_>) -> PyResult<Vec<i64>> {
    let array = array.cast::<PyArrayDyn<i64>>()?.readonly();
    Ok(array.as_slice()?.to_vec())
}

/// Returns an array of rows.
pub fn rows<'py, T: numpy::Element, const N: usize>(
    py: Python<'py>,
    all: Vec<[T; N]>,
) -> PyResult<Object<'py>> {
    let count = all.len();
    PyArray1::from_vec(py, all.into_flattened())
        .as_any()
        .call_method1("reshape", ((count, N),))
}

/// Returns an array of vectors.
pub fn in_space<'py>(py: Python<'py>, all: &[Vec3<f64>]) -> PyResult<Object<'py>> {
    rows(py, all.iter().map(|v| [v.x, v.y, v.z]).collect())
}

/// Returns a feature as a number: 0 the interior, 1 to 3 corners, from 4 on edges.
pub fn coded(feature: FaceFeature) -> i64 {
    match feature {
        FaceFeature::Interior => 0,
        FaceFeature::Vertex { corner } => 1 + i64::from(corner),
        FaceFeature::Edge { from, to } => 4 + 3 * i64::from(from) + i64::from(to),
    }
}

/// Returns records of searches, each a face and a feature as a number.
pub fn records(array: &Object<'_>) -> PyResult<Vec<FaceRecord>> {
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

/// Returns rays by their starts and directions.
pub fn rays(starts: &Object<'_>, directions: &Object<'_>) -> PyResult<Vec<Ray3<f64>>> {
    let starts = starts.cast::<PyArrayDyn<f64>>()?.readonly();
    let directions = directions.cast::<PyArrayDyn<f64>>()?.readonly();
    let both = in_rows(&starts)?.zip(in_rows(&directions)?);
    Ok(both
        .map(|(point, direction)| Ray3 { point, direction })
        .collect())
}

/// Returns the faces that rays meet, none for a negative number.
pub fn hit_faces(array: &Object<'_>) -> PyResult<Vec<Option<u32>>> {
    let face = |face: i64| (face >= 0).then(|| u32::try_from(face).unwrap_or(u32::MAX));
    Ok(whole(array)?.into_iter().map(face).collect())
}

/// Returns rows, columns and values of a sparse matrix.
pub fn triples(py: Python<'_>, entries: Vec<(u32, u32, f64)>) -> PyResult<Object<'_>> {
    let rows = entries.iter().map(|entry| i64::from(entry.0)).collect();
    let columns = entries.iter().map(|entry| i64::from(entry.1)).collect();
    let values = entries.iter().map(|entry| entry.2).collect();
    let all = (
        PyArray1::<i64>::from_vec(py, rows),
        PyArray1::<i64>::from_vec(py, columns),
        PyArray1::<f64>::from_vec(py, values),
    );
    Ok(all.into_pyobject(py)?.into_any())
}
