//! Adjoint of boolean operations: cotangents of the vertices of a result go back to both inputs by the
//! record of where each is from.
use crate::boolean::{
    Origin, OverlayTrace, ValidOrigin, ValidTrace, foot, input_edge, input_vertex,
};
use crate::clipping::crossing::meet;
use crate::polygon::Rings;
use crate::{Scalar, Vec2};

/// The cotangents of both inputs, by ring and vertex.
struct Bars<'a, 'b, S> {
    inputs: [Rings<'a, S>; 2],
    all: [&'b mut [Vec2<S>]; 2],
    /// The number of the first vertex of each ring.
    firsts: [Vec<usize>; 2],
}

impl<'a, 'b, S: Scalar> Bars<'a, 'b, S> {
    fn new(inputs: [Rings<'a, S>; 2], [a_bar, b_bar]: [&'b mut [Vec2<S>]; 2]) -> Self {
        let [count_a, count_b] = inputs.map(|rings| rings.vertex_count());
        let all = [&mut a_bar[..count_a], &mut b_bar[..count_b]];
        let firsts = inputs.map(|rings| {
            let starts = rings.iter().scan(0, |next, ring| {
                *next += ring.len();
                Some(*next - ring.len())
            });
            starts.collect()
        });
        let mut bars = Bars {
            inputs,
            all,
            firsts,
        };
        for bar in bars.all.iter_mut().flat_map(|all| all.iter_mut()) {
            *bar = Vec2::zero();
        }
        bars
    }
    /// Adds the cotangent of the mean of some points.
    fn add_mean(&mut self, origins: &[Origin], bar: Vec2<S>) {
        let bar = bar * S::lit(1.0 / origins.len() as f64);
        for &origin in origins {
            pull(self.inputs, origin, bar, self);
        }
    }
    fn finish(self) {
        for bar in self.all.into_iter().flatten() {
            *bar = bar.saturated().canonical();
        }
    }
    fn add(&mut self, owner: usize, ring: usize, vertex: usize, bar: Vec2<S>) {
        self.all[owner][self.firsts[owner][ring] + vertex] += bar;
    }
    /// Adds the cotangent of a point of an edge, at a fraction of its length, to both ends.
    fn add_along(&mut self, id: crate::boolean::EdgeId, end: usize, at: S, bar: Vec2<S>) {
        let owner = id.owner as usize;
        self.add(owner, id.ring, id.edge, bar * (S::one() - at));
        self.add(owner, id.ring, end, bar * at);
    }
}

/// Returns the cotangents of both inputs of [`overlay_replay`](crate::boolean::overlay_replay) from those of the
/// vertices of the result, and so the derivatives of any function of these. The input has one cotangent per vertex, one
/// ring after the other.
///
/// A vertex that is one of an input has that one's cotangent. For a crossing at the fractions `s` and `t` of two edges
/// with directions `u` and `v`, and `k = (x̄ · u) / (v⊥ · u)`, the first edge's point has the cotangent `x̄ − k v⊥` and
/// the second's `k v⊥`; each goes to the ends of its edge as `1 − s` and `s`, `1 − t` and `t`. For the point `p + t u`
/// of an edge nearest to a vertex `w`, with `k = (x̄ · u) / |u|²` and `m = k (w − p − 2 t u)`: `w̄ = k u`,
/// `p̄ = (1 − t) x̄ − k u − m`, `q̄ = t x̄ + m`.
///
/// ```
/// # #[cfg(feature = "boolean")] {
/// use geograd::ad::adjoint::{boolean::overlay_vjp, ring::signed_area_vjp};
/// use geograd::{Aabb2, Vec2, boolean::{BooleanOperation, overlay_search, overlay_replay}, polygon::Fill};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 2.0, 2.0).corners(), Aabb2::new(1.0, 1.0, 3.0, 3.0).corners());
/// let trace = overlay_search(&a, &b, BooleanOperation::Union, Fill::NonZero)?;
/// let union = overlay_replay(&a, &b, &trace);
/// let mut bars = vec![Vec2::zero(); union.vertices().len()];
/// signed_area_vjp(union.ring(0), 1.0, &mut bars);
/// let (mut a_bar, mut b_bar) = ([Vec2::zero(); 4], [Vec2::zero(); 4]);
/// overlay_vjp(&a, &b, &trace, &bars, &mut a_bar, &mut b_bar);
/// assert_eq!(a_bar.iter().map(|bar| bar.x).sum::<f64>(), -1.0); // moving a to the right
/// # }
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Panics
///
/// When the record is of other inputs, or a list of cotangents is too short.
pub fn overlay_vjp<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &OverlayTrace,
    out_bar: &[Vec2<S>],
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) {
    let mut bars = Bars::new([a.into(), b.into()], [a_bar, b_bar]);
    for (origins, &bar) in trace.origins().zip(out_bar) {
        bars.add_mean(origins, bar);
    }
    bars.finish();
}

/// Returns the cotangents of both inputs of [`valid_replay`](crate::boolean::valid_replay) from those of the vertices of
/// the result, one part and one ring after the other. The input has one cotangent per vertex, one ring after the other.
/// A vertex passes its cotangent to its origin, as in [`overlay_vjp`]; a point at a fixed fraction of an edge shares them
/// between its ends.
///
/// # Panics
///
/// When the record is of other inputs, or a list of cotangents is too short.
pub fn valid_vjp<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &ValidTrace,
    out_bar: &[Vec2<S>],
    a_bar: &mut [Vec2<S>],
    b_bar: &mut [Vec2<S>],
) {
    let mut bars = Bars::new([a.into(), b.into()], [a_bar, b_bar]);
    for (made, &bar) in trace.made.iter().zip(out_bar) {
        match made {
            ValidOrigin::One(origin) => bars.add_mean(std::slice::from_ref(origin), bar),
            ValidOrigin::Of(origins) => bars.add_mean(origins, bar),
            &ValidOrigin::Along(edge, share) => {
                let (_, end) = input_edge(bars.inputs, edge);
                bars.add_along(edge, end, S::lit(share), bar);
            }
        }
    }
    bars.finish();
}

fn pull<S: Scalar>(
    inputs: [Rings<'_, S>; 2],
    origin: Origin,
    bar: Vec2<S>,
    bars: &mut Bars<'_, '_, S>,
) {
    match origin {
        Origin::Vertex(id) => bars.add(id.owner as usize, id.ring, id.vertex, bar),
        Origin::Cross(first, second) => {
            let (a, end_a) = input_edge(inputs, first);
            let (b, end_b) = input_edge(inputs, second);
            let met = meet(a, b);
            let across = met.along_b.perp();
            // Zero if they are parallel: the point is then the middle of the first.
            let parallel = met.along_a.perp_dot(met.along_b).equals(S::zero());
            let k = -(bar.dot(met.along_a).over(met.cross));
            let to_b = across * S::select(parallel, S::zero(), k);
            bars.add_along(first, end_a, met.at_a, bar - to_b);
            bars.add_along(second, end_b, met.at_b, to_b);
        }
        Origin::Foot { of, on } => {
            let (line, end) = input_edge(inputs, on);
            let (seen, along, share, square) = foot(input_vertex(inputs, of), line);
            let arm = seen.place(input_vertex(inputs, of)) - seen.place(line[0]);
            let k = bar.dot(along).over(square);
            let turn = (arm - along * (share + share)) * k;
            bars.add(of.owner as usize, of.ring, of.vertex, along * k);
            bars.add_along(on, end, share, bar);
            let owner = on.owner as usize;
            bars.add(owner, on.ring, on.edge, -(along * k) - turn);
            bars.add(owner, on.ring, end, turn);
        }
    }
}
