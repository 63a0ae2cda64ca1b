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
    hints: &Hints<'_, S>,
    side: f64,
    has_points: bool,
) -> Relation<S> {
    let none = Vec3::zero();
    let (mut touch, apart) = touched(a, b, record, hints, side);
    let square = square_of_gap(apart);
    let Some(pieces) = record.pieces.filter(|_| has_points) else {
        return Relation {
            apart,
            square,
            normal: none,
            on_a: none,
            on_b: none,
        };
    };
    let pair = Pair::new(a, b, pieces, hints, side);
    if record.settled {
        touch = pair.step(&touch);
    }
    let [on_a, on_b] = pair.points(&touch);
    Relation {
        apart,
        square,
        normal: touch.normal,
        on_a,
        on_b,
    }
}

/// Two solids, the decisions about them and the hints.
struct Pair<'a, S, A, B> {
    a: &'a A,
    b: &'a B,
    pieces: [usize; 2],
    hints: &'a Hints<'a, S>,
    side: S,
}

impl<'a, S: Scalar, A: Pieces<S>, B: Pieces<S>> Pair<'a, S, A, B> {
    fn new(a: &'a A, b: &'a B, pieces: [u32; 2], hints: &'a Hints<'a, S>, side: f64) -> Self {
        Pair {
            a,
            b,
            pieces: pieces.map(|piece| piece as usize),
            hints,
            side: S::lit(side),
        }
    }
    fn pieces(&self, touch: &Touch<S>) -> [Piece<S>; 2] {
        let out = touch.normal * self.side;
        let [i, j] = self.pieces;
        [self.a.piece_at(i, out), self.b.piece_at(j, -out)]
    }
    /// Returns the points of a touch.
    fn points(&self, touch: &Touch<S>) -> [Vec3<S>; 2] {
        let [of_a, of_b] = self.pieces(touch);
        [of_a.at(&touch.a), of_b.at(&touch.b)]
    }
    /// Returns the touch after one of Newton's steps.
    fn step(&self, touch: &Touch<S>) -> Touch<S> {
        let [of_a, of_b] = self.pieces(touch);
        let frame = &self.hints.frame;
        let residuals: [S; MOST] = frame.residuals([&of_a, &of_b], touch);
        let residuals = residuals.each_as(vanish);
        let kinds = [of_a.kind, of_b.kind];
        let count = 2 + kinds[0].unknowns() + kinds[1].unknowns();
        let mut changes = [S::zero(); MOST];
        for (change, row) in changes
            .iter_mut()
            .zip(self.hints.inverse.chunks_exact(MOST))
            .take(count)
        {
            for (&by, &residual) in row.iter().zip(&residuals).take(count) {
                *change += by * residual;
            }
        }
        frame.moved(kinds, touch, &changes)
    }
}

/// Returns the touch after one of Newton's steps, where the places are stationary, and the signed distance in the units of
/// the search; zero for solids that are not finite.
#[inline(never)]
pub fn touched<S: Scalar>(
    a: &impl Pieces<S>,
    b: &impl Pieces<S>,
    record: CurvedRecord,
    hints: &Hints<'_, S>,
    side: f64,
) -> (Touch<S>, S) {
    let Some(pieces) = record.pieces else {
        return (hints.touch, S::zero());
    };
    let pair = Pair::new(a, b, pieces, hints, side);
    let touch = match record.settled {
        true => pair.step(&hints.touch),
        false => hints.touch,
    };
    let [on_a, on_b] = pair.points(&touch);
    (touch, touch.normal.dot(on_b - on_a))
}
