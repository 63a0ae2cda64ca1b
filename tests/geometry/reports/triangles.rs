//! Distances of points from triangles of space.
use super::Report;
use super::space::{FEATURES, at, wide};
use crate::space::oracle::{self, vector};
use geograd::distance3::distance;
use geograd::{Segment3, Triangle3, Vec3};

fn degenerate() -> (Vec3<f64>, [Vec3<f64>; 3]) {
    let b = at([-0.569_999_993, -8.100_000_38, 16.607_000_4]);
    (
        at([1.100_000_02, -7.900_000_1, 16.587_999_3]),
        [at([2.276_999_95, -7.900_000_1, 16.318_000_8]), b, b],
    )
}

type Seen = ([f64; 3], [[f64; 3]; 3]);

const SMALL: Seen = (
    [-1.0; 3],
    [
        [-0.163, -0.6029, 0.1093],
        [-0.1633, -0.6029, 0.1095],
        [-0.1641, -0.6041, 0.1075],
    ],
);
const CORNER: Seen = (
    [5.0; 3],
    [
        [10.673_999_79, 8.612_259_86, 0.771_466_02],
        [10.672_699_93, 8.611_419_68, 0.771_977_01],
        [10.673_999_79, 8.612_259_86, 0.771_977_01],
    ],
);
const FACE: Seen = (
    [-0.3623, -0.534, 0.7727],
    [
        [-0.0021, -0.3769, 0.7146],
        [-0.0161, -0.3771, 0.7146],
        [-0.0021, -0.3771, 0.7147],
    ],
);

/// The squared distance in single precision, in two orders of the corners.
fn near((p, corners): Seen) -> Vec<f64> {
    let narrow = |v: [f64; 3]| Vec3::new(v[0] as f32, v[1] as f32, v[2] as f32);
    let [a, b, c] = corners.map(narrow);
    let of = |t: Triangle3<f32>| f64::from(distance(narrow(p), t));
    vec![of(Triangle3::new(a, b, c)), of(Triangle3::new(c, a, b))]
}

fn near_right((p, corners): Seen) -> Vec<f64> {
    let narrow = |v: [f64; 3]| vector(v.map(|x| f64::from(x as f32)));
    vec![oracle::hulls(&[narrow(p)], &corners.map(narrow), false); 2]
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "dimforge/parry",
            number: 76,
            about: "0 for a triangle whose corners are two",
            asked: "the distance of a point from such a triangle, and from the segment that it is",
            source: FEATURES,
            found: || {
                let (p, [a, b, c]) = degenerate();
                vec![
                    distance(p, Triangle3::new(a, b, c)),
                    distance(p, Segment3::new(a, b)),
                ]
            },
            right: || {
                let (p, [a, b, _]) = degenerate();
                vec![oracle::hulls(&[wide(p)], &[wide(a), wide(b)], false); 2]
            },
            within: 1e-14,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 613,
            about: "a wrong distance for a small triangle",
            asked: "the distance of a point from a triangle of size 10⁻³, in two orders of the corners, `f32`",
            source: FEATURES,
            found: || near(SMALL),
            right: || near_right(SMALL),
            within: 1e-6,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 698,
            about: "0.0042, squared",
            asked: "the distance of a point from a triangle of size 10⁻³, in two orders of the corners, `f32`",
            source: FEATURES,
            found: || near(CORNER),
            right: || near_right(CORNER),
            within: 4e-6,
        },
        Report {
            library: "facebookresearch/pytorch3d",
            number: 682,
            about: "0.0005 or 0.2957 by the order of corners, squared",
            asked: "the distance of a point from a triangle, in two orders of the corners, `f32`",
            source: FEATURES,
            found: || near(FACE),
            right: || near_right(FACE),
            within: 1e-6,
        },
    ]
}
