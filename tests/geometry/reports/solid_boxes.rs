//! Overlaps and scores of boxes in space.
use super::Report;
use super::boxes::{ORACLE, SELF};
use crate::oracle_solid;
use geograd::kernels::methods::Giou as _;
use geograd::{Obb3, Vec2, Vec3, YawBox3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// A box from the corners of its bottom face, two heights, in single precision.
fn standing(corners: [[f64; 2]; 4], [low, high]: [f64; 2]) -> YawBox3<f32> {
    let [a, b, c, d] = corners.map(|[x, y]| Vec2::new(x, y));
    let at = (a + b + c + d) * 0.25;
    let (along, across) = (b - a, c - b);
    YawBox3::new(
        Vec3::new(at.x as f32, at.y as f32, ((low + high) / 2.0) as f32),
        Vec3::new(
            along.length() as f32,
            across.length() as f32,
            (high - low) as f32,
        ),
        along.y.atan2(along.x) as f32,
    )
}

fn solid(b: YawBox3<f32>) -> Obb3<f64> {
    let v = |v: Vec3<f32>| Vec3::new(v.x.into(), v.y.into(), v.z.into());
    Obb3::from(YawBox3::new(v(b.center), v(b.size), b.heading.into()))
}

fn solids([a, b]: [YawBox3<f32>; 2]) -> Vec<f64> {
    vec![oracle_solid::overlap(solid(a), solid(b))[3]]
}

fn yaw([a, b]: [YawBox3<f32>; 2]) -> Vec<f64> {
    vec![a.iou(b).into()]
}

fn cars() -> [YawBox3<f32>; 2] {
    [
        standing(
            [
                [19.7804, -4.8337],
                [24.3597, -4.8431],
                [24.3648, -2.3689],
                [19.7855, -2.3595],
            ],
            [-1.2441, 0.8192],
        ),
        standing(
            [
                [19.8159, -4.8659],
                [24.4267, -4.8794],
                [24.4341, -2.3641],
                [19.8233, -2.3506],
            ],
            [-1.25, 0.85],
        ),
    ]
}

fn plates() -> [YawBox3<f32>; 2] {
    [
        standing(
            [
                [844.4573, 545.2485],
                [876.2981, 549.768],
                [865.3027, 627.2315],
                [833.4619, 622.712],
            ],
            [-1.0, 1.0],
        ),
        standing(
            [
                [847.1049, 545.0182],
                [878.9629, 550.236],
                [866.222, 628.0273],
                [834.364, 622.8095],
            ],
            [-1.0, 1.0],
        ),
    ]
}

fn parked() -> [YawBox3<f32>; 2] {
    [
        standing(
            [
                [-105.6248, -32.7026],
                [-106.469, -30.8895],
                [-111.0017, -33.0001],
                [-110.1575, -34.8132],
            ],
            [-3.0279, -1.2279],
        ),
        standing(
            [
                [-105.5094, -32.9504],
                [-106.4272, -30.9793],
                [-110.9599, -33.0899],
                [-110.0421, -35.0609],
            ],
            [-3.1916, -1.0641],
        ),
    ]
}

fn city() -> YawBox3<f32> {
    let corners = [
        [-24931.9805, 40325.3438],
        [-24931.1562, 40325.4336],
        [-24931.3105, 40326.8789],
        [-24932.1348, 40326.7891],
    ];
    standing(corners, [-254.5391, -253.7584])
}

fn upright_yaw(x: [f64; 7]) -> YawBox3<f64> {
    YawBox3::new(
        Vec3::new(x[0], x[1], x[2]),
        Vec3::new(x[3], x[4], x[5]),
        x[6],
    )
}

fn once() -> [YawBox3<f32>; 2] {
    let at = |x: [f32; 7]| {
        YawBox3::new(
            Vec3::new(x[0], x[1], x[2]),
            Vec3::new(x[3], x[4], x[5]),
            x[6],
        )
    };
    [
        at([
            23.305_380_2,
            22.853_183,
            -1.199_327_3,
            0.303_450_3,
            0.271_859_98,
            0.817_803_26,
            4.712_389,
        ]),
        at([
            23.305_382,
            22.853_184,
            -1.199_327_2,
            0.303_450_29,
            0.271_859_97,
            0.817_803_26,
            4.712_413_3,
        ]),
    ]
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "lilanxiao/Rotated_IoU",
            number: 27,
            about: "IoU in space 0",
            asked: "IoU of cubes turned by π/4 and by −π/4",
            source: "closed form: the same cube",
            found: || {
                vec![
                    upright_yaw([0., 0., 0., 2., 2., 2., FRAC_PI_4])
                        .iou(upright_yaw([0., 0., 0., 2., 2., 2., -FRAC_PI_4])),
                ]
            },
            right: || vec![1.0],
            within: 1e-12,
        },
        Report {
            library: "open-mmlab/mmcv",
            number: 2715,
            about: "a wrong value among five pairs, one of them with a turn by π",
            asked: "IoU of a unit cube with itself turned by π, one twice as high, one turned by π/4, one shifted by half of each side, one apart",
            source: "closed forms 1, 1/2, 1/√2, 1/15, 0",
            found: || {
                let cube = upright_yaw([0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 0.0]);
                [
                    [0.5, 0.5, 0.5, 1., 1., 1., PI],
                    [0.5, 0.5, 0.5, 1., 1., 2., FRAC_PI_2],
                    [0.5, 0.5, 0.5, 1., 1., 1., FRAC_PI_4],
                    [1., 1., 1., 1., 1., 1., 0.],
                    [-1.5, -1.5, -1.5, 2.5, 2.5, 2.5, 0.],
                ]
                .map(|x| cube.iou(upright_yaw(x)))
                .to_vec()
            },
            right: || vec![1.0, 0.5, 0.5_f64.sqrt(), 1.0 / 15.0, 0.0],
            within: 1e-12,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 1082,
            about: "IoU 1.238",
            asked: "IoU of two cars, `f32`",
            source: ORACLE,
            found: || yaw(cars()),
            right: || solids(cars()),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 1429,
            about: "IoU 0.6088",
            asked: "IoU of two plates 78 long and 2 high, 850 from the origin, `f32`",
            source: ORACLE,
            found: || yaw(plates()),
            right: || solids(plates()),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 1287,
            about: "IoU 2.287",
            asked: "IoU of two parked cars, `f32`",
            source: ORACLE,
            found: || yaw(parked()),
            right: || solids(parked()),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 1551,
            about: "IoU 0.5",
            asked: "IoU of a box with itself, 47 km from the origin, `f32`",
            source: SELF,
            found: || yaw([city(), city()]),
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 992,
            about: "an infinite IoU one way round, 0 the other",
            asked: "IoU of a box and one of size zero in it, both ways round",
            source: "definition: no volume is shared",
            found: || {
                let (a, b) = (
                    upright_yaw([0., 0., 0., 2., 2., 1., 0.]),
                    upright_yaw([0.; 7]),
                );
                vec![a.iou(b), b.iou(a)]
            },
            right: || vec![0.0, 0.0],
            within: 0.0,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 1054,
            about: "volume 0.1627",
            asked: "volume shared by unit cubes shifted by (1/2, 1/2, 0)",
            source: "closed form 1/4",
            found: || {
                vec![
                    Obb3::from(upright_yaw([0.5, 0.5, 0.5, 1., 1., 1., 0.])).intersection_volume(
                        Obb3::from(upright_yaw([1., 1., 0.5, 1., 1., 1., 0.])),
                    ),
                ]
            },
            right: || vec![0.25],
            within: 1e-15,
        },
        Report {
            library: "facebookresearch/votenet",
            number: 150,
            about: "IoU 1.491",
            asked: "IoU of an upright box with itself",
            source: SELF,
            found: || {
                let b = upright_yaw([11.897, 3.263, -2.118, 0.306, 0.19, 0.382, 0.0]);
                vec![b.iou(b)]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "AlienCat-K/3D-IoU-Python",
            number: 2,
            about: "IoU 1.101",
            asked: "IoU of a turned box with itself",
            source: SELF,
            found: || {
                let b = upright_yaw([
                    29.781_969_07,
                    15.194_025_04,
                    0.862_522_3,
                    1.815_885_19,
                    0.759_254_04,
                    0.743_414_46,
                    0.319_246_08,
                ]);
                vec![b.iou(b)]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "once-for-auto-driving/once_devkit",
            number: 27,
            about: "IoU −1.03",
            asked: "IoU of two boxes that differ by 10⁻⁵, `f32`",
            source: ORACLE,
            found: || yaw(once()),
            right: || solids(once()),
            within: 4e-6,
        },
        Report {
            library: "tusen-ai/SimpleTrack",
            number: 39,
            about: "GIoU 0.59: heights that include one another",
            asked: "GIoU of a cube of side 2 and a box 2 by 1 by 1 at one centre",
            source: "closed form 2/8",
            found: || {
                vec![
                    upright_yaw([0., 0., 0., 2., 2., 2., 0.])
                        .giou(upright_yaw([0., 0., 0., 2., 1., 1., 0.])),
                ]
            },
            right: || vec![0.25],
            within: 1e-15,
        },
    ]
}
