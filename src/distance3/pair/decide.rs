//! The features of two boxes that are nearest, and the points on them: numbers without derivatives.
use super::super::spot::part;
use super::face::{Facing, overlap};
use super::features::{Corners, Edges, larger, smaller, turned, weight};
use super::seen::{Gaps, RelativeBox, column, dot, sign, sign_or_none};
use crate::Scalar;
use crate::arrays::Each;

/// The number of roundings of the unit by which edges must separate boxes more than faces.
const MORE: f64 = 8.0;
/// The number of roundings of the unit by which points of touching boxes may seem apart: within it planes decide the
/// direction.
const TOUCH: f64 = 32.0;
/// The number of roundings by which a point next to or on a face may seem beyond it.
const BESIDE: f64 = 8.0;

/// The features that the distance is computed from.
pub(super) struct Choice<P: Scalar> {
    /// `true` if the boxes overlap or touch.
    pub inside: P::Mask,
    /// `true` if a feature of b is nearest to a face, an edge or a corner of a, which gives the direction.
    pub by_a: P::Mask,
    /// `true` if an edge of each is. Else a corner of a is nearest to a feature of b.
    pub by_edges: P::Mask,
    /// One along the axes, of a or of b, along which the vector joins two fixed points; zero along the others.
    pub keep: [P; 3],
    /// The sides along the axes on which the other box is.
    pub out: [P; 3],
    /// The point of a along its axes, as parts of half its size.
    pub x: [P; 3],
    /// The point of b.
    pub y: [P; 3],
    /// One along the axis of a that the edge is parallel to, else zero.
    pub edge_a: [P; 3],
    /// The weights of the edges of b.
    pub edge_b: [P; 3],
    /// The side of the normal of two edges on which b is.
    pub side: P,
    /// The gap of the planes that separate the boxes best.
    pub deepest: P,
    /// The shares of the axes of a in that.
    pub share_a: [P; 3],
    /// The shares of the faces of b.
    pub share_b: [P; 3],
    /// The shares of pairs of edges.
    pub share_edges: [[P; 3]; 3],
    /// For each face of a, the point of b nearest to it along the axes of b parallel to it, as parts of half its size.
    pub lean_a: [[P; 3]; 3],
    /// For each face of b, the point of a nearest to it along the axes of a parallel to it.
    pub lean_b: [[P; 3]; 3],
}

/// Returns weights that are one for the first mask that is true and zero for all others.
#[cfg_attr(not(debug_assertions), inline(always))]
fn first_of<P: Scalar, const N: usize>(masks: [P::Mask; N]) -> [P; N] {
    let mut free = P::zero().equals(P::zero());
    masks.each_as(|mask| {
        let this = weight(mask & free);
        free = free & !mask;
        this
    })
}

/// Returns the sum of a number of nine pairs of edges, weighted by `shares`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mixed<P: Scalar>(
    edges: &[[Edges<P>; 3]; 3],
    shares: &[[P; 3]; 3],
    of: impl Fn(&Edges<P>) -> P,
) -> P {
    let mut sum = P::zero();
    for (edges, shares) in edges.iter().zip(shares) {
        for (edges, &share) in edges.iter().zip(shares) {
            sum += of(edges) * share;
        }
    }
    sum
}

/// The planes that separate the boxes best.
struct Deepest<P: Scalar> {
    value: P,
    a: [P::Mask; 3],
    b: [P::Mask; 3],
    edges: [P::Mask; 9],
    by_edges: P::Mask,
}

impl<P: Scalar> Deepest<P> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new(gaps: &Gaps<P>) -> Self {
        let most = |x: [P; 3]| larger(larger(x[0], x[1]), x[2]);
        let faces = larger(most(gaps.a), most(gaps.b));
        let edges = most(gaps.edges.each_as(most));
        let by_edges = edges.above(faces + P::rounding(MORE, 1));
        let face = |x: P| x.equals(faces) & !by_edges;
        Deepest {
            value: larger(faces, edges),
            a: gaps.a.each_as(face),
            b: gaps.b.each_as(face),
            edges: std::array::from_fn(|n| gaps.edges[n / 3][n % 3].equals(edges) & by_edges),
            by_edges,
        }
    }
    /// Returns one over the number of planes that tie.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn share(&self) -> P {
        let count = |masks: &[P::Mask]| {
            let ones = masks.iter().map(|&mask| weight::<P>(mask));
            ones.fold(P::zero(), |sum, one| sum + one)
        };
        P::one().over((count(&self.a) + count(&self.b)) + count(&self.edges))
    }
}

/// Returns the features that are nearest, or the planes that separate the boxes best, and the points there.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn decide<P: Scalar<Primal = P>>(seen: &RelativeBox<P>, gaps: &Gaps<P>) -> Choice<P> {
    let RelativeBox { c, d, r, g, h } = seen;
    let (zero, one) = (P::zero(), P::one());
    let transposed = [0, 1, 2].each_as(|j| column(r, j));
    let of_b = Corners::new(*c, *r, *h, *g);
    let of_a = Corners::new(d.each_as(|x| -x), transposed, *g, *h);
    let turned = turned(r);
    let edges = [0, 1, 2].each_as(|i| [0, 1, 2].each_as(|j| Edges::new(seen, &turned, i, j)));
    let corners = smaller(of_b.least(), of_a.least());
    let all = edges.iter().flatten();
    let least = all.fold(corners, |least, edges| smaller(least, edges.square));
    let deep = Deepest::new(gaps);
    // Flat boxes can cross without any candidate: they meet if all gaps are within rounding.
    let touch = least.at_most(P::rounding(TOUCH, 2));
    let inside = deep.value.at_most(P::rounding(BESIDE, 1)) | touch;

    // Corners that are nearest, and the points that they are nearest to.
    let ((y_b, count_b), (x_a, count_a)) = (of_b.tied(least), of_a.tied(least));
    let near_a = !count_b.equals(zero);
    let near_b = !count_a.equals(zero) & !near_a;
    let at_a =
        [0, 1, 2].each_as(|j| dot(transposed[j], [0, 1, 2].each_as(|k| g[k] * x_a[k])) - d[j]);
    let foot = |at: [P; 3], half: [P; 3]| [0, 1, 2].each_as(|k| part(at[k], half[k]));
    let y_a = foot(at_a, *h);
    // The mean of all these points of b is at most as far from a as they are.
    let total = count_a + count_b;
    let total = P::select(total.equals(zero), one, total);
    let corner_y = [0, 1, 2].each_as(|j| (y_b[j] * count_b + y_a[j] * count_a).over(total));
    let at_b = [0, 1, 2].each_as(|k| c[k] + dot(r[k], [0, 1, 2].each_as(|j| h[j] * corner_y[j])));
    let beyond = |at: P, half: P| at.unsigned().above(half + P::rounding(BESIDE, 1));
    let keep = |at: [P; 3], half: [P; 3]| [0, 1, 2].each_as(|k| weight(beyond(at[k], half[k])));
    let (keep_a, keep_b) = (keep(at_b, *g), keep(at_a, *h));

    // Edges: those nearest, or those that part best.
    let flat = |n: usize| edges[n / 3][n % 3];
    let near_edges = !near_a & !near_b;
    let chosen: [P::Mask; 9] = std::array::from_fn(|n| {
        let near = flat(n).square.equals(least) & near_edges & !inside;
        deep.edges[n] & inside | near
    });
    let first = first_of::<P, 9>(chosen);
    let shares = [0, 1, 2].each_as(|i| [0, 1, 2].each_as(|j| first[3 * i + j]));
    let by_sides = inside & deep.by_edges | !inside & near_edges;
    let of = |of: &dyn Fn(&Edges<P>) -> P| mixed(&edges, &shares, of);
    let three =
        |of_k: fn(&Edges<P>, usize) -> P| [0, 1, 2].each_as(|k| of(&|edges| of_k(edges, k)));
    let clear = of(&|edges| weight(edges.clear)).above(zero);
    // The difference of the points, if the normal has few digits.
    let rough = by_sides & !clear & !inside;
    let by_edges = by_sides & !rough;

    // Faces that part best.
    let (out_a, out_b) = (c.each_as(sign), d.each_as(sign));
    let firsts = first_of::<P, 6>([
        deep.a[0], deep.a[1], deep.a[2], deep.b[0], deep.b[1], deep.b[2],
    ]);
    let (deep_a, deep_b) = (
        [firsts[0], firsts[1], firsts[2]],
        [firsts[3], firsts[4], firsts[5]],
    );
    let sum = |x: [P; 3]| (x[0] + x[1]) + x[2];
    let lone = |x: [P; 3]| sum(x).equals(one);
    let any = |x: [P; 3]| sum(x).above(zero);

    // A face of either that the other one is over.
    let gated = |mask: P::Mask, x: [P; 3]| x.each_as(|x| P::select(mask, x, zero));
    let upright_a = three(|edges, k| edges.upright_a[k]);
    let upright_b = three(|edges, k| edges.upright_b[k]);
    let near = |near: P::Mask, keep: [P; 3], upright: [P; 3]| {
        let corner = gated(near & lone(keep), keep);
        let edge = gated(near_edges, upright);
        [0, 1, 2].each_as(|k| larger(corner[k], edge[k]))
    };
    let pick =
        |mask: P::Mask, x: [P; 3], y: [P; 3]| [0, 1, 2].each_as(|k| P::select(mask, x[k], y[k]));
    let face_a = pick(inside, deep_a, near(near_a, keep_a, upright_a));
    let face_b = pick(inside, deep_b, near(near_b, keep_b, upright_b));
    // The points.
    let corner_x = pick(near_a, foot(at_b, *g), x_a);
    let x = pick(by_sides, three(|edges, k| edges.x[k]), corner_x);
    let y = pick(by_sides, three(|edges, k| edges.y[k]), corner_y);
    let (is_a, is_b) = (any(face_a), any(face_b) & !any(face_a));
    let axis = pick(is_a, face_a, face_b);
    let own = |of: [P; 3]| {
        [0, 1, 2].each_as(|n| {
            // Along the normal, and along both sides.
            (axis[0] * of[n] + axis[1] * of[(n + 1) % 3]) + axis[2] * of[(n + 2) % 3]
        })
    };
    let matrix = [0, 1, 2].each_as(|k| pick(is_a, r[k], transposed[k]));
    let columns = [0, 1, 2].each_as(|j| own(column(&matrix, j)));
    let half = own(pick(is_a, *g, *h));
    let center = own(pick(is_a, *c, d.each_as(|x| -x)));
    let out = pick(is_a, out_a, out_b.each_as(|x| -x));
    let side = dot(axis, out);
    let lowest = columns.each_as(|column| -side.signed_as(column[0]));
    let facing = Facing {
        rows: [0, 1, 2].each_as(|n| [columns[0][n], columns[1][n], columns[2][n]]),
        center,
        half: [half[1], half[2]],
        other: pick(is_a, *h, *g),
        nearest: pick(inside, lowest, pick(is_a, y, x)),
    };
    let slack = P::select(inside, P::rounding(BESIDE, 1), zero);
    let middle = facing.middle(side, slack);
    let use_middle = (is_a | is_b) & (inside | middle.parallel);
    let own_parts = [
        side,
        part(middle.at[0], half[1]),
        part(middle.at[1], half[2]),
    ];
    // Converted from the face's axes to those of the box.
    let owner = [0, 1, 2].each_as(|k| {
        (axis[0] * own_parts[k] + axis[1] * own_parts[(k + 2) % 3])
            + axis[2] * own_parts[(k + 1) % 3]
    });

    let x = pick(use_middle, pick(is_a, owner, middle.other), x);
    let y = pick(use_middle, pick(is_a, middle.other, owner), y);
    let side = of(&|edges| edges.side);

    let by_a = inside & any(deep_a) | !inside & (near_a | rough);
    let fully = [one; 3];
    let keep_near = pick(rough, fully, pick(near_a, keep_a, keep_b));
    let keep = pick(inside, pick(any(deep_a), deep_a, deep_b), keep_near);

    // The direction along which sides of length zero grow.
    let at_a = [0, 1, 2].each_as(|k| g[k] * x[k]);
    let at_b = [0, 1, 2].each_as(|k| h[k] * y[k]);
    let way = [0, 1, 2].each_as(|k| (c[k] + dot(r[k], at_b)) - at_a[k]);
    let flat_x = [0, 1, 2].each_as(|k| sign_or_none(way[k]));
    let flat_y = [0, 1, 2].each_as(|j| -sign_or_none(dot(transposed[j], way)));
    let give = |half: &[P; 3], x: [P; 3], flat: [P; 3]| {
        [0, 1, 2].each_as(|k| P::select(half[k].equals(zero) & !inside, flat[k], x[k]))
    };

    let lean_x = [0, 1, 2].each_as(|i| overlap(g[i], c[i], dot(r[i].each_as(P::unsigned), *h)));
    let lean_y =
        [0, 1, 2].each_as(|j| overlap(h[j], -d[j], dot(transposed[j].each_as(P::unsigned), *g)));
    let flat = |x: P| x.equals(zero);
    let along_a = |l: usize, j: usize| flat(r[l][(j + 1) % 3]) & flat(r[l][(j + 2) % 3]);
    let along_b = |l: usize, j: usize| flat(r[(l + 1) % 3][j]) & flat(r[(l + 2) % 3][j]);
    // Masks of the faces of each box that are under the other one, or parallel to such a face.
    let met_a = [0, 1, 2].each_as(|l| {
        let other = (0..3).fold(zero, |sum, j| {
            sum + P::select(along_a(l, j), face_b[j], zero)
        });
        P::select(is_a, face_a[l], other).above(zero)
    });
    let met_b = [0, 1, 2].each_as(|j| {
        let other = (0..3).fold(zero, |sum, l| {
            sum + P::select(along_b(l, j), face_a[l], zero)
        });
        P::select(is_a, other, face_b[j]).above(zero)
    });
    let lean_a = [0, 1, 2].each_as(|l| {
        let lean = pick(met_a[l], y, lean_y);
        [0, 1, 2].each_as(|j| P::select(flat(r[l][j]), lean[j], zero))
    });
    let lean_b = [0, 1, 2].each_as(|j| {
        let lean = pick(met_b[j], x, lean_x);
        [0, 1, 2].each_as(|i| P::select(flat(r[i][j]), lean[i], zero))
    });
    let share = deep.share();
    let shared = |mask: P::Mask| P::select(mask, share, zero);
    Choice {
        inside,
        by_a,
        by_edges,
        keep,
        out: pick(by_a, out_a, out_b),
        x: give(g, x, flat_x),
        y: give(h, y, flat_y),
        edge_a: shares.each_as(sum),
        edge_b: [0, 1, 2].each_as(|j| sum(column(&shares, j))),
        side,
        deepest: P::select(touch & deep.value.above(zero), least.root(), deep.value),
        share_a: deep.a.each_as(shared),
        share_b: deep.b.each_as(shared),
        share_edges: [0, 1, 2].each_as(|i| [0, 1, 2].each_as(|j| shared(deep.edges[3 * i + j]))),
        lean_a,
        lean_b,
    }
}
