//! Results that are valid by the OGC's rules.
use super::corner::origins;
use super::decide::Pieces;
use super::faces::{Piece, is_straight, parts};
use super::grid::{Grid, Steps};
use super::trace::Made;
use super::{Operation, ValidTrace, valid_replay};
use crate::Scalar;
use crate::error::Error;
use crate::polygon::{Fill, Polygon, Rings};

/// The result of a boolean operation as polygons that are valid by the OGC's rules (Simple Features, OGC 06-103r4,
/// section 6.1.11): one polygon per part, its outer ring first, counter-clockwise, then its holes, clockwise. See the
/// [module](super).
///
/// ```
/// use geograd::{Vec2, boolean::{Operation, valid}, polygon::{self, Fill}};
/// let ring = |all: &[(f64, f64)]| all.iter().map(|&(x, y)| Vec2::new(x, y)).collect::<Vec<_>>();
/// // Two squares that touch in a corner.
/// let a = ring(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
/// let b = ring(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)]);
/// let parts = valid(&a, &b, Operation::Union, Fill::NonZero)?;
/// assert_eq!(parts.iter().map(polygon::area).collect::<Vec<f64>>(), [1.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Errors
///
/// See [`overlay_decided`](super::overlay_decided).
pub fn valid<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: Operation,
    fill: Fill,
) -> Result<Vec<Polygon<S>>, Error> {
    let (a, b) = (a.into(), b.into());
    valid_decided(a, b, operation, fill).map(|trace| valid_replay(a, b, &trace))
}

/// The vertices of a result that is valid by the OGC's rules, and where each is from: the record of
/// [`valid_replay`]. See the [module](super).
///
/// # Errors
///
/// See [`overlay_decided`](super::overlay_decided).
pub fn valid_decided<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: Operation,
    fill: Fill,
) -> Result<ValidTrace, Error> {
    let mut pieces = Pieces::new([a.into(), b.into()], fill, Steps::Exact)?;
    let squares = Grid::squares::<S>();
    let mut borders = Vec::new();
    let mut ends = Vec::new();
    // Of each piece the ones before and after it in its ring.
    let mut beside = Vec::new();
    for ring in pieces.parts(operation).into_iter().flatten() {
        let (first, count) = (borders.len(), ring.len());
        for (k, piece) in ring.iter().enumerate() {
            borders.push(pieces.border(piece));
            ends.push([piece.a, piece.b]);
            beside.push([(k + count - 1) % count, (k + 1) % count].map(|k| first + k));
        }
    }
    let mut short = Vec::new();
    let mut from = Vec::new();
    for (k, path) in squares.along(&ends).into_iter().enumerate() {
        for pair in path.windows(2) {
            short.push(Piece {
                from: pair[0],
                to: pair[1],
                of: from.len(),
            });
            from.push((k, pair[0], pair[1]));
        }
    }
    let grid = &pieces.grid;
    // Where one edge goes on, which is bent as it goes through the centre of a square.
    let along = |piece: usize, at| match borders[piece].edges.first() {
        Some(&edge) => {
            let edge = &grid.edges[edge];
            Made::Along(edge.id, edge.share(squares.center(at)))
        }
        None => Made::Of(Vec::new()),
    };
    let corner = |[before, after]: [usize; 2], at| {
        if borders[before].edges == borders[after].edges {
            return along(before, at);
        }
        let [mut first, second] = origins(grid, &borders[before], &borders[after]);
        if second != first {
            first.extend(second);
        }
        Made::Of(first)
    };
    let made = |before: usize, after: usize, at| {
        if before == after {
            along(before, at)
        } else if squares.of(ends[before][1]) == at {
            corner([before, beside[before][1]], at)
        } else if squares.of(ends[after][0]) == at {
            corner([beside[after][0], after], at)
        } else {
            along(before, at)
        }
    };
    let mut trace = ValidTrace::default();
    for part in parts(short) {
        for ring in part {
            let count = ring.len();
            for (i, &k) in ring.iter().enumerate() {
                let ((before, start, at), (after, _, end)) = (from[k], from[ring[(i + 1) % count]]);
                let is_same = borders[before].edges == borders[after].edges;
                if !(is_same && is_straight(start, at, end)) {
                    trace.places.push(grid.coordinates(squares, at));
                    trace.made.push(made(before, after, at));
                }
            }
            trace.rings.push(trace.places.len());
        }
        trace.parts.push(trace.rings.len());
    }
    Ok(trace)
}
