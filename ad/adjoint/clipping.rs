//! Adjoints of clipping: cotangents of a clipped polygon's vertices go back to both polygons by the
//! record of where each is from.
use crate::clipping::crossing::meet;
use crate::clipping::{ClipTrace, Corner};
use crate::{ConvexPolygon, Scalar, Vec2};

/// Returns the cotangents of both polygons of [`clip_replay`](crate::clipping::clip_replay) from those of the result.
///
/// A corner's cotangent is that of the vertex it is. Let a crossing be at the fractions `s` and `t` of two edges with
/// directions `u` and `v`, and let `ṗ`, `q̇` be the velocities of those points of the edges. The crossing moves by
/// `ṗ + u (v⊥ · (q̇ − ṗ)) / (v⊥ · u)`, so with `k = (x̄ · u) / (v⊥ · u)` the first edge's point has the cotangent
/// `x̄ − k v⊥` and the second's `k v⊥`; each goes to the ends of its edge as `1 − s` and `s`, `1 − t` and `t`.
#[must_use]
pub fn clip_vjp<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &ClipTrace<K>,
    out_bar: &[Vec2<S>; K],
) -> (ConvexPolygon<S, N>, ConvexPolygon<S, M>) {
    let (mut a_bar, mut b_bar) = ([Vec2::zero(); N], [Vec2::zero(); M]);
    let after = |k: usize, n: usize| if k + 1 < n { k + 1 } else { 0 };
    for (&corner, &bar) in trace.corners[..trace.count.min(K)].iter().zip(out_bar) {
        match corner {
            Corner::A(k) => a_bar[k] += bar,
            Corner::B(k) => b_bar[k] += bar,
            Corner::Cross { a: i, b: j } => {
                let (i_end, j_end) = (after(i, a.count), after(j, b.count));
                let met = meet(
                    [a.vertices[i], a.vertices[i_end]],
                    [b.vertices[j], b.vertices[j_end]],
                );
                let across = met.along_b.perp();
                // v⊥ · u = v × u, and `cross` is u × v.
                let k = -(bar.dot(met.along_a).over(met.cross));
                let to_b = across * k;
                let to_a = bar - to_b;
                a_bar[i] += to_a * (S::one() - met.at_a);
                a_bar[i_end] += to_a * met.at_a;
                b_bar[j] += to_b * (S::one() - met.at_b);
                b_bar[j_end] += to_b * met.at_b;
            }
        }
    }
    let finish = |v: Vec2<S>| v.saturated().canonical();
    (
        ConvexPolygon {
            vertices: a_bar.map(finish),
            count: a.count,
        },
        ConvexPolygon {
            vertices: b_bar.map(finish),
            count: b.count,
        },
    )
}
