//! Invariances of a function under motions, and what they imply for its derivatives.
//!
//! A motion of the input may change the output in a known way; the derivative along
//! that motion is then known too. Translation invariance: the derivatives of all positions sum to zero.
//! Rotation invariance: their torques balance. Homogeneity of degree p: Euler's `x · ∂y = p y`.
//!
//! The [`Kind`] of each number of a shape determines its motion. `compare/invariance` uses both.
pub use crate::ad::declared::{Effect, Invariance, Kind, Motion};
use crate::{Rotation3, Vec3};
use std::f64::consts::TAU;

/// A group of numbers that move together; a point or a direction has two or three.
#[derive(Clone, Copy)]
enum Group {
    Point(usize),
    Direction(usize),
    /// A direction and the offset of a line or plane along it.
    Plane(usize),
    Quaternion,
    RotationVector,
    Single(Kind),
}

impl Group {
    /// Returns the group that a list of kinds begins with, and its length.
    fn first(kinds: &[Kind]) -> (Group, usize) {
        use Kind::{
            DirectionX, DirectionY, DirectionZ, Offset, QuaternionW, QuaternionX, QuaternionY,
            QuaternionZ, RotationVectorX, RotationVectorY, RotationVectorZ, X, Y, Z,
        };
        match kinds {
            [X, Y, Z, ..] => (Group::Point(3), 3),
            [X, Y, ..] => (Group::Point(2), 2),
            [DirectionX, DirectionY, DirectionZ, Offset, ..] => (Group::Plane(3), 4),
            [DirectionX, DirectionY, Offset, ..] => (Group::Plane(2), 3),
            [DirectionX, DirectionY, DirectionZ, ..] => (Group::Direction(3), 3),
            [DirectionX, DirectionY, ..] => (Group::Direction(2), 2),
            [QuaternionW, QuaternionX, QuaternionY, QuaternionZ, ..] => (Group::Quaternion, 4),
            [RotationVectorX, RotationVectorY, RotationVectorZ, ..] => (Group::RotationVector, 3),
            _ => (Group::Single(kinds[0]), 1),
        }
    }
}

/// Calls a function with every group of numbers, its index and its numbers.
fn each_group<'a>(kinds: &[Kind], x: &'a [f64], mut call: impl FnMut(Group, usize, &'a [f64])) {
    let mut at = 0;
    while at < x.len().min(kinds.len()) {
        let (group, length) = Group::first(&kinds[at..x.len().min(kinds.len())]);
        call(group, at, &x[at..at + length]);
        at += length;
    }
}

/// A motion by its axis: x is 0, y is 1, z is 2.
enum MotionAxis {
    Along(usize),
    About(usize),
    Away,
    Exchange,
}

fn axis_of(motion: Motion) -> MotionAxis {
    match motion {
        Motion::TranslationX => MotionAxis::Along(0),
        Motion::TranslationY => MotionAxis::Along(1),
        Motion::TranslationZ => MotionAxis::Along(2),
        Motion::RotationX => MotionAxis::About(0),
        Motion::RotationY => MotionAxis::About(1),
        Motion::Rotation => MotionAxis::About(2),
        Motion::Scaling => MotionAxis::Away,
        Motion::Exchange => MotionAxis::Exchange,
    }
}

/// Returns `true` for a coordinate along an axis, and for an angle about it.
fn lies_on(kind: Kind, axis: usize) -> bool {
    match kind {
        Kind::X | Kind::AngleX => axis == 0,
        Kind::Y | Kind::AngleY => axis == 1,
        Kind::Z | Kind::Angle => axis == 2,
        _ => false,
    }
}

/// Returns the two axes that a rotation about an axis moves, the second one towards the negative first; `None` if
/// numbers of the plane have only one of them.
fn turning(axis: usize, numbers: usize) -> Option<[usize; 2]> {
    let across = [(axis + 1) % 3, (axis + 2) % 3];
    across.iter().all(|&i| i < numbers).then_some(across)
}

fn unit(axis: usize) -> Vec3<f64> {
    let at = |i: usize| f64::from(u8::from(i == axis));
    Vec3::new(at(0), at(1), at(2))
}

/// Returns the velocity of numbers of the given kinds under a motion of unit speed.
#[must_use]
pub fn velocity(motion: Motion, kinds: &[Kind], x: &[f64]) -> Vec<f64> {
    let mut speed = vec![0.0; x.len()];
    each_group(kinds, x, |group, at, x| {
        let speed = &mut speed[at..at + x.len()];
        match (axis_of(motion), group) {
            (MotionAxis::Along(axis), Group::Point(n)) if axis < n => speed[axis] = 1.0,
            (MotionAxis::Along(axis), Group::Plane(n)) if axis < n => speed[n] = x[axis],
            (MotionAxis::Along(axis), Group::Single(kind))
                if kind.is_place() && lies_on(kind, axis) =>
            {
                speed[0] = 1.0;
            }
            (MotionAxis::About(axis), Group::Point(n) | Group::Direction(n) | Group::Plane(n)) => {
                if let Some([i, j]) = turning(axis, n) {
                    (speed[i], speed[j]) = (-x[j], x[i]);
                }
            }
            // Half the product of the axis, as a quaternion, and the quaternion.
            (MotionAxis::About(axis), Group::Quaternion) => {
                let v = unit(axis).cross(Vec3::new(x[1], x[2], x[3])) + unit(axis) * x[0];
                speed.copy_from_slice(&[-x[1 + axis], v.x, v.y, v.z].map(|x| 0.5 * x));
            }
            (MotionAxis::About(axis), Group::RotationVector) => {
                let v = left_jacobian_inverse(Vec3::new(x[0], x[1], x[2]), unit(axis));
                speed.copy_from_slice(&[v.x, v.y, v.z]);
            }
            (MotionAxis::About(axis), Group::Single(kind))
                if kind.is_angle() && lies_on(kind, axis) =>
            {
                speed[0] = 1.0;
            }
            (MotionAxis::Away, Group::Point(_)) => speed.copy_from_slice(x),
            (MotionAxis::Away, Group::Plane(n)) => speed[n] = x[n],
            (MotionAxis::Away, Group::Single(kind)) if kind.is_length() => speed[0] = x[0],
            _ => {}
        }
    });
    speed
}

/// Returns the velocity of a rotation vector when the world turns about an axis at unit speed: the inverse of the left
/// Jacobian of SO(3), times the axis. It has a pole at a length of 2π.
fn left_jacobian_inverse(v: Vec3<f64>, axis: Vec3<f64>) -> Vec3<f64> {
    let (angle, square) = (v.length(), v.length_squared());
    // Below this angle four terms are exact in double precision; the closed form loses digits.
    let factor = match angle < 0.1 {
        true => {
            1.0 / 12.0 + square * (1.0 / 720.0 + square * (1.0 / 30_240.0 + square / 1_209_600.0))
        }
        false => (1.0 - 0.5 * angle / (0.5 * angle).tan()) / square,
    };
    let side = v.cross(axis);
    axis - side * 0.5 + v.cross(side) * factor
}

/// Returns the velocity of the output that the invariance declares, if its numbers are of these kinds.
#[must_use]
pub fn answer(invariance: Invariance, kinds: &[Kind], y: &[f64]) -> Vec<f64> {
    match invariance.answer {
        Effect::Stays => vec![0.0; y.len()],
        Effect::Power(p) => y.iter().map(|y| f64::from(p) * y).collect(),
        Effect::Follows => velocity(invariance.motion, kinds, y),
    }
}

/// Returns the input with its two halves exchanged.
#[must_use]
pub fn exchanged(x: &[f64]) -> Vec<f64> {
    let (a, b) = x.split_at(x.len() / 2);
    [b, a].concat()
}

/// Returns the numbers of the given kinds after a motion by an amount: a distance, an angle in radians, a factor.
#[must_use]
pub fn moved_by(motion: Motion, amount: f64, kinds: &[Kind], x: &[f64]) -> Vec<f64> {
    let axis = axis_of(motion);
    if let MotionAxis::Exchange = axis {
        return exchanged(x);
    }
    let (sin, cos) = amount.sin_cos();
    let mut there = x.to_vec();
    each_group(kinds, x, |group, at, x| {
        let there = &mut there[at..at + x.len()];
        match (&axis, group) {
            (&MotionAxis::Along(axis), Group::Point(n)) if axis < n => there[axis] += amount,
            (&MotionAxis::Along(axis), Group::Plane(n)) if axis < n => there[n] += amount * x[axis],
            (&MotionAxis::Along(axis), Group::Single(kind))
                if kind.is_place() && lies_on(kind, axis) =>
            {
                there[0] += amount;
            }
            (&MotionAxis::About(axis), Group::Point(n) | Group::Direction(n) | Group::Plane(n)) => {
                if let Some([i, j]) = turning(axis, n) {
                    (there[i], there[j]) = (cos * x[i] - sin * x[j], sin * x[i] + cos * x[j]);
                }
            }
            (&MotionAxis::About(axis), Group::Quaternion) => {
                let (sin, cos) = (0.5 * amount).sin_cos();
                let (v, axis) = (Vec3::new(x[1], x[2], x[3]), unit(axis));
                let turned = v * cos + (axis.cross(v) + axis * x[0]) * sin;
                let w = cos * x[0] - sin * axis.dot(v);
                there.copy_from_slice(&[w, turned.x, turned.y, turned.z]);
            }
            (&MotionAxis::About(axis), Group::RotationVector) => {
                let v = turned_vector(Vec3::new(x[0], x[1], x[2]), unit(axis), amount);
                there.copy_from_slice(&[v.x, v.y, v.z]);
            }
            (&MotionAxis::About(axis), Group::Single(kind))
                if kind.is_angle() && lies_on(kind, axis) =>
            {
                there[0] += amount;
            }
            (MotionAxis::Away, Group::Point(_)) => there.iter_mut().for_each(|x| *x *= amount),
            (MotionAxis::Away, Group::Plane(n)) => there[n] *= amount,
            (MotionAxis::Away, Group::Single(kind)) if kind.is_length() => there[0] *= amount,
            _ => {}
        }
    });
    there
}

/// Returns the rotation vector after a turn of the world: of all vectors of that rotation the one nearest to it.
fn turned_vector(v: Vec3<f64>, axis: Vec3<f64>, angle: f64) -> Vec3<f64> {
    let turn = Rotation3::from_axis_angle(axis, angle);
    let there = (turn * Rotation3::from_rotation_vector(v)).rotation_vector();
    let length = there.length();
    if length == 0.0 {
        return there;
    }
    let turns = (v.dot(there) / length - length) / TAU;
    there * (1.0 + TAU * turns.round() / length)
}
