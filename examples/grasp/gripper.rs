//! The gripper: two fingers and a palm, all capsules, as functions of seven numbers.
use geograd::{Capsule3, Pose3, Rotation3, Scalar, Vec3};

/// A grasp: the place between the finger pads in metres, a rotation vector in radians, and the gap between the fingers in
/// metres. Fingers close along x and point along z.
pub type Grasp<S> = [S; 7];

/// The radius of a finger, in metres.
pub const FINGER: f64 = 0.007;
/// The ends of a finger's axis along z; it touches at z = 0.
pub const REACH: [f64; 2] = [-0.042, 0.009];
/// The radius of the palm, half the length of its axis, and its place along z.
pub const PALM: f64 = 0.022;
const PALM_HALF: f64 = 0.05;
const PALM_PLACE: f64 = REACH[0] - PALM;
/// The least and the largest gap (a hand of Franka Emika opens by 80 mm).
pub const GAPS: [f64; 2] = [0.002, 0.08];
/// Which way a finger is from the middle, along x.
pub const SIDES: [f64; 2] = [-1.0, 1.0];

/// The motion from the gripper's frame.
pub fn pose<S: Scalar>([x, y, z, a, b, c, _]: Grasp<S>) -> Pose3<S> {
    let rotation = Rotation3::from_rotation_vector(Vec3::new(a, b, c));
    Pose3::new(Vec3::new(x, y, z), rotation)
}

/// The place of a point of a finger, or with side 0 of the palm.
pub fn place<S: Scalar>(grasp: Grasp<S>, local: Vec3<S>, side: S) -> Vec3<S> {
    let out = (grasp[6].halved() + S::lit(FINGER)) * side;
    pose(grasp) * (local + Vec3::new(out, S::zero(), S::zero()))
}

/// Both fingers and the palm.
pub fn parts(grasp: Grasp<f64>) -> [Capsule3<f64>; 3] {
    let at = |x: f64, z: f64, side: f64| place(grasp, Vec3::new(x, 0.0, z), side);
    let [left, right] =
        SIDES.map(|side| Capsule3::new(at(0.0, REACH[0], side), at(0.0, REACH[1], side), FINGER));
    let palm = [-PALM_HALF, PALM_HALF].map(|x| at(x, PALM_PLACE, 0.0));
    [left, right, Capsule3::new(palm[0], palm[1], PALM)]
}

/// A ball of a part, which stays outside of the body.
#[derive(Clone, Copy, Debug)]
pub struct Guard {
    pub local: Vec3<f64>,
    pub side: f64,
    pub radius: f64,
}

/// Balls along all axes. The first two are those that touch.
pub fn guards() -> Vec<Guard> {
    let at = |x: f64, z: f64, side: f64, radius: f64| Guard {
        local: Vec3::new(x, 0.0, z),
        side,
        radius,
    };
    let mut all: Vec<_> = SIDES.map(|side| at(0.0, 0.0, side, FINGER)).into();
    for side in SIDES {
        for k in 0..=16 {
            let z = REACH[0] + (REACH[1] - REACH[0]) * f64::from(k) / 16.0;
            all.push(at(0.0, z, side, FINGER));
        }
    }
    for k in 0..=8 {
        all.push(at(
            PALM_HALF * (0.25 * f64::from(k) - 1.0),
            PALM_PLACE,
            0.0,
            PALM,
        ));
    }
    all
}
