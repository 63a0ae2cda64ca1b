//! Delaunay triangulations: the triangles of points in whose circles there are no others.
//!
//! [`Delaunay::search`] decides with exact signs; [`Delaunay::areas`] and [`Delaunay::circumcircles`] measure its triangles in any
//! scalar, so duals of the points pass through. [`Delaunay::locate`] finds the triangles around places,
//! [`Delaunay::barycentric`] the weights of their corners. Voronoi cells, clipped and with weights, are in
//! [`cells`](crate::cells).
//!
//! ```
//! use geograd::{Vec2, delaunay::Delaunay};
//! let points = [(0.0, 0.0), (4.0, 0.0), (0.0, 2.0), (1.0, 0.5)].map(|(x, y)| Vec2::new(x, y));
//! let record = Delaunay::search(&points)?;
//! assert_eq!((record.triangles().len(), record.hull()), (3, &[0, 1, 2][..]));
//! let (_, by_points) = geograd::gradient(|all: [Vec2<_>; 4]| record.areas(&all)[0], points);
//! assert!(by_points.iter().any(|by| by.y != 0.0));
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! # Hard inputs
//!
//! Signs of turns and circles are exact for coordinates that are zero or at least 10⁻⁶⁰ of the largest one (Shewchuk 1997):
//! grids, points on circles and points that nearly coincide have a triangulation without gaps or overlaps.
//!
//! * Four or more points on an empty circle have one of their triangulations, the same on every machine.
//! * The first one of points at one place is in triangles ([`Delaunay::firsts`]).
//! * Points on one line, and fewer than three, have no triangles.
//!
//! # Derivatives
//!
//! Areas and circles are smooth while the triangles stay. A diagonal changes where four points come to lie on a circle: areas
//! and circles of triangles jump there. Sums that do not depend on the diagonal, such as that of all areas, are smooth.
mod barycentric;
mod divide_and_conquer;
mod half_edges;
mod triangle_walk;
mod triangulation;

pub use barycentric::TrianglePlace;
pub use triangulation::Delaunay;
