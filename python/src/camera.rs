//! Cameras and the points that they see.
use crate::table::table;
use geograd::camera::{BrownConrady, Fisheye, Pinhole};
use geograd::{Fixed, Pack, Vec3};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// True where the camera of a row of the second array sees the point of that row of the first one; the last argument is
/// the shape of the cameras.
#[pyfunction]
pub fn sees(
    points: PyReadonlyArray2<'_, f64>,
    cameras: PyReadonlyArray2<'_, f64>,
    kind: &str,
) -> PyResult<Vec<bool>> {
    fn all<C: Pack<Scalar = f64> + Fixed>(
        points: &[f64],
        cameras: &[f64],
        sees: impl Fn(C, Vec3<f64>) -> bool,
    ) -> Vec<bool> {
        let pairs = points.chunks_exact(3).zip(cameras.chunks_exact(C::LEN));
        pairs
            .map(|(point, camera)| sees(C::load(camera), Vec3::load(point)))
            .collect()
    }
    let width = table()
        .kind(kind)
        .map_or(0, |kind| table().shapes[usize::from(kind)].fields.len());
    let is_whole = points.shape()[0] == cameras.shape()[0]
        && points.shape()[1] == 3
        && cameras.shape()[1] == width;
    let (Ok(p), Ok(c), true) = (points.as_slice(), cameras.as_slice(), is_whole) else {
        return Err(PyValueError::new_err(
            "points and cameras: whole rows of one count are needed",
        ));
    };
    match kind {
        "Pinhole" => Ok(all(p, c, Pinhole::sees)),
        "BrownConrady" => Ok(all(p, c, BrownConrady::sees)),
        "Fisheye" => Ok(all(p, c, Fisheye::sees)),
        _ => Err(PyTypeError::new_err(format!("{kind} is no camera"))),
    }
}
