//! The nearest points of two convex solids by their supports (Gilbert, Johnson, Keerthi 1988), with a bound from below.
use crate::Vec3;

/// A point of b less one of a, and both.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// The vector from the point of a to that of b.
    pub way: Vec3<f64>,
    /// The point of a.
    pub a: Vec3<f64>,
    /// The point of b.
    pub b: Vec3<f64>,
}

/// The result of the iteration.
#[derive(Clone, Copy, Debug)]
pub struct Gap {
    /// The vector from the nearest point of a to that of b.
    pub way: Vec3<f64>,
    /// The point of a.
    pub on_a: Vec3<f64>,
    /// The point of b.
    pub on_b: Vec3<f64>,
    /// `true` if the solids seem to have a point in common.
    pub inside: bool,
}

/// The relative gap of both bounds of the square at which it ends.
const PROGRESS: f64 = 1e-14;
/// The square of a length that is none, relative to the square of the size.
const NONE: f64 = 1e-30;
/// The square of a bound that proves the solids to be apart, relative to the square of the size.
const PROVED: f64 = 1e-28;
/// The number of steps after which it ends, right or not.
const STEPS: usize = 200;

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

/// Returns the weights of the point of a triangle that is nearest to the origin.
fn of_triangle(corners: [Vec3<f64>; 3]) -> [f64; 3] {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let parts = [b.cross(c), c.cross(a), a.cross(b)].map(|part| part.dot(normal));
    if normal.length_squared() > 0.0 && parts.iter().all(|&part| part > 0.0) {
        let sum = parts[0] + parts[1] + parts[2];
        return parts.map(|part| part / sum);
    }
    let (mut best, mut weights) = (f64::INFINITY, [1.0, 0.0, 0.0]);
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
    weights
}

/// Returns the weights of the point of a simplex that is nearest to the origin; `None` if the origin is inside, which
/// it is not if the solids are known to be apart.
fn nearest(simplex: &[Difference], apart: bool) -> Option<[f64; 4]> {
    let mut weights = [0.0; 4];
    match *simplex {
        [p, q] => weights[..2].copy_from_slice(&of_segment(p.way, q.way)),
        [p, q, r] => weights[..3].copy_from_slice(&of_triangle([p.way, q.way, r.way])),
        [p, q, r, s] => {
            let all = [p.way, q.way, r.way, s.way];
            let (mut best, mut inside) = (f64::INFINITY, true);
            for [i, j, k, behind] in [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 3, 2, 0]] {
                let normal = (all[j] - all[i]).cross(all[k] - all[i]);
                let (origin, last) = (-normal.dot(all[i]), normal.dot(all[behind] - all[i]));
                if !apart && origin * last > 0.0 {
                    continue;
                }
                inside = false;
                let parts = of_triangle([all[i], all[j], all[k]]);
                let at = all[i] * parts[0] + all[j] * parts[1] + all[k] * parts[2];
                if at.length_squared() < best {
                    best = at.length_squared();
                    weights = [0.0; 4];
                    (weights[i], weights[j], weights[k]) = (parts[0], parts[1], parts[2]);
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

/// Returns the nearest points, given the point of b less a that is the lowest along a vector, and a first vector, which
/// is not zero.
pub fn gap(lowest: &dyn Fn(Vec3<f64>) -> Difference, first: Vec3<f64>) -> Gap {
    let start = lowest(first);
    let mut way = start.way;
    let (mut simplex, mut weights, mut count) = ([start; 4], [1.0, 0.0, 0.0, 0.0], 1);
    let mut least = first.dot(way) / first.length();
    let (mut size, mut inside) = (way.length_squared(), false);
    for _ in 0..STEPS {
        let square = way.length_squared();
        if square <= NONE * size {
            inside = true;
            break;
        }
        let low = lowest(way);
        size = size.max(low.way.length_squared());
        let height = way.dot(low.way);
        least = least.max(height / square.sqrt());
        let known = simplex[..count].iter().any(|corner| corner.way == low.way);
        if square - height <= PROGRESS * square || known {
            break;
        }
        simplex[count] = low;
        let apart = least > 0.0 && least * least > PROVED * size;
        let Some(parts) = nearest(&simplex[..=count], apart) else {
            inside = true;
            break;
        };
        let (mut kept, mut next) = (0, Vec3::zero());
        let (mut held, mut shares) = (simplex, [0.0; 4]);
        for k in 0..=count {
            if parts[k] > 0.0 {
                (held[kept], shares[kept]) = (simplex[k], parts[k]);
                next += simplex[k].way * parts[k];
                kept += 1;
            }
        }
        // No progress in the digits that there are.
        if next.length_squared() >= square {
            break;
        }
        (simplex, weights, count, way) = (held, shares, kept, next);
    }
    let mut found = Gap {
        way,
        on_a: Vec3::zero(),
        on_b: Vec3::zero(),
        inside,
    };
    for (corner, weight) in simplex[..count].iter().zip(weights) {
        found.on_a += corner.a * weight;
        found.on_b += corner.b * weight;
    }
    found
}
