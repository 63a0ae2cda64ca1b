//! Kernels generated from recordings: every operation of the list, programs, folds.
//!
//! How far a result may be from the processor's is the harness's to say: a GPU is one more witness there,
//! within its own measured error (`check_on`). Here everything else: the same bits twice, however
//! batches are cut, and in all pairs what there is in aligned ones, to within what the order of operations
//! may change.
use crate::{gpu, small};
use geograd_tests::forms::{Bound, pairs_agree};

use geograd::ad::check::sample::{Draw, Sample, random};
use geograd::ad::program::{Program, Sym};
use geograd::error::Argument;

use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Cpu, Distance, One, Op};
use geograd::{
    Circle, Error, Fixed, Flaw, GpuFault, Obb2, Pack, Scalar, Segment2, Vec2, YawBox3 as YawBox,
};
use geograd_tests::rows::{distance, fold, iou, iou3, overlap, overlap3};

/// Random shapes in single precision.
fn draws<P: Sample + Pack<With<f32> = Q>, Q>(count: usize, seed: u64) -> Vec<Q> {
    let mut draw = Draw::new(seed);
    let shape = |_| random::<P>(&mut draw).remake(&mut |&x| x as f32);
    (0..count).map(shape).collect()
}

type Point = Vec2<f64>;
type Segment = Segment2<f64>;
type Box2 = Obb2<f64>;
type Yaw = YawBox<f64>;

/// Numbers that may differ by so much of their size, and of one.
fn near(found: &[f32], expected: &[f32], by: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let bound = by * (1.0 + expected.abs());
        assert!(
            (found - expected).abs() <= bound,
            "{i}: {found} for {expected}"
        );
    }
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn derivatives_along_directions_agree_with_the_processor() {
    fn ordinary<P: Sample + Pack<With<f32> = Q>, Q>(seed: u64) -> Vec<Q> {
        let mut draw = Draw::new(seed);
        let shape = |_| P::ordinary(&mut draw).remake(&mut |&x| x as f32);
        (0..100).map(shape).collect()
    }
    let Some((_turn, gpu)) = gpu() else { return };
    let (points, boxes) = (ordinary::<Point, _>(1), ordinary::<Box2, _>(2));
    let (ways, directions) = (ordinary::<Point, _>(3), ordinary::<Box2, _>(4));
    let columns = ((&points, &boxes), (&ways, &directions));
    let cpu = Cpu::new();
    let (values, slopes) = gpu.aligned(Distance.jvp(), columns).unwrap();
    let expected = cpu.aligned(Distance.jvp(), columns).unwrap();
    near(&values, &expected.0, 1e-5);
    near(&slopes, &expected.1, 1e-4);
    let (found, expected) = (
        gpu.aligned(Distance.hvp(), columns).unwrap(),
        cpu.aligned(Distance.hvp(), columns).unwrap(),
    );
    near(&found.0.scalars(), &expected.0.scalars(), 1e-3);
    near(&found.1.scalars(), &expected.1.scalars(), 1e-3);
}

#[test]
fn batches_are_the_same_bits_however_they_are_cut() {
    let Some((_turn, gpu)) = gpu() else { return };
    let small = small();
    for count in [1, 15, 16, 17, 100, 5000] {
        let points: Vec<Vec2<f32>> = draws::<Point, _>(count, 1);
        let segments: Vec<Segment2<f32>> = draws::<Segment, _>(count, 2);
        let run = distance::DistancePointSegment.value_grad();
        let once = gpu.aligned(run, (&points, &segments)).unwrap();
        let again = gpu.aligned(run, (&points, &segments)).unwrap();
        let cut = small.aligned(run, (&points, &segments)).unwrap();
        assert_eq!(bits(&once.0), bits(&again.0));
        assert_eq!(once, cut);
        assert_eq!(once.0.len(), count);
        let (mut values, mut by_point) = (vec![0.0; count], vec![Vec2::new(0.0, 0.0); count]);
        let targets = (&mut values, (&mut by_point, geograd::kernels::Skip));
        gpu.aligned_into(run, (&points, &segments), targets)
            .unwrap();
        assert_eq!((values, by_point), (once.0, once.1.0));
    }
}

#[test]
fn one_shape_stands_for_all() {
    let Some((_turn, gpu)) = gpu() else { return };
    let boxes: Vec<Obb2<f32>> = draws::<Box2, _>(100, 3);
    let own = boxes[7];
    let all = vec![own; 100];
    let run = iou::GiouObb2;
    let expected = gpu.aligned(run, (&boxes, &all)).unwrap();
    let found = gpu.aligned(run, (&boxes, One(own))).unwrap();
    assert_eq!(bits(&found), bits(&expected));
    let found = small().aligned(run, (&boxes, One(own))).unwrap();
    assert_eq!(bits(&found), bits(&expected));
    let one = gpu.aligned(run, (One(own), One(own))).unwrap();
    assert_eq!(one.len(), 1);
}

#[test]
fn all_pairs_and_reductions() {
    let Some((_turn, gpu)) = gpu() else { return };
    let ordinary = |count, seed| -> Vec<Obb2<f32>> {
        let mut draw = Draw::new(seed);
        let shape = |_| Box2::ordinary(&mut draw).cast::<f32>();
        (0..count).map(shape).collect()
    };
    let (a, b) = (ordinary(70, 1), ordinary(150, 2));
    // Each operation of the list is asked the same on smaller lists; here more than a strip, cut, and a single column.
    pairs_agree(gpu, iou::GiouObb2, &a, &b, Bound::All);
    pairs_agree(gpu, overlap::IouObb2, &a, &b, Bound::All);
    pairs_agree(&small(), iou::DiouObb2, &a, &b, Bound::All);
    pairs_agree(gpu, distance::DistanceObb2, &a, &a[..1], Bound::All);
    let mut draw = Draw::new(9);
    let shape = |_| Yaw::ordinary(&mut draw).cast::<f32>();
    let yaw: Vec<YawBox<f32>> = (0..40).map(shape).collect();
    pairs_agree(gpu, iou3::GiouYaw, &yaw, &yaw[..30], Bound::All);
    pairs_agree(gpu, overlap3::IouBirdsEye, &yaw, &yaw[..30], Bound::All);
}

/// Long thin boxes that are nearly parallel overlap in a sliver whose ends move far for a small turn.
#[test]
fn thin_boxes_that_are_nearly_parallel() {
    let Some((_turn, gpu)) = gpu() else { return };
    let thin = |x, angle| Obb2::new(x, 0.0_f32, 1e-3, 50.0, angle);
    let boxes = [
        thin(0.0, 0.7),
        thin(0.0, 0.7 + 1e-7),
        thin(3e-4, 0.7 + 1e-6),
        thin(2e-4, 0.7 - 3e-5),
        Obb2::new(0.0, 0.0, 50.0, 1e-3, 0.7),
        Obb2::new(1e-4, 0.0, 50.0, 1e-3, 0.70001),
    ];
    let wide: Vec<Obb2<f64>> = boxes.iter().map(|shape| shape.cast()).collect();
    let found = gpu.all_pairs(overlap::IouObb2, &boxes, &boxes);
    let expected = Cpu::new()
        .all_pairs(overlap::IouObb2, &wide, &wide)
        .unwrap();
    for (found, expected) in found.unwrap().planes().iter().zip(expected.planes()) {
        let off = f64::from(*found) - expected;
        assert!(off.abs() <= 1e-4, "{found} for {expected}");
    }
}

#[test]
fn suppression_starts_from_the_same_pairs() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(4);
    let shape = |_| Yaw::ordinary(&mut draw).cast::<f32>();
    let yaw: Vec<YawBox<f32>> = (0..60).map(shape).collect();
    let found = gpu.overlaps(overlap3::IouYaw, &yaw, 0.1).unwrap();
    let expected = Cpu::new().overlaps(overlap3::IouYaw, &yaw, 0.1).unwrap();
    let places = |pairs: &[geograd::suppression::Pair<f32>]| -> Vec<(usize, usize)> {
        pairs.iter().map(|pair| (pair.first, pair.second)).collect()
    };
    assert!(!found.is_empty());
    assert_eq!(places(&found), places(&expected));
}

#[test]
fn programs_run_as_operations_do() {
    let Some((_turn, gpu)) = gpu() else { return };
    type Pair = (Vec2<Sym<f32>>, Circle<Sym<f32>>);
    let program = Program::trace(|(p, c): Pair| {
        let away = p - c.center;
        // Results that WGSL leaves open.
        let angle = away.y.atan2(away.x);
        let turns = (angle * Sym::lit(3.0)).sin() + (angle + c.radius).cos();
        turns + (-away.length()).exp() + (c.radius + Sym::one()).ln() + away.length().root()
    })
    .unwrap();
    // Near the origin: the cosine of a large angle is as wrong as the angle.
    let mut draw = Draw::new(1);
    let points: Vec<Vec2<f32>> = (0..300)
        .map(|_| Point::ordinary(&mut draw).cast())
        .collect();
    let circles: Vec<Circle<f32>> = (0..300)
        .map(|_| Circle::<f64>::ordinary(&mut draw).cast())
        .collect();
    let found = gpu.aligned(&program, (&points, &circles)).unwrap();
    let expected = Cpu::new().aligned(&program, (&points, &circles)).unwrap();
    near(&found, &expected, 3e-6);
    let (values, (by_point, _)) = gpu
        .aligned(&program.value_grad(), (&points, &circles))
        .unwrap();
    near(&values, &found, 1e-6);
    assert_eq!(by_point.len(), 300);
    let constant = Program::trace(|_: Vec2<Sym<f32>>| Sym::lit(2.5)).unwrap();
    assert_eq!(gpu.aligned(constant, &points).unwrap(), vec![2.5; 300]);
    // Many, one after another: those that are gone make room.
    for k in 0..30 {
        let shift = f64::from(k);
        let moved = Program::trace(|x: Sym<f32>| x + Sym::lit(shift)).unwrap();
        assert_eq!(gpu.aligned(moved, &[1.0]).unwrap(), [1.0 + k as f32]);
    }
}

/// As many numbers in and out as the device has room for; beyond that an error says how much it would have been.
#[test]
fn any_number_of_fields() {
    let Some((_turn, gpu)) = gpu() else { return };
    const MANY: usize = 250;
    let mixed = Program::trace(|x: [Sym<f32>; MANY]| {
        std::array::from_fn::<_, MANY, _>(|i| x[i] * x[(i + 1) % MANY] + x[(7 * i) % MANY])
    })
    .unwrap();
    let mut draw = Draw::new(3);
    let items: Vec<[f32; MANY]> = (0..40)
        .map(|_| std::array::from_fn(|_| draw.unit() as f32))
        .collect();
    let found = gpu.aligned(&mixed, &items).unwrap();
    let expected = Cpu::new().aligned(&mixed, &items).unwrap();
    for (found, expected) in found.iter().zip(&expected) {
        near(found, expected, 1e-6);
    }
    // Sixteen items are the least there is.
    let small = small();
    let needed = 4 * 16 * MANY as u64;
    assert_eq!(
        small.aligned(&mixed, &items).unwrap_err(),
        Error::Gpu(GpuFault::TooLarge {
            bytes: needed,
            most: small.most_bytes()
        })
    );
}

#[test]
fn jacobians_are_the_processors() {
    let Some((_turn, gpu)) = gpu() else { return };
    let draw = |seed| -> Vec<Obb2<f32>> {
        let mut draw = Draw::new(seed);
        let shape = |_| Box2::ordinary(&mut draw).remake(&mut |&x| x as f32);
        (0..1000).map(shape).collect()
    };
    let (a, b) = (draw(1), draw(2));
    let run = geograd::kernels::ClosestPoints.jacobian();
    let (points, derivatives) = gpu.aligned(run, (&a, One(b[0]))).unwrap();
    let (expected, derivatives_expected) = Cpu::new().aligned(run, (&a, One(b[0]))).unwrap();
    let all = |points: &[geograd::distance::PointPair<f32>]| -> Vec<f32> {
        points.iter().flat_map(|x| x.scalars()).collect()
    };
    near(&all(&points), &all(&expected), 1e-4);
    // Which sides are nearest is decided within rounding: hardly an item may choose others.
    let differs = |(own, other): &(&_, &_)| -> bool {
        let rows = |x: &geograd::distance::PointPair<(Obb2<f32>, Obb2<f32>)>| -> Vec<f32> {
            x.scalars().iter().flat_map(Pack::scalars).collect()
        };
        let pairs = rows(own).into_iter().zip(rows(other));
        pairs
            .into_iter()
            .any(|(a, b)| (a - b).abs() > 1e-3 * (1.0 + b.abs()))
    };
    let different = derivatives
        .iter()
        .zip(&derivatives_expected)
        .filter(differs)
        .count();
    assert!(different <= 10, "{different} of {}", a.len());
    let corners = Program::trace(|b: Obb2<Sym<f32>>| b.corners())
        .unwrap()
        .jacobian();
    let (_, derivatives) = gpu.aligned(&corners, &a).unwrap();
    let (_, expected) = Cpu::new().aligned(&corners, &a).unwrap();
    let rows = |all: &[[Vec2<Obb2<f32>>; 4]]| -> Vec<f32> {
        let rows = all.iter().flat_map(|x| x.scalars());
        rows.flat_map(|x| x.scalars()).collect()
    };
    near(&rows(&derivatives), &rows(&expected), 1e-5);
    // A search is replayed with its derivatives.
    let mut draw = Draw::new(5);
    let polygon =
        |_| geograd::ConvexPolygon::<f64, 5>::ordinary(&mut draw).remake(&mut |&x| x as f32);
    let polygons: Vec<geograd::ConvexPolygon<f32, 5>> = (0..50).map(polygon).collect();
    let run = geograd::kernels::MinimumCircle.jacobian();
    let (_, derivatives) = gpu.aligned(run, &polygons).unwrap();
    let (_, expected) = Cpu::new().aligned(run, &polygons).unwrap();
    for ((own, other), polygon) in derivatives.iter().zip(&expected).zip(&polygons) {
        let rows = |x: &Circle<geograd::ConvexPolygon<f32, 5>>| -> Vec<f32> {
            x.scalars().iter().flat_map(Pack::scalars).collect()
        };
        near(&rows(own), &rows(other), 1e-2);
        assert_eq!(own.radius.count, polygon.count);
    }
}

#[test]
fn bad_input_is_refused() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (points, bad) = (vec![Vec2::new(0.0_f32, 1.0); 3], Vec2::new(f32::NAN, 0.0));
    let segment = Segment2::new(points[0], Vec2::new(1.0, 0.0));
    let run = distance::DistancePointSegment;
    let refused = gpu.aligned(run, (&points, &[segment; 2]));
    let length = |argument, expected, found| Error::Length {
        argument,
        expected,
        found,
    };
    let segment_argument = Argument::Named("segment");
    assert_eq!(refused.unwrap_err(), length(segment_argument, 3, 2));
    let refused = gpu.aligned(run, (&[points[0], bad], One(segment)));
    let expected = Cpu::new().aligned(run, (&[points[0], bad], One(segment)));
    assert_eq!(refused.unwrap_err(), expected.unwrap_err());
    let refused = gpu.aligned(run.vjp(), ((&points, One(segment)), &[f32::INFINITY; 3]));
    assert!(matches!(
        refused.unwrap_err(),
        Error::Invalid {
            argument: Argument::Upstream,
            item: 0,
            flaw: Flaw::NotFinite(_)
        }
    ));
    let mut few = [0.0; 2];
    let refused = gpu.aligned_into(run, (&points, One(segment)), &mut few);
    assert_eq!(refused.unwrap_err(), length(Argument::Result(0), 3, 2));
    let boxes = [Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0)];
    let refused = gpu.all_pairs_vjp(iou::GiouObb2, &boxes, &boxes, &[]);
    assert_eq!(refused.unwrap_err(), length(Argument::Upstream, 1, 0));
    let none: &[Obb2<f32>] = &[];
    assert!(gpu.row_max(iou::GiouObb2, &boxes, none).is_err());
    assert_eq!(gpu.row_max(iou::GiouObb2, none, &boxes).unwrap(), []);
    assert_eq!(gpu.aligned(iou::GiouObb2, (none, none)).unwrap(), []);
    assert_eq!(
        gpu.all_pairs(iou::GiouObb2, none, &boxes).unwrap().planes(),
        []
    );
    assert_eq!(gpu.sum(iou::GiouObb2, none, &boxes).unwrap(), 0.0);
    let (a_bar, b_bar) = gpu.all_pairs_vjp(iou::GiouObb2, none, &boxes, &[]).unwrap();
    assert_eq!((a_bar.len(), b_bar), (0, vec![Obb2::filled(0.0)]));
}

#[test]
fn a_lost_device_is_an_error() {
    let Some((_turn, _)) = gpu() else { return };
    let gpu = Gpu::new().unwrap();
    let boxes = [Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0)];
    let (run, lost) = (iou::GiouObb2, Error::Gpu(GpuFault::DeviceLost));
    assert!(gpu.aligned(run, (&boxes, &boxes)).is_ok());
    gpu.destroy();
    assert_eq!(gpu.aligned(run, (&boxes, &boxes)).unwrap_err(), lost);
    assert_eq!(gpu.all_pairs(run, &boxes, &boxes).unwrap_err(), lost);
    assert_eq!(gpu.row_max(run, &boxes, &boxes).unwrap_err(), lost);
    let (vertices, offsets) = crate::folds::paths();
    let point = One(Vec2::new(0.0, 0.0));
    let refused = gpu.fold(fold::SignedDistancePointRing, point, &vertices, &offsets);
    assert_eq!(refused.unwrap_err(), lost);
}
