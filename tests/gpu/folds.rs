//! Folds over paths on a GPU.
use crate::{gpu, small};
use geograd::ad::check::sample::Draw;
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Cpu, Fold, Item, One};
use geograd::{Error, Fixed, GpuFault, Pack, Segment2, Vec2, Vec3};
use geograd_tests::rows::fold;

/// Numbers that may differ by so much of their size, and of one.
fn near(name: &str, found: &[f32], expected: &[f32], by: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs();
        let bound = by * (1.0 + expected.abs());
        assert!(off <= bound, "{name} {i}: {found} for {expected}");
    }
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

/// Rings and chains of many sizes, empty ones among them.
pub fn paths() -> (Vec<Vec2<f32>>, Vec<usize>) {
    let mut draw = Draw::new(8);
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for size in [0, 1, 2, 3, 4, 7, 40, 0, 130, 5] {
        for k in 0..size {
            let angle = f64::from(k) / f64::from(size) * 6.2;
            let reach = draw.within(0.5, 2.0);
            let (sin, cos) = angle.sin_cos();
            vertices.push(Vec2::new((reach * cos) as f32, (reach * sin) as f32));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

/// A path that contexts share, beside the same on the CPU.
#[test]
fn one_path_for_all_contexts() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (vertices, offsets) = paths();
    let points: Vec<Vec2<f32>> = (0..70)
        .map(|k| Vec2::new(0.05 * k as f32 - 1.5, 0.3))
        .collect();
    let upstream: Vec<f32> = (0..70).map(|k| 1.0 - 0.03 * k as f32).collect();
    let run = fold::SignedDistancePointRing;
    let cpu = Cpu::new();
    // With small buffers contexts go up in several loads.
    for gpu in [gpu, &small()] {
        for path in [5, 6] {
            let path = &vertices[offsets[path]..offsets[path + 1]];
            let found = gpu.fold_one(run, &points, path).unwrap();
            let expected = cpu.fold_one(run, &points, path).unwrap();
            near("one path", &found, &expected, 1e-5);
            let found = gpu.fold_one_vjp(run, &points, path, &upstream).unwrap();
            let expected = cpu.fold_one_vjp(run, &points, path, &upstream).unwrap();
            near("contexts", &numbers(&found.0), &numbers(&expected.0), 1e-4);
            near("vertices", &numbers(&found.1), &numbers(&expected.1), 1e-4);
        }
        let none: [Vec2<f32>; 0] = [];
        assert_eq!(
            gpu.fold_one(run, &points, &none),
            cpu.fold_one(run, &points, &none)
        );
        let ring = &vertices[offsets[6]..offsets[7]];
        let found = gpu.fold_one(fold::SecondMomentsOfRing, One([]), ring);
        assert_eq!(found.unwrap().len(), 1);
    }
}

fn numbers<P: Pack<Scalar = f32>>(shapes: &[P]) -> Vec<f32> {
    shapes.iter().flat_map(Pack::scalars).collect()
}

#[test]
fn folds() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (vertices, offsets) = paths();
    let paths = offsets.len() - 1;
    let points: Vec<Vec2<f32>> = (0..paths).map(|k| Vec2::new(0.1 * k as f32, 0.3)).collect();
    folds_agree(
        gpu,
        fold::SignedDistancePointRing,
        &points[..],
        &vertices,
        &offsets,
    );
    folds_agree(
        gpu,
        fold::SignedDistancePointRing,
        One(points[1]),
        &vertices,
        &offsets,
    );
    folds_agree(gpu, fold::SecondMomentsOfRing, One([]), &vertices, &offsets);
    folds_agree(gpu, fold::LengthOfPolyline, One([]), &vertices, &offsets);
    let context = &points[..];
    folds_agree(
        gpu,
        fold::DistancePointPolyline,
        context,
        &vertices,
        &offsets,
    );
    folds_agree(gpu, fold::DistancePointRing, context, &vertices, &offsets);
    folds_agree(gpu, fold::DepthPointRing, context, &vertices, &offsets);
    folds_agree(gpu, fold::WindingOfRing, context, &vertices, &offsets);
    // Off the vertices, whose crossings would be decided by roundings.
    let ways: Vec<Segment2<f32>> = (0..paths)
        .map(|k| {
            Segment2::new(
                Vec2::new(-9.1, 0.1 * k as f32 - 0.33),
                Vec2::new(8.7, 0.217),
            )
        })
        .collect();
    folds_agree(gpu, fold::LengthInsideRing, &ways[..], &vertices, &offsets);
    // Polylines and clouds of space.
    let in_space: Vec<Vec3<f32>> = vertices
        .iter()
        .map(|v| Vec3::new(v.x, v.y, v.x * v.y - 0.5))
        .collect();
    let places: Vec<Vec3<f32>> = points.iter().map(|p| Vec3::new(p.x, p.y, 0.7)).collect();
    let (none, places) = (One([]), &places[..]);
    folds_agree(gpu, fold::LengthOfPolyline3, none, &in_space, &offsets);
    folds_agree(
        gpu,
        fold::DistancePointPolyline3,
        places,
        &in_space,
        &offsets,
    );
    folds_agree(gpu, fold::CentroidOfCloud3, none, &in_space, &offsets);
    folds_agree(gpu, fold::CovarianceOfCloud3, none, &in_space, &offsets);
    // A path that fits no buffer is an error; paths that fit are split into chunks.
    let small = small();
    let run = fold::SignedDistancePointRing;
    let found = small
        .fold(run, One(points[1]), &vertices, &offsets)
        .unwrap();
    let expected = gpu.fold(run, One(points[1]), &vertices, &offsets).unwrap();
    assert_eq!(bits(&found), bits(&expected));
    let long = vec![Vec2::new(1.0, 2.0); 5000];
    let refused = small.fold(run, One(points[1]), &long, &[0, 5000]);
    assert!(matches!(
        refused.unwrap_err(),
        Error::Gpu(GpuFault::TooLarge { bytes, most }) if bytes > most && most == small.most_bytes()
    ));
}

fn folds_agree<F: Fold, C: geograd::kernels::Columns<Item = F::Context<f32>> + Copy>(
    gpu: &Gpu,
    run: F,
    context: C,
    vertices: &[F::Element<f32>],
    offsets: &[usize],
) where
    F::Context<f32>: Item<Scalar = f32>,
{
    let numbers =
        |all: &[F::Out<f32>]| -> Vec<f32> { all.iter().flat_map(Pack::scalars).collect() };
    let cpu = Cpu::new();
    let found = gpu.fold(run, context, vertices, offsets).unwrap();
    let expected = cpu.fold(run, context, vertices, offsets).unwrap();
    near(
        F::DECLARED.name,
        &numbers(&found),
        &numbers(&expected),
        1e-5,
    );
    let seeds: Vec<F::Out<f32>> = found.iter().map(|_| F::Out::filled(0.75)).collect();
    let (by_context, by_vertex) = gpu
        .fold_vjp(run, context, vertices, offsets, &seeds)
        .unwrap();
    let expected = cpu
        .fold_vjp(run, context, vertices, offsets, &seeds)
        .unwrap();
    let flat =
        |all: &[F::Element<f32>]| -> Vec<f32> { all.iter().flat_map(Pack::scalars).collect() };
    near(
        F::DECLARED.name,
        &flat(&by_vertex),
        &flat(&expected.1),
        2e-5,
    );
    assert_eq!(by_context.len(), expected.0.len());
    for (found, expected) in by_context.iter().zip(&expected.0) {
        near(
            F::DECLARED.name,
            &found.scalars(),
            &expected.scalars(),
            2e-5,
        );
    }
}
