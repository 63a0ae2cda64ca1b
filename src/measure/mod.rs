//! Measures of polygons: areas, centres, moments, extents, and the smallest shapes around them.
//!
//! | to know | see |
//! | --- | --- |
//! | area, perimeter, centroid of any ring | [`ring`](crate::ring), [`ConvexPolygon::area`](crate::ConvexPolygon::area) and the like |
//! | second moments, principal axes | [`moments`] |
//! | centroid, covariance of points of space | [`cloud`] |
//! | inertia of solids | [`inertia`] |
//! | diameter, width | [`extent`] |
//! | rectangle of least area around points | [`rectangle`] |
//! | smallest circle around points | [`circle`] |
//!
//! Areas, centres and moments are sums over edges. Extents and enclosing shapes are searches: `…_search`
//! gives the value and which vertices decided it, `…_replay` the value from vertices and that record,
//! with the derivatives of exactly those vertices (the envelope theorem: a vertex that does not decide
//! has derivative zero). Ties go to the first found.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
pub mod circle;
pub mod cloud;
pub mod extent;
pub mod inertia;
pub mod moments;
mod polygon;
pub use polygon::vertex_mean;
pub mod rectangle;
