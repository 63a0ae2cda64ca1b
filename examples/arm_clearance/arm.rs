//! The arm and what is around it: from joint angles to solids, and from these to one clearance.
use geograd::distance3::Apart;
use geograd::{Capsule3, Obb3, Plane3, Rotation3, Scalar, Shape, Vec3};

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
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
pub struct Solids<S> {
    /// Shoulder, upper arm, forearm and both links of the wrist.
    pub links: [Capsule3<S>; 5],
    /// The box that the flange carries.
    pub hand: Obb3<S>,
}

/// The solids of an arm with its joints at some angles, in metres.
pub fn solids<S: Scalar>(joints: Joints<S>, radius: S) -> Solids<S> {
    let mut frames = [Frame::base(); 7];
    for (k, &row) in ROWS.iter().enumerate() {
        frames[k + 1] = frames[k].next(joints[k], row);
    }
    // Shoulder, elbow and wrist turn about parallel axes; links lie beside their frames along these.
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

/// The surroundings of the arm.
#[derive(Clone, Copy)]
pub struct Scene<S> {
    pub floor: Plane3<S>,
    /// Under the base. Shoulder and upper arm turn beside it at a fixed distance, so they are no pairs with it.
    pub pedestal: Obb3<S>,
    /// A bench, and a crate that is turned.
    pub boxes: [Obb3<S>; 2],
    /// A post and a pipe.
    pub rods: [Capsule3<S>; 2],
}

/// The surroundings in metres, as constants: records simplify by them.
pub fn scene<S: Scalar>() -> Scene<S> {
    let v = |x: f64, y: f64, z: f64| Vec3::new(S::lit(x), S::lit(y), S::lit(z));
    let turned = |degrees: f64| {
        let half = degrees.to_radians() / 2.0;
        let (sin, cos) = half.sin_cos();
        Rotation3::new(S::lit(cos), S::zero(), S::zero(), S::lit(sin))
    };
    Scene {
        floor: Plane3::new(v(0.0, 0.0, 1.0), S::zero()),
        pedestal: Obb3::new(v(0.0, 0.0, MOUNT / 2.0), v(0.16, 0.16, MOUNT), turned(0.0)),
        boxes: [
            Obb3::new(v(0.6, -0.1, 0.15), v(0.5, 1.2, 0.3), turned(0.0)),
            Obb3::new(v(0.58, 0.02, 0.4), v(0.26, 0.2, 0.2), turned(30.0)),
        ],
        rods: [
            Capsule3::new(v(0.62, -0.28, 0.3), v(0.62, -0.28, 0.6), S::lit(0.04)),
            Capsule3::new(v(0.2, -0.8, 1.05), v(0.5, 0.8, 1.05), S::lit(0.05)),
        ],
    }
}

/// Something that can collide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Link(usize),
    Hand,
    Floor,
    Pedestal,
    Solid(usize),
    Rod(usize),
}
use Part::{Floor, Hand, Link, Pedestal, Rod, Solid};

/// How many pairs there are.
pub const COUNT: usize = 39;

/// All pairs that can collide: moving parts with what is around them, and links that are not neighbours.
pub const PAIRS: [(Part, Part); COUNT] = {
    let mut pairs = [(Hand, Pedestal); COUNT];
    let (mut n, mut k) = (1, 0);
    while k < 6 {
        let part = if k < 5 { Link(k) } else { Hand };
        let mut i = 0;
        while i < 2 {
            (pairs[n], pairs[n + 1]) = ((part, Rod(i)), (part, Solid(i)));
            (i, n) = (i + 1, n + 2);
        }
        // The height of the shoulder is fixed.
        if k > 0 {
            pairs[n] = (part, Floor);
            n += 1;
        }
        if k > 1 && k < 5 {
            pairs[n] = (part, Pedestal);
            n += 1;
        }
        if k > 2 {
            (pairs[n], pairs[n + 1]) = ((Link(0), part), (Link(1), part));
            n += 2;
        }
        k += 1;
    }
    assert!(n == COUNT);
    pairs
};

/// A part as a shape.
#[derive(Clone, Copy)]
pub enum Form<S> {
    Round(Capsule3<S>),
    Cubic(Obb3<S>),
    Flat(Plane3<S>),
}

/// The shape of a part.
pub fn form<S: Scalar>(part: Part, arm: &Solids<S>, around: &Scene<S>) -> Form<S> {
    match part {
        Link(k) => Form::Round(arm.links[k]),
        Hand => Form::Cubic(arm.hand),
        Floor => Form::Flat(around.floor),
        Pedestal => Form::Cubic(around.pedestal),
        Solid(k) => Form::Cubic(around.boxes[k]),
        Rod(k) => Form::Round(around.rods[k]),
    }
}

/// The signed distances of all pairs, in metres.
pub fn distances<S: Scalar>(joints: Joints<S>, radius: S) -> [S; COUNT] {
    let (arm, around) = (solids(joints, radius), scene::<S>());
    PAIRS.map(|(a, b)| {
        use Form::{Cubic, Flat, Round};
        match (form(a, &arm, &around), form(b, &arm, &around)) {
            (Round(a), Round(b)) => a.signed_distance(b),
            (Round(a), Cubic(b)) | (Cubic(b), Round(a)) => a.signed_distance(b),
            (Cubic(a), Cubic(b)) => a.signed_distance(b),
            (Round(a), Flat(b)) | (Flat(b), Round(a)) => a.signed_distance(b),
            (Cubic(a), Flat(b)) | (Flat(b), Cubic(a)) => a.signed_distance(b),
            // Two half-spaces overlap without end.
            (Flat(_), Flat(_)) => S::lit(-S::format().largest()),
        }
    })
}

/// The clearance of the arm in metres: the least signed distance of all [`PAIRS`]. Where the arm collides, minus the
/// depth of the deepest pair.
///
/// The least of all pairs shares ties: where two pairs are equally near, each has half of the derivative.
pub fn clearance<S: Scalar>(joints: Joints<S>, radius: S) -> S {
    let [first, rest @ ..] = distances(joints, radius);
    rest.into_iter().fold(first, S::least)
}
