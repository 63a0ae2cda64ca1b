//! Pieces of a border on a coarser grid, rounded so that they still meet at their ends only.
//!
//! Snap rounding (Hobby, Practical segment intersection with finite precision output, 1999): a square of the coarse grid
//! is *hot* if an end lies in it, and a piece goes through the centres of all hot squares that it meets. Then no two
//! pieces cross, and each moves by less than a square.
use i_overlay::i_float::int::point::IntPoint;

type Point = IntPoint<i64>;

/// A grid of squares of so many fine steps, a power of two. A square has its lower and left sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Squares {
    /// The binary logarithm of the size of a square: one at least.
    pub bits: u32,
}

impl Squares {
    fn half(self) -> i64 {
        1 << (self.bits - 1)
    }
    /// The square of a place.
    pub fn of(self, at: Point) -> Point {
        let number = |x: i64| (x + self.half()) >> self.bits;
        Point::new(number(at.x), number(at.y))
    }
    /// The centre of a square.
    pub fn center(self, square: Point) -> Point {
        Point::new(square.x << self.bits, square.y << self.bits)
    }
    /// For each piece the hot squares that it meets, from its start to its end.
    pub fn along(self, pieces: &[[Point; 2]]) -> Vec<Vec<Point>> {
        let mut hot: Vec<Point> = pieces.iter().flatten().map(|&p| self.of(p)).collect();
        hot.sort_unstable();
        hot.dedup();
        pieces.iter().map(|&piece| self.path(piece, &hot)).collect()
    }
    /// The hot squares that a piece meets; `hot` is in ascending order.
    fn path(self, [from, to]: [Point; 2], hot: &[Point]) -> Vec<Point> {
        let [start, end] = [from, to].map(|p| self.of(p));
        let (left, right) = (start.x.min(end.x), start.x.max(end.x));
        let (low, high) = (start.y.min(end.y), start.y.max(end.y));
        let first = hot.partition_point(|square| square.x < left);
        let near = hot[first..].iter().take_while(|square| square.x <= right);
        let met = near.filter(|x| low <= x.y && x.y <= high && self.meets(from, to, **x));
        let mut path: Vec<Point> = met.copied().collect();
        // The way never turns back in either coordinate.
        let way = |ahead: bool, x: i64| if ahead { x } else { -x };
        path.sort_unstable_by_key(|square| {
            (way(to.x >= from.x, square.x), way(to.y >= from.y, square.y))
        });
        path
    }
    /// Whether a piece meets a square: whether neither an axis nor the normal of the piece separates them. The upper and
    /// right sides of the square are infinitely little inside of where they are.
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
