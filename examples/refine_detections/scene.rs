//! A street of the program's own making, the same for the same seed.
use crate::model::{Class, Frame, Frames, Seen};
use common::random::Draw;
use geograd::{Obb2, Pose2, Vec2, Vec3, YawBox3};
use std::f32::consts::{FRAC_PI_2, PI};

/// Seconds between frames, and how fast the camera drives, in metres a second.
const PERIOD: f32 = 0.1;
const SPEED: f32 = 6.0;

/// How far the camera sees, in metres.
const NEAR: f32 = 3.0;
const FAR: f32 = 50.0;

/// How high the camera is above the street, in metres.
const CAMERA: f32 = 1.65;

/// Objects in a row along the street, evenly spaced but for a jitter, all going the same way.
struct Lane {
    class: Class,
    /// Metres to the right of the middle of the street.
    side: f32,
    spacing: f32,
    /// Metres a second along the street; negative against the camera's way.
    speed: f32,
    /// How many of the places are taken.
    filled: f32,
}

const fn lane(class: Class, side: f32, spacing: f32, speed: f32, filled: f32) -> Lane {
    Lane {
        class,
        side,
        spacing,
        speed,
        filled,
    }
}

const LANES: [Lane; 8] = [
    lane(Class::Car, -6.6, 6.5, 0.0, 0.75),
    lane(Class::Car, 6.6, 6.5, 0.0, 0.75),
    lane(Class::Car, -2.2, 17.0, -9.0, 0.8),
    lane(Class::Car, 2.2, 15.0, 6.5, 0.7),
    lane(Class::Cyclist, -4.6, 13.0, -4.5, 0.6),
    lane(Class::Cyclist, 4.6, 13.0, 5.0, 0.6),
    lane(Class::Pedestrian, -9.6, 5.0, 1.3, 0.7),
    lane(Class::Pedestrian, 9.6, 5.0, -1.2, 0.7),
];

/// The middle of the street, which bends, that far along.
fn street(along: f32) -> Vec2<f32> {
    Vec2::new(5.0 * (along / 22.0).sin(), along)
}

/// The direction of the street there, counter-clockwise from +x.
fn direction(along: f32) -> f32 {
    1.0_f32.atan2(5.0 / 22.0 * (along / 22.0).cos())
}

/// The frames of a drive along the street.
pub fn drive(seed: u64, frames: u32) -> Frames {
    (0..frames).map(|i| (i, frame(seed, i))).collect()
}

fn frame(seed: u64, number: u32) -> Frame {
    let time = number as f32 * PERIOD;
    let camera = time * SPEED;
    let world_from_camera = Pose2::new(
        street(camera) + Vec2::new(2.2, 0.0),
        direction(camera) - FRAC_PI_2,
    );
    let camera_from_world = world_from_camera.inverse();
    let mut frame = Frame::default();
    for (k, lane) in LANES.iter().enumerate() {
        let start = camera + NEAR - lane.speed * time;
        let first = (start / lane.spacing).floor() as i64;
        let count = ((FAR - NEAR) / lane.spacing).ceil() as i64 + 1;
        for place in first..=first + count {
            // An object is drawn from its place in its lane, so it stays the same over time.
            let mut draw = Draw::new(&[seed, k as u64, place as u64]);
            if draw.uniform() > lane.filled {
                continue;
            }
            let along = (place as f32 + 0.12 * draw.normal().clamp(-1.0, 1.0)) * lane.spacing
                + lane.speed * time;
            let turned = if lane.speed < 0.0 { PI } else { 0.0 };
            let (length, width, swerve) = match lane.class {
                Class::Car => (4.2, 1.75, 0.03),
                Class::Cyclist => (1.8, 0.65, 0.08),
                Class::Pedestrian | Class::Other => (0.8, 0.65, 0.4),
            };
            let direction = direction(along);
            let across = Vec2::new(direction.sin(), -direction.cos());
            let side = lane.side + 0.15 * draw.normal();
            let center = camera_from_world * (street(along) + across * side);
            if !(NEAR..FAR).contains(&center.y) {
                continue;
            }
            let ground = Obb2::new(
                center.x,
                center.y,
                length * (1.0 + 0.07 * draw.normal().clamp(-2.0, 2.0)),
                width * (1.0 + 0.05 * draw.normal().clamp(-2.0, 2.0)),
                direction + turned + swerve * draw.normal() - world_from_camera.rotation.angle(),
            );
            let mut draw = Draw::new(&[seed, HEIGHTS + k as u64, place as u64]);
            frame.truths.push(Seen {
                class: lane.class,
                score: 1.0,
                shape: standing(ground, lane.class, along, &mut draw),
            });
        }
    }
    let mut draw = Draw::new(&[seed, LANES.len() as u64, u64::from(number)]);
    // Heights have numbers of their own, so that the view from above does not depend on them.
    let mut up = Draw::new(&[seed, 2 * HEIGHTS, u64::from(number)]);
    for truth in &frame.truths {
        frame.detections.extend(detect(truth, &mut draw, &mut up));
    }
    while draw.uniform() < 0.6 {
        let (length, width) = (3.9 + 0.3 * draw.normal(), 1.6 + 0.1 * draw.normal());
        let ghost = Obb2::new(
            14.0 * (2.0 * draw.uniform() - 1.0),
            NEAR + (FAR - NEAR) * draw.uniform(),
            length,
            width,
            PI * draw.uniform(),
        );
        frame.detections.push(Seen {
            class: Class::Car,
            score: 0.4 * draw.uniform(),
            shape: standing(ghost, Class::Car, 0.0, &mut up),
        });
    }
    frame
}

/// Keys from here on are those of heights.
const HEIGHTS: u64 = 1000;

/// A box of a class's height on the street, which goes up and down a little.
fn standing(ground: Obb2<f32>, class: Class, along: f32, draw: &mut Draw) -> YawBox3<f32> {
    let height = match class {
        Class::Car => 1.5,
        Class::Cyclist => 1.72,
        Class::Pedestrian | Class::Other => 1.74,
    };
    let height = height * (1.0 + 0.05 * draw.normal().clamp(-2.0, 2.0));
    let street = 0.25 * (along / 17.0).sin() - CAMERA;
    upright(ground, street + 0.5 * height, height)
}

fn upright(ground: Obb2<f32>, z: f32, height: f32) -> YawBox3<f32> {
    YawBox3::new(
        Vec3::new(ground.center.x, ground.center.y, z),
        Vec3::new(ground.size.x, ground.size.y, height),
        ground.heading,
    )
}

/// The detection of an object by a middling detector: mostly near, sometimes far off, sometimes none.
fn detect(truth: &Seen, draw: &mut Draw, up: &mut Draw) -> Option<Seen> {
    let Obb2 {
        center,
        size,
        heading,
    } = truth.ground();
    let far = center.length() / FAR;
    let seen = draw.uniform() > 0.03 + 0.10 * far;
    // One in ten is off by much; one in twenty has the opposite heading, which is the same box.
    let blunder = if draw.uniform() < 0.1 { 3.5 } else { 1.0 };
    let turned = if draw.uniform() < 0.05 { PI } else { 0.0 };
    let spread = blunder * (0.4 + 0.6 * far);
    let off = Vec2::new(
        0.13 * spread * size.x * draw.normal(),
        0.13 * spread * size.y * draw.normal(),
    );
    let shape = Obb2 {
        center: center + geograd::Rotation2::from_angle(heading) * off,
        size: Vec2::new(
            size.x * (0.09 * spread.min(1.5) * draw.normal()).exp(),
            size.y * (0.09 * spread.min(1.5) * draw.normal()).exp(),
        ),
        heading: heading + turned + 0.12 * spread * draw.normal(),
    };
    let score = (1.0 - 0.25 * spread + 0.08 * draw.normal()).clamp(0.05, 0.99);
    let YawBox3 { center, size, .. } = truth.shape;
    let z = center.z + 0.07 * spread * size.z * up.normal();
    let height = size.z * (0.05 * spread.min(1.5) * up.normal()).exp();
    seen.then_some(Seen {
        class: truth.class,
        score,
        shape: upright(shape, z, height),
    })
}
