//! Thin long boxes that cross, in single precision: what they share is 10⁻⁵ of either.
use super::oracle_solid;
use super::pairs::{Random, random_rotation};
use geograd::overlap3::{intersection_volume_obb3, iou_obb3};
use geograd::{Jet, Obb3, Rotation3, Scalar, Vec3};

fn numbers(x: Obb3<f64>) -> [f32; 10] {
    let (c, s, q) = (x.center, x.size, x.rotation);
    [c.x, c.y, c.z, s.x, s.y, s.z, q.w, q.x, q.y, q.z].map(|x| x as f32)
}
fn made<S: Scalar>(x: [f32; 10]) -> Obb3<S> {
    let [x, y, z, u, v, w, a, b, c, d] = x.map(|x| S::lit(f64::from(x)));
    Obb3::new(
        Vec3::new(x, y, z),
        Vec3::new(u, v, w),
        Rotation3::new(a, b, c, d),
    )
}
/// The volume and its derivatives by the rotation of the second box.
fn turned<S: Scalar<Mask = bool>>(a: [f32; 10], b: [f32; 10]) -> Jet<S, 4> {
    let (a, mut b) = (made::<Jet<S, 4>>(a), made::<Jet<S, 4>>(b));
    let q = &mut b.rotation;
    for (i, x) in [&mut q.w, &mut q.x, &mut q.y, &mut q.z]
        .into_iter()
        .enumerate()
    {
        *x = Jet::variable(x.value, i);
    }
    intersection_volume_obb3(a, b)
}

/// Plates of 1 by 50 by a thousandth whose centres are near each other.
fn plates(random: &mut Random) -> ([f32; 10], [f32; 10]) {
    const SIZES: [[f64; 3]; 6] = [
        [1.0, 0.001, 50.0],
        [1.0, 50.0, 0.001],
        [50.0, 1.0, 0.001],
        [50.0, 0.001, 1.0],
        [0.001, 50.0, 1.0],
        [0.001, 1.0, 50.0],
    ];
    let plate = |center: Vec3<f64>, random: &mut Random| {
        let [x, y, z] = SIZES[random.next() as usize % 6];
        numbers(Obb3::new(
            center,
            Vec3::new(x, y, z),
            random_rotation(random),
        ))
    };
    let center = random.vector(3.0);
    let other = center + random.vector(0.4);
    (plate(center, random), plate(other, random))
}

#[test]
fn what_thin_boxes_that_cross_share_is_found() {
    if !geograd_tests::is_due("what_thin_boxes_that_cross_share_is_found") {
        return;
    }
    let mut random = Random(79);
    let (mut errors, mut shares, mut wrong) = (Vec::new(), Vec::new(), 0);
    while errors.len() < 1000 {
        let (a, b) = plates(&mut random);
        let truth = turned::<f64>(a, b);
        if truth.value == 0.0 {
            continue;
        }
        let found = turned::<f32>(a, b);
        let error = (f64::from(found.value) - truth.value).abs();
        errors.push(error / made::<f64>(a).volume());
        shares.push(error / truth.value);
        let steepest = truth
            .derivative
            .iter()
            .fold(0.0_f64, |most, s| most.max(s.abs()));
        for (derivative, truth) in found.derivative.iter().zip(truth.derivative) {
            let counts = truth.abs() > 0.1 * steepest;
            wrong += usize::from(counts && f64::from(*derivative) * truth <= 0.0);
        }
        if errors.len() % 100 == 0 {
            let exact = oracle_solid::overlap(made(a), made(b))[0];
            assert!((truth.value / exact - 1.0).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
    errors.sort_by(f64::total_cmp);
    shares.sort_by(f64::total_cmp);
    // Errors as shares of the volume of a box.
    assert!(errors[990] < 1.5e-6, "{:e}", errors[990]);
    assert!(errors[999] < 3e-5, "{:e}", errors[999]);
    // Errors as shares of the shared volume.
    assert!(
        shares[900] < 6e-3 && shares[990] < 4e-2,
        "{:e}",
        shares[990]
    );
    assert!(wrong <= 3, "{wrong}");
}

#[test]
fn plates_that_cross_at_a_small_angle() {
    let a = [
        0.4575, -1.98606, -0.63022, 1.0, 0.001, 50.0, -0.347003, 0.301147, 0.878665, -0.129798,
    ];
    let b = [
        0.442325, -2.29244, -0.729656, 1.0, 50.0, 0.001, -0.805256, -0.342258, -0.0567029, 0.480839,
    ];
    let (found, truth) = (turned::<f32>(a, b), turned::<f64>(a, b));
    assert!((truth.value / oracle_solid::overlap(made(a), made(b))[0] - 1.0).abs() < 1e-9);
    assert!(
        (f64::from(found.value) / truth.value - 1.0).abs() < 1e-4,
        "{found:?}"
    );
    let steepest = truth
        .derivative
        .iter()
        .fold(0.0_f64, |most, s| most.max(s.abs()));
    for (derivative, truth) in found.derivative.iter().zip(truth.derivative) {
        assert!(
            (f64::from(*derivative) - truth).abs() < 0.02 * steepest,
            "{found:?} {truth:?}"
        );
    }
    let (single, double) = (
        iou_obb3::<f32>(made(a), made(b)),
        iou_obb3::<f64>(made(a), made(b)),
    );
    assert!((f64::from(single) / double - 1.0).abs() < 1e-4);
}
