//! Edges cut into pieces that meet at their ends only, or the answer that these would be too many.
//!
//! i_overlay cuts edges where they cross, rounds these points to the grid, and begins again until nothing crosses. Some
//! edges lie within a few steps of each other over a length of many steps. Then each round bends pieces to where they
//! cross anew. Their number doubles until pieces are about as short as steps, which exceeds any memory. i_overlay has
//! no limit of rounds. This file therefore runs the rounds of such edges, by i_overlay's rules (of version 9.1, bit for
//! bit) and with a limit; i_overlay then has nothing left to cut. `Cargo.toml` admits that version only, and a test
//! compares both ([`is_cut_alike`](super::is_cut_alike)).
use i_overlay::i_float::int::number::int::IntNumber;
use i_overlay::i_float::int::number::product_uint::UIntProduct;
use i_overlay::i_float::int::number::uint::UIntNumber;
use i_overlay::i_float::int::point::IntPoint;

type Point = IntPoint<i64>;

/// The growth of the number of pieces that is allowed after the first round: a factor, and a number of pieces.
const GROWTH: (usize, usize) = (8, 1024);

/// The largest number of rounds: by then ends attract crossings from everywhere.
const ROUNDS: u32 = 120;

/// The difference of directions, in radians or half of that, up to which the pieces of two edges may become many.
/// Edges that cross at a larger one are close to each other for 2²⁴ steps at most. Their cuts end after 2¹⁶ pieces,
/// because ends attract crossings from further away in every round.
const SLIGHT: f64 = 1.0 / (1 << 20) as f64;

/// The distance in steps within which edges are close to each other, and the number of steps over which they may be
/// close.
const CLOSE: (f64, f64) = (16.0, 256.0);

/// Edges or pieces of them, each with the number of its edge.
pub(super) type Numbered = Vec<(usize, [Point; 2])>;

/// Returns `true` if the number of pieces could become large: two edges lie along each other within a few steps of the
/// grid. Rounding does not bend edges that are equal or parallel to one axis.
pub(super) fn may_grow(edges: &[(usize, [Point; 2])]) -> bool {
    if edges.iter().all(|(_, ends)| is_level(*ends)) {
        return false;
    }
    let places = edges.iter().enumerate();
    let mut order: Vec<(f64, usize)> = places.map(|(k, (_, x))| (direction(*x), k)).collect();
    // A direction and its opposite are equal here.
    for k in 0..order.len() {
        if order[k].0 <= SLIGHT {
            order.push((order[k].0 + 2.0, order[k].1));
        }
    }
    // Their bits are in the order of numbers that are not negative.
    order.sort_unstable_by_key(|(direction, _)| direction.to_bits());
    let alike = |group: &[(f64, usize)]| group.iter().map(|&(_, k)| edges[k].1).collect();
    order
        .chunk_by(|a, b| b.0 - a.0 <= SLIGHT)
        .any(|group| group.len() > 1 && are_along(alike(group)))
}

/// Returns `true` if any two of some edges that are nearly parallel lie along each other.
fn are_along(mut alike: Vec<[Point; 2]>) -> bool {
    if alike.iter().all(|&ends| is_level(ends)) {
        return false;
    }
    let left = |[a, b]: [Point; 2]| a.x.min(b.x);
    alike.sort_unstable_by_key(|&ends| left(ends));
    alike.iter().enumerate().any(|(i, &line)| {
        // More than what counts as close, roundings included.
        let right = line[0].x.max(line[1].x) + (1 << 12);
        let near = alike[i + 1..].iter().take_while(|x| left(**x) <= right);
        near.into_iter().any(|&other| is_along(line, other))
    })
}

/// Returns `true` for an edge parallel to an axis.
fn is_level([a, b]: [Point; 2]) -> bool {
    a.x == b.x || a.y == b.y
}

/// Returns the direction of an edge without its sign, from 0 to 2 in half a turn and growing with the angle.
fn direction([a, b]: [Point; 2]) -> f64 {
    let (x, y) = ((b.x - a.x) as f64, (b.y - a.y) as f64);
    let (x, y) = if y < 0.0 { (-x, -y) } else { (x, y) };
    let part = y / (x.abs() + y);
    match x < 0.0 {
        true if part > 0.0 => 2.0 - part,
        _ => part,
    }
}

/// Returns `true` if two edges that are nearly parallel lie along each other.
fn is_along(p: [Point; 2], q: [Point; 2]) -> bool {
    if p == q || p == [q[1], q[0]] || is_level(p) && is_level(q) {
        return false;
    }
    let is_close = |line: [Point; 2], other: [Point; 2]| {
        let seen = |at: Point| ((at.x - line[0].x) as f64, (at.y - line[0].y) as f64);
        let ((x, y), ends) = (seen(line[1]), other.map(seen));
        let length = (x * x + y * y).sqrt();
        let far = ends.map(|(u, v)| u.abs() + v.abs());
        // Products round by less than 2⁻⁵¹ of their size.
        let error = far[0].max(far[1]) / (1_u64 << 50) as f64;
        let sides = ends.map(|(u, v)| (x * v - y * u) / length);
        let shares = ends.map(|(u, v)| (x * u + y * v) / length);
        let near = CLOSE.0 + error;
        let beside = sides[0].min(sides[1]) <= near && sides[0].max(sides[1]) >= -near;
        let shared = shares[0].max(shares[1]).min(length) - shares[0].min(shares[1]).max(0.0);
        beside && shared > CLOSE.1 + error
    };
    is_close(p, q) && is_close(q, p)
}

/// A piece of an edge of an input.
#[derive(Clone, Copy)]
struct EdgePiece {
    /// Its ends, the smaller one by x, then y, first.
    ends: [Point; 2],
    /// The number of its edge, and whether the edge runs from the first end to the second.
    edge: u32,
    forward: bool,
    /// True if the last round cut it off another one.
    is_new: bool,
}

impl EdgePiece {
    fn new([from, to]: [Point; 2], edge: u32, forward: bool, is_new: bool) -> Self {
        let (ends, forward) = match from < to {
            true => ([from, to], forward),
            false => ([to, from], !forward),
        };
        EdgePiece {
            ends,
            edge,
            forward,
            is_new,
        }
    }
}

/// All pieces between two ends.
#[derive(Clone, Copy)]
struct Line {
    ends: [Point; 2],
    /// The lower and upper end of its range of y.
    low: i64,
    high: i64,
    /// The number after that of its last piece; its first one is where the line before ends.
    last: usize,
    is_new: bool,
}

/// A point at which a line is to be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct CutPoint {
    line: u32,
    at: Point,
}

/// Cuts edges into pieces that meet at their ends only. Returns `None` if there would be too many. `of_second` tells by
/// an edge's number if it belongs to the second input.
pub(super) fn cut(
    edges: &[(usize, [Point; 2])],
    of_second: impl Fn(usize) -> bool,
) -> Option<Numbered> {
    let whole = |&(k, ends): &(usize, [Point; 2])| EdgePiece::new(ends, k as u32, true, true);
    let mut pieces: Vec<EdgePiece> = edges.iter().map(whole).collect();
    let (mut lines, mut cuts) = (Vec::new(), Vec::new());
    let mut most = usize::MAX;
    for round in 0..ROUNDS {
        merge(&mut pieces, &mut lines, &of_second);
        cuts.clear();
        let is_rounded = crossings(&lines, 1 << round, &mut cuts);
        apply(&mut pieces, &lines, &mut cuts);
        if !is_rounded {
            let ends = |piece: &EdgePiece| match piece.forward {
                true => piece.ends,
                false => [piece.ends[1], piece.ends[0]],
            };
            return Some(pieces.iter().map(|x| (x.edge as usize, ends(x))).collect());
        }
        if pieces.len() > most {
            return None;
        }
        if round == 0 {
            most = pieces.len() * GROWTH.0 + GROWTH.1;
        }
    }
    None
}

/// Collects pieces into lines. Pieces of both inputs that run equally often in both directions bound nothing and are
/// left out.
fn merge(pieces: &mut Vec<EdgePiece>, lines: &mut Vec<Line>, of_second: &impl Fn(usize) -> bool) {
    pieces.sort_unstable_by_key(|piece| piece.ends);
    lines.clear();
    let (mut from, mut kept) = (0, 0);
    while from < pieces.len() {
        let first = pieces[from];
        let (mut to, mut winding, mut is_new) = (from, [0_i32; 2], true);
        while let Some(piece) = pieces.get(to).filter(|piece| piece.ends == first.ends) {
            let owner = usize::from(of_second(piece.edge as usize));
            winding[owner] += if piece.forward { 1 } else { -1 };
            is_new &= piece.is_new;
            to += 1;
        }
        if winding != [0; 2] {
            pieces.copy_within(from..to, kept);
            kept += to - from;
            let [a, b] = first.ends;
            lines.push(Line {
                ends: first.ends,
                low: a.y.min(b.y),
                high: a.y.max(b.y),
                last: kept,
                is_new,
            });
        }
        from = to;
    }
    pieces.truncate(kept);
}

/// Adds the crossings of lines, which are in ascending order; `true` if any of these points was rounded. No two lines
/// that the last round left alone cross.
fn crossings(lines: &[Line], radius: u128, cuts: &mut Vec<CutPoint>) -> bool {
    let mut is_rounded = false;
    let bands = Bands::new(lines);
    let mut open: Vec<Vec<u32>> = vec![Vec::new(); bands.count];
    for (i, line) in lines.iter().enumerate() {
        let (first, last) = (bands.of(line.low), bands.of(line.high));
        for (band, open) in open.iter_mut().enumerate().take(last + 1).skip(first) {
            open.retain(|&k| {
                let other = &lines[k as usize];
                if other.ends[1].x < line.ends[0].x {
                    return false;
                }
                let is_near = other.low <= line.high && line.low <= other.high;
                // Each pair once: in the first band that both are in.
                if (line.is_new || other.is_new)
                    && is_near
                    && (bands.count == 1 || band == first.max(bands.of(other.low)))
                {
                    is_rounded |= cross([other, line].map(|x| x.ends), [k, i as u32], radius, cuts);
                }
                true
            });
            open.push(i as u32);
        }
    }
    is_rounded
}

/// The range of y in bands, about as high as lines are.
struct Bands {
    count: usize,
    low: i64,
    per_step: f64,
}

impl Bands {
    fn new(lines: &[Line]) -> Self {
        let low = lines.iter().map(|line| line.low).min().unwrap_or(0);
        let high = lines.iter().map(|line| line.high).max().unwrap_or(0);
        let height = lines
            .iter()
            .map(|line| (line.high - line.low) as f64)
            .sum::<f64>();
        let height = height.max(1.0) / lines.len().max(1) as f64;
        let count = ((high - low) as f64 / height).min(lines.len() as f64 / 16.0);
        let count = (count as usize).max(1);
        Bands {
            count,
            low,
            per_step: count as f64 / ((high - low) as f64).max(1.0),
        }
    }
    fn of(&self, y: i64) -> usize {
        (((y - self.low) as f64 * self.per_step) as usize).min(self.count - 1)
    }
}

/// Returns the side of a directed line on which a point lies: 1 on the left, -1 on the right, 0 on the line.
/// Differences have up to 62 bits.
fn side(from: Point, to: Point, at: Point) -> i128 {
    let [ux, uy, vx, vy] =
        [to.x - from.x, to.y - from.y, at.x - from.x, at.y - from.y].map(i128::from);
    (ux * vy - uy * vx).signum()
}

/// Adds the points at which two lines are to be cut, the first in order first; `true` if that is not their exact
/// crossing.
///
/// An end whose squared distance from the crossing is at most `radius` takes its place.
fn cross(
    [p, q]: [[Point; 2]; 2],
    numbers: [u32; 2],
    radius: u128,
    cuts: &mut Vec<CutPoint>,
) -> bool {
    let mut add = |k: usize, at| {
        cuts.push(CutPoint {
            line: numbers[k],
            at,
        });
    };
    let of_q = q.map(|end| side(p[0], p[1], end));
    if of_q[0] == of_q[1] {
        if of_q[0] == 0 {
            let inside = |line: [Point; 2], at| line[0] < at && at < line[1];
            p.into_iter()
                .filter(|&at| inside(q, at))
                .for_each(|at| add(1, at));
            q.into_iter()
                .filter(|&at| inside(p, at))
                .for_each(|at| add(0, at));
        }
        return false;
    }
    let of_p = p.map(|end| side(q[0], q[1], end));
    if of_p[0] == of_p[1] {
        return false;
    }
    let on = |sides: [i128; 2]| sides.iter().position(|&side| side == 0);
    match (on(of_p), on(of_q)) {
        (Some(_), Some(_)) => return false,
        (None, Some(end)) => {
            add(0, q[end]);
            return false;
        }
        (Some(end), None) => {
            add(1, p[end]);
            return false;
        }
        (None, None) => {}
    }
    let at = meeting(p, q);
    if side(p[0], at, p[1]) == 0 && side(q[0], at, q[1]) == 0 {
        add(0, at);
        add(1, at);
        return false;
    }
    let [near_p, near_q] = [p, q].map(|line| {
        let [first, second] = line.map(|end| square_distance(end, at));
        if first < second {
            (first, line[0])
        } else {
            (second, line[1])
        }
    });
    if near_p.0 > radius && near_q.0 > radius {
        add(0, at);
        add(1, at);
    } else if near_p.0 <= near_q.0 {
        add(1, near_p.1);
    } else {
        add(0, near_q.1);
    }
    true
}

fn square_distance(a: Point, b: Point) -> u128 {
    let [x, y] = [a.x.abs_diff(b.x), a.y.abs_diff(b.y)].map(u128::from);
    x * x + y * y
}

/// Returns the crossing of two lines that are not parallel, rounded: to the nearest step, and towards the start of the
/// first where that one is parallel to an axis.
fn meeting(p: [Point; 2], q: [Point; 2]) -> Point {
    let start = p[0];
    let seen = |at: Point| [at.x - start.x, at.y - start.y].map(i128::from);
    let [[px, py], [ax, ay], [bx, by]] = [seen(p[1]), seen(q[0]), seen(q[1])];
    let (dx, dy) = (ax - bx, ay - by);
    // Products of differences of 62 bits, and products of three of these, divided.
    let cross = ax * by - ay * bx;
    let [x, y] = if px == 0 {
        [0, cross / dx]
    } else if py == 0 {
        [-cross / dy, 0]
    } else {
        let whole = py * dx - px * dy;
        let sign = whole.signum() * cross.signum();
        [px, py].map(|along| {
            type Wide = <<i64 as IntNumber>::WideUInt as UIntNumber>::Product;
            let product = Wide::multiply(along.unsigned_abs(), cross.unsigned_abs());
            // No longer than the line.
            along.signum() * sign * product.divide_with_rounding(whole.unsigned_abs()) as i128
        })
    };
    Point::new(start.x + x as i64, start.y + y as i64)
}

/// Cuts the pieces of lines.
fn apply(pieces: &mut Vec<EdgePiece>, lines: &[Line], cuts: &mut Vec<CutPoint>) {
    cuts.sort_unstable();
    cuts.dedup();
    pieces.iter_mut().for_each(|piece| piece.is_new = false);
    for group in cuts.chunk_by_mut(|a, b| a.line == b.line) {
        let line = group[0].line as usize;
        let ends = lines[line].ends;
        order(group, ends);
        let first = if line > 0 { lines[line - 1].last } else { 0 };
        for k in first..lines[line].last {
            let EdgePiece { edge, forward, .. } = pieces[k];
            pieces[k] = EdgePiece::new([ends[0], group[0].at], edge, forward, true);
            let to = group[1..].iter().map(|cut| cut.at).chain([ends[1]]);
            for (cut, to) in group.iter().zip(to) {
                pieces.push(EdgePiece::new([cut.at, to], edge, forward, true));
            }
        }
    }
}

/// Sorts the points at which a line is cut, given in ascending order, into their order along it: those with equal x are
/// reversed if the line runs downwards.
fn order(cuts: &mut [CutPoint], [start, end]: [Point; 2]) {
    let mut from = 0;
    while from < cuts.len() {
        let same = cuts[from..]
            .iter()
            .take_while(|cut| cut.at.x == cuts[from].at.x);
        let to = from + same.count();
        let before = if from > 0 {
            cuts[from - 1].at.y
        } else {
            start.y
        };
        let after = cuts.get(to).map_or(end.y, |cut| cut.at.y);
        if before > after {
            cuts[from..to].reverse();
        }
        from = to;
    }
}
