//! The search: bounds of the domain, cut by bisectors of sites near each other.
use super::cell_cutting::{Cutter, Ring};
use super::cell_domain::Domain;
use super::site_tree::{Site, SiteTree, Waiting};
use super::{CellTrace, PowerDiagram};
use crate::predicate::{wide, wide_place};
use crate::{Polygon, Scalar, Vec2};

/// Returns the first site at each one's place with its weight, and the sites that have cells of their own.
fn welded(sites: &[Site]) -> (Vec<usize>, Vec<Site>) {
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_unstable_by(|&i, &j| {
        let (a, b) = (&sites[i], &sites[j]);
        let places = a.place[0].total_cmp(&b.place[0]);
        let places = places.then(a.place[1].total_cmp(&b.place[1]));
        places.then(b.weight.total_cmp(&a.weight)).then(i.cmp(&j))
    });
    let mut first: Vec<usize> = (0..sites.len()).collect();
    let mut is_own = vec![true; sites.len()];
    // The heaviest site at this place.
    let mut heaviest: Option<usize> = None;
    for &i in &order {
        match heaviest {
            Some(j) if sites[i].place == sites[j].place => {
                is_own[i] = false;
                if sites[i].weight == sites[j].weight {
                    first[i] = j;
                }
            }
            _ => heaviest = Some(i),
        }
    }
    let own = sites.iter().filter(|site| is_own[site.number]);
    (first, own.copied().collect())
}

impl<S: Scalar<Mask = bool>> PowerDiagram<'_, S> {
    /// Finds what bounds each cell, in time in proportion to `n log n` for sites spread over the domain.
    #[must_use]
    pub fn search(&self) -> CellTrace {
        let number = |x: S| wide(Vec2::new(x, S::zero())).map_or(0.0, |[x, _]| x);
        let sites: Vec<Site> = (0..self.sites.len())
            .map(|i| Site {
                // Both zeros are one place.
                place: wide(self.sites[i]).unwrap_or([0.0; 2]).map(|x| x + 0.0),
                weight: self.weights.get(i).map_or(0.0, |&w| number(w)),
                number: i,
            })
            .collect();
        let mut rings = Polygon::default();
        for ring in self.domain.iter() {
            rings.push(ring.iter().map(|&v| wide_place(v)));
        }
        searched(&sites, &Domain::new(&rings))
    }
}

/// Returns what bounds each cell. It knows plain numbers only, and so is compiled once.
fn searched(sites: &[Site], domain: &Domain) -> CellTrace {
    let (first, own) = welded(sites);
    let tree = SiteTree::new(own);
    // Cells in the order of the tree, whose sites need the same parts of memory, then in that of the sites.
    let mut found = CellTrace::default();
    let mut places = vec![0..0; sites.len()];
    let (mut cutter, mut waiting) = (Cutter::default(), Waiting::new());
    let mut cell = Ring::default();
    for site in &tree.sites {
        let from = found.rings.len();
        domain.start(site, &mut cell);
        if !cell.is_empty() {
            let mut reach = cell.reach();
            tree.visit(site, reach, &mut waiting, |[x, y], high, other| {
                let keeps_line = site.number < other.number;
                let n = Vec2::new(x, y);
                if cutter.cut(&mut cell, n, high, other.number, keeps_line) {
                    reach = cell.reach();
                }
                reach
            });
        }
        domain.finish(site, &mut cell, sites, &mut cutter, &mut found);
        places[site.number] = from..found.rings.len();
    }
    let mut trace = CellTrace {
        first,
        ..CellTrace::default()
    };
    for rings in places {
        for ring in rings {
            let start = ring.checked_sub(1).map_or(0, |before| found.rings[before]);
            trace.push_ring(found.borders[start..found.rings[ring]].iter().copied());
        }
        trace.cells.push(trace.rings.len());
    }
    trace
}
