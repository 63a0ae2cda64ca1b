//! Suppression on a GPU: exactly what the processor keeps.
use crate::{gpu, small};
use geograd::__private::Call;
use geograd::ad::check::sample::Draw;
use geograd::ad::program::{Program, Sym};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Backend, Cpu, Function, Single};
use geograd::suppression::Rules;
use geograd::{Error, GpuFault, Obb2, Obb3, Rotation3, Scalar, Vec3, YawBox3};
use geograd_tests::rows::{iou, overlap, overlap3};

/// Detections that crowd around some objects, with scores of which many are the same.
struct Scene<A> {
    shapes: Vec<A>,
    scores: Vec<f32>,
    classes: Vec<u32>,
}

fn scene<A>(
    count: usize,
    objects: usize,
    seed: u64,
    shape: impl Fn(&mut Draw, f64) -> A,
) -> Scene<A> {
    let mut draw = Draw::new(seed);
    let shapes = (0..count)
        .map(|i| shape(&mut draw, (i % objects) as f64))
        .collect();
    let scores = (0..count).map(|_| (16.0 * draw.unit()).floor() as f32 / 16.0);
    let scores = scores.collect();
    let classes = (0..count).map(|_| (3.0 * draw.unit()) as u32).collect();
    Scene {
        shapes,
        scores,
        classes,
    }
}

/// Cars in two rows, six metres apart, each seen many times.
fn flat(draw: &mut Draw, object: f64) -> Obb2<f32> {
    let place = [6.0 * (object / 2.0).floor(), 3.0 * (object % 2.0)];
    let mut near = |x: f64, by: f64| (x + draw.within(-by, by)) as f32;
    Obb2::new(
        near(place[0], 1.0),
        near(place[1], 0.5),
        near(4.0, 0.5),
        near(2.0, 0.3),
        near(0.3, 0.2),
    )
}

fn upright(draw: &mut Draw, object: f64) -> YawBox3<f32> {
    let seen = flat(draw, object);
    let mut near = |x: f64, by: f64| (x + draw.within(-by, by)) as f32;
    let center = Vec3::new(seen.center.x, seen.center.y, near(0.0, 0.5));
    YawBox3::new(
        center,
        Vec3::new(seen.size.x, seen.size.y, near(1.5, 0.2)),
        seen.heading,
    )
}

fn turned(draw: &mut Draw, object: f64) -> Obb3<f32> {
    let seen = upright(draw, object);
    let mut near = |by: f64| draw.within(-by, by) as f32;
    let axis = Vec3::new(near(0.4), near(0.4), 1.0);
    Obb3::new(
        seen.center,
        seen.size,
        Rotation3::from_axis_angle(axis, seen.heading),
    )
}

/// The same places as the processor's, for many thresholds, and classes or none. How many are kept.
fn agrees<A: Single<Scalar = f32>, R>(gpu: &Gpu, run: R, scene: &Scene<A>) -> Vec<usize>
where
    R: Function<(A, A), Out = f32> + Copy,
{
    let mut counts = Vec::new();
    for overlap in [0.0, 0.1, 1.0 / 3.0, 0.5, 0.7, 1.0] {
        for (classes, score, most) in [
            (None, f32::MIN, usize::MAX),
            (Some(&scene.classes[..]), 0.2, usize::MAX),
            (None, f32::MIN, 7),
        ] {
            let rules = Rules {
                classes,
                overlap,
                score,
                most,
            };
            let found = Backend::Gpu(gpu).suppress(run, &scene.shapes, &scene.scores, rules);
            let expected = Cpu::new().suppress(run, &scene.shapes, &scene.scores, rules);
            assert_eq!(found, expected, "{rules:?}");
            counts.push(expected.map_or(0, |kept| kept.len()));
        }
    }
    counts
}

/// Something was suppressed, and something kept.
fn varied(counts: &[usize], of: usize) {
    assert!(
        counts.iter().any(|&kept| kept > 7 && kept < of / 4),
        "{counts:?}"
    );
    assert!(counts.iter().any(|&kept| kept > of / 4), "{counts:?}");
}

#[test]
fn boxes_in_the_plane() {
    let Some((_turn, gpu)) = gpu() else { return };
    let crowd = scene(1200, 40, 1, flat);
    varied(&agrees(gpu, overlap::IouObb2, &crowd), 1200);
    // More than one block of rows, and more than one window of columns.
    let few = scene(333, 60, 2, flat);
    varied(&agrees(&small(), overlap::IouObb2, &few), 333);
    agrees(
        &small(),
        overlap::IouAabb2,
        &scene(200, 20, 3, |draw, object| flat(draw, object).bounding()),
    );
}

#[test]
fn boxes_in_space() {
    let Some((_turn, gpu)) = gpu() else { return };
    let crowd = scene(700, 30, 4, upright);
    varied(&agrees(gpu, overlap3::IouBirdsEye, &crowd), 700);
    varied(&agrees(gpu, overlap3::IouYaw, &crowd), 700);
    varied(
        &agrees(gpu, overlap3::IouObb3, &scene(200, 20, 5, turned)),
        200,
    );
}

/// Scores whose pairs are apart without being zero.
#[test]
fn without_bounds() {
    let Some((_turn, gpu)) = gpu() else { return };
    varied(&agrees(gpu, iou::GiouObb2, &scene(400, 30, 6, flat)), 400);
}

/// All pairs are as near to the threshold as rounding lets them be.
#[test]
fn ties_at_the_threshold() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(7);
    let (mut shapes, mut scores) = (Vec::new(), Vec::new());
    for k in 0..400 {
        // Two squares, one moved by half a side: an IoU of a third, up to rounding.
        let (angle, x, y) = (
            draw.within(-3.0, 3.0),
            draw.within(-5.0, 5.0),
            10.0 * f64::from(k),
        );
        let (sin, cos) = angle.sin_cos();
        for by in [0.0, 1.0] {
            shapes.push(Obb2::new(
                (x + by * cos) as f32,
                (y + by * sin) as f32,
                2.0,
                2.0,
                angle as f32,
            ));
            scores.push(draw.unit() as f32);
        }
    }
    let rules = Rules::above(1.0 / 3.0);
    let found = gpu
        .suppress(overlap::IouObb2, &shapes, &scores, rules)
        .unwrap();
    let expected = Cpu::new()
        .suppress(overlap::IouObb2, &shapes, &scores, rules)
        .unwrap();
    assert_eq!(found, expected);
    assert!(
        (450..750).contains(&found.len()),
        "{} of 800 kept",
        found.len()
    );
    // The same box many times, thin ones, sizes far apart.
    let mut shapes = vec![Obb2::new(1.0, 2.0, 3.0, 1.0, 0.5); 100];
    for k in 0..60 {
        let turn = 1e-6 * draw.unit() as f32;
        shapes.push(Obb2::new(2e-4 * k as f32, 0.0, 1e-3, 50.0, 0.7 + turn));
        shapes.push(Obb2::new(0.0, 0.0, 1e-30, 1e-30, turn));
        shapes.push(Obb2::new(0.0, 0.0, 1e30 * (1.0 + turn), 1e30, turn));
    }
    let scores: Vec<f32> = shapes.iter().map(|_| draw.unit() as f32).collect();
    let classes = vec![5; shapes.len()];
    agrees(
        gpu,
        overlap::IouObb2,
        &Scene {
            shapes,
            scores,
            classes,
        },
    );
}

/// The width that counts as near to the threshold is many times the error of the driver.
#[test]
fn the_driver_is_never_so_wrong() {
    let Some((_turn, gpu)) = gpu() else { return };
    let shapes = scene(150, 10, 8, turned).shapes;
    let found = gpu.all_pairs(overlap3::IouObb3, &shapes, &shapes).unwrap();
    let expected = Cpu::new()
        .all_pairs(overlap3::IouObb3, &shapes, &shapes)
        .unwrap();
    let off = found
        .planes()
        .iter()
        .zip(expected.planes())
        .map(|(x, y)| (x - y).abs());
    let worst = off.fold(0.0, f32::max);
    assert!(worst < 1.0 / 2048.0, "{worst}");
}

#[test]
fn few_and_bad_ones() {
    let Some((_turn, gpu)) = gpu() else { return };
    let run = overlap::IouObb2;
    let one = [Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0)];
    let cpu = Cpu::new();
    let rules = Rules::above(0.5);
    assert_eq!(gpu.suppress(run, &one[..0], &[], rules).unwrap(), []);
    assert_eq!(gpu.suppress(run, &one, &[0.5], rules).unwrap(), [0]);
    let least = Rules {
        score: 0.6,
        ..rules
    };
    assert_eq!(gpu.suppress(run, &one, &[0.5], least).unwrap(), []);
    let none = Rules { most: 0, ..rules };
    assert_eq!(gpu.suppress(run, &one, &[0.5], none).unwrap(), []);
    let two = [one[0], Obb2::new(f32::NAN, 0.0, 1.0, 1.0, 0.0)];
    let classes = Rules {
        classes: Some(&[1]),
        ..rules
    };
    for (shapes, scores, rules) in [
        (&one[..], &[][..], rules),
        (&one[..], &[f32::NAN][..], rules),
        (&one[..], &[0.5][..], Rules::above(1.5)),
        (&one[..], &[0.5][..], Rules::above(f32::NAN)),
        (&two[..], &[0.5, 0.4][..], rules),
        (&two[..], &[0.5, 0.4][..], classes),
    ] {
        let found = gpu.suppress(run, shapes, scores, rules).unwrap_err();
        assert_eq!(found, cpu.suppress(run, shapes, scores, rules).unwrap_err());
    }
    let gpu = Gpu::new().unwrap();
    gpu.destroy();
    let refused = gpu.suppress(run, &one, &[0.5], rules);
    assert_eq!(refused.unwrap_err(), Error::Gpu(GpuFault::DeviceLost));
}

/// An IoU that a driver gets wrong by two thousandths.
#[derive(Clone, Copy, Debug)]
struct Off;

impl Function<(Obb2<f32>, Obb2<f32>)> for Off {
    type Out = f32;
    fn call(&self) -> Result<Call<f32>, Error> {
        type Boxes = (Obb2<Sym<f32>>, Obb2<Sym<f32>>);
        let off = Program::trace(|(a, b): Boxes| a.iou(b) + Sym::lit(0.002))?;
        overlap::IouObb2.call()?.with_kernels_of(&off.call()?)
    }
}

/// The processor makes the decisions that depend on rounding, whatever the driver computes.
#[test]
fn a_driver_that_is_off() {
    let Some((_turn, gpu)) = gpu() else { return };
    agrees(gpu, Off, &scene(500, 20, 9, flat));
}
