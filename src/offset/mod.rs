//! Offsets of polygons and paths: grown or shrunk by a distance. Others call it a *buffer* (shapely, PostGIS, boost).
//!
//! The offset of a polygon by `d ≥ 0` is all that is within `d` of it; by `d < 0`, all of it that is at least `−d` away
//! from its border. A path has the offset of a polygon without inside. With [`Join::Round`] and [`End::Round`] this is
//! exact but for the [`Chords`] of its arcs, which lie inside of them; other joins and ends are defined by what they add
//! to a rectangle over each edge.
//!
//! [`offset`] and [`path_offset`] (feature `boolean`) return polygons that are valid by the OGC's rules. As for
//! [`boolean`](crate::boolean) operations, a search gives a record without numbers of the input, and
//! [`offset_replay`] or [`valid_offset_replay`] computes the result from it in any scalar: duals of the vertices and of
//! the distance pass through. [`ad::adjoint::offset`](crate::ad::adjoint::offset) has the adjoints: of any function of the
//! vertices of the result, and of its area and perimeter.
//!
//! ```
//! # #[cfg(feature = "boolean")] {
//! use geograd::{Aabb2, Polygon, offset::{Join, OffsetStyle, offset_replay, offset_search}, polygon};
//! let (outer, hole) = (Aabb2::new(0.0_f64, 0.0, 6.0, 6.0).corners(), Aabb2::new(2.0, 2.0, 4.0, 4.0).corners());
//! let frame = Polygon::from_rings([&outer[..], &hole]);
//! let style = OffsetStyle { join: Join::Mitre(2.0), ..OffsetStyle::default() };
//! let trace = offset_search(&frame, 0.5, &style)?;
//! let area = |(rings, d): (Polygon<_>, _)| polygon::signed_area(&offset_replay(&rings, d, &trace));
//! let (area, (by_rings, by_distance)) = geograd::gradient(area, (frame, 0.5));
//! assert_eq!(area, 7.0 * 7.0 - 1.0);
//! assert_eq!(by_distance, 4.0 * 7.0 + 4.0 * 1.0); // the perimeter
//! assert_eq!(by_rings.ring(0)[0].x, -3.5);
//! # }
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! # Input
//!
//! A polygon may be of any kind, with holes and parts, crossing and repeated vertices included; it is united with nothing
//! first, by the rule [`fill`](OffsetStyle::fill). A style [that trusts](OffsetStyle::is_trusted) skips this. Paths may
//! cross themselves and each other. A path that ends where it starts has two ends there; the border of a ring is
//! the [difference](crate::boolean::BooleanOperation::Difference) of the offsets to either side.
//!
//! The distance zero gives the polygon itself, united; its derivative by the distance is that of moved edges. A distance
//! that leaves nothing gives no parts, with area, perimeter and derivatives of zero. Paths have no offset by a distance
//! of zero or less.
//!
//! # Exact arcs
//!
//! [`round_offset_measures`] has the area and the perimeter with round joins and ends without chords:
//!
//! ```
//! # #[cfg(feature = "boolean")] {
//! use geograd::{Vec2, offset::{OffsetStyle, round_path_offset_measures}};
//! let path = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0)];
//! let found = round_path_offset_measures(&path, 1.0_f64, &OffsetStyle::default())?;
//! assert!((found.area - (8.0 + std::f64::consts::PI)).abs() < 1e-14);
//! # }
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! The record, [`RoundOffsetTrace`], names the pieces of the border: an edge moved along its normal or an arc about a vertex,
//! and at each end of a piece the curve that cuts it. A crossing is that at which one curve ends and the other one starts, so
//! it needs no number to tell the two crossings of circles apart.
//! [`round_offset_vjp`](crate::ad::adjoint::round_offset::round_offset_vjp) has the adjoint by the motion of the border. Duals
//! pass through it, so they give second derivatives. The derivative of the area by the distance is the perimeter, exactly.
//!
//! [`round_offset_curves`] has the border itself, as contours of lines and arcs.
//!
//! Each side and each arc is decided by itself: capsules of the distance around all other edges are taken from it. A record is
//! used if each piece goes over into exactly one other one, at one place. Otherwise chords stand for the arcs, which
//! [`RoundOffsetTrace::is_exact`] tells; known cases are paths that lie along themselves.
//!
//! # Kinks
//!
//! The derivative of the area by the distance is the perimeter for mitres that are not cut, and for arcs in the limit of
//! short chords; for bevels, cut mitres and flat ends it is another. Kinks of the area, exact arcs included:
//!
//! * parallel edges that meet: a slot closes, a plate or a neck vanishes. The derivative of the area by the distance, the
//!   perimeter, jumps there. The result is that of the closed slot, and the empty plate;
//! * an edge of length zero, by its ends;
//! * with [`Chords::Within`] the value jumps, by less than the tolerance times the perimeter, as the number of chords
//!   changes.
//!
//! A hole that vanishes and corners that touch are no kinks of the area; the perimeter falls there as a root. A mitre
//! that reaches its limit, a corner that becomes straight, and an arc that gets another chord are kinks at most.
//!
//! # Method
//!
//! The raw offset has every edge moved along its normal and a join at every corner; inner corners go back through the
//! vertex. Its winding number is that of the polygon, plus one for each rectangle over an edge and piece at a corner that
//! covers a point: it is zero outside of the offset. So the offset is the union of the raw rings by the non-zero rule.
//! Inward it is a frame around all, less the offset of all that is outside of the polygon.
#[cfg(feature = "boolean")]
mod capsules;
#[cfg(feature = "boolean")]
mod edge_cells;
#[cfg(feature = "boolean")]
mod joins;
mod laid;
#[cfg(feature = "boolean")]
mod outlined;
mod raw;
mod round_border;
#[cfg(feature = "boolean")]
mod round_closing;
#[cfg(feature = "boolean")]
mod round_corners;
mod round_curves;
#[cfg(feature = "boolean")]
mod round_pieces;
#[cfg(feature = "boolean")]
mod round_search;
mod round_trace;
mod style;

pub(crate) use laid::{Before, Laid};
pub use laid::{OffsetTrace, ValidOffsetTrace, offset_replay, valid_offset_replay};
#[cfg(feature = "boolean")]
pub(crate) use outlined::united;
#[cfg(feature = "boolean")]
pub use outlined::{
    offset, offset_area, offset_perimeter, offset_search, path_offset, path_offset_search,
    valid_offset_search, valid_path_offset_search,
};
pub(crate) use raw::{Bend, Plan, cut_share, directions, right};
pub use round_border::{OffsetMeasures, round_offset_replay};
pub(crate) use round_border::{RoundBorder, sweep};
pub use round_curves::round_offset_curves;
#[cfg(feature = "boolean")]
pub use round_search::{
    round_offset_measures, round_offset_search, round_path_offset_measures,
    round_path_offset_search,
};
pub use round_trace::RoundOffsetTrace;
pub(crate) use round_trace::{OffsetCurve, PieceEnd, RoundWay};
pub use style::{Chords, End, Join, OffsetStyle};
