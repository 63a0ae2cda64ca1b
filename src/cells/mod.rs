//! Cells of sites in a polygon: Voronoi cells, and power cells where sites have weights.
//!
//! The cell of site `i` is all `x` of the domain with `|x − yᵢ|² − wᵢ ≤ |x − yⱼ|² − wⱼ` for every other site `j`. With
//! equal weights that is the nearest site (Voronoi); a larger weight gives a larger cell (a power or Laguerre diagram).
//! The domain is a polygon with holes and parts, its rings of either orientation and without crossings.
//!
//! [`PowerDiagram`] borrows sites, weights and domain. A search, [`PowerDiagram::search`], finds what bounds each cell:
//! its record, [`CellTrace`], holds no numbers. [`PowerDiagram::cells`] computes from it areas, centroids, moments,
//! the energy of transport, sides and Hessians in any scalar, so duals pass through.
//! [`ad::adjoint::cells`](crate::ad::adjoint::cells) has the adjoint by sites, weights and vertices of the domain.
//!
//! ```
//! use geograd::cells::PowerDiagram;
//! use geograd::{Aabb2, Vec2};
//! let domain = Aabb2::new(0.0_f64, 0.0, 4.0, 2.0).corners();
//! let sites = [Vec2::new(1.0, 1.0), Vec2::new(3.0, 1.0)];
//! let voronoi = PowerDiagram::new(&sites, &[], &domain)?;
//! assert_eq!(voronoi.cells(&voronoi.search()).areas(), [4.0, 4.0]);
//!
//! // The side moves by half of the weight's growth over the distance of the sites.
//! let diagram = PowerDiagram::new(&sites, &[2.0, 0.0], &domain)?;
//! let trace = diagram.search();
//! let cells = diagram.cells(&trace);
//! assert_eq!(cells.areas(), [5.0, 3.0]);
//! assert_eq!(cells.area_slopes(), [(0, 0, 0.5), (0, 1, -0.5), (1, 0, -0.5), (1, 1, 0.5)]);
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! # Method
//!
//! Every cell is decided by itself: the bounds of the domain, seen from the site, are cut by the bisectors of other
//! sites, near ones first, until no site of a tree can reach what is left. No triangulation is built, so a wrong
//! decision about a side of length zero costs one rounding. A cell that meets the border of the domain is the domain's
//! rings, cut by the same bisectors; where that gives several parts, they hang together by borders that cancel.
//!
//! A corner is the foot of the site on one line, and a way along it to the other: rounding leaves it on the line, and
//! sites at a distance of 10⁻¹⁵ have cells as exact as others.
//!
//! # Derivatives and kinks
//!
//! A side moves along its normal, and a corner adds nothing (Reynolds' transport theorem). Over a side of length `l`
//! between sites at a distance `D`, the area changes by `l/D · ((m − yᵢ)·dyᵢ − (m − yⱼ)·dyⱼ + (dwᵢ − dwⱼ)/2)`, with its
//! midpoint `m`. `l/D` is rational: no root is taken.
//!
//! * Areas and moments are differentiable where sites lie on one circle; second derivatives jump there.
//! * Of sites at one place the heaviest has the cell. Equal ones share it: each has an equal part of every measure
//!   and of every derivative. Values jump there, the energy has a kink with the mean of its slopes.
//! * A site that others cover has no cell: measures and derivatives are zero. Its area begins as the square of its
//!   weight's growth.
//! * A bisector along an edge of the domain is a kink of both cells.
//!
//! Measures are exact to a few roundings of the size of the domain seen from the site. Values and derivatives are finite
//! where every length, and the root of every difference of weights, is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in `f32`,
//! from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
mod cell_cutting;
mod cell_domain;
mod cell_hessian;
mod cell_measures;
mod cell_search;
mod cell_trace;
mod power_diagram;
mod site_tree;

pub use cell_measures::{CellMoments, CellSide, Cells};
pub(crate) use cell_measures::{Piece, side_share};
pub use cell_trace::{CellBorder, CellTrace};
pub use power_diagram::PowerDiagram;
