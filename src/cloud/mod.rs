//! Clouds of points of space: nearest points, some nearest ones, all within a radius, with derivatives by the query and by
//! the points.
//!
//! A [`CloudTree`] over points is built once and keeps no reference; with the points it is a [`Cloud`], which answers
//! queries. It is the tree of [meshes](crate::mesh), whose leaves hold points. An [`OwnedCloud`] keeps both.
//!
//! | function | gives |
//! | --- | --- |
//! | [`Cloud::nearest`] | the point that is nearest to a query, the record of a search |
//! | [`Cloud::distance`], [`squared_distance`](Cloud::squared_distance) | the distance to it |
//! | [`Cloud::nearest_some`] | some nearest points, in the order of their distances |
//! | [`Cloud::within`] | the points within a radius |
//! | [`Cpu::chamfer`](crate::kernels::Cpu::chamfer), [`hausdorff`](crate::kernels::Cpu::hausdorff), [`f_score`](crate::kernels::Cpu::f_score) | how far two clouds are apart |
//!
//! ```
//! use geograd::Vec3;
//! use geograd::cloud::CloudTree;
//! let points = [(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 4.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let tree = CloudTree::new(&points)?;
//! let cloud = tree.on(&points)?;
//! let query = Vec3::new(1.0, 0.0, 0.0);
//! assert_eq!((cloud.nearest(query), cloud.distance(query)), (0, 1.0));
//! assert_eq!(cloud.nearest_some(query, 2), [0, 1]);
//! assert_eq!(cloud.within(query, 2.0), [0, 1]);
//! # Ok::<(), geograd::cloud::CloudFault>(())
//! ```
//!
//! # Decisions
//!
//! The tree has single precision and finds candidates; squared distances in double precision decide among them. Of points
//! at equal distances the lowest index comes first, whatever the order of the search. Where two points are equally near,
//! the derivative is that of the lower one.
//!
//! # Bad input
//!
//! [`CloudTree::new`] refuses clouds without points and points that are not finite; a [`CloudFault`] names the point.
//! Repeated points are valid.
mod cloud_fault;
mod cloud_search;
mod cloud_tree;
mod owned_cloud;

pub use cloud_fault::CloudFault;
pub use cloud_tree::{Cloud, CloudTree};
pub use owned_cloud::OwnedCloud;
