//! Second derivatives at inputs along the axes, parallel and concentric, beside formulas and differences of gradients.
use geograd::ad::adjoint::overlap3::{intersection_volume_obb3_vjp, iof_obb3_vjp, iou_obb3_vjp};
use geograd::gaussian::{self, solid};
use geograd::overlap3::{iof_obb3, iou_obb3};
use geograd::shape::{Cone, Cylinder};
use geograd::{Fixed, Jet, Obb2, Obb3, Rotation3, Scalar, Vec3};

/// A function of some numbers.
trait Of<const N: usize> {
    fn of<S: Scalar>(&self, x: [S; N]) -> S;
}

/// The second derivatives by nested duals, one at a time: large ones take much of the stack.
fn hessian<const N: usize>(function: &impl Of<N>, at: [f64; N]) -> [[f64; N]; N] {
    let mut all = [[0.0; N]; N];
    for (i, row) in all.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            let along = |is: bool| if is { 1.0 } else { 0.0 };
            let x: [Jet<Jet<f64, 1>, 1>; N] = std::array::from_fn(|k| Jet {
                value: Jet {
                    value: at[k],
                    derivative: [along(k == i)],
                },
                derivative: [Jet {
                    value: along(k == j),
                    derivative: [0.0],
                }],
            });
            *entry = function.of(x).derivative[0].derivative[0];
        }
    }
    all
}

/// A number that moves along one of several.
fn along(x: f64, moves: bool) -> Jet<f64, 1> {
    Jet {
        value: x,
        derivative: [if moves { 1.0 } else { 0.0 }],
    }
}

/// The gradient by duals.
fn gradient<const N: usize>(function: &impl Of<N>, at: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| {
        let x = std::array::from_fn(|k| along(at[k], k == i));
        function.of(x).derivative[0]
    })
}

fn assert_near(found: f64, expected: f64, of: &str) {
    let off = (found - expected).abs();
    assert!(
        off <= 1e-6 * (1.0 + expected.abs()),
        "{of}: {found}, {expected}"
    );
}

struct Length;
impl Of<3> for Length {
    fn of<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        Vec3::new(x, y, z).length()
    }
}

#[test]
fn lengths_have_second_derivatives_along_the_axes() {
    // (I − v vᵀ / |v|²) / |v|.
    for x in -2..=2 {
        for y in -2..=2 {
            for z in -2..=2 {
                let v = [x, y, z].map(f64::from);
                let square = v.iter().map(|x| x * x).sum::<f64>();
                let found = hessian(&Length, v);
                for i in 0..3 {
                    for j in 0..3 {
                        let own = if i == j { square } else { 0.0 };
                        let expected = match square > 0.0 {
                            true => (own - v[i] * v[j]) / (square * square.sqrt()),
                            false => 0.0,
                        };
                        assert_near(found[i][j], expected, "length");
                    }
                }
                let single = Vec3::new(x as f32, y as f32, z as f32).length();
                assert_eq!(single, (square as f32).sqrt());
                assert_eq!(Vec3::new(v[0], v[1], v[2]).length(), square.sqrt());
            }
        }
    }
    let far = Vec3::new(3e200_f64, 4e200, 0.0);
    assert!((far.length() / 5e200 - 1.0).abs() < 1e-15);
    let near = Vec3::new(0.0, 3e-200_f64, 4e-200);
    assert!((near.length() / 5e-200 - 1.0).abs() < 1e-15);
}

struct Volumes;
impl Of<7> for Volumes {
    fn of<S: Scalar>(&self, [a, b, c, d, e, f, r]: [S; 7]) -> S {
        let (from, to) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
        Cylinder::new(from, to, r).volume() + Cone::new(from, to, r).surface()
    }
}

struct Angles;
impl Of<6> for Angles {
    fn of<S: Scalar>(&self, [a, b, c, d, e, f]: [S; 6]) -> S {
        Vec3::new(a, b, c).angle_to(Vec3::new(d, e, f))
    }
}

struct Turned;
impl Of<4> for Turned {
    fn of<S: Scalar>(&self, [w, x, y, z]: [S; 4]) -> S {
        Rotation3::new(w, x, y, z).angle()
    }
}

/// Compares second derivatives with differences of gradients.
fn assert_differences<const N: usize>(function: &impl Of<N>, at: [f64; N], of: &str) {
    let (found, step) = (hessian(function, at), 1.0 / 65536.0);
    for i in 0..N {
        let moved = |by: f64| {
            let mut x = at;
            x[i] += by;
            gradient(function, x)
        };
        let (after, before) = (moved(step), moved(-step));
        for j in 0..N {
            let expected = (after[j] - before[j]) / (2.0 * step);
            assert_near(found[i][j], expected, &format!("{of} {at:?} {i} {j}"));
        }
    }
}

#[test]
fn upright_shapes_have_second_derivatives() {
    for axis in 0..3 {
        let mut at = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.5];
        at[3 + axis] = 2.0;
        assert_differences(&Volumes, at, "volumes");
        let mut at = [0.0; 6];
        (at[axis], at[3 + (axis + 1) % 3]) = (2.0, 0.5);
        assert_differences(&Angles, at, "angle");
        let mut at = [1.0, 0.0, 0.0, 0.0];
        at[1 + axis] = 1.0;
        assert_differences(&Turned, at, "turn");
    }
}

/// A score of two boxes of space by their places and sizes.
struct Boxes(usize);
impl Of<12> for Boxes {
    fn of<S: Scalar>(&self, x: [S; 12]) -> S {
        let (a, b) = boxes(x);
        match self.0 {
            0 => iou_obb3(a, b),
            1 => iof_obb3(a, b),
            2 => solid::kullback_leibler(a, b),
            3 => solid::jeffreys(a, b),
            4 => solid::bhattacharyya(a, b),
            5 => solid::probiou(a, b),
            _ => solid::wasserstein(a, b),
        }
    }
}
fn boxes<S: Scalar>(x: [S; 12]) -> (Obb3<S>, Obb3<S>) {
    let vector = |k: usize| Vec3::new(x[k], x[k + 1], x[k + 2]);
    let made = |k: usize| Obb3::new(vector(k), vector(k + 3), Rotation3::identity());
    (made(0), made(6))
}

/// The derivatives of a box's score by hand, in the order of its numbers.
pub fn by_hand<S: Scalar>(which: usize, a: Obb3<S>, b: Obb3<S>) -> [S; 20] {
    let (_, (a, b)) = match which {
        0 => iou_obb3_vjp(a, b, S::one()),
        1 => iof_obb3_vjp(a, b, S::one()),
        _ => intersection_volume_obb3_vjp(a, b, S::one()),
    };
    let mut numbers = [S::zero(); 20];
    (a, b).store(&mut numbers);
    numbers
}

/// The numbers of two boxes but for their rotations.
const PLACES_AND_SIZES: [usize; 12] = [0, 1, 2, 3, 4, 5, 10, 11, 12, 13, 14, 15];

/// The derivatives of those, column by column: entry `[i][j]` is that of derivative j by number i.
fn second(which: usize, x: &[f64; 20]) -> [[f64; 20]; 20] {
    std::array::from_fn(|i| {
        let duals: [Jet<f64, 1>; 20] = std::array::from_fn(|k| along(x[k], k == i));
        let (a, b) = Fixed::load(&duals);
        by_hand(which, a, b).map(|derivative| derivative.derivative[0])
    })
}

#[test]
fn ratios_by_hand_have_second_derivatives_by_places_and_sizes_of_parallel_boxes() {
    if !geograd_tests::is_due(
        "ratios_by_hand_have_second_derivatives_by_places_and_sizes_of_parallel_boxes",
    ) {
        return;
    }
    let (mut dice, mut overlapping) = (geograd_tests::Dice(5), 0);
    for case in 0..60 {
        let mut number = |least: i32| f64::from(dice.below(16) as i32 + least) / 8.0;
        let mut x = [0.0; 20];
        for k in [0, 10] {
            for i in 0..3 {
                // Odd multiples of a sixteenth: no two faces in one plane.
                x[k + i] = number(-8) + if k == 10 { 0.0625 } else { 0.0 };
                x[k + 3 + i] = number(4) * 2.0;
            }
        }
        x[6 + case % 4] = 1.0;
        x[16] = 1.0;
        let seen = |x: &[f64; 20]| -> (Obb3<f64>, Obb3<f64>) { Fixed::load(x) };
        let (a, b) = seen(&x);
        overlapping += usize::from(iou_obb3(a, b) > 0.0);
        for which in 0..3 {
            let found = second(which, &x);
            let step = 1.0 / 1_048_576.0;
            for i in PLACES_AND_SIZES {
                let moved = |by: f64| {
                    let mut x = x;
                    x[i] += by;
                    let (a, b) = seen(&x);
                    by_hand(which, a, b)
                };
                let (after, before) = (moved(step), moved(-step));
                for j in PLACES_AND_SIZES {
                    let expected = (after[j] - before[j]) / (2.0 * step);
                    let off = (found[i][j] - expected).abs();
                    assert!(
                        off < 1e-4 * (1.0 + expected.abs()),
                        "{which} {i} {j} {x:?}: {} {expected}",
                        found[i][j]
                    );
                    // Off ties the order of both does not matter.
                    let (here, there) = (found[i][j], found[j][i]);
                    assert!(
                        (here - there).abs() < 1e-9 * (1.0 + here.abs()),
                        "{which} {i} {j} {x:?}: {here} {there}"
                    );
                }
            }
        }
    }
    assert!(overlapping > 20, "{overlapping}");
}

#[test]
fn second_derivatives_are_finite_at_faces_in_one_plane() {
    for (dx, dy, dz) in [
        (0.0, 0.0, 0.0),
        (1.0, 0.0, 0.0),
        (0.5, 0.5, 0.0),
        (1.0, 1.0, 1.0),
        (0.0, 2.0, 0.0),
    ] {
        let mut x = [0.0; 20];
        (x[0], x[1], x[2]) = (dx, dy, dz);
        (x[3], x[4], x[5], x[6]) = (2.0, 1.0, 2.0, 1.0);
        (x[13], x[14], x[15], x[16]) = (2.0, 2.0, 1.0, 1.0);
        for which in 0..3 {
            let found = second(which, &x);
            for i in PLACES_AND_SIZES {
                for j in PLACES_AND_SIZES {
                    let here = found[i][j];
                    assert!(here.abs() < 1e3, "{which} {i} {j} {x:?}: {here}");
                }
            }
        }
    }
}

/// A score of two boxes of the plane by their places and sizes.
struct Flat;
impl Of<8> for Flat {
    fn of<S: Scalar>(&self, [a, b, c, d, e, f, g, h]: [S; 8]) -> S {
        let (first, second) = (
            Obb2::new(a, b, c, d, S::zero()),
            Obb2::new(e, f, g, h, S::zero()),
        );
        gaussian::wasserstein(first, second)
    }
}

#[test]
fn gaussian_scores_have_second_derivatives_of_concentric_boxes() {
    let at = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 2.0, 1.5, 2.5];
    let expected = [1.0, 5.0, 0.4, -1.4416, 1.6330];
    for (which, expected) in (2..7).zip(expected) {
        let found = hessian(&Boxes(which), at)[0][0];
        assert!(
            (found - expected).abs() < 1e-4,
            "{which}: {found} {expected}"
        );
        assert_differences(&Boxes(which), at, "solid");
    }
    let at = [0.0, 0.0, 1.0, 2.0, 0.0, 0.0, 2.0, 1.5];
    assert_near(
        hessian(&Flat, at)[0][0],
        1.0 / 0.3125_f64.sqrt(),
        "wasserstein",
    );
    assert_differences(&Flat, at, "flat");
    for scale in [1e-30, 1e-3, 1e6, 1e30] {
        let found = hessian(&Flat, at.map(|x| x * scale))[0][0] * scale;
        assert_near(found, 1.0 / 0.3125_f64.sqrt(), "wasserstein");
    }
}
