//! Exact decisions about points of space: the side of a plane, and whether three points are on a line.
use crate::predicate::{Turn, turn};
use crate::{Vec2, Vec3};
use robust::{Coord3D, orient3d};

/// Returns a number with the sign of the height of a point over the plane of three others: positive on the side from
/// which they run counter-clockwise, zero in the plane. Exact where no product over- or underflows.
pub(crate) fn side([a, b, c]: [Vec3<f64>; 3], point: Vec3<f64>) -> f64 {
    let coordinates = |Vec3 { x, y, z }: Vec3<f64>| Coord3D { x, y, z };
    -orient3d(
        coordinates(a),
        coordinates(b),
        coordinates(c),
        coordinates(point),
    )
}

/// Returns `true` for three points on a line, exactly.
pub(crate) fn on_line([a, b, c]: [Vec3<f64>; 3]) -> bool {
    // The product of rounded differences errs by some roundings of both lengths.
    const CLEAR: f64 = 1e-24;
    let (u, v) = (b - a, c - a);
    if u.cross(v).length_squared() > CLEAR * (u.length_squared() * v.length_squared()) {
        return false;
    }
    (0..3).all(|axis| turn_along(axis, [a, b, c]) == Turn::Straight)
}

/// Returns the turn of a path seen along a coordinate axis, exactly.
pub(crate) fn turn_along(axis: usize, [a, b, c]: [Vec3<f64>; 3]) -> Turn {
    turn(seen(axis, a), seen(axis, b), seen(axis, c))
}

/// Returns a point seen along a coordinate axis.
pub(crate) fn seen(axis: usize, Vec3 { x, y, z }: Vec3<f64>) -> Vec2<f64> {
    match axis {
        0 => Vec2::new(y, z),
        1 => Vec2::new(z, x),
        _ => Vec2::new(x, y),
    }
}
