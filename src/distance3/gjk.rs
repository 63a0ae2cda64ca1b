//! The nearest points of two convex solids by their supports (Gilbert, Johnson, Keerthi 1988), with a bound from below.
use crate::Vec3;
use crate::arrays::Each;

/// A point of b less one of a.
pub(super) trait Difference: Copy {
    /// Returns the vector from the point of a to that of b.
    fn way(&self) -> Vec3<f64>;
}

impl Difference for Vec3<f64> {
    #[inline(always)]
    fn way(&self) -> Vec3<f64> {
        *self
    }
}

/// A corner of b less one of a, and the numbers of both.
#[derive(Clone, Copy, Debug)]
pub(super) struct CornerDifference {
    /// The vector from the corner of a to that of b.
    pub way: Vec3<f64>,
    /// The number of the corner of a.
    pub a: usize,
    /// The number of the corner of b.
    pub b: usize,
}

impl Difference for CornerDifference {
    #[inline(always)]
    fn way(&self) -> Vec3<f64> {
        self.way
    }
}

/// A point of b less one of a, and both.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointDifference {
    /// The vector from the point of a to that of b.
    pub way: Vec3<f64>,
    /// The point of a.
    pub a: Vec3<f64>,
    /// The point of b.
    pub b: Vec3<f64>,
}

impl Difference for PointDifference {
    #[inline(always)]
    fn way(&self) -> Vec3<f64> {
        self.way
    }
}

/// A point of b less one of a, that of a, and the codes of both.
#[derive(Clone, Copy, Debug)]
pub(super) struct CodedDifference {
    /// The vector from the point of a to that of b.
    pub way: Vec3<f64>,
    /// The point of a.
    pub a: Vec3<f64>,
    /// Numbers that say on which corners, ends or rims the points are.
    pub codes: [u32; 2],
}

impl Difference for CodedDifference {
    #[inline(always)]
    fn way(&self) -> Vec3<f64> {
        self.way
    }
}

/// The result of the iteration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap<D> {
    /// The vector from the nearest point of a to that of b.
    pub way: Vec3<f64>,
    /// A distance that the solids have at least: the width of a slab between them. Negative without one.
    pub least: f64,
    /// `true` if the solids seem to have a point in common.
    pub inside: bool,
    /// The difference that is the lowest along the vector, if nothing is inside.
    pub low: D,
    /// Differences whose weighted mean the vector is; the first `count` matter.
    simplex: [D; 4],
    weights: [f64; 4],
    count: usize,
}

/// The faces of a tetrahedron, each with the corner behind it.
pub(super) const FACES: [[usize; 4]; 4] = [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 3, 2, 0]];
/// The relative gap of both bounds of the square at which it ends.
const PROGRESS: f64 = 1e-15;
/// The square of a length that is none, relative to the square of the size.
const NONE: f64 = 1e-30;
/// The square of a bound that proves the solids to be apart, relative to the square of the size.
const PROVED: f64 = 1e-28;
/// The number of steps after which it ends, right or not; hulls need about five.
const STEPS: usize = 200;

impl<D: Difference> Gap<D> {
    /// Returns the corners of the simplex that has a common point inside; `None` if it has fewer than four.
    pub fn around(&self) -> Option<[Vec3<f64>; 4]> {
        (self.inside && self.count == 3).then(|| self.simplex.map(|corner| corner.way()))
    }
    /// Returns the differences with their weights.
    pub fn weighted(&self) -> impl Iterator<Item = (&D, f64)> {
        self.simplex[..self.count].iter().zip(self.weights)
    }
}

impl Gap<PointDifference> {
    /// Returns the nearest points, of a and of b.
    pub fn points(&self) -> [Vec3<f64>; 2] {
        let (mut on_a, mut on_b) = (Vec3::zero(), Vec3::zero());
        for (corner, weight) in self.simplex[..self.count].iter().zip(self.weights) {
            on_a += corner.a * weight;
            on_b += corner.b * weight;
        }
        [on_a, on_b]
    }
}

/// Returns the weights of the point of a segment that is nearest to the origin.
fn of_segment(p: Vec3<f64>, q: Vec3<f64>) -> [f64; 2] {
    let along = q - p;
    let square = along.length_squared();
    let t = match square > 0.0 {
        true => (-p.dot(along) / square).clamp(0.0, 1.0),
        false => 0.0,
    };
    [1.0 - t, t]
}

/// Returns the weights of the point of a triangle that is nearest to the origin, and the square of its distance.
pub(super) fn of_triangle(corners: [Vec3<f64>; 3]) -> ([f64; 3], f64) {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let parts = [b.cross(c), c.cross(a), a.cross(b)].each_as(|part| part.dot(normal));
    if normal.length_squared() > 0.0 && parts.iter().all(|&part| part > 0.0) {
        let sum = parts[0] + parts[1] + parts[2];
        let [s, t, u] = parts.each_as(|part| part / sum);
        return ([s, t, u], (a * s + b * t + c * u).length_squared());
    }
    let (mut best, mut weights) = (f64::INFINITY, [1.0, 0.0, 0.0]);
    // All edges: of thin triangles one without the newest corner may be nearer, by rounding.
    for k in 0..3 {
        let (p, q) = (corners[k], corners[(k + 1) % 3]);
        let [s, t] = of_segment(p, q);
        let square = (p * s + q * t).length_squared();
        if square < best {
            best = square;
            weights = [0.0; 3];
            (weights[k], weights[(k + 1) % 3]) = (s, t);
        }
    }
    (weights, best)
}

/// Returns the weights of the point of a simplex that is nearest to the origin; `None` if the origin is inside, which
/// it is not if the solids are known to be apart.
fn nearest<D: Difference>(simplex: &[D], apart: bool) -> Option<[f64; 4]> {
    let mut weights = [0.0; 4];
    match simplex {
        [p, q] => weights[..2].copy_from_slice(&of_segment(p.way(), q.way())),
        [p, q, r] => weights[..3].copy_from_slice(&of_triangle([p.way(), q.way(), r.way()]).0),
        [p, q, r, s] => {
            let all = [p.way(), q.way(), r.way(), s.way()];
            let (mut best, mut inside) = (f64::INFINITY, true);
            // A face of solids apart that has the origin behind it counts only if rounding has put the origin behind all.
            for all_faces in [false, true] {
                for [i, j, k, behind] in FACES {
                    let normal = (all[j] - all[i]).cross(all[k] - all[i]);
                    let (origin, last) = (-normal.dot(all[i]), normal.dot(all[behind] - all[i]));
                    if !all_faces && origin * last > 0.0 {
                        continue;
                    }
                    inside = false;
                    let (parts, square) = of_triangle([all[i], all[j], all[k]]);
                    if square < best {
                        best = square;
                        weights = [0.0; 4];
                        (weights[i], weights[j], weights[k]) = (parts[0], parts[1], parts[2]);
                    }
                }
                if !inside || !apart {
                    break;
                }
            }
            if inside {
                return None;
            }
        }
        _ => weights[0] = 1.0,
    }
    Some(weights)
}

/// Returns the weights of the point of a triangle that is nearest to the origin, and the square of its distance, if the
/// last corner has a part in it.
#[inline(always)]
fn from_newest(p: Vec3<f64>, q: Vec3<f64>, newest: Vec3<f64>) -> ([f64; 3], f64) {
    let (p, q, way) = (p - newest, q - newest, -newest);
    let normal = p.cross(q);
    let (of_p, of_q) = (way.cross(q).dot(normal), p.cross(way).dot(normal));
    let whole = normal.length_squared();
    let [s, t] = match of_p > 0.0 && of_q > 0.0 && of_p + of_q < whole {
        true => {
            let over = 1.0 / whole;
            [of_p * over, of_q * over]
        }
        false => {
            let share = |along: Vec3<f64>| {
                let square = along.length_squared();
                let share = way.dot(along) / if square > 0.0 { square } else { 1.0 };
                share.clamp(0.0, 1.0)
            };
            let (s, t) = (share(p), share(q));
            match (p * s - way).length_squared() < (q * t - way).length_squared() {
                true => [s, 0.0],
                false => [0.0, t],
            }
        }
    };
    let square = (p * s + q * t - way).length_squared();
    ([s, t, 1.0 - s - t], square)
}

/// Returns what [`nearest`] does, if the last corner has a part in the nearest point and no rounding matters; `None` also
/// where the origin may be inside.
#[inline(always)]
fn nearest_with_newest<D: Difference>(simplex: &[D]) -> Option<[f64; 4]> {
    match simplex {
        [p, q] => {
            let [s, t] = of_segment(p.way(), q.way());
            Some([s, t, 0.0, 0.0])
        }
        [p, q, r] => {
            let ([s, t, u], _) = from_newest(p.way(), q.way(), r.way());
            Some([s, t, u, 0.0])
        }
        [p, q, r, newest] => {
            let newest = newest.way();
            let all = [p.way(), q.way(), r.way()];
            let [p, q, r] = all.each_as(|corner| corner - newest);
            let normals = [p.cross(q), q.cross(r), r.cross(p)];
            let side = normals[0].dot(r);
            let (mut best, mut weights) = (f64::INFINITY, None);
            for (k, normal) in normals.into_iter().enumerate() {
                if normal.dot(newest) * side > 0.0 {
                    let next = if k == 2 { 0 } else { k + 1 };
                    let ([s, t, u], square) = from_newest(all[k], all[next], newest);
                    if square < best {
                        best = square;
                        let mut parts = [0.0, 0.0, 0.0, u];
                        (parts[k], parts[next]) = (s, t);
                        weights = Some(parts);
                    }
                }
            }
            weights
        }
        _ => None,
    }
}

/// Returns the mean of the corners of a simplex.
#[inline(always)]
fn mean<D: Difference>(simplex: &[D; 4], parts: &[f64; 4]) -> Vec3<f64> {
    let mut sum = Vec3::zero();
    for (corner, &part) in simplex.iter().zip(parts) {
        if part > 0.0 {
            sum += corner.way() * part;
        }
    }
    sum
}

/// Returns the nearest points of two solids, given the difference that is the lowest along a vector, a first one, and a
/// distance that they are known to have at least; that may be negative.
pub(super) fn gap<D: Difference>(lowest: impl Fn(Vec3<f64>) -> D, first: D, least: f64) -> Gap<D> {
    gap_until(lowest, first, least, |_, _| false)
}

/// Returns what [`gap`] does, or ends where a function of the state and of the relative gap of both bounds of the square
/// says so.
#[inline(always)]
pub(super) fn gap_until<D: Difference>(
    lowest: impl Fn(Vec3<f64>) -> D,
    first: D,
    least: f64,
    mut ends: impl FnMut(&Gap<D>, f64) -> bool,
) -> Gap<D> {
    let way = first.way();
    let mut found = Gap {
        way,
        least,
        inside: false,
        low: first,
        simplex: [first; 4],
        weights: [1.0, 0.0, 0.0, 0.0],
        count: 1,
    };
    let mut size = way.length_squared();
    for step in 0.. {
        let square = found.way.length_squared();
        if square <= NONE * size {
            found.inside = true;
            break;
        }
        found.low = lowest(found.way);
        let at = found.low.way();
        size = size.max(at.length_squared());
        let height = found.way.dot(at);
        found.least = found.least.max(height / square.sqrt());
        if ends(&found, (square - height) / square) {
            break;
        }
        let simplex = &found.simplex[..found.count];
        let known = simplex.iter().any(|corner| corner.way() == at);
        if square - height <= PROGRESS * square || known || step == STEPS {
            break;
        }
        found.simplex[found.count] = found.low;
        let quick = nearest_with_newest(&found.simplex[..=found.count]);
        let quick = quick.map(|parts| (mean(&found.simplex, &parts), parts));
        let (next, parts) = match quick {
            Some((next, parts)) if next.length_squared() < square => (next, parts),
            _ => {
                let apart = found.least > 0.0 && found.least * found.least > PROVED * size;
                let Some(parts) = nearest(&found.simplex[..=found.count], apart) else {
                    found.inside = true;
                    break;
                };
                let next = mean(&found.simplex, &parts);
                // No progress in the digits that there are.
                if next.length_squared() >= square {
                    break;
                }
                (next, parts)
            }
        };
        // Corners beyond the last one have no part.
        found.count = 0;
        for (k, part) in parts.into_iter().enumerate() {
            if part > 0.0 {
                found.simplex[found.count] = found.simplex[k];
                found.weights[found.count] = part;
                found.count += 1;
            }
        }
        found.way = next;
    }
    found
}
