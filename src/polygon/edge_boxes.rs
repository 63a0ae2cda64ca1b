//! The edges of two polygons that are nearest to each other, by boxes around stretches of edges.
use super::Rings;
use super::box_ends::{Ends, NOWHERE, join, squared_gap};
use super::box_tree::{BoxTree, FEW, Node};
use super::nearest_few::{Approach, Candidates, beyond, may_cross};
use crate::arrays::sort_few;
use crate::distance::{distance as between, segments::distance_apart};
use crate::shape::edges;
use crate::{Scalar, Segment2, Vec2};

/// The most edges of a list that are all looked at: longer ones are faster by boxes.
const MOST: usize = 128;
/// A bound of the rounding errors of the distance of two edges, in units of ε times the largest difference of two of
/// their coordinates: eight products and quotients of a few roundings each.
const SLACK: f64 = 64.0;

/// Edges with boxes around stretches of them, for distances from other edges. Neighbours in the list should be near each
/// other, as the edges of a ring are.
///
/// ```
/// use geograd::polygon::EdgeBoxes;
/// use geograd::{Aabb2, Rings};
/// let (a, b) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(6.0, 1.0, 7.0, 2.0).corners());
/// let [a, b] = [&a, &b].map(|corners| EdgeBoxes::of(Rings::from(corners)));
/// let nearest = a.nearest(&b).expect("both have edges");
/// // The corner at (6, 1) belongs to two edges; the first counts.
/// assert_eq!((nearest.distance, nearest.edges), (2.0, [1, 0]));
/// ```
#[derive(Clone, Debug, Default)]
pub struct EdgeBoxes<S> {
    edges: Vec<[Vec2<S>; 2]>,
    tree: BoxTree,
}

/// Two edges that are nearest to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestEdges<S> {
    /// Their distance, 0 where they meet.
    pub distance: S,
    /// Their places in both lists. Of a polygon they are the numbers of the edges' first vertices.
    pub edges: [usize; 2],
}

impl<S> EdgeBoxes<S> {
    /// Creates boxes of no edges.
    pub(super) const fn none() -> Self {
        EdgeBoxes {
            edges: Vec::new(),
            tree: BoxTree::NONE,
        }
    }
}

impl<S: Scalar<Mask = bool>> EdgeBoxes<S> {
    /// Creates the boxes of a polygon's edges, in time in proportion to their number.
    #[must_use]
    pub fn of(rings: Rings<'_, S>) -> Self {
        Self::of_edges(rings.iter().flat_map(edges))
    }
    /// Creates the boxes of edges from any one point to another.
    pub fn of_edges(edges: impl IntoIterator<Item = [Vec2<S>; 2]>) -> Self {
        let mut made = EdgeBoxes::none();
        made.replace(edges);
        made
    }
    /// Takes other edges, and keeps the memory.
    pub fn replace(&mut self, edges: impl IntoIterator<Item = [Vec2<S>; 2]>) {
        self.edges.clear();
        self.edges.extend(edges);
        self.build();
    }
    /// Takes the edges of a polygon, without boxes.
    #[inline(always)]
    pub(super) fn take(&mut self, rings: Rings<'_, S>) {
        self.edges.clear();
        for ring in rings.iter() {
            if let (Some(&first), Some(&last)) = (ring.first(), ring.last()) {
                let pairs = ring.windows(2).map(|pair| [pair[0], pair[1]]);
                self.edges.extend(pairs);
                self.edges.push([last, first]);
            }
        }
    }
    /// Makes the boxes of all edges.
    pub(super) fn build(&mut self) {
        self.tree.replace(self.edges.chunks(FEW).map(around));
    }
    /// Returns the two edges that are nearest to each other; `None` where there are none. Coordinates are finite. Of edges
    /// that are apart and equally near the first of this list count, and beside it the first of the other.
    #[must_use]
    pub fn nearest(&self, other: &Self) -> Option<NearestEdges<S>> {
        let (whole, others) = (self.tree.whole()?, other.tree.whole()?);
        let wholes = [whole, others];
        let mut search = Search::new([self, other], wholes);
        if !search.all_few(wholes, MOST) {
            search.by_boxes();
        }
        search.best
    }
    /// Returns `true` where the boxes around both have a point in common. One polygon contains a part of another only then.
    #[must_use]
    pub fn is_near(&self, other: &Self) -> bool {
        let both = self.tree.whole().zip(other.tree.whole());
        both.is_some_and(|(a, b)| squared_gap(a, b) <= 0.0)
    }
    /// Returns the distance of a point from the nearest edge, and the first such edge; `None` where an edge is at most
    /// `floor` away, or there are none. Edge `start` is looked at first; `left` is room for the search.
    pub(crate) fn nearest_to(
        &self,
        point: Vec2<S>,
        start: usize,
        floor: S,
        left: &mut Vec<(f64, Node)>,
    ) -> Option<(S, usize)> {
        let (whole, place) = (self.tree.whole()?, around(&[[point; 2]]));
        let slack = SLACK * S::format().epsilon() * spread(whole, place);
        let of = |edge: usize| {
            let [from, to] = self.edges[edge];
            between(point, Segment2::new(from, to))
        };
        let bound = |found: S| {
            let wide = found.widened().unwrap_or(f64::INFINITY);
            beyond(wide * wide, slack)
        };
        let mut best = (of(start), start);
        if best.0.at_most(floor) {
            return None;
        }
        let mut limit = bound(best.0);
        left.clear();
        left.push((0.0, self.tree.top()));
        while let Some((gap, node)) = left.pop() {
            if gap > limit {
                continue;
            }
            if node.level > 0 {
                self.tree.push_near(node, place, limit, left);
                continue;
            }
            for edge in node.items(self.edges.len()) {
                if squared_gap(around(&self.edges[edge..=edge]), place) > limit {
                    continue;
                }
                let found = of(edge);
                if found.at_most(floor) {
                    return None;
                }
                if found.below(best.0) || found.equals(best.0) && edge < best.1 {
                    best = (found, edge);
                    limit = bound(found);
                }
            }
        }
        Some(best)
    }
    /// Returns `true` if the box around an edge meets another box, borders included.
    pub(crate) fn may_touch(&self, other: [[f64; 2]; 2]) -> bool {
        let meets =
            |own: Ends| (0..2).all(|k| own[k][0] <= other[k][1] && other[k][0] <= own[k][1]);
        if self.edges.is_empty() {
            return false;
        }
        let mut left = vec![self.tree.top()];
        while let Some(node) = left.pop() {
            if !meets(self.tree.at(node)) {
                continue;
            }
            if node.level > 0 {
                left.extend(self.tree.children(node));
                continue;
            }
            if self.edges[node.items(self.edges.len())]
                .iter()
                .any(|edge| meets(around(std::slice::from_ref(edge))))
            {
                return true;
            }
        }
        false
    }
}

/// What is known of the nearest edges.
pub(super) struct Search<'a, S> {
    both: [&'a EdgeBoxes<S>; 2],
    pub best: Option<NearestEdges<S>>,
    /// The least known square of a distance.
    square: f64,
    /// The squared gap beyond which no edge can be nearest.
    limit: f64,
    /// The largest difference of two coordinates.
    spread: f64,
    slack: f64,
}

impl<'a, S: Scalar<Mask = bool>> Search<'a, S> {
    #[inline(always)]
    pub fn new(both: [&'a EdgeBoxes<S>; 2], wholes: [Ends; 2]) -> Self {
        let spread = spread(wholes[0], wholes[1]);
        Search {
            both,
            best: None,
            square: f64::INFINITY,
            limit: f64::INFINITY,
            spread,
            slack: SLACK * S::format().epsilon() * spread,
        }
    }
    /// Compares the edges that approximate distances leave, given the boxes around both lists. Returns `false` of lists that
    /// have more of them than there is room, or more than so many edges.
    #[inline(always)]
    pub fn all_few(&mut self, wholes: [Ends; 2], most: usize) -> bool {
        let [a, b] = self.both;
        let count = a.edges.len().max(b.edges.len());
        // Approximate distances have roundings of their own.
        let slack = 2.0 * self.slack;
        let approach = match count <= most {
            true => Approach::of(&a.edges, &b.edges, self.spread, slack),
            false => None,
        };
        let Some(approach) = approach else {
            return false;
        };
        if approach.is_parted() && self.few::<4>(wholes, &approach) {
            return true;
        }
        match count {
            ..=4 => self.few::<4>(wholes, &approach),
            5..=8 => self.few::<8>(wholes, &approach),
            _ => self.few::<16>(wholes, &approach),
        }
    }
    /// Compares such edges where there are not more of either list than there is room.
    fn few<const ROOM: usize>(&mut self, wholes: [Ends; 2], approach: &Approach) -> bool {
        let mut few = Candidates::<ROOM>::new();
        let [a, b] = self.both;
        let Some(least) = few.find(&a.edges, &b.edges, wholes, approach, self.spread) else {
            return false;
        };
        for ([i, j], is_apart) in few.within(beyond(least, 2.0 * self.slack)) {
            self.compare(i, j, is_apart);
            if self.has_met() {
                break;
            }
        }
        true
    }
    /// Compares all edges whose boxes are near, of two lists that have boxes.
    pub fn by_boxes(&mut self) {
        let [own, other] = self.both;
        let tops = [own.tree.top(), other.tree.top()];
        let mut left = vec![(0.0, tops)];
        while let Some((gap, nodes)) = left.pop() {
            if gap > self.limit {
                continue;
            }
            let [a, b] = nodes;
            if a.level == 0 && b.level == 0 {
                if self.leaves(nodes) {
                    break;
                }
                continue;
            }
            let side = usize::from(b.level > a.level);
            let first = left.len();
            for child in self.both[side].tree.children(nodes[side]) {
                let mut pair = nodes;
                pair[side] = child;
                let gap = squared_gap(own.tree.at(pair[0]), other.tree.at(pair[1]));
                if gap <= self.limit {
                    left.push((gap, pair));
                }
            }
            // The nearest pair comes first.
            sort_few(&mut left[first..], |(one, _), (another, _)| {
                another.total_cmp(one).is_lt()
            });
        }
    }
    /// Compares the edges of two leaves. Returns `true` once two edges meet.
    fn leaves(&mut self, [a, b]: [Node; 2]) -> bool {
        let (own, others) = (
            a.items(self.both[0].edges.len()),
            b.items(self.both[1].edges.len()),
        );
        let mut ends = [NOWHERE; FEW];
        for (ends, edge) in ends.iter_mut().zip(&self.both[1].edges[others.clone()]) {
            *ends = around(std::slice::from_ref(edge));
        }
        let whole = self.both[1].tree.at(b);
        for i in own {
            let edge = self.both[0].edges[i];
            let seen = around(&[edge]);
            if squared_gap(seen, whole) > self.limit {
                continue;
            }
            // Distances of vertices bound that of edges, and take less time.
            for other in &self.both[1].edges[others.clone()] {
                self.bound(squared_distance(edge[0], other[0]));
            }
            for (j, ends) in others.clone().zip(ends) {
                let gap = squared_gap(seen, ends);
                if gap <= self.limit {
                    let other = self.both[1].edges[j];
                    self.compare(i, j, gap > 0.0 || !may_cross(edge, other, self.spread));
                }
            }
        }
        self.has_met()
    }
    /// Returns `true` once two edges meet.
    fn has_met(&self) -> bool {
        self.best
            .is_some_and(|best| best.distance.at_most(S::zero()))
    }
    /// Compares two edges with the nearest ones. Edges that are apart take half the time.
    fn compare(&mut self, i: usize, j: usize, is_apart: bool) {
        let [a, b] = [self.both[0].edges[i], self.both[1].edges[j]]
            .map(|[from, to]| Segment2::new(from, to));
        let apart = is_apart.then(|| distance_apart(a, b)).flatten();
        let found = NearestEdges {
            distance: apart.unwrap_or_else(|| between(a, b)),
            edges: [i, j],
        };
        let is_nearer = self.best.is_none_or(|best| {
            let is_first = found.edges < best.edges;
            found.distance.below(best.distance) || found.distance.equals(best.distance) && is_first
        });
        if is_nearer {
            self.best = Some(found);
            if let Some(distance) = found.distance.widened() {
                self.bound(distance * distance);
            }
        }
    }
    /// Takes note of a square of a distance.
    fn bound(&mut self, square: f64) {
        if square < self.square {
            self.square = square;
            self.limit = beyond(square, self.slack);
        }
    }
}

/// Returns a coordinate as an interval; everything in a format that has no exact value as `f64`.
#[inline(always)]
pub(super) fn seen<S: Scalar>(x: S) -> [f64; 2] {
    x.widened()
        .map_or([f64::NEG_INFINITY, f64::INFINITY], |x| [x, x])
}

/// Returns the box around edges.
#[inline(always)]
pub(super) fn around<S: Scalar>(edges: &[[Vec2<S>; 2]]) -> Ends {
    let ends = edges.iter().flatten();
    ends.fold(NOWHERE, |[x, y], end| {
        [join(x, seen(end.x)), join(y, seen(end.y))]
    })
}

/// Returns the largest difference of two coordinates of the points of two boxes.
fn spread(a: Ends, b: Ends) -> f64 {
    let of = |k: usize| a[k][1].max(b[k][1]) - a[k][0].min(b[k][0]);
    of(0).max(of(1))
}

#[inline(always)]
fn squared_distance<S: Scalar>(a: Vec2<S>, b: Vec2<S>) -> f64 {
    let wide = |x: S| x.widened().unwrap_or(f64::INFINITY);
    let (x, y) = (wide(a.x) - wide(b.x), wide(a.y) - wide(b.y));
    x * x + y * y
}
