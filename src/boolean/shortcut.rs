//! Results without their record, and intersection over union with it.
use super::pieces::Pieces;
use super::{BooleanOperation, IouTrace, iou_replay, overlay_replay, overlay_search};
use crate::Scalar;
use crate::error::Error;
use crate::polygon::{Fill, Polygon, Rings};

fn made<S: Scalar<Mask = bool>>(
    a: Rings<'_, S>,
    b: Rings<'_, S>,
    operation: BooleanOperation,
    fill: Fill,
) -> Result<Polygon<S>, Error> {
    overlay_search(a, b, operation, fill).map(|trace| overlay_replay(a, b, &trace))
}

/// Returns the union of two polygons of any kind. See the [module](super).
///
/// ```
/// use geograd::{Aabb2, boolean::union, polygon::{Fill, perimeter}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 2.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// assert_eq!(perimeter(&union(&a, &b, Fill::NonZero)?), 12.0);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`overlay_search`].
pub fn union<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Polygon<S>, Error> {
    made(a.into(), b.into(), BooleanOperation::Union, fill)
}

/// Returns the intersection of two polygons of any kind. See the [module](super).
///
/// # Errors
///
/// See [`overlay_search`].
pub fn intersection<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Polygon<S>, Error> {
    made(a.into(), b.into(), BooleanOperation::Intersection, fill)
}

/// Returns the difference of two polygons of any kind: the points in the first and not in the second. See the
/// [module](super).
///
/// ```
/// use geograd::{Aabb2, boolean::difference, polygon::{Fill, area}};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 3.0, 3.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let frame = difference(&a, &b, Fill::NonZero)?;
/// assert_eq!((frame.rings().count(), area(&frame)), (2, 8.0));
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`overlay_search`].
pub fn difference<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Polygon<S>, Error> {
    made(a.into(), b.into(), BooleanOperation::Difference, fill)
}

/// Returns the symmetric difference of two polygons of any kind: the points in exactly one of them. See the
/// [module](super).
///
/// # Errors
///
/// See [`overlay_search`].
pub fn symmetric_difference<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<Polygon<S>, Error> {
    made(
        a.into(),
        b.into(),
        BooleanOperation::SymmetricDifference,
        fill,
    )
}

/// Returns the intersection over union of two polygons of any kind, in `[0, 1]`, and the record of its decisions; zero
/// with derivative zero where they are apart or the union is empty. [`iou_replay`] has its derivatives.
///
/// ```
/// use geograd::{Polygon, Vec2, boolean::{iou_search, iou_replay}, polygon::Fill};
/// // A bow tie that crosses itself, and a square around it.
/// let tie = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// let square = [(-1.0, -1.0), (3.0, -1.0), (3.0, 3.0), (-1.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
/// let (iou, trace) = iou_search(&tie, &square, Fill::NonZero)?;
/// assert_eq!(iou, 0.125);
/// let both = (Polygon::from_rings([&tie[..]]), Polygon::from_rings([&square[..]]));
/// let of = |(a, b): (Polygon<_>, Polygon<_>)| iou_replay(&a, &b, &trace);
/// let (iou, (by_tie, _)) = geograd::gradient(of, both);
/// assert!(iou == 0.125 && (by_tie.ring(0)[0].x + 1.0_f64 / 32.0).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`overlay_search`].
pub fn iou_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    fill: Fill,
) -> Result<(S, IouTrace), Error> {
    let (a, b) = (a.into(), b.into());
    let mut pieces = Pieces::new([a, b], fill)?;
    let trace = IouTrace {
        intersection: pieces.trace(BooleanOperation::Intersection),
        union: pieces.trace(BooleanOperation::Union),
    };
    Ok((iou_replay(a, b, &trace), trace))
}
