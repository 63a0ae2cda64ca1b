//! The search for the pieces of two solids that touch along the normal from one to the other.
//!
//! Supports find a direction: by nearest points where the solids are apart, by an expansion where they overlap. Solids
//! that overlap are then parted along it, and their nearest points give a direction that is better, until it stays.
//! Newton's step makes of it the pieces, the places and the normal to all digits. Whatever is found comes with a proof:
//! the gap of the supports along the normal bounds the signed distance from below, two points of the solids bound the
//! distance from above, and the difference is stated. Of solids that overlap it proves a direction to be one of the best
//! near it; the expansion bounds how much better another could be.
use super::expand::exits;
use super::gap::{Difference, gap};
use super::level::shared;
use super::piece::{Piece, PieceKind, Place};
use super::support::{Supported, start};
use super::touch::{System, Touch};
use crate::Vec3;

/// What decides about two solids.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// The numbers of the pieces.
    pub pieces: [usize; 2],
    /// Where and along which normal they touch.
    pub touch: Touch<f64>,
    /// The gap of the supports along the normal.
    pub value: f64,
    /// The length by which the points are not that far apart along the normal.
    pub error: f64,
    /// `true` if all equations are independent.
    pub regular: bool,
    /// `true` if a place was moved onto its piece.
    pub clamped: bool,
}

/// The error up to which a touch is exact, relative to the size.
const EXACT: f64 = 1e-13;
/// The error up to which a touch is good enough.
const GOOD: f64 = 1e-12;
/// The number of Newton's steps.
const STEPS: usize = 12;
/// The most pairs of pieces that are tried, and pieces of each solid.
const PAIRS: usize = 24;
const PIECES: usize = 10;
/// How often solids that overlap are parted.
const PARTINGS: usize = 4;

/// Two solids, and their size.
#[derive(Clone, Copy)]
pub struct Solids<'a> {
    pub a: &'a dyn Supported,
    pub b: &'a dyn Supported,
    pub size: f64,
    /// 1, or −1 for the points that are the farthest from each other, with outer normals away from the other solid.
    pub side: f64,
}

/// A piece, a place on it, and how far it is from where the piece was expected.
struct Candidate {
    off: f64,
    piece: usize,
    place: Place<f64>,
}

/// Returns the pieces of a solid that may touch near a point along an outer normal, likely ones first.
fn candidates(solid: &dyn Supported, normal: Vec3<f64>, at: Vec3<f64>) -> Vec<Candidate> {
    let size = solid.size();
    let over = if size > 0.0 { 1.0 / size } else { 0.0 };
    let highest = solid.support(normal);
    let mut all = Vec::new();
    for k in 0..solid.pieces() {
        let piece = solid.piece(k, normal);
        let ways: &[bool] = if piece.kind.is_round() {
            &[true, false]
        } else {
            &[false]
        };
        for &by_normal in ways {
            let place = solid.clamped(k, &start(&piece, at, normal, by_normal));
            let point = piece.at(&place);
            let off = (point - at).length() + normal.dot(highest - point);
            // Of pieces that are equally likely the one with the fewest parameters.
            let simple = 1e-14 * (piece.kind.ways() + usize::from(piece.kind.has_axis())) as f64;
            all.push(Candidate {
                off: off * over + simple,
                piece: k,
                place,
            });
        }
    }
    all.sort_by(|p, q| p.off.total_cmp(&q.off));
    all.truncate(PIECES);
    all
}

impl<'a> Solids<'a> {
    /// Returns the gap of the supports along a normal.
    pub fn value(&self, normal: Vec3<f64>) -> f64 {
        let out = normal * self.side;
        normal.dot(self.b.support(-out) - self.a.support(out))
    }
    /// Returns two pieces, seen along a normal from a to b.
    pub fn pieces(&self, [i, j]: [usize; 2], normal: Vec3<f64>) -> [Piece<f64>; 2] {
        let out = normal * self.side;
        let mut both = [self.a.piece(i, out), self.b.piece(j, -out)];
        for piece in both.iter_mut().filter(|piece| piece.kind == PieceKind::Own) {
            // Derivatives by the normal instead of the outer one.
            piece.ways = piece.ways.map(|way| way * self.side);
        }
        both
    }
    /// Returns the pieces of both that may touch near two points, likely ones first.
    fn near(&self, normal: Vec3<f64>, on_a: Vec3<f64>, on_b: Vec3<f64>) -> [Vec<Candidate>; 2] {
        let out = normal * self.side;
        let mut both = [
            candidates(self.a, out, on_a),
            candidates(self.b, -out, on_b),
        ];
        for candidate in both.iter_mut().flatten() {
            candidate.place.pull *= self.side;
        }
        both
    }
    /// Returns the point of b, moved, less a that is the lowest along a vector.
    fn lowest(&self, way: Vec3<f64>, by: Vec3<f64>) -> Difference {
        let (a, b) = (self.a.support(way), self.b.support(-way) + by);
        Difference { way: b - a, a, b }
    }
    /// Returns 0 for a touch that is exact and regular, more for others, 3 for one that is not exact.
    fn grade(&self, found: &Found) -> usize {
        match found.error <= EXACT * self.size {
            true => usize::from(!found.regular) + usize::from(found.clamped),
            false => 3,
        }
    }
    /// Returns `true` if a touch is worse than another one along about the same normal.
    fn is_worse(&self, found: &Found, other: &Found) -> bool {
        let (p, q) = (self.grade(found), self.grade(other));
        q < p || p == 3 && q == 3 && other.error < found.error
    }
    /// Returns the touch of two pieces with the least error that steps from a first one lead to, if its value is not
    /// below a bound.
    fn attempt(&self, pieces: [usize; 2], first: Touch<f64>, floor: f64) -> Option<Found> {
        let (mut touch, mut kept): (_, Option<Found>) = (first, None);
        for step in 0..STEPS {
            let [a, b] = self.pieces(pieces, touch.normal);
            let system = System::new([&a, &b], &touch);
            let on = Touch {
                normal: touch.normal,
                a: self.a.clamped(pieces[0], &touch.a),
                b: self.b.clamped(pieces[1], &touch.b),
            };
            let off = |p: &Place<f64>, q: &Place<f64>| {
                let shift = |k: usize| (p.y[k] - q.y[k]).abs();
                shift(0) + shift(1) + (p.s - q.s).abs()
            };
            let value = self.value(touch.normal);
            let error = ((b.at(&on.b) - a.at(&on.a)) - touch.normal * value).length();
            if value >= floor && kept.is_none_or(|kept| error < kept.error) {
                kept = Some(Found {
                    pieces,
                    touch: on,
                    value,
                    error,
                    regular: system.rank == system.count,
                    clamped: off(&touch.a, &on.a) + off(&touch.b, &on.b) > 1e-9,
                });
            } else if step > 3 {
                break;
            }
            let changes = system.solve(&system.residuals([&a, &b], &touch));
            let change = changes.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !(1e-16..f64::INFINITY).contains(&change) {
                break;
            }
            let limit = (0.7 / change).min(1.0);
            touch = system.moved([a.kind, b.kind], &touch, &changes.map(|x| x * limit));
        }
        kept
    }
    /// Tries pairs of pieces, likely ones first; returns `true` if one is exact and regular.
    fn try_pairs(
        &self,
        best: &mut Option<Found>,
        (of_a, of_b): (&[Candidate], &[Candidate]),
        normal: Vec3<f64>,
        floor: f64,
    ) -> bool {
        let mut pairs = Vec::new();
        for p in of_a {
            pairs.extend(of_b.iter().map(|q| (p, q)));
        }
        pairs.sort_by(|(p, q), (r, s)| (p.off + q.off).total_cmp(&(r.off + s.off)));
        for (p, q) in pairs.into_iter().take(PAIRS) {
            let first = Touch {
                normal,
                a: p.place,
                b: q.place,
            };
            let Some(found) = self.attempt([p.piece, q.piece], first, floor) else {
                continue;
            };
            if best.as_ref().is_none_or(|best| self.is_worse(best, &found)) {
                *best = Some(found);
            }
            if self.grade(&found) == 0 {
                return true;
            }
        }
        false
    }
    /// Returns the touch near a normal and two points, whose value is no less than that of the normal.
    fn polish(&self, normal: Vec3<f64>, on_a: Vec3<f64>, on_b: Vec3<f64>) -> Option<Found> {
        let floor = self.value(normal) - EXACT * self.size;
        let mut best = None;
        let [of_a, of_b] = self.near(normal, on_a, on_b);
        let found = self.try_pairs(&mut best, (&of_a, &of_b), normal, floor);
        if found || self.side < 0.0 || best.as_ref().is_some_and(|best| self.grade(best) < 3) {
            return best;
        }
        // Along the normal of a face that is all but orthogonal another point may be the lowest, far from these.
        for (own, other, side, foot) in [(self.a, self.b, 1.0, on_a), (self.b, self.a, -1.0, on_b)]
        {
            for k in 0..own.pieces() {
                let piece = own.piece(k, normal * side);
                let up = piece.ways[0].cross(piece.ways[1]);
                let length = up.length() * side.signum();
                if piece.kind != PieceKind::Face || length == 0.0 {
                    continue;
                }
                let up = up * (1.0 / length.abs());
                let up = if up.dot(normal) * side < 0.0 { -up } else { up };
                if up.dot(normal) * side < 0.999 {
                    continue;
                }
                let at = other.support(-up);
                let mut ours = candidates(own, up, at + up * up.dot(foot - at));
                ours.retain(|candidate| candidate.piece == k);
                let theirs = candidates(other, -up, at);
                let pair = if side > 0.0 {
                    (&*ours, &*theirs)
                } else {
                    (&*theirs, &*ours)
                };
                if self.try_pairs(&mut best, pair, up * side, floor) {
                    return best;
                }
            }
        }
        best
    }
    /// Returns the touch along a normal of points that are known, as fixed ones.
    fn plain(&self, normal: Vec3<f64>, on_a: Vec3<f64>, on_b: Vec3<f64>) -> Option<Found> {
        let [of_a, of_b] = self.near(normal, on_a, on_b);
        let (p, q) = (of_a.first()?, of_b.first()?);
        let value = self.value(normal);
        let [a, b] = self.pieces([p.piece, q.piece], normal);
        Some(Found {
            pieces: [p.piece, q.piece],
            touch: Touch {
                normal,
                a: p.place,
                b: q.place,
            },
            value,
            error: ((b.at(&q.place) - a.at(&p.place)) - normal * value).length(),
            regular: false,
            clamped: true,
        })
    }
    /// Keeps the better one of two touches along any normals.
    fn take(&self, best: &mut Option<Found>, found: Option<Found>) {
        let Some(found) = found else { return };
        let slack = EXACT * self.size;
        let better = best.as_ref().is_none_or(|best| {
            let level = (found.value - best.value).abs() <= slack;
            found.value > best.value + slack || level && self.is_worse(best, &found)
        });
        if better {
            *best = Some(found);
        }
    }
    /// Returns the touch of solids that overlap, or nearly so, beginning with a normal.
    fn parted(&self, best: &mut Option<Found>, first: Vec3<f64>) {
        let (mut normal, mut value) = (first, self.value(first));
        let (mut on_a, mut on_b) = (self.a.support(first), self.b.support(-first));
        for round in 0..PARTINGS {
            let by = normal * (0.1 * self.size - value);
            let near = gap(&|way| self.lowest(way, by), normal);
            let length = near.way.length();
            if length == 0.0 || near.inside {
                break;
            }
            let next = near.way * (1.0 / length);
            let better = self.value(next);
            if better < value - EXACT * self.size {
                break;
            }
            (normal, on_a, on_b) = (next, near.on_a, near.on_b - by);
            let gain = better - value;
            value = better;
            if round > 0 && gain <= 1e-9 * self.size {
                break;
            }
        }
        self.take(best, self.plain(normal, on_a, on_b));
        self.take(best, self.polish(normal, on_a, on_b));
    }
}

/// Returns the touch that decides about the relation of two solids.
pub fn search(a: &dyn Supported, b: &dyn Supported) -> Option<Found> {
    let way = b.middle() - a.middle();
    let size = a
        .size()
        .max(b.size())
        .max(way.length())
        .max(f64::MIN_POSITIVE);
    let solids = Solids {
        a,
        b,
        size,
        side: 1.0,
    };
    let first = match way.length_squared() > 0.0 {
        true => way,
        false => Vec3::new(0.0, 0.0, 1.0),
    };
    let near = gap(&|way| solids.lowest(way, Vec3::zero()), first);
    let length = near.way.length();
    let mut best = None;
    if !near.inside && length > GOOD * size {
        let normal = near.way * (1.0 / length);
        self::Solids::take(
            &solids,
            &mut best,
            solids.plain(normal, near.on_a, near.on_b),
        );
        let polished = solids.polish(normal, near.on_a, near.on_b);
        let exact = polished
            .as_ref()
            .is_some_and(|found| found.error <= EXACT * size);
        match exact {
            true => best = polished,
            false => solids.take(&mut best, polished),
        }
    }
    let apart = |found: &Found| found.error <= GOOD * size && found.value > 0.0;
    if !best.as_ref().is_some_and(apart) {
        for exit in exits(&|way| solids.lowest(way, Vec3::zero())) {
            solids.parted(&mut best, exit.normal);
        }
    }
    best.map(|found| shared(&solids, found))
}

/// Returns the pieces of a touch, seen along its normal.
pub fn pieces([a, b]: [&dyn Supported; 2], found: &Found, side: f64) -> [Piece<f64>; 2] {
    let solids = Solids {
        a,
        b,
        size: 1.0,
        side,
    };
    solids.pieces(found.pieces, found.touch.normal)
}

/// The number of steps to a direction in which two solids are the farthest.
const ASCENTS: usize = 100;

/// Returns the touch of the points of two solids that are the farthest from each other.
pub fn search_farthest(a: &dyn Supported, b: &dyn Supported) -> Option<Found> {
    let way = b.middle() - a.middle();
    let size = a
        .size()
        .max(b.size())
        .max(way.length())
        .max(f64::MIN_POSITIVE);
    let solids = Solids {
        a,
        b,
        size,
        side: -1.0,
    };
    let mut starts = vec![way];
    for code in 0..27 {
        let side = |k: usize| f64::from(code / 3_i32.pow(k as u32) % 3 - 1);
        starts.push(Vec3::new(side(0), side(1), side(2)));
    }
    let mut best: Option<(f64, Vec3<f64>)> = None;
    for mut way in starts {
        let (mut length, mut normal) = (way.length(), way);
        if length == 0.0 {
            continue;
        }
        for _ in 0..ASCENTS {
            normal = way * (1.0 / length);
            way = b.support(normal) - a.support(-normal);
            length = way.length();
            if length == 0.0 || normal.dot(way) >= length * (1.0 - f64::EPSILON) {
                break;
            }
        }
        let value = solids.value(normal);
        if best.is_none_or(|best| value > best.0) {
            best = Some((value, normal));
        }
    }
    let (_, normal) = best?;
    let (on_a, on_b) = (a.support(-normal), b.support(normal));
    let mut found = None;
    solids.take(&mut found, solids.plain(normal, on_a, on_b));
    solids.take(&mut found, solids.polish(normal, on_a, on_b));
    found
}
