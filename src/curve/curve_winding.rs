//! How often a piece winds around a point, as part of a closed path.
use super::curve_piece::CurvePiece;
use crate::Vec2;
use crate::predicate::{Turn, turn};

/// Halvings until the rest of a piece is a few roundings long.
const DEEPEST: u32 = 56;

/// Returns the crossings of a ray, from a point along x, by a piece: those upwards less those downwards. The sum over the pieces
/// of a closed path is its winding number.
///
/// A piece and its chord lie in the hull of its control points. A point outside of that hull sees both wind equally: the
/// chord decides, exactly. Else both halves decide, down to parts of a rounding's size.
pub(super) fn crossings(piece: CurvePiece<f64>, point: Vec2<f64>, depth: u32) -> i32 {
    if depth >= DEEPEST || !may_hold(piece, point) {
        return of_chord(piece.start(), piece.end(), point);
    }
    let [first, second] = piece.halves();
    crossings(first, point, depth + 1) + crossings(second, point, depth + 1)
}

/// Returns the crossing of the ray by a line, by a rule that gives a vertex on the ray to one of its lines.
pub(super) fn of_chord(from: Vec2<f64>, to: Vec2<f64>, point: Vec2<f64>) -> i32 {
    let (is_above, ends_above) = (from.y > point.y, to.y > point.y);
    match (is_above, ends_above) {
        (false, true) => i32::from(turn(from, to, point) == Turn::Left),
        (true, false) => -i32::from(turn(from, to, point) == Turn::Right),
        _ => 0,
    }
}

/// Returns `true` if a point is in the box around a region that holds the piece and its chord.
fn may_hold(piece: CurvePiece<f64>, point: Vec2<f64>) -> bool {
    match piece {
        CurvePiece::Line(_) => false,
        CurvePiece::Quadratic(curve) => is_among(&curve.points, point),
        CurvePiece::Cubic(curve) => is_among(&curve.points, point),
        // Half a turn at most is in a rectangle over its chord.
        CurvePiece::Arc(arc) if arc.bulge.abs() <= 1.0 => {
            let height = arc.height();
            // The middle's rounding.
            let height = height + height * (4.0 * f64::EPSILON);
            is_among(
                &[arc.from, arc.to, arc.from - height, arc.to - height],
                point,
            )
        }
        CurvePiece::Arc(arc) => arc.from != arc.to,
    }
}

/// Returns `true` if a point is in the box around others, unless that is a line along an axis, which holds the chord alone, or a
/// few roundings wide and high: halves would not become smaller.
fn is_among(all: &[Vec2<f64>], point: Vec2<f64>) -> bool {
    const FEW: f64 = 8.0 * f64::EPSILON;
    let range = |of: fn(&Vec2<f64>) -> f64| {
        let low = all.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = all.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let is_wide = high - low > FEW * low.abs().max(high.abs());
        (low < high && (low..=high).contains(&of(&point)), is_wide)
    };
    let ((by_x, is_wide), (by_y, is_high)) = (range(|p| p.x), range(|p| p.y));
    by_x && by_y && (is_wide || is_high)
}
