//! Rings on the GPU.
use crate::bounds::{EPSILON, ROUNDINGS};
use crate::shapes::{Draws, fields, shape_of};
use geograd::kernels::Backend;
use geograd::kernels::gpu::{Gpu, Options};
use geograd::ring::Measure;
use geograd::{Pack, Vec2};
use geograd_tests::calls::{self, OfRings};

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

pub fn rings_agree<O: OfRings<f32>>(gpu: &Gpu) {
    let (vertices, offsets) = rings();
    let found = gpu.ragged(O::default(), &vertices, &offsets).unwrap();
    let expected = Backend::Cpu
        .ragged(O::default(), &vertices, &offsets)
        .unwrap();
    assert_eq!(found.len(), expected.len());
    let upstream = vec![shape_of(&[1.5, -0.5]); expected.len()];
    let bars = gpu.ragged_vjp(O::default(), &vertices, &offsets, &upstream);
    let bars = bars.unwrap();
    let expected_bars = Backend::Cpu
        .ragged_vjp(O::default(), &vertices, &offsets, &upstream)
        .unwrap();
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
                O::DECLARED.name
            );
        }
        for i in offsets[ring]..offsets[ring + 1] {
            for (found, expected) in fields(bars[i]).iter().zip(fields(expected_bars[i])) {
                let bound = (edges + ROUNDINGS) * EPSILON * (25.0 + expected.abs());
                assert!(
                    (found - expected).abs() <= bound,
                    "{} {ring}: {found} for {expected}",
                    O::DECLARED.name
                );
            }
        }
    }
}

/// Coastlines: smooth rings of so many vertices, some of them long, between short ones.
fn coastlines(counts: &[usize]) -> (Vec<Vec2<f32>>, Vec<usize>) {
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for &n in counts {
        for i in 0..n {
            let at = i as f64 / n as f64 * std::f64::consts::TAU;
            let r = 1.5 + 0.5 * (5.0 * at).sin();
            let (x, y) = (7.0 + r * at.cos(), r * at.sin() - 3.0);
            vertices.push(Vec2::new(x as f32, y as f32));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

/// Long rings, of which more than one thread takes care, against the CPU in `f64`.
///
/// With the extent E ≤ 4 and the perimeter P < 16, a vertex is displaced by at most ε·E when it is
/// taken relative to the first one: that moves the area by ε·E·P, and the length of each edge by
/// twice ε·E. Sums have terms of together less than 2·E·P and a depth of less than 64: 8 vertices a
/// thread, 8 halvings, 20 spans.
pub fn long_rings_agree<O: OfRings<f32> + OfRings<f64>>(gpu: &Gpu, counts: &[usize]) {
    let (vertices, offsets) = coastlines(counts);
    let wide: Vec<Vec2<f64>> = vertices
        .iter()
        .map(|v| Vec2::new(f64::from(v.x), f64::from(v.y)))
        .collect();
    let on = Backend::Gpu(gpu).resident();
    let on = on.upload_rings(&vertices, &offsets).unwrap();
    let found = on.ragged(O::default()).unwrap().download().unwrap();
    let expected = calls::ragged::<O, f64>(&wide, &offsets).unwrap();
    let upstream = vec![shape_of(&[1.5, -0.5]); counts.len()];
    let run = || on.ragged_vjp(O::default(), &upstream).unwrap().download();
    let bars = run().unwrap();
    assert!(run().unwrap() == bars, "the same bits");
    let upstream = vec![shape_of(&[1.5, -0.5]); counts.len()];
    let expected_bars = calls::ragged_vjp::<O, f64>(&wide, &offsets, &upstream).unwrap();
    for (ring, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let (extent, around) = (4.0, 16.0);
        let ring = offsets[ring]..offsets[ring + 1];
        let corners = &wide[ring.clone()];
        let edge = |i: usize| (corners[(i + 1) % corners.len()] - corners[i]).length();
        let shortest = (0..corners.len()).map(edge).fold(f64::MAX, f64::min);
        let lengths = if O::MEASURE == Some(Measure::Perimeter) {
            2.0 * extent * corners.len() as f64
        } else {
            0.0
        };
        let bound = EPSILON * (64.0 * 2.0 * extent * around + lengths);
        for (found, expected) in fields(*found).into_iter().zip(expected.scalars()) {
            let n = corners.len();
            assert!(
                (found - expected).abs() <= bound,
                "{} of {n}: {found} for {expected}",
                O::DECLARED.name
            );
        }
        // Directions of edges turn by their displacement over their length.
        let bound = match O::MEASURE == Some(Measure::Perimeter) {
            true => 1.5 * 8.0 * EPSILON * extent / shortest,
            false => ROUNDINGS * EPSILON * 2.0 * extent,
        };
        for i in ring {
            let (x, y) = (bars[i], expected_bars[i]);
            assert!(
                (f64::from(x.x) - y.x).abs() <= bound,
                "{} {i}: {x:?} for {y:?}",
                O::DECLARED.name
            );
            assert!(
                (f64::from(x.y) - y.y).abs() <= bound,
                "{} {i}: {x:?} for {y:?}",
                O::DECLARED.name
            );
        }
    }
}

pub fn long_rings<O: OfRings<f32> + OfRings<f64>>() {
    let Some((_turn, gpu)) = crate::gpu() else {
        return;
    };
    long_rings_agree::<O>(gpu, &[3, 1023, 1024, 7, 2048, 2049, 0, 40_000, 5000]);
    // Buffers of 8192 vertices.
    let mut options = Options::default();
    options.most_bytes = Some(1 << 16);
    let gpu = Gpu::with(&options).unwrap();
    long_rings_agree::<O>(&gpu, &[5000, 8192, 1, 3000, 3000, 3000]);
}

/// Rings that stay and move: the same bits as of rings that are new.
pub fn moved_rings_agree<O: OfRings<f32>>() {
    let Some((_turn, gpu)) = crate::gpu() else {
        return;
    };
    let (vertices, offsets) = rings();
    let moved: Vec<_> = vertices.iter().map(|v| Vec2::new(v.y, v.x * 0.5)).collect();
    let upstream = vec![shape_of(&[1.5, -0.5]); offsets.len() - 1];
    for backend in [
        Backend::Cpu,
        Backend::Gpu(gpu),
        Backend::Gpu(&crate::small()),
    ] {
        let mut on = backend
            .resident()
            .upload_rings(&vertices, &offsets)
            .unwrap();
        on.update(&moved).unwrap();
        assert!(on.update(&moved[1..]).is_err());
        let bad = vec![Vec2::new(0.0, f32::NAN); moved.len()];
        assert!(on.update(&bad).is_err());
        let found = on.ragged(O::default()).unwrap().download().unwrap();
        let expected = backend.ragged(O::default(), &moved, &offsets).unwrap();
        for (x, y) in found.iter().zip(&expected) {
            assert_eq!(fields(*x), fields(*y));
        }
        let bars = on
            .ragged_vjp(O::default(), &upstream)
            .unwrap()
            .download()
            .unwrap();
        let expected = backend
            .ragged_vjp(O::default(), &moved, &offsets, &upstream)
            .unwrap();
        assert_eq!(bars, expected);
    }
}
