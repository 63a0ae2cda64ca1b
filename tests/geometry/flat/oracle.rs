//! Distances by another way: the hull of all differences of corners, and the origin.

/// A shape as corners and radius, made here from its numbers. An infinite shape gets a far end.
pub fn corners(kind: usize, x: &[f64]) -> (Vec<[f64; 2]>, f64) {
    let p = |k: usize| [x[k], x[k + 1]];
    let far = |t: f64| {
        let length = (x[2] * x[2] + x[3] * x[3]).sqrt();
        [x[0] + t * x[2] / length, x[1] + t * x[3] / length]
    };
    const FAR: f64 = 1e3;
    match kind {
        0 => (vec![p(0)], 0.0),
        1 => (vec![far(-FAR), far(FAR)], 0.0),
        2 => (vec![p(0), far(FAR)], 0.0),
        3 => (vec![p(0), p(2)], 0.0),
        4 => (vec![p(0), p(2), p(4)], 0.0),
        5 => (vec![p(0), p(2), [x[0], x[3]], [x[2], x[1]]], 0.0),
        6 => {
            let (sin, cos) = x[4].sin_cos();
            let corner = |u: f64, v: f64| {
                let (a, b) = (u * x[2] / 2.0, v * x[3] / 2.0);
                [x[0] + cos * a - sin * b, x[1] + sin * a + cos * b]
            };
            (
                vec![
                    corner(-1., -1.),
                    corner(1., -1.),
                    corner(1., 1.),
                    corner(-1., 1.),
                ],
                0.0,
            )
        }
        7 => (vec![p(0)], x[2]),
        8 => (vec![p(0), p(2)], x[4]),
        _ => (vec![p(0), p(2), p(4), p(6)], 0.0),
    }
}

fn cross(o: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

/// Andrew's monotone chain.
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a.partial_cmp(b).unwrap());
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while chain.len() > 1 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter().copied());
    all.extend(half(&mut points.iter().rev().copied()));
    all
}

/// The distance from the origin to a segment, by ternary search along it.
fn to_segment(a: [f64; 2], b: [f64; 2]) -> f64 {
    let at = |t: f64| (a[0] + t * (b[0] - a[0])).hypot(a[1] + t * (b[1] - a[1]));
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..90 {
        let (l, h) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(l) < at(h) {
            high = h;
        } else {
            low = l;
        }
    }
    at(low).min(at(high)).min(at(0.0)).min(at(1.0))
}

/// The signed distance of two shapes.
pub fn signed_distance(a: (usize, &[f64]), b: (usize, &[f64])) -> f64 {
    let ((pa, ra), (pb, rb)) = (corners(a.0, a.1), corners(b.0, b.1));
    let mut differences = Vec::new();
    for p in &pa {
        for q in &pb {
            differences.push([q[0] - p[0], q[1] - p[1]]);
        }
    }
    let hull = hull(differences);
    let n = hull.len();
    let distance = (0..n)
        .map(|i| to_segment(hull[i], hull[(i + 1) % n]))
        .fold(f64::INFINITY, f64::min);
    let inside = n > 2 && (0..n).all(|i| cross(hull[i], hull[(i + 1) % n], [0.0, 0.0]) > 0.0);
    (if inside { -distance } else { distance }) - ra - rb
}

/// The farthest distance of two shapes.
pub fn farthest(a: (usize, &[f64]), b: (usize, &[f64])) -> f64 {
    let ((pa, ra), (pb, rb)) = (corners(a.0, a.1), corners(b.0, b.1));
    let mut most: f64 = 0.0;
    for p in &pa {
        for q in &pb {
            most = most.max((q[0] - p[0]).hypot(q[1] - p[1]));
        }
    }
    most + ra + rb
}

/// `true` if a point is within `slack` of a shape.
pub fn holds(shape: (usize, &[f64]), point: [f64; 2], slack: f64) -> bool {
    signed_distance((0, &point), shape) <= slack
}
