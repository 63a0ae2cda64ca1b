//! Pieces that may touch near a point.
use super::piece::{Piece, PieceKind, Place, shares};
use super::support::{Supported, start};
use crate::Vec3;
use crate::arrays::sort_few;

/// The most pieces of a solid that are tried.
const PIECES: usize = 10;

/// A piece that may touch another one.
pub struct Candidate {
    /// The distance of its place from the point, its height below the support, and its strain.
    pub off: f64,
    /// Its number.
    pub piece: usize,
    /// The place to begin at.
    pub place: Place<f64>,
}

/// Returns by how much a piece is not stationary at a place, given a normal of length one.
fn strain(piece: &Piece<f64>, place: &Place<f64>, normal: Vec3<f64>) -> f64 {
    let along = |way: Vec3<f64>| {
        let length = way.length();
        if length > 0.0 {
            normal.dot(way).abs() / length
        } else {
            0.0
        }
    };
    let shares = shares(&piece.sizes);
    let pulled = |k: usize| match piece.kind {
        PieceKind::Face => along(piece.ways[k]),
        PieceKind::Ball => (normal.dot(piece.ways[k]) * shares[k] - place.pull * place.y[k]).abs(),
        _ => (normal.dot(piece.ways[k]) - place.pull * place.y[k]).abs(),
    };
    let by_share = if piece.kind.has_axis() {
        along(piece.by_share(place))
    } else {
        0.0
    };
    (0..piece.kind.ways()).fold(by_share, |most, k| most.max(pulled(k)))
}

/// Returns the pieces of a solid that may touch near a point along an outer normal, likely ones first.
pub fn candidates(solid: &dyn Supported, normal: Vec3<f64>, at: Vec3<f64>) -> Vec<Candidate> {
    let size = solid.size();
    let over = if size > 0.0 { 1.0 / size } else { 0.0 };
    let highest = solid.support(normal);
    let mut all = Vec::new();
    for k in 0..solid.pieces() {
        let piece = solid.piece(k, normal);
        let ways: &[bool] = if piece.kind.is_round() {
            &[true, false]
        } else {
            &[false]
        };
        for &by_normal in ways {
            let place = solid.clamped(k, &start(&piece, at, normal, by_normal));
            let point = piece.at(&place);
            let off = (point - at).length() + normal.dot(highest - point);
            // The piece with the fewest parameters is taken of those that are equally likely.
            let simple = 1e-14 * (piece.kind.ways() + usize::from(piece.kind.has_axis())) as f64;
            all.push(Candidate {
                off: off * over + strain(&piece, &place, normal) + simple,
                piece: k,
                place,
            });
        }
    }
    sort_few(&mut all, |p, q| p.off.total_cmp(&q.off).is_lt());
    all.truncate(PIECES);
    all
}
