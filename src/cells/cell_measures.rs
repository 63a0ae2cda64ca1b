//! Measures of cells, from a record.
use super::{CellBorder, CellTrace, PowerDiagram};
use crate::{Polygon, Scalar, Vec2};

/// The moments of a cell: integrals over it, about its site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellMoments<S> {
    /// The area, in squared units of length.
    pub area: S,
    /// The integral of `x − y`, in third powers of length, with the site `y`.
    pub first: Vec2<S>,
    /// The integral of `|x − y|²`, in fourth powers of length.
    pub second: S,
}

impl<S: Scalar> CellMoments<S> {
    pub(crate) fn zero() -> Self {
        CellMoments {
            area: S::zero(),
            first: Vec2::zero(),
            second: S::zero(),
        }
    }
    pub(crate) fn scaled(self, factor: S) -> Self {
        CellMoments {
            area: self.area * factor,
            first: self.first * factor,
            second: self.second * factor,
        }
    }
}

/// A side of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellSide<S> {
    /// The line that bounds the cell there.
    pub border: CellBorder,
    /// The side's start, with the cell on its left.
    pub from: Vec2<S>,
    /// The side's end.
    pub to: Vec2<S>,
}

/// A side as the sums over a cell need it: its ends are seen from the cell's site.
#[derive(Clone, Copy)]
pub(crate) struct Piece<S> {
    pub border: CellBorder,
    pub ends: [Vec2<S>; 2],
}

/// The cells of a [`PowerDiagram`], by a record.
#[derive(Clone, Debug)]
pub struct Cells<'a, 't, S> {
    pub(crate) diagram: PowerDiagram<'a, S>,
    pub(crate) trace: &'t CellTrace,
    /// The places of sites with a cell: of equal ones the mean.
    pub(crate) places: Vec<Vec2<S>>,
    weights: Vec<S>,
    /// The vertices of all rings of the domain.
    vertices: Vec<Vec2<S>>,
    /// The number of sites that share a cell, by the first one.
    pub(crate) counts: Vec<usize>,
}

/// A line seen from a site: its normal, and its height along it.
type Line<S> = (Vec2<S>, S);

/// Returns the length of a side over the distance of both sites, whose difference is `n`: negative for one that runs
/// back.
pub(crate) fn side_share<S: Scalar>(ends: [Vec2<S>; 2], n: Vec2<S>) -> S {
    let [p, q] = ends;
    n.perp_dot(q - p).over(n.length_squared())
}

impl<'a, S: Scalar<Mask = bool>> PowerDiagram<'a, S> {
    /// Returns the cells of a record, to be measured in this diagram's scalar. The record may be of other numbers, with
    /// as many sites and the same rings: results are those of the same borders, then.
    ///
    /// # Panics
    ///
    /// When the record has another number of sites.
    #[must_use]
    pub fn cells<'t>(&self, trace: &'t CellTrace) -> Cells<'a, 't, S> {
        Cells::new(*self, trace)
    }
}

impl<'a, 't, S: Scalar<Mask = bool>> Cells<'a, 't, S> {
    fn new(diagram: PowerDiagram<'a, S>, trace: &'t CellTrace) -> Self {
        let count = diagram.sites.len();
        assert_eq!(
            trace.len(),
            count,
            "the record is of another number of sites"
        );
        let mut counts = vec![0; count];
        for &first in &trace.first {
            counts[first] += 1;
        }
        let weight = |i: usize| diagram.weights.get(i).copied().unwrap_or(S::zero());
        let mut cells = Cells {
            diagram,
            trace,
            places: diagram.sites.to_vec(),
            weights: (0..count).map(weight).collect(),
            vertices: diagram.domain.iter().flatten().copied().collect(),
            counts,
        };
        // A mean with the value of the first one: what is added has the value zero.
        for (i, &first) in trace.first.iter().enumerate() {
            if first != i {
                let share = S::one().over(S::lit(cells.counts[first] as f64));
                let apart = diagram.sites[i] - diagram.sites[first];
                cells.places[first] += apart * share;
                cells.weights[first] += (weight(i) - weight(first)) * share;
            }
        }
        cells
    }
    /// Returns the number of sites.
    #[must_use]
    pub fn len(&self) -> usize {
        self.trace.len()
    }
    /// Returns `true` if there are no sites.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.trace.is_empty()
    }
    /// Returns the number of vertices of the domain.
    pub(crate) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }
    /// Returns the difference of two sites with cells.
    pub(crate) fn apart(&self, i: usize, j: usize) -> Vec2<S> {
        self.places[j] - self.places[i]
    }
    fn line(&self, i: usize, border: CellBorder) -> Line<S> {
        match border {
            CellBorder::Site(j) => {
                let n = self.apart(i, j);
                let rest = n.length_squared() + (self.weights[i] - self.weights[j]);
                (n, rest.halved())
            }
            CellBorder::Edge(ends) => {
                let [a, b] = self.edge(i, ends);
                let way = b - a;
                (Vec2::new(way.y, -way.x), a.perp_dot(way))
            }
        }
    }
    /// Returns the ends of an edge of the domain, seen from a site.
    pub(crate) fn edge(&self, i: usize, ends: [usize; 2]) -> [Vec2<S>; 2] {
        ends.map(|k| self.vertices[k] - self.places[i])
    }
    /// Returns the corner where one border ends and another starts, seen from the site.
    fn corner(&self, i: usize, borders: [CellBorder; 2], lines: [Line<S>; 2]) -> Vec2<S> {
        if let [CellBorder::Edge(_), CellBorder::Edge([from, _])] = borders {
            return self.vertices[from] - self.places[i];
        }
        let [(other, height), (n, high)] = lines;
        let foot = n * high.over(n.length_squared());
        let along = Vec2::new(-n.y, n.x);
        let slope = other.dot(along);
        if slope.equals(S::zero()) {
            return foot;
        }
        foot + along * (height - other.dot(foot)).over(slope)
    }
    /// Calls something for each side of a site's own cell.
    pub(crate) fn each_piece(&self, i: usize, mut f: impl FnMut(Piece<S>)) {
        for borders in self.trace.own_rings(i) {
            let count = borders.len();
            let line = |k: usize| self.line(i, borders[k]);
            let mut before = line(count - 1);
            let mut own = line(0);
            let first = self.corner(i, [borders[count - 1], borders[0]], [before, own]);
            let mut from = first;
            for k in 0..count {
                let to = if k + 1 < count {
                    before = own;
                    own = line(k + 1);
                    self.corner(i, [borders[k], borders[k + 1]], [before, own])
                } else {
                    first
                };
                f(Piece {
                    border: borders[k],
                    ends: [from, to],
                });
                from = to;
            }
        }
    }
    /// Returns the moments of a site's own cell, without regard to sites that share it.
    pub(crate) fn whole(&self, i: usize) -> CellMoments<S> {
        let mut sums = CellMoments::zero();
        self.each_piece(i, |Piece { ends: [p, q], .. }| {
            let cross = p.perp_dot(q);
            sums.area += cross;
            sums.first += (p + q) * cross;
            sums.second += cross * (p.length_squared() + p.dot(q) + q.length_squared());
        });
        let sixth = S::lit(1.0 / 6.0);
        CellMoments {
            area: sums.area.halved(),
            first: sums.first * sixth,
            second: sums.second * sixth.halved(),
        }
    }
    /// Returns the part of a shared cell that each of its sites has.
    pub(crate) fn part(&self, first: usize) -> S {
        S::one().over(S::lit(self.counts[first] as f64))
    }
    /// Returns the moments of each cell about its site; zeros for a hidden one.
    #[must_use]
    pub fn moments(&self) -> Vec<CellMoments<S>> {
        let mut all = vec![CellMoments::zero(); self.len()];
        for i in 0..self.len() {
            let first = self.trace.first[i];
            all[i] = match (first == i, self.counts[first]) {
                (true, 1) => self.whole(i),
                (true, _) => self.whole(i).scaled(self.part(i)),
                // The first of equals comes before them.
                (false, _) => all[first],
            };
        }
        all
    }
    /// Returns the area of each cell, in squared units of length; zero for a hidden one. Their sum is the domain's area.
    #[must_use]
    pub fn areas(&self) -> Vec<S> {
        self.moments().iter().map(|own| own.area).collect()
    }
    /// Returns the centroid of each cell; the site itself where the area is zero but for roundings.
    #[must_use]
    pub fn centroids(&self) -> Vec<Vec2<S>> {
        let all = self.moments();
        let of_site = |i: usize| {
            let (own, site) = (all[i], self.diagram.sites[i]);
            match self.has_area(i) {
                true => site + Vec2::new(own.first.x.over(own.area), own.first.y.over(own.area)),
                false => site,
            }
        };
        (0..self.len()).map(of_site).collect()
    }
    /// Returns `true` if the area of a site's cell is larger than the rounding errors of its sum.
    pub(crate) fn has_area(&self, site: usize) -> bool {
        let (mut sum, mut size) = (S::zero(), S::zero());
        self.each_piece(self.trace.first[site], |Piece { ends: [p, q], .. }| {
            let cross = p.perp_dot(q);
            sum += cross;
            size += cross.magnitude();
        });
        sum.above(size * S::rounding(64.0, 1))
    }
    /// Returns the energy of transport: the sum over cells of the integral of `|x − y|² − w`, in fourth powers of
    /// length. Its derivative by a site is `−2` times the first moment, by a weight minus the area.
    #[must_use]
    pub fn energy(&self) -> S {
        let own = (0..self.len()).filter(|&i| self.trace.first[i] == i);
        own.fold(S::zero(), |sum, i| {
            let whole = self.whole(i);
            sum + (whole.second - whole.area * self.weights[i])
        })
    }
    /// Returns the sides of a cell, counter-clockwise. A cell of several parts has sides between them that run
    /// along each other, there and back.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    #[must_use]
    pub fn sides(&self, site: usize) -> Vec<CellSide<S>> {
        let mut all = Vec::new();
        let first = self.trace.first[site];
        let place = self.places[first];
        self.each_piece(first, |Piece { border, ends }| {
            let [from, to] = ends.map(|end| place + end);
            all.push(CellSide { border, from, to });
        });
        all
    }
    /// Returns a cell as a polygon, which has no rings for a hidden site.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    #[must_use]
    pub fn polygon(&self, site: usize) -> Polygon<S> {
        let sides = self.sides(site);
        let mut starts = sides.iter().map(|side| side.from);
        let mut polygon = Polygon::from_rings([]);
        for ring in self.trace.rings(site) {
            polygon.push(starts.by_ref().take(ring.len()));
        }
        polygon
    }
}
