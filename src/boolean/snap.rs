//! Edges cut and rounded to a coarser grid, so that they meet at their ends only.
//!
//! Snap rounding (Hobby, Practical segment intersection with finite precision output, 1999): a square of the coarse
//! grid is *hot* if an end of an edge or a crossing of two lies in it. An edge goes through the centres of all hot
//! squares that it meets. Then no two edges cross, and each moves by less than a square.
use i_overlay::i_float::int::point::IntPoint;

type Point = IntPoint<i64>;

/// A grid of squares with sides of a power of two of fine steps. The lower and left sides belong to a square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Squares {
    /// The binary logarithm of the size of a square: one at least.
    pub bits: u32,
}

impl Squares {
    fn half(self) -> i64 {
        1 << (self.bits - 1)
    }
    /// Returns the square that contains a point.
    pub fn of(self, at: Point) -> Point {
        let number = |x: i64| (x + self.half()) >> self.bits;
        Point::new(number(at.x), number(at.y))
    }
    /// Returns the centre of a square.
    pub fn center(self, square: Point) -> Point {
        Point::new(square.x << self.bits, square.y << self.bits)
    }
    /// Returns for each edge the hot squares that it meets, from its start to its end.
    pub fn along(self, edges: &[[Point; 2]]) -> Vec<Vec<Point>> {
        let mut hot: Vec<Point> = edges.iter().flatten().map(|&p| self.of(p)).collect();
        let mut order: Vec<usize> = (0..edges.len()).collect();
        order.sort_unstable_by_key(|&k| edges[k][0].x.min(edges[k][1].x));
        for (i, &k) in order.iter().enumerate() {
            let right = edges[k][0].x.max(edges[k][1].x);
            let near = order[i + 1..].iter().map(|&j| edges[j]);
            let near = near.take_while(|other| other[0].x.min(other[1].x) <= right);
            hot.extend(
                near.filter_map(|other| crossing(edges[k], other))
                    .map(|p| self.of(p)),
            );
        }
        hot.sort_unstable();
        hot.dedup();
        edges.iter().map(|&edge| self.path(edge, &hot)).collect()
    }
    /// Returns the hot squares that an edge meets; `hot` is in ascending order.
    fn path(self, [from, to]: [Point; 2], hot: &[Point]) -> Vec<Point> {
        let [start, end] = [from, to].map(|p| self.of(p));
        let (left, right) = (start.x.min(end.x), start.x.max(end.x));
        let (low, high) = (start.y.min(end.y), start.y.max(end.y));
        let first = hot.partition_point(|square| square.x < left);
        let near = hot[first..].iter().take_while(|square| square.x <= right);
        let met = near.filter(|x| low <= x.y && x.y <= high && self.meets(from, to, **x));
        let mut path: Vec<Point> = met.copied().collect();
        // The path is monotone in both coordinates.
        let way = |ahead: bool, x: i64| if ahead { x } else { -x };
        path.sort_unstable_by_key(|square| {
            (way(to.x >= from.x, square.x), way(to.y >= from.y, square.y))
        });
        path
    }
    /// Returns `true` if an edge meets a square: neither an axis nor the normal of the edge separates them. The upper
    /// and right sides of the square are infinitely little inside of where they are.
    fn meets(self, from: Point, to: Point, square: Point) -> bool {
        let (center, half) = (self.center(square), self.half());
        let apart = |from: i64, to: i64, center: i64| {
            from.max(to) < center - half || from.min(to) >= center + half
        };
        if apart(from.x, to.x, center.x) || apart(from.y, to.y, center.y) {
            return false;
        }
        let (dx, dy) = (i128::from(to.x - from.x), i128::from(to.y - from.y));
        let side = |right: bool, upper: bool| {
            let x = i128::from(center.x - from.x + if right { half } else { -half });
            let y = i128::from(center.y - from.y + if upper { half } else { -half });
            let little = dy * i128::from(right) - dx * i128::from(upper);
            match (dx * y - dy * x).signum() {
                0 => little.signum(),
                side => side,
            }
        };
        let sides = [
            side(false, false),
            side(true, false),
            side(false, true),
            side(true, true),
        ];
        !(sides.iter().all(|&x| x > 0) || sides.iter().all(|&x| x < 0))
    }
}

/// Returns the crossing of two edges that are not parallel, rounded down in both coordinates.
pub(super) fn crossing(a: [Point; 2], b: [Point; 2]) -> Option<Point> {
    let apart = |a: [i64; 2], b: [i64; 2]| {
        a[0].max(a[1]) < b[0].min(b[1]) || b[0].max(b[1]) < a[0].min(a[1])
    };
    if apart(a.map(|p| p.x), b.map(|p| p.x)) || apart(a.map(|p| p.y), b.map(|p| p.y)) {
        return None;
    }
    // Differences have up to 62 bits, these up to 125.
    let cross = |from: Point, to: Point, at: Point| {
        let [ux, uy] = [to.x - from.x, to.y - from.y].map(i128::from);
        let [vx, vy] = [at.x - from.x, at.y - from.y].map(i128::from);
        ux * vy - uy * vx
    };
    let (before, after) = (cross(b[0], b[1], a[0]), cross(b[0], b[1], a[1]));
    if before.signum() * after.signum() > 0 || before == after {
        return None;
    }
    if cross(a[0], a[1], b[0]).signum() * cross(a[0], a[1], b[1]).signum() > 0 {
        return None;
    }
    let (part, whole) = (before.unsigned_abs(), (before - after).unsigned_abs());
    let number = |from: i64, to: i64| {
        let (way, rest) = share(from.abs_diff(to), part, whole);
        match to >= from {
            true => from + way,
            false => from - way - i64::from(rest),
        }
    };
    Some(Point::new(number(a[0].x, a[1].x), number(a[0].y, a[1].y)))
}

/// Returns a fraction of a length, rounded down, and `true` if there is a rest. The fraction is at most one.
fn share(length: u64, part: u128, whole: u128) -> (i64, bool) {
    let (mut quotient, mut rest) = (0, 0);
    for bit in (0..64).rev() {
        rest *= 2;
        quotient *= 2;
        if length >> bit & 1 == 1 {
            rest += part;
        }
        while rest >= whole {
            rest -= whole;
            quotient += 1;
        }
    }
    (quotient, rest > 0)
}
