//! The border of a result as rings of connected parts, none of which meets itself.
use i_overlay::i_float::int::point::IntPoint;

type Point = IntPoint<i64>;

/// A piece of the border with the inside on its left. Pieces meet at their ends only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct BorderPiece {
    pub from: Point,
    pub to: Point,
    /// Its index in the list of edges.
    pub of: usize,
}

/// A ring by the numbers of its pieces.
pub(super) type Ring = Vec<usize>;

/// Returns twice the area of a triangle, positive when its corners run counter-clockwise. Coordinates have up to 54
/// bits.
fn turn(a: Point, b: Point, c: Point) -> i128 {
    let [ux, uy, vx, vy] = [b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y].map(i128::from);
    ux * vy - uy * vx
}

/// Returns `true` if three points of a ring are collinear.
pub(super) fn is_straight(a: Point, b: Point, c: Point) -> bool {
    turn(a, b, c) == 0
}

/// Returns the connected parts that pieces bound, each as its outer ring, counter-clockwise, and its holes.
pub(super) fn parts(mut pieces: Vec<BorderPiece>) -> Vec<Vec<Ring>> {
    pieces.sort_unstable();
    // Pieces on each other: two in opposite directions cancel.
    let count = |from, to| {
        let first = pieces.partition_point(|x| (x.from, x.to) < (from, to));
        pieces[first..]
            .iter()
            .take_while(|x| (x.from, x.to) == (from, to))
            .count()
    };
    let kept = pieces
        .iter()
        .filter(|x| count(x.from, x.to) > count(x.to, x.from));
    let mut kept: Vec<BorderPiece> = kept.copied().collect();
    kept.dedup_by_key(|piece| (piece.from, piece.to));
    let border = BorderPieces { pieces: kept };
    let (mut parts, mut inner): (Vec<ResultPart>, Vec<Vec<Ring>>) = (Vec::new(), Vec::new());
    for cycle in border.cycles() {
        let (outer, holes): (Vec<Ring>, Vec<Ring>) = border
            .simple(&cycle)
            .into_iter()
            .filter(|ring| border.area(ring) != 0)
            .partition(|ring| border.area(ring) > 0);
        match <[Ring; 1]>::try_from(outer) {
            Ok([outer]) => parts.push(ResultPart {
                area: border.area(&outer),
                rings: [vec![outer], holes].concat(),
            }),
            Err(_) => inner.push(holes),
        }
    }
    // The border of a hole has no point of the outer ring of its part: otherwise both would be one cycle.
    for holes in inner {
        let Some(&piece) = holes.first().and_then(|ring| ring.first()) else {
            continue;
        };
        let place = border.pieces[piece].from;
        let around = parts
            .iter_mut()
            .filter(|part| border.is_inside(place, &part.rings[0]));
        if let Some(part) = around.min_by_key(|part| part.area) {
            part.rings.extend(holes);
        }
    }
    let numbered = |ring: Ring| ring.into_iter().map(|k| border.pieces[k].of).collect();
    let numbered = |part: ResultPart| part.rings.into_iter().map(numbered).collect();
    parts.into_iter().map(numbered).collect()
}

/// The outer ring and the holes of a part.
struct ResultPart {
    /// Twice the area inside the outer ring.
    area: i128,
    rings: Vec<Ring>,
}

/// All pieces, in order of where they begin.
struct BorderPieces {
    pieces: Vec<BorderPiece>,
}

impl BorderPieces {
    /// Returns the pieces that begin at a point.
    fn leaving(&self, at: Point) -> std::ops::Range<usize> {
        let first = self.pieces.partition_point(|piece| piece.from < at);
        let last = self.pieces.partition_point(|piece| piece.from <= at);
        first..last
    }
    /// Returns the piece after one: the first in clockwise order from it, so that the inside stays on the left.
    fn next(&self, k: usize) -> Option<usize> {
        let BorderPiece {
            from: back, to: at, ..
        } = self.pieces[k];
        // Less than half a turn from the reverse direction.
        let is_early = |to: Point| {
            let turned = turn(at, back, to);
            turned < 0 || turned == 0 && !is_same_way(at, back, to)
        };
        self.leaving(at).reduce(|best, other| {
            let (p, q) = (self.pieces[best].to, self.pieces[other].to);
            match (is_early(p), is_early(q)) {
                (true, false) => best,
                (false, true) => other,
                _ if turn(at, p, q) > 0 => other,
                _ => best,
            }
        })
    }
    /// Returns the closed walks along the border of one connected part, outside or around a hole.
    fn cycles(&self) -> Vec<Ring> {
        let mut visited = vec![false; self.pieces.len()];
        let mut cycles = Vec::new();
        for start in 0..self.pieces.len() {
            let (mut cycle, mut k) = (Vec::new(), start);
            while !visited[k] {
                visited[k] = true;
                cycle.push(k);
                k = self.next(k).unwrap_or(start);
            }
            if !cycle.is_empty() {
                cycles.push(cycle);
            }
        }
        cycles
    }
    /// Splits a closed walk into rings that visit no point twice.
    fn simple(&self, cycle: &[usize]) -> Vec<Ring> {
        let (mut rings, mut open): (Vec<Ring>, Ring) = (Vec::new(), Vec::new());
        // The points of the walk so far, each with its index in `open`.
        let mut places = std::collections::HashMap::new();
        for &k in cycle {
            let at = self.pieces[k].from;
            if let Some(&since) = places.get(&at) {
                let ring = open.split_off(since);
                for k in &ring {
                    places.remove(&self.pieces[*k].from);
                }
                rings.push(ring);
            }
            places.insert(at, open.len());
            open.push(k);
        }
        rings.push(open);
        rings
    }
    /// Returns twice the signed area of a ring.
    fn area(&self, ring: &[usize]) -> i128 {
        let Some(&first) = ring.first() else { return 0 };
        let seen = self.pieces[first].from;
        let of = |&k: &usize| turn(seen, self.pieces[k].from, self.pieces[k].to);
        ring.iter().map(of).sum()
    }
    /// Returns `true` if a point is inside a ring and not on its border.
    fn is_inside(&self, at: Point, ring: &[usize]) -> bool {
        let mut is_inside = false;
        for &k in ring {
            let BorderPiece { from, to, .. } = self.pieces[k];
            if (from.y > at.y) == (to.y > at.y) {
                let level = from.y == at.y && to.y == at.y;
                let between = from.x.min(to.x) <= at.x && at.x <= from.x.max(to.x);
                if level && between || to == at {
                    return false;
                }
                continue;
            }
            let side = turn(from, to, at);
            if side == 0 {
                return false;
            }
            if (side > 0) == (to.y > from.y) {
                is_inside = !is_inside;
            }
        }
        is_inside
    }
}

/// Returns `true` if two points in line with a third one lie on one side of it.
fn is_same_way(at: Point, a: Point, b: Point) -> bool {
    let [ux, uy, vx, vy] = [a.x - at.x, a.y - at.y, b.x - at.x, b.y - at.y].map(i128::from);
    ux * vx + uy * vy > 0
}
