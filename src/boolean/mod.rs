//! Boolean operations of polygons of any kind, with the provenance of every vertex: union, intersection,
//! difference, symmetric difference.
//!
//! [`overlay_search`] (feature `boolean`) finds by exact arithmetic on integers which pieces of which edges bound the
//! result. Its record, [`OverlayTrace`], holds no numbers: a vertex of the result is a vertex of an input, or the
//! crossing of two edges. [`overlay_replay`] computes the result from the inputs and the record in the precision of the
//! scalar, so duals pass through it. The adjoint of any function of its vertices is
//! [`overlay_vjp`](crate::ad::adjoint::boolean::overlay_vjp). Both need no feature.
//!
//! Inputs are [`Rings`](crate::Rings) of any kind, crossing and self-intersecting ones included; a
//! [`Fill`](crate::polygon::Fill) decides which winding numbers are inside, for both inputs. The parts of the result
//! run counter-clockwise and its holes clockwise.
//!
//! Kinks: edges of both inputs (or several of one) that lie along each other. The border of the result moves with the
//! mean of them, so identical polygons have the IoU 1 and derivatives of zero. There the result may have two vertices
//! at one point. Between these it has a side of length zero that opens as inputs move. A vertex of one input on an edge
//! of the other has the derivative of one of its sides. A part without area is no part of a result and has no
//! derivative: a line along which both merely touch, or a polygon less itself.
//!
//! Vertices that differ by less than about 10⁻¹⁷ of the extent of both inputs count as one.
//!
//! # Validity
//!
//! A replayed result has the exact derivatives of every vertex; it is not always valid by the OGC's rules (Simple
//! Features, OGC 06-103r4), which GEOS, PostGIS and others require. Edges may cross by an ulp, rings may have no area
//! or touch themselves, and a part may consist of pieces that meet in points only.
//!
//! [`valid`] gives results that are valid: one polygon per part, with simple rings and a connected inside. Its vertices
//! are rounded to a grid of the format, with steps of the last digit of the largest coordinate, by snap rounding: rings
//! move by less than a step, and do not cross. ([`valid_search`] and [`valid_replay`] are its two halves,
//! [`valid_vjp`](crate::ad::adjoint::boolean::valid_vjp) is the adjoint.) Derivatives
//! are those of the origin of each vertex, and so, for polygons in general position, those of the usual result. A part
//! narrower than a step may vanish and has no derivative then. If edges lie along each other, two vertices at one point
//! become one, with the mean of their derivatives.
//!
//! For the area of an intersection nothing need be clipped: see
//! [`overlap_polygon::holed`](crate::overlap_polygon::holed).
//!
//! ```
//! # #[cfg(feature = "boolean")] {
//! use geograd::{Aabb2, Vec2, boolean::{BooleanOperation, Origin, overlay_search, overlay_replay}, polygon::Fill};
//! let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 2.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
//! let trace = overlay_search(&a, &b, BooleanOperation::Intersection, Fill::NonZero)?;
//! let shared = overlay_replay(&a, &b, &trace);
//! assert_eq!(geograd::polygon::area(&shared), 1.0_f64);
//! let crossings = trace.origins().filter(|of| matches!(of, [Origin::Cross(..)])).count();
//! assert_eq!((shared.vertices().len(), crossings), (4, 2));
//! # }
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! # Method
//!
//! i_overlay cuts edges on a grid of 2⁶⁰ steps (`grid`) and carries a tag per edge. `corner` reads the origin of a
//! vertex (vertex, crossing, foot) from the tags before and after it, without numbers. For valid results edges are cut
//! and rounded first (`snap`), and faces traced (`faces`). Unions with nothing whose edges keep apart or cross clearly
//! (`meetings`) need none of it: a walk along each ring knows the winding numbers on both sides (`walked`).
#[cfg(feature = "boolean")]
mod corner;
#[cfg(feature = "boolean")]
mod cut;
#[cfg(feature = "boolean")]
mod faces;
#[cfg(feature = "boolean")]
mod grid;
#[cfg(feature = "boolean")]
mod meetings;
#[cfg(feature = "boolean")]
mod pieces;
mod records;
mod replay;
#[cfg(feature = "boolean")]
mod shortcut;
#[cfg(feature = "boolean")]
mod snap;
#[cfg(feature = "boolean")]
mod valid;
#[cfg(feature = "boolean")]
mod walked;

#[cfg(feature = "boolean")]
pub(crate) use pieces::framed_search;
#[cfg(feature = "boolean")]
#[doc(hidden)]
pub use pieces::is_cut_alike;
#[cfg(feature = "boolean")]
pub use pieces::overlay_search;
pub(crate) use records::ValidOrigin;
pub use records::{
    BooleanOperation, EdgeId, IouTrace, Origin, OverlayTrace, Owner, ValidTrace, VertexId,
};
pub(crate) use replay::{foot, input_edge, input_vertex};
pub use replay::{iou_replay, overlay_replay, valid_replay};
#[cfg(feature = "boolean")]
pub use shortcut::{difference, intersection, iou_search, symmetric_difference, union};
#[cfg(feature = "boolean")]
pub(crate) use valid::valid_framed_search;
#[cfg(feature = "boolean")]
pub use valid::{valid, valid_search};
