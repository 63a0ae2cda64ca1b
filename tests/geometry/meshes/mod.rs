//! Meshes of triangles: queries against every face one by one, derivatives against differences.
mod closest_faces;
mod face_adjoints;
mod many_queries;
mod mesh_faults;
pub mod mesh_shapes;
mod pierced_faces;
mod query_slopes;
