//! Edges in general position: each pair keeps apart or crosses, by margins far above roundings.
use crate::polygon::Rings;
use crate::predicate::wide;
use crate::{Scalar, Vec2};

/// The distance that edges keep, as a share of the extent of all rings.
const MARGIN: f64 = 1.0 / (1_u64 << 40) as f64;

/// The error of a crossing's share of an edge, in units of the extent over the edge's height above the other one.
const ROUNDING: f64 = 1.0 / (1_u64 << 46) as f64;

/// The least sine of an angle at which edges cross.
const SLIGHT: f64 = 1.0 / (1 << 12) as f64;

/// The most pairs of edges that are compared and the most crossings, per edge.
const MOST: [usize; 2] = [40, 4];

/// The extents within which products neither over- nor underflow.
const EXTENTS: std::ops::Range<f64> = 1e-120..1e150;

/// A crossing on one of its two edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// The edge, and where on it: 0 at its start, 1 at its end.
    pub edge: u32,
    pub share: f64,
    error: f64,
    /// The number of the crossing.
    pub crossing: u32,
    /// The change of the winding number on either side from before to after.
    pub change: i32,
}

/// Rings whose edges keep apart or cross.
pub(super) struct GeneralRings {
    pub points: Vec<Vec2<f64>>,
    /// The number of vertices up to the end of each ring. An edge has the number of the vertex that it leaves.
    pub ends: Vec<usize>,
    /// Two of each crossing, in the order of edges and on each edge.
    pub meetings: Vec<Meeting>,
    /// Twice the area that counts as none.
    pub no_area: f64,
}

/// An edge with the range of each coordinate.
struct RangedEdge {
    x: [f64; 2],
    y: [f64; 2],
    start: Vec2<f64>,
    way: Vec2<f64>,
    number: u32,
    next: u32,
}

/// The relation of two edges.
enum Relation {
    Apart,
    /// They cross, at a share of each; the cross product of their directions.
    Crossing([f64; 2], f64),
    Unclear,
}

impl GeneralRings {
    /// Returns rings in general position; `None` for others. Edges keep apart by `steps`, too, where that is more.
    pub fn new<S: Scalar<Mask = bool>>(rings: Rings<'_, S>, steps: f64) -> Option<Self> {
        let mut made = GeneralRings {
            points: Vec::with_capacity(rings.vertex_count()),
            ends: Vec::with_capacity(rings.count()),
            meetings: Vec::new(),
            no_area: 0.0,
        };
        for ring in rings.iter() {
            for &vertex in ring {
                let [x, y] = wide(vertex)?;
                made.points.push(Vec2::new(x, y));
            }
            made.ends.push(made.points.len());
        }
        let first = *made.points.first()?;
        let (mut low, mut high) = (first, first);
        for at in &made.points {
            low = Vec2::new(low.x.min(at.x), low.y.min(at.y));
            high = Vec2::new(high.x.max(at.x), high.y.max(at.y));
        }
        let extent = (high.x - low.x).max(high.y - low.y);
        if !EXTENTS.contains(&extent) {
            return None;
        }
        let margin = (extent * MARGIN).max(steps);
        made.no_area = margin * extent;
        let edges = made.sorted(margin)?;
        made.find(&edges, extent, margin)?;
        // Another edge within the margin of a crossing meets one of both edges within this.
        let apart = if steps > 0.0 { margin / SLIGHT } else { 0.0 };
        made.are_clear(apart).then_some(made)
    }
    /// Returns the edge after one.
    pub fn next(&self, ring: usize, edge: usize) -> usize {
        if edge + 1 < self.ends[ring] {
            edge + 1
        } else {
            self.start(ring)
        }
    }
    /// Returns the edge before one.
    pub fn previous(&self, ring: usize, edge: usize) -> usize {
        if edge > self.start(ring) {
            edge - 1
        } else {
            self.ends[ring] - 1
        }
    }
    /// Returns the number of the first vertex of a ring.
    pub fn start(&self, ring: usize) -> usize {
        if ring == 0 { 0 } else { self.ends[ring - 1] }
    }
    /// Returns the ring that an edge is of.
    pub fn ring_of(&self, edge: usize) -> usize {
        self.ends.partition_point(|&end| end <= edge)
    }
    /// Returns the edges by where they begin in x; `None` for one about as short as the margin.
    fn sorted(&self, margin: f64) -> Option<Vec<RangedEdge>> {
        let mut order = Vec::with_capacity(self.points.len());
        for ring in 0..self.ends.len() {
            let from = self.start(ring);
            for number in from..self.ends[ring] {
                let next = self.next(ring, number);
                let (start, end) = (self.points[number], self.points[next]);
                let way = end - start;
                if self.ends[ring] - from < 3 || way.x.abs().max(way.y.abs()) <= 4.0 * margin {
                    return None;
                }
                order.push((start.x.min(end.x), number as u32, next as u32));
            }
        }
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let edge = |(left, number, next): (f64, u32, u32)| {
            let (start, end) = (self.points[number as usize], self.points[next as usize]);
            RangedEdge {
                x: [left, start.x.max(end.x)],
                y: [start.y.min(end.y), start.y.max(end.y)],
                start,
                way: end - start,
                number,
                next,
            }
        };
        Some(order.into_iter().map(edge).collect())
    }
    /// Finds all crossings; `None` where a relation is unclear, or where there are too many.
    fn find(&mut self, edges: &[RangedEdge], extent: f64, margin: f64) -> Option<()> {
        let [mut pairs, mut crossings] = MOST.map(|most| most * edges.len());
        for (i, edge) in edges.iter().enumerate() {
            let right = edge.x[1] + margin;
            for other in edges[i + 1..]
                .iter()
                .take_while(|other| other.x[0] <= right)
            {
                pairs = pairs.checked_sub(1)?;
                if edge.y[0] > other.y[1] + margin || other.y[0] > edge.y[1] + margin {
                    continue;
                }
                match edge.relation(other, margin) {
                    Relation::Apart => {}
                    Relation::Unclear => return None,
                    Relation::Crossing(shares, cross) => {
                        crossings = crossings.checked_sub(1)?;
                        self.add([edge, other], shares, cross, extent);
                    }
                }
            }
        }
        let key = |own: &Meeting| (own.edge, own.share);
        self.meetings.sort_unstable_by(|a, b| {
            let ((i, s), (j, t)) = (key(a), key(b));
            i.cmp(&j).then(s.total_cmp(&t))
        });
        Some(())
    }
    /// Returns `true` if crossings of one edge are apart by more than their errors and a distance.
    fn are_clear(&self, apart: f64) -> bool {
        self.meetings.windows(2).all(|two| {
            let [p, q] = [two[0], two[1]];
            if p.edge != q.edge {
                return true;
            }
            let edge = p.edge as usize;
            let way = self.points[self.next(self.ring_of(edge), edge)] - self.points[edge];
            let length = way.x.abs().max(way.y.abs());
            (q.share - p.share - p.error - q.error) * length > apart
        })
    }
    fn add(&mut self, edges: [&RangedEdge; 2], shares: [f64; 2], cross: f64, extent: f64) {
        let crossing = self.meetings.len() as u32 / 2;
        for k in 0..2 {
            let other = edges[1 - k].way;
            let height = cross.abs() / (other.x.abs() + other.y.abs());
            // A way from the left of the other edge to its right loses one turn.
            let is_left = (cross > 0.0) == (k == 0);
            self.meetings.push(Meeting {
                edge: edges[k].number,
                share: shares[k],
                error: ROUNDING * extent / height,
                crossing,
                change: if is_left { -1 } else { 1 },
            });
        }
    }
}

impl RangedEdge {
    fn relation(&self, other: &Self, margin: f64) -> Relation {
        // Bounds of the lengths, and of these times the margin.
        let sizes = [self, other].map(|edge| edge.way.x.abs() + edge.way.y.abs());
        let [own, its] = sizes.map(|size| margin * size);
        let cross = self.way.perp_dot(other.way);
        if self.next == other.number || other.next == self.number {
            let parts = cross.abs() > own && cross.abs() > its || self.way.dot(other.way) > 0.0;
            return if parts {
                Relation::Apart
            } else {
                Relation::Unclear
            };
        }
        let seen = other.start - self.start;
        // The ends of each from the line of the other one: two on one side keep both apart.
        let (a, b) = (self.way.perp_dot(seen), other.way.perp_dot(seen));
        let (c, d) = (a + cross, b + cross);
        let beyond = |p: f64, q: f64, by: f64| p.min(q) > by || p.max(q) < -by;
        if beyond(a, c, own) || beyond(b, d, its) {
            return Relation::Apart;
        }
        let across = |p: f64, q: f64, by: f64| p.min(q) < -by && p.max(q) > by;
        let is_steep = cross.abs() > SLIGHT * sizes[0] * sizes[1];
        if is_steep && across(a, c, own) && across(b, d, its) {
            return Relation::Crossing([-b / cross, -a / cross], cross);
        }
        Relation::Unclear
    }
}
