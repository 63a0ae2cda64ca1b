//! The triangulation of points: both halves, and the edges between them (Guibas and Stolfi 1985).
//!
//! Halves are those along x and along y in turn, so that parts are about as high as wide and few of their triangles are
//! removed later (Dwyer 1987).
use super::half_edges::{HalfEdges, back};
use crate::arrays::sort_few;
use robust::{Coord, incircle, orient2d};
use std::cmp::Ordering;

type Point = Coord<f64>;

/// The direction in which points are divided: along x, and points of one x along y, or a quarter turn from that.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

impl Axis {
    fn other(self) -> Self {
        match self {
            Axis::X => Axis::Y,
            Axis::Y => Axis::X,
        }
    }
    /// Returns the order of two points, which is equal for the same place only.
    #[inline(always)]
    fn order(self, p: Point, q: Point) -> Ordering {
        match self {
            Axis::X => p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)),
            Axis::Y => p.y.total_cmp(&q.y).then(q.x.total_cmp(&p.x)),
        }
    }
}

/// The most points that have edges without parts.
const LEAF: usize = 3;

/// Brings points, which stay with their numbers, into the order of their parts.
pub(super) fn divide(points: &mut [(Point, u32)]) {
    fn along(points: &mut [(Point, u32)], axis: Axis) {
        if points.len() <= LEAF {
            return sort_few(points, |p, q| Axis::X.order(p.0, q.0).is_lt());
        }
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |p, q| axis.order(p.0, q.0));
        let (low, high) = points.split_at_mut(middle);
        along(low, axis.other());
        along(high, axis.other());
    }
    along(points, Axis::X);
}

/// Returns the edges of a triangulation of points that are different and in the order of their [parts](divide), and one
/// edge of its border, which has the outside on its left: none for fewer than two points.
pub(super) fn triangulated(points: &[Point]) -> (HalfEdges, Option<u32>) {
    let mut work = Work {
        points,
        edges: HalfEdges::with_room(points.len()),
    };
    let border = work.conquer(0, points.len() as u32, Axis::X);
    (work.edges, border)
}

struct Work<'a> {
    points: &'a [Point],
    edges: HalfEdges,
}

impl Work<'_> {
    #[inline(always)]
    fn at(&self, vertex: u32) -> Point {
        self.points[vertex as usize]
    }
    /// Returns a number above zero for a left turn, exactly.
    #[inline(always)]
    fn turn(&self, a: u32, b: u32, c: u32) -> f64 {
        orient2d(self.at(a), self.at(b), self.at(c))
    }
    /// Returns `true` if a vertex is to the left of an edge.
    #[inline(always)]
    fn is_left(&self, vertex: u32, e: u32) -> bool {
        self.turn(vertex, self.edges.from(e), self.edges.to(e)) > 0.0
    }
    /// Returns `true` if a vertex is to the right of an edge.
    #[inline(always)]
    fn is_right(&self, vertex: u32, e: u32) -> bool {
        self.turn(vertex, self.edges.to(e), self.edges.from(e)) > 0.0
    }
    /// Returns `true` if the last vertex is inside of the circle through the others, which turn left, exactly.
    #[inline(always)]
    fn is_inside(&self, a: u32, b: u32, c: u32, d: u32) -> bool {
        incircle(self.at(a), self.at(b), self.at(c), self.at(d)) > 0.0
    }
    /// Triangulates vertices. Returns an edge of the border that has the outside on its left: none for a vertex alone.
    fn conquer(&mut self, from: u32, to: u32, axis: Axis) -> Option<u32> {
        match to - from {
            0 | 1 => None,
            2 => Some(self.edges.add(from, from + 1)),
            3 => {
                let a = self.edges.add(from, from + 1);
                let b = self.edges.add(from + 1, from + 2);
                self.edges.splice(back(a), b);
                let turn = self.turn(from, from + 1, from + 2);
                if turn != 0.0 {
                    self.edges.connect(b, a);
                }
                Some(if turn > 0.0 { back(a) } else { a })
            }
            count => {
                let middle = from + count / 2;
                let low = self.conquer(from, middle, axis.other())?;
                let high = self.conquer(middle, to, axis.other())?;
                let [_, inner_low] = self.at_end(low, axis, Ordering::Greater);
                let [inner_high, _] = self.at_end(high, axis, Ordering::Less);
                Some(self.joined(inner_low, inner_high))
            }
        }
    }
    /// Returns the edges of the border at its first or last vertex along an axis: that with the inside on its left, and that
    /// with the outside.
    fn at_end(&self, border: u32, axis: Axis, side: Ordering) -> [u32; 2] {
        let (mut best, mut before) = (border, border);
        let mut found = None;
        loop {
            let e = self.edges.after(before);
            let (vertex, least) = (self.edges.from(e), self.edges.from(best));
            if found.is_none() || axis.order(self.at(vertex), self.at(least)) == side {
                best = e;
                found = Some([back(before), e]);
            }
            before = e;
            if e == border {
                return found.unwrap_or([back(e), e]);
            }
        }
    }
    /// Joins two triangulations, the second after the first along an axis, by edges from the last vertex of the first and from
    /// the first vertex of the second. Returns an edge of the border that has the outside on its left.
    fn joined(&mut self, mut inner_left: u32, mut inner_right: u32) -> u32 {
        // The lower common tangent.
        loop {
            if self.is_left(self.edges.from(inner_right), inner_left) {
                inner_left = self.edges.after(inner_left);
            } else if self.is_right(self.edges.from(inner_left), inner_right) {
                inner_right = self.edges.left_of(back(inner_right));
            } else {
                break;
            }
        }
        let lowest = self.edges.connect(back(inner_right), inner_left);
        let mut base = lowest;
        // The base rises from triangle to triangle.
        loop {
            let (to, from) = (self.edges.to(base), self.edges.from(base));
            let mut left = self.edges.left_of(back(base));
            let has_left = self.is_right(self.edges.to(left), base);
            if has_left {
                loop {
                    let next = self.edges.left_of(left);
                    if !self.is_inside(to, from, self.edges.to(left), self.edges.to(next)) {
                        break;
                    }
                    self.edges.remove(left);
                    left = next;
                }
            }
            let mut right = self.edges.right_of(base);
            let has_right = self.is_right(self.edges.to(right), base);
            if has_right {
                loop {
                    let next = self.edges.right_of(right);
                    if !self.is_inside(to, from, self.edges.to(right), self.edges.to(next)) {
                        break;
                    }
                    self.edges.remove(right);
                    right = next;
                }
            }
            if !has_left && !has_right {
                return lowest;
            }
            let is_right_next = !has_left
                || (has_right
                    && self.is_inside(
                        self.edges.to(left),
                        self.edges.from(left),
                        self.edges.from(right),
                        self.edges.to(right),
                    ));
            base = if is_right_next {
                self.edges.connect(right, back(base))
            } else {
                self.edges.connect(back(base), back(left))
            };
        }
    }
}
