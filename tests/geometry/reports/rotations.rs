//! Rotations, their angles and derivatives.
use super::{Report, flag};
use geograd::{EulerOrder, Jet, Rotation3, Vec3};
use std::f64::consts::{FRAC_PI_2, PI};

const BACK: &str = "definition: the angles give the rotation back";

type Rotation = Rotation3<f64>;
type Matrix = [[f64; 3]; 3];

fn apart(a: Matrix, b: Matrix) -> f64 {
    a.iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

/// The largest difference of the matrices of a rotation and of the one that its angles give.
fn back(q: Rotation) -> f64 {
    let again = Rotation3::from_euler(EulerOrder::Zyx, q.euler(EulerOrder::Zyx));
    apart(q.matrix(), again.matrix())
}

/// The derivatives of the rotation vector by the quaternion: of x, y, z by themselves, and of x by w.
fn slopes(w: f64) -> Vec<f64> {
    let x: [Jet<f64, 4>; 4] = std::array::from_fn(|k| Jet::variable([w, 0.0, 0.0, 0.0][k], k));
    let v = Rotation3::new(x[0], x[1], x[2], x[3]).rotation_vector();
    vec![
        v.x.derivative[1],
        v.y.derivative[2],
        v.z.derivative[3],
        v.x.derivative[0],
    ]
}

/// The largest difference of a matrix from that of the rotation made of it.
fn rebuilt(m: Matrix) -> f64 {
    apart(Rotation3::from_matrix(m).matrix(), m)
}

const HALF: Matrix = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];

fn about_x(angle: f64) -> Rotation {
    Rotation3::from_axis_angle(Vec3::new(1.0, 0.0, 0.0), angle)
}

/// The rotation that takes vectors nearest to others.
fn aligned(pairs: &[([f64; 3], [f64; 3])]) -> Rotation {
    let sum = |k: usize| {
        pairs.iter().fold(Vec3::zero(), |sum, (to, from)| {
            sum + Vec3::new(to[0], to[1], to[2]) * from[k]
        })
    };
    Rotation3::nearest_to([sum(0), sum(1), sum(2)])
}

fn spun() -> [Rotation3<f32>; 2] {
    [
        Rotation3::new(
            -0.999_254_5,
            -0.011_218_898,
            -0.036_763_325,
            -0.003_614_953_5,
        ),
        Rotation3::new(
            -0.999_251_8,
            -0.011_407_853,
            -0.036_797_106,
            -0.003_429_236_4,
        ),
    ]
}

fn axes() -> [Vec3<f64>; 2] {
    [
        Vec3::new(
            0.524_890_544_902_786_2,
            -0.303_045_695_512_374_15,
            -0.795_395_010_233_474_1,
        ),
        Vec3::new(
            0.524_890_543_272_223_7,
            -0.303_045_698_336_590_56,
            -0.795_395_010_233_474,
        ),
    ]
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "kornia/kornia",
            number: 3949,
            about: "NaN derivatives",
            asked: "derivatives of the rotation vector by the quaternion, at no rotation; of the quaternion's x by the vector's, there",
            source: "closed form 2, 2, 2, 0; 1/2",
            found: || {
                let x: [Jet<f64, 3>; 3] = std::array::from_fn(|k| Jet::variable(0.0, k));
                let q = Rotation3::from_rotation_vector(Vec3::new(x[0], x[1], x[2]));
                [slopes(1.0), vec![q.x.derivative[0]]].concat()
            },
            right: || vec![2.0, 2.0, 2.0, 0.0, 0.5],
            within: 1e-15,
        },
        Report {
            library: "kornia/kornia",
            number: 4007,
            about: "NaN derivatives, by the arc cosine at 1",
            asked: "whether the angle, the vector and the three angles have finite derivatives at no rotation",
            source: "definition",
            found: || {
                let x: [Jet<f64, 4>; 4] =
                    std::array::from_fn(|k| Jet::variable([1.0, 0.0, 0.0, 0.0][k], k));
                let q = Rotation3::new(x[0], x[1], x[2], x[3]);
                let finite = |j: Jet<f64, 4>| j.derivative.iter().all(|d| d.is_finite());
                vec![
                    flag(finite(q.angle())),
                    flag(finite(q.rotation_vector().x)),
                    flag(q.euler(EulerOrder::Zyx).into_iter().all(finite)),
                ]
            },
            right: || vec![1.0; 3],
            within: 0.0,
        },
        Report {
            library: "kornia/kornia",
            number: 4237,
            about: "2 for all four",
            asked: "the derivative of the rotation vector's x by the quaternion's, at w = 1, −1, 2, −2",
            source: "closed form 2/w",
            found: || [1.0, -1.0, 2.0, -2.0].map(|w| slopes(w)[0]).to_vec(),
            right: || vec![2.0, -2.0, 1.0, -1.0],
            within: 1e-15,
        },
        Report {
            library: "kornia/kornia",
            number: 1653,
            about: "NaN derivatives",
            asked: "whether the quaternion of a half turn's matrix has finite derivatives",
            source: "definition",
            found: || {
                let m: [[Jet<f64, 9>; 3]; 3] = std::array::from_fn(|i| {
                    std::array::from_fn(|j| Jet::variable(HALF[i][j], 3 * i + j))
                });
                let q = Rotation3::from_matrix(m);
                vec![flag(
                    [q.w, q.x, q.y, q.z]
                        .iter()
                        .all(|n| n.derivative.iter().all(|d| d.is_finite())),
                )]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "kornia/kornia",
            number: 3950,
            about: "another rotation in 200 of 200 cases",
            asked: "the largest error of a matrix from its yaw, pitch and roll, at pitches of ±π/2 and 100 yaws and rolls",
            source: BACK,
            found: || {
                let cases = (0..200).map(|k| {
                    [
                        f64::from(k % 10) - 4.7,
                        if k < 100 { FRAC_PI_2 } else { -FRAC_PI_2 },
                        f64::from(k / 10 % 10) - 4.2,
                    ]
                });
                vec![
                    cases
                        .map(|angles| back(Rotation3::from_euler(EulerOrder::Zyx, angles)))
                        .fold(0.0, f64::max),
                ]
            },
            right: || vec![0.0],
            within: 2e-15,
        },
        Report {
            library: "dimforge/nalgebra",
            number: 1482,
            about: "yaw of the other sign",
            asked: "the error of a matrix from its angles, at pitch −90 and yaw 45 degrees",
            source: BACK,
            found: || {
                vec![back(Rotation3::from_euler(
                    EulerOrder::Zyx,
                    [PI / 4.0, -FRAC_PI_2, 0.0],
                ))]
            },
            right: || vec![0.0],
            within: 1e-15,
        },
        Report {
            library: "dimforge/nalgebra",
            number: 494,
            about: "NaN angles",
            asked: "the error of a matrix from its angles, of a quaternion near pitch π/2",
            source: BACK,
            found: || {
                vec![back(Rotation3::new(
                    -0.104_057_92,
                    -0.699_392_2,
                    -0.104_068_71,
                    0.699_422_84,
                ))]
            },
            right: || vec![0.0],
            within: 1e-14,
        },
        Report {
            library: "g-truc/glm",
            number: 461,
            about: "NaN pitch",
            asked: "the middle angle of two turns of 0.78539 about y, `f32`",
            source: "closed form 1.57078",
            found: || {
                let q = Rotation3::from_euler(EulerOrder::Zyx, [0.0_f32, 0.78539, 0.0]);
                vec![(q * q).euler(EulerOrder::Zyx)[1].into()]
            },
            right: || vec![1.57078],
            within: 1e-6,
        },
        Report {
            library: "dimforge/nalgebra",
            number: 661,
            about: "no rotation",
            asked: "the largest error of a half turn's matrix rebuilt from its rotation",
            source: "definition, to the rounding of the given matrix",
            found: || {
                vec![rebuilt([
                    [0.834_281_3, 0.0, -0.551_339],
                    [6.572_473e-8, -1.000_000_1, 9.945_408_4e-8],
                    [-0.551_339_03, 1.192_092_9e-7, -0.834_281_44],
                ])]
            },
            right: || vec![0.0],
            within: 4e-7,
        },
        Report {
            library: "dimforge/nalgebra",
            number: 1187,
            about: "no rotation",
            asked: "the largest error of the matrix diag(1, −1, −1) rebuilt from its rotation",
            source: "definition",
            found: || vec![rebuilt(HALF)],
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "cyberbotics/webots",
            number: 2155,
            about: "a wrong axis at an angle of π",
            asked: "the rotation vector of the half turn that exchanges y and z",
            source: "closed form π (0, 1, 1)/√2",
            found: || {
                let v =
                    Rotation3::from_matrix([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
                        .rotation_vector();
                vec![v.x, v.y, v.z]
            },
            right: || vec![0.0, PI * 0.5_f64.sqrt(), PI * 0.5_f64.sqrt()],
            within: 1e-15,
        },
        Report {
            library: "scipy/scipy",
            number: 20660,
            about: "no rotation",
            asked: "where the rotation nearest to one that takes x to −x takes x",
            source: "definition",
            found: || {
                let v = aligned(&[([-1., 0., 0.], [1., 0., 0.])]) * Vec3::new(1.0, 0.0, 0.0);
                vec![v.x, v.y, v.z]
            },
            right: || vec![-1.0, 0.0, 0.0],
            within: 1e-15,
        },
        Report {
            library: "scipy/scipy",
            number: 20555,
            about: "no rotation",
            asked: "the size of the rotation vector's coordinates where y goes to −y and x stays",
            source: "closed form (π, 0, 0)",
            found: || {
                let v = aligned(&[
                    ([0., 1., 0.], [0., -1., 0.]),
                    ([-1., 0., 0.], [-1., 0., 0.]),
                ])
                .rotation_vector();
                vec![v.x.abs(), v.y.abs(), v.z.abs()]
            },
            right: || vec![PI, 0.0, 0.0],
            within: 1e-15,
        },
        Report {
            library: "bitshifter/glam-rs",
            number: 276,
            about: "NaN, by a division by 0",
            asked: "the angle from no rotation to the whole way to a turn by 2π, `f32`",
            source: "definition: no rotation",
            found: || {
                let full =
                    Rotation3::from_axis_angle(Vec3::new(1.0_f32, 0.0, 0.0), std::f32::consts::TAU);
                vec![Rotation3::identity().interpolate(full, 1.0).angle().into()]
            },
            right: || vec![0.0],
            within: 1e-6,
        },
        Report {
            library: "bitshifter/glam-rs",
            number: 356,
            about: "2.549 where it is 2π: small angles are interpolated linearly",
            asked: "the angles at 30 and at 120 times the way from no rotation to π/60 about x",
            source: "closed form π/2; 2π, which is none",
            found: || {
                [30.0, 120.0]
                    .map(|t| {
                        Rotation3::identity()
                            .interpolate(about_x(PI / 60.0), t)
                            .angle()
                    })
                    .to_vec()
            },
            right: || vec![FRAC_PI_2, 0.0],
            within: 1e-13,
        },
        Report {
            library: "playcanvas/engine",
            number: 39,
            about: "NaN",
            asked: "the angle of the way half from a rotation to itself",
            source: "definition",
            found: || {
                let q = about_x(0.7);
                vec![q.interpolate(q, 0.5).angle()]
            },
            right: || vec![0.7],
            within: 1e-15,
        },
        Report {
            library: "g-truc/glm",
            number: 901,
            about: "NaN",
            asked: "the angle a hundredth of the way from a quaternion to its opposite, `f32`",
            source: "definition: both are one rotation, by π/2",
            found: || {
                let q = Rotation3::new(0.707_106_83_f32, 0.707_106_83, 0.0, 0.0);
                let other = Rotation3::new(-q.w, -q.x, 0.0, 0.0);
                vec![q.interpolate(other, 0.01).angle().into()]
            },
            right: || vec![FRAC_PI_2],
            within: 1e-6,
        },
        Report {
            library: "redorav/hlslpp",
            number: 68,
            about: "NaN",
            asked: "how far 0.691 of the way between two rotations 5·10⁻⁴ apart leads, as a share, `f32`",
            source: "definition",
            found: || {
                let [a, b] = spun();
                let t = 0.691_265_2;
                let way = a.tangent_to(b).length();
                vec![(a.tangent_to(a.interpolate(b, t)).length() / way).into()]
            },
            right: || vec![0.691_265_2],
            within: 1e-3,
        },
        Report {
            library: "dimforge/nalgebra",
            number: 316,
            about: "NaN",
            asked: "the angle of two directions 3·10⁻⁹ apart",
            source: "length of the cross product",
            found: || {
                let [a, b] = axes();
                vec![a.angle_to(b)]
            },
            right: || {
                let [a, b] = axes();
                vec![a.cross(b).length()]
            },
            within: 1e-16,
        },
        Report {
            library: "toji/gl-matrix",
            number: 499,
            about: "NaN",
            asked: "the angle from a rotation to itself",
            source: "definition",
            found: || {
                let q = Rotation3::from_yaw(0.7);
                vec![q.angle_to(q)]
            },
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "g-truc/glm",
            number: 820,
            about: "NaN: the real part exceeds 1 by rounding",
            asked: "the angle of a product of small rotations, `f32`",
            source: "closed form, in double precision",
            found: || {
                let y = Rotation3::new(0.999_998_45_f32, 0.0, -0.001_745_328_3, 0.0);
                let z = Rotation3::new(
                    0.999_996_07_f32,
                    -0.004_363_328_2,
                    0.004_363_702_6,
                    1.903_598_6e-5,
                );
                vec![(y * z).angle().into()]
            },
            right: || {
                let y = [0.999_998_45_f32, 0.0, -0.001_745_328_3, 0.0].map(f64::from);
                let z = [
                    0.999_996_07_f32,
                    -0.004_363_328_2,
                    0.004_363_702_6,
                    1.903_598_6e-5,
                ]
                .map(f64::from);
                let w = y[0] * z[0] - y[2] * z[2];
                let v = [
                    y[0] * z[1] + y[2] * z[3],
                    y[0] * z[2] + y[2] * z[0],
                    y[0] * z[3] - y[2] * z[1],
                ];
                vec![2.0 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt().atan2(w)]
            },
            within: 1e-8,
        },
    ]
}
