//! The arm and what is around it: from joint angles to solids, and from these to one clearance.
use geograd::distance3::Apart;
use geograd::{Aabb3, Capsule3, Obb3, Plane3, Rotation3, Scalar, Vec3};

/// The angles of the joints, in radians.
pub type Joints<S> = [S; 6];

/// The lengths of a UR5 in metres (Universal Robots, parameters of Denavit and Hartenberg): along the old z axis and
/// along the new x axis, and the quarter turns about that axis.
const ROWS: [(f64, f64, i8); 6] = [
    (0.089159, 0.0, 1),
    (0.0, -0.425, 0),
    (0.0, -0.39225, 0),
    (0.10915, 0.0, 1),
    (0.09465, 0.0, -1),
    (0.0823, 0.0, 0),
];
/// How far upper arm and forearm are beside the plane of the shoulder (UR5, its published description). With the wrist
/// they add up to the fourth row.
const BESIDE: [f64; 2] = [0.13585, 0.01615];
/// The base is so high above the floor.
pub const MOUNT: f64 = 0.35;
/// The size of the hand, which is a box ahead of the flange.
const HAND: [f64; 3] = [0.16, 0.07, 0.12];
/// The radius of the links, in metres.
pub const RADIUS: f64 = 0.055;

/// A place with three axes.
#[derive(Clone, Copy)]
struct Frame<S> {
    at: Vec3<S>,
    axes: [Vec3<S>; 3],
}

impl<S: Scalar> Frame<S> {
    fn base() -> Self {
        let (zero, one) = (S::zero(), S::one());
        Frame {
            at: Vec3::new(zero, zero, S::lit(MOUNT)),
            axes: [
                Vec3::new(one, zero, zero),
                Vec3::new(zero, one, zero),
                Vec3::new(zero, zero, one),
            ],
        }
    }
    /// The next frame, with the joint between at an angle.
    fn next(self, angle: S, (along_z, along_x, quarter): (f64, f64, i8)) -> Self {
        let ([x, y, z], (sin, cos)) = (self.axes, angle.sin_cos());
        let (x, y) = (x * cos + y * sin, y * cos - x * sin);
        let at = self.at + z * S::lit(along_z) + x * S::lit(along_x);
        let axes = match quarter {
            0 => [x, y, z],
            1 => [x, z, -y],
            _ => [x, -z, y],
        };
        Frame { at, axes }
    }
    /// A point beside the frame, along its z axis.
    fn beside(self, length: f64) -> Vec3<S> {
        self.at + self.axes[2] * S::lit(length)
    }
}

/// The arm as solids.
#[derive(Clone, Copy)]
pub struct Solids<S> {
    /// Shoulder, upper arm, forearm and both links of the wrist.
    pub links: [Capsule3<S>; 5],
    pub hand: Obb3<S>,
}

/// The solids of an arm with its joints at some angles, in metres.
pub fn solids<S: Scalar>(joints: Joints<S>, radius: S) -> Solids<S> {
    let mut frames = [Frame::base(); 7];
    for (k, &row) in ROWS.iter().enumerate() {
        frames[k + 1] = frames[k].next(joints[k], row);
    }
    // The first and the second joint turn about axes that do not move along the upper arm.
    let [_, shoulder, elbow, wrist, turn, last, flange] = frames;
    let [above, below] = BESIDE;
    let points = [
        [shoulder.at, shoulder.beside(above)],
        [shoulder.beside(above), elbow.beside(above)],
        [elbow.beside(below), wrist.beside(below)],
        [wrist.beside(below), turn.at],
        [turn.at, last.at],
    ];
    let size = Vec3::new(S::lit(HAND[0]), S::lit(HAND[1]), S::lit(HAND[2]));
    let center = flange.beside(0.5 * HAND[2]);
    Solids {
        links: points.map(|[start, end]| Capsule3::new(start, end, radius)),
        hand: Obb3::new(center, size, Rotation3::from_axes(flange.axes)),
    }
}

/// What is around the arm.
#[derive(Clone, Copy)]
pub struct Scene<S> {
    pub floor: Plane3<S>,
    /// What the arm stands on. Shoulder and upper arm are always beside it, so nobody asks how near.
    pub pedestal: Aabb3<S>,
    /// A bench, and a crate that is turned.
    pub boxes: [Obb3<S>; 2],
    /// A post and a pipe.
    pub rods: [Capsule3<S>; 2],
}

/// The place in which the arm works, in metres.
pub fn scene<S: Scalar>() -> Scene<S> {
    let v = |x: f64, y: f64, z: f64| Vec3::new(S::lit(x), S::lit(y), S::lit(z));
    let turned = |degrees: f64| {
        let half = degrees.to_radians() / 2.0;
        let (sin, cos) = half.sin_cos();
        Rotation3::new(S::lit(cos), S::zero(), S::zero(), S::lit(sin))
    };
    Scene {
        floor: Plane3::new(v(0.0, 0.0, 1.0), S::zero()),
        pedestal: Aabb3::new(v(-0.08, -0.08, 0.0), v(0.08, 0.08, MOUNT)),
        boxes: [
            Obb3::new(v(0.6, -0.1, 0.15), v(0.5, 1.2, 0.3), turned(0.0)),
            Obb3::new(v(0.58, 0.02, 0.4), v(0.26, 0.2, 0.2), turned(30.0)),
        ],
        rods: [
            Capsule3::new(v(0.62, -0.28, 0.3), v(0.62, -0.28, 0.75), S::lit(0.04)),
            Capsule3::new(v(0.2, -0.8, 1.05), v(0.5, 0.8, 1.05), S::lit(0.05)),
        ],
    }
}

/// The clearance of the arm in metres: the least signed distance of its solids from what is around it, and of its hand
/// and wrist from shoulder and upper arm. Negative where it collides: minus the depth of the deepest pair.
///
/// The least of all pairs shares ties: of pairs that are equally near each has half of the derivative.
pub fn clearance<S: Scalar>(joints: Joints<S>, radius: S) -> S {
    let (arm, around) = (solids(joints, radius), scene::<S>());
    let [shoulder, upper, forearm, wrist, last] = arm.links;
    let mut found = around.floor.signed_distance(arm.hand);
    let mut add = |distance: S| found = found.least(distance);
    for rod in around.rods {
        arm.links
            .into_iter()
            .for_each(|link| add(link.signed_distance(rod)));
        add(rod.signed_distance(arm.hand));
    }
    for solid in around.boxes {
        arm.links
            .into_iter()
            .for_each(|link| add(link.signed_distance(solid)));
        add(arm.hand.signed_distance(solid));
    }
    for link in [upper, forearm, wrist, last] {
        add(around.floor.signed_distance(link));
    }
    for link in [forearm, wrist, last] {
        add(link.signed_distance(around.pedestal));
    }
    add(arm.hand.signed_distance(around.pedestal));
    // The arm against itself, where links are not neighbours.
    for link in [shoulder, upper] {
        add(link.signed_distance(wrist));
        add(link.signed_distance(last));
        add(link.signed_distance(arm.hand));
    }
    found
}
