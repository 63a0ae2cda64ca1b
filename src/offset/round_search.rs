//! Searches of offsets with exact arcs, and their measures.
use super::outlined::{Subject, before, checked_distance};
use super::round_border::frame_around;
use super::round_corners::Corners;
use super::round_pieces::round_pieces;
use super::round_trace::{RoundPieces, RoundWay};
use super::{
    Chords, End, Join, OffsetMeasures, OffsetStyle, RoundOffsetTrace, offset_search,
    path_offset_search, round_offset_replay,
};
use crate::Scalar;
use crate::error::Error;
use crate::polygon::{Polygon, Rings};
use crate::predicate::wide_place;

/// The relative change of the distance by which a search decides, so that several events at one distance are apart: 2⁻⁴⁰.
/// Parallel sides that meet are gone.
const SHIFT: f64 = 1.0 / (1_u64 << 40) as f64;

/// The fewest chords per quarter of a turn where chords stand for arcs.
const LEAST_CHORDS: u32 = 128;

/// Returns the record of the border of a polygon in the given coordinates; `None` if it is not certain.
fn pieces(polygon: &Polygon<f64>, distance: f64, is_path: bool) -> Option<RoundPieces> {
    let is_inward = distance < 0.0;
    if is_path && distance <= 0.0 || polygon.vertices().is_empty() {
        return Some(RoundPieces::default());
    }
    let seen = frame_around(polygon.vertices(), distance.abs());
    let points: Vec<_> = polygon.vertices().iter().map(|&v| seen.place(v)).collect();
    let corners = Corners::new(Rings::flat(&points, polygon.ends()), is_path, is_inward)?;
    let r = distance.abs() * 0.5 * seen.scale;
    let distances = if r > 0.0 {
        [r * (1.0 + SHIFT), r * (1.0 - SHIFT), r]
    } else {
        // Sides that have moved by much less than any edge is long.
        let lengths = corners.edges.iter().map(|edge| edge.length);
        let least = lengths.fold(f64::INFINITY, f64::min).min(1.0);
        [1e-6, 1e-7, 1e-8].map(|share| share * least)
    };
    distances
        .into_iter()
        .find_map(|r| round_pieces(&corners, &points, r, is_inward))
}

fn searched<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<RoundOffsetTrace, Error> {
    style.validate()?;
    let distance = checked_distance(rings, d)?;
    let before = before(rings, style, subject)?;
    let polygon = before.polygon(rings);
    let mut own = Polygon::new();
    for ring in polygon.rings().iter() {
        own.push(ring.iter().map(|&v| wide_place(v)));
    }
    let is_path = subject == Subject::Paths;
    if let Some(all) = pieces(&own, distance, is_path) {
        let way = RoundWay::Arcs(before, all);
        return Ok(RoundOffsetTrace { way });
    }
    let quarter = style.quarter(distance.abs()).max(LEAST_CHORDS);
    let style = OffsetStyle {
        join: Join::Round,
        end: End::Round,
        chords: Chords::PerQuarter(quarter),
        ..*style
    };
    let trace = match subject {
        Subject::Polygon => offset_search(rings, d, &style)?,
        Subject::Paths => path_offset_search(rings, d, &style)?,
    };
    let way = RoundWay::Chords(trace);
    Ok(RoundOffsetTrace { way })
}

/// Returns the record of the measures of a polygon's offset with round corners, by a distance of either sign in units of
/// length. Arcs are exact: neither `chords` nor `join` of the style take part, its [`fill`](OffsetStyle::fill) and
/// [`is_trusted`](OffsetStyle::is_trusted) do. See the [module](super#exact-arcs).
///
/// Decisions are those of a distance whose size is larger by a share of 2⁻⁴⁰, so that sides that meet are gone. The record is
/// one of arcs if its pieces close. If they do not there, nor at a distance as much smaller, nor at the
/// distance itself, chords stand for arcs, at least 128 per quarter of a turn, so that the area of each
/// sector is too small by a share of 2.6 · 10⁻⁵ at most. [`RoundOffsetTrace::is_exact`] tells.
///
/// # Errors
///
/// See [`offset_search`].
pub fn round_offset_search<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<RoundOffsetTrace, Error> {
    searched(rings.into(), d, style, Subject::Polygon)
}

/// Returns the record of the measures of all that is within a distance of open paths, in units of length. It is empty for
/// a distance of zero or less. See [`round_offset_search`].
///
/// # Errors
///
/// See [`path_offset_search`].
pub fn round_path_offset_search<'a, S: Scalar<Mask = bool>>(
    paths: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<RoundOffsetTrace, Error> {
    searched(paths.into(), d, style, Subject::Paths)
}

/// Returns the area and the perimeter of a polygon's offset with round corners, arcs exact; zero where the distance empties
/// it. See [`round_offset_search`].
///
/// ```
/// use geograd::{Aabb2, offset::{OffsetStyle, round_offset_measures}};
/// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
/// let out = round_offset_measures(&square, 1.0, &OffsetStyle::default())?;
/// assert!((out.area - (16.0 + 16.0 + std::f64::consts::PI)).abs() < 1e-13);
/// assert!((out.perimeter - (16.0 + std::f64::consts::TAU)).abs() < 1e-13);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`offset_search`].
pub fn round_offset_measures<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<OffsetMeasures<S>, Error> {
    let rings = rings.into();
    round_offset_search(rings, d, style).map(|trace| round_offset_replay(rings, d, &trace))
}

/// Returns the area and the perimeter of all that is within a distance of open paths, arcs exact. See
/// [`round_path_offset_search`].
///
/// # Errors
///
/// See [`path_offset_search`].
pub fn round_path_offset_measures<'a, S: Scalar<Mask = bool>>(
    paths: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<OffsetMeasures<S>, Error> {
    let paths = paths.into();
    round_path_offset_search(paths, d, style).map(|trace| round_offset_replay(paths, d, &trace))
}
