//! The nearest of many edges, found in plain numbers side by side, for slices.
use super::edge::{edge_distance, winding_of};
use super::edge_fold::EdgeFold;
use crate::{Scalar, Vec2};

/// Edges worked on side by side, in arrays that the compiler turns into SIMD.
const SIDE: usize = 16;

/// Returns the squared distance of the origin from an edge, and the edge's contribution to the winding number around
/// the origin.
#[inline(always)]
fn measure<P: Scalar>(a: Vec2<P>, b: Vec2<P>) -> (P, P) {
    let zero = P::zero();
    let along = b - a;
    let (square, ahead, turn) = (along.length_squared(), -a.dot(along), a.perp_dot(along));
    let inside = zero.below(ahead) & ahead.below(square);
    let across = turn.over(P::select(inside, square, P::one())) * turn;
    let end = P::select(ahead.at_most(zero), a.length_squared(), b.length_squared());
    // The side is computed as in a fold over edges, so that both give one winding number next to an edge, too.
    let side = a.perp_dot(b);
    let up = a.y.at_most(zero) & zero.below(b.y) & zero.below(side);
    let down = b.y.at_most(zero) & zero.below(a.y) & side.below(zero);
    (P::select(inside, across, end), winding_of(up, down))
}

/// Returns the larger one of two numbers that are not negative.
#[inline(always)]
fn larger<P: Scalar>(a: P, b: P) -> P {
    P::select(a.below(b), b, a)
}

/// Returns `true` if a square is at most another one within rounding.
#[inline(always)]
fn about_least<P: Scalar>(square: P, least: P) -> P::Mask {
    square.at_most(least * P::lit(1.0 + 64.0 * P::format().epsilon()))
}

/// The state of a search: the least squared distance, its edge, `true` if another edge ties within rounding, the
/// winding number, and the largest coordinate of a vertex relative to the point.
struct NearestSearch<P> {
    least: P,
    edge: usize,
    tie: bool,
    winding: P,
    extent: P,
}

impl<P: Scalar<Mask = bool>> NearestSearch<P> {
    #[inline(always)]
    fn see(&mut self, square: P, edge: usize, tie: bool) {
        if square.below(self.least) {
            let tie = tie || about_least(self.least, square);
            (self.least, self.edge, self.tie) = (square, edge, tie);
        } else if about_least(square, self.least) {
            self.tie = true;
        }
    }
}

/// Returns the fold over the edges between neighbours in a path and, for a ring, from the last vertex to the
/// first. `None` where squares over- or underflow, or there are too many edges to count.
///
/// The nearest edges are found by their squared distance, and only they are measured with derivatives.
#[inline]
pub(super) fn nearest<S: Scalar<Mask = bool>>(
    point: Vec2<S>,
    path: &[Vec2<S>],
    ring: bool,
) -> Option<EdgeFold<S>> {
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let origin = Vec2::new(point.x.primal(), point.y.primal());
    let seen = |v: Vec2<S>| Vec2::new(v.x.primal(), v.y.primal()) - origin;
    let (&first, &last) = (path.first()?, path.last()?);
    let edges = path.len() - 1;
    // Block numbers are counted in the scalar itself, which is exact below 1/ε.
    if edges as f64 * S::format().epsilon() > 1.0 {
        return None;
    }
    let blocks = edges / SIDE;
    let mut least = [S::Primal::largest(); SIDE];
    let (mut block, mut again, mut winding) = ([zero; SIDE], [zero; SIDE], [zero; SIDE]);
    let mut extent = [zero; SIDE];
    for number in 0..blocks {
        let start = number * SIDE;
        let (mut x, mut y) = ([zero; SIDE + 1], [zero; SIDE + 1]);
        let vertices = &path[start..=start + SIDE];
        for ((x, y), &vertex) in x.iter_mut().zip(&mut y).zip(vertices) {
            let at = seen(vertex);
            (*x, *y) = (at.x, at.y);
        }
        let number = S::Primal::lit(number as f64);
        for k in 0..SIDE {
            let (a, b) = (Vec2::new(x[k], y[k]), Vec2::new(x[k + 1], y[k + 1]));
            let (square, turns) = measure(a, b);
            let less = square.below(least[k]);
            let pick = S::Primal::select;
            let tie = about_least(pick(less, least[k], square), pick(less, square, least[k]));
            block[k] = pick(less, number, block[k]);
            again[k] = pick(tie, one, pick(less, zero, again[k]));
            least[k] = pick(less, square, least[k]);
            winding[k] += turns;
            extent[k] = larger(extent[k], larger(a.x.unsigned(), a.y.unsigned()));
        }
    }
    let mut found = NearestSearch {
        least: S::Primal::largest(),
        edge: 0,
        tie: false,
        winding: zero,
        extent: zero,
    };
    for k in 0..SIDE {
        // Back from the scalar: the edge is found by counting, for a number need not be an integer.
        found.see(least[k], k, again[k].above(zero));
        found.winding += winding[k];
        found.extent = larger(found.extent, extent[k]);
    }
    let lane = found.edge;
    found.edge = (0..blocks)
        .find(|&number| S::Primal::lit(number as f64).equals(block[lane]))
        .map_or(0, |number| number * SIDE + lane);
    for &vertex in &path[blocks * SIDE..] {
        let at = seen(vertex);
        found.extent = larger(found.extent, larger(at.x.unsigned(), at.y.unsigned()));
    }
    for edge in blocks * SIDE..edges {
        let (square, turns) = measure(seen(path[edge]), seen(path[edge + 1]));
        found.see(square, edge, false);
        found.winding += turns;
    }
    if ring {
        let (square, turns) = measure(seen(last), seen(first));
        found.see(square, edges, false);
        found.winding += turns;
    }
    // The squares hold, and the least of them with all of its digits.
    let ordinary = S::Primal::largest_to(-0.4).below(found.least)
        & found.extent.below(S::Primal::largest_to(0.4));
    if !ordinary {
        return None;
    }
    let ends = |edge: usize| (path[edge], *path.get(edge + 1).unwrap_or(&first));
    let measured = |edge: usize| {
        let (from, to) = ends(edge);
        edge_distance(point, from, to)
    };
    let mut state = EdgeFold::nearest(measured(found.edge), S::from_primal(found.winding));
    if found.tie {
        let mut least = state.distance.primal();
        for edge in 0..edges + usize::from(ring) {
            let (from, to) = ends(edge);
            let square = measure(seen(from), seen(to)).0;
            if edge == found.edge || !about_least(square, found.least) {
                continue;
            }
            let distance = measured(edge);
            let lower = distance.primal().below(least);
            least = S::Primal::select(lower, distance.primal(), least);
            if square.equals(found.least) {
                state = state.and_also(distance);
            }
        }
        // The least as it is measured: the distance that a fold over all edges has.
        state.distance = state.distance.with_primal(least);
    }
    Some(state)
}
