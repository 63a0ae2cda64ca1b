//! Rings on the GPU.
use crate::bounds::{EPSILON, ROUNDINGS};
use crate::shapes::{Draws, fields, shape_of};
use geograd::Vec2;
use geograd::kernels::cpu;
use geograd::kernels::gpu::{Gpu, GpuRing};

fn rings() -> (Vec<Vec2<f32>>, Vec<usize>) {
    let mut draws = Draws(5);
    let v = Vec2::new;
    let mut vertices = vec![
        // A triangle, a figure of eight, a line, a point twice, a square far away.
        v(0.0, 0.0),
        v(4.0, 0.0),
        v(0.0, 3.0),
        v(0.0, 0.0),
        v(1.0, 1.0),
        v(1.0, 0.0),
        v(0.0, 1.0),
        v(0.0, 0.0),
        v(1.0, 1.0),
        v(2.0, 2.0),
        v(5.0, 5.0),
        v(5.0, 5.0),
        v(1e6, 1e6),
        v(1e6 + 2.0, 1e6),
        v(1e6 + 2.0, 1e6 + 2.0),
        v(1e6, 1e6 + 2.0),
    ];
    let mut offsets = vec![0, 3, 7, 10, 12, 12, 16];
    for n in 0..60 {
        for i in 0..n {
            let (sin, cos) = (i as f32 / n as f32 * std::f32::consts::TAU).sin_cos();
            let r = 1.0 + draws.next();
            vertices.push(v(7.0 + r * cos, -3.0 + r * sin));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

pub fn rings_agree<O: GpuRing>(gpu: &Gpu) {
    let (vertices, offsets) = rings();
    let on = gpu.upload_rings(&vertices, &offsets).unwrap();
    let found = gpu.ragged::<O>(&on).unwrap().download().unwrap();
    let expected = cpu::ragged::<O, f32>(&vertices, &offsets).unwrap();
    assert_eq!(found.len(), expected.len());
    let upstream = vec![shape_of(&[1.5, -0.5]); expected.len()];
    let bars = gpu
        .ragged_vjp::<O>(&on, &upstream)
        .unwrap()
        .download()
        .unwrap();
    let expected_bars = cpu::ragged_vjp::<O, f32>(&vertices, &offsets, &upstream).unwrap();
    assert_eq!(bars.len(), expected_bars.len());
    for (ring, (found, expected)) in found.iter().zip(&expected).enumerate() {
        // Sums over edges of terms no larger than the square of the ring's extent, which is below
        // five; centroids divide them by areas of at least one, and add the first vertex.
        let edges = (offsets[ring + 1] - offsets[ring]) as f64;
        for (found, expected) in fields(*found).iter().zip(fields(*expected)) {
            let bound = (edges + ROUNDINGS) * EPSILON * (25.0 + expected.abs());
            assert!(
                (found - expected).abs() <= bound,
                "{} {ring}: {found} for {expected}",
                O::NAME
            );
        }
        for i in offsets[ring]..offsets[ring + 1] {
            for (found, expected) in fields(bars[i]).iter().zip(fields(expected_bars[i])) {
                let bound = (edges + ROUNDINGS) * EPSILON * (25.0 + expected.abs());
                assert!(
                    (found - expected).abs() <= bound,
                    "{} {ring}: {found} for {expected}",
                    O::NAME
                );
            }
        }
    }
}
