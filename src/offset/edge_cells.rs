//! Edges by the cells of a grid that their boxes meet.
use crate::Vec2;

/// The most edges that are compared one by one, without a grid.
const FEW: usize = 24;

/// The most cells along an axis.
const MOST: f64 = 512.0;

/// A grid of square cells, each with the numbers of the edges near it.
pub(super) struct EdgeCells {
    low: Vec2<f64>,
    size: f64,
    counts: [usize; 2],
    /// The number of entries before each cell.
    starts: Vec<u32>,
    entries: Vec<u32>,
}

impl EdgeCells {
    /// Returns a grid for queries that reach a radius around pieces about as long as edges.
    pub fn new(edges: &[[Vec2<f64>; 2]], radius: f64) -> Self {
        let mut grid = EdgeCells {
            low: Vec2::zero(),
            size: 1.0,
            counts: [1, 1],
            starts: vec![0, edges.len() as u32],
            entries: (0..edges.len() as u32).collect(),
        };
        if edges.len() <= FEW {
            return grid;
        }
        let (mut low, mut high) = (edges[0][0], edges[0][0]);
        let mut total = 0.0;
        for &[p, q] in edges {
            for v in [p, q] {
                low = Vec2::new(low.x.min(v.x), low.y.min(v.y));
                high = Vec2::new(high.x.max(v.x), high.y.max(v.y));
            }
            total += (q - p).length();
        }
        let extent = (high.x - low.x).max(high.y - low.y);
        let mean = total / edges.len() as f64;
        grid.low = low;
        grid.size = (0.5 * radius).max(mean).max(extent / MOST);
        grid.counts = [high.x - low.x, high.y - low.y].map(|x| (x / grid.size) as usize + 1);
        let cells = grid.counts[0] * grid.counts[1];
        let mut starts = vec![0_u32; cells + 1];
        for edge in edges {
            grid.any_cell(*edge, 0.0, |cell| {
                starts[cell + 1] += 1;
                false
            });
        }
        for k in 0..cells {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut entries = vec![0; starts[cells] as usize];
        for (k, edge) in (0..).zip(edges) {
            grid.any_cell(*edge, 0.0, |cell| {
                entries[next[cell] as usize] = k;
                next[cell] += 1;
                false
            });
        }
        (grid.starts, grid.entries) = (starts, entries);
        grid
    }
    fn cells(&self, [p, q]: [Vec2<f64>; 2], reach: f64) -> [[usize; 2]; 2] {
        let of = |x: f64, low: f64, count: usize| {
            // A conversion saturates.
            (((x - low) / self.size) as usize).min(count - 1)
        };
        let axis = |a: f64, b: f64, low: f64, count: usize| {
            [
                of(a.min(b) - reach, low, count),
                of(a.max(b) + reach, low, count),
            ]
        };
        [
            axis(p.x, q.x, self.low.x, self.counts[0]),
            axis(p.y, q.y, self.low.y, self.counts[1]),
        ]
    }
    /// Calls a function with each cell that a box meets, whose sides are moved out by a reach, until it returns `true`.
    #[inline(always)]
    fn any_cell(
        &self,
        corners: [Vec2<f64>; 2],
        reach: f64,
        mut f: impl FnMut(usize) -> bool,
    ) -> bool {
        let [x, y] = self.cells(corners, reach);
        (y[0]..=y[1]).any(|row| (x[0]..=x[1]).any(|column| f(row * self.counts[0] + column)))
    }
    /// Calls a function with the edges of each cell that a box meets, whose sides are moved out by a reach, until it returns
    /// `true`. An edge may come several times.
    pub fn near(&self, corners: [Vec2<f64>; 2], reach: f64, mut f: impl FnMut(u32) -> bool) {
        self.any_cell(corners, reach, |cell| {
            let [from, to] = [self.starts[cell], self.starts[cell + 1]].map(|k| k as usize);
            self.entries[from..to].iter().any(|&k| f(k))
        });
    }
}
