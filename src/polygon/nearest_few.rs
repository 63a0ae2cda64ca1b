//! The nearest edges of short lists: approximate distances of all pairs at once tell which pairs can be nearest.
use super::box_ends::{Ends, NOWHERE, join, joined, squared_gap};
use crate::{Scalar, Vec2};

/// Differences of coordinates of which squares and products are far from the limits of the format.
const ORDINARY: std::ops::Range<f64> = 1e-100..1e140;
/// The squared length from which on a parameter along an edge has its digits. Shorter edges count as points.
const LEAST: f64 = 1e-280;
/// Roundings of the side on which a point lies of a line, in units of ε times the square of the largest difference.
const SIDES: f64 = 64.0;

/// Numbers of edges by axis, in the order of the list.
type Plane<const ROOM: usize> = [[f64; ROOM]; 2];

/// Edges that can be nearest.
struct Lanes<const ROOM: usize> {
    count: usize,
    /// Their places in the list.
    places: [usize; ROOM],
    from: Plane<ROOM>,
    to: Plane<ROOM>,
    along: Plane<ROOM>,
    /// The reciprocals of their squared lengths.
    inverse: [f64; ROOM],
}

/// Pairs of edges that can be nearest to each other, up to so many edges of one list. To clear room for sixteen takes as
/// long as to search four.
pub(super) struct Candidates<const ROOM: usize> {
    a: Lanes<ROOM>,
    b: Lanes<ROOM>,
    /// The approximate square of the distance of every pair; 0 where they may cross.
    squares: [[f64; ROOM]; ROOM],
}

impl<const ROOM: usize> Candidates<ROOM> {
    /// Creates room for pairs.
    #[inline(always)]
    pub fn new() -> Self {
        let none = || Lanes {
            count: 0,
            places: [0; ROOM],
            from: [[0.0; ROOM]; 2],
            to: [[0.0; ROOM]; 2],
            along: [[0.0; ROOM]; 2],
            inverse: [0.0; ROOM],
        };
        Candidates {
            a: none(),
            b: none(),
            squares: [[f64::INFINITY; ROOM]; ROOM],
        }
    }
    /// Finds the candidates of two lists with a box around each, and returns the least of their squares; `None` where there
    /// are too many. `spread` is the largest difference of two coordinates.
    #[inline(always)]
    pub fn find<S: Scalar>(
        &mut self,
        a: &[[Vec2<S>; 2]],
        b: &[[Vec2<S>; 2]],
        wholes: [Ends; 2],
        approach: &Approach,
        spread: f64,
    ) -> Option<f64> {
        (self.a.count, self.b.count) = (0, 0);
        if let Some([least, most]) = approach.limits {
            let is_kept = |[from, to]: [f64; 2]| from >= least || to >= least;
            let limit = approach.square;
            self.a.fill(a, |edge| {
                is_kept(approach.heights(edge)) && squared_gap(ends(edge), wholes[1]) <= limit
            })?;
            let is_kept = |[from, to]: [f64; 2]| from <= most || to <= most;
            let others = self.a.bounds();
            self.b.fill(b, |edge| {
                is_kept(approach.heights(edge)) && squared_gap(ends(edge), others) <= limit
            })?;
            return Some(self.measure::<false>(0.0));
        }
        let limit = approach.square;
        let seen = a.iter().map(|&edge| ends(edge));
        let near = seen
            .filter(|&own| squared_gap(own, wholes[1]) <= limit)
            .fold(NOWHERE, joined);
        self.b
            .fill(b, |edge| squared_gap(ends(edge), near) <= limit)?;
        let others = self.b.bounds();
        self.a
            .fill(a, |edge| squared_gap(ends(edge), others) <= limit)?;
        Some(match squared_gap(self.a.bounds(), others) > 0.0 {
            true => self.measure::<false>(0.0),
            false => self.measure::<true>(SIDES * f64::EPSILON * spread * spread),
        })
    }
    /// Computes the squares of all pairs, and returns the least one of their ends, which bounds the distance. Edges may cross
    /// if `MEET`.
    #[inline(always)]
    fn measure<const MEET: bool>(&mut self, slack: f64) -> f64 {
        let (a, b) = (&self.a, &self.b);
        // Pairs of edges fill the processor's lanes; those beyond the last one are points at the origin.
        let count = b.count.next_multiple_of(2);
        let mut least = [f64::INFINITY; ROOM];
        for (i, squares) in self.squares.iter_mut().enumerate().take(a.count) {
            let of = |plane: &Plane<ROOM>| [plane[0][i], plane[1][i]];
            let (from, to, along) = (of(&a.from), of(&a.to), of(&a.along));
            for (j, (square, least)) in squares.iter_mut().zip(&mut least).enumerate().take(count) {
                let of = |plane: &Plane<ROOM>| [plane[0][j], plane[1][j]];
                let (start, end, way) = (of(&b.from), of(&b.to), of(&b.along));
                let ends_of_a = less(
                    apart(from, start, way, b.inverse[j]),
                    apart(to, start, way, b.inverse[j]),
                );
                let ends_of_b = less(
                    apart(start, from, along, a.inverse[i]),
                    apart(end, from, along, a.inverse[i]),
                );
                let near = less(ends_of_a, ends_of_b);
                let may_cross = MEET
                    && parts(from, along, start, end, slack) & parts(start, way, from, to, slack);
                *square = if may_cross { 0.0 } else { near };
                *least = less(*least, near);
            }
        }
        least[..b.count].iter().copied().fold(f64::INFINITY, less)
    }
    /// Returns the places in both lists of the pairs within a square, in order, and `true` of those that cannot cross.
    pub fn within(&self, limit: f64) -> impl Iterator<Item = ([usize; 2], bool)> {
        let (a, b) = (&self.a, &self.b);
        let row = move |i: usize| {
            let squares = self.squares[i][..b.count].iter().enumerate();
            let near = squares.filter(move |&(_, &square)| square <= limit);
            near.map(move |(j, &square)| ([a.places[i], b.places[j]], square > 0.0))
        };
        (0..a.count).flat_map(row)
    }
}

impl<const ROOM: usize> Lanes<ROOM> {
    /// Takes the edges that are near; `None` where they are too many.
    #[inline(always)]
    fn fill<S: Scalar>(
        &mut self,
        edges: &[[Vec2<S>; 2]],
        is_near: impl Fn([Vec2<S>; 2]) -> bool,
    ) -> Option<()> {
        for (place, &edge) in edges.iter().enumerate() {
            if !is_near(edge) {
                continue;
            }
            let k = self.count;
            if k == ROOM {
                return None;
            }
            let [from, to] = edge.map(wide);
            for axis in 0..2 {
                self.from[axis][k] = from[axis];
                self.to[axis][k] = to[axis];
                self.along[axis][k] = to[axis] - from[axis];
            }
            let length = square(to, from);
            self.inverse[k] = if length > LEAST { 1.0 / length } else { 0.0 };
            self.places[k] = place;
            self.count = k + 1;
        }
        Some(())
    }
    /// Returns the box around the edges.
    #[inline(always)]
    fn bounds(&self) -> Ends {
        [0, 1].map(|axis| {
            let (from, to) = (&self.from[axis][..self.count], &self.to[axis][..self.count]);
            let both = from.iter().zip(to);
            both.fold(NOWHERE[axis], |all, (&from, &to)| {
                join(join(all, [from; 2]), [to; 2])
            })
        })
    }
}

/// Two vertices near each other, and the heights of both lists along the way from one to the other.
pub(super) struct Approach {
    from: [f64; 2],
    way: [f64; 2],
    /// The square beyond which no edges are nearest.
    square: f64,
    /// The least height of nearest edges of the first list and the largest of the second, if a line parts both.
    limits: Option<[f64; 2]>,
}

impl Approach {
    /// Returns the way between the nearest of some vertices; `None` of numbers too large or too small. `slack` bounds the
    /// roundings of a distance.
    #[inline(always)]
    pub fn of<S: Scalar>(
        a: &[[Vec2<S>; 2]],
        b: &[[Vec2<S>; 2]],
        spread: f64,
        slack: f64,
    ) -> Option<Self> {
        if !ORDINARY.contains(&spread) {
            return None;
        }
        // Vertices near each other bound the distance: the nearest one of b, from there that of a, and so on.
        let (on_b, _) = nearest_start(b, wide(a.first()?[0]));
        let (on_a, _) = nearest_start(a, on_b);
        let (on_b, square) = nearest_start(b, on_a);
        let mut found = Approach {
            from: on_a,
            way: [on_b[0] - on_a[0], on_b[1] - on_a[1]],
            square: beyond(square, slack),
            limits: None,
        };
        let more = |a: f64, b: f64| if b > a { b } else { a };
        let (mut top, mut bottom) = (f64::NEG_INFINITY, f64::INFINITY);
        for &edge in a {
            let [from, to] = found.heights(edge);
            top = more(top, more(from, to));
        }
        for &edge in b {
            let [from, to] = found.heights(edge);
            bottom = less(bottom, less(from, to));
        }
        // No two points are nearer to each other than their heights are, over the length of the way.
        let roundings = SIDES * f64::EPSILON * spread * spread;
        if bottom - top > roundings {
            let reach = (found.square * square).sqrt() * (1.0 + 8.0 * f64::EPSILON) + roundings;
            found.limits = Some([bottom - reach, top + reach]);
        }
        Some(found)
    }
    /// Returns `true` if a line has all of the first list on one side and all of the second on the other.
    pub fn is_parted(&self) -> bool {
        self.limits.is_some()
    }
    #[inline(always)]
    fn height<S: Scalar>(&self, at: Vec2<S>) -> f64 {
        let [x, y] = wide(at);
        (x - self.from[0]) * self.way[0] + (y - self.from[1]) * self.way[1]
    }
    #[inline(always)]
    fn heights<S: Scalar>(&self, edge: [Vec2<S>; 2]) -> [f64; 2] {
        edge.map(|end| self.height(end))
    }
}

/// Returns the square beyond which nothing within a slack of a squared distance lies.
#[inline(always)]
pub(super) fn beyond(square: f64, slack: f64) -> f64 {
    let far = square.sqrt() * (1.0 + 8.0 * f64::EPSILON) + slack;
    far * far * (1.0 + 8.0 * f64::EPSILON) + f64::MIN_POSITIVE
}

#[inline(always)]
fn less(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}
#[inline(always)]
fn wide<S: Scalar>(v: Vec2<S>) -> [f64; 2] {
    [v.x, v.y].map(|x| x.widened().unwrap_or(f64::NAN))
}
#[inline(always)]
fn square(a: [f64; 2], b: [f64; 2]) -> f64 {
    let (x, y) = (a[0] - b[0], a[1] - b[1]);
    x * x + y * y
}

/// Returns the box of an edge.
#[inline(always)]
fn ends<S: Scalar>(edge: [Vec2<S>; 2]) -> Ends {
    let [from, to] = edge.map(wide);
    [0, 1].map(|k| join([from[k]; 2], [to[k]; 2]))
}

/// Returns the start of an edge that is nearest to a point, and the square of its distance.
#[inline(always)]
fn nearest_start<S: Scalar>(edges: &[[Vec2<S>; 2]], at: [f64; 2]) -> ([f64; 2], f64) {
    let (mut best, mut least) = (0, f64::INFINITY);
    // A place is selected without a branch, which nobody could foresee.
    for (place, &[from, _]) in edges.iter().enumerate() {
        let own = square(wide(from), at);
        best = if own < least { place } else { best };
        least = less(least, own);
    }
    (edges.get(best).map_or(at, |&[from, _]| wide(from)), least)
}

/// Returns the approximate squared distance of a point from an edge.
#[inline(always)]
fn apart(at: [f64; 2], from: [f64; 2], along: [f64; 2], inverse: f64) -> f64 {
    let (x, y) = (at[0] - from[0], at[1] - from[1]);
    let t = (x * along[0] + y * along[1]) * inverse;
    let t = if t > 0.0 { t } else { 0.0 };
    let t = less(1.0, t);
    let (x, y) = (x - t * along[0], y - t * along[1]);
    x * x + y * y
}

/// Returns `true` unless the ends of one of two edges surely lie on one side of the other's line. `spread` is the largest
/// difference of two coordinates.
#[inline(always)]
pub(super) fn may_cross<S: Scalar>(a: [Vec2<S>; 2], b: [Vec2<S>; 2], spread: f64) -> bool {
    if !ORDINARY.contains(&spread) {
        return true;
    }
    let slack = SIDES * f64::EPSILON * spread * spread;
    let ([from, to], [start, end]) = (a.map(wide), b.map(wide));
    let along = |[from, to]: [[f64; 2]; 2]| [to[0] - from[0], to[1] - from[1]];
    parts(from, along([from, to]), start, end, slack)
        && parts(start, along([start, end]), from, to, slack)
}

/// Returns `true` unless two points surely lie on one side of the line of an edge.
#[inline(always)]
fn parts(from: [f64; 2], along: [f64; 2], p: [f64; 2], q: [f64; 2], slack: f64) -> bool {
    let side = |at: [f64; 2]| along[0] * (at[1] - from[1]) - along[1] * (at[0] - from[0]);
    let (p, q) = (side(p), side(q));
    !((p > slack) & (q > slack) | (p < -slack) & (q < -slack))
}
