//! The relation of two solids from what a search found, with derivatives.
//!
//! The search hands over a normal and two places as numbers without derivatives. One Newton step with the matrix of
//! plain numbers gives them first derivatives, and the signed distance, which is stationary there, first and second
//! ones. A second step gives the normal and the points second derivatives. Places on pieces that are not stationary are
//! fixed.
use super::hints::{CurvedRecord, Hints};
use super::piece::Piece;
use super::touch::{MOST, Touch};
use crate::arrays::Each;
use crate::distance3::relation::{Relation, square_of_gap};
use crate::distance3::spot::vanish;
use crate::{Scalar, Vec3};

/// A solid with derivatives, whose pieces a replay evaluates.
pub trait Pieces<S: Scalar>: Copy {
    /// Returns a piece by its number, seen along its outer normal.
    fn piece_at(&self, k: usize, normal: Vec3<S>) -> Piece<S>;
}

/// Returns the relation of two solids from a touch of their pieces. The side is −1 for points that are the farthest from
/// each other, else 1. Normal and points are zero unless they are asked for.
// All pairs of shapes share it: a solid is one of a few.
#[inline(never)]
pub fn replay<S: Scalar>(
    a: &impl Pieces<S>,
    b: &impl Pieces<S>,
    record: CurvedRecord,
    hints: &Hints<S>,
    side: f64,
    has_points: bool,
) -> Relation<S> {
    let Some([i, j]) = record.pieces.map(|both| both.map(|piece| piece as usize)) else {
        let (zero, none) = (S::zero(), Vec3::zero());
        return Relation {
            apart: zero,
            square: zero,
            normal: none,
            on_a: none,
            on_b: none,
        };
    };
    let side = S::lit(side);
    let mut touch = hints.touch;
    let pieces = |touch: &Touch<S>| {
        let out = touch.normal * side;
        (a.piece_at(i, out), b.piece_at(j, -out))
    };
    let step = |touch: &Touch<S>| {
        let (of_a, of_b) = pieces(touch);
        let residuals: [S; MOST] = hints.frame.residuals([&of_a, &of_b], touch);
        let residuals = residuals.each_as(vanish);
        let kinds = [of_a.kind, of_b.kind];
        let count = 2 + kinds[0].unknowns() + kinds[1].unknowns();
        let mut changes = [S::zero(); MOST];
        for (change, row) in changes.iter_mut().zip(&hints.inverse).take(count) {
            for (&by, &residual) in row.iter().zip(&residuals).take(count) {
                *change += by * residual;
            }
        }
        hints.frame.moved(kinds, touch, &changes)
    };
    let points = |touch: &Touch<S>| {
        let (of_a, of_b) = pieces(touch);
        [of_a.at(&touch.a), of_b.at(&touch.b)]
    };
    if record.settled {
        touch = step(&touch);
    }
    let [on_a, on_b] = points(&touch);
    let apart = touch.normal.dot(on_b - on_a);
    if !has_points {
        let none = Vec3::zero();
        return Relation {
            apart,
            square: square_of_gap(apart),
            normal: none,
            on_a: none,
            on_b: none,
        };
    }
    if record.settled {
        touch = step(&touch);
    }
    let [on_a, on_b] = points(&touch);
    Relation {
        apart,
        square: square_of_gap(apart),
        normal: touch.normal,
        on_a,
        on_b,
    }
}
