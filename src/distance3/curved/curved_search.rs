//! The search for the pieces of two solids that touch along the normal from one to the other.
//!
//! Supports find a direction: by nearest points where the solids are apart, by an expansion where they overlap. Solids
//! that overlap are then parted along it, and their nearest points give a direction that is better, until it stays.
//! Newton's step makes of it the pieces, the places and the normal to all digits. Whatever is found comes with a proof:
//! the gap of the supports along the normal bounds the signed distance from below, two points of the solids bound the
//! distance from above, and the difference is stated. Of solids that overlap it proves a direction to be one of the best
//! near it; the expansion bounds how much better another could be.
use super::super::gjk::{Gap, PointDifference, gap};
use super::bend::FEW;
use super::expand::exits;
use super::level::shared;
use super::piece::{Piece, PieceKind, Place};
use super::solid_pair::{Found, Solids};
use super::support::{Supported, start};
use super::touch::{Constants, System, Touch, tangents};
use super::touching::{Candidate, candidates};
use crate::{Scalar, Vec3};

/// The error up to which a touch is exact, relative to the size.
const EXACT: f64 = 1e-13;
/// The error up to which a touch is good enough.
const GOOD: f64 = 1e-12;
/// The step and the residual that are none.
const SETTLED: f64 = 1e-9;
/// The number of Newton's steps.
const STEPS: usize = 12;
/// The most pairs of pieces that are tried.
const PAIRS: usize = 24;
/// The least cosine between axes around which directions are tried.
const PARALLEL: f64 = 0.8;
/// The number of directions around an axis that are tried.
const AROUND: usize = 12;
/// The most by which one of these is worse than the touch that is known and still refined, relative to the size.
const NEARLY: f64 = 1e-3;
/// The number of parabolas through values of three directions that refine one.
const TOPS: usize = 3;
/// How often solids that overlap are parted.
const PARTINGS: usize = 4;

/// Returns the longest straight piece of a solid, or its rim, along an axis of length one.
fn axis(solid: &dyn Supported) -> Option<Piece<f64>> {
    let mut longest: Option<(f64, Piece<f64>)> = None;
    for k in 0..solid.pieces() {
        let mut piece = solid.piece(k, Vec3::new(0.0, 0.0, 1.0));
        let length = match piece.kind {
            PieceKind::Line | PieceKind::Side => piece.along.length(),
            PieceKind::Rim | PieceKind::Ball => f64::MIN_POSITIVE,
            _ => continue,
        };
        if longest.as_ref().is_some_and(|longest| length <= longest.0) || length == 0.0 {
            continue;
        }
        match piece.kind {
            PieceKind::Rim => piece.along = piece.ways[0].cross(piece.ways[1]),
            PieceKind::Ball => {
                // Across the two half extents that are the most alike.
                let [x, y, z] = piece.sizes;
                let apart = [(y - z).abs(), (z - x).abs(), (x - y).abs()];
                let alike = (0..3).min_by(|&i, &j| apart[i].total_cmp(&apart[j]));
                piece.along = piece.ways[alike.unwrap_or(0)];
            }
            _ => {
                piece.along = piece.along * (1.0 / length);
                piece.taper /= length;
            }
        }
        longest = Some((length, piece));
    }
    longest.map(|longest| longest.1)
}

impl Solids<'_> {
    /// Returns the nearest points of a and b, moved, by a first vector that is not zero.
    fn nearest(&self, first: Vec3<f64>, by: Vec3<f64>) -> Gap<PointDifference> {
        let start = self.lowest(first, by);
        let least = first.dot(start.way) / first.length();
        gap(|way| self.lowest(way, by), start, least)
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
    /// Returns 0 for a touch that is exact, settled and regular, 1 if only equations depend on each other, more for
    /// others, 4 for one that is not exact.
    fn grade(&self, found: &Found) -> usize {
        match found.error <= EXACT * self.size {
            true => usize::from(!found.regular) + 2 * usize::from(!found.settled),
            false => 4,
        }
    }
    /// Returns `true` if a touch is worse than another one along about the same normal.
    fn is_worse(&self, found: &Found, other: &Found) -> bool {
        let (p, q) = (self.grade(found), self.grade(other));
        q < p || p == 4 && q == 4 && other.error < found.error
    }
    /// Returns the touch of two pieces with the least error that steps from a first one lead to, if its value is not
    /// below a bound.
    fn attempt(&self, pieces: [usize; 2], first: Touch<f64>, floor: f64) -> Option<Found> {
        let (mut touch, mut kept): (_, Option<(Found, f64)>) = (first, None);
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
            let residuals = system.frame.residuals([&a, &b], &touch);
            let changes = system.solve(&residuals);
            let change = changes.iter().map(|x| x * x).sum::<f64>().sqrt();
            let exact = error <= EXACT * self.size;
            let better = |(kept, last): &(Found, f64)| match exact {
                true => change < *last || kept.error > EXACT * self.size,
                false => error < kept.error,
            };
            if value >= floor && kept.as_ref().is_none_or(better) {
                let rest = residuals.iter().fold(change, |most, x| most.max(x.abs()));
                let off = off(&touch.a, &on.a) + off(&touch.b, &on.b);
                let found = Found {
                    pieces,
                    touch: on,
                    value,
                    error,
                    regular: system.rank == system.count,
                    settled: off.max(rest) <= SETTLED,
                };
                kept = Some((found, change));
            } else if step > 3 {
                break;
            }
            if !(1e-16..f64::INFINITY).contains(&change) {
                break;
            }
            let limit = (0.7 / change).min(1.0);
            touch = system
                .frame
                .moved([a.kind, b.kind], &touch, &changes.map(|x| x * limit));
        }
        kept.map(|kept| kept.0)
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
            if self.grade(&found) < 2 {
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
        if found || self.side < 0.0 || best.as_ref().is_some_and(|best| self.grade(best) < 4) {
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
            settled: false,
        })
    }
    /// Returns a touch whose points are off each other with one of them moved to where the other one is, if that is better: where
    /// a curved shape touches an edge or a needle along it, the place there has no equation of its own.
    fn matched(&self, found: Found) -> Found {
        let normal = found.touch.normal;
        let ([a, b], out) = (self.pieces(found.pieces, normal), normal * self.side);
        let [i, j] = found.pieces;
        let way = normal * found.value;
        let [on_a, on_b] = [b.at(&found.touch.b) - way, a.at(&found.touch.a) + way];
        let mut best = found;
        for (is_a, at) in [(true, on_a), (false, on_b)] {
            let mut touch = found.touch;
            let moved = match is_a {
                true => &mut touch.a,
                false => &mut touch.b,
            };
            let near = match is_a {
                true => self.a.clamped(i, &start(&a, at, out, false)),
                false => self.b.clamped(j, &start(&b, at, -out, false)),
            };
            *moved = Place {
                pull: moved.pull,
                ..near
            };
            let error = ((b.at(&touch.b) - a.at(&touch.a)) - way).length();
            if error < best.error {
                best = Found {
                    touch,
                    error,
                    ..found
                };
            }
        }
        best
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
    /// Returns a direction beside a touch along which solids that overlap part after a shorter way, if there is one: a
    /// touch may be stationary without being the best near it.
    pub(super) fn better(&self, found: &Found) -> Option<Vec3<f64>> {
        let [x, y] = tangents(found.touch.normal);
        // A rim as far from the line of the middles as the other one's reach has better ways along that line alone.
        let between = self.b.middle() - self.a.middle();
        let aside = x * x.dot(between) + y * y.dot(between);
        let length = aside.length();
        let aside = aside * if length > 0.0 { 1.0 / length } else { 0.0 };
        let ways = [x, -x, y, -y, x + y, x - y, y - x, -x - y, aside, -aside];
        [3e-2, 3e-3, 3e-4].into_iter().find_map(|step| {
            let turned = ways.map(|way| {
                let normal = found.touch.normal + way * step;
                normal * (1.0 / normal.length())
            });
            let valued = turned.map(|normal| (self.value(normal), normal));
            let best = valued.into_iter().max_by(|p, q| p.0.total_cmp(&q.0))?;
            (best.0 > found.value + 10.0 * EXACT * self.size).then_some(best.1)
        })
    }
    /// Returns a direction around the axis of either solid along which they part after a shorter way than at a touch, if
    /// there is one. About axes that are nearly parallel all ways are as good but for the square of the angle, which the
    /// expansion does not see.
    pub(super) fn around(&self, found: &Found) -> Option<Vec3<f64>> {
        let mut best = (found.value + EXACT * self.size, None);
        let (p, q) = (axis(self.a)?, axis(self.b)?);
        if p.along.dot(q.along).abs() < PARALLEL {
            return None;
        }
        for (piece, side) in [(p, 1.0), (q, -1.0)] {
            let share = piece.along.dot(found.touch.normal);
            let across = (found.touch.normal - piece.along * share).normalize_or_zero();
            let beside = piece.along.cross(across);
            // As steep as the touch, and orthogonal to the side.
            for (share, out) in [
                (share, (1.0 - share * share).sqrt()),
                (-side * piece.taper, 1.0),
            ] {
                let turned = |angle: f64| {
                    let (sin, cos) = Scalar::sin_cos(angle);
                    let normal = piece.along * share + (across * cos + beside * sin) * out;
                    let normal = normal * (1.0 / normal.length());
                    (self.value(normal), normal)
                };
                let first = std::f64::consts::TAU / AROUND as f64;
                let values: [f64; AROUND] = std::array::from_fn(|k| turned(first * k as f64).0);
                for k in 0..AROUND {
                    let mut three = [AROUND - 1, 0, 1].map(|by| values[(k + by) % AROUND]);
                    if three[1] < three[0].max(three[2]).max(best.0 - NEARLY * self.size) {
                        continue;
                    }
                    let (mut angle, mut step) = (first * k as f64, first);
                    for _ in 0..TOPS {
                        // The top of the parabola through three values.
                        let bend = three[0] + three[2] - three[1] - three[1];
                        if bend < 0.0 {
                            angle += step * (0.5 * (three[0] - three[2]) / bend).clamp(-1.0, 1.0);
                        }
                        step *= 0.1;
                        three = [angle - step, angle, angle + step].map(|angle| turned(angle).0);
                        if three[1] > best.0 {
                            best = (three[1], Some(turned(angle).1));
                        }
                    }
                }
            }
        }
        best.1
    }
    /// Returns the touch of solids that overlap, or nearly so, beginning with a normal.
    fn parted(&self, best: &mut Option<Found>, first: Vec3<f64>) {
        let (mut normal, mut value) = (first, self.value(first));
        let (mut on_a, mut on_b) = (self.a.support(first), self.b.support(-first));
        for round in 0..PARTINGS {
            let by = normal * (0.1 * self.size - value);
            let near = self.nearest(normal, by);
            let length = near.way.length();
            if length == 0.0 || near.inside {
                break;
            }
            let next = near.way * (1.0 / length);
            let better = self.value(next);
            if better < value - EXACT * self.size {
                break;
            }
            let points = near.points();
            (normal, on_a, on_b) = (next, points[0], points[1] - by);
            let gain = better - value;
            value = better;
            if round > 0 && gain <= 1e-9 * self.size {
                break;
            }
        }
        let known =
            |best: &Found| (best.touch.normal - normal).length() <= 1e-7 && self.grade(best) == 0;
        if !best.as_ref().is_some_and(known) {
            self.take(best, self.plain(normal, on_a, on_b));
            self.take(best, self.polish(normal, on_a, on_b));
        }
    }
}

impl<'a> Solids<'a> {
    /// Creates the pair, of which nearest points are asked for.
    fn new(a: &'a dyn Supported, b: &'a dyn Supported) -> Self {
        let way = b.middle() - a.middle();
        let size = a.size().max(b.size()).max(way.length());
        Solids {
            a,
            b,
            size: size.max(f64::MIN_POSITIVE),
            side: 1.0,
        }
    }
}

/// Returns the touch of two solids that are clearly apart or overlap clearly, and the constants of its replay, where that
/// is simple.
pub fn quick(a: &dyn Supported, b: &dyn Supported) -> Option<(Found, Constants<FEW>)> {
    Solids::new(a, b).quick()
}

/// Returns the touch that decides about the relation of two solids.
pub fn search(a: &dyn Supported, b: &dyn Supported) -> Option<Found> {
    let solids = Solids::new(a, b);
    let (size, way) = (solids.size, b.middle() - a.middle());
    let first = match way.length_squared() > 0.0 {
        true => way,
        false => Vec3::new(0.0, 0.0, 1.0),
    };
    let near = solids.nearest(first, Vec3::zero());
    let length = near.way.length();
    let mut best = None;
    if !near.inside && length > GOOD * size {
        let normal = near.way * (1.0 / length);
        let [on_a, on_b] = near.points();
        solids.take(&mut best, solids.plain(normal, on_a, on_b));
        let polished = solids.polish(normal, on_a, on_b);
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
        for exit in exits(&|way| solids.lowest_coded(way)).all {
            // A bound from below of the depth.
            let deeper = |best: &Found| best.error <= GOOD * size && exit.depth >= -best.value;
            if !best.as_ref().is_some_and(deeper) {
                solids.parted(&mut best, exit.normal);
            }
        }
    }
    for _ in 0..2 * PARTINGS {
        let overlap = best.filter(|found| found.value <= 0.0);
        let Some(better) =
            overlap.and_then(|found| solids.better(&found).or_else(|| solids.around(&found)))
        else {
            break;
        };
        let before = best;
        solids.parted(&mut best, better);
        if best.as_ref().is_none_or(|found| solids.grade(found) > 3) {
            best = before;
            break;
        }
    }
    let best = best.map(|found| match found.error <= EXACT * size {
        true => found,
        false => solids.matched(found),
    });
    best.map(|found| shared(&solids, found))
}

/// The number of steps to a direction in which two solids are the farthest.
const ASCENTS: usize = 100;

/// Returns the touch of the points of two solids that are the farthest from each other.
pub fn search_farthest(a: &dyn Supported, b: &dyn Supported) -> Option<Found> {
    let way = b.middle() - a.middle();
    let solids = Solids {
        side: -1.0,
        ..Solids::new(a, b)
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
