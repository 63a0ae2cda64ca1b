//! Second derivatives: sparse matrices over pairs of sites whose cells share a side.
use super::cell_measures::{Piece, side_share};
use super::{CellBorder, Cells};
use crate::{Scalar, Vec2};

/// A block of a matrix of blocks.
type Block<S, const N: usize> = [[S; N]; N];

fn add<S: Scalar, const N: usize>(sum: &mut Block<S, N>, block: Block<S, N>) {
    for (row, others) in sum.iter_mut().zip(block) {
        for (x, other) in row.iter_mut().zip(others) {
            *x += other;
        }
    }
}

/// Returns the integral of `f gᵀ` along a way of length one, for linear functions given at both ends: exact by Simpson's
/// rule.
fn integral<S: Scalar>(f: [[S; 3]; 2], g: [[S; 3]; 2]) -> Block<S, 3> {
    let middle = |[a, b]: [[S; 3]; 2]| [0, 1, 2].map(|k| (a[k] + b[k]).halved());
    let (fm, gm) = (middle(f), middle(g));
    let (four, sixth) = (S::lit(4.0), S::lit(1.0 / 6.0));
    [0, 1, 2].map(|k| {
        [0, 1, 2].map(|l| {
            let ends = f[0][k] * g[0][l] + f[1][k] * g[1][l];
            (ends + four * (fm[k] * gm[l])) * sixth
        })
    })
}

impl<S: Scalar<Mask = bool>> Cells<'_, '_, S> {
    /// Returns the derivatives of areas by weights: `(i, j, ∂areaᵢ/∂wⱼ)` for each cell and each site that it depends on,
    /// sorted. The matrix is symmetric and its rows sum to zero, up to roundings.
    ///
    /// Minus this matrix is the Hessian by weights of the energy, and so of the dual of semi-discrete transport.
    ///
    /// ```
    /// use geograd::{Aabb2, Vec2, cells::PowerDiagram};
    /// let domain = Aabb2::new(0.0_f64, 0.0, 4.0, 2.0).corners();
    /// let sites = [Vec2::new(1.0, 1.0), Vec2::new(3.0, 1.0)];
    /// let (mut weights, wanted) = ([0.0; 2], [6.0, 2.0]);
    /// // One step of Newton: two cells depend on the difference of their weights.
    /// let diagram = PowerDiagram::new(&sites, &weights, &domain)?;
    /// let trace = diagram.search();
    /// let cells = diagram.cells(&trace);
    /// weights[0] += (wanted[0] - cells.areas()[0]) / cells.area_slopes()[0].2;
    /// let diagram = PowerDiagram::new(&sites, &weights, &domain)?;
    /// assert_eq!(diagram.cells(&diagram.search()).areas(), wanted);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub fn area_slopes(&self) -> Vec<(usize, usize, S)> {
        let blocks = self.blocks(|_, _, share| [[[share]], [[-share]]], |_| [[S::zero()]]);
        blocks
            .into_iter()
            .map(|(i, j, [[slope]])| (i, j, slope))
            .collect()
    }
    /// Returns the Hessian of the [`energy`](Self::energy) by sites and weights: `(i, j, block)`, sorted, with the rows
    /// and columns of a block in the order x, y, weight.
    ///
    /// With `fᵢ = (2(x − yᵢ), 1)` and the distance `D` of both sites, the block of two sites is the integral of
    /// `fᵢ fⱼᵀ/(2D)` over their side. One on the diagonal is `diag(2a, 2a, 0)`, with the area `a`, less the integrals of
    /// `fᵢ fᵢᵀ/(2D)` over all sides.
    #[must_use]
    pub fn energy_hessian(&self) -> Vec<(usize, usize, Block<S, 3>)> {
        let weighed = |block: Block<S, 3>, by: S| block.map(|row| row.map(|x| x * by));
        let of_side = |[p, q]: [Vec2<S>; 2], n: Vec2<S>, share: S| {
            let seen = |v: Vec2<S>| [v.x + v.x, v.y + v.y, S::one()];
            let (own, other) = ([p, q].map(seen), [p - n, q - n].map(seen));
            [
                weighed(integral(own, own), -share),
                weighed(integral(own, other), share),
            ]
        };
        let of_cell = |i: usize| {
            let area = self.whole(i).area;
            let mut block = [[S::zero(); 3]; 3];
            (block[0][0], block[1][1]) = (area + area, area + area);
            block
        };
        self.blocks(of_side, of_cell)
    }
    /// Returns a matrix over sites. `of_side` gives what a side adds for its cell itself and for its neighbour, from its
    /// ends, the difference of both sites, and half its length over their distance. `of_cell` gives what a cell adds.
    fn blocks<const N: usize>(
        &self,
        of_side: impl Fn([Vec2<S>; 2], Vec2<S>, S) -> [Block<S, N>; 2],
        of_cell: impl Fn(usize) -> Block<S, N>,
    ) -> Vec<(usize, usize, Block<S, N>)> {
        let mut sharing = vec![Vec::new(); self.len()];
        for i in 0..self.len() {
            sharing[self.trace.first(i)].push(i);
        }
        let mut found = Vec::new();
        let mut row: Vec<(usize, Block<S, N>)> = Vec::new();
        for i in 0..self.len() {
            if self.trace.own_rings(i).next().is_none() {
                continue;
            }
            row.clear();
            let mut own = of_cell(i);
            self.each_piece(i, |Piece { border, ends }| {
                if let CellBorder::Site(j) = border {
                    let n = self.apart(i, j);
                    let [diagonal, other] = of_side(ends, n, side_share(ends, n).halved());
                    add(&mut own, diagonal);
                    match row.iter_mut().find(|(known, _)| *known == j) {
                        Some((_, sum)) => add(sum, other),
                        None => row.push((j, other)),
                    }
                }
            });
            row.push((i, own));
            for &(j, block) in &row {
                // Each of the sites at one place moves their mean.
                let part = self.part(i) * self.part(j);
                let block = block.map(|row| row.map(|x| x * part));
                for &first in &sharing[i] {
                    found.extend(sharing[j].iter().map(|&second| (first, second, block)));
                }
            }
        }
        found.sort_unstable_by_key(|(i, j, _)| (*i, *j));
        found
    }
}
