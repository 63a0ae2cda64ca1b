//! Meshes of triangles: closest points, signed distances, rays and parity, with derivatives by the query and by the
//! vertices.
//!
//! A [`Mesh`] borrows a column of vertices and one of faces; a [`MeshTree`] over it is built once and keeps no
//! reference. Both together are a [`MeshSurface`], which answers queries. An [`OwnedMesh`] keeps columns that were checked.
//!
//! | function | gives |
//! | --- | --- |
//! | [`MeshSurface::nearest_face`] | the face and the feature that are nearest to a point: the record of a search |
//! | [`MeshSurface::closest_point`], [`distance`](MeshSurface::distance), [`squared_distance`](MeshSurface::squared_distance) | what replays of that record compute |
//! | [`MeshSurface::signed_distance`] | the distance, negative inside a [closed](ClosedMesh) mesh |
//! | [`MeshSurface::hit_face`], [`first_hit`](MeshSurface::first_hit), [`all_hits`](MeshSurface::all_hits) | where rays meet the mesh |
//! | [`MeshSurface::encloses`] | whether a point is inside, by the parity of exact crossings |
//! | [`MeshSurface::distance_to`], [`closest_points_to`](MeshSurface::closest_points_to), [`is_touching`](MeshSurface::is_touching), [`faces_within`](MeshSurface::faces_within) | distances of a [solid](MeshSolid): a ball, a capsule, a box, a hull |
//! | [`MeshSurface::distance_between`], [`closest_points_between`](MeshSurface::closest_points_between), [`is_meeting`](MeshSurface::is_meeting), [`pairs_within`](MeshSurface::pairs_within) | distances of another mesh, which a pose places |
//! | [`WoundSurface::winding_number`] | how often a mesh goes around a point; open and crossing ones, too |
//! | [`WoundSurface::signed_distance`] | the distance, negative where the winding number is above ½ |
//! | [`Mesh::area`], [`volume`](Mesh::volume), [`centroid`](Mesh::centroid), [`dirichlet`](Mesh::dirichlet) | measures |
//! | [`MeshEnergy`] | measures and energies with gradients and sparse Hessians, by [batches](crate::kernels::cpu::mesh_energies) |
//!
//! ```
//! use geograd::mesh::{ClosedMesh, Mesh, MeshTree};
//! use geograd::{Ray3, Vec3};
//! let corners = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 3.0, 0.0), (0.0, 0.0, 3.0)];
//! let vertices = corners.map(|(x, y, z)| Vec3::new(x, y, z));
//! let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
//! let mesh = Mesh::new(&vertices, &faces)?;
//! let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh)?);
//! let surface = tree.on(&mesh)?;
//!
//! let above = Vec3::new(0.5, 0.25, -2.0);
//! assert_eq!(surface.closest_point(above), Vec3::new(0.5, 0.25, 0.0));
//! assert_eq!(surface.signed_distance(&closed, above), 2.0);
//! assert_eq!(surface.signed_distance(&closed, Vec3::new(0.5, 0.5, 0.25)), -0.25);
//! let hit = surface.first_hit(Ray3::new(above, Vec3::new(0.0, 0.0, 1.0))).expect("the floor is above");
//! assert_eq!((hit.face, hit.hit.parameter), (0, 2.0));
//! # Ok::<(), geograd::mesh::MeshFault>(())
//! ```
//!
//! # Searches and replays
//!
//! A query is a search and a replay. The search reads plain numbers and yields a record without numbers: a face and,
//! for closest points, its feature ([`FaceFeature`]). The replay is a straight line over the query and the three corners
//! of that face, so it runs on floats, duals, lanes and symbols: [`closest_replay`], [`distance_replay`],
//! [`first_hit_triangle`](crate::intersection3::first_hit_triangle). Its derivatives by the corners belong to the
//! vertices of the face.
//!
//! Batches of queries run on vectors and threads, with adjoints by hand for queries and vertices:
//! [`mesh_batches`](crate::kernels::cpu::mesh_batches). Those of solids and of poses of a mesh have the adjoints of
//! distances: [`mesh_solids`](crate::kernels::mesh_solids).
//!
//! # Decisions
//!
//! The tree has single precision and finds candidates: every face that its rounding cannot exclude. Double precision
//! decides among them. Of faces at equal distances the lowest index is chosen, whatever the order of the search: a point
//! over an edge or a vertex has several, and their closest points are equal. So are derivatives by the point and by the
//! vertices of the common feature. At the medial axis, where closest points differ, the lowest face gives the
//! derivative.
//!
//! # Bad input
//!
//! [`Mesh::new`] refuses indices out of range, vertices that are not finite and meshes without faces; a
//! [`MeshFault`] names the face and the vertex. Faces without area are segments or points for distances, and rays miss
//! them. Repeated faces and vertices are valid. Points farther from a mesh than some thousand times its size compare
//! most of its faces, one by one. Rays that start farther than 10²⁰ times its size may miss it.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
mod closed_mesh;
mod enclosed_point;
mod face_measure;
mod face_replay;
mod face_search;
mod lane_gap;
mod mesh_border;
mod mesh_column;
mod mesh_fault;
mod mesh_measures;
mod mesh_solid;
mod mesh_surface;
mod mesh_tree;
mod owned_mesh;
mod packet;
mod pair_search;
mod ray_search;
mod solid_search;
mod solid_surface;
mod tree_split;
mod wound_surface;

pub(crate) use face_measure::normal;
pub(crate) use face_search::{FAR, SearchRoom, bound_squares, margin, nearest};
pub(crate) use mesh_column::plain;
pub(crate) use packet::{EightLanes, PACKET, part_of};
pub(crate) use pair_search::visit_pairs;
pub(crate) use ray_search::{first, plain_ray};
pub(crate) use solid_search::{Wanted, visit_faces};
pub(crate) use solid_surface::{faces_within, nearest_pair, nearest_to, pairs_within};
pub(crate) use wound_surface::edge_slopes;

pub use closed_mesh::ClosedMesh;
pub use face_measure::{FaceFeature, FaceRecord};
pub use face_replay::{closest_replay, distance_replay, normal_replay, squared_distance_replay};
pub use mesh_border::{BorderEdge, MeshBorder};
pub use mesh_column::Mesh;
pub use mesh_fault::MeshFault;
pub use mesh_measures::{
    MeshEnergy, bending_of_hinge, cone_volume, dirichlet_of_face, hinge_angle,
};
pub use mesh_solid::{MeshSolid, SolidBounds};
pub use mesh_surface::{MeshHit, MeshSurface};
pub use mesh_tree::MeshTree;
pub use owned_mesh::OwnedMesh;
pub use solid_surface::{FacePair, pair_closest_points, pair_distance};
pub use wound_surface::{WoundSurface, solid_angle};
