//! Rings of corners, cut by lines.
use super::site_tree::Site;
use crate::Vec2;

/// The bit of a border's code that marks an edge of the domain: the rest is its place among [oriented
/// edges](super::cell_domain::Domain). Codes without it are numbers of sites.
pub(super) const EDGE: usize = 1 << (usize::BITS - 1);

/// The rounding errors of a height over a bisector: two products and three sums.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// Corners seen from the site, and the codes of the borders that start at them.
#[derive(Default)]
pub(super) struct Ring {
    x: Vec<f64>,
    y: Vec<f64>,
    borders: Vec<usize>,
}

impl Ring {
    pub fn clear(&mut self) {
        self.x.clear();
        self.y.clear();
        self.borders.clear();
    }
    pub fn push(&mut self, corner: Vec2<f64>, border: usize) {
        self.x.push(corner.x);
        self.y.push(corner.y);
        self.borders.push(border);
    }
    pub fn is_empty(&self) -> bool {
        self.borders.is_empty()
    }
    pub fn borders(&self) -> &[usize] {
        &self.borders
    }
    pub fn corners(&self) -> impl Iterator<Item = Vec2<f64>> {
        let both = self.x.iter().zip(&self.y);
        both.map(|(&x, &y)| Vec2::new(x, y))
    }
    /// Returns the squared distance of the farthest corner from the site; −1 without corners.
    pub fn reach(&self) -> f64 {
        let squares = self.x.iter().zip(&self.y);
        squares.fold(-1.0, |most, (x, y)| f64::max(most, x * x + y * y))
    }
}

/// Memory for cutting.
#[derive(Default)]
pub(super) struct Cutter {
    next: Ring,
    heights: Vec<f64>,
}

impl Cutter {
    /// Keeps of a ring what has `x·n ≤ high`, with a new border along the line. Corners within rounding errors of the
    /// line are on it, and kept by one of its sides only: then what both sides keep of an edge along it does not overlap.
    /// Returns `false` where nothing is cut.
    ///
    /// The parts that are left of a ring that is not convex hang together along the line (Sutherland and Hodgman,
    /// 1974): sums over its sides are those of the parts.
    pub fn cut(
        &mut self,
        ring: &mut Ring,
        n: Vec2<f64>,
        high: f64,
        border: usize,
        keeps_line: bool,
    ) -> bool {
        let sizes = ring.x.iter().zip(&ring.y);
        let (most, size) = sizes.fold((f64::NEG_INFINITY, 0.0), |(most, size), (x, y)| {
            let (x, y) = (x * n.x, y * n.y);
            (f64::max(most, x + y), f64::max(size, x.abs() + y.abs()))
        });
        // Well on the kept side, all of it.
        if most < high - SLACK * (high.abs() + size) {
            return false;
        }
        let is_kept = |height: f64| height > 0.0 || keeps_line && height == 0.0;
        self.heights.clear();
        let mut is_cut = false;
        for (x, y) in ring.x.iter().zip(&ring.y) {
            let (x, y) = (x * n.x, y * n.y);
            let height = high - (x + y);
            let slack = SLACK * (high.abs() + x.abs() + y.abs());
            let height = if height.abs() <= slack { 0.0 } else { height };
            is_cut |= !is_kept(height);
            self.heights.push(height);
        }
        if !is_cut {
            return false;
        }
        self.next.clear();
        let count = ring.borders.len();
        for k in 0..count {
            let after = if k + 1 < count { k + 1 } else { 0 };
            let (own, s, t) = (ring.borders[k], self.heights[k], self.heights[after]);
            let p = Vec2::new(ring.x[k], ring.y[k]);
            let is_start_kept = is_kept(s);
            if is_start_kept {
                self.next.push(p, own);
            }
            if is_start_kept != is_kept(t) {
                let q = Vec2::new(ring.x[after], ring.y[after]);
                // The new border starts where the ring leaves; where it enters, its own goes on.
                let border = if is_start_kept { border } else { own };
                self.next.push(p + (q - p) * (s / (s - t)), border);
            }
        }
        std::mem::swap(ring, &mut self.next);
        if ring.borders.len() < 3 {
            ring.clear();
        }
        true
    }
}

/// Returns the normal of the bisector with another site, and the height of the line, both seen from the site.
#[inline]
pub(super) fn bisector(site: &Site, other: &Site) -> (Vec2<f64>, f64) {
    let [x, y] = [0, 1].map(|k| other.place[k] - site.place[k]);
    let n = Vec2::new(x, y);
    (n, (n.length_squared() + (site.weight - other.weight)) / 2.0)
}
