//! Results of rings in general position, without an overlay.
//!
//! A walk along each ring knows the winding numbers on both sides of it: from all rings around its first vertex, and by one
//! more or less after each crossing. A piece between two crossings bounds the result if both sides differ in being inside.
//! Pieces that meet in a crossing continue each other. The overlay has to find out what is near what, exactly and for all
//! input; most small polygons, and the raw rings of most offsets, need less.
use super::meetings::GeneralRings;
use super::{EdgeId, Origin, OverlayTrace, Owner, VertexId};
use crate::polygon::Rings;
use crate::predicate::{Turn, turn};
use crate::{Scalar, Vec2};

/// The most rings: each is compared with every other one.
const RINGS: usize = 48;

/// A vertex of the result: one of the input by its number, or the crossing of two edges.
#[derive(Clone, Copy, Debug)]
pub(super) enum WalkedVertex {
    Own(usize),
    Cross(usize, usize),
}

/// The parts of a result: for each the ring around it, then its holes.
pub(super) type WalkedParts = Vec<Vec<Vec<WalkedVertex>>>;

/// How the result runs along a piece of a ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Run {
    Not,
    Forward,
    Backward,
}

/// A ring of the result with its coordinates.
struct Found {
    vertices: Vec<WalkedVertex>,
    places: Vec<Vec2<f64>>,
    /// Twice its area.
    area: f64,
}

struct Walks<'a> {
    all: &'a GeneralRings,
    /// How the result runs before and after each meeting.
    runs: Vec<[Run; 2]>,
    /// The other meeting of the same crossing.
    twins: Vec<usize>,
    /// The first meeting of each ring, and the number of all.
    firsts: Vec<usize>,
    found: Vec<Found>,
}

/// Returns the parts of the result; `None` where input is not in general position. Edges keep apart by `steps`. `base` is the
/// winding number around all rings; `is_inside` tells which are inside.
pub(super) fn walked_parts<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    steps: f64,
    base: i32,
    is_inside: impl Fn(i32) -> bool,
) -> Option<WalkedParts> {
    if rings.count() == 0 || rings.count() > RINGS {
        return None;
    }
    let all = GeneralRings::new(rings, steps)?;
    let count = all.meetings.len();
    let mut walks = Walks {
        all: &all,
        runs: vec![[Run::Not; 2]; count],
        twins: vec![0; count],
        firsts: Vec::with_capacity(all.ends.len() + 1),
        found: Vec::new(),
    };
    let mut seen = vec![usize::MAX; count / 2];
    for (k, meeting) in all.meetings.iter().enumerate() {
        let other = &mut seen[meeting.crossing as usize];
        if *other == usize::MAX {
            *other = k;
        } else {
            (walks.twins[k], walks.twins[*other]) = (*other, k);
        }
    }
    for ring in 0..all.ends.len() {
        let start = all.start(ring) as u32;
        let first = all.meetings.partition_point(|own| own.edge < start);
        walks.firsts.push(first);
    }
    walks.firsts.push(count);
    let run = |right: i32| match (is_inside(right + 1), is_inside(right)) {
        (true, false) => Run::Forward,
        (false, true) => Run::Backward,
        _ => Run::Not,
    };
    for ring in 0..all.ends.len() {
        walks.walk(ring, base, &run)?;
    }
    walks.trace()?;
    parts(walks.found)
}

impl Walks<'_> {
    /// Finds how the result runs along a ring, by the winding number to its right.
    fn walk(&mut self, ring: usize, base: i32, run: &impl Fn(i32) -> Run) -> Option<()> {
        let all = self.all;
        let (start, end) = (all.start(ring), all.ends[ring]);
        let points = &all.points[start..end];
        let n = points.len();
        let (first, is_left) = leftmost(points);
        let others = (0..all.ends.len()).filter(|&other| other != ring);
        let around = others.map(|other| {
            let points = &all.points[all.start(other)..all.ends[other]];
            winding(points, all.points[start + first])
        });
        let outside = base + around.sum::<i32>();
        // Outside is to the right of the edge that leaves the leftmost vertex if the ring turns left there.
        let begin = if is_left { outside } else { outside - 1 };
        let (low, high) = (self.firsts[ring], self.firsts[ring + 1]);
        if low == high {
            let order = |k: usize| WalkedVertex::Own(start + k);
            match run(begin) {
                Run::Not => {}
                Run::Forward => self.keep((0..n).map(order).collect())?,
                Run::Backward => self.keep((0..n).rev().map(order).collect())?,
            }
            return Some(());
        }
        let from = low
            + all.meetings[low..high].partition_point(|own| (own.edge as usize) < start + first);
        let mut right = begin;
        for k in (from..high).chain(low..from) {
            let before = run(right);
            right += all.meetings[k].change;
            self.runs[k] = [before, run(right)];
        }
        (right == begin).then_some(())
    }
    /// Follows the pieces of the result.
    fn trace(&mut self) -> Option<()> {
        let count = self.runs.len();
        // Pieces that leave a crossing: after a meeting forward, before it backward.
        let mut is_left = vec![[false; 2]; count];
        for first in 0..count {
            for side in 0..2 {
                if !self.leaves(first, side) || is_left[first][side] {
                    continue;
                }
                let mut vertices = Vec::new();
                let (mut k, mut way) = (first, side);
                loop {
                    if std::mem::replace(&mut is_left[k][way], true) {
                        return None;
                    }
                    let end = self.follow(k, way == 1, &mut vertices);
                    let (next, next_way) = self.after(end, way)?;
                    if (next, next_way) != (end, way) {
                        let [a, b] = [end, next].map(|k| self.all.meetings[k].edge as usize);
                        vertices.push(WalkedVertex::Cross(a.min(b), a.max(b)));
                    }
                    (k, way) = (next, next_way);
                    if (k, way) == (first, side) {
                        break;
                    }
                }
                self.keep(vertices)?;
            }
        }
        Some(())
    }
    fn leaves(&self, k: usize, side: usize) -> bool {
        self.runs[k][side] == [Run::Backward, Run::Forward][side]
    }
    /// Adds the vertices from a meeting to the next one along its ring, which it returns.
    fn follow(&self, k: usize, ahead: bool, vertices: &mut Vec<WalkedVertex>) -> usize {
        let all = self.all;
        let edge = all.meetings[k].edge as usize;
        let ring = all.ring_of(edge);
        let (low, high) = (self.firsts[ring], self.firsts[ring + 1]);
        let (end, is_wrapped) = match ahead {
            true if k + 1 < high => (k + 1, false),
            true => (low, true),
            false if k > low => (k - 1, false),
            false => (high - 1, true),
        };
        let last = all.meetings[end].edge as usize;
        let mut at = edge;
        if is_wrapped || last != edge {
            loop {
                if ahead {
                    at = all.next(ring, at);
                    vertices.push(WalkedVertex::Own(at));
                } else {
                    vertices.push(WalkedVertex::Own(at));
                    at = all.previous(ring, at);
                }
                if at == last {
                    break;
                }
            }
        }
        end
    }
    /// Returns the piece that leaves a crossing; `None` unless there is one, and one that enters it.
    fn after(&self, end: usize, way: usize) -> Option<(usize, usize)> {
        let pieces = [end, self.twins[end]].map(|k| [(k, 0), (k, 1)]);
        let mut leaving = pieces
            .iter()
            .flatten()
            .filter(|(k, side)| self.leaves(*k, *side));
        let next = *leaving.next()?;
        // Pieces that enter run the other way.
        let enters = |(k, side): &&(usize, usize)| {
            self.runs[*k][*side] == [Run::Forward, Run::Backward][*side]
        };
        let entering = pieces.iter().flatten().filter(enters).count();
        let is_own = enters(&&(end, 1 - way));
        (leaving.next().is_none() && entering == 1 && is_own).then_some(next)
    }
    /// Adds a ring of the result; `None` if it is about as thin as the margin.
    fn keep(&mut self, vertices: Vec<WalkedVertex>) -> Option<()> {
        let points = &self.all.points;
        let place = |vertex: &WalkedVertex| match *vertex {
            WalkedVertex::Own(k) => points[k],
            WalkedVertex::Cross(a, b) => {
                let end = |k: usize| points[self.all.next(self.all.ring_of(k), k)];
                let (u, w) = (end(a) - points[a], end(b) - points[b]);
                let seen = points[b] - points[a];
                points[a] + u * (seen.perp_dot(w) / u.perp_dot(w))
            }
        };
        let places: Vec<_> = vertices.iter().map(place).collect();
        let area = twice_area(&places);
        self.found.push(Found {
            vertices,
            places,
            area,
        });
        (area.abs() > self.all.no_area).then_some(())
    }
}

/// Returns each ring that runs counter-clockwise with the holes in it.
fn parts(found: Vec<Found>) -> Option<WalkedParts> {
    let (outer, holes): (Vec<_>, Vec<_>) = found.into_iter().partition(|own| own.area > 0.0);
    let mut owners = Vec::with_capacity(holes.len());
    for hole in &holes {
        let around = (0..outer.len())
            .filter(|&k| outer.len() == 1 || winding(&outer[k].places, hole.places[0]) != 0);
        owners.push(around.min_by(|&a, &b| outer[a].area.total_cmp(&outer[b].area))?);
    }
    let mut made: WalkedParts = outer.into_iter().map(|own| vec![own.vertices]).collect();
    for (hole, owner) in holes.into_iter().zip(owners) {
        made[owner].push(hole.vertices);
    }
    Some(made)
}

/// Returns the record of a result of rings in general position. The rings are those of an input from a number on.
pub(super) fn walked_trace<S: Scalar<Mask = bool>>(
    rings: Rings<'_, S>,
    names: (Owner, usize),
    base: i32,
    is_inside: impl Fn(i32) -> bool,
) -> Option<OverlayTrace> {
    let parts = walked_parts(rings, 0.0, base, is_inside)?;
    let count = parts.iter().flatten().map(Vec::len).sum();
    let mut trace = OverlayTrace {
        origins: Vec::with_capacity(count),
        vertices: Vec::with_capacity(count),
        ..OverlayTrace::default()
    };
    let names = Names::new(rings, names);
    for part in parts {
        for ring in part {
            for vertex in ring {
                trace.origins.push(names.origin(vertex));
                trace.vertices.push(trace.origins.len());
            }
            trace.rings.push(trace.vertices.len());
        }
        trace.parts.push(trace.rings.len());
    }
    Some(trace)
}

/// The rings of an input, from a number on, by the numbers of all their vertices.
pub(super) struct Names {
    owner: Owner,
    first: usize,
    ends: Vec<usize>,
}

impl Names {
    pub fn new<S: Copy>(rings: Rings<'_, S>, (owner, first): (Owner, usize)) -> Self {
        let mut end = 0;
        let ends = rings.iter().map(|ring| {
            end += ring.len();
            end
        });
        Names {
            owner,
            first,
            ends: ends.collect(),
        }
    }
    /// Returns the ring of a vertex among those of the input, and its number there.
    fn place(&self, number: usize) -> (usize, usize) {
        let ring = self.ends.partition_point(|&end| end <= number);
        let start = if ring == 0 { 0 } else { self.ends[ring - 1] };
        (self.first + ring, number - start)
    }
    /// Returns the number of the vertex after one of its ring.
    pub fn next(&self, number: usize) -> usize {
        let ring = self.ends.partition_point(|&end| end <= number);
        match number + 1 < self.ends[ring] {
            true => number + 1,
            false if ring == 0 => 0,
            false => self.ends[ring - 1],
        }
    }
    pub fn vertex(&self, number: usize) -> VertexId {
        let (ring, vertex) = self.place(number);
        VertexId {
            owner: self.owner,
            ring,
            vertex,
        }
    }
    fn edge(&self, number: usize) -> EdgeId {
        let (ring, edge) = self.place(number);
        EdgeId {
            owner: self.owner,
            ring,
            edge,
        }
    }
    pub fn origin(&self, vertex: WalkedVertex) -> Origin {
        match vertex {
            WalkedVertex::Own(k) => Origin::Vertex(self.vertex(k)),
            WalkedVertex::Cross(a, b) => Origin::Cross(self.edge(a), self.edge(b)),
        }
    }
}

fn twice_area(ring: &[Vec2<f64>]) -> f64 {
    let Some((&first, rest)) = ring.split_first() else {
        return 0.0;
    };
    let pairs = rest.windows(2);
    pairs
        .map(|two| (two[0] - first).perp_dot(two[1] - first))
        .sum()
}

/// Returns the number of the lowest leftmost vertex, and `true` if the ring turns left there.
fn leftmost(ring: &[Vec2<f64>]) -> (usize, bool) {
    let n = ring.len();
    let before = |a: &usize, b: &usize| {
        let (p, q) = (ring[*a], ring[*b]);
        p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y))
    };
    let k = (0..n).min_by(before).unwrap_or(0);
    let turned = turn(ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
    (k, turned == Turn::Left)
}

/// Returns the winding number of a ring around a point that keeps apart from it.
fn winding(ring: &[Vec2<f64>], at: Vec2<f64>) -> i32 {
    let mut sum = 0;
    let mut from = ring[ring.len() - 1];
    for &to in ring {
        let is_up = to.y > at.y;
        if (from.y > at.y) != is_up {
            let side = (to - from).perp_dot(at - from);
            // Edges that cross the ray to the right.
            if is_up && side > 0.0 {
                sum += 1;
            } else if !is_up && side < 0.0 {
                sum -= 1;
            }
        }
        from = to;
    }
    sum
}
