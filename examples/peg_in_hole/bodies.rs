//! The peg, the block with its hole, and the peg's motion from one place to another.
use geograd::motion::Motion3;
use geograd::{Hull3, Pose3, Rotation3, Scalar, Shape, Vec3};
use std::f64::consts::FRAC_PI_3;

/// A hexagonal prism, or a part of the block.
pub type Solid<S> = Hull3<S, 12>;
/// A place of the peg: its centre in metres, and its rotation vector in radians.
pub type Place<S> = [S; 6];

/// Half the width of the peg from side to side.
pub const HALF: f64 = 0.2;
/// The height of the peg, and the depth of the hole.
pub const HEIGHT: f64 = 0.6;
/// The gap between peg and hole on every side.
pub const PLAY: f64 = 0.002;
/// Half the width of the block.
const OUTSIDE: f64 = 0.5;
const BASE: f64 = 0.12;
/// The number of the base in [`block`].
pub const GROUND: usize = 6;
/// The peg leans and is turned about its axis; it shall stand in the hole, with the same gap below.
pub const ENDS: [Place<f64>; 2] = [
    [-0.85, 0.1, 0.72, 0.3, 0.9, 0.5],
    [0.0, 0.0, PLAY - 0.5 * HEIGHT, 0.0, 0.0, 0.0],
];

/// Returns the pose that takes the peg from the origin to a place.
pub fn pose<S: Scalar>([x, y, z, a, b, c]: Place<S>) -> Pose3<S> {
    let rotation = Rotation3::from_rotation_vector(Vec3::new(a, b, c));
    Pose3::new(Vec3::new(x, y, z), rotation)
}

/// Returns the corners of a hexagonal prism about the z axis, by half its width and its ends along z.
fn prism<S: Scalar>(half: S, ends: [f64; 2]) -> [Vec3<S>; 12] {
    let out = half * S::lit(1.0 / (0.5 * FRAC_PI_3).cos());
    std::array::from_fn(|k| {
        let (sin, cos) = (FRAC_PI_3 * ((k / 2) as f64 + 0.5)).sin_cos();
        Vec3::new(out * S::lit(cos), out * S::lit(sin), S::lit(ends[k % 2]))
    })
}

/// Returns the place at a part of the way between two others.
pub fn between<S: Scalar>(from: Place<S>, to: Place<S>, part: S) -> Place<S> {
    std::array::from_fn(|k| from[k] + (to[k] - from[k]) * part)
}

/// Returns the corners of the peg at a part of the way between two places, by half its width.
pub fn corners<S: Scalar>(from: Place<S>, to: Place<S>, part: S, half: S) -> [Vec3<S>; 12] {
    let pose = pose(between(from, to, part));
    prism(half, [-0.5 * HEIGHT, 0.5 * HEIGHT]).map(|corner| pose * corner)
}

/// Returns the peg at a place.
pub fn peg(place: Place<f64>) -> Solid<f64> {
    Solid::from(corners(place, place, 0.0, HALF))
}

/// The peg at the start of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
pub struct MovingPeg<S> {
    pub corners: [Vec3<S>; 12],
    pub motion: Motion3<S>,
}

/// Returns the peg on its way from one place to another, by half its width.
pub fn moving<S: Scalar>(from: Place<S>, to: Place<S>, half: S) -> MovingPeg<S> {
    MovingPeg {
        corners: corners(from, to, S::zero(), half),
        motion: Motion3::between(pose(from), pose(to)),
    }
}

/// Returns the six walls of the hole, anticlockwise from the one on the right, and the base.
pub fn block() -> [Solid<f64>; 7] {
    std::array::from_fn(|k| match k {
        GROUND => Solid::from(prism(OUTSIDE, [-HEIGHT - BASE, -HEIGHT])),
        _ => {
            let turned = Rotation3::from_yaw(FRAC_PI_3 * k as f64);
            let corners: [_; 8] = std::array::from_fn(|i| {
                let out = [HALF + PLAY, OUTSIDE][i & 1];
                let along = out * (0.5 * FRAC_PI_3).tan();
                let side = if i & 2 == 0 { -along } else { along };
                turned * Vec3::new(out, side, if i & 4 == 0 { -HEIGHT } else { 0.0 })
            });
            Solid::from_vertices(&corners)
        }
    })
}
