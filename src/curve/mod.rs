//! Curves of the plane: circular arcs, quadratic and cubic Bézier curves, and paths of them.
//!
//! [`Arc2`], [`Quadratic2`], [`Cubic2`] and [`Segment2`](crate::Segment2) are the [`CurvePiece`]s of a [`CurvePath`], whose
//! [steps](CurveElement) have the names of SVG's. All have lengths, signed areas, bounds, nearest places and distances of
//! points; a path has winding numbers, and chords to a stated tolerance.
//!
//! ```
//! use geograd::curve::{CurveElement, CurvePath};
//! use geograd::{Pack, Vec2, gradient};
//! let at = |x: f64, y| Vec2::new(x, y);
//! let lens = CurvePath::at(at(0.0, 0.0)).curve_to(at(1.0, 2.0), at(3.0, 2.0), at(4.0, 0.0)).close();
//! let point = at(2.0, 3.5);
//! assert!((lens.signed_area() + 4.2).abs() < 1e-15); // clockwise
//! let place = lens.closest(point).expect("it has pieces");
//! let distance = |path: CurvePath<_>| path.distance_replay(point.lift(), place);
//! let (distance, by_path) = gradient(distance, lens.clone());
//! assert_eq!(Some(distance), lens.distance(point));
//! // The weight of either control point in the middle is three eighths.
//! let CurveElement::CurveTo(by_first, by_second, _) = by_path.elements()[1] else { unreachable!() };
//! assert!((by_first.y + 0.375).abs() < 1e-15 && (by_second.y + 0.375).abs() < 1e-15);
//! ```
//!
//! # Values and derivatives
//!
//! Decisions are made with plain numbers: which place is nearest, where a curve turns back, how an interval is divided.
//! A replay then computes the value in any scalar, so that gradients and Hessians by control points, bulges and points are
//! those of the exact result. Parameters that depend on the control points follow by Newton steps with plain slopes.
//!
//! * Areas are polynomials of the control points, and a closed form for arcs: smooth everywhere.
//! * Lengths have a kink where a curve stops and turns back, or has length zero.
//! * Distances have a kink where two places are equally near, of which the first one counts, and at zero.
//! * Bounds have a kink where two places share one.
//!
//! # Input
//!
//! All finite numbers are valid: repeated control points, curves on a line, cusps, loops, arcs of radius zero, curves of one
//! point. A curve of one point has length, area and derivatives of zero, and the distance of that point. An arc whose ends
//! coincide is one point; a full circle has two arcs. Results are finite where lengths and radii are zero or from 10⁻¹⁵⁰ to
//! 10¹⁵⁰ in `f64` (10⁻¹⁸ to 10¹⁸ in `f32`). Numbers that are not finite give results that are not.
//!
//! # Accuracy
//!
//! A few roundings of the size of the curve, bounds and distances included. Lengths of cubic curves are within 10⁻¹⁴ of
//! their value. The search for the nearest place isolates every zero of the slope of the distance, so that no place is
//! missed but those whose distances differ by roundings.
mod bernstein;
mod bezier;
mod circle_arc;
mod curve_bounds;
mod curve_boxes;
mod curve_length;
mod curve_nearest;
mod curve_path;
mod curve_piece;
mod curve_shapes;
mod curve_winding;
mod flattening;
mod path_verbs;

pub use bezier::{Cubic2, Quadratic2};
pub use circle_arc::Arc2;
pub use curve_boxes::CurveBoxes;
pub use curve_nearest::{CurvePlace, CurveSpot};
pub(crate) use curve_nearest::{nearest_spot, spot_replayed};
pub use curve_path::{CurveElement, CurvePath};
pub use curve_piece::CurvePiece;
