//! The nearest points of two hulls of plain numbers (Gilbert, Johnson, Keerthi 1988), with a bound from below.
use super::highest_point::PointColumns;
use crate::Vec3;

/// The result of the iteration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// The vector from the nearest point of a to that of b.
    pub way: Vec3<f64>,
    /// A distance that the hulls have at least: the width of a slab between them.
    pub least: f64,
    /// `true` if the hulls seem to have a point in common.
    pub inside: bool,
}

/// The number of steps after which it ends, right or not; hulls need about five.
const STEPS: usize = 64;

/// Returns the point of b's hull less a's that is the lowest along a direction.
fn support([a, b]: &[PointColumns; 2], way: Vec3<f64>) -> Vec3<f64> {
    b.highest(-way).1 - a.highest(way).1
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

/// Returns the weights of the point of a simplex that is nearest to the origin; `None` if the origin is inside.
fn nearest(simplex: &[Vec3<f64>]) -> Option<[f64; 4]> {
    let mut weights = [0.0; 4];
    match *simplex {
        [p, q] => weights[..2].copy_from_slice(&of_segment(p, q)),
        [p, q, r] => weights[..3].copy_from_slice(&of_triangle([p, q, r])),
        [p, q, r, s] => {
            let (all, mut best, mut inside) = ([p, q, r, s], f64::INFINITY, true);
            for [i, j, k, behind] in [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 3, 2, 0]] {
                let normal = (all[j] - all[i]).cross(all[k] - all[i]);
                let (origin, last) = (-normal.dot(all[i]), normal.dot(all[behind] - all[i]));
                if origin * last > 0.0 {
                    continue;
                }
                inside = false;
                let parts = of_triangle([all[i], all[j], all[k]]);
                let square =
                    (all[i] * parts[0] + all[j] * parts[1] + all[k] * parts[2]).length_squared();
                if square < best {
                    best = square;
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

/// Returns the nearest points of two hulls, which have at least a corner each.
pub(super) fn gap(hulls: &[PointColumns; 2]) -> Gap {
    const PROGRESS: f64 = 1e-15;
    const NONE: f64 = 1e-30;
    let mut way = hulls[1].point(0) - hulls[0].point(0);
    let (mut simplex, mut count) = ([way; 4], 1);
    let (mut least, mut size) = (0.0_f64, way.length_squared());
    for _ in 0..STEPS {
        let square = way.length_squared();
        if square <= NONE * size {
            return Gap {
                way,
                least: 0.0,
                inside: true,
            };
        }
        let lowest = support(hulls, way);
        size = size.max(lowest.length_squared());
        let height = way.dot(lowest);
        least = least.max(height / square.sqrt());
        if square - height <= PROGRESS * square || simplex[..count].contains(&lowest) {
            break;
        }
        simplex[count] = lowest;
        let Some(weights) = nearest(&simplex[..=count]) else {
            return Gap {
                way,
                least: 0.0,
                inside: true,
            };
        };
        let (mut kept, mut next) = (0, Vec3::zero());
        for k in 0..=count {
            if weights[k] > 0.0 {
                simplex[kept] = simplex[k];
                next += simplex[k] * weights[k];
                kept += 1;
            }
        }
        // No progress in the digits that there are.
        if next.length_squared() >= square {
            break;
        }
        (count, way) = (kept, next);
    }
    Gap {
        way,
        least,
        inside: false,
    }
}
