//! A convex polygon clipped to another one.
//!
//! The border of the result changes between both borders only where these meet. Along every edge of
//! the first polygon its line enters and leaves the second one; where, is found from signs of exact
//! predicates on given vertices: which vertex is farthest left and right of the line (two pointers
//! that move around once), and between those, by bisection, where the sign changes. The meetings are in
//! the same cyclic order on both borders, and from each one to the next the result follows the border
//! that turns farther inwards. `O(n log m)`.
use super::{ClipTrace, Corner, Side};
use crate::error::Flaw;
use crate::predicate::{Turn, left_to_right, same, turn, turn_between};
use crate::{ConvexPolygon, Scalar, Vec2};
use std::cmp::Ordering;

/// A place that both borders have.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    corner: Corner,
    /// Twice the number of a vertex, or one more on the edge that starts there.
    on_a: usize,
    on_b: usize,
}

/// Where the line of an edge of a enters or leaves b.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Contact {
    Vertex(usize),
    Edge(usize),
}

/// A convex polygon as a list of vertices, counted around and around.
#[derive(Clone, Copy)]
struct Border<'a, S>(&'a [Vec2<S>]);

impl<S: Scalar<Mask = bool>> Border<'_, S> {
    fn len(&self) -> usize {
        self.0.len()
    }
    fn at(&self, k: usize) -> Vec2<S> {
        self.0[k % self.0.len()]
    }
    fn edge(&self, k: usize) -> [Vec2<S>; 2] {
        [self.at(k), self.at(k + 1)]
    }
    fn side(&self, k: usize, point: Vec2<S>) -> Turn {
        let [start, end] = self.edge(k);
        turn(start, end, point)
    }
    fn contains(&self, point: Vec2<S>) -> bool {
        (0..self.len()).all(|k| self.side(k, point) != Turn::Right)
    }
    /// The vertex from which the way on no longer turns to `side` of a direction, but the way there did.
    fn extreme(&self, direction: [Vec2<S>; 2], side: Turn) -> usize {
        let turns = |k: usize| turn_between(direction, self.edge(k)) == side;
        let n = self.len();
        (0..n).find(|&k| turns(k + n - 1) && !turns(k)).unwrap_or(0)
    }
    /// The same for a direction that has turned on since.
    fn advance(&self, from: usize, direction: [Vec2<S>; 2], side: Turn) -> usize {
        let turns = |k: usize| turn_between(direction, self.edge(k)) == side;
        let end = from + self.len();
        let found = (from..end).find(|&k| !turns(k));
        found.unwrap_or(from) % self.len()
    }
}

/// The last number up to `len` for which a condition holds that holds for zero and, once it does not,
/// never again.
fn last_where(len: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut low, mut high) = (0, len + 1);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Where the line of edge `i` of a enters and leaves b, in this order.
struct Reach<'a, S> {
    a: Border<'a, S>,
    b: Border<'a, S>,
    i: usize,
    contacts: [Contact; 2],
}

impl<S: Scalar<Mask = bool>> Reach<'_, S> {
    /// Where on the edge a place on its line is: at the start, behind it and before the end, or not.
    fn order(&self, point: Vec2<S>) -> Option<Ordering> {
        let [start, end] = self.a.edge(self.i);
        let ahead = left_to_right(start, end);
        let from_start = left_to_right(start, point);
        if from_start == Ordering::Equal {
            Some(Ordering::Equal)
        } else if from_start == ahead && left_to_right(point, end) == ahead {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
    /// The edge of b that lies along the line, if one does.
    fn along(&self) -> Option<usize> {
        match self.contacts {
            [Contact::Vertex(enter), Contact::Vertex(leave)] if enter != leave => {
                let m = self.b.len();
                if (enter + 1) % m == leave {
                    Some(enter)
                } else if (leave + 1) % m == enter {
                    Some(leave)
                } else {
                    None
                }
            }
            _ => None,
        }
    }
    /// The meeting at the start of the edge, if that is on the border of b.
    fn at_start(&self) -> Option<Meeting> {
        let start = self.a.at(self.i);
        let met = |on_b| Meeting {
            corner: Corner::A(self.i),
            on_a: 2 * self.i,
            on_b,
        };
        for contact in self.contacts {
            match contact {
                Contact::Vertex(j) if same(self.b.at(j), start) => return Some(met(2 * j)),
                Contact::Edge(j) if self.b.side(j, start) == Turn::Straight => {
                    return Some(met(2 * j + 1));
                }
                _ => {}
            }
        }
        let j = self.along()?;
        let [p, q] = self.b.edge(j);
        let inside = left_to_right(p, start) == left_to_right(start, q);
        inside.then(|| met(2 * j + 1))
    }
    /// The meeting at one of the contacts, if that is between the ends of the edge.
    fn between(&self, which: usize) -> Option<Meeting> {
        let on_a = 2 * self.i + 1;
        match self.contacts[which] {
            Contact::Vertex(j) => {
                let twice = which == 1 && self.contacts[0] == self.contacts[1];
                let inside = self.order(self.b.at(j)) == Some(Ordering::Greater);
                (inside && !twice).then_some(Meeting {
                    corner: Corner::B(j),
                    on_a,
                    on_b: 2 * j,
                })
            }
            Contact::Edge(j) => {
                let [start, end] = self.a.edge(self.i).map(|p| self.b.side(j, p));
                let wanted = [(Turn::Right, Turn::Left), (Turn::Left, Turn::Right)][which];
                ((start, end) == wanted).then_some(Meeting {
                    corner: Corner::Cross { a: self.i, b: j },
                    on_a,
                    on_b: 2 * j + 1,
                })
            }
        }
    }
}

/// All meetings, in order; `None` when an edge separates the polygons.
struct Meetings<const K: usize> {
    list: [Meeting; K],
    count: usize,
}

fn meetings<S: Scalar<Mask = bool>, const K: usize>(
    a: Border<'_, S>,
    b: Border<'_, S>,
) -> Result<Option<Meetings<K>>, Flaw> {
    let none = Meeting {
        corner: Corner::A(0),
        on_a: 0,
        on_b: 0,
    };
    let mut all = Meetings {
        list: [none; K],
        count: 0,
    };
    let (mut high, mut low) = (0, 0);
    let m = b.len();
    for i in 0..a.len() {
        let line = a.edge(i);
        if i == 0 {
            (high, low) = (b.extreme(line, Turn::Left), b.extreme(line, Turn::Right));
        } else {
            high = b.advance(high, line, Turn::Left);
            low = b.advance(low, line, Turn::Right);
        }
        let side = |k: usize| turn(line[0], line[1], b.at(k));
        if side(high) == Turn::Right {
            return Ok(None);
        }
        if side(low) == Turn::Left {
            continue;
        }
        // From the leftmost vertex down to the rightmost one and up again, each time the last vertex
        // before the other side begins.
        let down = (high + last_where((low + m - high) % m, |t| side(high + t) != Turn::Right)) % m;
        let up = (low + last_where((high + m - low) % m, |t| side(low + t) != Turn::Left)) % m;
        let contact = |k: usize| match side(k) {
            Turn::Straight => Contact::Vertex(k),
            _ => Contact::Edge(k),
        };
        let reach = Reach {
            a,
            b,
            i,
            contacts: [contact(down), contact(up)],
        };
        for met in [reach.at_start(), reach.between(0), reach.between(1)] {
            let Some(met) = met else { continue };
            if all.count == K {
                return Err(Flaw::Vertex {
                    index: K,
                    fault: crate::VertexFault::Surplus,
                });
            }
            all.list[all.count] = met;
            all.count += 1;
        }
    }
    Ok(Some(all))
}

/// What two convex polygons share, as a record of where every vertex and every side of it is from.
/// Decided exactly, `O(n log m)`; the polygons must be valid, or the record means nothing.
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, clipping::{Corner, Side, clip_decided}};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let b = ConvexPolygon::from(Aabb2::new(1.0, 1.0, 3.0, 3.0));
/// let trace = clip_decided::<_, 4, 4, 8>(&a, &b).unwrap();
/// let cross = |a, b| Corner::Cross { a, b };
/// assert_eq!(trace.corners[..trace.count], [cross(1, 0), Corner::A(2), cross(2, 3), Corner::B(0)]);
/// assert_eq!(trace.sides[..trace.count], [Side::A(1), Side::A(2), Side::B(3), Side::B(0)]);
/// ```
///
/// # Errors
///
/// When the result has more than `K` vertices; `N + M` always suffice.
pub fn clip_decided<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ClipTrace<K>, Flaw> {
    let mut trace = ClipTrace::empty();
    let (a, b) = (Border(a.as_slice()), Border(b.as_slice()));
    let (n, m) = (a.len(), b.len());
    if n == 0 || m == 0 {
        return Ok(trace);
    }
    let Some(all) = meetings::<S, K>(a, b)? else {
        return Ok(trace);
    };
    let list = &all.list[..all.count];
    if list.is_empty() {
        if b.contains(a.at(0)) {
            (0..n).try_for_each(|k| trace.push(Corner::A(k), Side::A(k)))?;
        } else if a.contains(b.at(0)) {
            (0..m).try_for_each(|k| trace.push(Corner::B(k), Side::B(k)))?;
        }
        return Ok(trace);
    }
    for (k, from) in list.iter().enumerate() {
        let alone = list.len() == 1;
        let to = list[(k + 1) % list.len()];
        let (edge_a, edge_b) = (from.on_a / 2, from.on_b / 2);
        // Vertices strictly between the two places, on either border.
        let around = if k + 1 == list.len() { 2 * n } else { 0 };
        let chain_a = vertices_between(from.on_a, to.on_a + around);
        let way_b = (to.on_b + 2 * m - from.on_b) % (2 * m);
        let way_b = if alone { 2 * m } else { way_b };
        let chain_b = vertices_between(from.on_b, from.on_b + way_b);
        let inwards = turn_between(a.edge(edge_a), b.edge(edge_b));
        // With fewer than three meetings there may be nothing inside either border.
        let sure = list.len() > 2;
        let (follow_a, follow_b) = match inwards {
            Turn::Left => (false, sure || b_inside(a, b, chain_b)),
            Turn::Right => (sure || b_inside(b, a, chain_a), false),
            Turn::Straight => (false, false),
        };
        let side = if inwards == Turn::Left {
            Side::B(edge_b)
        } else {
            Side::A(edge_a)
        };
        trace.push(from.corner, side)?;
        if follow_a {
            for k in chain_a.0..chain_a.1 {
                trace.push(Corner::A(k % n), Side::A(k % n))?;
            }
        }
        if follow_b {
            for k in chain_b.0..chain_b.1 {
                trace.push(Corner::B(k % m), Side::B(k % m))?;
            }
        }
    }
    Ok(trace)
}

/// The numbers of the vertices strictly between two places on a border, the end excluded.
fn vertices_between(from: usize, to: usize) -> (usize, usize) {
    (from / 2 + 1, to.div_ceil(2))
}

/// Whether the first vertex of a chain of `inner` lies in `outer`.
fn b_inside<S: Scalar<Mask = bool>>(
    outer: Border<'_, S>,
    inner: Border<'_, S>,
    chain: (usize, usize),
) -> bool {
    chain.0 < chain.1 && outer.contains(inner.at(chain.0))
}

/// What two convex polygons share, from both and the record of [`clip_decided`]. Slopes of a crossing
/// are those of the two edges that cross; its own are unbounded as these become parallel, though those of
/// areas are not.
#[must_use]
pub fn clip_replay<S: Scalar, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
    trace: &ClipTrace<K>,
) -> ConvexPolygon<S, K> {
    trace.replay(
        |k| [a.vertex(k), a.vertex(k + 1)],
        |k| [b.vertex(k), b.vertex(k + 1)],
    )
}

/// What two convex polygons share: a polygon, a segment (two vertices), a point (one) or nothing (none).
///
/// ```
/// use geograd::{Aabb2, ConvexPolygon, Vec2, clipping::clip};
/// let a = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
/// let corner = ConvexPolygon::from(Aabb2::new(2.0, 2.0, 3.0, 3.0));
/// let shared: ConvexPolygon<f64, 8> = clip(&a, &corner).unwrap();
/// assert_eq!(shared.as_slice(), [Vec2::new(2.0, 2.0)]);
/// ```
///
/// # Errors
///
/// When the result has more than `K` vertices; `N + M` always suffice.
pub fn clip<S: Scalar<Mask = bool>, const N: usize, const M: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, M>,
) -> Result<ConvexPolygon<S, K>, Flaw> {
    clip_decided(a, b).map(|trace| clip_replay(a, b, &trace))
}
