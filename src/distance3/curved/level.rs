//! Flat pieces that lie on each other: they touch in the middle of their overlap.
use super::piece::{Piece, PieceKind};
use super::solid_pair::{Found, Solids};
use super::support::{Supported, start};
use super::touch::{System, Touch};
use crate::Vec3;

/// The height up to which a piece is level, relative to the size.
const LEVEL: f64 = 4e-14;
/// The number of steps to a point of both pieces.
const STEPS: usize = 60;

/// Returns the largest flat piece at the height of the support, within rounding.
fn level(solid: &dyn Supported, normal: Vec3<f64>, slack: f64) -> Option<usize> {
    let highest = solid.support(normal);
    let mut found: Option<(usize, usize)> = None;
    for k in 0..solid.pieces() {
        let piece = solid.piece(k, normal);
        let dimension = match piece.kind {
            PieceKind::Face => 2,
            PieceKind::Line | PieceKind::Side => 1,
            _ => continue,
        };
        let place = start(&piece, solid.middle_of(k, &piece), normal, true);
        let rise = match piece.kind {
            PieceKind::Face => {
                let rise = |k: usize| (normal.dot(piece.ways[k]) * piece.sizes[k]).abs();
                rise(0) + rise(1)
            }
            _ => normal.dot(piece.by_share(&place)).abs(),
        };
        // Without an extent it is a point or an edge.
        let extent = match piece.kind {
            PieceKind::Face => piece.sizes[0].min(piece.sizes[1]),
            _ => piece.by_share(&place).length(),
        };
        let high = normal.dot(highest - piece.at(&place)) <= slack;
        if extent > slack && rise <= slack && high && found.is_none_or(|found| found.0 < dimension)
        {
            found = Some((dimension, k));
        }
    }
    found.map(|found| found.1)
}

/// Returns a touch in the middle of what two flat pieces share, if several points of them are equally near; else the
/// given one. The middle does not depend on rounding: it is halfway along a line through a point to which steps lead
/// that begin between the middles of both.
pub fn shared(solids: &Solids<'_>, found: Found) -> Found {
    let (normal, slack) = (found.touch.normal, LEVEL * solids.size);
    let (a, b) = (solids.a, solids.b);
    let Some(i) = level(a, normal, slack) else {
        return found;
    };
    let Some(j) = level(b, -normal, slack) else {
        return found;
    };
    let (of_a, of_b) = (a.piece(i, normal), b.piece(j, -normal));
    let way = normal * found.value;
    let on_a = |at: Vec3<f64>| a.clamped(i, &start(&of_a, at, normal, true));
    let on_b = |at: Vec3<f64>| b.clamped(j, &start(&of_b, at + way, -normal, true));
    let middle = |solid: &dyn Supported, k: usize, piece: &Piece<f64>, normal: Vec3<f64>| {
        piece.at(&start(piece, solid.middle_of(k, piece), normal, true))
    };
    let middle_a = middle(a, i, &of_a, normal);
    let middle_b = middle(b, j, &of_b, -normal) - way;
    let mut at = (middle_a + middle_b) * 0.5;
    for _ in 0..STEPS {
        let next = (of_a.at(&on_a(at)) + of_b.at(&on_b(at)) - way) * 0.5;
        let step = (next - at).length();
        at = next;
        if step <= f64::EPSILON * solids.size {
            break;
        }
    }
    let off = |at: Vec3<f64>| {
        let (p, q) = (of_a.at(&on_a(at)), of_b.at(&on_b(at)) - way);
        (p - at).length().max((q - at).length())
    };
    let between = middle_b - middle_a;
    let length = between.length();
    let common = off(at).max(slack);
    if length > slack {
        // The middle of what both have on the line through it from one middle to the other.
        let along = between * (1.0 / length);
        let reach = |side: f64| {
            let (mut inside, mut outside) = (0.0, 4.0 * solids.size);
            for _ in 0..STEPS {
                let half = 0.5 * (inside + outside);
                match off(at + along * (side * half)) <= common {
                    true => inside = half,
                    false => outside = half,
                }
            }
            inside * side
        };
        at += along * (0.5 * (reach(1.0) + reach(-1.0)));
    }
    let touch = Touch {
        normal,
        a: on_a(at),
        b: on_b(at),
    };
    let system = System::new([&of_a, &of_b], &touch);
    let error = ((of_b.at(&touch.b) - of_a.at(&touch.a)) - way).length();
    if system.rank == system.count || error > found.error.max(1e-13 * solids.size) {
        return found;
    }
    Found {
        pieces: [i, j],
        touch,
        error,
        regular: false,
        settled: true,
        ..found
    }
}
