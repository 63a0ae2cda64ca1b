//! Results that are valid by the OGC's rules.
use super::corner::{Border, origins};
use super::faces::{BorderPiece, is_straight, parts};
use super::grid::{Scale, Steps, invalid, squares};
use super::pieces::Pieces;
use super::records::ValidOrigin;
use super::snap::crossing;
use super::walked::{Names, WalkedVertex, walked_parts};
use super::{BooleanOperation, Owner, ValidTrace, valid_replay};
use crate::Scalar;
use crate::contain::Location;
use crate::error::Error;
use crate::polygon::{Fill, Polygon, Rings};
use i_overlay::i_float::int::point::IntPoint;

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
    let inputs = [a.into(), b.into()];
    if operation == BooleanOperation::Union && inputs[1].count() == 0 {
        let flaw = |flaw| invalid(Owner::A, flaw);
        inputs[0].validate().map_err(flaw)?;
        let is_inside = |winding| Location::Off(winding).is_inside(fill);
        if let Some(trace) = walked_valid(inputs, inputs[0], (Owner::A, 0), 0, is_inside) {
            return Ok(trace);
        }
    }
    let mut pieces = Pieces::snapped(inputs, fill)?;
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
            match first[..] {
                [only] => ValidOrigin::One(only),
                _ => ValidOrigin::Of(first),
            }
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

/// Returns the record of a valid result of rings in general position, by some steps of its grid. They are those of an input
/// from a number on.
fn walked_valid<S: Scalar<Mask = bool>>(
    inputs: [Rings<'_, S>; 2],
    rings: Rings<'_, S>,
    names: (Owner, usize),
    base: i32,
    is_inside: impl Fn(i32) -> bool,
) -> Option<ValidTrace> {
    let scale = Scale::new(inputs, Steps::Exact);
    let squares = squares::<S>();
    let one = squares.center(IntPoint::new(1, 0));
    let steps = 8.0 * scale.coordinates::<S>(squares.of(one))[0];
    let parts = walked_parts(rings, steps, base, is_inside)?;
    let names = Names::new(rings, names);
    let points: Vec<_> = rings.iter().flatten().map(|&v| scale.place(v)).collect();
    let ends = |k: usize| [points[k], points[names.next(k)]];
    let count = parts.iter().flatten().map(Vec::len).sum();
    let mut trace = ValidTrace {
        places: Vec::with_capacity(count),
        made: Vec::with_capacity(count),
        ..ValidTrace::default()
    };
    for part in parts {
        for ring in part {
            for vertex in ring {
                let at = match vertex {
                    WalkedVertex::Own(k) => points[k],
                    WalkedVertex::Cross(a, b) => crossing(ends(a), ends(b))?,
                };
                trace.places.push(scale.coordinates::<S>(squares.of(at)));
                trace.made.push(ValidOrigin::One(names.origin(vertex)));
            }
            trace.rings.push(trace.places.len());
        }
        trace.parts.push(trace.rings.len());
    }
    Some(trace)
}

/// Returns the record of the part of a frame that no ring covers, valid by the OGC's rules; see
/// [`framed_search`](super::framed_search).
pub(crate) fn valid_framed_search<S: Scalar<Mask = bool>>(
    frame: Rings<'_, S>,
    all: Rings<'_, S>,
) -> Result<ValidTrace, Error> {
    let inner: Vec<_> = all.iter().skip(1).collect();
    let own = Rings::from(&inner[..]);
    match walked_valid([frame, all], own, (Owner::B, 1), 1, |winding| winding == 0) {
        Some(trace) => Ok(trace),
        None => valid_search(frame, all, BooleanOperation::Difference, Fill::NonZero),
    }
}
