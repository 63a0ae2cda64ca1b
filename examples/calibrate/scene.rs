//! Two sensors that see the same objects, each in coordinates of its own.
use common::random::Draw;
use geograd::{Obb3, Pose3, Rotation3, Vec3};
use std::f64::consts::TAU;

/// How far the sensors see, in metres.
pub const FAR: f64 = 40.0;

/// Objects around, of which each sensor misses some.
const OBJECTS: usize = 48;
const MISSED: f64 = 0.1;
/// Boxes of the second sensor that are far from their object, and boxes of nothing of either sensor.
const WRONG: f64 = 0.12;
const GHOSTS: usize = 4;

/// The boxes that the sensors see, and the motion between the sensors.
pub struct Scene {
    /// The boxes of the first sensor, in its coordinates.
    pub a: Vec<Obb3<f64>>,
    /// The boxes of the second sensor, in its own coordinates.
    pub b: Vec<Obb3<f64>>,
    /// The truth.
    pub a_from_b: Pose3<f64>,
    /// The motion known at the start, from the mounting of the sensors, say.
    pub guess: Pose3<f64>,
}

fn uniform(draw: &mut Draw, low: f64, high: f64) -> f64 {
    low + (high - low) * f64::from(draw.uniform())
}

/// Three independent numbers of mean zero.
fn normal3(draw: &mut Draw, spread: f64) -> Vec3<f64> {
    let mut next = || spread * f64::from(draw.normal());
    Vec3::new(next(), next(), next())
}

/// A direction and a length.
fn vector(draw: &mut Draw, length: f64) -> Vec3<f64> {
    normal3(draw, 1.0).normalize_or_zero() * length
}

impl Scene {
    pub fn new(seed: u64) -> Self {
        let mut draw = Draw::new(&[seed]);
        let draw = &mut draw;
        let yaw = uniform(draw, -0.8, 0.8);
        let turn = Rotation3::from_yaw(yaw).retract(normal3(draw, 0.06));
        let shift = Vec3::new(
            uniform(draw, -2.5, 2.5),
            uniform(draw, -2.5, 2.5),
            uniform(draw, -0.6, 0.6),
        );
        let a_from_b = Pose3::new(shift, turn);
        let angle = uniform(draw, 0.05, 0.09);
        let by_turn = vector(draw, angle);
        let guess = a_from_b.retract(by_turn, vector(draw, 1.2));
        let mut objects: Vec<Obb3<f64>> = Vec::new();
        while objects.len() < OBJECTS {
            let object = object(draw);
            let near = |other: &Obb3<f64>| object.center.distance(other.center) < 5.5;
            if !objects.iter().any(near) {
                objects.push(object);
            }
        }
        let (mut a, mut b) = (Vec::new(), Vec::new());
        let b_from_a = a_from_b.inverse();
        for &object in &objects {
            if uniform(draw, 0.0, 1.0) > MISSED {
                a.push(seen(object, draw));
            }
            let mut other = seen(b_from_a * object, draw);
            if uniform(draw, 0.0, 1.0) < WRONG {
                let far = uniform(draw, 2.0, 6.0);
                other.center += vector(draw, far);
                other = other.retract(normal3(draw, 0.4));
            }
            if uniform(draw, 0.0, 1.0) > MISSED {
                b.push(other);
            }
        }
        for _ in 0..GHOSTS {
            a.push(object(draw));
            b.push(b_from_a * object(draw));
        }
        Scene {
            a,
            b,
            a_from_b,
            guess,
        }
    }
}

/// Something that stands around, on ground that is not quite even.
fn object(draw: &mut Draw) -> Obb3<f64> {
    let size = match uniform(draw, 0.0, 1.0) {
        x if x < 0.6 => Vec3::new(4.3, 1.8, 1.5),
        x if x < 0.8 => Vec3::new(6.0, 2.2, 2.6),
        _ => Vec3::new(1.8, 0.7, 1.7),
    };
    let size = size * (1.0 + 0.08 * f64::from(draw.normal().clamp(-2.0, 2.0)));
    let (around, far) = (uniform(draw, 0.0, TAU), uniform(draw, 0.03, 1.0));
    // Evenly over the ground.
    let far = FAR * far.sqrt();
    let z = 0.5 * size.z - 1.7 + 0.4 * (far / 9.0).sin();
    let center = Vec3::new(far * around.cos(), far * around.sin(), z);
    let heading = Rotation3::from_yaw(uniform(draw, 0.0, TAU));
    Obb3::new(center, size, heading.retract(normal3(draw, 0.03)))
}

/// A box as a sensor measures it.
fn seen(object: Obb3<f64>, draw: &mut Draw) -> Obb3<f64> {
    let mut size = object.size;
    for side in [&mut size.x, &mut size.y, &mut size.z] {
        *side *= 1.0 + 0.03 * f64::from(draw.normal());
    }
    let center = object.center + normal3(draw, 0.06);
    Obb3::new(center, size, object.rotation).retract(normal3(draw, 0.02))
}
