//! The module `geograd._core`.
#![forbid(unsafe_code)]
mod arrays;
mod at_once;
mod border_curves;
mod buffer_measures;
mod buffered;
mod call;
mod camera;
mod catalogue;
mod cell_calls;
mod check;
mod clouds;
mod column;
mod curve_calls;
mod far_pairs;
mod forms;
mod grouped;
mod hulls;
mod indexed;
mod lent;
mod machine;
mod mesh_arrays;
mod meshes;
mod metric;
mod nearest;
mod number;
mod overlay;
mod pairs;
mod paths;
mod points;
mod polygon_calls;
mod polygon_points;
mod polygons;
mod results;
mod samples;
mod separation;
mod shapes;
mod solid_calls;
mod suppressed;
mod symbol;
mod table;
mod threads;
mod traced;
mod tracing;
mod triangulated;
mod verb;

use geograd::Error;
use pyo3::exceptions::{PyMemoryError, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Converts an error of the library to an exception.
pub(crate) fn raised(error: Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::Program(_) | Error::NotOneNumber { .. } | Error::Arguments { .. } => {
            PyTypeError::new_err(text)
        }
        Error::TooLarge => PyMemoryError::new_err(text),
        Error::Gpu(_) => PyRuntimeError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

#[pymodule(gil_used = false)]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    m.add("WGSL", geograd::ad::program::WGSL)?;
    m.add_class::<shapes::Shape>()?;
    m.add_class::<shapes::Columns>()?;
    m.add_class::<shapes::Paths>()?;
    m.add_class::<polygons::Polygons>()?;
    m.add_class::<clouds::CloudCore>()?;
    m.add_class::<meshes::MeshCore>()?;
    m.add_class::<cell_calls::CellsCore>()?;
    m.add_class::<curve_calls::CurveCore>()?;
    m.add_class::<triangulated::DelaunayCore>()?;
    m.add_class::<overlay::Overlay>()?;
    m.add_class::<buffered::Buffer>()?;
    m.add_class::<symbol::Symbol>()?;
    m.add_class::<symbol::Truth>()?;
    m.add_class::<verb::Verb>()?;
    m.add_class::<traced::Recorded>()?;
    m.add_class::<traced::Program>()?;
    m.add_class::<check::Report>()?;
    m.add_function(wrap_pyfunction!(camera::sees, m)?)?;
    m.add_function(wrap_pyfunction!(check::check_recorded, m)?)?;
    m.add_function(wrap_pyfunction!(check::check_callables, m)?)?;
    m.add_function(wrap_pyfunction!(verb::valid_samples, m)?)?;
    m.add_function(wrap_pyfunction!(verb::shapes, m)?)?;
    m.add_function(wrap_pyfunction!(verb::verbs, m)?)?;
    m.add_function(wrap_pyfunction!(verb::rows, m)?)?;
    m.add_function(wrap_pyfunction!(metric::assigned, m)?)?;
    m.add_function(wrap_pyfunction!(metric::outcomes, m)?)?;
    m.add_function(wrap_pyfunction!(metric::curve, m)?)?;
    m.add_function(wrap_pyfunction!(metric::average_precision, m)?)?;
    m.add_function(wrap_pyfunction!(metric::judge_kitti, m)?)?;
    m.add_function(wrap_pyfunction!(metric::judge_nuscenes, m)?)?;
    m.add_function(wrap_pyfunction!(suppressed::suppressed, m)?)?;
    m.add_function(wrap_pyfunction!(suppressed::assigned_matrix, m)?)?;
    m.add_function(wrap_pyfunction!(points::around_points, m)?)?;
    m.add_function(wrap_pyfunction!(points::hulls_of_points, m)?)?;
    m.add_function(wrap_pyfunction!(points::align_points, m)?)?;
    m.add_function(wrap_pyfunction!(polygons::joined_polygons, m)?)?;
    m.add_function(wrap_pyfunction!(polygon_calls::polygon_measure, m)?)?;
    m.add_function(wrap_pyfunction!(polygon_calls::polygon_overlap, m)?)?;
    m.add_function(wrap_pyfunction!(polygon_calls::polygon_pairs, m)?)?;
    m.add_function(wrap_pyfunction!(polygon_points::polygon_distance, m)?)?;
    m.add_function(wrap_pyfunction!(polygon_points::polygon_contains, m)?)?;
    m.add_function(wrap_pyfunction!(hulls::hull_measure, m)?)?;
    m.add_function(wrap_pyfunction!(hulls::hull_faces, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_solid_search, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_solid_distances, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_solid_points, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_solid_touches, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_solid_faces, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_pair_search, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_pair_distances, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_pair_points, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_pair_meets, m)?)?;
    m.add_function(wrap_pyfunction!(solid_calls::mesh_pair_faces, m)?)?;
    m.add_function(wrap_pyfunction!(far_pairs::far_pairs, m)?)?;
    m.add_function(wrap_pyfunction!(separation::nearest_edges, m)?)?;
    m.add_function(wrap_pyfunction!(separation::polygons_apart, m)?)?;
    m.add_function(wrap_pyfunction!(separation::polygons_hold, m)?)?;
    m.add_function(wrap_pyfunction!(overlay::polygon_overlay, m)?)?;
    m.add_function(wrap_pyfunction!(buffered::polygon_buffer, m)?)?;
    m.add_function(wrap_pyfunction!(
        buffer_measures::polygon_buffer_measures,
        m
    )?)?;
    m.add_function(wrap_pyfunction!(
        buffer_measures::polygon_buffer_measures_along,
        m
    )?)?;
    m.add_function(wrap_pyfunction!(border_curves::polygon_buffer_curves, m)?)?;
    m.add_function(wrap_pyfunction!(overlay::polygon_union_all, m)?)?;
    m.add_function(wrap_pyfunction!(samples::samples, m)?)?;
    m.add_function(wrap_pyfunction!(samples::hard_samples, m)?)?;
    m.add_function(wrap_pyfunction!(samples::valid, m)?)?;
    m.add_function(wrap_pyfunction!(shapes::set_classes, m)?)?;
    m.add_function(wrap_pyfunction!(symbol::where_, m)?)?;
    m.add_function(wrap_pyfunction!(symbol::elementary, m)?)?;
    m.add_function(wrap_pyfunction!(threads::get_num_threads, m)?)?;
    m.add_function(wrap_pyfunction!(threads::set_num_threads, m)?)?;
    m.add_function(wrap_pyfunction!(threads::before_fork, m)?)?;
    m.add_function(wrap_pyfunction!(threads::after_fork, m)?)?;
    Ok(())
}
