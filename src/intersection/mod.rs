//! Intersections of shapes: crossings of lines and segments, hits of rays, lengths of segments inside
//! shapes and polygons.
//!
//! | function | gives |
//! | --- | --- |
//! | [`crossing_of_lines`] | the point of two lines and its parameters |
//! | [`meeting_of_segments`] | what two segments share: nothing, a point or a segment |
//! | [`span`](span()) | the parameters at which a line enters and leaves a convex shape |
//! | [`first_hit`] | where a ray first meets the border of a convex shape |
//! | [`length_inside`] | how much of a segment lies in a convex shape |
//! | [`length_inside_ring`] | how much of a segment lies in a polygon of any kind |
//!
//! A whole number in the result is 0 without a meeting, so that results are shapes like any other. A result without a
//! meeting is finite, with derivative zero where its page states it.
//!
//! Values and derivatives are finite where every length and coordinate is zero or of a magnitude from 2⁻²⁰ to 2²⁰ in
//! `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`.
//!
//! Kinks: rays that graze a shape, where the hit jumps; directions that are parallel to a face; hits
//! of a corner, where the faces share the derivative of the parameter and the first one gives the normal.
//! Directions whose sine is below ε² count as parallel.

pub(crate) mod lines;
mod met;
mod ring;
pub mod span;
mod turns;

pub use lines::{CommonPart, CommonPoint, crossing_of_lines, meeting_of_segments};
pub use ring::{edge_inside, length_inside_ring};
pub use span::{Chord, Hit, first_hit, length_inside, span};
