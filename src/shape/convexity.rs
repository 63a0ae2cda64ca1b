//! Convexity of rings, decided exactly.
use crate::error::{Flaw, VertexFault};
use crate::predicate::{Turn, same, turn};
use crate::{Scalar, Vec2};

pub(super) fn check_capacity<S, const N: usize>(vertices: &[Vec2<S>]) -> Result<(), Flaw> {
    if vertices.len() > N {
        return Err(Flaw::Vertex {
            index: N,
            fault: VertexFault::Surplus,
        });
    }
    Ok(())
}

pub(super) fn check_finite<S: Scalar>(vertices: &[Vec2<S>]) -> Result<(), Flaw> {
    match vertices.iter().position(|vertex| !vertex.is_finite()) {
        Some(index) => Err(Flaw::Vertex {
            index,
            fault: VertexFault::NotFinite,
        }),
        None => Ok(()),
    }
}

/// Returns `Ok` when every vertex turns strictly left and the border runs around once.
pub(crate) fn check_convex<S: Scalar<Mask = bool>>(vertices: &[Vec2<S>]) -> Result<(), Flaw> {
    let n = vertices.len();
    let flaw = |index, fault| Err(Flaw::Vertex { index, fault });
    check_finite(vertices)?;
    for index in 0..n {
        if n > 1 && same(vertices[index], vertices[(index + 1) % n]) {
            return flaw(index, VertexFault::Repeated);
        }
    }
    if n < 3 {
        return flaw(n, VertexFault::Missing);
    }
    // A path that always turns left has gone around once it has reached its lowest point twice.
    let mut lows = 0;
    for index in 0..n {
        let (before, here) = (vertices[(index + n - 1) % n], vertices[index]);
        let after = vertices[(index + 1) % n];
        match turn(before, here, after) {
            Turn::Left => {}
            Turn::Straight => return flaw(index, VertexFault::Straight),
            Turn::Right => return flaw(index, VertexFault::Clockwise),
        }
        let order = crate::predicate::left_to_right;
        if order(here, before).is_lt() && order(here, after).is_lt() {
            lows += 1;
            if lows > 1 {
                return flaw(index, VertexFault::SecondRound);
            }
        }
    }
    Ok(())
}

/// Returns `true` if `q` is between `p` and `r`, all three on a line.
pub(super) fn between<S: Scalar<Mask = bool>>(p: Vec2<S>, q: Vec2<S>, r: Vec2<S>) -> bool {
    use crate::predicate::left_to_right as order;
    order(p, q) != order(r, q)
}

/// Returns the index of the lowest vertex by x, then by y: always a corner.
pub(super) fn corner_of<S: Scalar<Mask = bool>>(ring: &[Vec2<S>]) -> Option<usize> {
    (0..ring.len()).min_by(|&i, &j| crate::predicate::left_to_right(ring[i], ring[j]))
}

/// Returns `true` if a simple ring runs clockwise, by the turn at its lowest vertex.
pub(super) fn runs_clockwise<S: Scalar<Mask = bool>>(ring: &[Vec2<S>]) -> bool {
    let Some(corner) = corner_of(ring) else {
        return false;
    };
    let (n, here) = (ring.len(), ring[corner]);
    let other = |k: &usize| !same(ring[*k % n], here);
    let before = (corner + 1..corner + n).rev().find(other);
    let after = (corner + 1..corner + n).find(other);
    match (before, after) {
        (Some(p), Some(r)) => turn(ring[p % n], here, ring[r % n]) == Turn::Right,
        _ => false,
    }
}
