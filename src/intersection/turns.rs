//! On which sides of two segments the ends of the other one are, exactly and without branches.
use crate::distance::edge::{scale_of, size_of};
use crate::twofold::{Halves, sum};
use crate::{Mask, Scalar, Vec2};

/// The sides of the ends of two segments. Signs are those of exact arithmetic; sizes are in units of the longest
/// difference in their products, and right to some roundings.
#[derive(Clone, Copy, Debug)]
pub(super) struct EndSides<P> {
    /// The sides of both ends of the other segment, seen along the base: positive to the left.
    pub of_other: [P; 2],
    /// The sides of both ends of the base, seen along the other segment.
    pub of_base: [P; 2],
}

/// Returns the sum of two exact sums, from small to large (Shewchuk's expansion sum; zeros stay).
#[inline(always)]
fn joined<P: Scalar, const N: usize, const M: usize, const SUM: usize>(
    a: [P; N],
    b: [P; M],
) -> [P; SUM] {
    let mut all = [P::zero(); SUM];
    all[..N].copy_from_slice(&a);
    for (i, &part) in b.iter().enumerate() {
        let mut carry = part;
        for place in &mut all[i..N + i] {
            [*place, carry] = sum(carry, *place);
        }
        all[N + i] = carry;
    }
    all
}

type Point<P> = [Halves<P>; 2];

/// Returns the cross product of two points, exactly.
#[inline(always)]
fn cross<P: Scalar>(p: Point<P>, q: Point<P>) -> [P; 4] {
    let less = p[1].times(q[0]);
    joined(p[0].times(q[1]), [-less[0], -less[1]])
}

/// Returns the side of c as seen from a to b, from the cross products a × b, b × c and c × a: a number with the exact
/// sign.
#[inline(always)]
fn side<P: Scalar>(ab: [P; 4], bc: [P; 4], ca: [P; 4]) -> P {
    let two: [P; 8] = joined(ab, bc);
    let all: [P; 12] = joined(two, ca);
    // Parts do not overlap nor touch, so their sum from small to large has the sign of the largest one.
    all.into_iter().fold(P::zero(), |sum, part| sum + part)
}

/// Returns the exact signs, from the cross products of all pairs of points.
#[cold]
#[inline(never)]
fn exact<P: Scalar>(base: [Vec2<P>; 2], other: [Vec2<P>; 2], scale: P) -> EndSides<P> {
    let halves = |v: Vec2<P>| [Halves::of(v.x * scale), Halves::of(v.y * scale)];
    let [a, b, p, q] = [base[0], base[1], other[0], other[1]].map(halves);
    let minus = |all: [P; 4]| all.map(|part| -part);
    let (ab, pq) = (cross(a, b), cross(p, q));
    let [ap, aq, bp, bq] = [cross(a, p), cross(a, q), cross(b, p), cross(b, q)];
    EndSides {
        of_other: [side(ab, bp, minus(ap)), side(ab, bq, minus(aq))],
        of_base: [side(pq, minus(aq), ap), side(pq, minus(bq), bp)],
    }
}

impl<P: Scalar<Primal = P>> EndSides<P> {
    /// Returns the turns from the ends of both segments and a power of two that brings their differences near one.
    #[inline(always)]
    pub fn of(base: [Vec2<P>; 2], other: [Vec2<P>; 2], scale: P) -> Self {
        let [d, e, w, far, back] = [
            base[1] - base[0],
            other[1] - other[0],
            other[0] - base[0],
            other[1] - base[0],
            base[1] - other[0],
        ]
        .map(|way| way * scale);
        let rounded = EndSides {
            of_other: [d.perp_dot(w), d.perp_dot(far)],
            of_base: [w.perp_dot(e), e.perp_dot(back)],
        };
        let all = rounded.of_other.into_iter().chain(rounded.of_base);
        let least = all.fold(P::largest(), |least, x| least.least(x.unsigned()));
        // Coordinates of differences are below 8, and a product of two and their difference take four roundings of half
        // an ε each.
        let doubt = least.at_most(P::rounding(256.0, 1));
        if !doubt.any() {
            return rounded;
        }
        let size = [base[0], base[1], other[0], other[1]]
            .into_iter()
            .fold(P::zero(), |most, point| most.most(size_of(point)));
        let far = scale_of::<P>(size);
        let exact = exact(base, other, far);
        let unit = scale.over(far);
        let pick = |exact: [P; 2], rounded: [P; 2]| {
            [0, 1].map(|k| P::select(doubt, exact[k] * unit * unit, rounded[k]))
        };
        EndSides {
            of_other: pick(exact.of_other, rounded.of_other),
            of_base: pick(exact.of_base, rounded.of_base),
        }
    }
}
