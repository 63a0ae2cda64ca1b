//! The triangulation of sorted points: both halves, and the edges between them (Guibas and Stolfi 1985).
use super::half_edges::{HalfEdges, back};
use robust::{Coord, incircle, orient2d};

type Point = Coord<f64>;

/// Returns the edges of a triangulation of points that are different and sorted by x, then by y, and one edge of its
/// border, which has the triangulation on its left: none for fewer than two points.
pub(super) fn triangulated(points: &[Point]) -> (HalfEdges, Option<u32>) {
    let mut work = Work {
        points,
        edges: HalfEdges::with_room(points.len()),
    };
    let border = (points.len() >= 2).then(|| work.conquer(0, points.len() as u32)[0]);
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
    /// Triangulates two or more vertices. Returns the edge of the border from the leftmost vertex that has the inside on its
    /// left, and that from the rightmost vertex which has it on its right.
    fn conquer(&mut self, from: u32, to: u32) -> [u32; 2] {
        match to - from {
            2 => {
                let e = self.edges.add(from, from + 1);
                [e, back(e)]
            }
            3 => {
                let a = self.edges.add(from, from + 1);
                let b = self.edges.add(from + 1, from + 2);
                self.edges.splice(back(a), b);
                let turn = self.turn(from, from + 1, from + 2);
                if turn == 0.0 {
                    return [a, back(b)];
                }
                let c = self.edges.connect(b, a);
                if turn > 0.0 {
                    [a, back(b)]
                } else {
                    [back(c), c]
                }
            }
            count => {
                let middle = from + count / 2;
                let left = self.conquer(from, middle);
                let right = self.conquer(middle, to);
                self.joined(left, right)
            }
        }
    }
    /// Joins two triangulations, the second to the right of the first.
    fn joined(
        &mut self,
        [mut outer_left, mut inner_left]: [u32; 2],
        [mut inner_right, mut outer_right]: [u32; 2],
    ) -> [u32; 2] {
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
        let mut base = self.edges.connect(back(inner_right), inner_left);
        if self.edges.from(inner_left) == self.edges.from(outer_left) {
            outer_left = back(base);
        }
        if self.edges.from(inner_right) == self.edges.from(outer_right) {
            outer_right = base;
        }
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
                return [outer_left, outer_right];
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
