//! Columns that stay: any operation, the same on both machines, and the same bits as of slices.
use crate::shapes::bits;
use crate::{gpu, small};
use geograd::ad::check::sample::{Draw, Sample};
use geograd::ad::program::{Program, Sym};
use geograd::error::Argument;
use geograd::kernels::Backend;
use geograd::kernels::Diameter;
use geograd::kernels::resident::Held;
use geograd::kernels::{One, Op};
use geograd::{
    ConvexPolygon, Error, GpuFault, Obb2, Obb3, Pack, Scalar, Segment2, Unrecordable, Vec2, YawBox3,
};
use geograd_tests::rows::{distance, iou, iou3, overlap, overlap3};

/// Ordinary shapes in single precision.
fn ordinary<P: Sample + Pack<Scalar = f64, With<f32> = Q>, Q>(count: usize, seed: u64) -> Vec<Q> {
    let mut draw = Draw::new(seed);
    let shape = |_| P::ordinary(&mut draw).remake(&mut |&x| x as f32);
    (0..count).map(shape).collect()
}

fn near(found: &[Vec<f32>], expected: &[Vec<f32>], by: f32) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!(found.len(), expected.len());
        for (i, (x, y)) in found.iter().zip(expected).enumerate() {
            assert!((x - y).abs() <= by * (1.0 + y.abs()), "{i}: {x} for {y}");
        }
    }
}

/// The results of a chain of calls, which a test compares between machines.
fn chain(here: Backend<'_>, count: usize) -> Result<Vec<Vec<f32>>, Error> {
    let points = here.upload(&ordinary::<Vec2<f64>, _>(count, 1))?;
    let segments = here.upload(&ordinary::<Segment2<f64>, _>(count, 2))?;
    let wall = One(ordinary::<Segment2<f64>, _>(1, 3)[0]);
    let run = distance::DistancePointSegment;
    let mut all = here.aligned(run, (&points, &segments))?.numbers()?;
    // The same columns again, for another operation and beside one that stands for all.
    let mut both = here.aligned(run.value_grad(), (&points, &segments))?;
    all.extend(both.numbers()?);
    here.aligned_into(run.value_grad(), (&points, wall), &mut both)?;
    all.extend(both.numbers()?);
    // Results as cotangents, and as shapes to compute with.
    let (distances, derivatives) = both.split();
    let (by_points, _) = derivatives.split();
    let derivatives = here.aligned(run.vjp(), ((&points, wall), &distances))?;
    all.extend(derivatives.numbers()?);
    all.extend(here.aligned(run, (&by_points, &segments))?.numbers()?);
    Ok(all)
}

#[test]
fn columns_serve_many_calls() {
    let Some((_turn, gpu)) = gpu() else { return };
    for count in [0, 1, 16, 100, 5000] {
        let expected = chain(Backend::Cpu.resident(), count).unwrap();
        let found = chain(Backend::Gpu(gpu).resident(), count).unwrap();
        near(&found, &expected, 2e-5);
        // Cut into small pieces, the same bits.
        let cut = chain(Backend::Gpu(&small()).resident(), count).unwrap();
        for (found, cut) in found.iter().zip(&cut) {
            assert_eq!(bits(found), bits(cut));
        }
    }
}

/// Sines of headings and frames of boxes are the processor's: the bits are those of slices.
#[test]
fn what_is_prepared_is_what_slices_are() {
    let Some((_turn, gpu)) = gpu() else { return };
    let here = Backend::Gpu(gpu).resident();
    let (a, b): (Vec<Obb2<f32>>, Vec<Obb2<f32>>) = (
        ordinary::<Obb2<f64>, _>(300, 4),
        ordinary::<Obb2<f64>, _>(300, 5),
    );
    let (on_a, on_b) = (here.upload(&a).unwrap(), here.upload(&b).unwrap());
    let run = iou::GiouObb2.value_grad();
    // Twice: what was prepared is kept.
    for _ in 0..2 {
        let found = here.aligned(run, (&on_a, &on_b)).unwrap();
        let found = found.download().unwrap();
        assert_eq!(found, gpu.aligned(run, (&a, &b)).unwrap());
    }
    let found = here.all_pairs(iou::GiouObb2, &on_a, &on_b).unwrap();
    let expected = gpu.all_pairs(iou::GiouObb2, &a, &b).unwrap();
    assert_eq!(bits(&found.download().unwrap()), bits(expected.planes()));
    // Boxes that a GPU computed are prepared as well, once they are brought back.
    let turned = Program::trace(|x: Obb2<Sym<f32>>| {
        let (center, size) = (x.center, x.size);
        Obb2::new(center.x, center.y, size.y, size.x, x.heading + x.heading)
    });
    let turned = here.aligned(&turned.unwrap(), &on_a).unwrap();
    let found = here.aligned(iou::GiouObb2, (&turned, &on_b)).unwrap();
    let slices = turned.download().unwrap();
    let expected = gpu.aligned(iou::GiouObb2, (&slices, &b)).unwrap();
    assert_eq!(bits(&found.download().unwrap()), bits(&expected));
    assert_eq!(slices[7].heading, 2.0 * a[7].heading);
    let found = here.all_pairs(iou::GiouObb2, &turned, &on_b).unwrap();
    let expected = gpu.all_pairs(iou::GiouObb2, &slices, &b).unwrap();
    assert_eq!(bits(&found.download().unwrap()), bits(expected.planes()));
}

#[test]
fn other_shapes_in_the_same_buffers() {
    let Some((_turn, gpu)) = gpu() else { return };
    for gpu in [gpu, &small()] {
        let here = Backend::Gpu(gpu).resident();
        let lists: [Vec<Obb3<f32>>; 3] = [6, 7, 8].map(|seed| ordinary::<Obb3<f64>, _>(90, seed));
        let mut a = here.upload(&lists[0]).unwrap();
        let b = here.upload(&lists[1]).unwrap();
        let mut found = here.aligned(overlap3::IouObb3, (&a, &b)).unwrap();
        let mut matrix = here.all_pairs(overlap3::IouObb3, &a, &b).unwrap();
        for list in [&lists[2], &lists[1], &lists[0]] {
            a.update(list).unwrap();
            here.aligned_into(overlap3::IouObb3, (&a, &b), &mut found)
                .unwrap();
            let expected = gpu.aligned(overlap3::IouObb3, (list, &lists[1]));
            assert_eq!(bits(&found.download().unwrap()), bits(&expected.unwrap()));
            here.all_pairs_into(overlap3::IouObb3, &a, &b, &mut matrix)
                .unwrap();
            let expected = gpu.all_pairs(overlap3::IouObb3, list, &lists[1]);
            let expected = expected.unwrap();
            assert_eq!(bits(&matrix.download().unwrap()), bits(expected.planes()));
        }
        // A derivative of moved results, over which other results went.
        let mut values = here
            .aligned(iou::DiouObb2, (&boxes(here, 1), &boxes(here, 2)))
            .unwrap();
        let before = values.download().unwrap();
        here.aligned_into(
            iou::DiouObb2,
            (&boxes(here, 2), &boxes(here, 1)),
            &mut values,
        )
        .unwrap();
        near(&[values.download().unwrap()], &[before], 1e-5);
    }
}

fn boxes(here: Backend<'_>, seed: u64) -> Held<Obb2<f32>> {
    here.upload(&ordinary::<Obb2<f64>, _>(64, seed)).unwrap()
}

/// More columns than a kernel may bind in any case: copied together first.
#[test]
fn many_columns() {
    let Some((_turn, gpu)) = gpu() else { return };
    type S = Sym<f32>;
    let many = Program::trace(|(a, b, c, d, e, f): (S, S, S, S, S, S)| {
        (a * b + c, d * e - f, (a + f).sin() * c, b)
    })
    .unwrap();
    let vjp = many.vjp();
    for gpu in [gpu, &small()] {
        let run = |here: Backend<'_>| {
            let held = |k: usize| -> Held<f32> {
                let numbers: Vec<f32> = (0..500).map(|i| ((i * k) as f32).sin()).collect();
                here.upload(&numbers).unwrap()
            };
            let (a, b, c, d, e) = (&held(1), &held(2), &held(3), &held(4), &held(5));
            let ups = (&held(6), &held(7), &held(8), One(0.5));
            let found = here.aligned(&vjp, ((a, b, c, d, e, One(0.25)), ups));
            found.unwrap().numbers().unwrap()
        };
        let expected = run(Backend::Cpu.resident());
        near(&run(Backend::Gpu(gpu).resident()), &expected, 1e-5);
        assert_eq!(expected.len(), 6);
    }
}

#[test]
fn all_pairs_reductions_and_derivatives() {
    let Some((_turn, gpu)) = gpu() else { return };
    let yaw: Vec<YawBox3<f32>> = ordinary::<YawBox3<f64>, _>(70, 9);
    let run = iou3::GiouYaw;
    let told = |here: Backend<'_>| -> Result<_, Error> {
        let (a, b) = (here.upload(&yaw[..40])?, here.upload(&yaw)?);
        let matrix = here.all_pairs(run, &a, &b)?;
        let (by_a, by_b) = here.all_pairs_vjp(run, &a, &b, &matrix)?;
        let (sum, sum_a, _) = here.sum_grad(run, &a, &b)?;
        let (mean, _, mean_b) = here.mean_grad(run, &a, &b)?;
        let rows = here.row_max(run, &a, &b)?.download()?;
        let columns = here.column_max(run, &a, &b)?.download()?;
        let places = |best: &geograd::kernels::reduce::Best| best.index;
        let places: Vec<usize> = rows.iter().chain(&columns).map(places).collect();
        let above = here.above(run, &a, &b, 0.25)?.download()?.len();
        let count = here.count_above(run, &a, &b, 0.25)?;
        assert_eq!(above as u64, count);
        let mut all = vec![matrix.download()?];
        for bars in [by_a, by_b, sum_a, mean_b] {
            all.extend(bars.numbers()?);
        }
        let sums = [sum, mean, here.sum(run, &a, &b)?, here.mean(run, &a, &b)?];
        all.push(sums.iter().map(|&x| x as f32).collect());
        Ok((all, places, count))
    };
    let expected = told(Backend::Cpu.resident()).unwrap();
    let found = told(Backend::Gpu(gpu).resident()).unwrap();
    near(&found.0, &expected.0, 1e-3);
    assert_eq!((found.1, found.2), (expected.1, expected.2));
    let again = told(Backend::Gpu(gpu).resident()).unwrap();
    for (x, y) in again.0.iter().zip(&found.0) {
        assert_eq!(bits(x), bits(y));
    }
}

#[test]
fn wrong_columns_are_refused() {
    let Some((_turn, gpu)) = gpu() else { return };
    let other = small();
    let refused = Error::Gpu(GpuFault::ForeignBuffer);
    let length = |argument, expected, found| Error::Length {
        argument,
        expected,
        found,
    };
    let run = overlap::IouObb2;
    for here in [Backend::Cpu.resident(), Backend::Gpu(gpu).resident()] {
        let shapes: Vec<Obb2<f32>> = ordinary::<Obb2<f64>, _>(5, 1);
        let (five, four) = (
            here.upload(&shapes).unwrap(),
            here.upload(&shapes[1..]).unwrap(),
        );
        let found = here.aligned(run, (&five, &four)).unwrap_err();
        assert_eq!(found, length(Argument::B, 5, 4));
        let ups = here.upload(&[1.0_f32; 4]).unwrap();
        let found = here.aligned(run.vjp(), ((&five, &five), &ups)).unwrap_err();
        assert_eq!(found, length(Argument::Upstream, 5, 4));
        let mut results = here.aligned(run, (&four, &four)).unwrap();
        let found = here
            .aligned_into(run, (&five, &five), &mut results)
            .unwrap_err();
        assert_eq!(found, length(Argument::Values, 5, 4));
        let mut matrix = here.all_pairs(run, &four, &five).unwrap();
        let found = here
            .all_pairs_into(run, &five, &four, &mut matrix)
            .unwrap_err();
        assert_eq!(found, length(Argument::Values, 5, 4));
        let found = here.all_pairs_vjp(run, &five, &four, &matrix).unwrap_err();
        assert_eq!(found, length(Argument::Upstream, 5, 4));
        let mut bad = shapes.clone();
        bad[3].size.x = f32::NAN;
        let invalid = here.upload(&bad).unwrap_err();
        assert!(
            matches!(invalid, Error::Invalid { item: 3, .. }),
            "{invalid}"
        );
        let mut held = here.upload(&shapes).unwrap();
        assert_eq!(held.update(&bad).unwrap_err(), invalid);
        assert_eq!(
            held.update(&bad[..2]).unwrap_err(),
            length(Argument::Shape, 5, 2)
        );
        assert_eq!(held.download().unwrap(), shapes);
        let invalid = here.aligned(run, (&five, One(bad[3]))).unwrap_err();
        assert!(
            matches!(
                invalid,
                Error::Invalid {
                    argument: Argument::B,
                    ..
                }
            ),
            "{invalid}"
        );
    }
    // Handles of others.
    let all = [Backend::Cpu, Backend::Gpu(gpu), Backend::Gpu(&other)].map(Backend::resident);
    let shapes: Vec<Obb2<f32>> = ordinary::<Obb2<f64>, _>(5, 1);
    for (i, j) in [(0, 1), (1, 0), (1, 2), (2, 1)] {
        let (here, there) = (all[i], all[j]);
        let (own, theirs) = (
            here.upload(&shapes).unwrap(),
            there.upload(&shapes).unwrap(),
        );
        assert_eq!(here.aligned(run, (&own, &theirs)).unwrap_err(), refused);
        assert_eq!(here.all_pairs(run, &theirs, &own).unwrap_err(), refused);
        let matrix = there.all_pairs(run, &theirs, &theirs).unwrap();
        let found = here.all_pairs_vjp(run, &own, &own, &matrix).unwrap_err();
        assert_eq!(found, refused);
        let mut results = there.aligned(run, (&theirs, &theirs)).unwrap();
        let found = here.aligned_into(run, (&own, &own), &mut results);
        assert_eq!(found.unwrap_err(), refused);
    }
    let polygon: ConvexPolygon<f32, 4> = Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0).into();
    let here = Backend::Gpu(gpu).resident();
    let held = here.upload(&[polygon]).unwrap();
    let found = here.aligned(Diameter, &held).unwrap_err();
    assert_eq!(found, Error::Program(Unrecordable::Search));
}

#[test]
fn a_lost_device_is_an_error() {
    let Some((_turn, _)) = gpu() else { return };
    let gpu = geograd::kernels::gpu::Gpu::new().unwrap();
    let here = Backend::Gpu(&gpu).resident();
    let held = here
        .upload(&[Obb2::new(0.0_f32, 0.0, 1.0, 1.0, 0.0)])
        .unwrap();
    let values = here.aligned(overlap::IouObb2, (&held, &held)).unwrap();
    gpu.destroy();
    let lost = Error::Gpu(GpuFault::DeviceLost);
    assert_eq!(values.download().unwrap_err(), lost);
    assert_eq!(
        here.aligned(overlap::IouObb2, (&held, &held)).unwrap_err(),
        lost
    );
    assert_eq!(
        here.all_pairs(overlap::IouObb2, &held, &held).unwrap_err(),
        lost
    );
    assert_eq!(here.upload(&[1.0_f32]).unwrap_err(), lost);
}
