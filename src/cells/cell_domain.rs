//! The domain: where cells start, and what is left of them inside of it.
use super::cell_cutting::{Cutter, EDGE, Ring, bisector};
use super::site_tree::Site;
use super::{CellBorder, CellTrace};
use crate::Vec2;
use crate::polygon::{EdgeBoxes, Fill, Polygon, Sides, Slabs};

/// A domain in numbers.
pub(super) struct Domain {
    low: [f64; 2],
    high: [f64; 2],
    /// Its rings with the domain on their left: the start of each edge, and the numbers of both ends.
    rings: Vec<Vec<(Vec2<f64>, [usize; 2])>>,
    boxes: EdgeBoxes<f64>,
    slabs: Slabs<f64>,
}

/// The code of a side of the bounds of the domain, which no cell keeps.
const BOUNDS: usize = usize::MAX;

impl Domain {
    pub fn new(all: &Polygon<f64>) -> Self {
        let sides = Sides::decided(all);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for v in all.vertices() {
            for (k, x) in [v.x, v.y].into_iter().enumerate() {
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
            }
        }
        let mut first = 0;
        let mut oriented = Vec::with_capacity(all.rings().count());
        for (k, ring) in all.rings().iter().enumerate() {
            let mut own: Vec<_> = ring.iter().copied().zip(first..).collect();
            if sides.is_turned(k) {
                own.reverse();
            }
            first += ring.len();
            let next = own.iter().cycle().skip(1);
            let edges = own.iter().zip(next);
            oriented.push(
                edges
                    .map(|((v, from), (_, to))| (*v, [*from, *to]))
                    .collect(),
            );
        }
        Domain {
            low,
            high,
            rings: oriented,
            boxes: EdgeBoxes::of(all.rings()),
            slabs: Slabs::of(all.rings()),
        }
    }
    /// Writes the bounds of the domain, seen from a site.
    pub fn start(&self, site: &Site, cell: &mut Ring) {
        cell.clear();
        if self.rings.is_empty() {
            return;
        }
        let [x, y] = site.place;
        let ([left, bottom], [right, top]) = (self.low, self.high);
        let corners = [(left, bottom), (right, bottom), (right, top), (left, top)];
        for (u, v) in corners {
            cell.push(Vec2::new(u - x, v - y), BOUNDS);
        }
    }
    /// Writes the rings of a cell to the record: what is left of the cell in the domain. `cell` is what the bisectors
    /// have left of the bounds, and memory.
    pub fn finish(
        &self,
        site: &Site,
        cell: &mut Ring,
        sites: &[Site],
        cutter: &mut Cutter,
        found: &mut CellTrace,
    ) {
        if cell.is_empty() {
            return;
        }
        let [x, y] = site.place;
        let (mut low, mut high, mut sum) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], [0.0; 2]);
        for v in cell.corners() {
            for (k, x) in [v.x + x, v.y + y].into_iter().enumerate() {
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
                sum[k] += x;
            }
        }
        let slack =
            8.0 * f64::EPSILON * (low[0].abs() + high[0].abs() + low[1].abs() + high[1].abs());
        let around = [0, 1].map(|k| [low[k] - slack, high[k] + slack]);
        let count = cell.borders().len() as f64;
        let middle = Vec2::new(sum[0] / count, sum[1] / count);
        if !self.boxes.may_touch(around) {
            if !cell.borders().contains(&BOUNDS) && self.slabs.contains(middle, Fill::EvenOdd) {
                found.push_ring(cell.borders().iter().map(|&j| CellBorder::Site(j)));
            }
            return;
        }
        let mut borders = cell.borders().to_vec();
        borders.retain(|&border| border != BOUNDS);
        for ring in &self.rings {
            cell.clear();
            for (k, (v, _)) in ring.iter().enumerate() {
                cell.push(Vec2::new(v.x - x, v.y - y), EDGE | k);
            }
            for &j in &borders {
                let (n, high) = bisector(site, &sites[j]);
                cutter.cut(cell, n, high, j, site.number < j);
                if cell.is_empty() {
                    break;
                }
            }
            let mut around = cell.borders().to_vec();
            shorten(&mut around);
            if around.len() >= 3 {
                found.push_ring(around.iter().map(|&border| match border & EDGE {
                    0 => CellBorder::Site(border),
                    _ => CellBorder::Edge(ring[border ^ EDGE].1),
                }));
            }
        }
    }
}

/// Removes borders between two stretches of one line: their ends are one point, and ways there and back cancel.
fn shorten(around: &mut Vec<usize>) {
    let mut kept: Vec<usize> = Vec::with_capacity(around.len());
    for &border in around.iter() {
        if kept.last() == Some(&border) {
            continue;
        }
        match kept.len() {
            0 | 1 => kept.push(border),
            n if kept[n - 2] == border => {
                kept.pop();
            }
            _ => kept.push(border),
        }
    }
    // The same over the end.
    let (mut from, mut to) = (0, kept.len());
    while to - from > 2 {
        if kept[from] == kept[to - 1] {
            to -= 1;
        } else if kept[from + 1] == kept[to - 1] {
            from += 1;
            to -= 1;
        } else if kept[from] == kept[to - 2] {
            to -= 2;
        } else {
            break;
        }
    }
    around.clear();
    around.extend_from_slice(&kept[from..to]);
}
