//! Points in which the borders of two convex polygons meet, in order, decided exactly.
use super::Corner;
use crate::error::{Flaw, VertexFault};
use crate::predicate::{Turn, left_to_right, same, turn, turn_between};
use crate::{Scalar, Vec2};
use std::cmp::Ordering;

/// A point of both borders.
#[derive(Clone, Copy, Debug)]
pub(super) struct BorderPoint {
    pub corner: Corner,
    /// Twice the number of a vertex, or one more on the edge that starts there.
    pub on_a: usize,
    pub on_b: usize,
}

/// The vertex or edge of b at which the line of an edge of a enters or leaves b.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LineContact {
    Vertex(usize),
    Edge(usize),
}

/// A convex polygon as a list of vertices, with indices modulo its length.
#[derive(Clone, Copy)]
pub(super) struct ConvexRing<'a, S>(pub &'a [Vec2<S>]);

impl<S: Scalar<Mask = bool>> ConvexRing<'_, S> {
    pub fn len(&self) -> usize {
        self.0.len()
    }
    pub fn at(&self, k: usize) -> Vec2<S> {
        self.0[k % self.0.len()]
    }
    pub fn edge(&self, k: usize) -> [Vec2<S>; 2] {
        [self.at(k), self.at(k + 1)]
    }
    fn side(&self, k: usize, point: Vec2<S>) -> Turn {
        let [start, end] = self.edge(k);
        turn(start, end, point)
    }
    pub fn contains(&self, point: Vec2<S>) -> bool {
        (0..self.len()).all(|k| self.side(k, point) != Turn::Right)
    }
    /// Returns the tangent vertex: the end of the last edge that turns to `side` of a direction.
    fn extreme(&self, direction: [Vec2<S>; 2], side: Turn) -> usize {
        let turns = |k: usize| turn_between(direction, self.edge(k)) == side;
        let n = self.len();
        (0..n).find(|&k| turns(k + n - 1) && !turns(k)).unwrap_or(0)
    }
    /// Returns the tangent vertex of a direction that has turned further, searching from vertex `from` on.
    fn advance(&self, from: usize, direction: [Vec2<S>; 2], side: Turn) -> usize {
        let turns = |k: usize| turn_between(direction, self.edge(k)) == side;
        let end = from + self.len();
        let found = (from..end).find(|&k| !turns(k));
        found.unwrap_or(from) % self.len()
    }
}

/// Returns the last number up to `len` for which a condition holds that holds for zero and, once it does not,
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

/// The line of edge `i` of a, with its contacts: where it enters b, and where it leaves b.
struct EdgeLine<'a, S> {
    a: ConvexRing<'a, S>,
    b: ConvexRing<'a, S>,
    i: usize,
    contacts: [LineContact; 2],
}

impl<S: Scalar<Mask = bool>> EdgeLine<'_, S> {
    /// Returns the position of a point on the edge's line: `Equal` at the start, `Greater` behind it and before the
    /// end, else `None`.
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
    /// Returns the edge of b that lies along the line, if one does.
    fn along(&self) -> Option<usize> {
        match self.contacts {
            [LineContact::Vertex(enter), LineContact::Vertex(leave)] if enter != leave => {
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
    /// Returns the meeting at the start of the edge, if that is on the border of b.
    fn at_start(&self) -> Option<BorderPoint> {
        let start = self.a.at(self.i);
        let met = |on_b| BorderPoint {
            corner: Corner::A(self.i),
            on_a: 2 * self.i,
            on_b,
        };
        for contact in self.contacts {
            match contact {
                LineContact::Vertex(j) if same(self.b.at(j), start) => return Some(met(2 * j)),
                LineContact::Edge(j) if self.b.side(j, start) == Turn::Straight => {
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
    /// Returns the meeting at one of the contacts, if that is between the ends of the edge.
    fn between(&self, which: usize) -> Option<BorderPoint> {
        let on_a = 2 * self.i + 1;
        match self.contacts[which] {
            LineContact::Vertex(j) => {
                let twice = which == 1 && self.contacts[0] == self.contacts[1];
                let inside = self.order(self.b.at(j)) == Some(Ordering::Greater);
                (inside && !twice).then_some(BorderPoint {
                    corner: Corner::B(j),
                    on_a,
                    on_b: 2 * j,
                })
            }
            LineContact::Edge(j) => {
                let [start, end] = self.a.edge(self.i).map(|p| self.b.side(j, p));
                let wanted = [(Turn::Right, Turn::Left), (Turn::Left, Turn::Right)][which];
                ((start, end) == wanted).then_some(BorderPoint {
                    corner: Corner::Cross { a: self.i, b: j },
                    on_a,
                    on_b: 2 * j + 1,
                })
            }
        }
    }
}

/// All meetings, in order; `None` when an edge separates the polygons.
pub(super) struct Meetings<const K: usize> {
    pub list: [BorderPoint; K],
    pub count: usize,
}

pub(super) fn meetings<S: Scalar<Mask = bool>, const K: usize>(
    a: ConvexRing<'_, S>,
    b: ConvexRing<'_, S>,
) -> Result<Option<Meetings<K>>, Flaw> {
    let none = BorderPoint {
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
            Turn::Straight => LineContact::Vertex(k),
            _ => LineContact::Edge(k),
        };
        let reach = EdgeLine {
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
                    fault: VertexFault::Surplus,
                });
            }
            all.list[all.count] = met;
            all.count += 1;
        }
    }
    Ok(Some(all))
}
