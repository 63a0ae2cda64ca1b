//! Meshes of triangles: queries against every face one by one, derivatives against differences.
mod bad_files;
mod closest_faces;
mod damaged_files;
mod energy_slopes;
mod face_adjoints;
mod good_files;
mod indexed_columns;
mod many_queries;
mod mesh_faults;
pub mod mesh_shapes;
mod near_points;
mod near_solids;
mod pierced_faces;
mod point_clouds;
mod query_slopes;
mod winding_numbers;
