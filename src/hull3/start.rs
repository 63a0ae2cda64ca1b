//! The first corners of a hull: as many as its dimension needs, far from each other.
use super::orientation::{on_line, side};
use crate::Vec3;

/// Points that span a hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// All points coincide, or there is none.
    Point,
    /// The points are on the line of two.
    Line([usize; 2]),
    /// The points are in the plane of three.
    Plane([usize; 3]),
    /// Four points are in no plane; the last one is behind the first three, which run counter-clockwise.
    Solid([usize; 4]),
}

/// Returns the index of the point with the largest size, the first one of equals, among those for which a condition
/// holds exactly.
fn farthest(
    points: &[Vec3<f64>],
    size: impl Fn(Vec3<f64>) -> f64,
    holds: impl Fn(Vec3<f64>) -> bool,
) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (k, &point) in points.iter().enumerate() {
        let size = size(point);
        if best.is_none_or(|(_, most)| size > most) {
            best = Some((k, size));
        }
    }
    let best = best.map(|(k, _)| k).filter(|&k| holds(points[k]));
    best.or_else(|| points.iter().position(|&point| holds(point)))
}

/// Returns the points that span the hull of all, decided exactly.
pub(super) fn start(points: &[Vec3<f64>]) -> Start {
    let Some(first) = least(points) else {
        return Start::Point;
    };
    let a = points[first];
    let away = |p: Vec3<f64>| (p - a).length_squared();
    let Some(second) = farthest(points, away, |p| p != a) else {
        return Start::Point;
    };
    let b = points[second];
    let aside = |p: Vec3<f64>| (b - a).cross(p - a).length_squared();
    let Some(third) = farthest(points, aside, |p| !on_line([a, b, p])) else {
        return Start::Line([first, second]);
    };
    let plane = [a, b, points[third]];
    let normal = (b - a).cross(points[third] - a);
    let height = |p: Vec3<f64>| normal.dot(p - a).abs();
    let Some(fourth) = farthest(points, height, |p| side(plane, p) != 0.0) else {
        return Start::Plane([first, second, third]);
    };
    match side(plane, points[fourth]) < 0.0 {
        true => Start::Solid([first, second, third, fourth]),
        false => Start::Solid([first, third, second, fourth]),
    }
}

/// Returns the index of the least point by x, then y, then z.
pub(super) fn least(points: &[Vec3<f64>]) -> Option<usize> {
    (0..points.len()).min_by(|&i, &j| by_coordinates(points[i], points[j]))
}

/// Returns the order of two points by x, then y, then z.
pub(super) fn by_coordinates(p: Vec3<f64>, q: Vec3<f64>) -> std::cmp::Ordering {
    // Zeros of either sign are equal.
    let order = |p: f64, q: f64| p.partial_cmp(&q).unwrap_or(std::cmp::Ordering::Equal);
    order(p.x, q.x).then(order(p.y, q.y)).then(order(p.z, q.z))
}
