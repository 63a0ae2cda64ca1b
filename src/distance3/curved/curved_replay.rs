//! The relation of two solids from what a search found, with derivatives.
//!
//! The search hands over a normal and two places as numbers without derivatives. One Newton step with the matrix of
//! plain numbers gives them first derivatives, and the signed distance, which is stationary there, first and second
//! ones. A second step gives the normal and the points second derivatives. Places on pieces that are not stationary are
//! fixed.
use super::piece::{Piece, Place};
use super::solid_pair::Found;
use super::touch::{System, Touch, lit};
use crate::arrays::Each;
use crate::distance3::relation::{Relation, square_of_gap};
use crate::distance3::spot::vanish;
use crate::{Scalar, Vec3};

/// A solid with derivatives, whose pieces a replay evaluates.
pub trait Pieces<S: Scalar>: Copy {
    /// Returns a piece by its number, seen along its outer normal.
    fn piece_at(&self, k: usize, normal: Vec3<S>) -> Piece<S>;
}

/// Returns a place of constants.
fn constant<S: Scalar>(place: &Place<f64>) -> Place<S> {
    Place {
        y: place.y.map(S::lit),
        s: S::lit(place.s),
        pull: S::lit(place.pull),
    }
}

/// Returns the relation of two solids from a touch of their pieces, given these as plain numbers, too. The side is −1
/// for points that are the farthest from each other, else 1.
pub fn replay<S: Scalar>(
    (a, b): (impl Pieces<S>, impl Pieces<S>),
    plain: [Piece<f64>; 2],
    found: &Found,
    side: f64,
) -> Relation<S> {
    let side = S::lit(side);
    let system = System::new([&plain[0], &plain[1]], &found.touch);
    let kinds = [plain[0].kind, plain[1].kind];
    let [i, j] = found.pieces;
    let mut touch = Touch {
        normal: lit::<S>(found.touch.normal),
        a: constant(&found.touch.a),
        b: constant(&found.touch.b),
    };
    let pieces = |touch: &Touch<S>| {
        let out = touch.normal * side;
        (a.piece_at(i, out), b.piece_at(j, -out))
    };
    let step = |touch: &Touch<S>| {
        let (of_a, of_b) = pieces(touch);
        let residuals = system.residuals([&of_a, &of_b], touch).each_as(vanish);
        system.moved(kinds, touch, &system.solve(&residuals))
    };
    let points = |touch: &Touch<S>| {
        let (of_a, of_b) = pieces(touch);
        [of_a.at(&touch.a), of_b.at(&touch.b)]
    };
    if found.settled {
        touch = step(&touch);
    }
    let [on_a, on_b] = points(&touch);
    let apart = touch.normal.dot(on_b - on_a);
    if found.settled {
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
