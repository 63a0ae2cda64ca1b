//! Results that are valid by the OGC's rules.
use super::corner::{Border, origins};
use super::faces::{BorderPiece, is_straight, parts};
use super::pieces::Pieces;
use super::records::ValidOrigin;
use super::{BooleanOperation, ValidTrace, valid_replay};
use crate::Scalar;
use crate::error::Error;
use crate::polygon::{Fill, Polygon, Rings};

/// Returns the result of a boolean operation as polygons that are valid by the OGC's rules (Simple Features, OGC
/// 06-103r4, section 6.1.11): one polygon per part, its outer ring first, counter-clockwise, then its holes, clockwise.
/// See the [module](super). Time grows with the number of pairs of edges that share a range of x.
///
/// ```
/// use geograd::{Vec2, boolean::{BooleanOperation, valid}, polygon::{self, Fill}};
/// let ring = |all: &[(f64, f64)]| all.iter().map(|&(x, y)| Vec2::new(x, y)).collect::<Vec<_>>();
/// // Two squares that touch in a corner.
/// let a = ring(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
/// let b = ring(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]);
/// let parts = valid(&a, &b, BooleanOperation::Union, Fill::NonZero)?;
/// assert_eq!(parts.iter().map(polygon::area).collect::<Vec<f64>>(), [1.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`overlay_search`](super::overlay_search).
pub fn valid<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: BooleanOperation,
    fill: Fill,
) -> Result<Vec<Polygon<S>>, Error> {
    let (a, b) = (a.into(), b.into());
    valid_search(a, b, operation, fill).map(|trace| valid_replay(a, b, &trace))
}

/// Returns the vertices of a result that is valid by the OGC's rules, and where each is from: the record of
/// [`valid_replay`]. See the [module](super).
///
/// # Errors
///
/// See [`overlay_search`](super::overlay_search).
pub fn valid_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: BooleanOperation,
    fill: Fill,
) -> Result<ValidTrace, Error> {
    let mut pieces = Pieces::snapped([a.into(), b.into()], fill)?;
    let mut all = Vec::new();
    for piece in pieces.parts(operation).into_iter().flatten().flatten() {
        let (from, to, of) = (piece.a, piece.b, all.len());
        all.push((BorderPiece { from, to, of }, pieces.border(&piece)));
    }
    let grid = &pieces.grid;
    let made = |before: &Border, after: &Border, at| match &before.edges[..] {
        // One edge continues, and is bent here.
        &[edge, ..] if before.edges == after.edges => {
            let edge = &grid.edges[edge];
            ValidOrigin::Along(edge.id, edge.share(at))
        }
        _ => {
            let [mut first, second] = origins(grid, before, after);
            if second != first {
                first.extend(second);
            }
            ValidOrigin::Of(first)
        }
    };
    let mut trace = ValidTrace::default();
    for part in parts(all.iter().map(|(piece, _)| *piece).collect()) {
        for ring in part {
            let count = ring.len();
            for (i, &k) in ring.iter().enumerate() {
                let ((piece, before), (next, after)) = (&all[k], &all[ring[(i + 1) % count]]);
                let is_same = before.edges == after.edges;
                if !(is_same && is_straight(piece.from, piece.to, next.to)) {
                    trace.places.push(grid.coordinates::<S>(piece.to));
                    trace.made.push(made(before, after, piece.to));
                }
            }
            trace.rings.push(trace.places.len());
        }
        trace.parts.push(trace.rings.len());
    }
    Ok(trace)
}
