//! Searches of offsets.
use super::joins::{path_plan, polygon_plan};
use super::laid::{Before, Laid};
use super::raw::Plan;
use super::{OffsetStyle, OffsetTrace, ValidOffsetTrace};
use crate::boolean::{
    BooleanOperation, Origin, OverlayTrace, ValidTrace, framed_search, overlay_replay,
    overlay_search, valid_framed_search, valid_replay, valid_search,
};
use crate::error::{Argument, Error, Field, Flaw, VertexFault};
use crate::polygon::{self, Polygon, Rings};
use crate::predicate::{wide, wide_place};
use crate::{Scalar, Vec2};

/// The kind of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Subject {
    Polygon,
    Paths,
}

fn invalid(argument: Argument, flaw: Flaw) -> Error {
    Error::Invalid {
        argument,
        item: 0,
        flaw,
    }
}

/// Returns the polygon's own union by a fill rule.
pub(crate) fn united<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    fill: polygon::Fill,
) -> Result<Before, Error> {
    let nothing = Rings::flat(&[], &[]);
    let union = BooleanOperation::Union;
    let trace = overlay_search(rings, nothing, union, fill)?;
    // Crossings are rounded, and rings through them may cross again; vertices are not.
    if trace.origins().all(|of| matches!(of, [Origin::Vertex(_)])) {
        return Ok(Before::United(trace));
    }
    valid_search(rings, nothing, union, fill).map(Before::Valid)
}

/// Returns `Ok` when every coordinate is finite and every path has two places.
fn validate_paths<S: Scalar<Mask = bool>>(paths: Rings<'_, S>) -> Result<(), Flaw> {
    for (ring, path) in paths.iter().enumerate() {
        let flaw = |index, fault| Err(Flaw::Ring { ring, index, fault });
        if let Some(index) = path.iter().position(|vertex| !vertex.is_finite()) {
            return flaw(index, VertexFault::NotFinite);
        }
        if path.len() < 2 {
            return flaw(path.len(), VertexFault::Missing);
        }
        if path.iter().all(|v| wide(*v) == wide(path[0])) {
            return flaw(0, VertexFault::Repeated);
        }
    }
    Ok(())
}

/// Returns the polygon that is offset, from a valid input.
pub(super) fn before<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<Before, Error> {
    match subject {
        Subject::Paths => validate_paths(rings).map(|()| Before::Given),
        Subject::Polygon if style.is_trusted => rings.validate().map(|()| Before::Given),
        Subject::Polygon => return united(rings, style.fill),
    }
    .map_err(|flaw| invalid(Argument::A, flaw))
}

fn of_distance(flaw: Flaw) -> Error {
    invalid(Argument::Named("distance"), flaw)
}

/// Returns the error of a distance beyond the numbers of the format.
fn too_far() -> Error {
    let rule = "moves a vertex beyond the largest number";
    of_distance(Flaw::Broken(Field::VALUE, rule))
}

/// Returns a distance that is finite.
fn distance<S: Scalar<Mask = bool>>(d: S) -> Result<f64, Error> {
    let distance = wide(Vec2::new(d, d)).map_or(0.0, |[d, _]| d);
    if distance.is_finite() {
        Ok(distance)
    } else {
        Err(of_distance(Flaw::NotFinite(Field::VALUE)))
    }
}

/// Returns a distance that is finite and keeps all points within it of some vertices finite.
pub(super) fn checked_distance<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
) -> Result<f64, Error> {
    let distance = distance(d)?;
    // Twice as far, for the extent of the result.
    let far = (d + d).unsigned();
    let is_within = |v: &Vec2<S>| {
        let reach = v.x.unsigned().most(v.y.unsigned());
        !reach.finite() || (reach + reach + far).finite()
    };
    match rings.iter().flatten().all(is_within) {
        true => Ok(distance),
        false => Err(too_far()),
    }
}

/// Returns the decisions up to the raw rings, and both inputs of the boolean operation that makes the result.
fn laid<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<(Laid, [Polygon<S>; 2]), Error> {
    style.validate()?;
    let distance = distance(d)?;
    let before = before(rings, style, subject)?;
    let mut laid = Laid {
        before,
        plan: Plan::default(),
    };
    let polygon = laid.polygon(rings);
    let vertices = polygon.vertices().iter();
    let places: Vec<_> = vertices.map(|&v| wide_place(v)).collect();
    let own = Rings::flat(&places, polygon.ends());
    laid.plan = match subject {
        Subject::Polygon => polygon_plan(own, distance, style),
        // Nothing is nearer than zero, or less.
        Subject::Paths if distance <= 0.0 => Plan::default(),
        Subject::Paths => path_plan(own, distance, style),
    };
    let made = laid.inputs(&polygon, d);
    // A ring for each walk, after a frame where there is one.
    let is_inward = laid.plan.is_inward;
    let all = &made[usize::from(is_inward)];
    if !all.vertices().iter().all(|vertex| vertex.is_finite()) {
        return Err(too_far());
    }
    // Walks whose rings round to less than three places enclose nothing.
    let is_ring = |ring| Rings::from(ring).validate().is_ok();
    let rings = all.rings().iter().skip(usize::from(is_inward));
    let kept: Vec<bool> = rings.map(is_ring).collect();
    if kept.iter().filter(|&&kept| kept).count() < laid.plan.walks.len() {
        let mut kept = kept.into_iter();
        laid.plan.walks.retain(|_| kept.next().unwrap_or(false));
        let made = laid.inputs(&polygon, d);
        return Ok((laid, made));
    }
    Ok((laid, made))
}

fn searched<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<(OffsetTrace, [Polygon<S>; 2]), Error> {
    let (laid, [a, b]) = laid(rings, d, style, subject)?;
    let mut result = OverlayTrace::default();
    if !laid.plan.walks.is_empty() {
        result = if laid.plan.is_inward {
            framed_search(a.rings(), b.rings())?
        } else {
            overlay_search(&a, &b, BooleanOperation::Union, polygon::Fill::NonZero)?
        };
    }
    Ok((OffsetTrace { laid, result }, [a, b]))
}

fn valid_searched<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<(ValidOffsetTrace, [Polygon<S>; 2]), Error> {
    let (laid, [a, b]) = laid(rings, d, style, subject)?;
    let mut result = ValidTrace::default();
    if !laid.plan.walks.is_empty() {
        result = if laid.plan.is_inward {
            valid_framed_search(a.rings(), b.rings())?
        } else {
            valid_search(&a, &b, BooleanOperation::Union, polygon::Fill::NonZero)?
        };
    }
    Ok((ValidOffsetTrace { laid, result }, [a, b]))
}

/// Returns the parts of an offset that are valid by the OGC's rules.
fn valid_parts<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
    subject: Subject,
) -> Result<Vec<Polygon<S>>, Error> {
    let (trace, [a, b]) = valid_searched(rings, d, style, subject)?;
    Ok(valid_replay(&a, &b, &trace.result))
}

/// Returns an offset whose edges may cross by a rounding.
fn outline<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    d: S,
    style: &OffsetStyle,
) -> Result<Polygon<S>, Error> {
    let (trace, [a, b]) = searched(rings, d, style, Subject::Polygon)?;
    Ok(overlay_replay(&a, &b, &trace.result))
}

/// Returns the record of the offset of a polygon by a distance of either sign, in units of length. See the
/// [module](super).
///
/// # Errors
///
/// [`Error::Invalid`] with `A` and [`Flaw::Ring`] for a coordinate that is not finite and for a ring of fewer than three
/// distinct vertices; with the distance if it is not finite or moves vertices beyond the largest number; with the style
/// for a setting out of range.
pub fn offset_search<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<OffsetTrace, Error> {
    searched(rings.into(), d, style, Subject::Polygon).map(|found| found.0)
}

/// Returns the record of the offset of open paths by a distance, in units of length: all that is nearer than it. It is
/// empty for a distance of zero or less. See the [module](super).
///
/// # Errors
///
/// As [`offset_search`]; a path needs two distinct vertices.
pub fn path_offset_search<'a, S: Scalar<Mask = bool>>(
    paths: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<OffsetTrace, Error> {
    searched(paths.into(), d, style, Subject::Paths).map(|found| found.0)
}

/// Returns the record of an [`offset`] of a polygon that is valid by the OGC's rules.
///
/// # Errors
///
/// See [`offset_search`].
pub fn valid_offset_search<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<ValidOffsetTrace, Error> {
    valid_searched(rings.into(), d, style, Subject::Polygon).map(|found| found.0)
}

/// Returns the record of a [`path_offset`] that is valid by the OGC's rules.
///
/// # Errors
///
/// See [`path_offset_search`].
pub fn valid_path_offset_search<'a, S: Scalar<Mask = bool>>(
    paths: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<ValidOffsetTrace, Error> {
    valid_searched(paths.into(), d, style, Subject::Paths).map(|found| found.0)
}

/// Returns the offset of a polygon by a distance of either sign, in units of length, as polygons that are valid by the
/// OGC's rules: one per part, its outer ring first, counter-clockwise, then its holes, clockwise. See the
/// [module](super).
///
/// ```
/// use geograd::{Aabb2, offset::{Join, OffsetStyle, offset}, polygon};
/// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
/// let style = OffsetStyle { join: Join::Mitre(2.0), ..OffsetStyle::default() };
/// assert_eq!(polygon::area(&offset(&square, 1.0, &style)?[0]), 36.0);
/// assert_eq!(polygon::area(&offset(&square, -1.0, &style)?[0]), 4.0);
/// assert!(offset(&square, -2.5, &style)?.is_empty());
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`offset_search`].
pub fn offset<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<Vec<Polygon<S>>, Error> {
    valid_parts(rings.into(), d, style, Subject::Polygon)
}

/// Returns the offset of open paths by a distance, in units of length, as polygons that are valid by the OGC's rules.
/// See the [module](super).
///
/// ```
/// use geograd::{Vec2, offset::{End, OffsetStyle, path_offset}, polygon};
/// let path = [Vec2::new(0.0, 0.0), Vec2::new(4.0, 0.0)];
/// let style = OffsetStyle { end: End::Square, ..OffsetStyle::default() };
/// assert_eq!(polygon::area(&path_offset(&path, 1.0, &style)?[0]), 12.0);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`path_offset_search`].
pub fn path_offset<'a, S: Scalar<Mask = bool>>(
    paths: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<Vec<Polygon<S>>, Error> {
    valid_parts(paths.into(), d, style, Subject::Paths)
}

/// Returns the area of the offset of a polygon, in squared units of length; zero where the distance empties it.
///
/// ```
/// use geograd::{Aabb2, offset::{OffsetStyle, offset_area}, polygon::Fill};
/// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
/// let area = offset_area(&square, 1.0, &OffsetStyle::default())?;
/// // Chords lie inside of the arcs.
/// assert!(area < 32.0 + std::f64::consts::PI && area > 31.99 + std::f64::consts::PI);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`offset_search`].
pub fn offset_area<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<S, Error> {
    outline(rings.into(), d, style).map(|made| polygon::signed_area(&made))
}

/// Returns the perimeter of the offset of a polygon, holes included, in units of length; zero where the distance empties
/// it.
///
/// # Errors
///
/// See [`offset_search`].
pub fn offset_perimeter<'a, S: Scalar<Mask = bool>>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    style: &OffsetStyle,
) -> Result<S, Error> {
    outline(rings.into(), d, style).map(|made| polygon::perimeter(&made))
}
