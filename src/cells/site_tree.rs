//! A tree of sites, for those that can reach a cell.
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Nodes that wait for a visit: their squared distances and places. Bits of numbers that are not negative have the
/// order of the numbers.
pub(super) type Waiting = BinaryHeap<Reverse<(u64, usize)>>;

/// The number of sites in a leaf.
const FEW: usize = 6;

/// A site: its place, its weight, its number.
#[derive(Clone, Copy)]
pub(super) struct Site {
    pub place: [f64; 2],
    pub weight: f64,
    pub number: usize,
}

/// Sites of one part of the plane: of a leaf themselves, else those of two nodes.
struct Node {
    low: [f64; 2],
    high: [f64; 2],
    heaviest: f64,
    from: usize,
    to: usize,
    /// The second of both nodes; the first one follows its parent. Zero for a leaf.
    second: usize,
}

/// Sites in order of a tree: neighbours are near each other.
pub(super) struct SiteTree {
    pub sites: Vec<Site>,
    nodes: Vec<Node>,
}

impl SiteTree {
    pub fn new(sites: Vec<Site>) -> Self {
        let mut tree = SiteTree {
            nodes: Vec::with_capacity(sites.len() / 2 + 1),
            sites,
        };
        if !tree.sites.is_empty() {
            tree.split(0, tree.sites.len());
        }
        tree
    }
    /// Creates the nodes of some sites. The depth is the logarithm of their number, since halves are equal.
    fn split(&mut self, from: usize, to: usize) {
        let own = &mut self.sites[from..to];
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut heaviest = f64::NEG_INFINITY;
        for site in own.iter() {
            for k in 0..2 {
                low[k] = low[k].min(site.place[k]);
                high[k] = high[k].max(site.place[k]);
            }
            heaviest = heaviest.max(site.weight);
        }
        let node = self.nodes.len();
        let half = own.len() / 2;
        if own.len() > FEW {
            let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
            let order = |a: &Site, b: &Site| {
                let numbers = || a.number.cmp(&b.number);
                a.place[axis].total_cmp(&b.place[axis]).then_with(numbers)
            };
            own.select_nth_unstable_by(half, order);
        }
        let is_leaf = own.len() <= FEW;
        self.nodes.push(Node {
            low,
            high,
            heaviest,
            from,
            to,
            second: 0,
        });
        if !is_leaf {
            self.split(from, from + half);
            self.nodes[node].second = self.nodes.len();
            self.split(from + half, to);
        }
    }
    /// Calls something for each site whose bisector with a site may be nearer to it than a reach, in the order of
    /// distances of leaves. The call gets the difference of both, the height of the bisector along it and the other
    /// site. It returns what is left of the reach, squared; a negative one ends the search. `waiting` is memory.
    pub fn visit(
        &self,
        site: &Site,
        mut reach: f64,
        waiting: &mut Waiting,
        mut f: impl FnMut([f64; 2], f64, &Site) -> f64,
    ) {
        // The bisector of a site at a distance d with the weight w' is at (d² + w − w')/(2d), which is least where d² is
        // w − w' or the least that it can be.
        let is_beyond = |square: f64, heaviest: f64, reach: f64| {
            let lighter = site.weight - heaviest;
            let square = square.max(lighter);
            let reached = square + lighter;
            reached > 0.0 && reached * reached >= 4.0 * square * reach
        };
        waiting.clear();
        waiting.push(Reverse((0, 0)));
        while let Some(Reverse((square, at))) = waiting.pop() {
            let square = f64::from_bits(square);
            let node = &self.nodes[at];
            if is_beyond(square, node.heaviest, reach) {
                continue;
            }
            if node.second > 0 {
                for child in [at + 1, node.second] {
                    let own = &self.nodes[child];
                    let gap = |k: usize| {
                        let x = site.place[k];
                        (own.low[k] - x).max(x - own.high[k]).max(0.0)
                    };
                    let (x, y) = (gap(0), gap(1));
                    let square = x * x + y * y;
                    if !is_beyond(square, own.heaviest, reach) {
                        waiting.push(Reverse((square.to_bits(), child)));
                    }
                }
                continue;
            }
            let mut near = [(0.0, 0); FEW];
            let mut count = 0;
            for k in node.from..node.to {
                let other = &self.sites[k];
                let (x, y) = (
                    other.place[0] - site.place[0],
                    other.place[1] - site.place[1],
                );
                let square = x * x + y * y;
                let rest = square + (site.weight - other.weight);
                if rest > 0.0 && rest * rest >= 4.0 * square * reach || other.number == site.number
                {
                    continue;
                }
                let mut place = count;
                while place > 0 && square < near[place - 1].0 {
                    near[place] = near[place - 1];
                    place -= 1;
                }
                near[place] = (square, k);
                count += 1;
            }
            for &(square, k) in &near[..count] {
                let other = &self.sites[k];
                let way = [
                    other.place[0] - site.place[0],
                    other.place[1] - site.place[1],
                ];
                let rest = square + (site.weight - other.weight);
                if rest > 0.0 && rest * rest >= 4.0 * square * reach {
                    continue;
                }
                reach = f(way, rest / 2.0, other);
                if reach < 0.0 {
                    return;
                }
            }
        }
    }
}
