//! A box in the frame of another one, and the gaps between both.
use crate::Scalar;
use crate::arrays::Each;

/// The axes after one, in order: with it they are a right-handed frame.
pub(super) const NEXT: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Box b in the frame of box a.
#[derive(Clone, Copy, Debug)]
pub(super) struct RelativeBox<S> {
    /// The vector from the centre of a to that of b, along the axes of a.
    pub c: [S; 3],
    /// That vector along the axes of b.
    pub d: [S; 3],
    /// The axes of b: of entry `[i][j]` axis j, along axis i of a.
    pub r: [[S; 3]; 3],
    /// Half the size of a.
    pub g: [S; 3],
    /// Half the size of b.
    pub h: [S; 3],
}

/// The gaps between the boxes along the normals of faces and of pairs of edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gaps<S> {
    /// Along the axes of a.
    pub a: [S; 3],
    /// Along the axes of b.
    pub b: [S; 3],
    /// Along the normal of axis i of a and axis j of b; the least number where these are parallel.
    pub edges: [[S; 3]; 3],
}

/// Returns the sign of a number without derivatives, -1 or 1; 1 of zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn sign<P: Scalar>(x: P) -> P {
    P::one().signed_as(x)
}

/// Returns the sign of a number, -1 or 1; zero for zero.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn sign_or_none<P: Scalar>(x: P) -> P {
    P::select(x.equals(P::zero()), P::zero(), sign(x))
}

/// Returns the sum of products.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn dot<S: Scalar>(x: [S; 3], y: [S; 3]) -> S {
    (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]
}

/// Returns a column of a matrix.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn column<S: Scalar>(r: &[[S; 3]; 3], j: usize) -> [S; 3] {
    [r[0][j], r[1][j], r[2][j]]
}

/// Returns the square of a product of axes below which they count as parallel, in which the boxes have a size of one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn least_square<S: Scalar>() -> S {
    S::rounding(1.0, 4)
}

impl<S: Scalar> RelativeBox<S> {
    /// Returns the relation without derivatives.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn primal(&self) -> RelativeBox<S::Primal> {
        let plain = |x: [S; 3]| x.each_as(S::primal);
        RelativeBox {
            c: plain(self.c),
            d: plain(self.d),
            r: self.r.each_as(plain),
            g: plain(self.g),
            h: plain(self.h),
        }
    }
    /// Returns the gaps along all normals. The gaps of edges are along directions that are orthogonal to both within
    /// the digits of the matrix: the difference of a product and itself in other order is exactly zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn gaps(&self) -> Gaps<S> {
        let RelativeBox { c, d, r, g, h } = self;
        let size = r.each_as(|row| row.each_as(S::magnitude));
        let edges = |i: usize, j: usize| {
            let ([k, l], [m, p]) = (NEXT[i], NEXT[j]);
            let across = |m: usize| (r[k][j] * r[l][m] - r[l][j] * r[k][m]).magnitude();
            let square = r[l][j] * r[l][j] + r[k][j] * r[k][j];
            let none = square.at_most(least_square());
            let center = (r[k][j] * c[l] - r[l][j] * c[k]).magnitude();
            let reach_a = size[l][j] * g[k] + size[k][j] * g[l];
            let reach = reach_a + (across(m) * h[m] + across(p) * h[p]);
            let length = S::select(none, S::one(), square).root();
            S::select(none, S::lowest(), (center - reach).over(length))
        };
        Gaps {
            a: [0, 1, 2].each_as(|l| (c[l].magnitude() - g[l]) - dot(size[l], *h)),
            b: [0, 1, 2].each_as(|j| (d[j].magnitude() - h[j]) - dot(column(&size, j), *g)),
            edges: [0, 1, 2].each_as(|i| [0, 1, 2].each_as(|j| edges(i, j))),
        }
    }
}

/// Returns the gaps without derivatives.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn gaps_primal<S: Scalar>(gaps: &Gaps<S>) -> Gaps<S::Primal> {
    Gaps {
        a: gaps.a.each_as(S::primal),
        b: gaps.b.each_as(S::primal),
        edges: gaps.edges.each_as(|row| row.each_as(S::primal)),
    }
}
