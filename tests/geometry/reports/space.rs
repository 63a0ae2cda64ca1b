//! Distances and contacts in space.
use super::Report;
use crate::space::oracle::{self, Boxed, Vector, times, vector};
use geograd::distance3::{closest_points, distance, penetration, signed_distance};
use geograd::{
    Aabb3, Capsule3, Cylinder, Line3, Obb3, Rotation3, Segment3, Sphere, Triangle3, Vec3,
};

pub const FEATURES: &str = "all pairs of features in numbers of twice the digits";

pub fn at([x, y, z]: [f64; 3]) -> Vec3<f64> {
    Vec3::new(x, y, z)
}

fn upright(center: [f64; 3], size: [f64; 3]) -> Obb3<f64> {
    Obb3::new(at(center), at(size), Rotation3::identity())
}

pub fn wide(v: Vec3<f64>) -> Vector {
    vector([v.x, v.y, v.z])
}

/// A box as the oracle has it.
fn boxed(b: Obb3<f64>) -> Boxed {
    let q = b.rotation;
    let [x, y, z] = oracle::axes([q.w, q.x, q.y, q.z]);
    let half = |axis: Vector, size: f64| times(axis, oracle::Wide::of(size / 2.0));
    Boxed {
        center: wide(b.center),
        arms: [half(x, b.size.x), half(y, b.size.y), half(z, b.size.z)],
    }
}

fn shelf() -> [Obb3<f64>; 2] {
    [
        upright([1.625, 0.0, 0.5], [2.75, 6.0, 0.05]),
        Obb3::new(
            at([0.192_074, -0.277_87, 0.273_546]),
            at([0.424, 0.15, 0.1686]),
            Rotation3::new(0.672_811, 0.340_674, 0.155_066, 0.638_138),
        ),
    ]
}

/// Two cubes of one turn, the first shifted by its own side along its own y axis.
fn kissing(rows: [[f64; 3]; 3], side: f64, shift: [f64; 3]) -> [Obb3<f64>; 2] {
    let turn = Rotation3::from_matrix(rows);
    let size = at([side; 3]);
    [
        Obb3::new(at(shift), size, turn),
        Obb3::new(Vec3::zero(), size, turn),
    ]
}

fn stacked() -> [Obb3<f64>; 2] {
    let rows = [
        [
            0.940_960_632_174_177_8,
            0.292_968_402_372_895,
            0.169_595_415_861_748_12,
        ],
        [
            -0.235_698_368_412_998_8,
            0.926_615_235_958_484_3,
            -0.292_968_402_372_895_07,
        ],
        [
            -0.242_980_179_903_263_9,
            0.235_698_368_412_998_8,
            0.940_960_632_174_177_8,
        ],
    ];
    let up = 1.308_924_592_103_249_7 - 1.25;
    kissing(
        rows,
        0.25,
        [0.073_242_100_093_223_82, 0.231_653_808_989_621_23, up],
    )
}

fn slanted() -> [Obb3<f64>; 2] {
    let rows = [
        [
            0.961_939_766_255_643_5,
            0.154_012_799_157_373_6,
            0.225_725_372_503_289_2,
        ],
        [
            -0.191_341_716_182_544_87,
            0.969_364_949_512_839_1,
            0.154_012_799_157_373_6,
        ],
        [
            -0.195_090_322_016_128_22,
            -0.191_341_716_182_544_87,
            0.961_939_766_255_643_5,
        ],
    ];
    kissing(
        rows,
        0.5,
        [
            0.077_006_399_578_687,
            0.484_682_474_756_419_5,
            1.154_329_141_908_727_6 - 1.25,
        ],
    )
}

fn standing(lift: f64) -> (Capsule3<f64>, Triangle3<f64>) {
    let way = at([-1.0, -0.9, -1.0]);
    let corner = |x: [f64; 3]| at(x) + way;
    (
        Capsule3::new(at([0.0, -0.5, 0.0]), at([0.0, 0.5, 0.0]), 0.5),
        Triangle3::new(
            corner([10.0, 0.0, -5.0]),
            corner([10.0, 0.0, 5.0]),
            corner([-10.0, lift, 5.0]),
        ),
    )
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "flexible-collision-library/fcl",
            number: 508,
            about: "3.162",
            asked: "the distance of unit cubes 4 apart along y, along z",
            source: "closed form 4 − 1",
            found: || {
                [[0., 4., 0.], [0., 0., 4.]]
                    .map(|c| distance(upright(c, [1.; 3]), upright([0.; 3], [1.; 3])))
                    .to_vec()
            },
            right: || vec![3.0; 2],
            within: 0.0,
        },
        Report {
            library: "flexible-collision-library/fcl",
            number: 127,
            about: "wrong closest points",
            asked: "distance and closest points (their y) of a ball of radius 1 and a box 10 by 2 by 10",
            source: "closed form: 3, from y = 1 to y = 4",
            found: || {
                let (a, b) = (
                    Sphere::new(Vec3::zero(), 1.0),
                    upright([0., 5., 3.], [10., 2., 10.]),
                );
                let pair = closest_points(a, b);
                vec![
                    distance(a, b),
                    pair.on_a.x,
                    pair.on_a.y,
                    pair.on_a.z,
                    pair.on_b.y,
                ]
            },
            right: || vec![3.0, 0.0, 1.0, 0.0, 4.0],
            within: 1e-15,
        },
        Report {
            library: "flexible-collision-library/fcl",
            number: 275,
            about: "25, and points outside",
            asked: "the distance of balls of radius 20 and 10, 40 apart, and y of the closest points",
            source: "closed form: 10, 20, 30",
            found: || {
                let (a, b) = (
                    Sphere::new(Vec3::zero(), 20.0),
                    Sphere::new(at([0., 40., 0.]), 10.0),
                );
                let pair = closest_points(a, b);
                vec![distance(a, b), pair.on_a.y, pair.on_b.y]
            },
            right: || vec![10.0, 20.0, 30.0],
            within: 1e-14,
        },
        Report {
            library: "flexible-collision-library/fcl",
            number: 293,
            about: "NaN closest points",
            asked: "the distance of two boxes, and that of their closest points",
            source: FEATURES,
            found: || {
                let [a, b] = shelf();
                let pair = closest_points(a, b);
                vec![distance(a, b), pair.on_a.distance(pair.on_b)]
            },
            right: || {
                let [a, b] = shelf();
                vec![oracle::boxes(&boxed(a), &boxed(b)); 2]
            },
            within: 1e-14,
        },
        Report {
            library: "flexible-collision-library/fcl",
            number: 493,
            about: "an exception",
            asked: "the distances of cubes of sides 1/2 and 1/4 that touch with whole faces",
            source: "definition: 0, but for the rounding of the given matrices",
            found: || [slanted(), stacked()].map(|[a, b]| distance(a, b)).to_vec(),
            right: || vec![0.0; 2],
            within: 2e-15,
        },
        Report {
            library: "dartsim/dart",
            number: 3343,
            about: "√2: the axis was sampled at five points",
            asked: "the distance of a segment from x = −8 to 12 at y = 2 and a cube of side 2",
            source: "closed form 1",
            found: || {
                vec![distance(
                    Segment3::new(at([-8., 2., 0.]), at([12., 2., 0.])),
                    upright([0.; 3], [2.; 3]),
                )]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "dimforge/parry",
            number: 70,
            about: "no overlap in places of a sweep",
            asked: "how many of 200 places of a capsule in a cube's top face are inside, and the largest error of the depth",
            source: "closed form: height less 1/2 and the radius",
            found: || {
                let ground = upright([0., -50., 0.], [100.; 3]);
                let places = (0..200).map(|k| -0.5 + f64::from(k) / 200.0);
                let found: Vec<(f64, f64)> = places
                    .map(|y| {
                        (
                            y,
                            signed_distance(
                                Capsule3::new(at([0., y - 0.5, 0.]), at([0., y + 0.5, 0.]), 0.5),
                                ground,
                            ),
                        )
                    })
                    .collect();
                vec![
                    found.iter().filter(|(_, d)| *d < 0.0).count() as f64,
                    found
                        .iter()
                        .map(|(y, d)| (d - (y - 1.0)).abs())
                        .fold(0.0, f64::max),
                ]
            },
            right: || vec![200.0, 0.0],
            within: 1e-13,
        },
        Report {
            library: "mikedh/trimesh",
            number: 73,
            about: "0: the point is in the plane of a face",
            asked: "the signed distance of (3, 2, 2) from the cube from 0 to 2",
            source: "closed form 1",
            found: || {
                vec![signed_distance(
                    at([3., 2., 2.]),
                    Aabb3::new(Vec3::zero(), at([2.; 3])),
                )]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "google-deepmind/mujoco",
            number: 1473,
            about: "1",
            asked: "the distance of a capsule of radius 0.15 above a cube of side 0.2",
            source: "closed form 1 − 0.3 − 0.1",
            found: || {
                vec![distance(
                    Capsule3::new(at([0., 0., 0.85]), at([0., 0., 1.15]), 0.15),
                    upright([0.; 3], [0.2; 3]),
                )]
            },
            right: || vec![0.6],
            within: 1e-15,
        },
        Report {
            library: "coal-library/coal",
            number: 344,
            about: "a NaN normal",
            asked: "depth and direction of overlapping balls of radius 1/2, 0.9 apart",
            source: "closed form: 0.1, (1, 0, 0)",
            found: || {
                let found = penetration(
                    Sphere::new(at([-0.9, 0., 0.]), 0.5),
                    Sphere::new(Vec3::zero(), 0.5),
                );
                vec![
                    found.depth,
                    found.direction.x,
                    found.direction.y,
                    found.direction.z,
                ]
            },
            right: || vec![0.1, 1.0, 0.0, 0.0],
            within: 1e-15,
        },
        Report {
            library: "coal-library/coal",
            number: 351,
            about: "a doubt that a ball and a cylinder overlap by 0.06",
            asked: "the signed distance of a ball of radius 55 and a cylinder of radius 136",
            source: "closed form: the distance from the axis less both radii",
            found: || {
                vec![signed_distance(
                    Sphere::new(at([140.834, -45.449, 905.432]), 55.0),
                    Cylinder::new(at([0., -50., 776.5]), at([0., 50., 776.5]), 136.0),
                )]
            },
            right: || vec![140.834_f64.hypot(905.432 - 776.5) - 136.0 - 55.0],
            within: 1e-12,
        },
        Report {
            library: "bepu/bepuphysics2",
            number: 101,
            about: "a wrong contact where the axis is nearly normal to the triangle",
            asked: "the signed distances of a capsule of radius 1/2 and a triangle, level and tilted by 10⁻⁶",
            source: FEATURES,
            found: || {
                [0.0, 1e-6]
                    .map(|lift| {
                        let (a, b) = standing(lift);
                        signed_distance(a, b)
                    })
                    .to_vec()
            },
            right: || {
                [0.0, 1e-6]
                    .map(|lift| {
                        let (a, b) = standing(lift);
                        oracle::hulls(&[wide(a.start), wide(a.end)], &b.corners().map(wide), true)
                            - 0.5
                    })
                    .to_vec()
            },
            within: 1e-14,
        },
        Report {
            library: "godotengine/godot",
            number: 55383,
            about: "0",
            asked: "the distance of two parallel segments",
            source: "closed form 2.9888",
            found: || {
                vec![distance(
                    Segment3::new(at([0., -2.5, 0.]), at([0., 2.5, 0.])),
                    Segment3::new(at([2.9888, -5.1938, 0.]), at([2.9888, 4.8062, 0.])),
                )]
            },
            right: || vec![2.9888],
            within: 1e-15,
        },
        Report {
            library: "godotengine/godot",
            number: 55617,
            about: "0, in a test of its own",
            asked: "the distance of two parallel segments of opposite directions",
            source: "closed form 2",
            found: || {
                vec![distance(
                    Segment3::new(at([1., -2., 0.]), at([1., 2., 0.])),
                    Segment3::new(at([-1., 2., 0.]), at([-1., -2., 0.])),
                )]
            },
            right: || vec![2.0],
            within: 0.0,
        },
        Report {
            library: "bdaiinstitute/spatialmath-python",
            number: 224,
            about: "2.5",
            asked: "the distance of two skew lines",
            source: "closed form 2",
            found: || {
                vec![distance(
                    Line3::new(Vec3::zero(), at([1., 0., 0.])),
                    Line3::new(at([0., 0., 2.]), at([0.6, 0.8, 0.])),
                )]
            },
            right: || vec![2.0],
            within: 1e-15,
        },
    ]
}
