//! The raw offset of rings: every edge moved along its normal, joined at every vertex.
use crate::{Polygon, Scalar, Vec2};

/// The raw vertices at a vertex of a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum Bend {
    /// In line with both neighbours: one vertex.
    Straight,
    /// The moved edges cross: back to the vertex and out again.
    Inner,
    /// The crossing of the moved edges, inside or outside.
    Tip,
    /// So many vertices of an arc between the ends of both edges.
    Round(usize),
    /// The crossing, cut straight across.
    Cut,
    /// The ends of both edges.
    Bevel,
    /// The end of a path, one distance ahead.
    Square,
}

impl Bend {
    /// Returns the number of raw vertices.
    pub fn count(self) -> usize {
        match self {
            Bend::Straight | Bend::Tip => 1,
            Bend::Cut | Bend::Bevel | Bend::Square => 2,
            Bend::Inner => 3,
            Bend::Round(count) => count + 2,
        }
    }
}

/// The decisions behind raw rings: for each the vertices, numbered among all of the input, and the kind of corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Plan {
    pub walks: Vec<Vec<(usize, Bend)>>,
    /// Cosine and sine of one, two and more steps of arcs.
    pub turns: Vec<[f64; 2]>,
    /// The most distances from a vertex to a cut.
    pub limit: f64,
    /// Rings run backwards and move by the negative distance: the offset of all that is outside.
    pub is_inward: bool,
}

/// Returns a vector turned right by a quarter.
#[inline]
pub(crate) fn right<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    Vec2::new(v.y, -v.x)
}

/// Returns the directions of the edges that leave each vertex of a walk, and the lengths of these edges.
pub(crate) fn directions<S: Scalar>(
    points: &[Vec2<S>],
    walk: &[(usize, Bend)],
) -> Vec<(Vec2<S>, S)> {
    let n = walk.len();
    let of = |k: usize| {
        let way = points[walk[(k + 1) % n].0] - points[walk[k].0];
        let length = way.length();
        (Vec2::new(way.x.over(length), way.y.over(length)), length)
    };
    (0..n).map(of).collect()
}

/// Returns how far along both edges a cut lies, in distances: `(limit − cos half) / sin half` of the turn.
#[inline]
pub(crate) fn cut_share<S: Scalar>(u: Vec2<S>, w: Vec2<S>, limit: f64) -> S {
    let square = (u - w).length_squared();
    let twice = S::lit(limit) * square.root() - u.perp_dot(w);
    (twice + twice).over(square)
}

impl Plan {
    /// Returns the distance by which rings move outward.
    pub fn radius<S: Scalar>(&self, d: S) -> S {
        if self.is_inward { -d } else { d }
    }
    /// Returns the raw rings. Straight line.
    ///
    /// Their winding number is that of the polygon, plus one per rectangle over an edge and per piece at a corner that
    /// covers a point.
    pub fn raw<S: Scalar>(&self, points: &[Vec2<S>], d: S) -> Polygon<S> {
        let r = self.radius(d);
        let mut made = Polygon::new();
        for walk in &self.walks {
            let n = walk.len();
            let ways = directions(points, walk);
            let mut ring = Vec::with_capacity(2 * n);
            for k in 0..n {
                let (vertex, bend) = walk[k];
                let (at, u, w) = (points[vertex], ways[(k + n - 1) % n].0, ways[k].0);
                self.corner(at, [u, w], r, bend, &mut ring);
            }
            made.push(ring);
        }
        made
    }
    /// Adds the vertices at a corner, between the directions of two edges.
    fn corner<S: Scalar>(
        &self,
        at: Vec2<S>,
        [u, w]: [Vec2<S>; 2],
        r: S,
        bend: Bend,
        ring: &mut Vec<Vec2<S>>,
    ) {
        let (from, to) = (right(u) * r, right(w) * r);
        match bend {
            Bend::Straight => ring.push(at + to),
            Bend::Inner => ring.extend([at + from, at, at + to]),
            Bend::Tip => {
                let whole = right(u) + right(w);
                // |whole|² = 2 (1 + cos turn); the tip is r whole / (1 + cos turn).
                ring.push(at + whole * (r + r).over(whole.length_squared()));
            }
            Bend::Round(count) => {
                ring.push(at + from);
                for turn in &self.turns[..count] {
                    let [cos, sin] = turn.map(S::lit);
                    let way = Vec2::new(from.x * cos - from.y * sin, from.x * sin + from.y * cos);
                    ring.push(at + way);
                }
                ring.push(at + to);
            }
            Bend::Cut => {
                let share = r * cut_share(u, w, self.limit);
                ring.extend([at + from + u * share, at + to - w * share]);
            }
            Bend::Bevel => ring.extend([at + from, at + to]),
            Bend::Square => ring.extend([at + from + u * r, at + to + u * r]),
        }
    }
}
