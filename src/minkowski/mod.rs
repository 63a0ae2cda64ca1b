//! Minkowski sums of polygons of any kind: all sums of a point of one and a point of the other. With one of them mirrored they
//! are *no-fit polygons*: where the origin of the second may not be if both are not to overlap.
//!
//! [`minkowski_sum`] and [`no_fit_polygon`] (feature `boolean`) return polygons that are valid by the OGC's rules. As for
//! [offsets](crate::offset), a search gives a record without numbers of the inputs and [`minkowski_replay`] or
//! [`valid_minkowski_replay`] computes the result from it in any scalar;
//! [`ad::adjoint::minkowski`](crate::ad::adjoint::minkowski) has the adjoints by the vertices of both.
//!
//! ```
//! # #[cfg(feature = "boolean")] {
//! use geograd::{Aabb2, minkowski::{minkowski_search, minkowski_replay}, polygon::{Fill, perimeter}};
//! let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 2.0).corners(), Aabb2::new(-1.0, -1.0, 1.0, 1.0).corners());
//! let trace = minkowski_search(&a, &b, Fill::NonZero)?;
//! assert_eq!(perimeter(&minkowski_replay(&a, &b, &trace)), 2.0 * (6.0 + 4.0_f64));
//! # }
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! # Input
//!
//! Polygons may be of any kind, with holes and parts, crossing and repeated vertices included; each is united with nothing
//! first, by a fill rule. A polygon without rings has the empty sum. The result is closed: holes that are lines or points,
//! such as the slot into which a key just fits, are none.
//!
//! # Kinks
//!
//! Edges of both that are parallel: then the border of the sum has the mean of both, by the rule of
//! [`boolean`](crate::boolean). Areas are smooth there but where such edges bound a slot that closes.
//!
//! # Method
//!
//! The convolution of two rings has the sum of an edge of one and a vertex of the other if the edge's direction is between
//! those of both edges at the vertex, backwards where the vertex is reflex. Its winding number at a point `z` is the Euler
//! number of what the first polygon `A` and the mirrored second one at `z`, `z − B`, share: the number of their common pieces less
//! that of holes in these (Guibas, Ramshaw and Stolfi, A kinetic framework for computational geometry, 1983). It vanishes
//! outside of the sum, and inside where pieces have as many holes. A ring that touches itself is convolved as several.
//!
//! Such a hole consists of holes of `A` and of `z − B`. The convex hull of it has a vertex of one of these that is in both
//! polygons. So the sum is the union of the convolution, by the non-zero rule, with copies of `B` at each vertex of a hole of `A`
//! and copies of `A` at each vertex of a hole of `B`.
mod sum_trace;
#[cfg(feature = "boolean")]
mod summed;

pub(crate) use sum_trace::SumLaid;
pub use sum_trace::{
    MinkowskiTrace, ValidMinkowskiTrace, minkowski_replay, valid_minkowski_replay,
};
#[cfg(feature = "boolean")]
pub use summed::{
    minkowski_search, minkowski_sum, no_fit_polygon, no_fit_search, valid_minkowski_search,
    valid_no_fit_search,
};
